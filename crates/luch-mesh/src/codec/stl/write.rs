//! The writers.

use std::fmt::Write;

use glam::Vec3;

use crate::TriangleMesh;

/// Writes text. Numbers are the shortest that read back as the same `f32`; all but positions is lost.
pub fn encode_ascii(mesh: &TriangleMesh) -> String {
    let mut text = String::from("solid mesh\n");
    // Writing to a string cannot fail.
    let _ = write_facets(&mut text, mesh);
    text.push_str("endsolid mesh\n");
    text
}

fn write_facets(text: &mut String, mesh: &TriangleMesh) -> std::fmt::Result {
    for t in 0..mesh.triangles.len() {
        let n = facet_normal(mesh, t);
        writeln!(text, "  facet normal {} {} {}\n    outer loop", n.x, n.y, n.z)?;
        for p in mesh.corners(t) {
            writeln!(text, "      vertex {} {} {}", p.x, p.y, p.z)?;
        }
        text.push_str("    endloop\n  endfacet\n");
    }
    Ok(())
}

/// Writes binary data; all but positions is lost. Meshes of more than 2³² − 1 triangles are cut off there.
pub fn encode_binary(mesh: &TriangleMesh) -> Vec<u8> {
    let count = u32::try_from(mesh.triangles.len()).unwrap_or(u32::MAX);
    let mut bytes = vec![0; 80];
    bytes[..11].copy_from_slice(b"binary mesh");
    bytes.extend(count.to_le_bytes());
    for t in 0..count as usize {
        let [a, b, c] = mesh.corners(t);
        for vector in [facet_normal(mesh, t), a, b, c] {
            bytes.extend(vector.to_array().into_iter().flat_map(f32::to_le_bytes));
        }
        bytes.extend([0, 0]);
    }
    bytes
}

fn facet_normal(mesh: &TriangleMesh, triangle: usize) -> Vec3 {
    let [a, b, c] = mesh.corners(triangle).map(|p| p.as_dvec3());
    (b - a).cross(c - a).try_normalize().map_or(Vec3::ZERO, |n| n.as_vec3())
}
