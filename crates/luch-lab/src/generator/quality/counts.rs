//! Tests that count: values, pairs, gaps.

use super::tail::chi_square_two_sided;
use super::{Part, TestResult};
use crate::generator::Stream;
use luch_sampling::check::{ChiSquare, chi_square};

fn result(test: ChiSquare, numbers: u64) -> TestResult {
    let degrees = test.degrees as f64;
    TestResult {
        statistic: test.statistic,
        expected: degrees,
        p_value: chi_square_two_sided(test.statistic, degrees),
        numbers,
    }
}

/// χ² of `count` numbers in 2^bits cells of equal width, by their highest bits; bits at most 15.
pub fn uniformity(stream: &mut Stream, count: u64, bits: u32) -> TestResult {
    let bits = bits.clamp(1, 15);
    let mut cells = vec![0u64; 1 << bits];
    for _ in 0..count {
        cells[Part::High(bits).next(stream) as usize] += 1;
    }
    let expected = vec![count as f64 / cells.len() as f64; cells.len()];
    result(chi_square(&cells, &expected), count)
}

/// χ² of `count` pairs of successive numbers, not overlapping, in 2^bits × 2^bits cells; bits at most 10.
pub fn serial_pairs(stream: &mut Stream, count: u64, bits: u32) -> TestResult {
    let part = Part::High(bits.clamp(1, 10));
    let mut cells = vec![0u64; (part.values() * part.values()) as usize];
    for _ in 0..count {
        let first = part.next(stream) as usize;
        cells[first * part.values() as usize + part.next(stream) as usize] += 1;
    }
    let expected = vec![count as f64 / cells.len() as f64; cells.len()];
    result(chi_square(&cells, &expected), 2 * count)
}

/// Gap test (Kendall and Babington Smith 1939): how many numbers pass until the bits looked at are zero again, over `count` gaps.
///
/// A gap ends at the latest after 64 times its expected length, so that a generator that never gets there fails and ends.
pub fn gap(stream: &mut Stream, part: Part, count: u64) -> TestResult {
    let hit = 1.0 / part.values();
    // Lengths with an expectation of ten or more have a cell of their own.
    let classes =
        (libm::log(10.0 / (count as f64 * hit)) / libm::log1p(-hit)).clamp(1.0, 65_536.0).ceil() as usize;
    let longest = (64.0 / hit).max(classes as f64) as u64;
    let mut cells = vec![0u64; classes + 1];
    let mut numbers = 0;
    for _ in 0..count {
        let mut length = 0;
        while length < longest && part.next(stream) != 0 {
            length += 1;
        }
        numbers += length + 1;
        cells[(length as usize).min(classes)] += 1;
    }
    let miss = |length: usize| libm::exp(length as f64 * libm::log1p(-hit));
    let mut expected: Vec<f64> = (0..classes).map(|length| count as f64 * hit * miss(length)).collect();
    expected.push(count as f64 * miss(classes));
    result(chi_square(&cells, &expected), numbers)
}
