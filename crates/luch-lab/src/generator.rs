//! Pseudo-random generators, good and bad, each exactly as it was published.
//!
//! [`Generator`] names them, [`Generator::start`] gives a [`Stream`] of numbers, [`quality`] looks for their faults. The
//! renderer uses none of these: its samples are pure functions (`luch_sampling::hash`). They are here to be compared.

mod counter;
mod linear;
mod pcg;
pub mod quality;
mod shift;
mod stream;
#[cfg(test)]
mod tests;
mod twister;

pub use linear::Lcg;
pub use stream::Stream;

/// A published pseudo-random generator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Generator {
    /// RANDU of IBM's System/360 library: x ← 65539·x mod 2³¹.
    Randu,
    /// The C standard's example as glibc's `TYPE_0` has it: x ← 1103515245·x + 12345 mod 2³¹.
    AnsiC,
    /// `rand` of Microsoft's C library: bits 16 to 30 of x ← 214013·x + 2531011 mod 2³².
    Msvc,
    /// Park and Miller's minimal standard of 1988: x ← 16807·x mod 2³¹ − 1.
    Minstd16807,
    /// Their better multiplier of 1993: x ← 48271·x mod 2³¹ − 1.
    Minstd48271,
    /// The 48-bit generator of POSIX.
    Drand48,
    /// "Quick and dirty" of Numerical Recipes: x ← 1664525·x + 1013904223 mod 2³².
    Lcg32,
    /// Knuth's generator for MMIX: x ← 6364136223846793005·x + 1442695040888963407 mod 2⁶⁴, all bits returned.
    Lcg64,
    /// Mersenne Twister, 32 bits (Matsumoto and Nishimura 1998).
    Mt19937,
    /// Mersenne Twister, 64 bits (Nishimura 2000).
    Mt19937x64,
    /// Vigna's xorshift128+ with shifts 23, 18, 5 ("Further scramblings of Marsaglia's xorshift generators", 2017).
    Xorshift128Plus,
    /// PCG-XSH-RR 64/32 (O'Neill 2014).
    Pcg32,
    /// PCG with 128 bits of state, the "cheap" multiplier and the DXSM output (O'Neill 2019).
    Pcg64Dxsm,
    /// xoshiro256++ (Blackman and Vigna, "Scrambled linear pseudorandom number generators", 2021).
    Xoshiro256PlusPlus,
    /// SplitMix64 (Steele, Lea, Flood 2014).
    SplitMix64,
    /// Philox4x32 with ten rounds: a hash of a counter (Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", 2011).
    Philox4x32,
    /// The stream cipher ChaCha with 8 rounds (Bernstein 2008).
    ChaCha8,
    /// The stream cipher ChaCha with 20 rounds.
    ChaCha20,
}

impl Generator {
    /// All members, oldest kinds first.
    pub const ALL: [Generator; 18] = [
        Generator::Randu,
        Generator::AnsiC,
        Generator::Msvc,
        Generator::Minstd16807,
        Generator::Minstd48271,
        Generator::Drand48,
        Generator::Lcg32,
        Generator::Lcg64,
        Generator::Mt19937,
        Generator::Mt19937x64,
        Generator::Xorshift128Plus,
        Generator::Pcg32,
        Generator::Pcg64Dxsm,
        Generator::Xoshiro256PlusPlus,
        Generator::SplitMix64,
        Generator::Philox4x32,
        Generator::ChaCha8,
        Generator::ChaCha20,
    ];

    /// What independent sampling uses unless told otherwise: fast, and no fault is known.
    pub const DEFAULT: Generator = Generator::Xoshiro256PlusPlus;

    /// The name used in files and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Generator::Randu => "randu",
            Generator::AnsiC => "ansi-c",
            Generator::Msvc => "msvc",
            Generator::Minstd16807 => "minstd-16807",
            Generator::Minstd48271 => "minstd-48271",
            Generator::Drand48 => "drand48",
            Generator::Lcg32 => "lcg32",
            Generator::Lcg64 => "lcg64",
            Generator::Mt19937 => "mt19937",
            Generator::Mt19937x64 => "mt19937-64",
            Generator::Xorshift128Plus => "xorshift128+",
            Generator::Pcg32 => "pcg32",
            Generator::Pcg64Dxsm => "pcg64-dxsm",
            Generator::Xoshiro256PlusPlus => "xoshiro256++",
            Generator::SplitMix64 => "splitmix64",
            Generator::Philox4x32 => "philox4x32",
            Generator::ChaCha8 => "chacha8",
            Generator::ChaCha20 => "chacha20",
        }
    }

    /// The member with this [`name`](Self::name), or `None`.
    pub fn from_name(name: &str) -> Option<Generator> {
        Self::ALL.into_iter().find(|generator| generator.name() == name)
    }

    /// One line about it: what it is and what it is known for.
    pub const fn description(self) -> &'static str {
        match self {
            Generator::Randu => "IBM, 1968: all triples lie on 15 planes",
            Generator::AnsiC => "the example of the C standard: the lowest bit alternates",
            Generator::Msvc => "rand() of Microsoft's C: 15 bits at a time, period 2^32",
            Generator::Minstd16807 => "Park and Miller's minimal standard, period 2^31 - 2",
            Generator::Minstd48271 => "the minimal standard with a better multiplier",
            Generator::Drand48 => "POSIX drand48, 48 bits",
            Generator::Lcg32 => "Numerical Recipes' quick generator, 32 bits",
            Generator::Lcg64 => "Knuth's MMIX generator, all 64 bits of a linear congruence",
            Generator::Mt19937 => "Mersenne Twister: huge period, but linear over two elements",
            Generator::Mt19937x64 => "Mersenne Twister of 64 bits",
            Generator::Xorshift128Plus => "long the generator of browsers: the lowest bit is linear",
            Generator::Pcg32 => "permuted congruential generator, 64 bits of state",
            Generator::Pcg64Dxsm => "permuted congruential generator, 128 bits of state",
            Generator::Xoshiro256PlusPlus => "scrambled linear generator, 256 bits of state: fast and sound",
            Generator::SplitMix64 => "a counter and a hash, 64 bits of state",
            Generator::Philox4x32 => {
                "a hash of a counter by ten rounds of multiplication: any number at once"
            }
            Generator::ChaCha8 => "stream cipher with 8 rounds",
            Generator::ChaCha20 => "stream cipher with 20 rounds: cryptographic strength",
        }
    }

    /// Bits in one native output: 15 to 64.
    pub const fn bits(self) -> u32 {
        match self {
            Generator::Msvc => 15,
            Generator::Randu | Generator::AnsiC | Generator::Minstd16807 | Generator::Minstd48271 => 31,
            Generator::Lcg32 | Generator::Mt19937 | Generator::Pcg32 | Generator::Philox4x32 => 32,
            Generator::ChaCha8 | Generator::ChaCha20 => 32,
            Generator::Drand48 => 48,
            Generator::Lcg64
            | Generator::Mt19937x64
            | Generator::Xorshift128Plus
            | Generator::Pcg64Dxsm
            | Generator::Xoshiro256PlusPlus
            | Generator::SplitMix64 => 64,
        }
    }

    /// Its linear congruence, if it is one; for the spectral test.
    pub const fn lcg(self) -> Option<Lcg> {
        linear::congruence(self)
    }

    /// The numbers that belong to `seed`, seeded the way the generator's authors do it.
    ///
    /// Congruences take the seed modulo their modulus, with 0 replaced by 1 where 0 is a fixed point and RANDU's seed made odd;
    /// Mersenne Twisters take seeds past their word as an array; generators with more state fill it by SplitMix64; PCG32 uses
    /// stream 54; Philox and ChaCha take the seed as the low 64 bits of their key.
    pub fn start(self, seed: u64) -> Stream {
        Stream::new(self, seed)
    }
}
