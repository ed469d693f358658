//! An integrand that one generator cannot see.

use super::TestResult;
use super::tail::normal_two_sided;
use crate::generator::Stream;
use std::f64::consts::PI;

/// cos²(π(9x − 6y + z)): mean ½ and variance ⅛ over the unit cube, and 1 on every plane of RANDU.
pub fn killer_integrand(point: [f64; 3]) -> f64 {
    let cosine = libm::cos(PI * (9.0 * point[0] - 6.0 * point[1] + point[2]));
    cosine * cosine
}

/// The mean of [`killer_integrand`] over `count` triples, against ½.
pub fn killer(stream: &mut Stream, count: u64) -> TestResult {
    let mut sum = 0.0;
    for _ in 0..count {
        sum += killer_integrand([stream.unit_f64(), stream.unit_f64(), stream.unit_f64()]);
    }
    let mean = sum / count.max(1) as f64;
    let z = (mean - 0.5) * (8.0 * count as f64).sqrt();
    TestResult { statistic: mean, expected: 0.5, p_value: normal_two_sided(z), numbers: 3 * count }
}
