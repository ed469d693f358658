//! A running generator: native outputs, words, numbers in [0, 1), bytes.

use super::Generator;
use super::counter::{ChaCha, Philox};
use super::linear::{Minstd, PowerOfTwo};
use super::pcg::{Pcg32, Pcg64Dxsm};
use super::shift::{SplitMix64, Xorshift128Plus, Xoshiro256PlusPlus};
use super::twister::{Twister32, Twister64};

/// What every generator does: give its next native output.
pub(super) trait Source {
    /// The next output in the lowest bits.
    fn next(&mut self) -> u64;
}

#[derive(Clone, Debug)]
enum State {
    PowerOfTwo(PowerOfTwo),
    Minstd(Minstd),
    Twister32(Box<Twister32>),
    Twister64(Box<Twister64>),
    Xorshift128Plus(Xorshift128Plus),
    Pcg32(Pcg32),
    Pcg64Dxsm(Pcg64Dxsm),
    Xoshiro256PlusPlus(Xoshiro256PlusPlus),
    SplitMix64(SplitMix64),
    Philox(Philox),
    ChaCha8(ChaCha<4>),
    ChaCha20(ChaCha<10>),
}

/// Runs an expression with the state inside, whatever its kind: one test outside of the loop.
macro_rules! with_source {
    ($state:expr, $source:ident => $body:expr) => {
        match $state {
            State::PowerOfTwo($source) => $body,
            State::Minstd($source) => $body,
            State::Twister32($source) => $body,
            State::Twister64($source) => $body,
            State::Xorshift128Plus($source) => $body,
            State::Pcg32($source) => $body,
            State::Pcg64Dxsm($source) => $body,
            State::Xoshiro256PlusPlus($source) => $body,
            State::SplitMix64($source) => $body,
            State::Philox($source) => $body,
            State::ChaCha8($source) => $body,
            State::ChaCha20($source) => $body,
        }
    };
}

/// The numbers of one generator from one seed, in order.
#[derive(Clone, Debug)]
pub struct Stream {
    generator: Generator,
    state: State,
    /// Bits of an output that [`fill_bytes`](Self::fill_bytes) has not given out, lowest first.
    pending: u128,
    pending_bits: u32,
}

impl Stream {
    pub(super) fn new(generator: Generator, seed: u64) -> Stream {
        let state = match generator {
            Generator::Minstd16807 => State::Minstd(Minstd::new(16_807, seed)),
            Generator::Minstd48271 => State::Minstd(Minstd::new(48_271, seed)),
            Generator::Mt19937 => State::Twister32(Box::new(Twister32::from_seed(seed))),
            Generator::Mt19937x64 => State::Twister64(Box::new(Twister64::from_seed(seed))),
            Generator::Xorshift128Plus => State::Xorshift128Plus(Xorshift128Plus::from_seed(seed)),
            Generator::Pcg32 => State::Pcg32(Pcg32::new(seed, 54)),
            Generator::Pcg64Dxsm => State::Pcg64Dxsm(Pcg64Dxsm::from_seed(seed)),
            Generator::Xoshiro256PlusPlus => State::Xoshiro256PlusPlus(Xoshiro256PlusPlus::from_seed(seed)),
            Generator::SplitMix64 => State::SplitMix64(SplitMix64::new(seed)),
            Generator::Philox4x32 => State::Philox(Philox::new([seed as u32, (seed >> 32) as u32])),
            Generator::ChaCha8 => State::ChaCha8(ChaCha::new([seed, 0, 0, 0])),
            Generator::ChaCha20 => State::ChaCha20(ChaCha::new([seed, 0, 0, 0])),
            Generator::Randu
            | Generator::AnsiC
            | Generator::Msvc
            | Generator::Drand48
            | Generator::Lcg32
            | Generator::Lcg64 => State::PowerOfTwo(PowerOfTwo::new(generator, seed)),
        };
        Stream { generator, state, pending: 0, pending_bits: 0 }
    }

    /// The generator this is a stream of.
    pub fn generator(&self) -> Generator {
        self.generator
    }

    /// The next output as the generator gives it, [`bits`](Generator::bits) wide.
    #[inline]
    pub fn next_native(&mut self) -> u64 {
        with_source!(&mut self.state, source => source.next())
    }

    /// The next 32 bits: the highest of an output, or of as many outputs as it takes, first one highest.
    #[inline]
    pub fn next_u32(&mut self) -> u32 {
        let bits = self.generator.bits();
        if bits >= 32 {
            return (self.next_native() >> (bits - 32)) as u32;
        }
        let (mut word, mut missing) = (0u64, 32);
        while missing > 0 {
            let taken = bits.min(missing);
            word = word << taken | self.next_native() >> (bits - taken);
            missing -= taken;
        }
        word as u32
    }

    /// The next 64 bits: an output of that size, or two times [`next_u32`](Self::next_u32), the first one higher.
    #[inline]
    pub fn next_u64(&mut self) -> u64 {
        if self.generator.bits() == 64 {
            return self.next_native();
        }
        let high = u64::from(self.next_u32());
        high << 32 | u64::from(self.next_u32())
    }

    /// The next number in [0, 1), from one native output: output / modulus, of which 64-bit generators use the highest 53 bits.
    #[inline]
    pub fn unit_f64(&mut self) -> f64 {
        let unit = unit_of(self.generator);
        unit.of(self.next_native())
    }

    /// Fills a slice with what [`unit_f64`](Self::unit_f64) gives in turn; the fast way to many.
    pub fn fill_unit(&mut self, numbers: &mut [f64]) {
        let unit = unit_of(self.generator);
        with_source!(&mut self.state, source => {
            for number in numbers {
                *number = unit.of(source.next());
            }
        });
    }

    /// Fills a slice with native outputs.
    pub fn fill_native(&mut self, outputs: &mut [u64]) {
        with_source!(&mut self.state, source => {
            for output in outputs {
                *output = source.next();
            }
        });
    }

    /// The raw bits in the generator's own order, as test programs read them: outputs follow one another without gaps, the lowest
    /// bit of each first. Words of 32 and 64 bits come out little-endian.
    pub fn fill_bytes(&mut self, bytes: &mut [u8]) {
        let bits = self.generator.bits();
        let (mut pending, mut held) = (self.pending, self.pending_bits);
        with_source!(&mut self.state, source => {
            for byte in bytes {
                while held < 8 {
                    pending |= u128::from(source.next()) << held;
                    held += bits;
                }
                *byte = pending as u8;
                pending >>= 8;
                held -= 8;
            }
        });
        (self.pending, self.pending_bits) = (pending, held);
    }
}

/// How an output becomes a number in [0, 1).
#[derive(Clone, Copy)]
struct Unit {
    shift: u32,
    divisor: f64,
}

impl Unit {
    #[inline(always)]
    fn of(self, output: u64) -> f64 {
        (output >> self.shift) as f64 / self.divisor
    }
}

fn unit_of(generator: Generator) -> Unit {
    match generator {
        Generator::Minstd16807 | Generator::Minstd48271 => Unit { shift: 0, divisor: 2_147_483_647.0 },
        _ => {
            let bits = generator.bits().min(53);
            Unit { shift: generator.bits() - bits, divisor: (1u64 << bits) as f64 }
        }
    }
}
