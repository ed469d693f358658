//! Where uniform points come from.

use luch_sampling::{Sequence, hash};

/// A source of points of the unit cube: a pure function of replicate and number.
pub trait Points: Sync {
    /// Fills `out` with the coordinates of points `first`, `first + 1`, …, those of a point side by side; each in [0, 1].
    /// Replicates are independent randomisations.
    fn fill(&self, replicate: u64, first: u64, dimensions: usize, out: &mut [f64]);

    /// Whether replicates differ. Where they do not, their scatter says nothing of the error.
    fn is_random(&self) -> bool {
        true
    }

    /// The source that is best for exactly this many points, if that is another one: grids and lattices are made for their size.
    fn sized(&self, _samples: u64) -> Option<Box<dyn Points>> {
        None
    }
}

/// Independent points, one hash for each number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HashedPoints {
    /// Any number.
    pub seed: u64,
}

impl Points for HashedPoints {
    fn fill(&self, replicate: u64, first: u64, dimensions: usize, out: &mut [f64]) {
        let key = hash::combine(self.seed, replicate);
        let start = first.wrapping_mul(dimensions as u64);
        for (at, number) in out.iter_mut().enumerate() {
            let word = hash::word(key, start.wrapping_add(at as u64));
            // The middle of one of 2⁵² cells: never 0, never 1.
            *number = ((word >> 12) as f64 + 0.5) * (1.0 / 4_503_599_627_370_496.0);
        }
    }
}

/// Points of a sequence of the renderer; every four dimensions are a group with its own randomisation and order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SequencePoints {
    /// Which.
    pub sequence: Sequence,
    /// Any number.
    pub seed: u64,
}

impl Points for SequencePoints {
    fn fill(&self, replicate: u64, first: u64, dimensions: usize, out: &mut [f64]) {
        if dimensions == 0 {
            return;
        }
        let base = hash::combine(self.seed, replicate);
        // Past 2³² points comes a fresh randomisation.
        let keys_of = |round: u64| -> Vec<u64> {
            (0..dimensions.div_ceil(4) as u64).map(|group| hash::combine(base, round << 8 | group)).collect()
        };
        let mut round = first >> 32;
        let mut keys = keys_of(round);
        for (at, point) in out.chunks_mut(dimensions).enumerate() {
            let index = first.wrapping_add(at as u64);
            if index >> 32 != round {
                round = index >> 32;
                keys = keys_of(round);
            }
            for (numbers, &key) in point.chunks_mut(4).zip(&keys) {
                let words = self.sequence.words(key, index as u32);
                for (number, word) in numbers.iter_mut().zip(words) {
                    *number = (f64::from(word) + 0.5) * (1.0 / 4_294_967_296.0);
                }
            }
        }
    }
}
