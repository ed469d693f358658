//! The mesh as it grows.

use std::collections::HashMap;

use glam::{DVec2, DVec3, Vec2, Vec3};

use crate::{Attribute, TriangleMesh};

#[derive(Default)]
pub(super) struct Output {
    mesh: TriangleMesh,
    /// Vertices on edges by the bits of their places; looked up only, never walked.
    welded: HashMap<[u32; 3], u32>,
    uvs: Vec<Vec2>,
    normals: Vec<Vec3>,
    value_triangles: Vec<[u32; 3]>,
}

impl Output {
    /// A vertex of its own.
    pub(super) fn add_vertex(&mut self, place: DVec3) -> u32 {
        self.mesh.positions.push(place.as_vec3());
        self.mesh.positions.len() as u32 - 1
    }

    /// A vertex of an edge: the same number for the same place.
    pub(super) fn add_edge_vertex(&mut self, place: DVec3) -> u32 {
        // Adding zero makes −0 and 0 one.
        let place = place.as_vec3() + Vec3::ZERO;
        let positions = &mut self.mesh.positions;
        *self.welded.entry(place.to_array().map(f32::to_bits)).or_insert_with(|| {
            positions.push(place);
            positions.len() as u32 - 1
        })
    }

    /// A uv and a normal.
    pub(super) fn add_value(&mut self, uv: DVec2, normal: Option<DVec3>) -> u32 {
        self.uvs.push(uv.as_vec2());
        self.normals.push(normal.map_or(Vec3::Z, DVec3::as_vec3));
        self.uvs.len() as u32 - 1
    }

    /// A triangle, unless two of its corners are one.
    pub(super) fn add_triangle(&mut self, vertices: [u32; 3], values: [u32; 3]) {
        let [a, b, c] = vertices;
        if a != b && b != c && c != a {
            self.mesh.triangles.push(vertices);
            self.value_triangles.push(values);
        }
    }

    pub(super) fn into_mesh(mut self) -> TriangleMesh {
        self.mesh.normals = Attribute::indexed(self.normals, self.value_triangles.clone());
        self.mesh.uv_sets = vec![Attribute::indexed(self.uvs, self.value_triangles)];
        crate::clean::remove_unused_positions(&self.mesh).mesh
    }
}
