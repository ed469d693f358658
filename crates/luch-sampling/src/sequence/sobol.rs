//! Sobol' points in four dimensions with Owen scrambling by hashing.
//!
//! The points are a (t, 4)-sequence in base 2: any aligned block of 2^m indices is spread evenly over the dyadic boxes.
//! A nested uniform scramble (Owen 1995) makes each point uniform, keeps that evenness and brings the error of smooth
//! integrands from 1/N to about N^−3/2; here it is done by a hash of a few multiplications (Burley, "Practical hash-based
//! Owen scrambling", 2020). The order is shuffled by the same scramble of the index, so that groups with different keys can
//! be padded side by side. Nothing is tuned to a number of points, and all 32 bits of the index count.

use super::sobol_table::{DIRECTIONS, REVERSED, REVERSED_BITS};
use crate::hash;

/// Point `index` of the plain sequence (in natural, not Gray-code order) as fractions of 2³².
pub fn point(index: u32) -> [u32; 4] {
    let mut result = [0; 4];
    let mut rest = index;
    while rest != 0 {
        let direction = DIRECTIONS[rest.trailing_zeros() as usize];
        for dimension in 0..4 {
            result[dimension] ^= direction[dimension];
        }
        rest &= rest - 1;
    }
    result
}

/// Point `index` with Owen scrambling by hashing, in plain order; each dimension has its own scramble.
pub fn scrambled(index: u32, seed: u64) -> [u32; 4] {
    let [first, second] = [hash::word(seed, 0), hash::word(seed, 1)];
    let seeds = [first as u32, (first >> 32) as u32, second as u32, (second >> 32) as u32];
    let plain = point(index);
    std::array::from_fn(|d| hash::nested_scramble(plain[d], seeds[d]))
}

/// Point `index` with an exact nested uniform scramble, one hash per node of the binary tree: the slow reference.
pub fn owen_exact(index: u32, seed: u64) -> [u32; 4] {
    let plain = point(index);
    std::array::from_fn(|dimension| {
        let tree = hash::word(seed, dimension as u64);
        let mut flips = 0u32;
        for bit in (0..32).rev() {
            // The node is named by the bits above, with a leading one for its depth.
            let node = (1u64 << (31 - bit)) | (u64::from(plain[dimension]) >> bit >> 1);
            flips |= ((hash::combine(tree, node) >> 63) as u32) << bit;
        }
        plain[dimension] ^ flips
    })
}

/// The four coordinates of point `index` under the randomisation `key`, shuffled and scrambled, as fractions of 2³².
#[inline]
pub fn words(key: u64, index: u32) -> [u32; 4] {
    // The key is a hash already, so its low half may shuffle.
    let [first, second] = [hash::word(key, 0), hash::word(key, 1)];
    let seeds = [first as u32, (first >> 32) as u32, second as u32, (second >> 32) as u32];
    // A scramble is a hash between two reversals; the tables take and give reversed words, so the inner ones vanish.
    let shuffled = hash::laine_karras(index.reverse_bits(), key as u32);
    let mut point = [0; 4];
    for (nibble, table) in REVERSED.iter().enumerate() {
        let entry = &table[(shuffled >> (4 * nibble)) as usize & 15];
        for dimension in 0..4 {
            point[dimension] ^= entry[dimension];
        }
    }
    std::array::from_fn(|d| hash::laine_karras(point[d], seeds[d]).reverse_bits())
}

/// [`words`] of sixteen keys and indices, `[coordinate][lane]`: the same bits, by vector instructions where there are some.
#[inline(always)]
pub(crate) fn words_16(keys: &[u64; 16], indices: &[u32; 16]) -> [[u32; 16]; 4] {
    let mut shuffled = [0u32; 16];
    let mut seeds = [[0u32; 16]; 4];
    for lane in 0..16 {
        let [first, second] = [hash::word(keys[lane], 0), hash::word(keys[lane], 1)];
        seeds[0][lane] = first as u32;
        seeds[1][lane] = (first >> 32) as u32;
        seeds[2][lane] = second as u32;
        seeds[3][lane] = (second >> 32) as u32;
        shuffled[lane] = hash::laine_karras(reverse(indices[lane]), keys[lane] as u32);
    }
    // Bit by bit instead of by table: no lane looks anything up.
    let mut points = [[0u32; 16]; 4];
    for (bit, columns) in REVERSED_BITS.iter().enumerate() {
        for lane in 0..16 {
            let mask = 0u32.wrapping_sub((shuffled[lane] >> bit) & 1);
            for dimension in 0..4 {
                points[dimension][lane] ^= columns[dimension] & mask;
            }
        }
    }
    for dimension in 0..4 {
        for lane in 0..16 {
            points[dimension][lane] =
                reverse(hash::laine_karras(points[dimension][lane], seeds[dimension][lane]));
        }
    }
    points
}

/// The bits of a word in the opposite order, by steps that vectors have.
#[inline(always)]
fn reverse(word: u32) -> u32 {
    let word = (word >> 1 & 0x5555_5555) | (word & 0x5555_5555) << 1;
    let word = (word >> 2 & 0x3333_3333) | (word & 0x3333_3333) << 2;
    let word = (word >> 4 & 0x0f0f_0f0f) | (word & 0x0f0f_0f0f) << 4;
    word.swap_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_points_by_hand() {
        let fractions = |index| point(index).map(|v| f64::from(v) / 4_294_967_296.0);
        assert_eq!(fractions(0), [0.0; 4]);
        assert_eq!(fractions(1), [0.5; 4]);
        assert_eq!(fractions(2), [0.25, 0.75, 0.75, 0.75]);
        assert_eq!(fractions(3), [0.75, 0.25, 0.25, 0.25]);
    }

    #[test]
    fn words_is_shuffle_then_scramble() {
        for index in (0..1000).chain([1 << 20, u32::MAX]) {
            let key = hash::mix64(12_345);
            let shuffled = hash::nested_scramble(index, key as u32);
            assert_eq!(words(key, index), scrambled(shuffled, key));
        }
    }
}
