//! Independent random numbers from a counter.
//!
//! The index is mixed into the key by one round of a 64-bit mixer, and each pair of coordinates leaves through a second
//! round with its own offset. That is SplitMix64 with random access; each output bit depends on every bit of key and
//! index.

use crate::hash;

/// The four coordinates of point `index` under the randomisation `key`, as fractions of 2³².
#[inline]
pub fn words(key: u64, index: u32) -> [u32; 4] {
    let point = hash::combine(key, u64::from(index));
    let first = hash::word(point, 0);
    let second = hash::word(point, 1);
    [(first >> 32) as u32, first as u32, (second >> 32) as u32, second as u32]
}
