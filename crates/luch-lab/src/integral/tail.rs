//! Whether a few samples carry the sum: signs of infinite variance.

use serde::Serialize;

/// What the greatest of some samples tell.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Tail {
    /// Exponent α of the tail, P(|sample| > t) ~ t^−α, by Hill's estimator ("A simple general approach to inference about the
    /// tail of a distribution", 1975); infinite for bounded samples. The variance is finite above 2, the mean above 1.
    pub index: f64,
    /// Its standard error.
    pub index_error: f64,
    /// The share of the greatest square in the sum of squares.
    pub greatest_share: f64,
    /// Fourth moment over the square of the second, about the mean; 3 for normal samples.
    pub kurtosis: f64,
    /// How many samples were looked at.
    pub samples: usize,
    /// Whether the variance may be infinite: then no interval from it is honest.
    pub is_heavy: bool,
}

/// Looks at independent samples.
///
/// The tail counts as heavy if its index is not clearly above 2 (two standard errors), or if one sample in a hundred or more
/// holds half of the sum of squares.
pub fn tail_of(samples: &[f64]) -> Tail {
    let mut sizes: Vec<f64> =
        samples.iter().map(|sample| sample.abs()).filter(|size| size.is_finite()).collect();
    sizes.sort_by(|a, b| b.total_cmp(a));
    let n = sizes.len();
    // The root of the count: few enough to be the tail, enough to be an estimate.
    let k = ((n as f64).sqrt() as usize).min(n.saturating_sub(1));
    let threshold = sizes.get(k).copied().unwrap_or(0.0);
    let mean_log = if k == 0 || threshold <= 0.0 {
        0.0
    } else {
        sizes[..k].iter().map(|size| libm::log(size / threshold)).sum::<f64>() / k as f64
    };
    let index = if mean_log > 0.0 { 1.0 / mean_log } else { f64::INFINITY };
    let index_error = index / (k.max(1) as f64).sqrt();
    let squares: f64 = sizes.iter().map(|size| size * size).sum();
    let greatest_share =
        sizes.first().map_or(0.0, |size| if squares > 0.0 { size * size / squares } else { 0.0 });
    let finite = samples.iter().filter(|sample| sample.is_finite());
    let mean = finite.clone().sum::<f64>() / n.max(1) as f64;
    let moment = |power: i32| {
        finite.clone().map(|s| (0..power).fold(1.0, |product, _| product * (s - mean))).sum::<f64>()
            / n.max(1) as f64
    };
    let spread = moment(2);
    let kurtosis = if spread > 0.0 { moment(4) / (spread * spread) } else { 0.0 };
    let is_heavy = (n >= 100 && index.is_finite() && index - 2.0 * index_error < 2.0)
        || (n >= 1000 && greatest_share > 0.5);
    Tail { index, index_error, greatest_share, kurtosis, samples: n, is_heavy }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integral::{HashedPoints, Integral};

    fn tail(formula: &str, density: &str) -> Tail {
        let domain = if density.starts_with("uniform") { "x=0..1" } else { "x=-inf..inf" };
        let integral = Integral::new(formula, domain).unwrap().with_density(density).unwrap();
        tail_of(&integral.samples(&HashedPoints { seed: 3 }, 0, 1 << 15))
    }

    #[test]
    fn powers_are_told_from_bounded_samples() {
        // x^−a of a uniform number has the tail t^(−1/a): infinite variance from a = 1/2 on.
        for (power, is_heavy) in [(0.1, false), (0.25, false), (0.6, true), (0.9, true)] {
            let found = tail(&format!("x^(-{power})"), "uniform");
            assert_eq!(found.is_heavy, is_heavy, "{power}: {found:?}");
            assert!((found.index - 1.0 / power).abs() < 4.0 * found.index_error, "{power}: {found:?}");
        }
        for formula in ["x", "x < 0.3", "cos(20*x)^77", "1", "x < 0.0003", "exp(x)"] {
            assert!(!tail(formula, "uniform").is_heavy, "{formula}: {:?}", tail(formula, "uniform"));
        }
        // exp(−x²/2) drawn with deviation s: infinite variance for s below the root of a half.
        assert!(tail("exp(-x^2/2)", "normal(0, 0.6)").is_heavy);
        assert!(!tail("exp(-x^2/2)", "normal(0, 1.2)").is_heavy);
        assert!(!tail_of(&[]).is_heavy && !tail_of(&[f64::NAN, 1.0]).is_heavy);
    }
}
