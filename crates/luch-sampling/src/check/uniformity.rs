//! The Kolmogorov–Smirnov test of numbers against a distribution.

/// Result of a Kolmogorov–Smirnov test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KolmogorovSmirnov {
    /// Largest distance between the empirical and the expected distribution function.
    pub statistic: f64,
    /// Probability of a distance at least as large if the numbers are independent and so distributed.
    pub p_value: f64,
}

/// Tests numbers against a continuous distribution function. No numbers give a probability of one, a not-a-number gives zero.
///
/// The probability is Kolmogorov's limit with the correction of Stephens (1970), good to some thousandths from ten numbers on.
pub fn kolmogorov_smirnov(values: &[f64], cumulative: impl Fn(f64) -> f64) -> KolmogorovSmirnov {
    if values.is_empty() {
        return KolmogorovSmirnov { statistic: 0.0, p_value: 1.0 };
    }
    let mut shares: Vec<f64> = values.iter().map(|&value| cumulative(value)).collect();
    if shares.iter().any(|share| share.is_nan()) {
        return KolmogorovSmirnov { statistic: 1.0, p_value: 0.0 };
    }
    shares.sort_by(f64::total_cmp);
    let n = shares.len() as f64;
    let statistic = shares
        .iter()
        .enumerate()
        .map(|(i, &share)| (share - i as f64 / n).max((i as f64 + 1.0) / n - share))
        .fold(0.0, f64::max);
    let root = n.sqrt();
    KolmogorovSmirnov { statistic, p_value: kolmogorov_tail(statistic * (root + 0.12 + 0.11 / root)) }
}

/// Tests numbers against the uniform distribution on [0, 1].
pub fn uniformity(values: &[f64]) -> KolmogorovSmirnov {
    kolmogorov_smirnov(values, |value| value.clamp(0.0, 1.0))
}

/// Kolmogorov's limit distribution: 2 Σ (−1)^(k−1) e^(−2k²x²).
fn kolmogorov_tail(x: f64) -> f64 {
    if x < 0.2 {
        return 1.0; // Right to fifteen digits; the alternating sum converges badly here.
    }
    let mut sum = 0.0;
    for k in 1..100 {
        let k = f64::from(k);
        let term = libm::exp(-2.0 * k * k * x * x);
        sum += if k % 2.0 == 1.0 { term } else { -term };
        if term < 1e-17 {
            break;
        }
    }
    (2.0 * sum).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_probabilities() {
        assert!((kolmogorov_tail(1.358_1) - 0.05).abs() < 1e-4);
        assert!((kolmogorov_tail(1.627_6) - 0.01).abs() < 1e-4);
        let even: Vec<f64> = (0..100).map(|i| (f64::from(i) + 0.5) / 100.0).collect();
        let test = uniformity(&even);
        assert!((test.statistic - 0.005).abs() < 1e-15 && test.p_value == 1.0);
        let squeezed: Vec<f64> = even.iter().map(|x| 0.8 * x).collect();
        assert!(uniformity(&squeezed).p_value < 1e-3);
        assert_eq!(uniformity(&[f64::NAN]).p_value, 0.0);
    }
}
