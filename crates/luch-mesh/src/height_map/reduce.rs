//! Few triangles for many heights: greedy insertion into a Delaunay triangulation.
//!
//! Garland and Heckbert, "Fast polygonal approximation of terrains and height fields" (1995): start with two triangles and add
//! the point that is off by most, until none is off by more than allowed.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::HeightField;
use super::delaunay::GridDelaunay;
use super::sheet::over_points;
use crate::TriangleMesh;

/// How far to go.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reduction {
    /// No point of the field may be farther than this above or below the triangles, in metres. What is below zero or not a
    /// number counts as zero.
    pub error: f64,
    /// Stop before there are more triangles than this, even if the error is not reached. Where there are holes, their rims
    /// are kept in full all the same.
    pub most_triangles: Option<u64>,
}

/// A sheet of few triangles: at every point of the field that is no hole its height differs by at most the error.
///
/// Holes stay as they are: the triangles of the full sheet that touch one are missing, no others. The points come in one order
/// for each field; a smaller error takes more of them. For a field that is not sound ([`HeightField::check`]) the result
/// is empty.
pub fn reduced(field: &HeightField, reduction: &Reduction) -> TriangleMesh {
    if field.check().is_err() {
        return TriangleMesh::default();
    }
    let mut work = Work {
        field,
        mesh: GridDelaunay::new(field.width, field.height),
        worst: BinaryHeap::new(),
        stamps: vec![0; 2],
        kept: 0,
    };
    work.keep_rims();
    for triangle in 0..work.mesh.triangles.len() as u32 {
        work.kept += u64::from(work.is_whole(triangle));
        work.examine(triangle);
    }
    let error = reduction.error.max(0.0);
    // A point adds two triangles at most.
    let most = reduction.most_triangles.unwrap_or(u64::MAX);
    while let Some(candidate) = work.worst.pop() {
        if work.stamps[candidate.triangle as usize] != candidate.stamp {
            continue;
        }
        if candidate.error <= error || work.kept.saturating_add(2) > most {
            break;
        }
        work.add(candidate.point, candidate.triangle);
    }
    work.mesh.align_cells();
    let triangles = 0..work.mesh.triangles.len() as u32;
    let whole = triangles.filter(|&t| work.is_whole(t)).map(|t| work.mesh.triangles[t as usize]);
    over_points(field, whole.collect())
}

/// The point of a triangle that is off by most.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Candidate {
    error: f64,
    point: u32,
    triangle: u32,
    /// Of the triangle when it was examined.
    stamp: u32,
}

impl Eq for Candidate {}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        // Of equal errors the first point comes first.
        self.error
            .total_cmp(&other.error)
            .then(other.point.cmp(&self.point))
            .then(other.triangle.cmp(&self.triangle))
            .then(self.stamp.cmp(&other.stamp))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

struct Work<'a> {
    field: &'a HeightField,
    mesh: GridDelaunay,
    worst: BinaryHeap<Candidate>,
    stamps: Vec<u32>,
    /// Triangles without a hole at a corner.
    kept: u64,
}

impl Work<'_> {
    fn height(&self, point: u32) -> Option<f64> {
        Some(f64::from(self.field.heights[point as usize])).filter(|height| height.is_finite())
    }

    fn is_whole(&self, triangle: u32) -> bool {
        self.mesh.triangles[triangle as usize].iter().all(|&point| self.height(point).is_some())
    }

    /// Adds all corners of cells that have both holes and heights. Such a cell then is two triangles by itself, since the
    /// circle around it is empty; so triangles of heights and triangles of holes never mix.
    fn keep_rims(&mut self) {
        let (width, height) = (self.field.width, self.field.height);
        let mut on_rim = vec![false; self.field.heights.len()];
        for row in 0..height - 1 {
            for column in 0..width - 1 {
                let corners =
                    [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| self.field.index(column + i, row + j));
                let holes = corners.iter().filter(|&&point| !self.field.heights[point].is_finite()).count();
                if holes > 0 && holes < 4 {
                    corners.iter().for_each(|&point| on_rim[point] = true);
                }
            }
        }
        let mut near = 0;
        for (point, _) in on_rim.iter().enumerate().filter(|(_, on_rim)| **on_rim) {
            near = self.mesh.locate(point as u32, near);
            self.mesh.insert(point as u32, near);
        }
        self.stamps.resize(self.mesh.triangles.len(), 0);
    }

    fn add(&mut self, point: u32, triangle: u32) {
        let before = self.mesh.triangles.len();
        self.mesh.insert(point, triangle);
        // The triangles that are split have no holes: edges between heights and holes are too short to hold a point.
        self.kept += (self.mesh.triangles.len() - before) as u64;
        self.stamps.resize(self.mesh.triangles.len(), 0);
        let changed = std::mem::take(&mut self.mesh.changed);
        for &triangle in &changed {
            self.stamps[triangle as usize] += 1;
            self.examine(triangle);
        }
        self.mesh.changed = changed;
    }

    /// Looks for the point of a triangle that is off by most.
    fn examine(&mut self, triangle: u32) {
        let corners = self.mesh.triangles[triangle as usize];
        let [Some(base), Some(second), Some(third)] = corners.map(|corner| self.height(corner)) else {
            return;
        };
        let [a, b, c] = corners.map(|corner| self.mesh.cell(corner));
        // The plane through the corners.
        let (b_rise, c_rise) = (second - base, third - base);
        let double_area = ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) as f64;
        let slope_x = (b_rise * (c.y - a.y) as f64 - c_rise * (b.y - a.y) as f64) / double_area;
        let slope_y = (c_rise * (b.x - a.x) as f64 - b_rise * (c.x - a.x) as f64) / double_area;
        let mut worst =
            Candidate { error: 0.0, point: u32::MAX, triangle, stamp: self.stamps[triangle as usize] };
        for y in a.y.min(b.y).min(c.y)..=a.y.max(b.y).max(c.y) {
            let (mut low, mut high) = (0, i64::from(self.field.width) - 1);
            for (from, to) in [(a, b), (b, c), (c, a)] {
                // Left of the edge: (to − from) × (p − from) ≥ 0, solved for x in whole numbers.
                let rise = to.y - from.y;
                let product = (to.x - from.x) * (y - from.y);
                match rise.cmp(&0) {
                    Ordering::Greater => high = high.min(from.x + product.div_euclid(rise)),
                    Ordering::Less => low = low.max(from.x - product.div_euclid(-rise)),
                    Ordering::Equal => {}
                }
            }
            let row = -y * i64::from(self.field.width);
            for x in low..=high {
                let point = (row + x) as u32;
                let Some(height) = self.height(point).filter(|_| !corners.contains(&point)) else { continue };
                let plane = base + slope_x * (x - a.x) as f64 + slope_y * (y - a.y) as f64;
                let error = (height - plane).abs();
                if error > worst.error {
                    worst = Candidate { error, point, ..worst };
                }
            }
        }
        if worst.error > 0.0 {
            self.worst.push(worst);
        }
    }
}
