//! Importing glTF 2.0: small assets in memory, folders of real files, and mutations of both.

#![expect(clippy::print_stderr, reason = "tests say what they skipped and how many files they read")]

#[path = "gltf/accessors.rs"]
mod accessors;
#[path = "gltf/asset.rs"]
mod asset;
#[path = "gltf/broken_files.rs"]
mod broken_files;
#[path = "gltf/cameras_lights.rs"]
mod cameras_lights;
#[path = "gltf/good_files.rs"]
mod good_files;
#[path = "gltf/hostile.rs"]
mod hostile;
#[path = "gltf/materials.rs"]
mod materials;
#[path = "gltf/mutations.rs"]
mod mutations;
#[path = "gltf/nodes.rs"]
mod nodes;
#[path = "gltf/textures.rs"]
mod textures;
