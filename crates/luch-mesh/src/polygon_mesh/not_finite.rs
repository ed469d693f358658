//! Making values harmless that are infinite or not numbers.

use glam::{Vec2, Vec3, Vec4};

use super::PolygonMesh;

impl PolygonMesh {
    /// Leaves out faces with a vertex that is not finite, replaces the rest of such values (positions and uvs by zero,
    /// colours by white), and tells which faces were kept, or `None` if all. For meshes without holes.
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

    /// Keeps the faces marked so. For meshes without holes.
    fn retain_faces(&mut self, kept: &[bool]) {
        let mut is_kept_corner = vec![false; self.corners.len()];
        for (face, _) in kept.iter().enumerate().filter(|(_, kept)| **kept) {
            is_kept_corner[self.face(face)].fill(true);
        }
        let lengths: Vec<u32> = (0..self.face_count()).map(|face| self.face(face).len() as u32).collect();
        let mut lists = vec![&mut self.corners, &mut self.normals.corners, &mut self.colors.corners];
        lists.extend(self.uv_sets.iter_mut().map(|uvs| &mut uvs.corners));
        for list in lists.into_iter().filter(|list| !list.is_empty()) {
            let mut keep = is_kept_corner.iter();
            list.retain(|_| keep.next().copied().unwrap_or(false));
        }
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

    /// Gives every normal length one; those that have no direction become the flat normal's stand-in +Z.
    pub(crate) fn normalize_normals(&mut self) {
        for normal in &mut self.normals.values {
            *normal = normal.try_normalize().unwrap_or(Vec3::Z);
        }
    }
}
