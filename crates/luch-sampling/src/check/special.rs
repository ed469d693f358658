//! The incomplete gamma and beta functions and the distributions made of them.

/// Most terms of a series or a continued fraction; the arguments in use need far fewer.
const MOST_TERMS: u32 = 100_000;

/// Keeps a continued fraction off division by zero (Lentz's method).
const TINY: f64 = 1e-300;

/// The regularised lower incomplete gamma function P(a, x), for a > 0 and x ≥ 0; not a number elsewhere.
pub fn regularized_gamma_p(a: f64, x: f64) -> f64 {
    1.0 - regularized_gamma_q(a, x)
}

/// The regularised upper incomplete gamma function Q(a, x) = 1 − P(a, x), for a > 0 and x ≥ 0; not a number elsewhere.
///
/// A series below x = a + 1, a continued fraction above (Abramowitz and Stegun 6.5.29 and 6.5.31).
pub fn regularized_gamma_q(a: f64, x: f64) -> f64 {
    if !(a > 0.0 && x >= 0.0) {
        return f64::NAN;
    }
    if x == 0.0 || x.is_infinite() {
        return if x == 0.0 { 1.0 } else { 0.0 };
    }
    let front = libm::exp(a * libm::log(x) - x - libm::lgamma(a));
    if x < a + 1.0 {
        let (mut term, mut sum) = (1.0 / a, 1.0 / a);
        for n in 1..MOST_TERMS {
            term *= x / (a + f64::from(n));
            sum += term;
            if term < sum * f64::EPSILON {
                break;
            }
        }
        1.0 - sum * front
    } else {
        let mut b = x + 1.0 - a;
        let (mut c, mut d) = (1.0 / TINY, 1.0 / b);
        let mut fraction = d;
        for n in 1..MOST_TERMS {
            let n = f64::from(n);
            let numerator = n * (a - n);
            b += 2.0;
            d = 1.0 / clear(numerator * d + b);
            c = clear(b + numerator / c);
            fraction *= c * d;
            if (c * d - 1.0).abs() < 2.0 * f64::EPSILON {
                break;
            }
        }
        fraction * front
    }
}

/// The regularised incomplete beta function I_x(a, b), for a, b > 0 and x in [0, 1]; not a number elsewhere.
///
/// The continued fraction of Abramowitz and Stegun 26.5.8, from whichever end converges fast.
pub fn regularized_beta(x: f64, a: f64, b: f64) -> f64 {
    if !(a > 0.0 && b > 0.0 && (0.0..=1.0).contains(&x)) {
        return f64::NAN;
    }
    if x == 0.0 || x == 1.0 {
        return x;
    }
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - regularized_beta_below(1.0 - x, b, a);
    }
    regularized_beta_below(x, a, b)
}

fn regularized_beta_below(x: f64, a: f64, b: f64) -> f64 {
    let logarithm = libm::lgamma(a + b) - libm::lgamma(a) - libm::lgamma(b);
    let front = libm::exp(logarithm + a * libm::log(x) + b * libm::log1p(-x)) / a;
    let (mut c, mut d) = (1.0, 1.0 / clear(1.0 - (a + b) * x / (a + 1.0)));
    let mut fraction = d;
    for n in 1..MOST_TERMS {
        let m = f64::from(n);
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        d = 1.0 / clear(1.0 + even * d);
        c = clear(1.0 + even / c);
        fraction *= c * d;
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        d = 1.0 / clear(1.0 + odd * d);
        c = clear(1.0 + odd / c);
        fraction *= c * d;
        if (c * d - 1.0).abs() < 2.0 * f64::EPSILON {
            break;
        }
    }
    front * fraction
}

fn clear(value: f64) -> f64 {
    if value.abs() < TINY { TINY } else { value }
}

/// Probability that χ² with these degrees of freedom exceeds `statistic`.
pub fn chi_square_tail(statistic: f64, degrees: f64) -> f64 {
    regularized_gamma_q(0.5 * degrees, 0.5 * statistic)
}

/// The distribution function of Student's t with a positive number of degrees of freedom.
pub fn student_cumulative(t: f64, degrees: f64) -> f64 {
    let tail = 0.5 * regularized_beta(degrees / (degrees + t * t), 0.5 * degrees, 0.5);
    if t > 0.0 { 1.0 - tail } else { tail }
}

/// The value that Student's t stays below with this probability; infinite at 0 and 1, not a number outside.
pub fn student_quantile(probability: f64, degrees: f64) -> f64 {
    if !((0.0..=1.0).contains(&probability) && degrees > 0.0) {
        return f64::NAN;
    }
    if probability == 0.5 {
        return 0.0;
    }
    // Bisection of the upper tail, whose digits do not cancel.
    let upper = probability.min(1.0 - probability);
    if upper == 0.0 {
        return if probability == 0.0 { f64::NEG_INFINITY } else { f64::INFINITY };
    }
    let tail = |t: f64| 0.5 * regularized_beta(degrees / (degrees + t * t), 0.5 * degrees, 0.5);
    let (mut low, mut high) = (0.0, 1.0);
    while tail(high) > upper && high < 1e300 {
        low = high;
        high *= 2.0;
    }
    for _ in 0..64 {
        let middle = 0.5 * (low + high);
        if tail(middle) > upper {
            low = middle;
        } else {
            high = middle;
        }
    }
    let magnitude = 0.5 * (low + high);
    if probability < 0.5 { -magnitude } else { magnitude }
}

#[cfg(test)]
mod tests {
    use statrs::distribution::{ContinuousCDF, StudentsT};
    use statrs::function::{beta, gamma};

    use super::*;

    #[test]
    fn gamma_agrees_with_a_reference() {
        for a in [0.5, 1.0, 2.5, 10.0, 77.0, 500.0, 5000.0] {
            for factor in [0.01, 0.3, 0.8, 0.99, 1.0, 1.01, 1.2, 2.0, 5.0] {
                let x = a * factor;
                let (own, reference) = (regularized_gamma_q(a, x), gamma::gamma_ur(a, x));
                assert!((own - reference).abs() < 1e-11, "Q({a}, {x}) = {own}, {reference}");
            }
        }
        // Q(1, x) = e^−x, deep in the tail.
        assert!((regularized_gamma_q(1.0, 300.0) / libm::exp(-300.0) - 1.0).abs() < 1e-12);
        assert!(regularized_gamma_q(-1.0, 1.0).is_nan());
    }

    #[test]
    fn beta_and_student_agree_with_a_reference() {
        for a in [0.5, 1.0, 3.0, 50.0] {
            for b in [0.5, 2.0, 20.0] {
                for x in [0.0, 0.01, 0.3, 0.5, 0.9, 1.0] {
                    let (own, reference) = (regularized_beta(x, a, b), beta::beta_reg(a, b, x));
                    assert!((own - reference).abs() < 1e-12, "I_{x}({a}, {b}) = {own}, {reference}");
                }
            }
        }
        for degrees in [1.0, 2.0, 5.0, 30.0, 1e4] {
            let reference = StudentsT::new(0.0, 1.0, degrees).unwrap();
            for t in [-3.0, -0.5, 0.0, 1.0, 4.0] {
                assert!((student_cumulative(t, degrees) - reference.cdf(t)).abs() < 1e-12);
            }
            for p in [0.001, 0.2, 0.5, 0.975, 0.9999] {
                assert!((student_cumulative(student_quantile(p, degrees), degrees) - p).abs() < 1e-12);
            }
        }
        // One degree of freedom is Cauchy's distribution: t = tan(π(p − ½)).
        assert!((student_quantile(0.975, 1.0) - 12.706_204_736_174_7).abs() < 1e-9);
        assert!((student_quantile(0.975, 1e9) - 1.959_964).abs() < 1e-5);
    }
}
