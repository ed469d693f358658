//! Every way in which vertices and indices can be stored.

use crate::asset::{Asset, load_bytes, mesh};
use glam::{Vec2, Vec3, Vec4};
use serde_json::json;

const CORNERS: [Vec3; 3] = [Vec3::ZERO, Vec3::X, Vec3::Y];

#[test]
fn a_triangle_without_anything_else() {
    let scene = Asset::triangle().scene();
    assert_eq!(mesh(&scene, 0).positions, CORNERS);
    assert_eq!(mesh(&scene, 0).triangles, [[0, 1, 2]]);
    assert!(mesh(&scene, 0).normals.is_empty(), "missing normals mean flat shading");
    assert_eq!((scene.instances.len(), scene.materials.len()), (1, 1));
}

#[test]
fn the_binary_container_says_the_same() {
    let asset = Asset::triangle();
    assert_eq!(load_bytes(asset.to_glb()).unwrap().scene.shapes, asset.scene().shapes);
}

#[test]
fn data_uris_say_the_same() {
    let mut asset = Asset::triangle();
    // Nine floats; 1.0 is 00 00 80 3f at bytes 12 and 28.
    let uri = "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    asset.json["buffers"] = json!([{ "byteLength": 36, "uri": uri }]);
    assert_eq!(mesh(&asset.scene(), 0).positions, CORNERS);
}

#[test]
fn indices_of_each_width() {
    let order = [2_u32, 0, 1];
    let widths: [(u32, Vec<u8>); 3] = [
        (5121, order.iter().map(|&index| index as u8).collect()),
        (5123, order.iter().flat_map(|&index| (index as u16).to_le_bytes()).collect()),
        (5125, order.iter().flat_map(|&index| index.to_le_bytes()).collect()),
    ];
    for (component, bytes) in widths {
        let mut asset = Asset::triangle();
        let indices = asset.accessor("SCALAR", component, 3, &bytes);
        asset.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
        assert_eq!(mesh(&asset.scene(), 0).triangles, [order]);
    }
}

#[test]
fn signed_and_float_indices_are_refused() {
    for (component, size) in [(5120, 1), (5122, 2), (5126, 4)] {
        let mut asset = Asset::triangle();
        let indices = asset.accessor("SCALAR", component, 3, &vec![0; 3 * size]);
        asset.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
        assert!(asset.error().contains("/accessors/1: is used for indices"), "{}", asset.error());
    }
}

#[test]
fn strips_and_fans() {
    for (mode, expected) in [(5, [[0, 1, 2], [1, 3, 2]]), (6, [[1, 2, 0], [2, 3, 0]])] {
        let mut asset = Asset::triangle();
        let square = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0];
        let positions = asset.floats("VEC3", &square);
        asset.json["meshes"][0]["primitives"][0] =
            json!({ "mode": mode, "attributes": { "POSITION": positions } });
        assert_eq!(mesh(&asset.scene(), 0).triangles, expected);
    }
}

#[test]
fn points_and_lines_are_named() {
    for (mode, name) in [(0, "points"), (1, "lines"), (2, "lines"), (3, "lines")] {
        let mut asset = Asset::triangle();
        asset.json["meshes"][0]["primitives"][0]["mode"] = json!(mode);
        let (scene, warning) = asset.scene_and_warning();
        assert_eq!(scene.instances.len(), 0);
        assert!(warning.contains("/meshes/0/primitives/0") && warning.contains(name), "{warning}");
    }
}

#[test]
fn interleaved_attributes() {
    let mut asset = Asset::new();
    let vertex = |position: Vec3, uv: Vec2| [position.x, position.y, position.z, uv.x, uv.y];
    let vertices: Vec<u8> = CORNERS
        .iter()
        .flat_map(|&corner| vertex(corner, Vec2::new(corner.x, 0.25)))
        .flat_map(|number| number.to_le_bytes())
        .collect();
    let view = asset.view(&vertices);
    asset.json["bufferViews"][view]["byteStride"] = json!(20);
    let accessor = |form: &str, offset| json!({ "bufferView": view, "byteOffset": offset, "componentType": 5126, "type": form, "count": 3 });
    let positions = asset.push("accessors", accessor("VEC3", 0));
    let uvs = asset.push("accessors", accessor("VEC2", 12));
    asset.json["meshes"] =
        json!([{ "primitives": [{ "attributes": { "POSITION": positions, "TEXCOORD_0": uvs } }] }]);
    asset.json["nodes"] = json!([{ "mesh": 0 }]);
    let scene = asset.scene();
    assert_eq!(mesh(&scene, 0).positions, CORNERS);
    // The file's v runs down, ours up.
    assert_eq!(mesh(&scene, 0).uv_sets[0].values, CORNERS.map(|corner| Vec2::new(corner.x, 0.75)));
}

#[test]
fn sparse_elements_replace_and_fill() {
    for has_base in [true, false] {
        let mut asset = Asset::triangle();
        let indices = asset.view(&[1, 2]);
        let values: Vec<u8> =
            [5.0_f32, 6.0, 7.0, 8.0, 9.0, 10.0].iter().flat_map(|x| x.to_le_bytes()).collect();
        let values = asset.view(&values);
        asset.json["accessors"][0]["sparse"] = json!({
            "count": 2,
            "indices": { "bufferView": indices, "componentType": 5121 },
            "values": { "bufferView": values },
        });
        if !has_base {
            asset.json["accessors"][0].as_object_mut().unwrap().remove("bufferView");
        }
        let expected = [Vec3::ZERO, Vec3::new(5.0, 6.0, 7.0), Vec3::new(8.0, 9.0, 10.0)];
        assert_eq!(mesh(&asset.scene(), 0).positions, expected);
    }
}

#[test]
fn normalised_integers_are_fractions() {
    // Specification, section 3.6.2.2: c / 127, c / 255, c / 32767, c / 65535, not below -1.
    let widths: [(u32, [Vec<u8>; 2], f32); 4] = [
        (5120, [vec![127], vec![0x80]], -1.0),
        (5121, [vec![255], vec![51]], 0.2),
        (5122, [vec![0xff, 0x7f], vec![0x01, 0x80]], -1.0),
        (5123, [vec![0xff, 0xff], vec![0x33, 0x33]], 0.2),
    ];
    for (component, [one, other], expected) in widths {
        let mut asset = Asset::triangle();
        let bytes = [&one, &other, &one, &other, &one, &other].map(Vec::as_slice).concat();
        let uvs = asset.accessor("VEC2", component, 3, &bytes);
        asset.json["accessors"][uvs]["normalized"] = json!(true);
        asset.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(uvs);
        assert_eq!(mesh(&asset.scene(), 0).uv_sets[0].values, [Vec2::new(1.0, 1.0 - expected); 3]);
    }
}

#[test]
fn quantized_positions() {
    let mut asset = Asset::triangle();
    // KHR_mesh_quantization: whole numbers as they stand.
    let numbers: [i16; 9] = [0, 0, 0, 300, 0, 0, 0, -2, 0];
    let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
    let positions = asset.accessor("VEC3", 5122, 3, &bytes);
    asset.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    asset.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = json!(positions);
    assert_eq!(mesh(&asset.scene(), 0).positions, [Vec3::ZERO, Vec3::X * 300.0, Vec3::Y * -2.0]);
}

#[test]
fn colours_of_each_kind() {
    let kinds: [(&str, u32, Vec<u8>, Vec4); 4] = [
        ("VEC3", 5121, vec![255, 0, 51], Vec4::new(1.0, 0.0, 0.2, 1.0)),
        ("VEC4", 5121, vec![255, 0, 51, 102], Vec4::new(1.0, 0.0, 0.2, 0.4)),
        ("VEC3", 5123, vec![0xff, 0xff, 0, 0, 0x33, 0x33], Vec4::new(1.0, 0.0, 0.2, 1.0)),
        (
            "VEC4",
            5126,
            [2.0_f32, -1.0, 0.25, 0.5].iter().flat_map(|x| x.to_le_bytes()).collect(),
            Vec4::new(1.0, 0.0, 0.25, 0.5),
        ),
    ];
    for (form, component, color, expected) in kinds {
        let mut asset = Asset::triangle();
        let colors = asset.accessor(form, component, 3, &color.repeat(3));
        asset.json["accessors"][colors]["normalized"] = json!(component != 5126);
        asset.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(colors);
        assert_eq!(mesh(&asset.scene(), 0).colors.values, [expected; 3]);
    }
}

#[test]
fn normals_and_tangents_become_units() {
    let mut asset = Asset::triangle();
    let normals = asset.floats("VEC3", &[0.0, 0.0, 2.0, 0.0, 0.0, 0.5, 0.0, 3e-6, 4e-6]);
    let tangents = asset.floats("VEC4", &[2.0, 0.0, 0.0, -1.0].repeat(3));
    asset.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(normals);
    asset.json["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] = json!(tangents);
    let scene = asset.scene();
    assert_eq!(mesh(&scene, 0).normals.values[..2], [Vec3::Z, Vec3::Z]);
    assert!(mesh(&scene, 0).normals.values[2].abs_diff_eq(Vec3::new(0.0, 0.6, 0.8), 1e-6));
    assert_eq!(mesh(&scene, 0).tangents.values, [Vec4::new(1.0, 0.0, 0.0, -1.0); 3]);
}

#[test]
fn normals_without_length_are_replaced() {
    let mut asset = Asset::triangle();
    let normals = asset.floats("VEC3", &[1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
    asset.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(normals);
    let (scene, warning) = asset.scene_and_warning();
    assert_eq!(mesh(&scene, 0).normals.values, [Vec3::X, Vec3::Z, Vec3::X]);
    assert!(warning.contains("/accessors/1: normals of length 0"), "{warning}");
}

#[test]
fn unused_vertices_are_dropped() {
    let mut asset = Asset::triangle();
    let positions = asset.floats("VEC3", &(0..30).map(|x| x as f32).collect::<Vec<_>>());
    let indices = asset.accessor("SCALAR", 5121, 3, &[9, 4, 7]);
    asset.json["meshes"][0]["primitives"] =
        json!([{ "attributes": { "POSITION": positions }, "indices": indices }]);
    let scene = asset.scene();
    assert_eq!(mesh(&scene, 0).positions.len(), 3);
    assert_eq!(mesh(&scene, 0).corners(0).map(|corner| corner.x), [27.0, 12.0, 21.0]);
}

#[test]
fn primitives_of_one_mesh_are_one_shape_with_slots() {
    let mut asset = Asset::triangle();
    asset.json["materials"] = json!([{ "name": "a" }, { "name": "b" }]);
    let more = asset.floats("VEC3", &[0.0, 0.0, 1.0, 1.0, 0.0, 1.0, 0.0, 1.0, 1.0]);
    asset.json["meshes"][0]["primitives"] = json!([
        { "attributes": { "POSITION": 0 }, "material": 1 },
        { "attributes": { "POSITION": more }, "material": 0 },
        { "attributes": { "POSITION": 0 }, "material": 0 },
    ]);
    let scene = asset.scene();
    assert_eq!((scene.shapes.len(), scene.instances.len()), (1, 1));
    let names: Vec<&str> = (0..3)
        .map(|triangle| {
            let material = scene.instances[0].material(mesh(&scene, 0).slot(triangle)).unwrap();
            scene.materials[material.index()].name.as_str()
        })
        .collect();
    // Primitives over the same vertices stand together.
    assert_eq!(names, ["b", "a", "a"]);
    assert_eq!(mesh(&scene, 0).positions.len(), 6);
    assert_eq!(mesh(&scene, 0).corners(1), CORNERS);
    assert_eq!(mesh(&scene, 0).corners(2), CORNERS.map(|corner| corner + Vec3::Z));
}

#[test]
fn primitives_with_other_attributes_are_shapes_of_their_own() {
    let mut asset = Asset::triangle();
    let normals = asset.floats("VEC3", &[0.0, 0.0, 1.0].repeat(3));
    asset.json["meshes"][0]["primitives"] =
        json!([{ "attributes": { "POSITION": 0 } }, { "attributes": { "POSITION": 0, "NORMAL": normals } }]);
    let scene = asset.scene();
    assert_eq!((scene.shapes.len(), scene.instances.len()), (2, 2));
    assert!(mesh(&scene, 0).normals.is_empty() && !mesh(&scene, 1).normals.is_empty());
}
