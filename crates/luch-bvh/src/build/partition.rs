//! Two groups out of one, in an order that depends on nothing but the items.

use super::bins::Cut;
use super::bounds::Bounds;
use super::item::Item;
use super::lanes::Lanes;

/// The boxes of the middles on either side of a split.
#[derive(Clone, Copy)]
pub(super) struct Middles(pub(super) [Bounds; 2]);

impl Middles {
    pub(super) const EMPTY: Self = Self([Bounds::EMPTY; 2]);

    pub(super) fn union(&self, other: &Self) -> Self {
        Self([self.0[0].union(&other.0[0]), self.0[1].union(&other.0[1])])
    }
}

/// The boxes of the middles while they grow.
struct Growing([Lanes<8>; 2]);

impl Growing {
    #[inline(always)]
    fn new() -> Self {
        Self([Lanes::<8>::splat(f32::INFINITY); 2])
    }

    /// The middle of what is on one side: both boxes grow, one of them by nothing. No branch to guess.
    #[inline(always)]
    fn grow(&mut self, middle: Lanes<8>, side: usize) {
        let limits = [f32::NEG_INFINITY, f32::INFINITY, f32::NEG_INFINITY];
        let [left, right] = self.0;
        self.0 = [
            left.smaller(middle.larger(Lanes::<8>::splat(limits[side]))),
            right.smaller(middle.larger(Lanes::<8>::splat(limits[side + 1]))),
        ];
    }

    #[inline(always)]
    fn grown(self) -> Middles {
        Middles(self.0.map(Bounds::of_lanes))
    }
}

/// Puts what is before the cut at the front of `target` and the rest, in reverse, at its end.
/// Each item is written to both ends, and one end moves on: no branch to guess here either.
#[inline(always)]
pub(super) fn partition(items: &[Item], target: &mut [Item], cut: &Cut) -> Middles {
    let (mut front, mut end) = (0, items.len());
    let mut middles = Growing::new();
    for item in items {
        let middle = cut.middle(item);
        let side = cut.side(middle);
        target[front] = *item;
        target[end - 1] = *item;
        front += 1 - side;
        end -= side;
        middles.grow(middle, side);
    }
    middles.grown()
}

/// Puts what is before the cut into the first list and the rest into the second; there is room for exactly that.
#[inline(always)]
pub(super) fn partition_apart(items: &[Item], targets: [&mut [Item]; 2], cut: &Cut) -> Middles {
    let mut filled = [0; 2];
    let mut middles = Growing::new();
    for item in items {
        let middle = cut.middle(item);
        let side = cut.side(middle);
        targets[side][filled[side]] = *item;
        filled[side] += 1;
        middles.grow(middle, side);
    }
    middles.grown()
}
