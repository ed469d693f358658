//! Height fields: every cell is two triangles, which are those of the sheet that the workshop makes of the field. Lowest and highest
//! heights of ever larger squares of cells lead rays past what they cannot meet, as in Tevs, Ihrke, Seidel, "Maximum mipmaps for
//! fast, accurate, and scalable dynamic height field rendering" (2008), here with both bounds.

use crate::place::blend;
use glam::{Vec2, Vec3};
use luch_bvh::triangle::ShearedRay;
use luch_bvh::{Aabb, Ray, SlabRay, Traced, TracedHit, Triangle};
use luch_mesh::height_map::HeightField;
use std::sync::Arc;

/// The ray test of a height field.
#[derive(Debug)]
pub(super) struct Tracer {
    field: Arc<HeightField>,
    /// Squares of 2 × 2 cells, of 4 × 4, …, until one holds all.
    levels: Vec<Level>,
}

/// Squares of one size, row by row.
#[derive(Debug)]
struct Level {
    columns: u32,
    rows: u32,
    ranges: Vec<Range>,
}

/// Lowest and highest height; the lowest is above the highest where there are only holes.
#[derive(Clone, Copy, Debug)]
struct Range {
    low: f32,
    high: f32,
}

impl Range {
    const NOTHING: Self = Self { low: f32::INFINITY, high: f32::NEG_INFINITY };

    fn with(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }
}

/// A square of cells on the way of a ray. Level 0 is a single cell.
#[derive(Clone, Copy)]
struct Square {
    level: usize,
    column: u32,
    row: u32,
    /// Where the ray enters its box.
    near: f32,
}

impl Tracer {
    pub(super) fn new(field: Arc<HeightField>) -> Self {
        let mut levels: Vec<Level> = Vec::new();
        let (mut columns, mut rows) = (field.width.saturating_sub(1), field.height.saturating_sub(1));
        while columns > 1 || rows > 1 {
            let finer = levels.last();
            let range = |column: u32, row: u32| match finer {
                None => cell_range(&field, column, row),
                Some(level) => level.ranges[(row * level.columns + column) as usize],
            };
            let halved = Level::halving(columns, rows, range);
            (columns, rows) = (halved.columns, halved.rows);
            levels.push(halved);
        }
        Self { field, levels }
    }

    fn range(&self, square: &Square) -> Range {
        match square.level.checked_sub(1) {
            None => cell_range(&self.field, square.column, square.row),
            Some(level) => {
                let level = &self.levels[level];
                level.ranges[(square.row * level.columns + square.column) as usize]
            }
        }
    }

    /// The box of a square of cells.
    fn square_bounds(&self, square: &Square) -> Aabb {
        let Range { low, high } = self.range(square);
        if low > high {
            return Aabb::empty();
        }
        let last = [self.field.width - 1, self.field.height - 1];
        let corner = |step: u32| {
            let column = ((square.column + step) << square.level).min(last[0]);
            let row = ((square.row + step) << square.level).min(last[1]);
            self.field.place(column, row)
        };
        let (from, to) = (corner(0), corner(1));
        Aabb { min: Vec3::new(from.x, low, from.z), max: Vec3::new(to.x, high, to.z) }
    }

    fn counts(&self, level: usize) -> [u32; 2] {
        match level.checked_sub(1) {
            None => [self.field.width - 1, self.field.height - 1],
            Some(level) => [self.levels[level].columns, self.levels[level].rows],
        }
    }
}

impl Level {
    fn halving(columns: u32, rows: u32, range: impl Fn(u32, u32) -> Range) -> Self {
        let (halved_columns, halved_rows) = (columns.div_ceil(2), rows.div_ceil(2));
        let mut ranges = Vec::with_capacity(halved_columns as usize * halved_rows as usize);
        for row in 0..halved_rows {
            for column in 0..halved_columns {
                let mut all = Range::NOTHING;
                for r in 2 * row..(2 * row + 2).min(rows) {
                    for c in 2 * column..(2 * column + 2).min(columns) {
                        all = all.with(range(c, r));
                    }
                }
                ranges.push(all);
            }
        }
        Self { columns: halved_columns, rows: halved_rows, ranges }
    }
}

/// The range of the triangles of one cell; holes count for nothing.
fn cell_range(field: &HeightField, column: u32, row: u32) -> Range {
    let corners = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(c, r)| field.at(column + c, row + r));
    corners
        .into_iter()
        .flatten()
        .fold(Range::NOTHING, |all, height| all.with(Range { low: height, high: height }))
}

impl Traced for Tracer {
    fn bounds(&self) -> Aabb {
        if self.field.check().is_err() {
            return Aabb::empty();
        }
        self.square_bounds(&Square { level: self.levels.len(), column: 0, row: 0, near: 0.0 })
    }

    fn nearest(&self, ray: &Ray) -> Option<TracedHit> {
        let (slab, sheared) = (SlabRay::new(ray)?, ShearedRay::new(ray)?);
        let mut best: Option<TracedHit> = None;
        // Three brothers wait on each level at most.
        let mut waiting: Vec<Square> = Vec::with_capacity(4 * self.levels.len() + 4);
        let enter = |square: Square| {
            let interval = slab.interval(&self.square_bounds(&square))?;
            Some(Square { near: interval.near, ..square })
        };
        waiting.extend(enter(Square { level: self.levels.len(), column: 0, row: 0, near: 0.0 }));
        while let Some(square) = waiting.pop() {
            if best.is_some_and(|best| square.near > best.crossing.t) {
                continue;
            }
            let Some(finer) = square.level.checked_sub(1) else {
                self.meet_cell(&square, &sheared, &mut best);
                continue;
            };
            let [columns, rows] = self.counts(finer);
            let first = waiting.len();
            for row in 2 * square.row..(2 * square.row + 2).min(rows) {
                for column in 2 * square.column..(2 * square.column + 2).min(columns) {
                    waiting.extend(enter(Square { level: finer, column, row, near: 0.0 }));
                }
            }
            // The nearest is looked at first.
            waiting[first..].sort_unstable_by(|one, other| other.near.total_cmp(&one.near));
        }
        best
    }
}

impl Tracer {
    fn meet_cell(&self, cell: &Square, ray: &ShearedRay, best: &mut Option<TracedHit>) {
        let first = 2 * (cell.row as usize * (self.field.width as usize - 1) + cell.column as usize);
        for primitive in first..first + 2 {
            let facet = Facet::of(&self.field, primitive);
            let [a, b, c] = facet.corners;
            if !facet.is_there(&self.field) {
                continue;
            }
            let Some(crossing) = ray.hit(&Triangle { a, b, c }) else { continue };
            let hit = TracedHit { crossing, primitive: primitive as u32 };
            let is_nearer =
                |best: &TracedHit| (crossing.t, hit.primitive) < (best.crossing.t, best.primitive);
            if best.as_ref().is_none_or(is_nearer) {
                *best = Some(hit);
            }
        }
    }
}

/// One of the two triangles of a cell.
pub(super) struct Facet {
    /// Column and row of each corner.
    points: [(u32, u32); 3],
    pub(super) corners: [Vec3; 3],
}

impl Facet {
    /// The triangle by its number: cells row by row, two each.
    pub(super) fn of(field: &HeightField, primitive: usize) -> Self {
        let (cell, columns) = (primitive / 2, field.width as usize - 1);
        let (column, row) = ((cell % columns) as u32, (cell / columns) as u32);
        let [a, b, c, d] = [(column, row + 1), (column + 1, row + 1), (column + 1, row), (column, row)];
        let points = if primitive.is_multiple_of(2) { [a, b, c] } else { [a, c, d] };
        Self { points, corners: points.map(|(column, row)| field.place(column, row)) }
    }

    fn is_there(&self, field: &HeightField) -> bool {
        self.points.iter().all(|(column, row)| field.at(*column, *row).is_some())
    }

    pub(super) fn point(&self, weights: [f32; 3]) -> Vec3 {
        blend(self.corners, weights)
    }

    pub(super) fn area_normal(&self) -> Vec3 {
        let [a, b, c] = self.corners;
        (b - a).cross(c - a)
    }

    pub(super) fn normals(&self, field: &HeightField) -> [Vec3; 3] {
        self.points.map(|(column, row)| field.normal(column, row))
    }
}

/// From 0 to 1 over the field; v grows toward −z.
pub(super) fn uv(field: &HeightField, point: Vec3) -> Vec2 {
    Vec2::new(0.5 + point.x / field.size.x, 0.5 - point.z / field.size.y)
}
