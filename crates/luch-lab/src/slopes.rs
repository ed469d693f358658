//! How fast the errors of the rules fall: RMSE ~ N^s, by rule, integrand and dimension.
//!
//! [`measure`] gives the slopes of one rule in one dimension for five integrands of different smoothness, [`EXPECTED`] what is known
//! of them. Integrands are as in `luch_sampling`'s own tests of slopes; their means are exact.

mod expected;
mod integrand;
#[cfg(test)]
mod tests;

pub use expected::{EXPECTED, Expected, tolerance};
pub use integrand::{Integrand, MOST_SLOPE_DIMENSIONS};

use crate::points::{Design, PointsError, Rule};
use luch_sampling::check::{Slope, fit_slope};
use luch_sampling::hash;
use rayon::prelude::*;

/// What to measure with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SlopeSettings {
    /// Sizes are 2^first … 2^last, or the nearest below that the rule accepts.
    pub first: u32,
    /// See `first`; at most 24.
    pub last: u32,
    /// Independent repetitions, at least 2.
    pub replicates: u32,
    /// Chooses the randomisations.
    pub seed: u64,
    /// Resamplings of the replicates for the interval.
    pub resamplings: u32,
}

impl Default for SlopeSettings {
    /// Nine sizes from 64 to 16384, 48 replicates.
    fn default() -> Self {
        SlopeSettings { first: 6, last: 14, replicates: 48, seed: 1, resamplings: 400 }
    }
}

/// Root mean square error at one size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SizeError {
    /// Points.
    pub count: u64,
    /// Root of the mean over replicates of (estimate − mean)².
    pub rmse: f64,
}

/// The errors of one rule on one integrand, and how they fall.
#[derive(Clone, Debug, PartialEq)]
pub struct SlopeRow {
    /// The rule.
    pub rule: Rule,
    /// The integrand.
    pub integrand: Integrand,
    /// Dimensions.
    pub dimensions: usize,
    /// Errors by size, smallest size first.
    pub errors: Vec<SizeError>,
    /// The fitted law; `None` if the rule is exact to rounding here, or there are fewer than two sizes.
    pub fit: Option<Slope>,
    /// Limits of the slope at 95 %, by resampling the replicates (Efron's percentiles); `None` with the fit.
    pub interval: Option<[f64; 2]>,
}

impl SlopeRow {
    /// Whether all errors are nothing but rounding.
    pub fn is_exact(&self) -> bool {
        self.errors.iter().all(|error| error.rmse < ROUNDING)
    }
}

/// Errors below this, of means near 1, are rounding.
const ROUNDING: f64 = 1e-13;

/// Measures the slopes of a rule on all integrands that have a known mean in so many dimensions.
///
/// The same numbers on any number of threads. Rules that are not [random](Rule::is_random) have one replicate only.
pub fn measure(
    rule: Rule,
    dimensions: usize,
    settings: &SlopeSettings,
) -> Result<Vec<SlopeRow>, PointsError> {
    let mut sizes: Vec<u64> =
        (settings.first..=settings.last.min(24)).map(|m| rule.nearest_count(1 << m, dimensions)).collect();
    sizes.dedup();
    for &size in &sizes {
        rule.accepts(size, dimensions)?;
    }
    let integrands: Vec<(Integrand, f64)> =
        Integrand::ALL.into_iter().filter_map(|f| f.mean(dimensions).map(|mean| (f, mean))).collect();
    let replicates = if rule.is_random() { settings.replicates.max(2) } else { 1 };
    // Estimates by replicate, size, integrand.
    let estimates: Vec<Vec<Vec<f64>>> = (0..u64::from(replicates))
        .into_par_iter()
        .map(|replicate| {
            let key = hash::combine(settings.seed, dimensions as u64);
            estimates(rule, dimensions, &sizes, &integrands, key, replicate)
        })
        .collect::<Result<_, _>>()?;
    let row = |(place, &(integrand, mean)): (usize, &(Integrand, f64))| {
        let squares: Vec<Vec<f64>> = estimates
            .iter()
            .map(|by_size| {
                by_size.iter().map(|values| (values[place] - mean) * (values[place] - mean)).collect()
            })
            .collect();
        summarise(rule, integrand, dimensions, &sizes, &squares, settings)
    };
    Ok(integrands.iter().enumerate().map(row).collect())
}

/// Means over the points of each size.
fn estimates(
    rule: Rule,
    dimensions: usize,
    sizes: &[u64],
    integrands: &[(Integrand, f64)],
    seed: u64,
    replicate: u64,
) -> Result<Vec<Vec<f64>>, PointsError> {
    let mut sums = vec![0.0; integrands.len()];
    let add = |points: &[f64], sums: &mut [f64]| {
        for point in points.chunks_exact(dimensions) {
            for (sum, (integrand, _)) in sums.iter_mut().zip(integrands) {
                *sum += integrand.value(point);
            }
        }
    };
    let means = |sums: &[f64], count: u64| sums.iter().map(|sum| sum / count as f64).collect::<Vec<f64>>();
    let mut results = Vec::with_capacity(sizes.len());
    let mut done = 0;
    for &size in sizes {
        if rule.is_sequence() && rule.is_streamed() {
            // Only what is new since the last size.
            let design = Design { count: size, dimensions, seed, replicate };
            let mut points = vec![0.0; (size - done) as usize * dimensions];
            rule.fill(&design, done, &mut points)?;
            add(&points, &mut sums);
            done = size;
        } else {
            sums.fill(0.0);
            add(rule.points(size as usize, dimensions, seed, replicate)?.flat(), &mut sums);
        }
        results.push(means(&sums, size));
    }
    Ok(results)
}

fn summarise(
    rule: Rule,
    integrand: Integrand,
    dimensions: usize,
    sizes: &[u64],
    squares: &[Vec<f64>],
    settings: &SlopeSettings,
) -> SlopeRow {
    // `chosen` names the replicates that count.
    let errors = |chosen: &[usize]| -> Vec<SizeError> {
        let error = |(place, &count): (usize, &u64)| {
            let mean = chosen.iter().map(|&r| squares[r][place]).sum::<f64>() / chosen.len() as f64;
            SizeError { count, rmse: mean.sqrt() }
        };
        sizes.iter().enumerate().map(error).collect()
    };
    let fit = |errors: &[SizeError]| {
        fit_slope(&errors.iter().map(|e| [e.count as f64, e.rmse]).collect::<Vec<[f64; 2]>>())
    };
    let all: Vec<usize> = (0..squares.len()).collect();
    let mut row = SlopeRow { rule, integrand, dimensions, errors: errors(&all), fit: None, interval: None };
    if row.is_exact() {
        return row;
    }
    row.fit = fit(&row.errors);
    let key = hash::combine(settings.seed, 0x626f_6f74);
    let n = squares.len() as u64;
    let mut slopes: Vec<f64> = (0..u64::from(settings.resamplings))
        .filter_map(|round| {
            let pick = |i: u64| ((u128::from(hash::word(key, round * n + i)) * u128::from(n)) >> 64) as usize;
            let chosen: Vec<usize> = (0..n).map(pick).collect();
            fit(&errors(&chosen)).map(|fit| fit.slope)
        })
        .collect();
    slopes.sort_by(f64::total_cmp);
    if row.fit.is_some() && slopes.len() >= 20 && n > 1 {
        let at = |share: f64| slopes[(share * (slopes.len() - 1) as f64).round() as usize];
        row.interval = Some([at(0.025), at(0.975)]);
    }
    row
}
