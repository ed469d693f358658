//! Which emitter a primitive of an instance is.

use std::ops::Range;

/// Marks a primitive that does not shine.
const DARK: u32 = u32::MAX;

/// For each instance where its primitives begin in one list of emitters.
#[derive(Debug, Default)]
pub(crate) struct Places {
    /// By instance; empty for those that do not shine.
    ranges: Vec<Range<usize>>,
    emitters: Vec<u32>,
}

impl Places {
    /// No emitters among so many instances.
    pub(crate) fn new(instances: usize) -> Self {
        Self { ranges: vec![0..0; instances], emitters: Vec::new() }
    }

    /// Adds the emitters of all primitives of an instance; `None` for those that do not shine.
    pub(crate) fn add(&mut self, instance: u32, emitters: impl IntoIterator<Item = Option<u32>>) {
        let first = self.emitters.len();
        self.emitters.extend(emitters.into_iter().map(|emitter| emitter.unwrap_or(DARK)));
        self.ranges[instance as usize] = first..self.emitters.len();
    }

    /// The emitter of a primitive, if it is one.
    pub(crate) fn get(&self, instance: u32, primitive: u32) -> Option<u32> {
        let range = self.ranges.get(instance as usize)?;
        let place = range.start + primitive as usize;
        let emitter = self.emitters[..range.end].get(place)?;
        (*emitter != DARK).then_some(*emitter)
    }
}
