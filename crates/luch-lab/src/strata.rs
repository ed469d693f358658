//! One random point in each of N equal cells: the variance it leaves, exactly and as measured.
//!
//! ```
//! use luch_lab::strata::{StrataProblem, strata};
//!
//! let rows = strata(StrataProblem::Cos77, &[16], 256, 1);
//! assert!((rows[0].exact / 5.226_226e-3 - 1.0).abs() < 1e-6);
//! assert!(rows[0].measured < rows[0].independent / 4.0);
//! ```

use crate::density::quadrature;
use crate::figure::{Axis, ErrorBar, Figure, Ink};
use crate::integral::{Points, RulePoints};
use crate::points::Rule;
use crate::problem::COS77;
use rayon::prelude::*;
use serde::Serialize;
use std::f64::consts::{FRAC_PI_2, PI};

/// What is integrated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum StrataProblem {
    /// π as four times the share of the unit square inside a disc, over n × n cells: an edge, so few cells matter.
    Pi,
    /// ∫cos⁷⁷ over a half turn, over N strata: smooth.
    Cos77,
}

/// One number of cells.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct StrataRow {
    /// Cells, and so points of an estimate.
    pub cells: u64,
    /// Variance of the estimate from as many independent points.
    pub independent: f64,
    /// Variance of the estimate from one point in each cell, by closed forms or quadrature.
    pub exact: f64,
    /// The mean square of the error that estimates had.
    pub measured: f64,
    /// Its standard error.
    pub standard_error: f64,
}

impl StrataRow {
    /// (measured − exact) / standard error.
    pub fn z_score(&self) -> f64 {
        (self.measured - self.exact) / self.standard_error
    }
}

impl StrataProblem {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Pi, Self::Cos77];

    /// A short name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Pi => "pi",
            Self::Cos77 => "cos77",
        }
    }

    fn dimensions(self) -> usize {
        match self {
            Self::Pi => 2,
            Self::Cos77 => 1,
        }
    }

    /// The integral.
    fn truth(self) -> f64 {
        match self {
            Self::Pi => PI,
            Self::Cos77 => COS77,
        }
    }

    fn value(self, u: &[f64]) -> f64 {
        match self {
            Self::Pi => {
                let (x, y) = (u[0] - 0.5, u[1] - 0.5);
                if x * x + y * y <= 0.25 { 4.0 } else { 0.0 }
            }
            Self::Cos77 => PI * bell((u[0] - 0.5) * PI),
        }
    }

    /// Variance of one value at a uniform point.
    fn variance(self) -> f64 {
        match self {
            // A coin: 16 p (1 − p) with p = π/4.
            Self::Pi => PI * (4.0 - PI),
            Self::Cos77 => PI * quadrature(-FRAC_PI_2, FRAC_PI_2, 200, |x| bell(x) * bell(x)) - COS77 * COS77,
        }
    }

    /// Variance of the mean of one value in each of `side` cells along each axis: the mean of the cells' own variances, over their
    /// number.
    fn stratified(self, side: u32) -> f64 {
        let n = f64::from(side);
        match self {
            Self::Pi => {
                let place = |at: u32| f64::from(at) / n - 0.5;
                let mut sum = 0.0;
                for y in 0..side {
                    for x in 0..side {
                        let corner = |x: u32, y: u32| disc_below(place(x), place(y));
                        let area = corner(x + 1, y + 1) - corner(x, y + 1) - corner(x + 1, y) + corner(x, y);
                        let share = (area * n * n).clamp(0.0, 1.0);
                        sum += share * (1.0 - share);
                    }
                }
                16.0 * sum / (n * n * n * n)
            }
            Self::Cos77 => {
                let width = PI / n;
                let of = |at: u32| {
                    let low = -FRAC_PI_2 + width * f64::from(at);
                    let mean = quadrature(low, low + width, 16, bell) / width;
                    let square = quadrature(low, low + width, 16, |x| bell(x) * bell(x)) / width;
                    square - mean * mean
                };
                width * width * (0..side).map(of).sum::<f64>()
            }
        }
    }
}

fn bell(x: f64) -> f64 {
    libm::pow(libm::cos(x).max(0.0), 77.0)
}

/// Area of the part of the disc of radius ½ about the origin with coordinates below these.
fn disc_below(x: f64, y: f64) -> f64 {
    const R: f64 = 0.5;
    let x = x.clamp(-R, R);
    let y = y.clamp(-R, R);
    // ∫√(R² − t²) dt
    let half =
        |t: f64| 0.5 * (t * (R * R - t * t).max(0.0).sqrt() + R * R * libm::asin((t / R).clamp(-1.0, 1.0)));
    let between = |low: f64, high: f64| if high > low { half(high) - half(low) } else { 0.0 };
    // Between −b and b the line at height y cuts the disc; beyond, the disc is wholly below or above.
    let b = (R * R - y * y).max(0.0).sqrt();
    let middle = x.min(b);
    let cut = if middle > -b { y * (middle + b) + between(-b, middle) } else { 0.0 };
    if y < 0.0 { cut } else { cut + 2.0 * (between(-R, x.min(-b)) + between(b, x)) }
}

/// Exact and measured variances for these numbers of cells along each axis (at most 4096 for the strata, 512 for the square), from so many
/// repetitions with the points of [`Rule::Jittered`].
pub fn strata(problem: StrataProblem, sides: &[u32], repetitions: u64, seed: u64) -> Vec<StrataRow> {
    let dimensions = problem.dimensions();
    let most = if dimensions == 2 { 512 } else { 4096 };
    let row = |&side: &u32| {
        let side = side.clamp(1, most);
        let cells = u64::from(side).pow(dimensions as u32);
        let rule = RulePoints { rule: Rule::Jittered, seed };
        let square_error = |repetition: u64| {
            let mut numbers = vec![0.0; cells as usize * dimensions];
            match rule.sized(cells) {
                Some(points) => points.fill(repetition, 0, dimensions, &mut numbers),
                None => rule.fill(repetition, 0, dimensions, &mut numbers),
            }
            let sum: f64 = numbers.chunks(dimensions).map(|u| problem.value(u)).sum();
            let error = sum / cells as f64 - problem.truth();
            error * error
        };
        let squares: Vec<f64> = (0..repetitions.max(2)).into_par_iter().map(square_error).collect();
        let n = squares.len() as f64;
        let measured = squares.iter().sum::<f64>() / n;
        let spread = squares.iter().map(|square| (square - measured) * (square - measured)).sum::<f64>();
        StrataRow {
            cells,
            independent: problem.variance() / cells as f64,
            exact: problem.stratified(side),
            measured,
            standard_error: (spread / (n * (n - 1.0))).sqrt(),
        }
    };
    sides.iter().map(row).collect()
}

/// Variances against the number of cells.
pub fn strata_figure(problem: StrataProblem, rows: &[StrataRow]) -> Figure {
    let line =
        |of: fn(&StrataRow) -> f64| rows.iter().map(|row| [row.cells as f64, of(row)]).collect::<Vec<_>>();
    let bars = rows.iter().map(|row| ErrorBar {
        x: row.cells as f64,
        y: row.measured,
        low: (row.measured - 2.0 * row.standard_error).max(1e-300),
        high: row.measured + 2.0 * row.standard_error,
    });
    let (title, slope) = match problem {
        StrataProblem::Pi => ("π: a disc over n × n cells", "N^−3/2"),
        StrataProblem::Cos77 => ("∫cos⁷⁷ over N strata", "N^−3"),
    };
    let exponent = if problem == StrataProblem::Pi { -1.5 } else { -3.0 };
    let figure = Figure::new(title)
        .with_x(Axis::log2("points N"))
        .with_y(Axis::log10("variance of the estimate"))
        .dashed("independent points", Ink::Muted, line(|row| row.independent))
        .line("one in each cell, exact", Ink::Blue, line(|row| row.exact))
        .points("measured", Ink::Vermilion, line(|row| row.measured), 7.0)
        .errors("", Ink::Vermilion, bars.collect());
    match rows.last() {
        Some(last) => figure.reference(slope, [last.cells as f64, 0.3 * last.exact], exponent),
        None => figure,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variances_of_strata_are_the_known_ones() {
        // Ground truth: exact variances of the estimate of the integral of cos⁷⁷.
        let known = [
            (16, 5.226_226e-3, 3.452_931e-2),
            (64, 7.631_674e-5, 8.632_326e-3),
            (256, 1.202_848e-6, 2.158_082e-3),
        ];
        let rows = strata(StrataProblem::Cos77, &known.map(|(cells, ..)| cells), 8192, 3);
        for (row, (cells, stratified, independent)) in rows.iter().zip(known) {
            assert_eq!(row.cells, u64::from(cells));
            assert!((row.exact / stratified - 1.0).abs() < 2e-7, "{row:?}");
            assert!((row.independent / independent - 1.0).abs() < 3e-7, "{row:?}");
            assert!(row.z_score().abs() < 4.0 && row.standard_error < 0.03 * row.exact, "{row:?}");
        }
    }

    #[test]
    fn cells_of_the_square_are_what_they_should_be() {
        let rows = strata(StrataProblem::Pi, &[1, 2, 3, 4, 16, 64], 4096, 5);
        for row in &rows {
            assert!(row.z_score().abs() < 4.0 && row.standard_error < 0.04 * row.exact, "{row:?}");
            assert!(row.exact <= row.independent * (1.0 + 1e-12), "{row:?}");
        }
        // One cell is no stratum, and four are alike: each holds a quarter of the disc.
        assert!((rows[0].exact - PI * (4.0 - PI)).abs() < 1e-12);
        assert!((rows[1].exact / rows[1].independent - 1.0).abs() < 1e-12);
        // The middle one of nine is full, and those beside it nearly: less than independent points.
        assert!(rows[2].exact < 0.8 * rows[2].independent);
        // An edge crosses about n of n² cells: N^−3/2.
        let slope = libm::log(rows[5].exact / rows[4].exact) / libm::log(16.0);
        assert!((slope + 1.5).abs() < 0.05, "{slope}");
        assert!((disc_below(0.5, 0.5) - PI / 4.0).abs() < 1e-15 && disc_below(0.5, 0.0) == PI / 8.0);
        assert!((disc_below(0.0, 0.0) - PI / 16.0).abs() < 1e-15 && disc_below(-0.5, 0.3) == 0.0);
    }
}
