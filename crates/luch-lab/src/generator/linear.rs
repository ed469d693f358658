//! Linear congruences: x ← a·x + c mod m.

use super::Generator;
use super::stream::Source;

/// The numbers that define a linear congruence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lcg {
    /// Factor a.
    pub multiplier: u64,
    /// Addend c.
    pub increment: u64,
    /// Modulus m, at most 2⁶⁴.
    pub modulus: u128,
    /// Modulus of the lattice that the tuples fill: m, but m/4 for RANDU, whose odd seeds have a quarter of the period
    /// (Knuth, TAOCP 2, 3.3.4).
    pub lattice_modulus: u128,
}

pub(super) const fn congruence(generator: Generator) -> Option<Lcg> {
    let (multiplier, increment, modulus) = match generator {
        Generator::Randu => (65_539, 0, 1 << 31),
        Generator::AnsiC => (1_103_515_245, 12_345, 1 << 31),
        Generator::Msvc => (214_013, 2_531_011, 1 << 32),
        Generator::Minstd16807 => (16_807, 0, (1 << 31) - 1),
        Generator::Minstd48271 => (48_271, 0, (1 << 31) - 1),
        Generator::Drand48 => (25_214_903_917, 11, 1 << 48),
        Generator::Lcg32 => (1_664_525, 1_013_904_223, 1 << 32),
        Generator::Lcg64 => (6_364_136_223_846_793_005, 1_442_695_040_888_963_407, 1 << 64),
        _ => return None,
    };
    let lattice_modulus = if matches!(generator, Generator::Randu) { modulus / 4 } else { modulus };
    Some(Lcg { multiplier, increment, modulus, lattice_modulus })
}

/// A congruence modulo a power of two, of which a run of bits is returned.
#[derive(Clone, Debug)]
pub(super) struct PowerOfTwo {
    state: u64,
    multiplier: u64,
    increment: u64,
    mask: u64,
    /// Bits cut off at the low end, and what of the rest is kept.
    shift: u32,
    kept: u64,
}

impl PowerOfTwo {
    pub(super) fn new(generator: Generator, seed: u64) -> PowerOfTwo {
        let lcg = congruence(generator).unwrap_or(Lcg {
            multiplier: 1,
            increment: 0,
            modulus: 1,
            lattice_modulus: 1,
        });
        let mask = (lcg.modulus - 1) as u64;
        let (state, shift, kept) = match generator {
            Generator::Randu => (seed | 1, 0, mask),
            Generator::Msvc => (seed, 16, 0x7fff),
            // srand48 puts 32 bits of the seed above this constant.
            Generator::Drand48 => (seed << 16 | 0x330e, 0, mask),
            _ => (seed, 0, mask),
        };
        PowerOfTwo {
            state: state & mask,
            multiplier: lcg.multiplier,
            increment: lcg.increment,
            mask,
            shift,
            kept,
        }
    }
}

impl Source for PowerOfTwo {
    #[inline(always)]
    fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_mul(self.multiplier).wrapping_add(self.increment) & self.mask;
        self.state >> self.shift & self.kept
    }
}

/// A multiplicative congruence modulo the prime 2³¹ − 1.
#[derive(Clone, Debug)]
pub(super) struct Minstd {
    state: u64,
    multiplier: u64,
}

impl Minstd {
    const MODULUS: u64 = (1 << 31) - 1;

    pub(super) fn new(multiplier: u64, seed: u64) -> Minstd {
        Minstd { state: (seed % Self::MODULUS).max(1), multiplier }
    }
}

impl Source for Minstd {
    #[inline(always)]
    fn next(&mut self) -> u64 {
        self.state = self.state * self.multiplier % Self::MODULUS;
        self.state
    }
}
