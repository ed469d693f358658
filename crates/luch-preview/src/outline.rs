//! The edges of a form, and which of them are creases, borders or faulty.

use crate::subject::Mesh;
use glam::{DVec3, Vec3};
use luch_mesh::edges::{Edge, Edges};
use luch_mesh::polygon_mesh::HalfEdges;
use std::borrow::Cow;

/// Edges with the points they lead between.
#[derive(Clone, Debug, Default)]
pub(crate) struct Outline {
    /// Points of curves on exact shapes; empty for meshes, whose edges lead between their own positions.
    pub(crate) points: Vec<Vec3>,
    pub(crate) edges: Vec<OutlineEdge>,
}

/// An edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OutlineEdge {
    pub(crate) ends: [u32; 2],
    /// Two of the faces at it; [`NO_FACE`] where there is none.
    pub(crate) faces: [u32; 2],
    pub(crate) kind: EdgeKind,
    /// The cosine of the angle by which the surface bends here; 1 where that is not known.
    pub(crate) bend_cosine: f32,
}

/// No face at all.
pub(crate) const NO_FACE: u32 = u32::MAX;

/// How many faces meet at an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum EdgeKind {
    /// Two, each on its side and with one outside in common.
    Inner,
    /// One.
    Border,
    /// More than two, or two that disagree about where outside is.
    NonManifold,
}

impl Outline {
    /// Of polygons if the mesh was made of some, else of triangles.
    pub(crate) fn of_mesh(mesh: &Mesh) -> Self {
        let triangles = &*mesh.triangles;
        let positions =
            mesh.polygons.as_ref().map_or(&triangles.positions, |polygons| &polygons.mesh.positions);
        let count = positions.len() as u32;
        if count == 0 {
            return Self::default();
        }
        if let Some(polygons) = &mesh.polygons {
            let normals = face_normals(mesh, polygons.mesh.face_count());
            let half_edges = HalfEdges::new(polygons.mesh);
            let edges = half_edges.edges();
            let classed =
                edges.map(|edge| classed(&edge, |h| half_edges.ends(h), |h| half_edges.face(h), &normals));
            return Self { points: Vec::new(), edges: classed.collect() };
        }
        let is_sound = |corners: &[u32; 3]| corners.iter().all(|&corner| corner < count);
        // Triangles that name missing positions become points, which have no edges.
        let corners: Cow<[[u32; 3]]> = match triangles.triangles.iter().all(is_sound) {
            true => Cow::Borrowed(&triangles.triangles),
            false => {
                let kept = |corners: &[u32; 3]| if is_sound(corners) { *corners } else { [0; 3] };
                Cow::Owned(triangles.triangles.iter().map(kept).collect())
            }
        };
        let normals = face_normals(mesh, corners.len());
        let ends = |half_edge| luch_mesh::edges::half_edge_ends(&corners, half_edge);
        let edges = Edges::new(&corners, count as usize);
        let classed =
            edges.iter(&corners).map(|edge| classed(&edge, ends, |half_edge| half_edge / 3, &normals));
        Self { points: Vec::new(), edges: classed.collect() }
    }

    /// Adds a curve through points, each in its place: the next is joined to the one before.
    pub(crate) fn add_curve(&mut self, points: impl Iterator<Item = DVec3>, is_border: bool) {
        let kind = if is_border { EdgeKind::Border } else { EdgeKind::Inner };
        let start = self.points.len() as u32;
        self.points.extend(points.map(|point| point.as_vec3()));
        let pairs = start + 1..self.points.len() as u32;
        self.edges.extend(pairs.map(|end| OutlineEdge {
            ends: [end - 1, end],
            faces: [NO_FACE; 2],
            kind,
            bend_cosine: 1.0,
        }));
    }
}

/// Unit normal of each face, zero where it has none.
fn face_normals(mesh: &Mesh, count: usize) -> Vec<DVec3> {
    let mut normals = vec![DVec3::ZERO; count];
    for triangle in 0..mesh.triangles.triangles.len() as u32 {
        if let (Some([a, b, c]), Some(sum)) =
            (mesh.corners(triangle), normals.get_mut(mesh.face(triangle) as usize))
        {
            let [a, b, c] = [a, b, c].map(|corner| corner.as_dvec3());
            *sum += (b - a).cross(c - a);
        }
    }
    normals.iter_mut().for_each(|normal| *normal = normal.normalize_or_zero());
    normals
}

fn classed(
    edge: &Edge,
    ends: impl Fn(u32) -> [u32; 2],
    face: impl Fn(u32) -> u32,
    normals: &[DVec3],
) -> OutlineEdge {
    let normal = |half_edge| normals.get(face(half_edge) as usize).copied().unwrap_or(DVec3::ZERO);
    let (kind, faces, bend_cosine) = match *edge.half_edges {
        [one] => (EdgeKind::Border, [face(one), NO_FACE], 1.0),
        [one, other] if ends(one)[0] != ends(other)[0] => {
            let (first, second) = (normal(one), normal(other));
            let is_known = first != DVec3::ZERO && second != DVec3::ZERO;
            let cosine = if is_known { first.dot(second) as f32 } else { 1.0 };
            (EdgeKind::Inner, [face(one), face(other)], cosine)
        }
        [one, other, ..] => (EdgeKind::NonManifold, [face(one), face(other)], 1.0),
        [] => (EdgeKind::Inner, [NO_FACE; 2], 1.0),
    };
    OutlineEdge { ends: edge.vertices, faces, kind, bend_cosine }
}
