//! Where the points come from.
//!
//! Every member answers one question: which four 32-bit coordinates does point `index` of the randomised sequence with
//! this `key` have? It is a pure function, it never asks how many points there will be, and it is defined for all 2³²
//! indices. A new member is one file, one variant, one entry in [`Sequence::ALL`] and one arm in `words`; the contract
//! suite in `tests/contract.rs` then applies to it.

pub mod halton;
pub mod independent;
pub mod sobol;
mod sobol_table;
pub mod stratified;

use serde::{Deserialize, Serialize};

/// A family of points of the four-dimensional unit cube.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Sequence {
    /// Hashed random numbers: error N^−½ for everything. The yardstick.
    Independent,
    /// Progressive jittered cells for each pair of coordinates, the pairs shuffled against each other.
    Stratified,
    /// Halton's sequence in bases 2, 3, 5, 7 with nested digit scrambling.
    Halton,
    /// Sobol' points with Owen scrambling by hashing: the best of the four nearly everywhere.
    #[default]
    Sobol,
}

impl Sequence {
    /// All members, from plain to fine.
    pub const ALL: [Sequence; 4] =
        [Sequence::Independent, Sequence::Stratified, Sequence::Halton, Sequence::Sobol];

    /// The name used in files and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Sequence::Independent => "independent",
            Sequence::Stratified => "stratified",
            Sequence::Halton => "halton",
            Sequence::Sobol => "sobol",
        }
    }

    /// The member with this [`name`](Self::name), or `None`.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|sequence| sequence.name() == name)
    }

    /// The four coordinates of point `index` under the randomisation `key`, as fractions of 2³².
    ///
    /// Different keys give independent randomisations, with independent orders of the points as well. A key should be a
    /// hash (see [`hash::mix64`](crate::hash::mix64)), not a small number.
    #[inline]
    pub fn words(self, key: u64, index: u32) -> [u32; 4] {
        match self {
            Sequence::Independent => independent::words(key, index),
            Sequence::Stratified => stratified::words(key, index),
            Sequence::Halton => halton::words(key, index),
            Sequence::Sobol => sobol::words(key, index),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_back() {
        for sequence in Sequence::ALL {
            assert_eq!(Sequence::from_name(sequence.name()), Some(sequence));
        }
        assert_eq!(Sequence::from_name("Sobol"), None);
        assert_eq!(Sequence::default(), Sequence::Sobol);
    }
}
