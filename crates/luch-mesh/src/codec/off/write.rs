//! The writer.

use super::Parts;
use crate::PolygonMesh;
use crate::codec::error::EncodeError;
use crate::codec::soundness;
use crate::codec::text::{put_all, put_f32, put_integer, write_rows};
use crate::codec::vertices::Split;

/// Writes a polygon mesh as text. Numbers are the shortest that read back as the same `f32`.
///
/// OFF has one normal, uv and colour per vertex: where the mesh has more its positions are split. Faces with holes are cut
/// into triangles. Lost: uv sets but the first, slots, smoothing groups, creases.
///
/// # Errors
/// If the mesh is broken: an index leads nowhere, lists differ in length.
pub fn encode_polygons(mesh: &PolygonMesh) -> Result<Vec<u8>, EncodeError> {
    soundness::check(mesh)?;
    let without_holes;
    let mesh = if mesh.holes.is_empty() {
        mesh
    } else {
        without_holes = PolygonMesh::from(&mesh.triangulate());
        &without_holes
    };
    let split = Split::new(mesh, 1);
    let parts = Parts {
        uvs: mesh.uv_sets.first().is_some_and(|uvs| !uvs.is_empty()),
        colors: !mesh.colors.is_empty(),
        normals: !mesh.normals.is_empty(),
    };
    let prefix = [("ST", parts.uvs), ("C", parts.colors), ("N", parts.normals)];
    let mut text: Vec<u8> =
        prefix.iter().filter(|(_, is_there)| *is_there).flat_map(|(name, _)| name.bytes()).collect();
    text.extend(format!("OFF\n{} {} 0\n", split.len(), mesh.face_count()).bytes());
    write_rows(&mut text, split.len(), |vertex, text| {
        let [x, y, z] = mesh.positions[split.positions[vertex] as usize].to_array();
        put_f32(text, x);
        put_all(text, &[y, z]);
        if parts.normals {
            put_all(text, &split.value(&mesh.normals, vertex, glam::Vec3::Z).to_array());
        }
        if parts.colors {
            for channel in split.value(&mesh.colors, vertex, glam::Vec4::ONE).to_array() {
                let before = text.len();
                put_all(text, &[channel]);
                // A whole number would be taken for one of 255.
                if text[before..].iter().all(|byte| *byte == b' ' || *byte == b'-' || byte.is_ascii_digit()) {
                    text.extend_from_slice(b".0");
                }
            }
        }
        if parts.uvs {
            put_all(text, &split.value(&mesh.uv_sets[0], vertex, glam::Vec2::ZERO).to_array());
        }
        text.push(b'\n');
    });
    write_rows(&mut text, mesh.face_count(), |face, text| {
        let corners = mesh.face(face);
        put_integer(text, corners.len() as u64);
        for &vertex in &split.corners[corners] {
            text.push(b' ');
            put_integer(text, vertex.into());
        }
        text.push(b'\n');
    });
    Ok(text)
}
