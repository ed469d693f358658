//! The one mesh type: positions, normals and uvs in lists of their own, triangles that index into them.

use glam::{Vec2, Vec3, Vec4};
use serde::{Deserialize, Serialize};

/// Values at the corners of triangles, shared through indices (the lecture's `n[3]` and `t[3]`).
///
/// A hard edge or a seam gives one position two values here without splitting the position, so a closed mesh stays closed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Attribute<T> {
    /// The distinct values.
    pub values: Vec<T>,
    /// For each triangle the places of its three corners in `values`; empty if `values` runs parallel to the positions
    /// (corner indices are then those of [`TriangleMesh::triangles`]), or if there are no values at all.
    pub triangles: Vec<[u32; 3]>,
}

impl<T> Default for Attribute<T> {
    fn default() -> Self {
        Self { values: Vec::new(), triangles: Vec::new() }
    }
}

impl<T: Copy> Attribute<T> {
    /// One value for each position.
    pub fn per_position(values: Vec<T>) -> Self {
        Self { values, triangles: Vec::new() }
    }

    /// Values with corner indices of their own. Without triangles there are no values either.
    pub fn indexed(values: Vec<T>, triangles: Vec<[u32; 3]>) -> Self {
        if triangles.is_empty() { Self::default() } else { Self { values, triangles } }
    }

    /// True if the mesh has no such attribute.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// The values at the corners of triangle `triangle`, whose position indices are `positions`; `None` if there are none.
    #[inline]
    pub fn corners(&self, triangle: usize, positions: [u32; 3]) -> Option<[T; 3]> {
        if self.values.is_empty() {
            return None;
        }
        let indices = if self.triangles.is_empty() { positions } else { self.triangles[triangle] };
        Some(indices.map(|i| self.values[i as usize]))
    }

    /// The index set in force: its own, or else that of the positions.
    pub fn corner_indices<'a>(&'a self, positions: &'a [[u32; 3]]) -> &'a [[u32; 3]] {
        if self.triangles.is_empty() { positions } else { &self.triangles }
    }
}

/// A surface made of triangles. Counter-clockwise corners face outward.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TriangleMesh {
    /// Places of the vertices, in metres.
    pub positions: Vec<Vec3>,
    /// For each triangle its corners in `positions`, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Unit normals for smooth shading; none means flat.
    pub normals: Attribute<Vec3>,
    /// Texture coordinates, origin at the lower left; set 0, set 1, …
    pub uv_sets: Vec<Attribute<Vec2>>,
    /// Unit tangents along increasing u, with the sign of the bitangent in w; none means they are derived from set 0.
    pub tangents: Attribute<Vec4>,
    /// Linear RGBA colours.
    pub colors: Attribute<Vec4>,
    /// For each triangle the slot of its material; empty if there is only slot 0.
    pub slots: Vec<u16>,
}

impl TriangleMesh {
    /// A mesh of bare triangles.
    pub fn new(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Self {
        Self { positions, triangles, ..Self::default() }
    }

    /// The three corners of a triangle.
    #[inline]
    pub fn corners(&self, triangle: usize) -> [Vec3; 3] {
        self.triangles[triangle].map(|i| self.positions[i as usize])
    }

    /// The three shading normals of a triangle, if the mesh has normals.
    #[inline]
    pub fn corner_normals(&self, triangle: usize) -> Option<[Vec3; 3]> {
        self.normals.corners(triangle, self.triangles[triangle])
    }

    /// The three texture coordinates of a triangle in uv set `set`, if the mesh has that set.
    #[inline]
    pub fn corner_uvs(&self, triangle: usize, set: usize) -> Option<[Vec2; 3]> {
        self.uv_sets.get(set)?.corners(triangle, self.triangles[triangle])
    }

    /// The smallest box around all triangles; see [`crate::measure::bounds`].
    pub fn bounds(&self) -> luch_bvh::Aabb {
        crate::measure::bounds(self)
    }

    /// The material slot of a triangle.
    pub fn slot(&self, triangle: usize) -> u16 {
        self.slots.get(triangle).copied().unwrap_or(0)
    }

    /// Twice the area times the unit normal of a triangle: (B − A) × (C − A).
    #[inline]
    pub fn area_normal(&self, triangle: usize) -> Vec3 {
        let [a, b, c] = self.corners(triangle);
        (b - a).cross(c - a)
    }
}
