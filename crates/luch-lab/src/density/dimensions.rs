//! Many dimensions: Monte Carlo does not mind, the product grid does.

use crate::figure::{Axis, Figure, Ink, Marker, Sheet};
use crate::integral::{Integral, IntegralError, Points, convergence};
use luch_sampling::check::fit_slope;
use serde::Serialize;

/// What places the points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Rule {
    /// Independent points.
    MonteCarlo,
    /// A randomised low-discrepancy sequence.
    QuasiMonteCarlo,
    /// The product of midpoint rules with k points on each axis, k^d in all.
    Grid,
}

impl Rule {
    /// All rules.
    pub const ALL: [Self; 3] = [Self::MonteCarlo, Self::QuasiMonteCarlo, Self::Grid];

    /// The name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::MonteCarlo => "Monte Carlo",
            Self::QuasiMonteCarlo => "quasi-Monte Carlo",
            Self::Grid => "product grid",
        }
    }
}

/// Errors of one rule in one dimension.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DimensionRow {
    /// Which.
    pub rule: Rule,
    /// How many dimensions.
    pub dimensions: usize,
    /// Number of points and error.
    pub errors: Vec<[f64; 2]>,
    /// The fitted exponent; `None` with fewer than two sizes.
    pub slope: Option<f64>,
}

/// All rules in all dimensions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DimensionStudy {
    /// One for each rule and dimension.
    pub rows: Vec<DimensionRow>,
}

/// exp((x₁ + … + x_d)/√d) over the unit cube, divided by its integral (√d (e^{1/√d} − 1))^d: a mean of 1, and in every dimension
/// about the same variance.
///
/// # Errors
///
/// More than 32 dimensions or none.
pub fn dimension_integral(dimensions: usize) -> Result<Integral, IntegralError> {
    let sum: Vec<String> = (1..=dimensions).map(|i| format!("x{i}")).collect();
    let root = format!("sqrt({dimensions})");
    let formula = format!("exp(({})/{root})/({root}*(exp(1/{root})-1))^{dimensions}", sum.join("+"));
    let domain = if dimensions == 1 { "x1=0..1".to_owned() } else { format!("x1..x{dimensions}=0..1") };
    Integral::new(&formula, &domain)?.with_truth("1")
}

/// Errors against the number of points for some dimensions. The grid takes the greatest k with k^d points within each size; sizes
/// that give the same k are left out.
///
/// # Errors
///
/// A dimension is above 32 or zero.
pub fn dimensions(
    dimensions: &[usize],
    sizes: &[u64],
    replicates: u64,
    independent: &dyn Points,
    low_discrepancy: &dyn Points,
) -> Result<DimensionStudy, IntegralError> {
    let mut rows = Vec::new();
    for &d in dimensions {
        let integral = dimension_integral(d)?;
        for rule in Rule::ALL {
            let errors: Vec<[f64; 2]> = match rule {
                Rule::Grid => grid_errors(d, sizes),
                _ => {
                    let points = if rule == Rule::MonteCarlo { independent } else { low_discrepancy };
                    let found = convergence(rule.name(), &integral, points, sizes, replicates);
                    found.rows.iter().map(|row| [row.samples as f64, row.rmse]).collect()
                }
            };
            let slope = fit_slope(&errors).map(|fit| fit.slope);
            rows.push(DimensionRow { rule, dimensions: d, errors, slope });
        }
    }
    Ok(DimensionStudy { rows })
}

/// The product grid of a product of equal factors is the power of one midpoint rule, so its error needs no loop over the points.
fn grid_errors(d: usize, sizes: &[u64]) -> Vec<[f64; 2]> {
    let root = (d as f64).sqrt();
    let mut errors: Vec<[f64; 2]> = Vec::new();
    for &size in sizes {
        let mut k = libm::floor(libm::pow(size as f64, 1.0 / d as f64)).max(1.0);
        // The root is rounded: 8^(1/3) may be a little below 2.
        if libm::pow(k + 1.0, d as f64) <= size as f64 * (1.0 + 1e-12) {
            k += 1.0;
        }
        let count = libm::pow(k, d as f64);
        if errors.last().is_some_and(|last| last[0] == count) {
            continue;
        }
        let one = (0..k as u64).map(|i| libm::exp((i as f64 + 0.5) / (k * root))).sum::<f64>() / k;
        let exact = root * libm::expm1(1.0 / root);
        errors.push([count, (libm::pow(one / exact, d as f64) - 1.0).abs()]);
    }
    errors
}

/// One figure for each rule: Monte Carlo keeps its slope, the grid loses it.
pub fn dimensions_figure(study: &DimensionStudy) -> Sheet {
    let all = || study.rows.iter().flat_map(|row| row.errors.iter()).filter(|error| error[1] > 0.0);
    let range = |axis: usize| {
        let low = all().map(|error| error[axis]).fold(f64::INFINITY, f64::min);
        let high = all().map(|error| error[axis]).fold(0.0, f64::max);
        [low / 1.5, high * 1.5]
    };
    let [xs, ys] = [range(0), range(1)];
    let figures = Rule::ALL.map(|rule| {
        let mut figure = Figure::new(rule.name())
            .with_x(Axis::log2("points N").with_range(xs[0], xs[1]))
            .with_y(Axis::log10("relative error").with_range(ys[0], ys[1]));
        for (at, row) in study.rows.iter().filter(|row| row.rule == rule).enumerate() {
            let slope = row.slope.map_or(String::new(), |slope| format!(" ({slope:.2})")).replace('-', "−");
            let name = format!("d = {}{slope}", row.dimensions);
            figure = figure.marked(name, Ink::of(at), Marker::of(at), row.errors.clone());
        }
        figure
    });
    Sheet::new("The error depends on N, not on the dimension, unless the points are a grid", 3, figures.into()).with_caption(
        "A smooth integrand of mean 1 and about the same variance in every dimension. The fitted exponents stand in brackets. A grid with k points on each axis has k^d points and the error of k.",
    )
}
