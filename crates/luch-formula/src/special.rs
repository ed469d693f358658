//! Functions that the mathematics library lacks.

/// The derivative of the logarithm of the gamma function.
///
/// Recurrence ψ(x) = ψ(x + 1) − 1/x up to 10, there the asymptotic series with Bernoulli numbers (Abramowitz & Stegun 6.3.18);
/// its first omitted term is below 2e-17. Left of zero the reflection 6.3.7.
pub(crate) fn digamma(x: f64) -> f64 {
    if x <= 0.0 {
        if x == x.floor() {
            return f64::NAN;
        }
        let turn = std::f64::consts::PI * (x - x.floor());
        return digamma(1.0 - x) - std::f64::consts::PI / libm::tan(turn);
    }
    let (mut argument, mut shift) = (x, 0.0);
    while argument < 10.0 {
        shift += 1.0 / argument;
        argument += 1.0;
    }
    let inverse = 1.0 / (argument * argument);
    // B₂ₖ / 2k for k = 7 down to 1.
    let series =
        [1.0 / 12.0, -691.0 / 32760.0, 1.0 / 132.0, -1.0 / 240.0, 1.0 / 252.0, -1.0 / 120.0, 1.0 / 12.0]
            .iter()
            .fold(0.0, |sum, coefficient| (sum + coefficient) * inverse);
    libm::log(argument) - 0.5 / argument - series - shift
}

#[cfg(test)]
mod tests {
    use super::digamma;

    #[test]
    fn digamma_has_its_known_values() {
        // −γ at one, −γ − 2 ln 2 at one half; DLMF 5.4.12 and 5.4.13.
        let gamma = 0.577_215_664_901_532_9;
        assert!((digamma(1.0) + gamma).abs() < 4e-15);
        assert!((digamma(0.5) + gamma + 2.0 * std::f64::consts::LN_2).abs() < 4e-15);
        assert!((digamma(-0.5) - (2.0 - gamma - 2.0 * std::f64::consts::LN_2)).abs() < 4e-15);
        assert!(digamma(-3.0).is_nan() && digamma(0.0).is_nan());
    }

    #[test]
    fn digamma_is_the_derivative_of_the_logarithm_of_gamma() {
        for i in 1..400 {
            let x = f64::from(i) * 0.05 + 0.013;
            let step = 1e-5;
            let difference = (libm::lgamma(x + step) - libm::lgamma(x - step)) / (2.0 * step);
            // Rounding: 2e-16 · |lgamma| / step; cut-off: step² / 6 times the third derivative, at most 2 / x³.
            let bound = 4e-16 * (1.0 + libm::lgamma(x).abs()) / step + step * step / (x * x * x);
            assert!((digamma(x) - difference).abs() < bound, "{x}");
        }
    }
}
