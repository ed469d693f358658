//! Cutting surfaces apart where they are no manifolds.

use glam::DVec3;

use super::{Repaired, faces, sound};
use crate::PolygonMesh;
use crate::polygon_mesh::HalfEdges;
use crate::sets::DisjointSets;

/// Parts faces at edges of more than two and at vertices where fans touch in a point only.
///
/// Around an edge of several bodies each face stays joined to the one across its own body, so closed bodies that touch
/// stay closed; what has no such partner gets a border. Neighbours that run along their edge in the same direction are
/// parted: see [`super::orient`]. The count is that of new vertices.
pub fn make_manifold(mesh: &PolygonMesh) -> Repaired {
    let mut mesh = sound(mesh).mesh;
    let half_edges = HalfEdges::new(&mesh);
    let mut fans = DisjointSets::new(mesh.corners.len());
    for edge in half_edges.edges() {
        for [one, other] in partners(&mesh, &half_edges, edge.half_edges) {
            // The start of one half-edge is the end of the other.
            fans.join(one, half_edges.next(other));
            fans.join(half_edges.next(one), other);
        }
    }
    faces::detach(&mut mesh);
    let mut is_taken = vec![false; mesh.positions.len()];
    let mut vertex_of: Vec<u32> = vec![0; mesh.corners.len()];
    let mut count = 0;
    for corner in 0..mesh.corners.len() as u32 {
        let fan = fans.root(corner);
        // The root is the lowest corner, so it comes first.
        if fan == corner {
            let vertex = mesh.corners[corner as usize];
            vertex_of[corner as usize] = if std::mem::replace(&mut is_taken[vertex as usize], true) {
                count += 1;
                mesh.positions.push(mesh.positions[vertex as usize]);
                mesh.positions.len() as u32 - 1
            } else {
                vertex
            };
        }
        vertex_of[corner as usize] = vertex_of[fan as usize];
    }
    mesh.corners = vertex_of;
    Repaired { mesh, count }
}

/// Which half-edges of an edge stay joined.
fn partners(mesh: &PolygonMesh, half_edges: &HalfEdges, halves: &[u32]) -> Vec<[u32; 2]> {
    let runs_up = |half: u32| half_edges.ends(half)[0] < half_edges.ends(half)[1];
    match *halves {
        [_] => Vec::new(),
        [one, other] if runs_up(one) != runs_up(other) => vec![[one, other]],
        [_, _] => Vec::new(),
        _ => {
            let [a, b] = half_edges.ends(halves[0]).map(|v| mesh.positions[v as usize].as_dvec3());
            let axis = if runs_up(halves[0]) { b - a } else { a - b };
            let Some(axis) = axis.try_normalize() else { return Vec::new() };
            let (x, y) = axis.any_orthonormal_pair();
            // Around the axis, by the direction in which each face lies.
            let angle = |half: u32| {
                let normal = faces::doubled_area_normal(mesh, half_edges.face(half) as usize);
                let along = if runs_up(half) { axis } else { -axis };
                let inward: DVec3 = normal.cross(along);
                libm::atan2(inward.dot(y), inward.dot(x))
            };
            let mut around: Vec<(f64, u32)> = halves.iter().map(|&half| (angle(half), half)).collect();
            around.sort_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
            // Outside lies counter-clockwise of a face that runs up, so its body ends at the one before.
            let count = around.len();
            let pairs = (0..count).map(|i| [around[i].1, around[(i + count - 1) % count].1]);
            pairs.filter(|[one, other]| runs_up(*one) && !runs_up(*other)).collect()
        }
    }
}
