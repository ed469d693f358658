//! Progressive jittered sampling, with no planned count.
//!
//! The index, shuffled and read backwards, is a van der Corput number; a nested scramble permutes it at random, and every
//! two bits of it choose a quadrant, the next two a quadrant of that, and so on (Morton's order of the cells). So the first
//! 4^L points lie one in each cell of the 2^L × 2^L grid, for every L at once, and at random inside their cell. The nested
//! permutation is the binary one: a base-4 permutation whose first choice is a half and whose second a quarter, hence the
//! first 2·4^L points also lie one in each half-cell. The two pairs of a group have independent shuffles and scrambles.

use crate::hash;

/// The four coordinates of point `index` under the randomisation `key`, as fractions of 2³².
#[inline]
pub fn words(key: u64, index: u32) -> [u32; 4] {
    let [x, y] = pair(hash::word(key, 0), hash::word(key, 1), index);
    let [z, w] = pair(hash::word(key, 2), hash::word(key, 3), index);
    [x, y, z, w]
}

/// One pair of coordinates: shuffle, scramble, unfold along Morton's curve, fill the bits below the last cell.
#[inline]
fn pair(seeds: u64, jitter: u64, index: u32) -> [u32; 2] {
    // A shuffled index, left reversed: that is its van der Corput number.
    let mirrored = hash::laine_karras(index.reverse_bits(), seeds as u32);
    let code = hash::nested_scramble(mirrored, (seeds >> 32) as u32);
    let fill = hash::word(jitter, u64::from(index)) as u32;
    [even_bits(code >> 1) << 16 | fill >> 16, even_bits(code) << 16 | fill & 0xffff]
}

/// Gathers the bits at even places into the low half.
#[inline]
const fn even_bits(value: u32) -> u32 {
    let mut v = value & 0x5555_5555;
    v = (v | v >> 1) & 0x3333_3333;
    v = (v | v >> 2) & 0x0f0f_0f0f;
    v = (v | v >> 4) & 0x00ff_00ff;
    (v | v >> 8) & 0x0000_ffff
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_cell_of_every_level_holds_one_point() {
        for key in [1, 99] {
            for level in 1..=6u32 {
                let side = 1usize << level;
                let mut counts = [vec![0; side * side], vec![0; side * side]];
                for index in 0..(side * side) as u32 {
                    let point = words(key, index);
                    for pair in 0..2 {
                        let [column, row] =
                            [0, 1].map(|axis| (point[2 * pair + axis] >> (32 - level)) as usize);
                        counts[pair][row * side + column] += 1;
                    }
                }
                assert!(counts.iter().flatten().all(|&count| count == 1), "level {level}");
            }
        }
    }

    #[test]
    fn even_bits_gathers() {
        assert_eq!(even_bits(0x5555_5555), 0xffff);
        assert_eq!(even_bits(0b1_0100), 0b110);
    }
}
