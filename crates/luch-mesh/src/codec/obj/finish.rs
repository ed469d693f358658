//! What can only be done when the whole file is known: references ahead, missing uvs and normals.

use glam::{Vec2, Vec4};

use super::ObjFile;
use super::read::{LISTS, NONE, Reader, Reference, close_last};
use crate::codec::error::{DecodeError, ErrorKind, Place};
use crate::normals::Weight;
use crate::polygon_mesh::CornerAttribute;

impl Reader {
    pub(super) fn finish(mut self) -> Result<ObjFile, DecodeError> {
        self.check_references()?;
        self.check_tags();
        let faces = self.file.mesh.face_ends.len() as u32;
        close_last(&mut self.file.objects, faces);
        close_last(&mut self.file.groups, faces);
        if !self.colors.is_empty() {
            self.colors.resize(self.file.mesh.positions.len(), Vec4::ONE);
            self.file.mesh.colors = CornerAttribute::per_position(std::mem::take(&mut self.colors));
        }
        if self.file.materials.len() <= 1 {
            self.file.mesh.slots.clear();
        }
        let mesh = &mut self.file.mesh;
        let (uvs, uv_corners) = (std::mem::take(&mut self.uvs), std::mem::take(&mut self.uv_corners));
        if uv_corners.iter().any(|&corner| corner != NONE) {
            mesh.uv_sets = vec![CornerAttribute::indexed(uvs, uv_corners)];
        }
        let (normals, normal_corners) =
            (std::mem::take(&mut self.normals), std::mem::take(&mut self.normal_corners));
        mesh.normals = CornerAttribute::indexed(normals, normal_corners);
        if self.any_smoothing {
            mesh.smoothing_groups = std::mem::take(&mut self.groups);
        }
        self.complete_uvs();
        self.complete_normals();
        let mesh = &mut self.file.mesh;
        if let Some(uvs) = mesh.uv_sets.first_mut() {
            run_parallel(uvs, &mesh.corners, mesh.positions.len());
        }
        run_parallel(&mut mesh.normals, &mesh.corners, mesh.positions.len());
        std::mem::take(&mut self.extras).finish(mesh);
        self.drop_not_finite();
        if self.file.mesh.face_ends.is_empty() {
            self.warnings.add(None, "the file has no faces");
        }
        self.file.warnings = self.warnings.into_list();
        Ok(self.file)
    }

    fn check_references(&mut self) -> Result<(), DecodeError> {
        let counts = [self.file.mesh.positions.len(), self.uvs.len(), self.normals.len()];
        for list in 0..3 {
            let Some(Reference { index, place, text }) = self.furthest[list].take() else { continue };
            if (index as usize) < counts[list] {
                continue;
            }
            if list == 0 {
                let expected = format!("a vertex from 1 to {}", counts[0]);
                return Err(DecodeError::new(ErrorKind::IndexOutOfRange, place, text, expected));
            }
            let corners = if list == 1 { &mut self.uv_corners } else { &mut self.normal_corners };
            for corner in corners.iter_mut().filter(|corner| **corner as usize >= counts[list]) {
                *corner = NONE;
            }
            let Place::Text { line, .. } = place else { continue };
            let message = format!(
                "{text} refers to number {} of {} {}: corners like it are treated as having none",
                u64::from(index) + 1,
                counts[list],
                LISTS[list]
            );
            self.warnings.add(Some(line), &message);
        }
        Ok(())
    }

    /// Leaves out faces with a vertex that is not finite.
    fn drop_not_finite(&mut self) {
        let Some(kept) = self.file.mesh.drop_not_finite() else { return };
        let mut kept_before = vec![0];
        let mut count = 0;
        kept_before.extend(kept.iter().map(|&kept| {
            count += u32::from(kept);
            count
        }));
        for named in self.file.objects.iter_mut().chain(&mut self.file.groups) {
            named.faces = kept_before[named.faces.start as usize]..kept_before[named.faces.end as usize];
        }
        let dropped = kept.len() - count as usize;
        if dropped > 0 {
            let message = format!("{dropped} faces with a vertex that is not finite are left out");
            self.warnings.add(None, &message);
        }
    }

    /// Corners without uv get (0, 0); no set if none has any.
    fn complete_uvs(&mut self) {
        let Some(CornerAttribute { mut values, mut corners }) = self.file.mesh.uv_sets.pop() else { return };
        let missing = values.len() as u32;
        for corner in corners.iter_mut().filter(|corner| **corner == NONE) {
            *corner = missing;
            if values.len() == missing as usize {
                values.push(Vec2::ZERO);
                self.warnings.add(None, "some faces have no texture coordinates: they are taken as 0 0");
            }
        }
        self.file.mesh.uv_sets.push(CornerAttribute::indexed(values, corners));
    }

    /// Corners without normal, or with one of no length, get that of their smoothing group.
    fn complete_normals(&mut self) {
        let mesh = &mut self.file.mesh;
        let CornerAttribute { mut values, mut corners } = std::mem::take(&mut mesh.normals);
        let has_length: Vec<bool> = values.iter().map(|n| n.try_normalize().is_some()).collect();
        for corner in corners.iter_mut().filter(|corner| has_length.get(**corner as usize) == Some(&false)) {
            *corner = NONE;
            self.warnings.add(None, "normals without length are computed anew");
        }
        let is_given = corners.iter().any(|&corner| corner != NONE);
        if !is_given && (!self.any_smoothing || self.extras.is_plain) {
            return;
        }
        if corners.contains(&NONE) {
            let computed = mesh.normals_of_smoothing_groups(Weight::Angle);
            if !is_given {
                values.clear();
            }
            let shift = values.len() as u32;
            for (corner, other) in corners.iter_mut().zip(&computed.corners) {
                if *corner == NONE {
                    *corner = other + shift;
                }
            }
            values.extend(computed.values);
        }
        mesh.normals = CornerAttribute::indexed(values, corners);
        mesh.normalize_normals();
    }
}

/// An index set that says what the positions say is no index set.
fn run_parallel<T>(attribute: &mut CornerAttribute<T>, corners: &[u32], positions: usize) {
    if attribute.values.len() == positions && attribute.corners == corners {
        attribute.corners = Vec::new();
    }
}
