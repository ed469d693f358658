//! Random damage to a file that uses everything: an error or a sound scene, never a panic.

use crate::asset::{Asset, load_bytes};
use proptest::prelude::*;
use serde_json::{Value, json};
use std::sync::LazyLock;

/// A file with every kind of thing the importer reads.
fn everything() -> Asset {
    let mut asset = Asset::with_material(json!({
        "pbrMetallicRoughness": {
            "baseColorTexture": { "index": 0, "extensions": { "KHR_texture_transform": { "rotation": 1, "texCoord": 0 } } },
            "baseColorFactor": [1, 1, 1, 0.5],
        },
        "normalTexture": { "index": 0, "scale": 2 },
        "emissiveFactor": [1, 0, 0],
        "alphaMode": "MASK",
        "extensions": {
            "KHR_materials_ior": { "ior": 1.3 },
            "KHR_materials_transmission": { "transmissionFactor": 1 },
            "KHR_materials_volume": { "thicknessFactor": 1 },
            "KHR_materials_specular": { "specularFactor": 0.5 },
            "KHR_materials_emissive_strength": { "emissiveStrength": 2 },
        },
    }));
    let normals = asset.floats("VEC3", &[0.0, 0.0, 1.0].repeat(3));
    let tangents = asset.floats("VEC4", &[1.0, 0.0, 0.0, 1.0].repeat(3));
    let colors = asset.accessor("VEC4", 5121, 3, &[200; 12]);
    asset.json["accessors"][colors]["normalized"] = json!(true);
    let indices = asset.accessor("SCALAR", 5123, 4, &[0, 0, 1, 0, 2, 0, 1, 0]);
    let attributes = &mut asset.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["NORMAL"] = json!(normals);
    attributes["TANGENT"] = json!(tangents);
    attributes["COLOR_0"] = json!(colors);
    asset.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
    asset.json["meshes"][0]["primitives"][0]["mode"] = json!(5);
    let sparse_indices = asset.view(&[1]);
    let sparse_values = asset.view(&[0; 12]);
    asset.json["accessors"][0]["sparse"] = json!({
        "count": 1,
        "indices": { "bufferView": sparse_indices, "componentType": 5121 },
        "values": { "bufferView": sparse_values },
    });
    let matrices = asset.floats("MAT4", &glam::Mat4::IDENTITY.to_cols_array());
    let translations = asset.floats("VEC3", &[1.0; 6]);
    let image = luch_image::Image::filled(3, 2, [9, 8, 7]);
    let png = luch_image::codec::encode_png8(&image, &luch_image::codec::Metadata::default()).unwrap();
    let view = asset.view(&png);
    asset.json["images"] = json!([{ "bufferView": view }]);
    asset.json["samplers"] = json!([{ "wrapS": 33071, "magFilter": 9728 }]);
    asset.json["textures"] = json!([{ "source": 0, "sampler": 0 }]);
    asset.json["skins"] = json!([{ "joints": [1], "inverseBindMatrices": matrices }]);
    asset.json["cameras"] = json!([
        { "type": "perspective", "perspective": { "yfov": 1, "aspectRatio": 1, "znear": 1 } },
        { "type": "orthographic", "orthographic": { "xmag": 1, "ymag": 1, "znear": 0, "zfar": 1 } },
    ]);
    asset.json["extensions"] = json!({ "KHR_lights_punctual": { "lights": [
        { "type": "spot", "spot": { "innerConeAngle": 0.1 }, "intensity": 3 },
        { "type": "directional" },
    ] } });
    asset.json["nodes"] = json!([
        { "mesh": 0, "children": [1, 2], "scale": [1, -1, 1], "rotation": [0, 0, 0, 1] },
        { "mesh": 0, "extensions": { "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": translations } } } },
        { "camera": 0, "extensions": { "KHR_lights_punctual": { "light": 0 } } },
        { "mesh": 0, "skin": 0, "matrix": glam::Mat4::IDENTITY.to_cols_array() },
        { "camera": 1, "extensions": { "KHR_lights_punctual": { "light": 1 } } },
    ]);
    asset.json["scenes"] = json!([{ "nodes": [0, 3, 4] }]);
    asset.json["scene"] = json!(0);
    asset
}

static ASSET: LazyLock<Asset> = LazyLock::new(everything);
static FILE: LazyLock<Vec<u8>> = LazyLock::new(|| ASSET.to_glb());

/// JSON pointers of every value of the document.
static POINTERS: LazyLock<Vec<String>> = LazyLock::new(|| {
    fn gather(value: &Value, path: &str, found: &mut Vec<String>) {
        found.push(path.to_owned());
        match value {
            Value::Array(items) => {
                items
                    .iter()
                    .enumerate()
                    .for_each(|(place, item)| gather(item, &format!("{path}/{place}"), found));
            }
            Value::Object(object) => {
                object.iter().for_each(|(key, item)| gather(item, &format!("{path}/{key}"), found));
            }
            _ => {}
        }
    }
    let mut found = Vec::new();
    gather(&ASSET.json, "", &mut found);
    found
});

/// What is put in place of a value.
fn nasty() -> impl Strategy<Value = Value> {
    let numbers = prop::sample::select(vec![
        json!(0),
        json!(1),
        json!(2),
        json!(3),
        json!(7),
        json!(255),
        json!(5121),
        json!(5123),
        json!(5125),
        json!(5126),
        json!(-1),
        json!(0.5),
        json!(1e38),
        json!(-3.4e38),
        json!(1e308),
        json!(1e-45),
        json!(u32::MAX),
        json!(u64::MAX),
        json!(i64::MIN),
        json!(9e15),
    ]);
    let others = prop::sample::select(vec![
        json!(null),
        json!(true),
        json!(""),
        json!("data:,"),
        json!("data:;base64,AAAA"),
        json!("t.glb"),
        json!("../../x"),
        json!("MAT2"),
        json!("SCALAR"),
        json!("VEC4"),
        json!("point"),
        json!("BLEND"),
        json!([]),
        json!({}),
        json!([0, 0, 0]),
        json!([0, 1, 2, 3, 4]),
        json!([{}]),
    ]);
    prop_oneof![numbers, others]
}

/// A scene must be sound, and an error must say where it is. (An unsound scene is refused without a place.)
fn check(bytes: Vec<u8>) {
    match load_bytes(bytes) {
        Ok(loaded) => assert_eq!(loaded.scene.problems(), [""; 0]),
        Err(error) => {
            assert!(!error.problems.is_empty());
            assert!(error.problems.iter().all(|problem| problem.place.is_some()), "{error}");
        }
    }
}

#[test]
fn the_undamaged_file_has_everything() {
    let loaded = load_bytes(FILE.clone()).unwrap();
    let scene = &loaded.scene;
    assert_eq!((scene.instances.len(), scene.lights.len(), scene.cameras.len()), (4, 2, 2));
    assert_eq!(loaded.warnings.len(), 1, "the skin: {:?}", loaded.warnings);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2048, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn bytes_changed(damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8)) {
        let mut bytes = FILE.clone();
        for (place, byte) in damage {
            let place = place.index(bytes.len());
            bytes[place] = byte;
        }
        check(bytes);
    }

    #[test]
    fn values_replaced(damage in prop::collection::vec((any::<prop::sample::Index>(), nasty()), 1..4)) {
        let mut asset = ASSET.clone();
        asset.json["buffers"] = json!([{ "byteLength": asset.bytes.len() }]);
        for (place, value) in damage {
            if let Some(target) = asset.json.pointer_mut(&POINTERS[place.index(POINTERS.len())]) {
                *target = value;
            }
        }
        let json = serde_json::to_vec(&asset.json).unwrap();
        check(crate::asset::glb(&json, &asset.bytes));
    }

    #[test]
    fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..256)) {
        check(bytes.clone());
        check([b"glTF\x02\0\0\0".as_slice(), &bytes].concat());
        check(crate::asset::glb(&bytes, &[]));
    }
}
