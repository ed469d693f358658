//! Points by the cell they are in, for finding neighbours.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

/// Cells of one size; only those with points in them take memory.
pub(super) struct Grid {
    size: f64,
    cells: HashMap<[i64; 3], Vec<u32>>,
}

impl Grid {
    /// An empty grid; `size` must be above zero.
    pub(super) fn new(size: f64) -> Self {
        Self { size, cells: HashMap::new() }
    }

    fn cell(&self, point: Vec3) -> [i64; 3] {
        // Numbers too large for a cell of their own end in the outermost one.
        (point.as_dvec3() / self.size).floor().to_array().map(|number| number.clamp(-9e15, 9e15) as i64)
    }

    pub(super) fn add(&mut self, number: u32, point: Vec3) {
        let cell = self.cell(point);
        self.cells.entry(cell).or_default().push(number);
    }

    /// Hands the numbers of all points in the cells about a point to `visit`, in a fixed order, until it returns false. Points
    /// nearer than the size are among them.
    pub(super) fn about(&self, point: Vec3, mut visit: impl FnMut(u32) -> bool) {
        let middle = self.cell(point);
        for step in 0..27 {
            let shift = [step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1];
            let cell = [0, 1, 2].map(|axis| middle[axis] + shift[axis]);
            if !self.cells.get(&cell).is_none_or(|points| points.iter().all(|&number| visit(number))) {
                return;
            }
        }
    }
}

pub(super) fn squared_distance(one: Vec3, other: Vec3) -> f64 {
    DVec3::distance_squared(one.as_dvec3(), other.as_dvec3())
}
