//! Faces to triangles, with corners that can be told.

use glam::Vec2;

use super::builder::{Builder, NewCorner, Shade};
use super::error::check_size;
use super::{EditError, prepared};
use crate::PolygonMesh;
use crate::polygon_mesh::{CornerAttribute, Hole};

/// A triangle of a face, by corners of the mesh.
#[derive(Clone, Copy)]
pub(super) struct FaceTriangle {
    pub(super) face: u32,
    pub(super) corners: [u32; 3],
}

/// The triangles of the marked faces of a prepared mesh, by face. Faces that give none are missing.
pub(super) fn face_triangles(mesh: &PolygonMesh, is_marked: impl Fn(usize) -> bool) -> Vec<FaceTriangle> {
    // A mesh of these faces only, whose uvs number the corners.
    let mut part = PolygonMesh { positions: mesh.positions.clone(), ..Default::default() };
    let mut faces = Vec::new();
    let mut corner_of = Vec::new();
    for face in (0..mesh.face_count()).filter(|&face| is_marked(face)) {
        for (number, border) in mesh.borders(face).into_iter().enumerate() {
            if number > 0 {
                part.holes.push(Hole { face: faces.len() as u32, start: part.corners.len() as u32 });
            }
            part.corners.extend_from_slice(&mesh.corners[border.clone()]);
            corner_of.extend(border.map(|corner| corner as u32));
        }
        part.face_ends.push(part.corners.len() as u32);
        faces.push(face as u32);
    }
    let numbers = (0..corner_of.len() as u32).collect();
    part.uv_sets.push(CornerAttribute { values: vec![Vec2::ZERO; corner_of.len()], corners: numbers });
    let cut = part.triangulation();
    let Some(corners) = cut.mesh.uv_sets.first() else { return Vec::new() };
    let triangles = corners.triangles.iter().zip(&cut.faces).map(|(triangle, &face)| FaceTriangle {
        face: faces[face as usize],
        corners: triangle.map(|corner| corner_of[corner as usize]),
    });
    triangles.collect()
}

/// Cuts the marked faces into triangles. Surface, edges and values stay; a closed mesh stays closed.
pub fn triangulate_faces(mesh: &PolygonMesh, faces: &[bool]) -> Result<PolygonMesh, EditError> {
    let mesh = &*prepared(mesh);
    let is_marked = |face: usize| faces.get(face).copied().unwrap_or(false) && mesh.face(face).len() > 3;
    let triangles = face_triangles(mesh, is_marked);
    check_size(
        (mesh.face_count() + triangles.len()) as u64,
        mesh.corners.len() as u64 + triangles.len() as u64 * 3,
    )?;
    let mut builder = Builder::new(mesh);
    let mut rest = triangles.as_slice();
    for face in 0..mesh.face_count() {
        if !is_marked(face) {
            builder.copy_face(face);
            continue;
        }
        let count = rest.iter().take_while(|triangle| triangle.face as usize == face).count();
        for triangle in &rest[..count] {
            let corners = triangle
                .corners
                .map(|corner| NewCorner::like(mesh.corners[corner as usize], corner))
                .to_vec();
            builder.face(face, &[corners], Shade::Mixed, None);
        }
        rest = &rest[count..];
    }
    Ok(builder.finish())
}
