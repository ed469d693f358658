//! The writers.

use glam::Vec3;

use crate::TriangleMesh;
use crate::codec::text::{put_all, write_rows};

/// Writes text. Numbers are the shortest that read back as the same `f32`; all but positions is lost.
pub fn encode_ascii(mesh: &TriangleMesh) -> String {
    let mut text = b"solid mesh\n".to_vec();
    write_rows(&mut text, mesh.triangles.len(), |t, text| {
        text.extend_from_slice(b"  facet normal");
        put_all(text, &facet_normal(mesh, t).to_array());
        text.extend_from_slice(b"\n    outer loop\n");
        for corner in mesh.corners(t) {
            text.extend_from_slice(b"      vertex");
            put_all(text, &corner.to_array());
            text.push(b'\n');
        }
        text.extend_from_slice(b"    endloop\n  endfacet\n");
    });
    text.extend_from_slice(b"endsolid mesh\n");
    String::from_utf8_lossy(&text).into_owned()
}

/// Writes binary data; all but positions is lost. Meshes of more than 2³² − 1 triangles are cut off there.
pub fn encode_binary(mesh: &TriangleMesh) -> Vec<u8> {
    let count = u32::try_from(mesh.triangles.len()).unwrap_or(u32::MAX);
    let mut bytes = vec![0; 80];
    bytes[..11].copy_from_slice(b"binary mesh");
    bytes.extend(count.to_le_bytes());
    write_rows(&mut bytes, count as usize, |t, bytes| {
        let [a, b, c] = mesh.corners(t);
        for number in [facet_normal(mesh, t), a, b, c].map(|vector| vector.to_array()).as_flattened() {
            bytes.extend_from_slice(&number.to_le_bytes());
        }
        bytes.extend_from_slice(&[0, 0]);
    });
    bytes
}

fn facet_normal(mesh: &TriangleMesh, triangle: usize) -> Vec3 {
    let [a, b, c] = mesh.corners(triangle).map(|p| p.as_dvec3());
    (b - a).cross(c - a).try_normalize().map_or(Vec3::ZERO, |n| n.as_vec3())
}
