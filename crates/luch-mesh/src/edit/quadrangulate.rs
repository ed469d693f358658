//! Pairs of triangles to quads.

use std::f64::consts::FRAC_PI_2;

use super::geometry::{angle_between, corner_place, unit_normals};
use super::{dissolve_edges, prepared};
use crate::PolygonMesh;
use crate::normals::corner_angle;
use crate::polygon_mesh::{CornerAttribute, HalfEdges};

/// Which pairs of triangles become quads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quadrangulation {
    /// The widest angle between the normals of both triangles, in radians.
    pub bend: f64,
    /// How far an angle of the quad may be from a right one, in radians.
    pub skew: f64,
}

/// Joins marked triangles in pairs, those first that give the squarest quads. Triangles are not joined across creases, between different slots
/// or groups, or where uvs, colours or normals part.
pub fn quadrangulate(mesh: &PolygonMesh, faces: &[bool], limits: &Quadrangulation) -> PolygonMesh {
    let mesh = &*prepared(mesh);
    let half_edges = HalfEdges::new(mesh);
    let normals = unit_normals(mesh);
    let mut creases: Vec<[u32; 2]> = mesh
        .creases
        .iter()
        .map(|c| [c.vertices[0].min(c.vertices[1]), c.vertices[0].max(c.vertices[1])])
        .collect();
    creases.sort_unstable();
    let is_free = |face: usize| faces.get(face).copied().unwrap_or(false) && mesh.face(face).len() == 3;
    let alike = |one: usize, other: usize| {
        mesh.slots.get(one) == mesh.slots.get(other)
            && mesh.smoothing_groups.get(one) == mesh.smoothing_groups.get(other)
    };
    // Edges by how far the worst angle of the quad is from a right one.
    let mut candidates: Vec<(f64, [u32; 2], [u32; 2])> = Vec::new();
    for (one, other) in half_edges.opposites().iter().enumerate() {
        let Some(other) = *other else { continue };
        let one = one as u32;
        let pair = [one, other].map(|half_edge| half_edges.face(half_edge) as usize);
        let [from, to] = half_edges.ends(one);
        let edge = [from.min(to), from.max(to)];
        if one > other
            || !pair.iter().all(|&face| is_free(face))
            || !alike(pair[0], pair[1])
            || angle_between(normals[pair[0]], normals[pair[1]]) > limits.bend
            || creases.binary_search(&edge).is_ok()
            || parts(mesh, &half_edges, one, other)
        {
            continue;
        }
        let apex = |half_edge: u32| half_edges.next(half_edges.next(half_edge));
        let ring = [one, apex(other), half_edges.next(one), apex(one)];
        let places = ring.map(|corner| corner_place(mesh, corner as usize));
        let angle = |i: usize| corner_angle(places[(i + 3) % 4], places[i], places[(i + 1) % 4]);
        // Angles of a convex quad add up to a full turn; a reflex one shows as too small a sum.
        let sum: f64 = (0..4).map(angle).sum();
        let convex_at_edge = [0, 2].into_iter().all(|i: usize| {
            let diagonal = places[2] - places[0];
            let (before, after) = (places[(i + 3) % 4] - places[i], places[(i + 1) % 4] - places[i]);
            let along = if i == 0 { diagonal } else { -diagonal };
            angle_between(before.normalize_or_zero(), along.normalize_or_zero())
                + angle_between(after.normalize_or_zero(), along.normalize_or_zero())
                < std::f64::consts::PI - 1e-6
        });
        let skew = (0..4).map(|i| (angle(i) - FRAC_PI_2).abs()).fold(0.0, f64::max);
        if sum.is_finite() && convex_at_edge && skew <= limits.skew {
            candidates.push((skew, edge, pair.map(|face| face as u32)));
        }
    }
    // A hair's breadth must not decide, so that neighbouring squares are joined alike.
    candidates.sort_by(|one, other| {
        let rounded = |skew: f64| (skew * 1e4).round();
        rounded(one.0).total_cmp(&rounded(other.0)).then(one.1.cmp(&other.1))
    });
    let mut is_taken = vec![false; mesh.face_count()];
    let mut edges = Vec::new();
    for (_, edge, pair) in candidates {
        if pair.iter().all(|&face| !is_taken[face as usize]) {
            pair.iter().for_each(|&face| is_taken[face as usize] = true);
            edges.push(edge);
        }
    }
    edges.sort_unstable();
    dissolve_edges(mesh, &edges)
}

/// Whether two faces have different values at an edge they share.
fn parts(mesh: &PolygonMesh, half_edges: &HalfEdges, one: u32, other: u32) -> bool {
    fn differ<T: PartialEq + Copy>(attribute: &CornerAttribute<T>, pairs: [[u32; 2]; 2]) -> bool {
        let value = |corner: u32| &attribute.values[attribute.corners[corner as usize] as usize];
        !attribute.is_empty() && pairs.iter().any(|&[one, other]| value(one) != value(other))
    }
    let pairs = [[one, half_edges.next(other)], [half_edges.next(one), other]];
    differ(&mesh.normals, pairs)
        || differ(&mesh.colors, pairs)
        || mesh.uv_sets.iter().any(|uvs| differ(uvs, pairs))
}
