//! How the error falls with the number of points.

use super::{Integral, Points, Sums};
use crate::figure::{Axis, Figure, Ink, Marker};
use luch_sampling::check::fit_slope;
use luch_sampling::hash;
use rayon::prelude::*;
use serde::Serialize;

/// A line of the table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// Points in each replicate.
    pub samples: u64,
    /// Mean over the replicates.
    pub mean: f64,
    /// Standard error of that mean, from the scatter of the replicates.
    pub standard_error: f64,
    /// Root mean square error of one replicate: against the truth, or against the mean if none is known.
    pub rmse: f64,
    /// What each replicate gave.
    pub estimates: Vec<f64>,
}

/// An exponent with its interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SlopeFit {
    /// Exponent of the error as a power of the number of points.
    pub slope: f64,
    /// Lower end of the 95 % interval, by bootstrap over the replicates.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// What one source of points did on one integral.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Convergence {
    /// The name of the source.
    pub name: String,
    /// One for each number of points.
    pub rows: Vec<Row>,
    /// The fitted exponent; `None` if fewer than two sizes have an error, or all errors are rounding.
    pub slope: Option<SlopeFit>,
    /// Whether the error is nothing but rounding from some size on.
    pub is_exact: bool,
    /// Whether errors are known at all: of points without chance they are not, unless the truth is.
    pub has_errors: bool,
    /// Variance of one independent sample, from points of all replicates together.
    pub variance: f64,
    /// How many times more independent samples give the error of the last row; `None` if that error is zero.
    pub equal_error_factor: Option<f64>,
    /// Time for each point on one thread, measured; the only number here that differs between runs.
    pub nanoseconds_per_sample: f64,
}

/// Estimates by `replicates` independent randomisations (at least 2) at some numbers of points, taken in growing order.
pub fn convergence(
    name: &str,
    integral: &Integral,
    points: &dyn Points,
    sizes: &[u64],
    replicates: u64,
) -> Convergence {
    let mut sizes: Vec<u64> = sizes.iter().copied().filter(|&size| size > 0).collect();
    sizes.sort_unstable();
    sizes.dedup();
    let replicates = replicates.clamp(2, 1 << 16);
    let started = std::time::Instant::now();
    let all: Vec<Vec<Sums>> = (0..replicates)
        .into_par_iter()
        .map(|replicate| {
            let (mut sums, mut at) = (Sums::default(), 0);
            let prefix = sizes.iter().map(|&size| match points.sized(size) {
                Some(made) => integral.estimate(&*made, replicate, size),
                None => {
                    sums.merge(&integral.sums_of(points, replicate, at, size - at));
                    at = size;
                    sums.clone()
                }
            });
            prefix.collect()
        })
        .collect();
    let points_used = sizes.last().copied().unwrap_or(0) * replicates;
    let threads = rayon::current_num_threads().max(1) as f64;
    let nanoseconds_per_sample = started.elapsed().as_nanos() as f64 * threads / points_used.max(1) as f64;

    let rows: Vec<Row> = sizes
        .iter()
        .enumerate()
        .map(|(at, &samples)| {
            let estimates: Vec<f64> = all.iter().map(|sums| sums[at].mean().unwrap_or(0.0)).collect();
            let n = replicates as f64;
            let mean = estimates.iter().sum::<f64>() / n;
            let scatter = estimates.iter().map(|e| (e - mean) * (e - mean)).sum::<f64>() / (n - 1.0);
            let rmse = root_mean_square(estimates.iter().copied(), integral.truth, n);
            Row { samples, mean, standard_error: (scatter / n).sqrt(), rmse, estimates }
        })
        .collect();
    let mut together = Sums::default();
    all.iter().filter_map(|sums| sums.last()).for_each(|sums| together.merge(sums));
    let variance = together.variance().unwrap_or(0.0);
    // Sums of N numbers of size s are right to some N·2⁻⁵³·s at worst and much better here; below that is no error to fit.
    let floor = 1e-14 * variance.sqrt().max(together.mean().unwrap_or(0.0).abs()).max(f64::MIN_POSITIVE);
    let has_errors = integral.truth.is_some() || points.is_random();
    let is_exact = has_errors && rows.last().is_some_and(|row| row.rmse <= floor);
    let slope = fitted(&rows, integral.truth, floor).filter(|_| has_errors && !is_exact);
    let equal_error_factor = rows
        .last()
        .filter(|row| has_errors && row.rmse > floor)
        .map(|row| variance / (row.rmse * row.rmse) / row.samples as f64);
    Convergence {
        name: name.to_owned(),
        rows,
        slope,
        is_exact,
        has_errors,
        variance,
        equal_error_factor,
        nanoseconds_per_sample,
    }
}

fn root_mean_square(estimates: impl Iterator<Item = f64> + Clone, truth: Option<f64>, n: f64) -> f64 {
    let (center, degrees) = match truth {
        Some(truth) => (truth, n),
        None => (estimates.clone().sum::<f64>() / n, n - 1.0),
    };
    (estimates.map(|e| (e - center) * (e - center)).sum::<f64>() / degrees.max(1.0)).sqrt()
}

/// The exponent over all sizes, and its interval: replicates are drawn again with replacement, whole, since those of one replicate
/// share their points.
fn fitted(rows: &[Row], truth: Option<f64>, floor: f64) -> Option<SlopeFit> {
    const DRAWS: u64 = 1000;
    let used: Vec<&Row> = rows.iter().filter(|row| row.rmse > floor).collect();
    let fit = |error: &dyn Fn(&Row) -> f64| {
        let points: Vec<[f64; 2]> = used.iter().map(|row| [row.samples as f64, error(row)]).collect();
        fit_slope(&points).map(|fit| fit.slope)
    };
    let slope = fit(&|row| row.rmse)?;
    let count = used.first()?.estimates.len();
    let mut drawn: Vec<f64> = (0..DRAWS)
        .filter_map(|draw| {
            let key = hash::combine(0xb007, draw);
            let chosen: Vec<usize> =
                (0..count as u64).map(|i| (hash::word(key, i) % count as u64) as usize).collect();
            fit(&|row| root_mean_square(chosen.iter().map(|&at| row.estimates[at]), truth, count as f64))
        })
        .collect();
    drawn.sort_by(f64::total_cmp);
    let at = |fraction: f64| drawn.get((fraction * (drawn.len().saturating_sub(1)) as f64).round() as usize);
    Some(SlopeFit { slope, low: *at(0.025)?, high: *at(0.975)? })
}

/// Errors of several sources in one figure, with lines of slope −½ and −3/2.
pub fn convergence_figure(title: &str, measured: &[Convergence]) -> Figure {
    let mut figure =
        Figure::new(title).with_x(Axis::log2("points N")).with_y(Axis::log10("root mean square error"));
    for (at, one) in measured.iter().enumerate().filter(|(_, one)| one.has_errors) {
        let points: Vec<[f64; 2]> = one.rows.iter().map(|row| [row.samples as f64, row.rmse]).collect();
        let name = match one.slope {
            Some(fit) => format!("{} ({})", one.name, format!("{:.2}", fit.slope).replace('-', "−")),
            None => one.name.clone(),
        };
        figure = figure.marked(name, Ink::of(at), Marker::of(at), points);
    }
    let first = measured.iter().filter_map(|one| one.rows.first()).filter(|row| row.rmse > 0.0);
    if let Some(row) = first.max_by(|a, b| a.rmse.total_cmp(&b.rmse)) {
        let through = [row.samples as f64, 1.6 * row.rmse];
        figure = figure.reference("slope −1/2", through, -0.5);
    }
    figure.with_caption("The exponents of the fitted lines stand in brackets.")
}
