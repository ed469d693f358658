//! Samples of a BSDF against its density, over the whole sphere.

use glam::Vec3;
use luch_render::Bsdf;
use luch_sampling::check::{ChiSquare, chi_square};
use std::f64::consts::{PI, TAU};

/// Rows by height, an odd number, so that the horizon is not a border of cells; columns by azimuth.
const ROWS: usize = 25;
const COLUMNS: usize = 24;

/// How samples and density agree.
#[derive(Debug)]
pub(crate) struct Fit {
    /// Counts against the integrated density; one more cell holds the draws without a direction and those of delta lobes.
    pub(crate) chi_square: ChiSquare,
    /// Integral of the density over the sphere.
    pub(crate) integral: f64,
}

/// A cell of the sphere: heights and azimuths.
#[derive(Clone, Copy)]
struct Cell {
    low: f64,
    high: f64,
    left: f64,
    right: f64,
}

impl Cell {
    fn of(row: usize, column: usize) -> Self {
        let height = |row: usize| 2.0 * row as f64 / ROWS as f64 - 1.0;
        let azimuth = |column: usize| TAU * column as f64 / COLUMNS as f64 - PI;
        Self { low: height(row), high: height(row + 1), left: azimuth(column), right: azimuth(column + 1) }
    }

    fn quarters(self) -> [Self; 4] {
        let (middle, between) = (0.5 * (self.low + self.high), 0.5 * (self.left + self.right));
        [
            Self { high: middle, right: between, ..self },
            Self { high: middle, left: between, ..self },
            Self { low: middle, right: between, ..self },
            Self { low: middle, left: between, ..self },
        ]
    }

    /// The density at a place of the cell, from 0 to 1 both ways.
    fn density(self, bsdf: &Bsdf, outgoing: Vec3, up: f64, along: f64) -> f64 {
        let height = self.low + (self.high - self.low) * up;
        let azimuth = self.left + (self.right - self.left) * along;
        let radius = (1.0 - height * height).max(0.0).sqrt();
        let (sine, cosine) = libm::sincos(azimuth);
        f64::from(
            bsdf.pdf(outgoing, Vec3::new((radius * cosine) as f32, (radius * sine) as f32, height as f32)),
        )
    }

    /// The integral of the density by the midpoints of a grid.
    fn midpoints(self, bsdf: &Bsdf, outgoing: Vec3, side: usize) -> f64 {
        let place = |index: usize| (index as f64 + 0.5) / side as f64;
        let mut sum = 0.0;
        for i in 0..side {
            for j in 0..side {
                sum += self.density(bsdf, outgoing, place(i), place(j));
            }
        }
        sum * (self.high - self.low) * (self.right - self.left) / (side * side) as f64
    }

    /// The integral, quartered where two grids disagree; `forced` quarterings come first.
    fn integral(self, bsdf: &Bsdf, outgoing: Vec3, forced: u32, depth: u32) -> f64 {
        if forced == 0 {
            let coarse = self.midpoints(bsdf, outgoing, 3);
            let fine = self.midpoints(bsdf, outgoing, 6);
            if depth == 0 || (fine - coarse).abs() < 3e-6 {
                return fine;
            }
        }
        let quarters = self.quarters().into_iter();
        quarters
            .map(|cell| cell.integral(bsdf, outgoing, forced.saturating_sub(1), depth.saturating_sub(1)))
            .sum()
    }
}

/// Draws directions and compares their histogram with the density.
pub(crate) fn fit(bsdf: &Bsdf, outgoing: Vec3, numbers: impl Iterator<Item = [f32; 4]>) -> Fit {
    let mut counts = vec![0_u64; ROWS * COLUMNS];
    let (mut count, mut elsewhere) = (0_u64, 0_u64);
    for [u, v, choice, _] in numbers {
        count += 1;
        match bsdf.sample(outgoing, [u, v], choice) {
            Some(sample) if !sample.specular => {
                let height = f64::from(sample.incoming.z);
                let azimuth = libm::atan2(f64::from(sample.incoming.y), f64::from(sample.incoming.x));
                let row = ((height + 1.0) * 0.5 * ROWS as f64) as usize;
                let column = ((azimuth + PI) / TAU * COLUMNS as f64) as usize;
                counts[row.min(ROWS - 1) * COLUMNS + column.min(COLUMNS - 1)] += 1;
            }
            _ => elsewhere += 1,
        }
    }
    let total = count as f64;
    let has_rim = !bsdf.is_reciprocal();
    let occupied = counts.iter().filter(|count| **count > 0).count();
    let mut expected: Vec<f64> = counts
        .iter()
        .enumerate()
        .map(|(index, &count)| {
            let cell = Cell::of(index / COLUMNS, index % COLUMNS);
            if has_rim && count > 0 {
                // Quartering by comparison is blind to a rim: many points instead, the more the fewer cells share the lobe.
                let side = (8e6 / occupied as f64).sqrt() as usize;
                return total * cell.midpoints(bsdf, outgoing, side);
            }
            // A narrow lobe can hide between the points of a grid: look closer where samples crowd.
            let forced = if count as f64 > 0.03 * total { 4 } else { 0 };
            let integral = cell.integral(bsdf, outgoing, forced, 10);
            let missed = integral == 0.0 && count > 0;
            total * if missed { cell.integral(bsdf, outgoing, 6, 10) } else { integral }
        })
        .collect();
    let integral = expected.iter().sum::<f64>() / total;
    counts.push(elsewhere);
    let left = total * (1.0 - integral);
    // Less than a thousandth is the error of the integral, not a cell.
    expected.push(if elsewhere == 0 && left < 1e-3 * total { 0.0 } else { left });
    Fit { chi_square: chi_square(&counts, &expected), integral }
}
