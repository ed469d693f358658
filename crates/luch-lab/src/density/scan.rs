//! The best width of a normal density.

use super::quadrature;
use crate::figure::{Axis, Figure, Ink};
use crate::integral::{AxisDensity, Integral};
use serde::Serialize;

/// One width.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ScanRow {
    /// Standard deviation of the density.
    pub deviation: f64,
    /// Variance of one sample.
    pub variance: f64,
    /// Standard deviation of one sample over the integral.
    pub relative_deviation: f64,
}

/// Many widths and the best.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Scan {
    /// In the order of the widths.
    pub rows: Vec<ScanRow>,
    /// The width of least variance between the ends.
    pub best: ScanRow,
    /// The integral.
    pub integral: f64,
    /// The curve.
    pub figure: Figure,
}

/// Variances of an integral in one dimension under normal densities, by quadrature over its finite domain; widths grow in equal
/// ratios from `low` to `high`. `None` if the integral has another dimension, infinite ends or no value, or the widths are not
/// positive and growing.
pub fn normal_scan(integral: &Integral, mean: f64, low: f64, high: f64, steps: usize) -> Option<Scan> {
    let [side] = integral.domain.sides() else { return None };
    if !(side.length().is_finite() && mean.is_finite() && low > 0.0 && low < high && high.is_finite()) {
        return None;
    }
    const CELLS: u32 = 400;
    let value = quadrature(side.low, side.high, CELLS, |x| integral.value(&[x]));
    if !value.is_finite() || value == 0.0 {
        return None;
    }
    let at = |deviation: f64| {
        let density = AxisDensity::Normal { mean, deviation };
        let square = quadrature(side.low, side.high, CELLS, |x| {
            let value = integral.value(&[x]);
            if value == 0.0 { 0.0 } else { value * (value / density.pdf(x, side)) }
        });
        let variance = if square.is_nan() { f64::INFINITY } else { square - value * value };
        ScanRow { deviation, variance, relative_deviation: variance.max(0.0).sqrt() / value.abs() }
    };
    let steps = steps.clamp(2, 4096);
    let ratio = libm::log(high / low) / (steps - 1) as f64;
    let rows: Vec<ScanRow> = (0..steps).map(|i| at(low * libm::exp(ratio * i as f64))).collect();
    let best = rows.iter().enumerate().min_by(|a, b| a.1.variance.total_cmp(&b.1.variance))?.0;
    // Golden section between the neighbours of the best of the rows.
    let (mut a, mut b) = (rows[best.saturating_sub(1)].deviation, rows[(best + 1).min(steps - 1)].deviation);
    let golden = 0.618_033_988_749_894_9;
    for _ in 0..60 {
        let (left, right) = (b - golden * (b - a), a + golden * (b - a));
        if at(left).variance < at(right).variance { b = right } else { a = left }
    }
    let best = at(0.5 * (a + b));
    let curve = rows.iter().filter(|row| row.relative_deviation.is_finite()).collect::<Vec<_>>();
    let figure = Figure::new("Too narrow is worse than too wide")
        .with_caption(format!("Standard deviation of one sample, as a share of the integral, against the width of the normal density. Least {:.5} at σ = {:.5}. To the left the weights of far samples have no bound, to the right samples are merely wasted.", best.relative_deviation, best.deviation))
        .with_x(Axis::log10("σ of the density"))
        .with_y(Axis::log10("relative deviation"))
        .line("", Ink::Blue, curve.iter().map(|row| [row.deviation, row.relative_deviation]).collect())
        .place(format!("σ* = {:.4}", best.deviation), best.deviation);
    Some(Scan { rows, best, integral: value, figure })
}
