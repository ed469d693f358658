//! Ranks of matrices of bits.

use super::tail::chi_square_two_sided;
use super::{Part, TestResult};
use crate::generator::Stream;
use luch_sampling::check::chi_square;

/// Builds `count` square matrices of `size` × `size` bits, one from each output's part (its lowest bit), and compares their ranks with
/// the law of random matrices (Marsaglia and Tsay 1985). Size at most 4096.
///
/// Generators that are linear over two elements, and low bits of congruences, do not reach full rank.
pub fn matrix_rank(stream: &mut Stream, part: Part, size: usize, count: u64) -> TestResult {
    let size = size.clamp(2, 4096);
    // Full rank, one less, two less, fewer.
    let mut cells = [0u64; 4];
    for _ in 0..count {
        let mut rows: Vec<Vec<u64>> = vec![vec![0; size.div_ceil(64)]; size];
        for row in &mut rows {
            for bit in 0..size {
                row[bit / 64] |= (part.next(stream) & 1) << (bit % 64);
            }
        }
        cells[(size - rank(&mut rows, size)).min(3)] += 1;
    }
    let probabilities = law(size);
    let expected = probabilities.map(|p| p * count as f64);
    let test = chi_square(&cells, &expected);
    TestResult {
        statistic: test.statistic,
        expected: test.degrees as f64,
        p_value: chi_square_two_sided(test.statistic, test.degrees as f64),
        numbers: count * (size * size) as u64,
    }
}

/// Rank by elimination.
fn rank(rows: &mut [Vec<u64>], size: usize) -> usize {
    let mut rank = 0;
    for bit in 0..size {
        let (word, mask) = (bit / 64, 1u64 << (bit % 64));
        let Some(pivot) = (rank..rows.len()).find(|&row| rows[row][word] & mask != 0) else { continue };
        rows.swap(rank, pivot);
        let (done, rest) = rows.split_at_mut(rank + 1);
        for row in rest.iter_mut().filter(|row| row[word] & mask != 0) {
            row.iter_mut().zip(&done[rank]).for_each(|(to, from)| *to ^= from);
        }
        rank += 1;
    }
    rank
}

/// Probabilities that a random n × n matrix of bits lacks 0, 1, 2, more than 2 of full rank:
/// P(n − s) = 2^(−s²) Π_{i=0}^{n−s−1} (1 − 2^(i−n))² / (1 − 2^(i−n+s)).
fn law(size: usize) -> [f64; 4] {
    let n = size as i32;
    let with = |s: i32| {
        let factors = (0..n - s).map(|i| {
            let over = 1.0 - libm::ldexp(1.0, i - n);
            over * over / (1.0 - libm::ldexp(1.0, i - n + s))
        });
        libm::ldexp(factors.product::<f64>(), -s * s)
    };
    let [full, one, two] = [with(0), with(1), with(2)];
    [full, one, two, 1.0 - full - one - two]
}
