//! Files made to break the importer: each ends with an error that says where, at once.

use crate::asset::{Asset, glb, load_bytes};
use luch_formats::{Files, load_with};
use serde_json::{Value, json};
use std::path::Path;

/// Puts `value` at a JSON pointer of the triangle and returns what the import says.
fn error_with(pointer: &str, value: Value) -> String {
    let mut asset = Asset::triangle();
    *asset.json.pointer_mut(pointer).unwrap() = value;
    asset.error()
}

#[test]
fn wrong_numbers_name_their_place() {
    let huge = json!(u64::MAX);
    let cases = [
        ("/accessors/0/count", json!(4), "/accessors/0: 4 elements of 12 bytes"),
        ("/accessors/0/count", huge.clone(), "/accessors/0: 18446744073709551615 elements"),
        ("/accessors/0/count", json!(-1), "/accessors/0/count: is the number -1"),
        ("/accessors/0/count", json!(2.5), "/accessors/0/count: is the number 2.5"),
        ("/accessors/0/componentType", json!(5124), "/accessors/0/componentType: is 5124"),
        ("/accessors/0/type", json!("VEC5"), "/accessors/0/type: is \"VEC5\""),
        ("/accessors/0/bufferView", json!(1), "/accessors/0/bufferView: refers to /bufferViews/1"),
        ("/bufferViews/0/byteLength", huge.clone(), "/bufferViews/0: reaches from byte 0"),
        ("/bufferViews/0/byteOffset", huge, "/bufferViews/0: reaches from byte 18446744073709551615"),
        ("/bufferViews/0/buffer", json!("x"), "/bufferViews/0/buffer: is the string \"x\""),
        ("/meshes/0/primitives/0/attributes/POSITION", json!(3), "/POSITION: refers to /accessors/3"),
        ("/meshes/0/primitives/0/attributes", json!([]), "/meshes/0/primitives/0/attributes: is an array"),
        ("/meshes/0/primitives", json!({}), "/meshes/0/primitives: is an object"),
        ("/nodes/0/mesh", json!(1), "/nodes/0/mesh: refers to /meshes/1"),
        ("/nodes", json!("all"), "/nodes: is the string \"all\""),
        ("/asset/version", json!("3.0"), "/asset/version: the file is glTF 3.0"),
    ];
    for (pointer, value, expected) in cases {
        let error = error_with(pointer, value);
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn indices_past_the_end_are_refused() {
    for index in [3_u8, 255] {
        let mut asset = Asset::triangle();
        let indices = asset.accessor("SCALAR", 5121, 3, &[0, 1, index]);
        asset.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
        let expected =
            format!("/accessors/1: element 2 is {index}, but /meshes/0/primitives/0 has 3 vertices");
        assert!(asset.error().contains(&expected), "{}", asset.error());
    }
}

#[test]
fn numbers_that_are_not_finite_are_refused() {
    for number in [f32::NAN, f32::INFINITY] {
        let mut asset = Asset::triangle();
        asset.bytes[16..20].copy_from_slice(&number.to_le_bytes());
        let error = asset.error();
        assert!(error.contains("/accessors/0: element 1 is [1.0") && error.contains("not finite"), "{error}");
    }
}

#[test]
fn sparse_indices_must_rise_and_fit() {
    for (indices, expected) in
        [([1, 1], "sparse index 1 is 1"), ([2, 3], "sparse index 1 is 3"), ([2, 0], "sparse index 1 is 0")]
    {
        let mut asset = Asset::triangle();
        let indices = asset.view(&indices);
        let values = asset.view(&[0; 24]);
        asset.json["accessors"][0]["sparse"] = json!({
            "count": 2,
            "indices": { "bufferView": indices, "componentType": 5121 },
            "values": { "bufferView": values },
        });
        assert!(asset.error().contains(expected), "{}", asset.error());
    }
}

#[test]
fn empty_lists_of_huge_length_take_no_memory() {
    // Without a view every element is zero: a few bytes of text claim four billion vertices.
    let mut asset = Asset::triangle();
    asset.json["accessors"][0] = json!({ "componentType": 5126, "type": "VEC3", "count": 4_294_967_295_u64 });
    assert!(asset.error().contains("out of proportion"), "{}", asset.error());
    asset.json["accessors"][0]["count"] = json!(4_294_967_296_u64);
    assert!(asset.error().contains("at most 2^32 - 1"), "{}", asset.error());
}

#[test]
fn lists_used_again_and_again_take_no_memory() {
    let mut asset = Asset::new();
    let positions = asset.floats("VEC3", &[1.0; 3 * 3000]);
    let primitive = json!({ "attributes": { "POSITION": positions } });
    asset.json["meshes"] = json!(vec![json!({ "primitives": [primitive] }); 5000]);
    asset.json["nodes"] = json!((0..5000).map(|mesh| json!({ "mesh": mesh })).collect::<Vec<_>>());
    assert!(asset.error().contains("out of proportion"), "{}", asset.error());
}

#[test]
fn many_primitives_over_one_list_share_it() {
    // The same as above in one mesh is sound: the vertices are there once.
    let mut asset = Asset::new();
    let positions = asset.floats("VEC3", &[1.0; 3 * 3000]);
    let indices = asset.accessor("SCALAR", 5121, 3, &[0, 1, 2]);
    let primitive = json!({ "attributes": { "POSITION": positions }, "indices": indices });
    asset.json["meshes"] = json!([{ "primitives": vec![primitive; 5000] }]);
    asset.json["nodes"] = json!([{ "mesh": 0 }]);
    let scene = asset.scene();
    assert_eq!(crate::asset::triangle_count(&scene), 5000);
    assert_eq!(crate::asset::mesh(&scene, 0).positions.len(), 3);
}

#[test]
fn text_that_is_no_json_names_line_and_column() {
    let text = "{\n  \"asset\": { \"version\": \"2.0\" },\n  \"nodes\": [ { ], }\n}";
    let files = Files::memory([("t.gltf".into(), text.into())]);
    let error = load_with(Path::new("t.gltf"), &files).unwrap_err().to_string();
    assert!(error.starts_with("t.gltf:3:16: no valid JSON: "), "{error}");
    assert!(error.contains("\"nodes\": [ { ], }"), "{error}");
    let error = load_bytes(glb(text.as_bytes(), &[])).unwrap_err().to_string();
    // Twenty bytes of headers come before the text.
    let expected = format!("t.glb: byte {}: no valid JSON: ", 20 + text.find(']').unwrap());
    assert!(error.starts_with(&expected), "{error}");
}

#[test]
fn deep_nesting_is_an_error() {
    let text = format!("{}{}", "[".repeat(1_000_000), "]".repeat(1_000_000));
    let error = load_bytes(glb(text.as_bytes(), &[])).unwrap_err().to_string();
    assert!(error.contains("recursion limit"), "{error}");
}

#[test]
fn every_truncation_of_a_binary_file_is_an_error() {
    let file = Asset::triangle().to_glb();
    for length in 0..file.len() {
        assert!(load_bytes(file[..length].to_vec()).is_err(), "{length} of {} bytes", file.len());
    }
}
