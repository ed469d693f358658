//! Birthday spacings: points of a lattice keep equal distances too often.

use super::tail::poisson_two_sided;
use super::{Part, TestResult};
use crate::generator::Stream;

/// Parameters of the test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BirthdaySpacings {
    /// Numbers that make a point.
    pub dimensions: u32,
    /// Highest bits taken of each; with the dimensions at most 63 bits.
    pub bits: u32,
    /// Points of a round.
    pub points: usize,
    /// Rounds, added up.
    pub rounds: u32,
}

/// Cuts the cube into cells, sorts the numbers of the cells of all points, and counts equal ones among the sorted differences
/// (Marsaglia 1985). The count is nearly Poisson with mean rounds · n³/(4k), k the number of cells (L'Ecuyer and Simard 2001).
///
/// Points are at most 2²⁴, and bits past 63 in all are left out.
pub fn birthday_spacings(stream: &mut Stream, parameters: BirthdaySpacings) -> TestResult {
    let dimensions = parameters.dimensions.clamp(1, 63);
    let bits = parameters.bits.clamp(1, 63 / dimensions).min(32);
    let points = parameters.points.clamp(2, 1 << 24);
    let mut days = Vec::with_capacity(points);
    let mut equal = 0u64;
    for _ in 0..parameters.rounds {
        days.clear();
        days.extend(
            (0..points)
                .map(|_| (0..dimensions).fold(0, |day, _| day << bits | Part::High(bits).next(stream))),
        );
        days.sort_unstable();
        for i in (1..points).rev() {
            days[i] -= days[i - 1];
        }
        // The first day itself is no spacing.
        let spacings = &mut days[1..];
        spacings.sort_unstable();
        equal += spacings.windows(2).filter(|pair| pair[0] == pair[1]).count() as u64;
    }
    let n = points as f64;
    let mean = f64::from(parameters.rounds) * n * n * n * libm::ldexp(0.25, -((dimensions * bits) as i32));
    TestResult {
        statistic: equal as f64,
        expected: mean,
        p_value: poisson_two_sided(equal, mean),
        numbers: u64::from(parameters.rounds) * points as u64 * u64::from(dimensions),
    }
}
