//! Rank-1 lattice sequences and multiples of irrational numbers.

use super::blocks::{self, Kernel};
use super::{BELOW_ONE, MOST_DIMENSIONS, unit, unit_64};
use luch_sampling::hash;

/// Generating vector of the lattice sequence: point i is the fraction of φ(i)·z, φ the binary digits of i mirrored.
///
/// The second component is that of Cools, Kuo and Nuyens ("Constructing embedded lattice rules for multivariate integration", 2006,
/// vector `exod2_base2_m20`), for which slopes are known. The others were made for this crate by their construction: component by
/// component, the odd number below 2²⁰ for which the largest ratio, over all N = 2⁶ … 2²⁰, of worst-case error to the least possible
/// at that N is smallest; space of periodic functions with square-integrable first derivatives, product weights 1/j. All
/// ratios are below 1.77.
#[rustfmt::skip]
pub const GENERATING_VECTOR: [u32; MOST_DIMENSIONS] = [
    1, 182_667, 147_913, 64_421, 26_061, 10_079, 50_195, 233_887,
    424_301, 189_809, 292_321, 213_971, 485_717, 109_305, 333_645, 299_347,
    294_311, 389_223, 317_141, 271_287, 106_523, 79_519, 265_097, 184_433,
    380_095, 52_539, 384_813, 464_171, 57_869, 233_529, 16_261, 197_271,
    235_237, 355_361, 177_895, 463_647, 477_819, 376_233, 65_181, 471_513,
    296_509, 110_101, 320_293, 113_907, 522_173, 444_291, 361_625, 509_955,
    162_343, 42_681, 358_341, 409_867, 224_253, 408_797, 487_477, 375_731,
    98_987, 134_859, 45_611, 49_581, 322_581, 263_731, 356_187, 201_593,
];

struct Lattice {
    /// Random shift of each dimension, repeated for a run.
    shifts: Vec<f64>,
    tent: bool,
}

impl Kernel for Lattice {
    fn place(&self, dimension: usize, index: u32) -> u32 {
        index.reverse_bits().wrapping_mul(GENERATING_VECTOR[dimension])
    }

    fn block(&self, dimension: usize, index: u32) -> u32 {
        index.reverse_bits().wrapping_mul(GENERATING_VECTOR[dimension])
    }

    #[inline(always)]
    fn finish(&self, places: &[u32], blocks: &[u32], out: &mut [f64]) {
        // The bits of place and block do not overlap, so their mirrored sum is the sum of their mirrors.
        for (((out, place), block), shift) in out.iter_mut().zip(places).zip(blocks).zip(&self.shifts) {
            let moved = unit(place.wrapping_add(*block)) + shift;
            *out = if moved >= 1.0 { moved - 1.0 } else { moved };
        }
        if self.tent {
            for out in out {
                *out = (1.0 - (2.0 * *out - 1.0).abs()).min(BELOW_ONE);
            }
        }
    }
}

/// The points of the shifted lattice sequence from `first` on, folded by 1 − |2x − 1| if `tent`.
pub(super) fn fill(key: u64, dimensions: usize, first: u64, tent: bool, out: &mut [f64]) {
    let one: Vec<f64> = (0..dimensions).map(|d| unit_64(hash::word(key, d as u64))).collect();
    let shifts = one.repeat(blocks::RUN);
    blocks::fill(&Lattice { shifts, tent }, dimensions, first, out);
}

/// Point i is the fraction of shift + i·(a, a², …, a^d), a the inverse of the positive root of x^(d+1) = x + 1.
///
/// Roberts, "The unreasonable effectiveness of quasirandom sequences" (2018). In one dimension a is the golden ratio's inverse.
pub(super) fn fill_kronecker(key: u64, dimensions: usize, first: u64, out: &mut [f64]) {
    let steps = kronecker_steps(dimensions);
    let mut places: Vec<u64> = steps
        .iter()
        .enumerate()
        .map(|(d, step)| hash::word(key, d as u64).wrapping_add(step.wrapping_mul(first)))
        .collect();
    for point in out.chunks_exact_mut(dimensions) {
        for ((out, place), step) in point.iter_mut().zip(&mut places).zip(&steps) {
            *out = unit_64(*place);
            *place = place.wrapping_add(*step);
        }
    }
}

/// The powers of a as fractions of 2⁶⁴, all bits but the last few right.
pub(super) fn kronecker_steps(dimensions: usize) -> Vec<u64> {
    let high = |x: u64, y: u64| ((u128::from(x) * u128::from(y)) >> 64) as u64;
    let power = |a: u64, exponent: usize| (1..exponent).fold(a, |product, _| high(product, a));
    // a^d + a^(d+1) = 1: bisection, bit by bit.
    let mut root = 0u64;
    for bit in (0..64).rev() {
        let candidate = root | 1 << bit;
        let sum = u128::from(power(candidate, dimensions)) + u128::from(power(candidate, dimensions + 1));
        if sum <= u128::from(u64::MAX) {
            root = candidate;
        }
    }
    (1..=dimensions).map(|exponent| power(root, exponent)).collect()
}
