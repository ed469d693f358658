//! What a top-down build aims at, and how far its items reach.

use super::bounds::{Bounds, Scale};
use super::item::Item;
use super::lanes::{Lanes, run};
use crate::simd::Task;
use rayon::prelude::*;

/// The items are measured by threads in portions of so many.
const PORTION: usize = 8192;

/// What a top-down build aims at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plan {
    pub(super) scale: Scale,
    /// The most items of a leaf: two to this power.
    pub(super) leaf_bits: u32,
    /// The most bins along an axis.
    pub(super) bins: usize,
    /// The longest way through the tree.
    pub(super) depth: u32,
}

impl Plan {
    /// The most items of a leaf.
    #[inline(always)]
    pub(super) fn leaf(self) -> usize {
        1 << self.leaf_bits
    }

    /// Leaf blocks that so many items need.
    #[inline(always)]
    pub(super) fn blocks(self, count: u32) -> f32 {
        // Not more than 2³¹ blocks: as a signed number it is one instruction to convert.
        let more = (1 << self.leaf_bits) - 1;
        ((count >> self.leaf_bits) as i32 + i32::from(count & more > 0)) as f32
    }

    /// Area times blocks of three boxes.
    #[inline(always)]
    pub(super) fn costs(self, boxes: &[Bounds; 3], counts: [u32; 4]) -> [f32; 4] {
        let blocks = counts.map(|count| self.blocks(count));
        (self.scale.half_areas(boxes) * Lanes(blocks)).0
    }
}

/// The box of some items and the box of their middles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    pub(super) bounds: Bounds,
    pub(super) middles: Bounds,
}

impl Extent {
    const EMPTY: Self = Self { bounds: Bounds::EMPTY, middles: Bounds::EMPTY };

    /// On all threads.
    pub(super) fn of(items: &[Item], scale: Scale) -> Self {
        let portions = items.par_chunks(PORTION).map(|items| run(Measure { items, scale }));
        portions.reduce(|| Self::EMPTY, |a, b| a.union(&b))
    }

    #[inline(always)]
    pub(super) fn within(items: &[Item], scale: Scale) -> Self {
        let mut bounds = Lanes::<8>::splat(f32::INFINITY);
        let mut middles = bounds;
        for item in items {
            bounds = bounds.smaller(item.bounds().lanes());
            middles = middles.smaller(scale.middle(&item.bounds()));
        }
        Self { bounds: Bounds::of_lanes(bounds), middles: Bounds::of_lanes(middles) }
    }

    fn union(&self, other: &Self) -> Self {
        Self { bounds: self.bounds.union(&other.bounds), middles: self.middles.union(&other.middles) }
    }
}

struct Measure<'a> {
    items: &'a [Item],
    scale: Scale,
}

impl Task for Measure<'_> {
    type Output = Extent;
    #[inline(always)]
    fn run(self) -> Extent {
        Extent::within(self.items, self.scale)
    }
}
