//! Meshes from real files: readers of positions and faces, no more than these tests need.

use crate::meshes::Mesh;
use glam::{Vec3, vec3};
use std::collections::HashMap;
use std::path::PathBuf;

/// The files that are there, or `None` with a line that says so.
#[expect(clippy::print_stdout)]
pub(crate) fn meshes() -> Vec<Mesh> {
    let beside = || PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let folder = std::env::var_os("LUCH_TEST_DATA").map_or_else(beside, PathBuf::from);
    let names = [
        "mesh/spot/spot.obj",
        "mesh/trimesh/models/teapot.stl",
        "mesh/trimesh/models/round.stl",
        "mesh/trimesh/models/octagonal_pocket.stl",
        "mesh/trimesh/models/20mm-xyz-cube.stl",
    ];
    let read = |name: &&str| {
        let bytes = std::fs::read(folder.join(name)).ok()?;
        let mesh = if name.ends_with("obj") { obj(name, &bytes) } else { stl(name, &bytes) };
        assert!(mesh.triangles.len() > 10, "{name} was not understood");
        Some(mesh)
    };
    let meshes: Vec<_> = names.iter().filter_map(read).collect();
    if meshes.is_empty() {
        println!("skipped: no test data");
    }
    meshes
}

fn obj(name: &str, bytes: &[u8]) -> Mesh {
    let text = String::from_utf8_lossy(bytes);
    let mut mesh = Mesh::new(name, Vec::new(), Vec::new());
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let numbers: Vec<f32> = words.filter_map(|word| word.parse().ok()).collect();
                mesh.positions.push(Vec3::from_slice(&numbers));
            }
            Some("f") => {
                let index = |word: &str| word.split('/').next().unwrap().parse::<u32>().unwrap() - 1;
                let corners: Vec<u32> = words.map(index).collect();
                mesh.triangles.extend(corners.windows(2).skip(1).map(|pair| [corners[0], pair[0], pair[1]]));
            }
            _ => {}
        }
    }
    mesh
}

/// Binary, or text when the size says so. Equal corners are merged.
fn stl(name: &str, bytes: &[u8]) -> Mesh {
    let mut mesh = Mesh::new(name, Vec::new(), Vec::new());
    let mut seen: HashMap<[u32; 3], u32> = HashMap::new();
    let mut corners = Vec::new();
    let count = u32::from_le_bytes(bytes[80..84].try_into().unwrap()) as usize;
    if bytes.len() == 84 + count * 50 {
        for face in bytes[84..].chunks_exact(50) {
            let number = |at: usize| f32::from_le_bytes(face[at..at + 4].try_into().unwrap());
            corners.extend((0..3).map(|corner| [0, 4, 8].map(|axis| number(12 + corner * 12 + axis))));
        }
    } else {
        for line in String::from_utf8_lossy(bytes).lines().filter(|line| line.trim().starts_with("vertex")) {
            let numbers: Vec<f32> =
                line.split_whitespace().skip(1).map(|word| word.parse().unwrap()).collect();
            corners.push([numbers[0], numbers[1], numbers[2]]);
        }
    }
    for face in corners.chunks_exact(3) {
        let mut index = |corner: &[f32; 3]| {
            *seen.entry(corner.map(f32::to_bits)).or_insert_with(|| {
                mesh.positions.push(vec3(corner[0], corner[1], corner[2]));
                mesh.positions.len() as u32 - 1
            })
        };
        let triangle = [index(&face[0]), index(&face[1]), index(&face[2])];
        mesh.triangles.push(triangle);
    }
    mesh
}
