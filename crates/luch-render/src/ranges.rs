//! Which samples a piece of film holds: a set of sample indices, kept as ranges.

use serde::{Deserialize, Serialize};
use std::ops::Range;

/// A set of sample indices: sorted ranges that neither overlap nor touch.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Ranges(Vec<Range<u64>>);

impl Ranges {
    /// The ranges, in order.
    pub fn as_slice(&self) -> &[Range<u64>] {
        &self.0
    }

    /// True if there is no index.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// How many indices there are.
    pub fn count(&self) -> u64 {
        self.0.iter().map(|r| r.end - r.start).sum()
    }

    /// How many indices there are of stream A (even) and of stream B (odd).
    pub fn stream_counts(&self) -> [u64; 2] {
        // Even numbers below n: ⌈n / 2⌉.
        let even = |n: u64| n.div_ceil(2);
        let a = self.0.iter().map(|r| even(r.end) - even(r.start)).sum();
        [a, self.count() - a]
    }

    /// How many indices of `range` there are.
    pub fn count_within(&self, range: &Range<u64>) -> u64 {
        let cut = |r: &Range<u64>| r.end.min(range.end).saturating_sub(r.start.max(range.start));
        self.0.iter().map(cut).sum()
    }

    /// Adds a range; indices that are there already stay.
    pub fn insert(&mut self, new: Range<u64>) {
        if new.is_empty() {
            return;
        }
        let first = self.0.partition_point(|r| r.end < new.start);
        let last = self.0.partition_point(|r| r.start <= new.end);
        let start = self.0.get(first).map_or(new.start, |r| r.start.min(new.start));
        let end = last.checked_sub(1).and_then(|i| self.0.get(i)).map_or(new.end, |r| r.end.max(new.end));
        self.0.splice(first..last.max(first), std::iter::once(start..end));
    }

    /// Whether any index of `other` is in the set.
    pub fn overlaps(&self, other: &Range<u64>) -> bool {
        self.0.iter().any(|r| r.start < other.end && other.start < r.end)
    }

    /// Indices that are in both sets, as the first range of them.
    pub fn first_overlap(&self, other: &Ranges) -> Option<Range<u64>> {
        let cut = |a: &Range<u64>, b: &Range<u64>| a.start.max(b.start)..a.end.min(b.end);
        self.0.iter().flat_map(|a| other.0.iter().map(move |b| cut(a, b))).find(|c| !c.is_empty())
    }

    /// The first stretch of at most `longest` indices of `wanted` that is not in the set.
    pub fn first_missing(&self, wanted: &Range<u64>, longest: u64) -> Option<Range<u64>> {
        let mut start = wanted.start;
        for have in &self.0 {
            if have.end <= start {
                continue;
            }
            if have.start > start {
                let end = have.start.min(wanted.end).min(start.saturating_add(longest));
                return (start < end).then_some(start..end);
            }
            start = have.end;
        }
        let end = wanted.end.min(start.saturating_add(longest));
        (start < end).then_some(start..end)
    }

    /// True if the ranges are sorted, not empty, and neither overlap nor touch: what a file must prove.
    pub(crate) fn is_sound(&self) -> bool {
        self.0.iter().all(|r| r.start < r.end) && self.0.windows(2).all(|w| w[0].end < w[1].start)
    }
}

impl std::fmt::Display for Ranges {
    /// `0..64, 128..256`
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (i, range) in self.0.iter().enumerate() {
            let comma = if i == 0 { "" } else { ", " };
            write!(f, "{comma}{}..{}", range.start, range.end)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_set_of_ranges_is_a_set(inserts in prop::collection::vec((0u64..64, 0u64..12), 0..12), wanted in (0u64..60, 0u64..20), longest in 1u64..9) {
            let mut ranges = Ranges::default();
            let mut model = [false; 96];
            for (start, length) in inserts {
                ranges.insert(start..start + length);
                for i in start..start + length {
                    model[i as usize] = true;
                }
                prop_assert!(ranges.is_sound(), "{ranges}");
            }
            let members: Vec<u64> = ranges.as_slice().iter().cloned().flatten().collect();
            let expected: Vec<u64> = (0..96).filter(|&i| model[i as usize]).collect();
            prop_assert_eq!(&members, &expected);
            let even = expected.iter().filter(|i| *i % 2 == 0).count() as u64;
            prop_assert_eq!(ranges.stream_counts(), [even, expected.len() as u64 - even]);

            let wanted = wanted.0..wanted.0 + wanted.1;
            let missing = wanted.clone().find(|&i| !model[i as usize]);
            match ranges.first_missing(&wanted, longest) {
                None => prop_assert_eq!(missing, None),
                Some(found) => {
                    prop_assert_eq!(Some(found.start), missing);
                    prop_assert!(found.end <= wanted.end && found.end - found.start <= longest);
                    prop_assert!(found.clone().all(|i| !model[i as usize]));
                    let maximal = found.end == wanted.end || found.end - found.start == longest || model[found.end as usize];
                    prop_assert!(maximal);
                }
            }
        }
    }
}
