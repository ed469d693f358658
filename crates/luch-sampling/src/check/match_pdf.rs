//! Samples against their density: the first thing to check of any new warp, lobe or lamp.

use std::f64::consts::{PI, TAU};

use glam::Vec3;

use super::chi_square::{ChiSquare, chi_square};
use crate::{Domain, Sampler, Sequence};

/// Rows by height and columns by angle of the directions' histogram. The number of rows is odd, so the horizon is not a
/// border of cells.
const ROWS: usize = 51;
const COLUMNS: usize = 64;

/// Cells a side of the histogram on the unit square.
const SIDE: usize = 48;

/// Points a side of the grid that integrates the density over a cell.
const FINE: usize = 8;

/// How samples and their density agree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionFit {
    /// Counts against the integrated density.
    pub chi_square: ChiSquare,
    /// Integral of the density over its domain, by a fine grid.
    pub integral: f64,
    /// Samples that were drawn, of those tried.
    pub drawn: u64,
}

/// Draws `count` directions with independent numbers and compares their histogram on the sphere with the density.
///
/// `sample` may decline with `None`; such tries count as lost mass, so the density is then expected to integrate to less than
/// one by as much. `pdf` is per solid angle. The integration grid is 408 × 512 points: a lobe narrower than some degrees, or
/// a density with a jump inside cells, needs a test of its own.
pub fn directions_match_pdf(
    count: u64,
    seed: u64,
    mut sample: impl FnMut([f32; 4]) -> Option<Vec3>,
    pdf: impl Fn(Vec3) -> f32,
) -> DirectionFit {
    let expected = cells(ROWS, COLUMNS, |row, column| {
        let z = 2.0 * row - 1.0;
        let (sin, cos) = libm::sincos(TAU * column);
        let radius = (1.0 - z * z).max(0.0).sqrt();
        4.0 * PI * f64::from(pdf(Vec3::new((radius * cos) as f32, (radius * sin) as f32, z as f32)))
    });
    compare(count, seed, expected, |u| {
        let direction = sample(u)?.as_dvec3();
        let angle = libm::atan2(direction.y, direction.x);
        let column = if angle < 0.0 { angle + TAU } else { angle } / TAU;
        Some(place(0.5 * (direction.z + 1.0), ROWS) * COLUMNS + place(column, COLUMNS))
    })
}

/// The same for points of the unit square with a density per area.
pub fn square_matches_pdf(
    count: u64,
    seed: u64,
    mut sample: impl FnMut([f32; 4]) -> Option<[f32; 2]>,
    pdf: impl Fn([f32; 2]) -> f32,
) -> DirectionFit {
    let expected = cells(SIDE, SIDE, |row, column| f64::from(pdf([column as f32, row as f32])));
    compare(count, seed, expected, |u| {
        let [x, y] = sample(u)?.map(f64::from);
        Some(place(y, SIDE) * SIDE + place(x, SIDE))
    })
}

/// Integrates a density of (row, column) fractions over each cell by midpoints.
fn cells(rows: usize, columns: usize, density: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let (fine_rows, fine_columns) = ((rows * FINE) as f64, (columns * FINE) as f64);
    let mut masses = vec![0.0; rows * columns];
    for (cell, mass) in masses.iter_mut().enumerate() {
        for fine in 0..FINE * FINE {
            let row = (cell / columns * FINE + fine / FINE) as f64 + 0.5;
            let column = (cell % columns * FINE + fine % FINE) as f64 + 0.5;
            *mass += density(row / fine_rows, column / fine_columns);
        }
        *mass /= fine_rows * fine_columns;
    }
    masses
}

/// The cell of a fraction.
fn place(fraction: f64, cells: usize) -> usize {
    ((fraction * cells as f64) as usize).min(cells - 1)
}

fn compare(
    count: u64,
    seed: u64,
    mut expected: Vec<f64>,
    mut cell: impl FnMut([f32; 4]) -> Option<usize>,
) -> DirectionFit {
    let mut observed = vec![0u64; expected.len()];
    let mut drawn = 0;
    for index in 0..count {
        let u = Sampler::at(Sequence::Independent, seed, [0, 0], index).group(Domain::new(0, 0));
        if let Some(cell) = cell(u) {
            observed[cell] += 1;
            drawn += 1;
        }
    }
    let integral: f64 = expected.iter().sum();
    expected.iter_mut().for_each(|mass| *mass *= count as f64);
    // Tries that were declined are a cell of their own, if there can be any.
    observed.push(count - drawn);
    let lost = (1.0 - integral) * count as f64;
    expected.push(if drawn < count || lost > 5.0 { lost.max(0.0) } else { 0.0 });
    DirectionFit { chi_square: chi_square(&observed, &expected), integral, drawn }
}
