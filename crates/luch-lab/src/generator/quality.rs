//! Tests that look for the faults of generators.
//!
//! [`spectral`] and [`Planes`] know the structure of linear congruences exactly. [`Test`] names statistical tests of any generator,
//! each with a probability. Simple tests, as of uniformity, pass for bad generators too: one has to look for structure on purpose.

mod birthday;
mod complexity;
mod counts;
mod killer;
mod lattice;
mod planes;
mod rank;
mod tail;
#[cfg(test)]
mod tests;

pub use birthday::{BirthdaySpacings, birthday_spacings};
pub use complexity::{berlekamp_massey, linear_complexity};
pub use counts::{gap, serial_pairs, uniformity};
pub use killer::{killer, killer_integrand};
pub use lattice::{Spectral, most_planes, spectral};
pub use planes::Planes;
pub use rank::matrix_rank;
pub use tail::{normal_two_sided, poisson_two_sided, two_sided};

use super::{Generator, Stream};

/// What a probability says about a generator, at the levels that TestU01 uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// Nothing was found.
    Passes,
    /// Less than one chance in ten thousand: repeat with another seed.
    Suspicious,
    /// Less than one chance in 10¹⁰: a fault.
    Fails,
}

impl Verdict {
    /// The verdict on a two-sided probability; not a number fails.
    pub fn of(p_value: f64) -> Verdict {
        if p_value >= 1e-4 {
            Verdict::Passes
        } else if p_value >= 1e-10 {
            Verdict::Suspicious
        } else {
            Verdict::Fails
        }
    }

    /// The word for it.
    pub const fn name(self) -> &'static str {
        match self {
            Verdict::Passes => "passes",
            Verdict::Suspicious => "suspicious",
            Verdict::Fails => "fails",
        }
    }
}

/// Result of a statistical test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TestResult {
    /// The test's own statistic.
    pub statistic: f64,
    /// Its expectation for ideal numbers.
    pub expected: f64,
    /// Probability of a statistic at least as far out on either side, for ideal numbers.
    pub p_value: f64,
    /// Native outputs used.
    pub numbers: u64,
}

impl TestResult {
    /// What the probability says.
    pub fn verdict(&self) -> Verdict {
        Verdict::of(self.p_value)
    }
}

/// Which bits of an output a test looks at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Part {
    /// So many highest bits.
    High(u32),
    /// So many lowest bits.
    Low(u32),
}

impl Part {
    /// The bits of the next output as a number below 2^bits; where an output has fewer bits, of the next 32.
    pub(crate) fn next(self, stream: &mut Stream) -> u64 {
        let width = stream.generator().bits();
        match self {
            Part::High(bits) if bits <= width => stream.next_native() >> (width - bits.max(1)),
            Part::High(bits) => u64::from(stream.next_u32() >> (32 - bits.clamp(1, 32))),
            Part::Low(bits) => stream.next_native() & (u64::MAX >> (64 - bits.clamp(1, 64))),
        }
    }

    /// How many values there are: 2^bits.
    pub(crate) fn values(self) -> f64 {
        let (Part::High(bits) | Part::Low(bits)) = self;
        libm::ldexp(1.0, bits.clamp(1, 64) as i32)
    }
}

/// A statistical test with fixed parameters, each below a second.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Test {
    /// A million numbers in 1024 cells.
    Uniformity,
    /// Half a million pairs in 64 × 64 cells.
    SerialPairs,
    /// The integrand that RANDU cannot see, 2¹⁴ triples.
    Killer,
    /// Equal spacings among 2¹⁵ points of a cube of 2³⁹ cells, 8 times.
    BirthdaySpacings,
    /// Equal spacings among 2²⁰ points of a square of 2⁵⁴ cells, twice.
    WideBirthdaySpacings,
    /// How long the highest four bits stay away from zero.
    Gap,
    /// How long the lowest three bits stay away from zero.
    LowGap,
    /// Ranks of 64 matrices of 256 × 256 lowest bits.
    LowRank,
    /// The shortest linear recurrence that makes 50 000 lowest bits.
    LowComplexity,
}

impl Test {
    /// All tests, simple ones first.
    pub const ALL: [Test; 9] = [
        Test::Uniformity,
        Test::SerialPairs,
        Test::Killer,
        Test::BirthdaySpacings,
        Test::WideBirthdaySpacings,
        Test::Gap,
        Test::LowGap,
        Test::LowRank,
        Test::LowComplexity,
    ];

    /// The name used in tables and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Test::Uniformity => "uniformity",
            Test::SerialPairs => "serial-pairs",
            Test::Killer => "killer",
            Test::BirthdaySpacings => "birthday-spacings",
            Test::WideBirthdaySpacings => "wide-birthday-spacings",
            Test::Gap => "gap",
            Test::LowGap => "low-gap",
            Test::LowRank => "low-rank",
            Test::LowComplexity => "low-complexity",
        }
    }

    /// The test with this [`name`](Self::name), or `None`.
    pub fn from_name(name: &str) -> Option<Test> {
        Self::ALL.into_iter().find(|test| test.name() == name)
    }

    /// One line about it.
    pub const fn description(self) -> &'static str {
        match self {
            Test::Uniformity => "are all values equally frequent?",
            Test::SerialPairs => "are all pairs of neighbours equally frequent?",
            Test::Killer => "the mean of cos^2(pi (9x - 6y + z)), which RANDU gets wrong by half",
            Test::BirthdaySpacings => "do points of the cube keep too regular distances?",
            Test::WideBirthdaySpacings => "the same for a million points of the square",
            Test::Gap => "how long do the highest four bits stay away from zero?",
            Test::LowGap => "how long do the lowest three bits stay away from zero?",
            Test::LowRank => "are matrices of lowest bits singular as often as they should be?",
            Test::LowComplexity => "does a short linear recurrence make the lowest bits?",
        }
    }

    /// Runs the test on the numbers of a seed.
    pub fn run(self, generator: Generator, seed: u64) -> TestResult {
        let mut stream = generator.start(seed);
        match self {
            Test::Uniformity => uniformity(&mut stream, 1 << 20, 10),
            Test::SerialPairs => serial_pairs(&mut stream, 1 << 19, 6),
            Test::Killer => killer(&mut stream, 1 << 14),
            Test::BirthdaySpacings => birthday_spacings(
                &mut stream,
                BirthdaySpacings { dimensions: 3, bits: 13, points: 1 << 15, rounds: 8 },
            ),
            Test::WideBirthdaySpacings => birthday_spacings(
                &mut stream,
                BirthdaySpacings { dimensions: 2, bits: 27, points: 1 << 20, rounds: 2 },
            ),
            Test::Gap => gap(&mut stream, Part::High(4), 1 << 16),
            Test::LowGap => gap(&mut stream, Part::Low(3), 1 << 16),
            Test::LowRank => matrix_rank(&mut stream, Part::Low(1), 256, 64),
            Test::LowComplexity => linear_complexity(&mut stream, Part::Low(1), 50_000),
        }
    }
}
