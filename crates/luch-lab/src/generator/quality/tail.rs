//! Two-sided probabilities.

use luch_sampling::check::{regularized_gamma_p, regularized_gamma_q};

/// Twice the smaller tail, at most 1.
pub fn two_sided(lower: f64, upper: f64) -> f64 {
    (2.0 * lower.min(upper)).min(1.0)
}

/// Probability that a standard normal number is at least as far from zero.
pub fn normal_two_sided(z: f64) -> f64 {
    libm::erfc(z.abs() * std::f64::consts::FRAC_1_SQRT_2)
}

/// Two-sided probability of a count whose expectation is `mean`, by Poisson's law.
pub fn poisson_two_sided(count: u64, mean: f64) -> f64 {
    // P(Y ≤ y) = Q(y + 1, λ), P(Y ≥ y) = P(y, λ). The smaller is taken from the function that does not cancel it.
    let lower = regularized_gamma_q(count as f64 + 1.0, mean);
    let upper = if count == 0 { 1.0 } else { upper_poisson(count, mean) };
    two_sided(lower, upper)
}

/// P(Y ≥ count): far out, the sum of the terms themselves.
fn upper_poisson(count: u64, mean: f64) -> f64 {
    if (count as f64) < mean + 1.0 {
        return regularized_gamma_p(count as f64, mean);
    }
    let mut term = libm::exp(count as f64 * libm::log(mean) - mean - libm::lgamma(count as f64 + 1.0));
    let (mut sum, mut k) = (0.0, count as f64);
    while term > sum * 1e-17 && term > 0.0 {
        sum += term;
        k += 1.0;
        term *= mean / k;
    }
    sum
}

/// Two-sided probability of a χ² statistic.
pub(super) fn chi_square_two_sided(statistic: f64, degrees: f64) -> f64 {
    two_sided(
        regularized_gamma_p(0.5 * degrees, 0.5 * statistic),
        regularized_gamma_q(0.5 * degrees, 0.5 * statistic),
    )
}
