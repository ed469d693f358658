//! Inside out.

use super::PolygonMesh;
use std::ops::Range;

impl PolygonMesh {
    /// Turns all faces round and all normals with them.
    pub fn flip(&mut self) {
        let mut borders: Vec<Range<usize>> = Vec::with_capacity(self.face_count());
        for face in 0..self.face_count() {
            borders.extend(self.borders(face));
        }
        fn turn(indices: &mut [u32], borders: &[Range<usize>]) {
            for border in borders {
                // The first corner stays first.
                if let Some(border) = indices.get_mut(border.clone()).and_then(|border| border.get_mut(1..)) {
                    border.reverse();
                }
            }
        }
        turn(&mut self.corners, &borders);
        turn(&mut self.normals.corners, &borders);
        turn(&mut self.colors.corners, &borders);
        for uvs in &mut self.uv_sets {
            turn(&mut uvs.corners, &borders);
        }
        for normal in &mut self.normals.values {
            *normal = -*normal;
        }
    }
}
