//! Joining films that hold different samples of the same picture.

use crate::film::Film;
use crate::ranges::Ranges;
use std::ops::Range;

/// Why two films cannot be joined.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MergeError {
    /// They show pictures of different sizes.
    #[error("the films have different sizes: {0}×{1} and {2}×{3} pixels")]
    Size(u32, u32, u32, u32),
    /// They sum in different units.
    #[error("the films sum in different steps: 2^{0} and 2^{1}")]
    Step(i8, i8),
    /// Both hold the same samples, which would count twice.
    #[error("both films hold samples {}..{} of the tile at pixel ({x}, {y}); each sample may be there once", .samples.start, .samples.end)]
    Overlap {
        /// First samples that both hold.
        samples: Range<u64>,
        /// Column of the tile.
        x: u32,
        /// Row of the tile.
        y: u32,
    },
}

impl Film {
    /// Adds the samples of `other`. The result does not depend on the order in which films are joined.
    ///
    /// # Errors
    /// If sizes or steps differ, or if a sample is in both; the film is then unchanged.
    pub fn merge(&mut self, other: &Film) -> Result<(), MergeError> {
        if (self.width, self.height) != (other.width, other.height) {
            return Err(MergeError::Size(self.width, self.height, other.width, other.height));
        }
        if self.step != other.step {
            return Err(MergeError::Step(self.step.exponent(), other.step.exponent()));
        }
        for (mine, theirs) in self.tiles.iter().zip(&other.tiles) {
            if let Some(samples) = mine.done.first_overlap(&theirs.done) {
                return Err(MergeError::Overlap { samples, x: mine.x, y: mine.y });
            }
        }
        for (mine, theirs) in self.tiles.iter_mut().zip(&other.tiles) {
            for range in theirs.done.as_slice() {
                mine.done.insert(range.clone());
            }
            for (sum, other) in mine.sums.iter_mut().zip(&theirs.sums) {
                sum.add(other);
            }
            mine.losses.saturated += theirs.losses.saturated;
            mine.losses.invalid += theirs.losses.invalid;
        }
        Ok(())
    }

    /// Samples below the last one held that some pixel does not have.
    pub fn gaps(&self) -> Ranges {
        let last = |ranges: &Ranges| ranges.as_slice().last().map_or(0, |r| r.end);
        let end = self.tiles.iter().map(|t| last(&t.done)).max().unwrap_or(0);
        let mut gaps = Ranges::default();
        for tile in &self.tiles {
            let mut wanted = 0..end;
            while let Some(gap) = tile.done.first_missing(&wanted, u64::MAX) {
                wanted.start = gap.end;
                gaps.insert(gap);
            }
        }
        gaps
    }
}
