//! On which side of a closed surface a point is: angle-weighted pseudonormals.

use glam::DVec3;

use super::Nearest;
use crate::TriangleMesh;
use crate::codec::welding::Welder;
use crate::edges::Edges;
use crate::measure::closedness;
use crate::normals::corner_angle;

/// Sums of unit normals: of the two triangles at each edge, of all triangles at each corner by their angle.
pub(super) struct Pseudonormals {
    /// For each half-edge.
    edges: Vec<[DVec3; 3]>,
    /// For each triangle and corner the place in `vertices`.
    corners: Vec<[u32; 3]>,
    vertices: Vec<DVec3>,
}

impl Pseudonormals {
    /// `None` if the mesh is not sound or not closed: then a side means nothing.
    pub(super) fn new(mesh: &TriangleMesh) -> Option<Self> {
        let is_sound = |t: usize| super::sound_corners(mesh, t).is_some();
        if !(0..mesh.triangles.len()).all(is_sound) {
            return None;
        }
        let mut welder = Welder::default();
        let mut corners = Vec::with_capacity(mesh.triangles.len());
        for t in 0..mesh.triangles.len() {
            corners.push(mesh.corners(t).map(|corner| welder.number(corner)));
        }
        let welded = TriangleMesh::new(welder.positions, corners);
        if !closedness(&welded).is_closed() {
            return None;
        }
        let TriangleMesh { positions, triangles: corners, .. } = welded;
        let normal = |t: usize| {
            let [a, b, c] = corners[t].map(|i| positions[i as usize].as_dvec3());
            (b - a).cross(c - a).try_normalize().unwrap_or(DVec3::ZERO)
        };
        let mut vertices = vec![DVec3::ZERO; positions.len()];
        for (t, indices) in corners.iter().enumerate() {
            let at = indices.map(|i| positions[i as usize].as_dvec3());
            for k in 0..3 {
                let angle = corner_angle(at[(k + 2) % 3], at[k], at[(k + 1) % 3]);
                vertices[indices[k] as usize] += normal(t) * angle;
            }
        }
        let mut edges = vec![[DVec3::ZERO; 3]; corners.len()];
        let sorted = Edges::new(&corners, positions.len());
        for edge in sorted.iter(&corners) {
            let sum: DVec3 = edge.half_edges.iter().map(|half_edge| normal(*half_edge as usize / 3)).sum();
            for half_edge in edge.half_edges {
                edges[*half_edge as usize / 3][*half_edge as usize % 3] = sum;
            }
        }
        Some(Self { edges, corners, vertices })
    }

    /// A vector whose half-space tells outside from inside at a point of the surface.
    pub(super) fn at(&self, mesh: &TriangleMesh, place: &Nearest) -> DVec3 {
        let triangle = place.triangle as usize;
        let is_there = place.weights.map(|weight| weight > 0.0);
        if let Some(k) = (0..3).find(|&k| is_there == [k == 0, k == 1, k == 2]) {
            return self.vertices[self.corners[triangle][k] as usize];
        }
        // The edge from corner k lies across from corner k + 2.
        if let Some(k) = (0..3).find(|&k| !is_there[(k + 2) % 3]) {
            return self.edges[triangle][k];
        }
        let [a, b, c] = mesh.corners(triangle).map(|corner| corner.as_dvec3());
        (b - a).cross(c - a)
    }
}
