//! The χ² test of counts against expectations.

use super::special::chi_square_tail;

/// Result of a χ² test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChiSquare {
    /// Sum of (observed − expected)²/expected over the pooled cells.
    pub statistic: f64,
    /// Pooled cells less one.
    pub degrees: usize,
    /// Samples in cells where none can be; any makes the probability zero.
    pub impossible: u64,
    /// Probability of a statistic at least as large if the expectations are right.
    pub p_value: f64,
}

/// Pearson's test of counts against expected counts. Cells of expectation below 5 are pooled, smallest first.
///
/// The expectations should add up to the number of samples: the test takes their sum as known and counts one degree of
/// freedom less than cells. A cell whose expectation is not positive must be empty. Too little expected for two pooled cells
/// gives a probability of one: nothing could be tested. The longer of two slices of different lengths is cut.
pub fn chi_square(observed: &[u64], expected: &[f64]) -> ChiSquare {
    let mut cells: Vec<(f64, f64)> = Vec::with_capacity(observed.len());
    let mut impossible = 0;
    for (&count, &expectation) in observed.iter().zip(expected) {
        if expectation > 0.0 {
            cells.push((expectation, count as f64));
        } else {
            impossible += count;
        }
    }
    cells.sort_by(|a, b| a.0.total_cmp(&b.0));

    let (mut statistic, mut pooled_cells) = (0.0, 0usize);
    let (mut pool_expected, mut pool_observed) = (0.0, 0.0);
    let mut remaining: f64 = cells.iter().map(|cell| cell.0).sum();
    for (expectation, count) in cells {
        pool_expected += expectation;
        pool_observed += count;
        remaining -= expectation;
        // The last pool takes what is too little for one of its own.
        let too_little_left = (1e-9..5.0).contains(&remaining);
        if pool_expected >= 5.0 && !too_little_left {
            statistic += (pool_observed - pool_expected) * (pool_observed - pool_expected) / pool_expected;
            pooled_cells += 1;
            (pool_expected, pool_observed) = (0.0, 0.0);
        }
    }
    if pool_expected > 0.0 {
        statistic += (pool_observed - pool_expected) * (pool_observed - pool_expected) / pool_expected;
        pooled_cells += 1;
    }
    let degrees = pooled_cells.saturating_sub(1);
    let p_value = match (impossible, degrees) {
        (0, 0) => 1.0,
        (0, _) => chi_square_tail(statistic, degrees as f64),
        _ => 0.0,
    };
    ChiSquare { statistic, degrees, impossible, p_value }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_statistic() {
        // A die thrown 60 times: statistic 13.4 on 5 degrees has the tail 0.0199.
        let test = chi_square(&[5, 8, 9, 8, 10, 20], &[10.0; 6]);
        assert_eq!((test.statistic, test.degrees, test.impossible), (13.4, 5, 0));
        assert!((test.p_value - 0.019_905_220_334_774_8).abs() < 1e-12, "{}", test.p_value);
    }

    #[test]
    fn small_cells_are_pooled_and_empty_ones_guarded() {
        let test = chi_square(&[2, 3, 10, 0], &[2.5, 2.5, 10.0, 0.0]);
        assert_eq!((test.degrees, test.impossible), (1, 0));
        assert_eq!(test.p_value, 1.0);
        assert_eq!(chi_square(&[5, 10, 1], &[5.0, 11.0, 0.0]).p_value, 0.0);
        assert_eq!(chi_square(&[], &[]).p_value, 1.0);
    }
}
