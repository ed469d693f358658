//! Triangles of generated polygons.

use crate::polygon_mesh::CornerAttribute;
use crate::{Attribute, PolygonMesh, TriangleMesh};

/// Cuts every face into a fan about its first corner. All faces that generators make are convex and have no holes, so
/// a fan is right; it is also always the same, and pictures of scenes rest on that.
pub(super) fn fans(mesh: PolygonMesh) -> TriangleMesh {
    let mut corners = Vec::with_capacity(mesh.corners.len());
    for face in 0..mesh.face_count() {
        let range = mesh.face(face);
        let first = range.start as u32;
        corners.extend((first + 1..(range.end as u32).max(first + 1) - 1).map(|c| [first, c, c + 1]));
    }
    TriangleMesh {
        triangles: corners.iter().map(|t| t.map(|corner| mesh.corners[corner as usize])).collect(),
        normals: attribute(mesh.normals, &corners),
        uv_sets: mesh.uv_sets.into_iter().map(|uvs| attribute(uvs, &corners)).collect(),
        positions: mesh.positions,
        ..TriangleMesh::default()
    }
}

fn attribute<T: Copy>(values: CornerAttribute<T>, corners: &[[u32; 3]]) -> Attribute<T> {
    if values.corners.is_empty() {
        return Attribute::per_position(values.values);
    }
    let triangles = corners.iter().map(|t| t.map(|corner| values.corners[corner as usize]));
    Attribute::indexed(values.values, triangles.collect())
}
