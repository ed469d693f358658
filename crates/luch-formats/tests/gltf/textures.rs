//! Pictures, samplers, uv sets and channels.

use crate::asset::Asset;
use glam::Vec2;
use luch_image::{Encoding, Image, codec};
use luch_scene::{Channel, Material, Principled, Scene, Surface, Texture, TextureFilter, Wrap};
use serde_json::{Value, json};

/// A PNG of two by one pixels.
fn picture() -> Vec<u8> {
    let image = Image::from_pixels(2, 1, vec![[255, 0, 0], [0, 255, 0]]).unwrap();
    codec::encode_png8(&image, &codec::Metadata::default()).unwrap()
}

/// The triangle with a material and texture 0, whose picture lies in the buffer.
fn textured(material: Value) -> Asset {
    let mut asset = Asset::with_material(material);
    let view = asset.view(&picture());
    asset.json["images"] = json!([{ "bufferView": view, "mimeType": "image/png" }]);
    asset.json["textures"] = json!([{ "source": 0 }]);
    asset
}

fn principled(material: &Material) -> &Principled {
    match &material.surface {
        Surface::Principled(principled) => principled,
        other => panic!("{other:?} is not principled"),
    }
}

fn encoding(scene: &Scene, texture: luch_scene::TextureUse) -> Encoding {
    match scene.textures[texture.texture.index()] {
        Texture::Image { encoding, .. } => encoding,
        Texture::Checker { .. } => panic!("no picture"),
    }
}

#[test]
fn every_channel_is_read_where_the_format_puts_it() {
    let info = json!({ "index": 0 });
    let asset = textured(json!({
        "pbrMetallicRoughness": { "baseColorTexture": info, "metallicRoughnessTexture": info, "metallicFactor": 0.5 },
        "normalTexture": { "index": 0, "scale": 0.25 },
        "occlusionTexture": info,
        "emissiveTexture": info,
        "emissiveFactor": [1, 1, 1],
        "extensions": {
            "KHR_materials_transmission": { "transmissionFactor": 1, "transmissionTexture": info },
            "KHR_materials_specular": { "specularTexture": info, "specularColorTexture": info },
        },
    }));
    let scene = asset.scene();
    let material = &scene.materials[0];
    let found = principled(material);
    let channel = |value: &luch_scene::ScalarValue| {
        value.texture.map(|(used, channel)| (encoding(&scene, used), channel))
    };
    assert_eq!(channel(&found.metallic), Some((Encoding::Linear, Channel::Blue)));
    assert_eq!(found.metallic.factor, 0.5);
    assert_eq!(channel(&found.roughness), Some((Encoding::Linear, Channel::Green)));
    assert_eq!(channel(&found.transmission), Some((Encoding::Linear, Channel::Red)));
    assert_eq!(channel(&found.specular), Some((Encoding::Linear, Channel::Alpha)));
    let colors = [found.base_color, found.specular_color, material.emission.unwrap().radiance];
    for color in colors {
        assert_eq!(encoding(&scene, color.texture.unwrap()), Encoding::Srgb);
    }
    let map = material.normal_map.unwrap();
    assert_eq!((encoding(&scene, map.texture), map.scale), (Encoding::Linear, 0.25));
    assert_eq!(scene.textures.len(), 2, "one for each encoding");
}

#[test]
fn pictures_in_views_in_text_and_beside_the_file_are_the_same() {
    let material = json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } });
    let in_view = textured(material.clone()).scene();
    let mut beside = textured(material.clone());
    beside.json["images"] = json!([{ "uri": "my%20picture.png" }]);
    let beside = beside.load_with_files([("dir/my picture.png", picture())]).unwrap();
    assert_eq!(beside.warnings, []);
    let mut in_text = textured(material);
    let escaped: String = picture().iter().map(|byte| format!("%{byte:02x}")).collect();
    in_text.json["images"] = json!([{ "uri": format!("data:image/png,{escaped}") }]);
    let in_text = in_text.scene();
    assert_eq!((in_view.images[0].width, in_view.images[0].height), (2, 1));
    assert_eq!(in_view.images[0], beside.scene.images[0]);
    assert_eq!(in_view.images[0], in_text.images[0]);
}

#[test]
fn broken_pictures_leave_the_factor() {
    let material = json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 }, "baseColorFactor": [0.5, 0.5, 0.5, 1] } });
    let images = [
        (json!([{ "uri": "absent.png" }]), "/images/0: \"dir/absent.png\": no such file"),
        (json!([{ "uri": "data:image/png;base64,AAAA" }]), "/images/0: byte 0: the file starts with"),
        (
            json!([{ "uri": "http://example.com/a.png" }]),
            "/images/0/uri: \"http://example.com/a.png\" is no relative path",
        ),
    ];
    for (images, expected) in images {
        let mut asset = textured(material.clone());
        asset.json["images"] = images;
        let (scene, warning) = asset.scene_and_warning();
        assert_eq!(principled(&scene.materials[0]).base_color, luch_image::Rgb::gray(0.5).into());
        assert!(warning.contains(expected) && warning.contains("the factor alone is used"), "{warning}");
    }
}

#[test]
fn samplers() {
    let mut asset = textured(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }));
    asset.json["samplers"] =
        json!([{ "wrapS": 33648, "wrapT": 33071, "magFilter": 9728, "minFilter": 9987 }]);
    asset.json["textures"][0]["sampler"] = json!(0);
    let scene = asset.scene();
    let Texture::Image { wrap, filter, .. } = scene.textures[0] else { panic!() };
    assert_eq!((wrap, filter), ([Wrap::Mirror, Wrap::Clamp], TextureFilter::Nearest));
}

#[test]
fn the_uv_set_comes_from_the_transform_if_it_says_one() {
    let transform =
        json!({ "KHR_texture_transform": { "texCoord": 1, "offset": [0.25, 0], "scale": [2, 4] } });
    let info = json!({ "index": 0, "texCoord": 0, "extensions": transform });
    let mut asset = textured(json!({ "pbrMetallicRoughness": { "baseColorTexture": info } }));
    let uvs = asset.floats("VEC2", &[0.5; 6]);
    asset.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = json!(uvs);
    let scene = asset.scene();
    let used = principled(&scene.materials[0]).base_color.texture.unwrap();
    assert_eq!(used.uv_set, 1);
    // With v down: (0.5, 0.25) → (1.25, 1). With v up: (0.5, 0.75) → (1.25, 0).
    assert_eq!(used.place(Vec2::new(0.5, 0.75)), Vec2::new(1.25, 0.0));
}

#[test]
fn a_missing_uv_set_leaves_the_factor_for_that_mesh_only() {
    let mut asset = textured(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }));
    asset.json["meshes"][0]["primitives"]
        .as_array_mut()
        .unwrap()
        .push(json!({ "attributes": { "POSITION": 0 }, "material": 0 }));
    asset.json["meshes"]
        .as_array_mut()
        .unwrap()
        .push(json!({ "primitives": [{ "attributes": { "POSITION": 0 }, "material": 0 }] }));
    asset.json["nodes"].as_array_mut().unwrap().push(json!({ "mesh": 1 }));
    let (scene, warning) = asset.scene_and_warning();
    assert_eq!(scene.materials.len(), 2, "with and without the texture; the latter is shared");
    let has_texture: Vec<bool> =
        scene.materials.iter().map(|material| principled(material).base_color.texture.is_some()).collect();
    assert_eq!(has_texture, [true, false]);
    assert!(
        warning.contains("/materials/0/pbrMetallicRoughness/baseColorTexture: uv set 0 is not in a mesh"),
        "{warning}"
    );
}

#[test]
fn pictures_in_unknown_formats_are_named() {
    let mut asset = textured(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }));
    asset.json["textures"] = json!([{ "extensions": { "KHR_texture_basisu": { "source": 0 } } }]);
    asset.json["extensionsRequired"] = json!(["KHR_texture_basisu"]);
    let loaded = asset.load().unwrap();
    let warnings: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
    assert!(
        warnings
            .iter()
            .any(|warning| warning.contains("the extension \"KHR_texture_basisu\" is not honoured"))
    );
    assert!(warnings.iter().any(|warning| warning.contains("/textures/0: the texture has no \"source\"")));
    assert_eq!(warnings.len(), 2, "{warnings:?}");
}
