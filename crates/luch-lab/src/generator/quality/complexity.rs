//! Linear complexity: the shortest linear recurrence over two elements that makes a sequence of bits.

use super::tail::two_sided;
use super::{Part, TestResult};
use crate::generator::Stream;

/// Length of the shortest linear feedback register that makes these bits (Berlekamp 1968, Massey 1969), 64 bits a step.
pub fn berlekamp_massey(bits: &[bool]) -> usize {
    let words = bits.len() / 64 + 2;
    // Connection polynomials, lowest power first, and the bits seen so far, latest first.
    let (mut current, mut previous) = (vec![0u64; words], vec![0u64; words]);
    (current[0], previous[0]) = (1, 1);
    let mut seen = vec![0u64; words];
    let (mut length, mut gap) = (0usize, 1usize);
    for (n, &bit) in bits.iter().enumerate() {
        let used = length / 64 + 1;
        shift_in(&mut seen[..n / 64 + 1], bit);
        let discrepancy =
            current[..used].iter().zip(&seen).fold(0, |sum, (c, s)| sum ^ (c & s)).count_ones() % 2;
        if discrepancy == 0 {
            gap += 1;
        } else if 2 * length <= n {
            let kept = current.clone();
            add_shifted(&mut current, &previous, gap);
            length = n + 1 - length;
            previous = kept;
            gap = 1;
        } else {
            add_shifted(&mut current, &previous, gap);
            gap += 1;
        }
    }
    length
}

/// Moves all bits up by one and puts a new one below.
fn shift_in(words: &mut [u64], bit: bool) {
    let mut carry = u64::from(bit);
    for word in words {
        let next = *word >> 63;
        *word = *word << 1 | carry;
        carry = next;
    }
}

/// Adds a polynomial times a power.
fn add_shifted(to: &mut [u64], from: &[u64], shift: usize) {
    let (words, bits) = (shift / 64, shift % 64);
    if words >= to.len() {
        return;
    }
    let mut carry = 0;
    for (to, &from) in to[words..].iter_mut().zip(from) {
        *to ^= from << bits | carry;
        carry = if bits == 0 { 0 } else { from >> (64 - bits) };
    }
}

/// Linear complexity of `count` bits, the lowest of each output's part, at most 2²⁰ of them. Random bits need a recurrence of half their
/// number, give or take two; linear generators never more than their state has bits.
pub fn linear_complexity(stream: &mut Stream, part: Part, count: usize) -> TestResult {
    let count = count.clamp(2, 1 << 20);
    let bits: Vec<bool> = (0..count).map(|_| part.next(stream) & 1 == 1).collect();
    let length = berlekamp_massey(&bits);
    TestResult {
        statistic: length as f64,
        expected: count as f64 / 2.0 + if count.is_multiple_of(2) { 2.0 } else { 2.5 } / 9.0,
        p_value: two_sided(lower(length, count), upper(length, count)),
        numbers: count as u64,
    }
}

/// Logarithm base 2 of the share of sequences of `count` bits with complexity `length` (Rueppel 1986):
/// 2^min(2(count − length), 2·length − 1) of 2^count.
fn log_share(length: usize, count: usize) -> f64 {
    let (length, count) = (length as f64, count as f64);
    if length == 0.0 { -count } else { (2.0 * (count - length)).min(2.0 * length - 1.0) - count }
}

fn share(length: usize, count: usize) -> f64 {
    libm::exp2(log_share(length, count).max(-1074.0))
}

/// Probability of this complexity or less. Shares change by a factor of four, so a few dozen terms are all there is.
fn lower(length: usize, count: usize) -> f64 {
    (0..=length)
        .rev()
        .take(count / 2 + 64)
        .take_while(|&l| l + 64 > length || share(l, count) > 1e-20)
        .map(|l| share(l, count))
        .sum::<f64>()
        .min(1.0)
}

/// Probability of this complexity or more.
fn upper(length: usize, count: usize) -> f64 {
    (length..=count)
        .take_while(|&l| l < length + 64 || share(l, count) > 1e-20)
        .map(|l| share(l, count))
        .sum::<f64>()
        .min(1.0)
}
