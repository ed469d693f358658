//! Files that are broken on purpose: never a panic, an error with its place where the geometry cannot be trusted.

use crate::asset::{data_folder, gltf_files};
use luch_formats::{Files, Place, load_with};
use serde_json::Value;
use std::path::Path;

/// Findings of the Khronos validator that leave nothing to be decoded: files with one of them must be refused.
const FATAL: [&str; 25] = [
    "ACCESSOR_SMALL_BYTESTRIDE",
    "ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE",
    "ACCESSOR_TOO_LONG",
    "ASSET_MIN_VERSION_GREATER_THAN_VERSION",
    "BUFFER_BYTE_LENGTH_MISMATCH",
    "BUFFER_VIEW_TOO_LONG",
    "GLB_CHUNK_TOO_BIG",
    "GLB_DUPLICATE_CHUNK",
    "GLB_EMPTY_CHUNK",
    "GLB_INVALID_MAGIC",
    "GLB_INVALID_VERSION",
    "GLB_LENGTH_MISMATCH",
    "GLB_LENGTH_TOO_SMALL",
    "GLB_UNEXPECTED_END_OF_CHUNK_DATA",
    "GLB_UNEXPECTED_END_OF_CHUNK_HEADER",
    "GLB_UNEXPECTED_END_OF_HEADER",
    "GLB_UNEXPECTED_FIRST_CHUNK",
    "INVALID_JSON",
    "IO_ERROR",
    "PATTERN_MISMATCH",
    "TYPE_MISMATCH",
    "UNKNOWN_ASSET_MAJOR_VERSION",
    "UNRESOLVED_REFERENCE",
    "UNDEFINED_PROPERTY",
    "INVALID_URI",
];

/// Files with such a finding that load all the same, and why.
const FORGIVEN: [(&str, &str); 4] = [
    ("animation", "animations are not played, so their references are not followed"),
    ("camera/empty_objects.gltf", "no node uses the cameras"),
    ("glb/bom.glb", "a byte order mark is skipped, as the specification allows"),
    ("buffer/invalid_uri_data.gltf", "a doubled semicolon leaves no doubt about the data"),
];

/// The findings of severity 0 in the report beside a file.
fn findings(file: &Path) -> Vec<String> {
    let mut name = file.as_os_str().to_owned();
    name.push(".report.json");
    let report: Value = serde_json::from_slice(&std::fs::read(name).unwrap()).unwrap();
    let messages = report["issues"]["messages"].as_array().cloned().unwrap_or_default();
    let code = |message: &Value| message["code"].as_str().unwrap().to_owned();
    messages.iter().filter(|message| message["severity"] == 0).map(code).collect()
}

#[test]
fn what_the_validator_calls_undecodable_is_refused() {
    let Some(folder) = data_folder() else { return };
    let folder = folder.join("invalid-khronos/base/data");
    let (mut loaded, mut refused, mut fatal) = (0, 0, 0);
    for file in gltf_files(&folder) {
        let name = file.strip_prefix(&folder).unwrap().to_str().unwrap().replace('\\', "/");
        let codes = findings(&file);
        let is_forgiven = FORGIVEN.iter().any(|(prefix, _)| name.starts_with(prefix));
        let must_fail = codes.iter().any(|code| FATAL.contains(&code.as_str())) && !is_forgiven;
        fatal += usize::from(must_fail);
        match load_with(&file, &Files::disk()) {
            Ok(scene) => {
                assert!(!must_fail, "{name} loads, but the validator finds {codes:?}");
                assert_eq!(scene.scene.problems(), [""; 0], "{name}");
                loaded += 1;
            }
            Err(error) => {
                assert!(error.problems.iter().all(|problem| problem.place.is_some()), "{error}");
                refused += 1;
            }
        }
    }
    eprintln!("broken glTF files: {loaded} loaded, {refused} refused, of which {fatal} had to be");
    assert!(loaded >= 60 && fatal >= 35, "{loaded} loaded, {fatal} had to be refused");
}

#[test]
fn files_without_fault_load() {
    let Some(folder) = data_folder() else { return };
    let folder = folder.join("invalid-khronos/base/data");
    // Without errors for the validator, yet beyond a reader of 2.0 without network and extensions.
    let beyond =
        ["accessor/unknown_type.gltf", "asset/min_version_valid.gltf", "buffer/non_relative_uri.gltf"];
    let mut count = 0;
    for file in gltf_files(&folder).iter().filter(|file| findings(file).is_empty()) {
        let is_beyond = beyond.iter().any(|name| file.ends_with(name));
        let result = load_with(file, &Files::disk());
        assert_eq!(result.is_ok(), !is_beyond, "{}: {:?}", file.display(), result.err());
        count += 1;
    }
    assert!(count >= 20, "{count}");
}

#[test]
fn errors_name_their_place() {
    let Some(folder) = data_folder() else { return };
    let pointer = |path: &str| Place::Path(path.to_owned());
    let files = [
        ("invalid-assimp/BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb", pointer("/accessors/2")),
        ("invalid-assimp/IncorrectVertexArrays/Cube.gltf", pointer("/bufferViews/2")),
        ("invalid-assimp/IndexOutOfRange/AllIndicesOutOfRange.gltf", pointer("/accessors/0")),
        ("invalid-assimp/IndexOutOfRange/IndexOutOfRange.gltf", pointer("/accessors/0")),
        ("invalid-assimp/MissingBin/BoxTextured.gltf", pointer("/buffers/0/uri")),
        ("invalid-assimp/RecursiveNodes/RecursiveNodes.gltf", pointer("/nodes/0")),
        ("invalid-assimp/TestNoRootNode/NoScene.gltf", pointer("/scene")),
        ("invalid-assimp/wrongTypes/badArray.gltf", pointer("/meshes/0/primitives")),
        ("invalid-assimp/wrongTypes/badNumber.gltf", pointer("/materials/0/normalTexture/scale")),
        ("invalid-assimp/wrongTypes/badObject.gltf", pointer("/materials/0/pbrMetallicRoughness")),
        ("invalid-assimp/wrongTypes/badString.gltf", pointer("/scenes/0/name")),
        (
            "invalid-assimp/wrongTypes/badUint.gltf",
            pointer("/materials/0/pbrMetallicRoughness/baseColorTexture/index"),
        ),
        ("invalid-khronos/base/data/accessor/small_stride.gltf", pointer("/accessors/0")),
        ("invalid-khronos/base/data/buffer/wrong_bytelength.glb", pointer("/buffers/0/byteLength")),
        ("invalid-khronos/base/data/glb/chunk_too_big.glb", Place::Byte(12)),
        ("invalid-khronos/base/data/glb/invalid_version.glb", Place::Byte(4)),
        ("invalid-khronos/base/data/glb/invalid_json_chunk.glb", Place::Byte(21)),
    ];
    for (name, place) in files {
        let error = load_with(&folder.join(name), &Files::disk()).expect_err(name);
        assert_eq!(error.problems.len(), 1);
        assert_eq!(error.problems[0].place, Some(place), "{error}");
    }
}
