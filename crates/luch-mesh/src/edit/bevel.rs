//! Edges and corners cut off by narrow faces.

mod edges;
mod vertices;

use glam::DVec3;

use super::builder::NewCorner;
use super::geometry::corner_place;
use super::raise::split_along;
use crate::PolygonMesh;
use crate::polygon_mesh::HalfEdges;
pub use edges::bevel_edges;
pub use vertices::bevel_vertices;

/// A bevelled mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Beveled {
    /// The mesh.
    pub mesh: PolygonMesh,
    /// The width that was used: less than was asked for if faces would have turned round.
    pub width: f64,
}

/// A prepared mesh with what is needed to walk around its vertices.
struct Surroundings<'a> {
    mesh: &'a PolygonMesh,
    half_edges: HalfEdges,
    opposites: Vec<Option<u32>>,
    previous: Vec<u32>,
}

impl<'a> Surroundings<'a> {
    fn new(mesh: &'a PolygonMesh) -> Self {
        let half_edges = HalfEdges::new(mesh);
        let opposites = half_edges.opposites();
        let previous = super::geometry::previous_corners(&half_edges, mesh.corners.len());
        Self { mesh, half_edges, opposites, previous }
    }

    fn place(&self, corner: u32) -> DVec3 {
        corner_place(self.mesh, corner as usize)
    }

    fn vertex(&self, corner: u32) -> u32 {
        self.mesh.corners[corner as usize]
    }

    fn next(&self, corner: u32) -> u32 {
        self.half_edges.next(corner)
    }

    /// The corner at the same vertex in the next face counter-clockwise; `None` at a border.
    fn counter_clockwise(&self, corner: u32) -> Option<u32> {
        self.opposites[self.previous[corner as usize] as usize]
    }

    /// The corner at the same vertex in the next face clockwise; `None` at a border.
    fn clockwise(&self, corner: u32) -> Option<u32> {
        self.opposites[corner as usize].map(|other| self.next(other))
    }

    /// The unit vector along the edge that leaves a corner.
    fn outgoing(&self, corner: u32) -> DVec3 {
        (self.place(self.next(corner)) - self.place(corner)).normalize_or_zero()
    }

    /// The unit vector back along the edge that comes to a corner.
    fn incoming(&self, corner: u32) -> DVec3 {
        (self.place(self.previous[corner as usize]) - self.place(corner)).normalize_or_zero()
    }

    /// The corners around a vertex, counter-clockwise: from a border if there is one, else from the given corner on.
    fn around(&self, corner: u32) -> Around {
        let mut first = corner;
        let mut is_closed = true;
        loop {
            match self.clockwise(first) {
                None => {
                    is_closed = false;
                    break;
                }
                Some(other) if other == corner => break,
                Some(other) => first = other,
            }
        }
        let first = if is_closed { corner } else { first };
        let mut corners = vec![first];
        let mut last = first;
        while let Some(other) = self.counter_clockwise(last).filter(|&other| other != first) {
            corners.push(other);
            last = other;
        }
        Around { corners, is_closed }
    }

    /// A vertex near a corner, in the plane of its face: with the values of the place.
    fn near(&self, corner: u32, vertex: u32, way: DVec3) -> NewCorner {
        let (before, after) = (self.previous[corner as usize], self.next(corner));
        let here = self.place(corner);
        let parts = split_along(way, self.place(after) - here, self.place(before) - here);
        let Some([forward, backward]) = parts else { return NewCorner::like(vertex, corner) };
        let rest = 1.0 - forward - backward;
        NewCorner::mixed(vertex, vec![(corner, rest), (after, forward), (before, backward)])
    }
}

/// Corners around a vertex, counter-clockwise.
struct Around {
    corners: Vec<u32>,
    /// Whether the last is beside the first.
    is_closed: bool,
}
