//! Making values harmless that are infinite or not numbers.

use glam::{Vec2, Vec3, Vec4};

use super::{CornerAttribute, Hole, PolygonMesh};

impl PolygonMesh {
    /// Leaves out faces with a vertex that is not finite, replaces the rest of such values (positions and uvs by zero,
    /// colours by white), and tells which faces were kept, or `None` if all.
    pub(crate) fn drop_not_finite(&mut self) -> Option<Vec<bool>> {
        for uvs in &mut self.uv_sets {
            uvs.values.iter_mut().filter(|uv| !uv.is_finite()).for_each(|uv| *uv = Vec2::ZERO);
        }
        self.colors.values.iter_mut().filter(|c| !c.is_finite()).for_each(|c| *c = Vec4::ONE);
        if self.positions.iter().all(|p| p.is_finite()) {
            return None;
        }
        let is_finite: Vec<bool> = self.positions.iter().map(|p| p.is_finite()).collect();
        let is_kept =
            |mesh: &Self, face| mesh.corners[mesh.face(face)].iter().all(|&i| is_finite[i as usize]);
        let kept: Vec<bool> = (0..self.face_count()).map(|face| is_kept(self, face)).collect();
        self.retain_faces(&kept);
        self.positions.iter_mut().filter(|p| !p.is_finite()).for_each(|p| *p = Vec3::ZERO);
        Some(kept)
    }

    /// Keeps the faces marked so.
    fn retain_faces(&mut self, kept: &[bool]) {
        let mut is_kept_corner = vec![false; self.corners.len()];
        for (face, _) in kept.iter().enumerate().filter(|(_, kept)| **kept) {
            is_kept_corner[self.face(face)].fill(true);
        }
        let mut kept_before = (0u32, 0u32, 0usize);
        self.holes.retain_mut(|hole| {
            // Faces and corners that are kept before the hole; holes stand in order.
            let (faces, corners, face) = &mut kept_before;
            while *face < hole.face as usize {
                if kept.get(*face) == Some(&true) {
                    *faces += 1;
                    *corners += self.face_ends[*face] - face.checked_sub(1).map_or(0, |f| self.face_ends[f]);
                }
                *face += 1;
            }
            let start_of_face = face.checked_sub(1).map_or(0, |f| self.face_ends[f]);
            let is_kept = kept.get(*face) == Some(&true);
            *hole = Hole { face: *faces, start: hole.start - start_of_face + *corners };
            is_kept
        });
        let lengths: Vec<u32> = (0..self.face_count()).map(|face| self.face(face).len() as u32).collect();
        retain_attribute(&mut self.normals, &is_kept_corner);
        retain_attribute(&mut self.colors, &is_kept_corner);
        self.uv_sets.iter_mut().for_each(|uvs| retain_attribute(uvs, &is_kept_corner));
        let mut keep = is_kept_corner.iter();
        self.corners.retain(|_| keep.next().copied().unwrap_or(false));
        let mut end = 0;
        let ends = lengths.iter().zip(kept).filter(|(_, kept)| **kept).map(|(length, _)| {
            end += length;
            end
        });
        self.face_ends = ends.collect();
        let mut keep = kept.iter();
        self.smoothing_groups.retain(|_| keep.next().copied().unwrap_or(false));
        let mut keep = kept.iter();
        self.slots.retain(|_| keep.next().copied().unwrap_or(false));
    }

    /// Gives every normal length one; those that have no direction become the flat normal's stand-in +Z. Normals whose
    /// length is one but for rounding stay as they are, so that files come back bit for bit.
    pub(crate) fn normalize_normals(&mut self) {
        // The squared length of a rounded unit vector is within a few units in the last place of one.
        let is_unit = |normal: &Vec3| (normal.length_squared() - 1.0).abs() <= 8.0 * f32::EPSILON;
        for normal in self.normals.values.iter_mut().filter(|normal| !is_unit(normal)) {
            *normal = normal.try_normalize().unwrap_or(Vec3::Z);
        }
    }
}

/// Keeps the corners marked so; values that are left without any corner go.
fn retain_attribute<T>(attribute: &mut CornerAttribute<T>, kept: &[bool]) {
    if !attribute.corners.is_empty() {
        let mut keep = kept.iter();
        attribute.corners.retain(|_| keep.next().copied().unwrap_or(false));
        if attribute.corners.is_empty() {
            attribute.values.clear();
        }
    }
}
