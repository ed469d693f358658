//! Halton's sequence in bases 2, 3, 5, 7, randomised by nested digit scrambling.
//!
//! A coordinate is the index written in its base, mirrored at the point. Each digit is permuted by a random map that
//! depends on all digits before it (Owen 1995). The maps are affine, d ↦ a·d + b modulo the base with a ≠ 0: for a prime
//! base any two digits then land on every pair of different digits equally often, and more than that the variance of a
//! scrambled sequence does not ask for. The order is shuffled in base 2, so a power-of-two prefix stays a run of
//! consecutive indices, which is a good set in every base.

use crate::hash;

/// The four coordinates of point `index` under the randomisation `key`, as fractions of 2³².
///
/// Digits finer than 2⁻²⁴ are random fill.
#[inline]
pub fn words(key: u64, index: u32) -> [u32; 4] {
    let shuffled = hash::nested_scramble(index, key as u32);
    [
        hash::nested_scramble(shuffled.reverse_bits(), hash::word(key, 0) as u32),
        scrambled::<3, 16>(shuffled, hash::word(key, 1)),
        scrambled::<5, 11>(shuffled, hash::word(key, 2)),
        scrambled::<7, 9>(shuffled, hash::word(key, 3)),
    ]
}

/// The plain radical inverse of `index` in a base of at least 2: its digits mirrored at the point.
pub fn radical_inverse(base: u32, index: u32) -> f64 {
    let (mut digits, mut denominator, mut rest) = (0u64, 1u64, index);
    let base = base.max(2);
    while rest > 0 {
        digits = digits * u64::from(base) + u64::from(rest % base);
        denominator *= u64::from(base);
        rest /= base;
    }
    digits as f64 / denominator as f64
}

/// The first four coordinates of the plain sequence.
pub fn point(index: u32) -> [f64; 4] {
    [2, 3, 5, 7].map(|base| radical_inverse(base, index))
}

/// The radical inverse with `DIGITS` nested random digits and random fill below them, as a fraction of 2³².
#[inline]
fn scrambled<const BASE: u32, const DIGITS: u32>(index: u32, seed: u64) -> u32 {
    let maps = const { &affine_maps::<BASE>() };
    let (mut rest, mut prefix, mut power, mut digits) = (index, 0u32, 1u32, 0u32);
    for depth in 0..DIGITS {
        // The node of the tree is named by the digits before this one, and by how many they are. Naming it by the plain
        // digits instead of the permuted ones is the same tree, and leaves the hashes independent of one another.
        let node = u64::from(depth) << 32 | u64::from(prefix);
        let random = hash::word(seed, node) >> 32;
        let map = ((random * u64::from(BASE * (BASE - 1))) >> 32) as usize;
        let digit = rest % BASE;
        digits = digits * BASE + u32::from(maps[map][digit as usize]);
        prefix += digit * power;
        power *= BASE;
        rest /= BASE;
    }
    // The cell is [digits, digits + 1) / base^DIGITS; the whole index chooses the fill.
    let fill = hash::word(seed, u64::from(DIGITS) << 32 | u64::from(index)) >> 32;
    // (digits + fill/2³²) / cells in units of 2⁻³², rounded down: at most 2³² − 1.
    ((u64::from(digits) << 32 | fill) / u64::from(power)) as u32
}

/// All maps d ↦ a·d + b modulo a prime base up to 7, with a ≠ 0, as tables.
const fn affine_maps<const BASE: u32>() -> [[u8; 7]; 42] {
    let mut maps = [[0; 7]; 42];
    let mut map = 0;
    while map < BASE * (BASE - 1) {
        let mut digit = 0;
        while digit < BASE {
            maps[map as usize][digit as usize] = (((map / BASE + 1) * digit + map % BASE) % BASE) as u8;
            digit += 1;
        }
        map += 1;
    }
    maps
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_values() {
        assert_eq!(point(0), [0.0; 4]);
        assert_eq!(radical_inverse(2, 6), 0.375);
        assert_eq!(radical_inverse(3, 5), 7.0 / 9.0);
        assert_eq!(radical_inverse(10, 1234), 0.4321);
    }

    #[test]
    fn scrambled_digits_stay_a_sequence_in_their_base() {
        fn check<const BASE: u32, const DIGITS: u32>() {
            let mut cells = 1u32;
            while cells < 2000 {
                cells *= BASE;
                for start in [0, cells, 5 * cells] {
                    let mut seen = vec![0; cells as usize];
                    for index in start..start + cells {
                        let value = u64::from(scrambled::<BASE, DIGITS>(index, 7));
                        seen[((value * u64::from(cells)) >> 32) as usize] += 1;
                    }
                    // Rounding to 2⁻³² may carry a point on a cell's lower edge into the cell below; it is rare.
                    let wrong = seen.iter().filter(|&&count| count != 1).count();
                    assert_eq!(wrong, 0, "base {BASE}, {cells} cells from {start}");
                }
            }
        }
        check::<3, 16>();
        check::<5, 11>();
        check::<7, 9>();
    }
}
