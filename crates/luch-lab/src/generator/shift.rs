//! Generators of shifts and additions.

use super::stream::Source;
use luch_sampling::hash;

/// A Weyl counter and a hash.
#[derive(Clone, Debug)]
pub(super) struct SplitMix64 {
    state: u64,
}

impl SplitMix64 {
    pub(super) fn new(seed: u64) -> SplitMix64 {
        SplitMix64 { state: seed }
    }
}

impl Source for SplitMix64 {
    #[inline(always)]
    fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(hash::GOLDEN);
        hash::mix64(self.state)
    }
}

/// Two words; the sum of both is returned.
#[derive(Clone, Debug)]
pub(super) struct Xorshift128Plus {
    pub(super) words: [u64; 2],
}

impl Xorshift128Plus {
    pub(super) fn from_seed(seed: u64) -> Xorshift128Plus {
        let mut fill = SplitMix64::new(seed);
        Xorshift128Plus { words: [fill.next(), fill.next()] }
    }
}

impl Source for Xorshift128Plus {
    #[inline(always)]
    fn next(&mut self) -> u64 {
        let [mut first, second] = self.words;
        let result = first.wrapping_add(second);
        first ^= first << 23;
        self.words = [second, first ^ second ^ first >> 18 ^ second >> 5];
        result
    }
}

/// Four words of a linear engine, scrambled by two additions and a rotation.
#[derive(Clone, Debug)]
pub(super) struct Xoshiro256PlusPlus {
    pub(super) words: [u64; 4],
}

impl Xoshiro256PlusPlus {
    pub(super) fn from_seed(seed: u64) -> Xoshiro256PlusPlus {
        let mut fill = SplitMix64::new(seed);
        Xoshiro256PlusPlus { words: [fill.next(), fill.next(), fill.next(), fill.next()] }
    }
}

impl Source for Xoshiro256PlusPlus {
    #[inline(always)]
    fn next(&mut self) -> u64 {
        let s = &mut self.words;
        let result = s[0].wrapping_add(s[3]).rotate_left(23).wrapping_add(s[0]);
        let shifted = s[1] << 17;
        s[2] ^= s[0];
        s[3] ^= s[1];
        s[1] ^= s[2];
        s[0] ^= s[3];
        s[2] ^= shifted;
        s[3] = s[3].rotate_left(45);
        result
    }
}
