//! Halton's sequence in the first 64 prime bases, plain, shifted and scrambled, in bulk.
//!
//! The low digits of the index, mirrored, are read from a table of some thousand entries; the high digits change rarely.

use super::{BELOW_ONE, Design, MOST_DIMENSIONS, unit_64};
use luch_sampling::hash;

/// The bases.
const PRIMES: [u32; MOST_DIMENSIONS + 1] = primes();

/// Entries of a table of low digits, at most (more if the base itself is larger).
const TABLE: u64 = 4096;

/// Points written before the next dimension is looked at, so that they stay near.
const TILE: usize = 256;

const fn primes() -> [u32; MOST_DIMENSIONS + 1] {
    let mut found = [2; MOST_DIMENSIONS + 1];
    let (mut count, mut candidate) = (1, 3);
    while count < found.len() {
        let mut divisor = 0;
        while divisor < count && candidate % found[divisor] != 0 {
            divisor += 1;
        }
        if divisor == count {
            found[count] = candidate;
            count += 1;
        }
        candidate += 1;
    }
    found
}

/// What is done to the plain points, with the key of the randomisation.
#[derive(Clone, Copy, Debug)]
pub(super) enum Change {
    /// Nothing.
    None,
    /// A random vector is added modulo 1.
    Shift(u64),
    /// Every node of the tree of digits has a random permutation of the digits below it.
    Scramble(u64),
}

/// One coordinate on its way through the indices.
struct Axis {
    base: u32,
    /// Power of the base that the table covers, and its inverse.
    period: u64,
    weight: f64,
    low: Vec<Low>,
    /// Index divided by the period, its remainder, and the digits of the former mirrored (or themselves, for scrambling).
    quotient: u64,
    remainder: usize,
    high: f64,
    digits: Vec<u32>,
    change: Change,
    shift: f64,
    key: u64,
}

/// The low digits of an index, mirrored; for scrambling permuted, with the uniform rest.
#[derive(Clone, Copy)]
struct Low {
    value: f64,
    rest: u64,
}

impl Axis {
    fn new(dimension: usize, first: u64, end: u64, change: Change) -> Axis {
        let base = PRIMES[dimension];
        let mut period = u64::from(base);
        while period * u64::from(base) <= TABLE {
            period *= u64::from(base);
        }
        let weight = 1.0 / period as f64;
        let key = match change {
            Change::None => 0,
            Change::Shift(key) | Change::Scramble(key) => hash::word(key, dimension as u64),
        };
        let shift = if matches!(change, Change::Shift(_)) { unit_64(key) } else { 0.0 };
        let entries = period.min(end);
        let low = (0..entries)
            .map(|index| match change {
                Change::Scramble(_) => scrambled_low(key, base, period, index),
                _ => Low { value: mirrored(base, index), rest: 0 },
            })
            .collect();
        let quotient = first / period;
        let remainder = (first % period) as usize;
        let mut axis = Axis {
            base,
            period,
            weight,
            low,
            quotient,
            remainder,
            high: 0.0,
            digits: Vec::new(),
            change,
            shift,
            key,
        };
        axis.enter();
        axis
    }

    /// Prepares for a new quotient.
    fn enter(&mut self) {
        self.high = mirrored(self.base, self.quotient) * self.weight;
        self.digits.clear();
        let mut rest = self.quotient;
        while rest != 0 {
            self.digits.push((rest % u64::from(self.base)) as u32);
            rest /= u64::from(self.base);
        }
    }

    /// Writes one coordinate of successive points.
    fn write(&mut self, out: &mut [f64], dimension: usize, dimensions: usize) {
        let count = out.len() / dimensions;
        let mut done = 0;
        while done < count {
            let run = (count - done).min(self.period as usize - self.remainder);
            let targets = out[done * dimensions..(done + run) * dimensions].chunks_exact_mut(dimensions);
            let entries = &self.low[self.remainder..self.remainder + run];
            match self.change {
                Change::None => {
                    targets.zip(entries).for_each(|(point, low)| point[dimension] = low.value + self.high);
                }
                Change::Shift(_) => targets.zip(entries).for_each(|(point, low)| {
                    let moved = low.value + self.high + self.shift;
                    point[dimension] = (if moved >= 1.0 { moved - 1.0 } else { moved }).min(BELOW_ONE);
                }),
                Change::Scramble(_) => {
                    for (k, (point, low)) in targets.zip(entries).enumerate() {
                        let prefix = (self.remainder + k) as u64;
                        point[dimension] = self.scrambled(*low, prefix).min(BELOW_ONE);
                    }
                }
            }
            done += run;
            self.remainder += run;
            if self.remainder as u64 == self.period {
                self.remainder = 0;
                self.quotient += 1;
                self.enter();
            }
        }
    }

    /// The low digits followed by the permuted high ones and a uniform rest.
    #[inline(always)]
    fn scrambled(&self, low: Low, prefix: u64) -> f64 {
        let Low { mut value, mut rest } = low;
        let (mut weight, mut node, mut power) = (self.weight, prefix, self.period);
        let step = 1.0 / f64::from(self.base);
        for &digit in &self.digits {
            let wide = u128::from(rest) * u128::from(self.base);
            let mut image = (wide >> 64) as u32;
            rest = wide as u64;
            if digit != 0 {
                image = permuted(self.key, self.base, node + power, digit, image);
                node += u64::from(digit) * power;
                rest = hash::word(self.key, node);
            }
            weight *= step;
            value += f64::from(image) * weight;
            power *= u64::from(self.base);
        }
        value + unit_64(rest) * weight
    }
}

/// Where a digit other than 0 goes, if zero goes to `image_of_zero`: an affine map d ↦ a·d + image with a random a ≠ 0, which sends
/// any two digits to every pair of different ones equally often.
///
/// A branch is named by the index whose digits it spells, without leading zeros: going on by a zero keeps the name and the uniform
/// number that the branch started with, digit by digit. So a point that nothing follows is uniform to the last bit. `sibling` is
/// the name of the branch of digit 1, which all siblings share.
#[inline(always)]
fn permuted(key: u64, base: u32, sibling: u64, digit: u32, image_of_zero: u32) -> u32 {
    let random = hash::word(!key, sibling) >> 32;
    let factor = 1 + ((random * u64::from(base - 1)) >> 32) as u32;
    (factor * digit + image_of_zero) % base
}

/// The permuted low digits of an index below the period, and the uniform rest below them.
fn scrambled_low(key: u64, base: u32, period: u64, index: u64) -> Low {
    let (mut digits, mut power, mut node) = (0u64, 1u64, 0u64);
    let mut rest = hash::word(key, 0);
    let mut left = index;
    while power < period {
        let digit = (left % u64::from(base)) as u32;
        left /= u64::from(base);
        let wide = u128::from(rest) * u128::from(base);
        let mut image = (wide >> 64) as u32;
        rest = wide as u64;
        if digit != 0 {
            image = permuted(key, base, node + power, digit, image);
            node += u64::from(digit) * power;
            rest = hash::word(key, node);
        }
        digits = digits * u64::from(base) + u64::from(image);
        power *= u64::from(base);
    }
    Low { value: digits as f64 / period as f64, rest }
}

/// The digits of an index mirrored at the point.
fn mirrored(base: u32, index: u64) -> f64 {
    let (mut digits, mut denominator, mut rest) = (0u64, 1u64, index);
    while rest > 0 {
        digits = digits * u64::from(base) + rest % u64::from(base);
        denominator *= u64::from(base);
        rest /= u64::from(base);
    }
    digits as f64 / denominator as f64
}

/// The points from `first` on.
pub(super) fn fill(dimensions: usize, first: u64, change: Change, out: &mut [f64]) {
    write_axes(dimensions, 0, dimensions, first, change, out);
}

/// Hammersley's set: i/N, then Halton's coordinates.
pub(super) fn fill_hammersley(design: &Design, first: u64, out: &mut [f64]) {
    for (i, point) in out.chunks_exact_mut(design.dimensions).enumerate() {
        point[0] = (first + i as u64) as f64 / design.count as f64;
    }
    write_axes(design.dimensions, 1, design.dimensions - 1, first, Change::None, out);
}

/// Writes Halton's first `axes` dimensions into the coordinates from `offset` on.
fn write_axes(dimensions: usize, offset: usize, axes: usize, first: u64, change: Change, out: &mut [f64]) {
    let end = first + (out.len() / dimensions) as u64;
    let mut states: Vec<Axis> = (0..axes).map(|d| Axis::new(d, first, end, change)).collect();
    for tile in out.chunks_mut(TILE * dimensions) {
        for (d, axis) in states.iter_mut().enumerate() {
            axis.write(tile, offset + d, dimensions);
        }
    }
}
