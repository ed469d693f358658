//! Small assets in memory.

use luch_formats::{Files, LoadError, Loaded, load_with};
use luch_mesh::TriangleMesh;
use luch_scene::{Scene, Shape};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// A document being put together, and its one buffer.
#[derive(Clone)]
pub(crate) struct Asset {
    pub(crate) json: Value,
    pub(crate) bytes: Vec<u8>,
}

impl Asset {
    /// `asset` and nothing else.
    pub(crate) fn new() -> Self {
        Self { json: json!({ "asset": { "version": "2.0" } }), bytes: Vec::new() }
    }

    /// One node with one mesh of one triangle: (0,0,0), (1,0,0), (0,1,0).
    pub(crate) fn triangle() -> Self {
        let mut asset = Self::new();
        let positions = asset.floats("VEC3", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
        asset.json["meshes"] = json!([{ "primitives": [{ "attributes": { "POSITION": positions } }] }]);
        asset.json["nodes"] = json!([{ "mesh": 0 }]);
        asset
    }

    /// The triangle with uv set 0 and a material.
    pub(crate) fn with_material(material: Value) -> Self {
        let mut asset = Self::triangle();
        let uvs = asset.floats("VEC2", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
        asset.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(uvs);
        asset.json["meshes"][0]["primitives"][0]["material"] = json!(0);
        asset.json["materials"] = json!([material]);
        asset
    }

    /// Appends an entry to a list of the document and returns its place.
    pub(crate) fn push(&mut self, list: &str, entry: Value) -> usize {
        let list = self.json.as_object_mut().unwrap().entry(list).or_insert_with(|| json!([]));
        let list = list.as_array_mut().unwrap();
        list.push(entry);
        list.len() - 1
    }

    /// A view of new bytes, which begin at a multiple of four.
    pub(crate) fn view(&mut self, bytes: &[u8]) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let offset = self.bytes.len();
        self.bytes.extend(bytes);
        self.push("bufferViews", json!({ "buffer": 0, "byteOffset": offset, "byteLength": bytes.len() }))
    }

    /// An accessor over new bytes.
    pub(crate) fn accessor(&mut self, form: &str, component: u32, count: usize, bytes: &[u8]) -> usize {
        let view = self.view(bytes);
        self.push(
            "accessors",
            json!({ "bufferView": view, "componentType": component, "type": form, "count": count }),
        )
    }

    /// An accessor of floating-point numbers.
    pub(crate) fn floats(&mut self, form: &str, numbers: &[f32]) -> usize {
        let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
        let width = match form {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            _ => 16,
        };
        self.accessor(form, 5126, numbers.len() / width, &bytes)
    }

    /// The document with its buffer named.
    fn finished(&self, uri: Option<&str>) -> Value {
        let mut json = self.json.clone();
        if !self.bytes.is_empty() && json.get("buffers").is_none() {
            json["buffers"] = json!([{ "byteLength": self.bytes.len() }]);
            if let Some(uri) = uri {
                json["buffers"][0]["uri"] = json!(uri);
            }
        }
        json
    }

    /// A .glb file.
    pub(crate) fn to_glb(&self) -> Vec<u8> {
        glb(&serde_json::to_vec(&self.finished(None)).unwrap(), &self.bytes)
    }

    /// Loads it as .gltf with a .bin beside it.
    pub(crate) fn load(&self) -> Result<Loaded, LoadError> {
        self.load_with_files([])
    }

    /// As [`Asset::load`] with more files beside it.
    pub(crate) fn load_with_files<const N: usize>(
        &self,
        more: [(&str, Vec<u8>); N],
    ) -> Result<Loaded, LoadError> {
        let text = serde_json::to_vec_pretty(&self.finished(Some("t.bin"))).unwrap();
        let own = [("dir/t.gltf", text), ("dir/t.bin", self.bytes.clone())];
        let files = own.into_iter().chain(more).map(|(name, bytes)| (PathBuf::from(name), bytes));
        load_with(Path::new("dir/t.gltf"), &Files::memory(files))
    }

    /// The scene; the asset must be sound and raise no warning.
    pub(crate) fn scene(&self) -> Scene {
        let loaded = self.load().unwrap();
        assert_eq!(loaded.warnings, [], "no warning expected");
        assert_eq!(loaded.scene.problems(), [""; 0]);
        loaded.scene
    }

    /// What the import says when it refuses the asset.
    pub(crate) fn error(&self) -> String {
        self.load().expect_err("the asset is broken").to_string()
    }

    /// The scene and the one warning it raises.
    pub(crate) fn scene_and_warning(&self) -> (Scene, String) {
        let loaded = self.load().unwrap();
        assert_eq!(loaded.scene.problems(), [""; 0]);
        assert_eq!(loaded.warnings.len(), 1, "one warning expected: {:?}", loaded.warnings);
        (loaded.scene, loaded.warnings[0].to_string())
    }
}

/// A binary container of two chunks.
pub(crate) fn glb(json: &[u8], binary: &[u8]) -> Vec<u8> {
    let mut json = json.to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut binary = binary.to_vec();
    binary.resize(binary.len().next_multiple_of(4), 0);
    let word = |number: usize| (number as u32).to_le_bytes();
    let mut file = [b"glTF".as_slice(), &word(2), &word(28 + json.len() + binary.len())].concat();
    file.extend([&word(json.len()), b"JSON".as_slice(), &json].concat());
    file.extend([&word(binary.len()), b"BIN\0".as_slice(), &binary].concat());
    file
}

/// Loads one file from memory.
pub(crate) fn load_bytes(bytes: Vec<u8>) -> Result<Loaded, LoadError> {
    load_with(Path::new("t.glb"), &Files::memory([("t.glb".into(), bytes)]))
}

/// The mesh of a shape.
pub(crate) fn mesh(scene: &Scene, shape: usize) -> &TriangleMesh {
    match &*scene.shapes[shape] {
        Shape::Mesh(mesh) => mesh,
        other => panic!("{other:?} is no mesh"),
    }
}

/// Triangles over all shapes.
pub(crate) fn triangle_count(scene: &Scene) -> usize {
    (0..scene.shapes.len()).map(|shape| mesh(scene, shape).triangles.len()).sum()
}

/// The folder of real glTF files, or `None`, having said so.
pub(crate) fn data_folder() -> Option<PathBuf> {
    let folder = match std::env::var_os("LUCH_TEST_DATA") {
        Some(folder) => PathBuf::from(folder),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"),
    };
    let folder = folder.join("gltf");
    if folder.is_dir() {
        return Some(folder);
    }
    eprintln!("skipped: no test data");
    None
}

/// All glTF files below a folder, in order.
pub(crate) fn gltf_files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut waiting = vec![folder.to_owned()];
    while let Some(folder) = waiting.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                waiting.push(path);
            } else if path.extension().is_some_and(|extension| extension == "gltf" || extension == "glb") {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}
