//! A primitive on its way into the tree.

use super::bounds::Bounds;
use crate::Aabb;

/// A primitive and its box, 32 bytes: half of the number of the primitive lies in the fourth lane of each corner.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Item(Bounds);

impl Item {
    /// Something without a place in any tree.
    pub(super) const NOTHING: Self = Self(Bounds::EMPTY);

    /// `None` for an empty box or one that is not a number: such a primitive is never hit.
    #[inline(always)]
    pub(crate) fn new(bounds: &Aabb, primitive: u32) -> Option<Self> {
        (!bounds.is_empty()).then(|| Self::of(&Bounds::of(bounds), primitive))
    }

    #[inline(always)]
    pub(super) fn of(bounds: &Bounds, primitive: u32) -> Self {
        Self(bounds.with_note(primitive & 0xffff, primitive >> 16))
    }

    #[inline(always)]
    pub(super) fn primitive(&self) -> u32 {
        let [low, high] = self.0.note();
        low | high << 16
    }

    /// The box.
    #[inline(always)]
    pub(super) fn bounds(&self) -> Bounds {
        self.0
    }

    /// Both planes along one axis.
    #[inline(always)]
    pub(super) fn along(&self, axis: usize) -> (f32, f32) {
        (self.0.low(axis), self.0.high(axis))
    }
}
