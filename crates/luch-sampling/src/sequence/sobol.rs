//! Sobol' points in four dimensions with Owen scrambling by hashing.
//!
//! The points are a (t, 4)-sequence in base 2: any aligned block of 2^m indices is spread evenly over the dyadic boxes.
//! A nested uniform scramble (Owen 1995) makes each point uniform, keeps that evenness and brings the error of smooth
//! integrands from 1/N to about N^−3/2; here it is done by a hash of a few multiplications (Burley, "Practical hash-based
//! Owen scrambling", 2020). The order is shuffled by the same scramble of the index, so that groups with different keys can
//! be padded side by side. Nothing is tuned to a number of points, and all 32 bits of the index count.

use super::sobol_table::{DIRECTIONS, REVERSED};
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
