//! What shared lists of vertices, normals and uvs save.

use glam::{Vec2, Vec3, Vec4};

use crate::TriangleMesh;

/// Memory of a mesh as it is and as a plain list of triangles that own their corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MemoryStatistics {
    /// Bytes of the shared lists together with all indices.
    pub shared_bytes: usize,
    /// Bytes if each triangle had its own three positions, normals, uvs, … and no indices.
    pub unshared_bytes: usize,
}

impl MemoryStatistics {
    /// How many times smaller the shared form is; 1 for an empty mesh.
    pub fn saving(&self) -> f64 {
        if self.shared_bytes == 0 { 1.0 } else { self.unshared_bytes as f64 / self.shared_bytes as f64 }
    }
}

impl TriangleMesh {
    /// Compares the memory of this mesh with that of the same mesh without sharing.
    pub fn memory(&self) -> MemoryStatistics {
        let triangle_count = self.triangles.len();
        let list = |values: usize, indices: usize, size: usize| MemoryStatistics {
            shared_bytes: values * size + indices * size_of::<[u32; 3]>(),
            unshared_bytes: if values == 0 { 0 } else { triangle_count * 3 * size },
        };
        let mut lists = vec![
            list(self.positions.len(), triangle_count, size_of::<Vec3>()),
            list(self.normals.values.len(), self.normals.triangles.len(), size_of::<Vec3>()),
            list(self.tangents.values.len(), self.tangents.triangles.len(), size_of::<Vec4>()),
            list(self.colors.values.len(), self.colors.triangles.len(), size_of::<Vec4>()),
        ];
        let uvs = self.uv_sets.iter();
        lists.extend(uvs.map(|uvs| list(uvs.values.len(), uvs.triangles.len(), size_of::<Vec2>())));
        let slot_bytes = self.slots.len() * size_of::<u16>();
        MemoryStatistics {
            shared_bytes: lists.iter().map(|l| l.shared_bytes).sum::<usize>() + slot_bytes,
            unshared_bytes: lists.iter().map(|l| l.unshared_bytes).sum::<usize>() + slot_bytes,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate;

    #[test]
    fn a_bare_cube_by_hand() {
        let mut mesh = generate::cuboid(Vec3::ONE, [1, 1, 1]);
        (mesh.normals, mesh.uv_sets) = Default::default();
        // 8 positions of 12 bytes and 12 triangles of 12 bytes; against 36 positions.
        assert_eq!(mesh.memory(), MemoryStatistics { shared_bytes: 96 + 144, unshared_bytes: 432 });
        assert!((mesh.memory().saving() - 1.8).abs() < 1e-12);
    }
}
