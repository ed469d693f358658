//! Rules that place points in the unit cube of 1 to 64 dimensions.
//!
//! [`Rule`] names them. [`Rule::points`] gives a whole set; [`Rule::fill`] gives any stretch of those that have random access,
//! for integrals too long to keep. Everything is a function of rule, count, dimensions, seed and replicate; two replicates of a
//! random rule are independent.

mod blocks;
mod blue_noise;
mod cells;
mod digital;
mod halton;
mod joe_kuo;
mod lattice;
mod matrices;
mod owen;
mod rule;
mod set;
#[cfg(test)]
mod tests;

pub use lattice::GENERATING_VECTOR;
pub use matrices::sobol_directions;
pub use rule::Rule;
pub use set::PointSet;

use luch_sampling::hash;
use thiserror::Error;

/// Most dimensions any rule serves.
pub const MOST_DIMENSIONS: usize = 64;

/// Most coordinates of one [`PointSet`]: a gigabyte of them.
pub const MOST_COORDINATES: usize = 1 << 27;

/// Most points of a set of blue noise.
pub const MOST_BLUE_NOISE: usize = 1 << 14;

/// Why a rule cannot give the points asked for.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum PointsError {
    /// No points at all were asked for.
    #[error("the number of points is 0; at least 1 is needed")]
    NoPoints,
    /// The rule does not work in that many dimensions.
    #[error("`{rule}` has no points in {dimensions} dimensions; it has them in {least} to {most}")]
    Dimensions {
        /// Name of the rule.
        rule: &'static str,
        /// Dimensions asked for.
        dimensions: usize,
        /// Fewest it serves.
        least: usize,
        /// Most it serves.
        most: usize,
    },
    /// The rule does not work with that many points.
    #[error(
        "`{rule}` cannot place {count} points in {dimensions} dimensions: {wanted}; the nearest below is {nearest}"
    )]
    Count {
        /// Name of the rule.
        rule: &'static str,
        /// Points asked for.
        count: usize,
        /// Dimensions asked for.
        dimensions: usize,
        /// What the number must be.
        wanted: &'static str,
        /// The largest number not above `count` that is accepted.
        nearest: usize,
    },
    /// More coordinates than a set may hold.
    #[error("{count} points in {dimensions} dimensions are more than {MOST_COORDINATES} coordinates")]
    TooMany {
        /// Points asked for.
        count: usize,
        /// Dimensions asked for.
        dimensions: usize,
    },
    /// The rule places all its points together and cannot give a stretch of them.
    #[error("`{rule}` places its points all together; take the whole set")]
    NotStreamed {
        /// Name of the rule.
        rule: &'static str,
    },
    /// The slice to fill does not hold whole points, or reaches past the last point.
    #[error(
        "a stretch of {coordinates} coordinates from point {first} on is not within {count} points of {dimensions}"
    )]
    Stretch {
        /// First point asked for.
        first: u64,
        /// Coordinates to be filled.
        coordinates: usize,
        /// Points of the set.
        count: u64,
        /// Dimensions of the points.
        dimensions: usize,
    },
}

/// Which set of a rule: everything but the rule itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Design {
    /// Number of points of the whole set, at most 2³².
    pub count: u64,
    /// Coordinates of each.
    pub dimensions: usize,
    /// Chooses the randomisation.
    pub seed: u64,
    /// Number of the independent repetition.
    pub replicate: u64,
}

impl Design {
    /// The randomisation of this set under a rule's own number.
    fn key(&self, rule: u64) -> u64 {
        hash::combine(hash::combine(self.seed, self.replicate), rule)
    }
}

/// A fraction of 2³² as a number in [0, 1), by placing the bits behind a one; vectors have all it takes.
#[inline(always)]
fn unit(word: u32) -> f64 {
    f64::from_bits(0x3ff0_0000_0000_0000 | u64::from(word) << 20) - 1.0
}

/// The highest 52 bits of a fraction of 2⁶⁴ as a number in [0, 1).
#[inline(always)]
fn unit_64(word: u64) -> f64 {
    f64::from_bits(0x3ff0_0000_0000_0000 | word >> 12) - 1.0
}

/// Keeps a sum of roundings in [0, 1).
const BELOW_ONE: f64 = 1.0 - f64::EPSILON / 2.0;
