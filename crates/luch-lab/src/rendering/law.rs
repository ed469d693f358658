//! The power law that errors follow, and how sure it is.

use luch_sampling::check::{fit_slope, student_quantile};
use serde::Serialize;

/// An exponent with its interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Exponent {
    /// Exponent of the error as a power of the number of samples.
    pub value: f64,
    /// Ends of the 95 % interval; `None` with fewer than three repetitions.
    pub interval: Option<[f64; 2]>,
    /// How many sizes it was fitted to.
    pub sizes: usize,
}

/// Fits `√(mean squared error)` to a power of the number of samples.
///
/// `squares[r][k]` is the mean squared error of repetition `r` at `samples[k]`, from which `noise`, that of the reference, is
/// subtracted; sizes whose rest is not larger than `floor` are left out. The interval is the jackknife's over whole repetitions (Quenouille
/// 1956, Tukey 1958), by Student's t: a repetition goes through all sizes, so that its errors are not independent of one another.
///
/// `None` if fewer than two sizes are left.
pub fn exponent(samples: &[u64], squares: &[Vec<f64>], noise: f64, floor: f64) -> Option<Exponent> {
    let mean = |size: usize, without: Option<usize>| {
        let kept = squares.iter().enumerate().filter(|(at, _)| Some(*at) != without);
        let (sum, count) = kept.fold((0.0, 0.0), |(sum, count), (_, row)| (sum + row[size], count + 1.0));
        sum / f64::max(count, 1.0) - noise
    };
    let used: Vec<usize> = (0..samples.len()).filter(|&size| mean(size, None) > floor).collect();
    let fit = |without: Option<usize>| {
        let points: Vec<[f64; 2]> =
            used.iter().map(|&size| [samples[size] as f64, mean(size, without).max(0.0).sqrt()]).collect();
        fit_slope(&points).map(|fit| fit.slope)
    };
    let value = fit(None)?;
    let count = squares.len() as f64;
    let left_out: Option<Vec<f64>> = (0..squares.len()).map(|at| fit(Some(at))).collect();
    let interval = left_out.filter(|slopes| slopes.len() >= 3).map(|slopes| {
        let middle = slopes.iter().sum::<f64>() / count;
        let scatter = slopes.iter().map(|slope| (slope - middle) * (slope - middle)).sum::<f64>();
        let reach = student_quantile(0.975, count - 1.0) * ((count - 1.0) / count * scatter).sqrt();
        [value - reach, value + reach]
    });
    Some(Exponent { value, interval, sizes: used.len() })
}

/// How many samples the law of a curve [samples, error] needs for an error: between its points by their logarithms, past them with
/// `exponent`.
pub(super) fn samples_for(curve: &[[f64; 2]], exponent: f64, error: f64) -> Option<f64> {
    let (first, last) = (*curve.first()?, *curve.last()?);
    let through = |[n, e]: [f64; 2], slope: f64| {
        let found = n * libm::pow(error / e, 1.0 / slope);
        (slope < 0.0 && found.is_finite()).then_some(found)
    };
    if error >= first[1] {
        return through(first, exponent);
    }
    let between = curve.windows(2).find(|pair| pair[0][1] >= error && error >= pair[1][1]);
    match between {
        Some(pair) if pair[0][1] > pair[1][1] => {
            let slope = libm::log(pair[1][1] / pair[0][1]) / libm::log(pair[1][0] / pair[0][0]);
            through(pair[0], slope)
        }
        Some(pair) => Some(pair[0][0]),
        None => through(last, exponent),
    }
}
