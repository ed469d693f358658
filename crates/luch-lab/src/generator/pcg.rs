//! Permuted congruential generators (O'Neill, "PCG: a family of simple fast space-efficient statistically good algorithms").

use super::shift::SplitMix64;
use super::stream::Source;

/// PCG-XSH-RR 64/32: the highest bits of the state choose how far others are rotated.
#[derive(Clone, Debug)]
pub(super) struct Pcg32 {
    state: u64,
    increment: u64,
}

impl Pcg32 {
    /// As `pcg32_srandom_r`.
    pub(super) fn new(seed: u64, stream: u64) -> Pcg32 {
        let mut generator = Pcg32 { state: 0, increment: stream << 1 | 1 };
        generator.next();
        generator.state = generator.state.wrapping_add(seed);
        generator.next();
        generator
    }
}

impl Source for Pcg32 {
    #[inline(always)]
    fn next(&mut self) -> u64 {
        let old = self.state;
        self.state = old.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(self.increment);
        let mixed = ((old >> 18 ^ old) >> 27) as u32;
        u64::from(mixed.rotate_right((old >> 59) as u32))
    }
}

/// 128 bits of state, a multiplier of 64 bits, and the output "double xorshift multiply".
#[derive(Clone, Debug)]
pub(super) struct Pcg64Dxsm {
    pub(super) state: u128,
    pub(super) increment: u128,
}

impl Pcg64Dxsm {
    const MULTIPLIER: u64 = 0xda94_2042_e4dd_58b5;

    pub(super) fn from_seed(seed: u64) -> Pcg64Dxsm {
        let mut fill = SplitMix64::new(seed);
        let mut wide = || u128::from(fill.next()) << 64 | u128::from(fill.next());
        Pcg64Dxsm { state: wide(), increment: wide() | 1 }
    }
}

impl Source for Pcg64Dxsm {
    #[inline(always)]
    fn next(&mut self) -> u64 {
        let mut high = (self.state >> 64) as u64;
        let low = self.state as u64 | 1;
        high ^= high >> 32;
        high = high.wrapping_mul(Self::MULTIPLIER);
        high ^= high >> 48;
        self.state = self.state.wrapping_mul(u128::from(Self::MULTIPLIER)).wrapping_add(self.increment);
        high.wrapping_mul(low)
    }
}
