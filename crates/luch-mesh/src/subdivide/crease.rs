//! Making edges sharp.

use glam::DVec3;

use crate::PolygonMesh;
use crate::polygon_mesh::{Crease, HalfEdges};

/// Makes every edge as sharp as given at least; zero takes all creases away. Sharpness below zero, or that is no
/// number, counts as zero.
pub fn crease_all(mesh: &mut PolygonMesh, sharpness: f32) {
    crease_where(mesh, sharpness, |_, _| true);
}

/// Makes edges sharp where two faces meet at an angle (radians, 0 where the surface goes straight on) of at least
/// `angle`; zero sharpness takes creases away there. Edges that do not have exactly two faces are sharp anyway.
pub fn crease_by_angle(mesh: &mut PolygonMesh, angle: f64, sharpness: f32) {
    let normals: Vec<Option<DVec3>> = (0..mesh.face_count()).map(|face| face_normal(mesh, face)).collect();
    let most_cosine = libm::cos(angle.clamp(0.0, std::f64::consts::PI)) + 1e-9;
    crease_where(mesh, sharpness, |half_edges, halves| match *halves {
        [one, other] => {
            let turned = half_edges.ends(one)[0] == half_edges.ends(other)[0];
            match [one, other].map(|half| normals[half_edges.face(half) as usize]) {
                [Some(a), Some(b)] => a.dot(if turned { -b } else { b }) <= most_cosine,
                _ => false,
            }
        }
        _ => false,
    });
}

fn crease_where(mesh: &mut PolygonMesh, sharpness: f32, chosen: impl Fn(&HalfEdges, &[u32]) -> bool) {
    let half_edges = HalfEdges::new(mesh);
    let edges = half_edges.edges().filter(|edge| chosen(&half_edges, edge.half_edges));
    let vertices: Vec<[u32; 2]> = edges.map(|edge| edge.vertices).collect();
    let is_chosen = |crease: &Crease| {
        let [a, b] = crease.vertices;
        vertices.binary_search(&[a.min(b), a.max(b)]).is_ok()
    };
    mesh.creases.retain(|crease| !is_chosen(crease));
    if sharpness > 0.0 {
        mesh.creases.extend(vertices.into_iter().map(|vertices| Crease { vertices, sharpness }));
    }
}

/// Newell's normal of a face; `None` without area.
fn face_normal(mesh: &PolygonMesh, face: usize) -> Option<DVec3> {
    let border = mesh.borders(face).into_iter().next()?;
    let place = |corner: usize| mesh.positions.get(mesh.corners[corner] as usize).map(|p| p.as_dvec3());
    let origin = place(border.clone().next()?)?;
    let mut sum = DVec3::ZERO;
    for corner in border.start + 1..border.end.saturating_sub(1) {
        sum += (place(corner)? - origin).cross(place(corner + 1)? - origin);
    }
    sum.try_normalize()
}
