//! Bins of middles along each axis, and the best plane between two of them.

use super::binned::{PORTION, Plan};
use super::bounds::{Bounds, Scale};
use super::item::Item;
use rayon::prelude::*;

/// The most bins along an axis; a power of two.
const MAX_BINS: usize = 32;

/// Which bin a middle belongs to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    scale: Scale,
    low: [f32; 4],
    factor: [f32; 4],
    used: usize,
}

/// 2²³: the sum of this and a number from 0 to 2²² has that number, rounded, as its last bits.
const ROUNDING: f32 = 8_388_608.0;

impl Grid {
    /// `None` if there is nothing to tell the middles apart by.
    pub(super) fn new(middles: &Bounds, count: usize, plan: Plan) -> Option<Self> {
        // Few items need few bins: the work at a bin is that of several items.
        let used = (8 + count / 16).min(plan.bins);
        let factor = std::array::from_fn(|axis| {
            let size = middles.high[axis] - middles.low[axis];
            if axis < 3 && size > 0.0 { used as f32 / size } else { 0.0 }
        });
        let tells = factor.iter().any(|factor| *factor > 0.0);
        tells.then_some(Self { scale: plan.scale, low: middles.low, factor, used })
    }

    /// The bin along one axis. It never falls as the middle rises, and what is not a number goes into the first.
    #[inline(always)]
    fn place(&self, middle: f32, axis: usize) -> u32 {
        let place = (middle - self.low[axis]) * self.factor[axis] - 0.5;
        let place = if place > 0.0 { place } else { 0.0 };
        let last = (self.used - 1) as f32;
        let place = if place < last { place } else { last };
        (place + ROUNDING).to_bits() & (MAX_BINS as u32 - 1)
    }

    #[inline(always)]
    pub(super) fn place_along(&self, middle: f32, axis: usize) -> usize {
        self.place(middle, axis) as usize
    }

    /// The bins along all axes.
    #[inline(always)]
    fn places(&self, bounds: &Bounds) -> [u32; 4] {
        let middle = self.scale.middle(bounds);
        std::array::from_fn(|axis| self.place(middle[axis], axis))
    }
}

/// Where a node is best split.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    pub(super) cost: f32,
    pub(super) axis: usize,
    /// The first bin of the second part.
    pub(super) at: usize,
}

/// Middles sorted roughly along each axis.
#[derive(Clone)]
pub(super) struct Bins {
    bounds: [[Bounds; MAX_BINS]; 3],
    counts: [[u32; MAX_BINS]; 3],
    used: usize,
}

impl Bins {
    pub(super) fn new() -> Self {
        Self { bounds: [[Bounds::EMPTY; MAX_BINS]; 3], counts: [[0; MAX_BINS]; 3], used: 0 }
    }

    /// Empties the bins and fills them with the items.
    pub(super) fn fill(&mut self, items: &[Item], grid: Grid) {
        self.used = grid.used;
        for axis in 0..3 {
            self.bounds[axis][..grid.used].fill(Bounds::EMPTY);
            self.counts[axis][..grid.used].fill(0);
        }
        if items.len() > 2 * PORTION {
            let filled = items.par_chunks(PORTION).map(|portion| {
                let mut bins = Box::new(Self::new());
                bins.add(portion, grid);
                bins
            });
            if let Some(bins) = filled.reduce_with(Self::merged) {
                self.bounds = bins.bounds;
                self.counts = bins.counts;
            }
        } else {
            self.add(items, grid);
        }
    }

    #[inline(always)]
    fn add(&mut self, items: &[Item], grid: Grid) {
        for item in items {
            let bounds = item.bounds();
            let places = grid.places(&bounds);
            for ((bins, counts), place) in self.bounds.iter_mut().zip(&mut self.counts).zip(places) {
                let place = place as usize % MAX_BINS;
                bins[place] = bins[place].union(&bounds);
                counts[place] += 1;
            }
        }
    }

    fn merged(mut self: Box<Self>, other: Box<Self>) -> Box<Self> {
        for axis in 0..3 {
            for place in 0..MAX_BINS {
                self.bounds[axis][place] = self.bounds[axis][place].union(&other.bounds[axis][place]);
                self.counts[axis][place] += other.counts[axis][place];
            }
        }
        self
    }

    /// The plane with the least sum of area times blocks; the first of equals. `None` if all middles share a bin, or where
    /// boxes have no end.
    pub(super) fn best(&self, plan: Plan) -> Option<Candidate> {
        let mut best: Option<Candidate> = None;
        let mut least = f32::INFINITY;
        for axis in 0..3 {
            let bounds = &self.bounds[axis][..self.used];
            let counts = &self.counts[axis][..self.used];
            let mut behind = [0.0; MAX_BINS];
            let mut right = Bounds::EMPTY;
            let mut all = 0;
            for at in (1..self.used).rev() {
                right = right.union(&bounds[at]);
                all += counts[at];
                behind[at] = plan.scale.half_area(&right) * plan.blocks(all);
            }
            all += counts[0];
            let mut left = Bounds::EMPTY;
            let mut before = 0;
            for at in 1..self.used {
                left = left.union(&bounds[at - 1]);
                before += counts[at - 1];
                let cost = plan.scale.half_area(&left) * plan.blocks(before) + behind[at];
                if cost < least && before > 0 && before < all {
                    least = cost;
                    best = Some(Candidate { cost, axis, at });
                }
            }
        }
        best
    }

    /// The boxes of both sides of a split.
    pub(super) fn sides(&self, split: &Candidate) -> [Bounds; 2] {
        let union = |bins: &[Bounds]| bins.iter().fold(Bounds::EMPTY, |all, bounds| all.union(bounds));
        let (left, right) = self.bounds[split.axis][..self.used].split_at(split.at);
        [union(left), union(right)]
    }
}
