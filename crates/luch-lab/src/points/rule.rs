//! The family of rules: names, what each accepts, and the one place that hands out points.

use super::{
    Design, MOST_BLUE_NOISE, MOST_COORDINATES, MOST_DIMENSIONS, PointSet, PointsError, blue_noise, cells,
    digital, halton, lattice, owen,
};
use crate::generator::Generator;
use luch_sampling::hash;

/// A rule that places points in the unit cube.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Rule {
    /// Independent numbers of a generator, each coordinate one native output.
    Independent(Generator),
    /// The middles of k^d cells: the product rule that high dimensions defeat.
    Midpoints,
    /// One random point in each of k^d cells.
    Jittered,
    /// Latin hypercube (McKay, Beckman, Conover 1979).
    LatinHypercube,
    /// Multi-jittered pairs (Chiu, Shirley, Wang 1994).
    MultiJittered,
    /// Correlated multi-jittered pairs (Kensler 2013).
    CorrelatedMultiJittered,
    /// Halton's sequence (1960).
    Halton,
    /// Halton's sequence moved by a random vector modulo 1 (Cranley, Patterson 1976).
    HaltonShifted,
    /// Halton's sequence with a random permutation of the digits at every node (Owen 1995).
    HaltonScrambled,
    /// Hammersley's set: i/N beside Halton's sequence.
    Hammersley,
    /// Sobol' points with the direction numbers of Joe and Kuo (2008).
    Sobol,
    /// Sobol' points with one random word added (exclusive or) to each coordinate.
    SobolShifted,
    /// Sobol' points with a random linear scramble of the digits and a shift (Matoušek 1998).
    SobolLinear,
    /// Sobol' points with an exact nested uniform scramble (Owen 1995), made by stochastic generation (Helmer et al. 2021).
    SobolOwen,
    /// Sobol' points with a nested scramble by hashing (Burley 2020, constants of Vegdahl 2021).
    SobolHashed,
    /// Pairs of scrambled (0,2)-sequences in base 2, shuffled against one another (Kollig, Keller 2002).
    ZeroTwo,
    /// Progressive multi-jittered (0,2)-sequences (Christensen et al. 2018) by stochastic generation (Helmer et al. 2021).
    Pmj02,
    /// Groups of four: (0,4)-sequences in base 4 whose halves are (0,2)-sequences in base 2, scrambled in base 2, after
    /// "SZ sequences: binary-based (0,2^q)-sequences" (Ahmed et al. 2025).
    Sz,
    /// Rank-1 lattice sequence with a random shift.
    LatticeShifted,
    /// The same folded by the tent function (Hickernell 2002).
    LatticeTent,
    /// Multiples of powers of the generalised golden ratio modulo 1 (Roberts 2018), moved by a random vector.
    Kronecker,
    /// Best of many candidates, on the torus (Mitchell 1991); two dimensions.
    BlueNoise,
}

impl Rule {
    /// All members, independent points by their default generator.
    pub const ALL: [Rule; 22] = [
        Rule::Independent(Generator::DEFAULT),
        Rule::Midpoints,
        Rule::Jittered,
        Rule::LatinHypercube,
        Rule::MultiJittered,
        Rule::CorrelatedMultiJittered,
        Rule::Halton,
        Rule::HaltonShifted,
        Rule::HaltonScrambled,
        Rule::Hammersley,
        Rule::Sobol,
        Rule::SobolShifted,
        Rule::SobolLinear,
        Rule::SobolOwen,
        Rule::SobolHashed,
        Rule::ZeroTwo,
        Rule::Pmj02,
        Rule::Sz,
        Rule::LatticeShifted,
        Rule::LatticeTent,
        Rule::Kronecker,
        Rule::BlueNoise,
    ];

    /// The name used in files and on the command line; independent points of other generators bear the generator's name.
    pub fn name(self) -> &'static str {
        match self {
            Rule::Independent(Generator::DEFAULT) => "independent",
            Rule::Independent(generator) => generator.name(),
            Rule::Midpoints => "midpoints",
            Rule::Jittered => "jittered",
            Rule::LatinHypercube => "latin-hypercube",
            Rule::MultiJittered => "multi-jittered",
            Rule::CorrelatedMultiJittered => "correlated-multi-jittered",
            Rule::Halton => "halton",
            Rule::HaltonShifted => "halton-shifted",
            Rule::HaltonScrambled => "halton-scrambled",
            Rule::Hammersley => "hammersley",
            Rule::Sobol => "sobol",
            Rule::SobolShifted => "sobol-shifted",
            Rule::SobolLinear => "sobol-linear",
            Rule::SobolOwen => "sobol-owen",
            Rule::SobolHashed => "sobol-hashed",
            Rule::ZeroTwo => "zero-two",
            Rule::Pmj02 => "pmj02",
            Rule::Sz => "sz",
            Rule::LatticeShifted => "lattice",
            Rule::LatticeTent => "lattice-tent",
            Rule::Kronecker => "kronecker",
            Rule::BlueNoise => "blue-noise",
        }
    }

    /// The rule with this [`name`](Self::name), generators included, or `None`.
    pub fn from_name(name: &str) -> Option<Rule> {
        Self::ALL
            .into_iter()
            .find(|rule| rule.name() == name)
            .or_else(|| Generator::from_name(name).map(Rule::Independent))
    }

    /// One line about it.
    pub fn description(self) -> &'static str {
        match self {
            Rule::Independent(Generator::DEFAULT) => {
                "independent random points: error N^-1/2 in any dimension"
            }
            Rule::Independent(generator) => generator.description(),
            Rule::Midpoints => "middles of k^d cells: the grid rule, helpless in many dimensions",
            Rule::Jittered => "one random point in each of k^d cells",
            Rule::LatinHypercube => "one point in each of N slices along every axis",
            Rule::MultiJittered => "cells and slices at once, pair by pair",
            Rule::CorrelatedMultiJittered => "cells and slices with aligned shuffles: more even inside",
            Rule::Halton => "mirrored digits in the bases 2, 3, 5, 7, ...",
            Rule::HaltonShifted => "Halton, moved by a random vector modulo 1",
            Rule::HaltonScrambled => "Halton with nested random permutations of its digits",
            Rule::Hammersley => "i/N beside Halton: even, but for one N only",
            Rule::Sobol => "Sobol' points as they are",
            Rule::SobolShifted => "Sobol' points, a random word added to each coordinate without carry",
            Rule::SobolLinear => "Sobol' points with a random linear scramble and shift",
            Rule::SobolOwen => "Sobol' points with an exact nested uniform scramble",
            Rule::SobolHashed => "Sobol' points, nested scramble by a hash of few multiplications",
            Rule::ZeroTwo => "scrambled (0,2)-sequences, pair by pair",
            Rule::Pmj02 => "progressive multi-jittered (0,2)-sequences, pair by pair",
            Rule::Sz => "(0,4)-sequences in base 4 of (0,2) halves, four by four",
            Rule::LatticeShifted => "rank-1 lattice sequence, randomly shifted: for periodic functions",
            Rule::LatticeTent => {
                "rank-1 lattice sequence, shifted and folded: error N^-2 for smooth functions"
            }
            Rule::Kronecker => "powers of the generalised golden ratio, added up modulo 1 (R2)",
            Rule::BlueNoise => "best of many candidates: no two points close, few waves below",
        }
    }

    /// Fewest and most dimensions it serves.
    pub fn dimensions(self) -> std::ops::RangeInclusive<usize> {
        match self {
            Rule::BlueNoise => 2..=2,
            _ => 1..=MOST_DIMENSIONS,
        }
    }

    /// Whether the first points of a larger set are the points of the smaller one.
    pub fn is_sequence(self) -> bool {
        !matches!(
            self,
            Rule::Midpoints
                | Rule::Jittered
                | Rule::LatinHypercube
                | Rule::MultiJittered
                | Rule::CorrelatedMultiJittered
                | Rule::Hammersley
        )
    }

    /// Whether [`fill`](Self::fill) can give a stretch from anywhere.
    pub fn is_streamed(self) -> bool {
        !matches!(
            self,
            Rule::Independent(_)
                | Rule::Jittered
                | Rule::LatinHypercube
                | Rule::MultiJittered
                | Rule::CorrelatedMultiJittered
                | Rule::BlueNoise
        )
    }

    /// Whether replicates differ; the others give one set and no error estimate.
    pub fn is_random(self) -> bool {
        !matches!(self, Rule::Midpoints | Rule::Halton | Rule::Hammersley | Rule::Sobol)
    }

    /// Which numbers of points it accepts, in words.
    pub fn accepted_counts(self) -> &'static str {
        match self {
            Rule::Midpoints | Rule::Jittered => {
                "the number must be k^d, a whole number to the power of the dimensions"
            }
            Rule::MultiJittered | Rule::CorrelatedMultiJittered => {
                "the number must be m*n with whole m and n, m <= n <= 2m"
            }
            Rule::BlueNoise => "the number must be at most 16384",
            _ => "any number up to 2^32 will do",
        }
    }

    /// The largest accepted number of points that is not above `wanted`; at least 1.
    pub fn nearest_count(self, wanted: u64, dimensions: usize) -> u64 {
        let wanted = wanted.clamp(1, 1 << 32);
        match self {
            Rule::Midpoints | Rule::Jittered => cells::per_axis(wanted, dimensions).count,
            Rule::MultiJittered | Rule::CorrelatedMultiJittered => {
                // A square is never far below.
                (1..=wanted).rev().find(|&count| cells::factors(count).is_some()).unwrap_or(1)
            }
            Rule::BlueNoise => wanted.min(MOST_BLUE_NOISE as u64),
            _ => wanted,
        }
    }

    /// Whether the rule has such a set; the error says what it would accept.
    pub fn accepts(self, count: u64, dimensions: usize) -> Result<(), PointsError> {
        let range = self.dimensions();
        if !range.contains(&dimensions) {
            let (least, most) = (*range.start(), *range.end());
            return Err(PointsError::Dimensions { rule: self.name(), dimensions, least, most });
        }
        if count == 0 {
            return Err(PointsError::NoPoints);
        }
        let nearest = self.nearest_count(count, dimensions);
        if nearest != count {
            return Err(PointsError::Count {
                rule: self.name(),
                count: count as usize,
                dimensions,
                wanted: self.accepted_counts(),
                nearest: nearest as usize,
            });
        }
        Ok(())
    }

    /// A whole set of points.
    ///
    /// The replicate chooses an independent randomisation; rules that are not [random](Self::is_random) ignore seed and replicate.
    pub fn points(
        self,
        count: usize,
        dimensions: usize,
        seed: u64,
        replicate: u64,
    ) -> Result<PointSet, PointsError> {
        self.accepts(count as u64, dimensions)?;
        let length = count.checked_mul(dimensions).filter(|&length| length <= MOST_COORDINATES);
        let mut coordinates = vec![0.0; length.ok_or(PointsError::TooMany { count, dimensions })?];
        self.points_into(dimensions, seed, replicate, &mut coordinates)?;
        PointSet::from_flat(dimensions, coordinates).ok_or(PointsError::TooMany { count, dimensions })
    }

    /// A whole set of as many points as the slice holds: [`points`](Self::points) without new memory for the result.
    pub fn points_into(
        self,
        dimensions: usize,
        seed: u64,
        replicate: u64,
        out: &mut [f64],
    ) -> Result<(), PointsError> {
        let count = out.len().checked_div(dimensions).unwrap_or(0) as u64;
        let design = Design { count, dimensions, seed, replicate };
        self.accepts(count, dimensions)?;
        if out.len() as u64 != count * dimensions as u64 || out.len() > MOST_COORDINATES {
            return Err(PointsError::Stretch { first: 0, coordinates: out.len(), count, dimensions });
        }
        let key = design.key(self.number());
        match self {
            Rule::Independent(generator) => {
                generator.start(hash::combine(seed, replicate)).fill_unit(out);
                Ok(())
            }
            Rule::Jittered => {
                cells::jittered(&design, key, out);
                Ok(())
            }
            Rule::LatinHypercube => {
                cells::latin_hypercube(&design, key, out);
                Ok(())
            }
            Rule::MultiJittered | Rule::CorrelatedMultiJittered => {
                cells::multi_jittered(&design, key, self == Rule::CorrelatedMultiJittered, out);
                Ok(())
            }
            Rule::BlueNoise => {
                blue_noise::fill(key, out);
                Ok(())
            }
            Rule::SobolOwen | Rule::Pmj02 => {
                owen::fill_all(self, key, dimensions, out);
                Ok(())
            }
            _ => self.fill(&design, 0, out),
        }
    }

    /// The points from number `first` on, as many as the slice holds, for rules that are [streamed](Self::is_streamed).
    ///
    /// The same bits as in [`points`](Self::points), in any order and split.
    pub fn fill(self, design: &Design, first: u64, out: &mut [f64]) -> Result<(), PointsError> {
        let Design { count, dimensions, .. } = *design;
        self.accepts(count, dimensions)?;
        let wanted = (out.len() / dimensions) as u64;
        let whole = out.len().is_multiple_of(dimensions);
        if !whole || first.checked_add(wanted).is_none_or(|end| end > count) {
            return Err(PointsError::Stretch { first, coordinates: out.len(), count, dimensions });
        }
        let key = design.key(self.number());
        match self {
            Rule::Midpoints => cells::midpoints(design, first, out),
            Rule::Halton => halton::fill(dimensions, first, halton::Change::None, out),
            Rule::HaltonShifted => halton::fill(dimensions, first, halton::Change::Shift(key), out),
            Rule::HaltonScrambled => halton::fill(dimensions, first, halton::Change::Scramble(key), out),
            Rule::Hammersley => halton::fill_hammersley(design, first, out),
            Rule::Sobol => digital::fill_sobol(dimensions, first, digital::Change::None, out),
            Rule::SobolShifted => digital::fill_sobol(dimensions, first, digital::Change::Shift(key), out),
            Rule::SobolLinear => digital::fill_sobol(dimensions, first, digital::Change::Linear(key), out),
            Rule::SobolHashed => digital::fill_sobol(dimensions, first, digital::Change::Hash(key), out),
            Rule::SobolOwen | Rule::Pmj02 => owen::fill(self, key, dimensions, first, out),
            Rule::ZeroTwo | Rule::Sz => digital::fill_padded(self, key, dimensions, first, out),
            Rule::LatticeShifted => lattice::fill(key, dimensions, first, false, out),
            Rule::LatticeTent => lattice::fill(key, dimensions, first, true, out),
            Rule::Kronecker => lattice::fill_kronecker(key, dimensions, first, out),
            Rule::Independent(_)
            | Rule::Jittered
            | Rule::LatinHypercube
            | Rule::MultiJittered
            | Rule::CorrelatedMultiJittered
            | Rule::BlueNoise => return Err(PointsError::NotStreamed { rule: self.name() }),
        }
        Ok(())
    }

    /// A number of its own for the keys of its randomisations; new members take new ones.
    fn number(self) -> u64 {
        match self {
            Rule::Independent(_) => 0,
            Rule::Midpoints => 1,
            Rule::Jittered => 2,
            Rule::LatinHypercube => 3,
            Rule::MultiJittered => 4,
            Rule::CorrelatedMultiJittered => 5,
            Rule::Halton => 6,
            Rule::HaltonShifted => 7,
            Rule::HaltonScrambled => 8,
            Rule::Hammersley => 9,
            Rule::Sobol => 10,
            Rule::SobolShifted => 11,
            Rule::SobolLinear => 12,
            Rule::SobolOwen => 13,
            Rule::SobolHashed => 14,
            Rule::ZeroTwo => 15,
            Rule::Pmj02 => 16,
            Rule::Sz => 17,
            Rule::LatticeShifted => 18,
            Rule::LatticeTent => 19,
            Rule::Kronecker => 20,
            Rule::BlueNoise => 21,
        }
    }
}
