//! Which hits count.

use crate::Hit;

/// A pure function of ray and hit; it may be asked about any hit, in any order.
pub(crate) trait Accept {
    /// Whether all hits count, so that nobody need ask.
    const ALWAYS: bool;

    fn accept(&mut self, ray: usize, hit: &Hit) -> bool;
}

/// All hits count.
pub(crate) struct All;

impl Accept for All {
    const ALWAYS: bool = true;

    #[inline(always)]
    fn accept(&mut self, _: usize, _: &Hit) -> bool {
        true
    }
}
