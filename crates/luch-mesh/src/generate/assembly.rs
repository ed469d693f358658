//! Faces put together by place: what lies at one place is one position, whichever face brings it.

use std::collections::HashMap;

use glam::{DVec3, Vec2, Vec3};

use crate::PolygonMesh;

/// A corner of a face to be added.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// The place.
    pub position: DVec3,
    /// The unit normal.
    pub normal: DVec3,
    /// The texture coordinate.
    pub uv: Vec2,
}

/// Collects faces. Numbers are given in the order in which values are met.
#[derive(Default)]
pub(super) struct Assembly {
    mesh: PolygonMesh,
    positions: HashMap<[u32; 3], u32>,
    normals: HashMap<[u32; 3], u32>,
    uvs: HashMap<[u32; 2], u32>,
    uv_values: Vec<Vec2>,
}

impl Assembly {
    /// Adds a face. Corners that fall on the one before are left out; what has fewer than three then is no face.
    pub(super) fn face(&mut self, corners: &[Corner]) {
        let mut places: Vec<(u32, &Corner)> = Vec::with_capacity(corners.len());
        for corner in corners {
            let position = self.position(corner.position.as_vec3());
            if places.last().is_none_or(|last| last.0 != position) {
                places.push((position, corner));
            }
        }
        while places.len() > 1 && places[0].0 == places[places.len() - 1].0 {
            places.pop();
        }
        if places.len() < 3 {
            return;
        }
        for (position, corner) in places {
            self.mesh.corners.push(position);
            let normal = corner.normal.as_vec3() + Vec3::ZERO;
            let count = self.mesh.normals.values.len() as u32;
            let number = *self.normals.entry(normal.to_array().map(f32::to_bits)).or_insert(count);
            if number == count {
                self.mesh.normals.values.push(normal);
            }
            self.mesh.normals.corners.push(number);
            let uv = corner.uv + Vec2::ZERO;
            let count = self.uv_values.len() as u32;
            let number = *self.uvs.entry(uv.to_array().map(f32::to_bits)).or_insert(count);
            if number == count {
                self.uv_values.push(uv);
            }
            self.uv_corners().push(number);
        }
        self.mesh.face_ends.push(self.mesh.corners.len() as u32);
    }

    /// What follows shares no position with what was added so far, even where both touch.
    pub(super) fn begin_piece(&mut self) {
        self.positions.clear();
    }

    /// A face with one normal.
    pub(super) fn flat_face(&mut self, points: &[DVec3], uvs: &[Vec2], normal: DVec3) {
        let corners: Vec<Corner> =
            points.iter().zip(uvs).map(|(&position, &uv)| Corner { position, normal, uv }).collect();
        self.face(&corners);
    }

    /// The mesh of all faces.
    pub(super) fn finish(mut self) -> PolygonMesh {
        let values = std::mem::take(&mut self.uv_values);
        self.uv_corners();
        self.mesh.uv_sets[0].values = values;
        self.mesh
    }

    fn uv_corners(&mut self) -> &mut Vec<u32> {
        if self.mesh.uv_sets.is_empty() {
            self.mesh.uv_sets.push(Default::default());
        }
        &mut self.mesh.uv_sets[0].corners
    }

    fn position(&mut self, place: Vec3) -> u32 {
        // Adding zero makes a negative zero positive: both are one place.
        let place = place + Vec3::ZERO;
        let count = self.mesh.positions.len() as u32;
        let number = *self.positions.entry(place.to_array().map(f32::to_bits)).or_insert(count);
        if number == count {
            self.mesh.positions.push(place);
        }
        number
    }
}
