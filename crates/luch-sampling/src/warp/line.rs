//! One-dimensional densities: exponential, normal, tent.

use std::f64::consts::{PI, SQRT_2};

/// A distance with density rate·exp(−rate·x), x ≥ 0; `u` in [0, 1), `rate` positive.
#[inline]
pub fn exponential(u: f64, rate: f64) -> f64 {
    -libm::log1p(-u) / rate
}

/// Density of [`exponential`].
#[inline]
pub fn exponential_pdf(x: f64, rate: f64) -> f64 {
    if x >= 0.0 { rate * libm::exp(-rate * x) } else { 0.0 }
}

/// A normal number: the quantile of `u`, so that an even set of `u` gives an even set of numbers.
///
/// The whole line is sampled. Over a bounded domain let the integrand be zero outside; drawing again instead changes the
/// density by the mass that was cut off. `u` is kept 2⁻³³ away from 0 and 1, so the result is finite (6.3 deviations).
pub fn normal(u: f64, mean: f64, deviation: f64) -> f64 {
    const MARGIN: f64 = 1.0 / 8_589_934_592.0;
    mean + deviation * normal_quantile(u.clamp(MARGIN, 1.0 - MARGIN))
}

/// Density of [`normal`].
pub fn normal_pdf(x: f64, mean: f64, deviation: f64) -> f64 {
    let z = (x - mean) / deviation;
    libm::exp(-0.5 * z * z) / (deviation * (2.0 * PI).sqrt())
}

/// The standard normal distribution function Φ.
pub fn normal_cumulative(z: f64) -> f64 {
    0.5 * libm::erfc(-z / SQRT_2)
}

/// The standard normal quantile Φ⁻¹, to about fifteen digits; infinite at 0 and 1, not a number outside.
pub fn normal_quantile(probability: f64) -> f64 {
    if !(0.0..=1.0).contains(&probability) {
        return f64::NAN;
    }
    let tail = probability.min(1.0 - probability);
    if tail == 0.0 {
        return if probability == 0.0 { f64::NEG_INFINITY } else { f64::INFINITY };
    }
    // Start: Abramowitz and Stegun 26.2.23, good to 4.5e-4, for the lower tail.
    let t = (-2.0 * libm::log(tail)).sqrt();
    let mut z = (2.515517 + t * (0.802853 + t * 0.010328))
        / (1.0 + t * (1.432788 + t * (0.189269 + t * 0.001308)))
        - t;
    // Two steps of Halley's method on Φ(z) = tail; each triples the digits.
    for _ in 0..2 {
        let step = (normal_cumulative(z) - tail) / normal_pdf(z, 0.0, 1.0);
        z -= step / (1.0 + 0.5 * z * step);
    }
    if probability < 0.5 { z } else { -z }
}

/// A number in (−radius, radius) with a density that falls linearly from the middle: the tent filter.
#[inline]
pub fn tent(u: f32, radius: f32) -> f32 {
    let offset = if u < 0.5 { (2.0 * u).sqrt() - 1.0 } else { 1.0 - (2.0 - 2.0 * u).sqrt() };
    radius * offset
}

/// Density of [`tent`].
#[inline]
pub fn tent_pdf(x: f32, radius: f32) -> f32 {
    ((1.0 - x.abs() / radius) / radius).max(0.0)
}

#[cfg(test)]
mod tests {
    use statrs::distribution::{ContinuousCDF, Normal};

    use super::*;

    #[test]
    fn quantile_inverts_the_distribution_function() {
        let reference = Normal::standard();
        for exponent in 1..=300 {
            let p = libm::pow(10.0, -f64::from(exponent));
            let z = normal_quantile(p);
            assert!((normal_cumulative(z) / p - 1.0).abs() < 1e-11, "p = {p}");
        }
        for step in 1..1000 {
            let p = f64::from(step) / 1000.0;
            assert!((normal_quantile(p) - reference.inverse_cdf(p)).abs() < 1e-10, "p = {p}");
        }
        assert!((normal_quantile(0.975) - 1.959_963_984_540_054).abs() < 1e-14);
        assert_eq!(normal_quantile(0.0), f64::NEG_INFINITY);
        assert_eq!(normal_quantile(1.0), f64::INFINITY);
        assert!(normal_quantile(-0.1).is_nan() && normal_quantile(f64::NAN).is_nan());
    }
}
