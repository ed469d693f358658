//! Normals from smoothing groups.

use glam::{DVec3, Vec3};

use super::{CornerAttribute, PolygonMesh};
use crate::normals::{Weight, corner_angle, unit_or_z};

impl PolygonMesh {
    /// One normal for each corner, shared by the faces of a position that are in the same smoothing group; faces in no
    /// group (0) are flat. Weighted as `weight` says; faces without area count nothing. All indices must be in
    /// range.
    pub fn normals_of_smoothing_groups(&self, weight: Weight) -> CornerAttribute<Vec3> {
        struct Part {
            /// Position and group; a face in no group is alone.
            key: [u32; 3],
            corner: u32,
            part: DVec3,
        }
        let mut parts = Vec::with_capacity(self.corners.len());
        for face in 0..self.face_count() {
            let group = self.smoothing_groups.get(face).copied().unwrap_or(0);
            let borders = self.borders(face);
            let outer: Vec<u32> = borders[0].clone().map(|corner| corner as u32).collect();
            let area_normal = self.newell_normal(&outer);
            for border in borders {
                for corner in border.clone() {
                    let at = |corner: usize| self.positions[self.corners[corner] as usize].as_dvec3();
                    let previous = if corner == border.start { border.end - 1 } else { corner - 1 };
                    let next = if corner + 1 == border.end { border.start } else { corner + 1 };
                    let part = match weight {
                        Weight::Area => area_normal,
                        Weight::Angle => {
                            let angle = corner_angle(at(previous), at(corner), at(next));
                            area_normal.try_normalize().unwrap_or(DVec3::ZERO) * angle
                        }
                    };
                    let alone = if group == 0 { face as u32 } else { 0 };
                    let position = if group == 0 { 0 } else { self.corners[corner] };
                    parts.push(Part { key: [group, position, alone], corner: corner as u32, part });
                }
            }
        }
        // Sum over equal keys; the sort is stable, so sums run in the order of the corners.
        parts.sort_by_key(|part| part.key);
        let mut normals = CornerAttribute { values: Vec::new(), corners: vec![0; self.corners.len()] };
        for shared in parts.chunk_by(|one, other| one.key == other.key) {
            let number = normals.values.len() as u32;
            normals.values.push(unit_or_z(shared.iter().map(|part| part.part).sum()));
            for part in shared {
                normals.corners[part.corner as usize] = number;
            }
        }
        normals
    }
}
