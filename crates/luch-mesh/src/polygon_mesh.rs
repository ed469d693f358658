//! Faces of any size: what editors and files have, before triangles are made of them.

mod cracks;
mod crease;
mod flip;
mod half_edges;
mod not_finite;
mod smoothing;
mod triangulate;

use std::ops::Range;

use glam::{Vec2, Vec3, Vec4};
use serde::{Deserialize, Serialize};

use crate::TriangleMesh;
pub use crease::{Crease, SharpVertex};
pub use half_edges::HalfEdges;
pub use triangulate::Triangulation;

/// Values at the corners of faces, shared through indices.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CornerAttribute<T> {
    /// The distinct values.
    pub values: Vec<T>,
    /// For each corner of [`PolygonMesh::corners`] the place of its value; empty if `values` runs parallel to the
    /// positions, or if there are no values at all.
    pub corners: Vec<u32>,
}

impl<T> Default for CornerAttribute<T> {
    fn default() -> Self {
        Self { values: Vec::new(), corners: Vec::new() }
    }
}

impl<T: Copy> CornerAttribute<T> {
    /// One value for each position.
    pub fn per_position(values: Vec<T>) -> Self {
        Self { values, corners: Vec::new() }
    }

    /// Values with corner indices of their own. Without corners there are no values either.
    pub fn indexed(values: Vec<T>, corners: Vec<u32>) -> Self {
        if corners.is_empty() { Self::default() } else { Self { values, corners } }
    }

    /// True if the mesh has no such attribute.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }
}

/// A surface made of polygons, which may be concave and may have holes.
///
/// The corners of all faces stand one after another in `corners`; within a face the outer border comes first, then its
/// holes. Borders run counter-clockwise seen from outside; which way the holes run does not matter.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PolygonMesh {
    /// Places of the vertices, in metres.
    pub positions: Vec<Vec3>,
    /// For each corner its place in `positions`.
    pub corners: Vec<u32>,
    /// For each face where its corners end in `corners`; they begin where those of the previous face end.
    pub face_ends: Vec<u32>,
    /// Where holes begin, in order; empty if there are none.
    pub holes: Vec<Hole>,
    /// Unit normals for smooth shading; none means flat.
    pub normals: CornerAttribute<Vec3>,
    /// Texture coordinates, origin at the lower left; set 0, set 1, …
    pub uv_sets: Vec<CornerAttribute<Vec2>>,
    /// Linear RGBA colours.
    pub colors: CornerAttribute<Vec4>,
    /// For each face the slot of its material; empty if there is only slot 0.
    pub slots: Vec<u16>,
    /// For each face its smoothing group, 0 for none; empty if there are no groups.
    pub smoothing_groups: Vec<u32>,
    /// Edges that subdivision keeps sharp, in no order; an edge that is named twice is as sharp as the sharper of both.
    pub creases: Vec<Crease>,
    /// Vertices that subdivision keeps sharp.
    pub sharp_vertices: Vec<SharpVertex>,
}

/// A hole in a face: its border runs from `start` to the next hole of the face or the face's end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Hole {
    /// The face.
    pub face: u32,
    /// The first corner of the hole's border.
    pub start: u32,
}

impl PolygonMesh {
    /// How many faces there are.
    pub fn face_count(&self) -> usize {
        self.face_ends.len()
    }

    /// The corners of a face, holes included.
    pub fn face(&self, face: usize) -> Range<usize> {
        let end_of = |face: usize| (self.face_ends[face] as usize).min(self.corners.len());
        let start = if face == 0 { 0 } else { end_of(face - 1) };
        start..end_of(face).max(start)
    }

    /// Adds a face without holes and returns its number.
    pub fn add_face(&mut self, corners: &[u32]) -> usize {
        self.add_face_with_holes(corners, &[])
    }

    /// Adds a face and the borders of its holes, and returns its number.
    pub fn add_face_with_holes(&mut self, corners: &[u32], holes: &[&[u32]]) -> usize {
        let face = self.face_ends.len();
        self.corners.extend_from_slice(corners);
        for hole in holes {
            self.holes.push(Hole { face: face as u32, start: self.corners.len() as u32 });
            self.corners.extend_from_slice(hole);
        }
        self.face_ends.push(self.corners.len() as u32);
        face
    }

    /// The borders of a face as ranges of `corners`: the outer one, then the holes.
    pub fn borders(&self, face: usize) -> Vec<Range<usize>> {
        let Range { start, end } = self.face(face);
        let first_hole = self.holes.partition_point(|hole| (hole.face as usize) < face);
        let holes = self.holes[first_hole..].iter().take_while(|hole| hole.face as usize == face);
        let mut cuts = vec![start];
        cuts.extend(holes.map(|hole| (hole.start as usize).clamp(start, end)));
        cuts.push(end);
        cuts.windows(2).map(|cut| cut[0]..cut[1].max(cut[0])).collect()
    }

    /// The triangles of this mesh; see [`PolygonMesh::triangulation`] for what became of each face.
    pub fn triangulate(&self) -> TriangleMesh {
        self.triangulation().mesh
    }
}

impl From<&TriangleMesh> for PolygonMesh {
    /// Every triangle a face. Tangents are left out: they can be derived.
    fn from(mesh: &TriangleMesh) -> Self {
        fn corners<T: Copy>(attribute: &crate::Attribute<T>) -> CornerAttribute<T> {
            CornerAttribute {
                values: attribute.values.clone(),
                corners: attribute.triangles.as_flattened().to_vec(),
            }
        }
        Self {
            positions: mesh.positions.clone(),
            corners: mesh.triangles.as_flattened().to_vec(),
            face_ends: (1..=mesh.triangles.len() as u32).map(|t| t * 3).collect(),
            holes: Vec::new(),
            normals: corners(&mesh.normals),
            uv_sets: mesh.uv_sets.iter().map(corners).collect(),
            colors: corners(&mesh.colors),
            slots: mesh.slots.clone(),
            smoothing_groups: Vec::new(),
            creases: Vec::new(),
            sharp_vertices: Vec::new(),
        }
    }
}
