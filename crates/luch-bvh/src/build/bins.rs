//! Bins of middles along each axis, and the best plane between two of them.

use super::bounds::{Bounds, Scale};
use super::item::Item;
use super::lanes::Lanes;
use super::plan::Plan;
use std::hint::black_box;

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

/// 2²³ and a multiple of the bins: the sum of this and a number has that number, rounded, as its last bits.
const ROUNDING: f32 = 8_388_640.0;
/// A little less than one: keeps the largest middle out of a bin beyond the last.
const WITHIN: f32 = 1.0 - 1.0 / 1_048_576.0;

impl Grid {
    /// `None` if there is nothing to tell the middles apart by.
    #[inline(always)]
    pub(super) fn new(middles: &Bounds, count: usize, plan: Plan) -> Option<Self> {
        // Few items need few bins: the work at a bin is that of several items.
        let used = (8 + count / 16).min(plan.bins);
        let factor = std::array::from_fn(|axis| {
            let size = middles.high(axis) - middles.low(axis);
            if axis < 3 && size > 0.0 { used as f32 * WITHIN / size } else { 0.0 }
        });
        let tells = factor.iter().any(|factor| *factor > 0.0);
        tells.then_some(Self { scale: plan.scale, low: middles.lows(), factor, used })
    }

    /// The bins along all axes. They never fall as the middle rises, and what is not a number goes into the first: its last bits
    /// are zeroes. Middles lie inside the box of middles, so there is nothing to clamp.
    #[inline(always)]
    fn places(&self, middle: Lanes<8>) -> [u32; 4] {
        let [x, y, z, w, ..] = middle.0;
        let place = (Lanes([x, y, z, w]) - Lanes(self.low)) * Lanes(self.factor);
        let rounded = place - Lanes::<4>::splat(0.5) + Lanes::<4>::splat(ROUNDING);
        rounded.0.map(|place| place.to_bits() & (MAX_BINS as u32 - 1))
    }
}

/// Which side of a split an item belongs to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut {
    grid: Grid,
    /// The first bin behind the cut, and along the other axes the first of all.
    limits: [u32; 4],
}

impl Cut {
    #[inline(always)]
    pub(super) fn new(grid: Grid, best: &Candidate) -> Self {
        let mut limits = [0; 4];
        limits[best.axis % 4] = best.at as u32;
        Self { grid, limits }
    }

    /// 0 for a middle before the cut, 1 for one behind it.
    #[inline(always)]
    pub(super) fn side(&self, middle: Lanes<8>) -> usize {
        let places = self.grid.places(middle);
        // Not to be guessed: the compiler would make a branch of it.
        let before = (0..4).fold(false, |before, axis| before | (places[axis] < self.limits[axis]));
        black_box(usize::from(!before))
    }

    /// The middle of an item.
    #[inline(always)]
    pub(super) fn middle(&self, item: &Item) -> Lanes<8> {
        self.grid.scale.middle(&item.bounds())
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
    bounds: [[Bounds; 3]; MAX_BINS],
    /// The fourth of each stays 0.
    counts: [[u32; 4]; MAX_BINS],
    used: usize,
}

impl Bins {
    pub(super) fn new() -> Self {
        Self { bounds: [[Bounds::EMPTY; 3]; MAX_BINS], counts: [[0; 4]; MAX_BINS], used: 0 }
    }

    /// Empties the bins and fills them with the items.
    #[inline(always)]
    pub(super) fn fill(&mut self, items: &[Item], grid: &Grid) {
        self.used = grid.used.min(MAX_BINS);
        self.bounds[..self.used].fill([Bounds::EMPTY; 3]);
        self.counts[..self.used].fill([0; 4]);
        // Known to be all ones to the reader alone: see `Lanes::masked`.
        let ones = black_box(u32::MAX);
        let mut seen = [0; 4];
        for item in items {
            let bounds = item.bounds();
            let places = grid.places(grid.scale.middle(&bounds));
            for (seen, place) in seen.iter_mut().zip(places) {
                *seen |= place;
            }
            for (axis, place) in places.into_iter().take(3).enumerate() {
                let place = place as usize % MAX_BINS;
                let bin = &mut self.bounds[place][axis];
                *bin = Bounds::of_lanes(bin.lanes().smaller(bounds.lanes()).masked(ones));
                self.counts[place][axis] += 1;
            }
        }
        // Asks for all four lanes, so that they are computed as one vector and not three numbers.
        black_box(seen);
    }

    /// Adds what other bins of the same grid hold.
    pub(super) fn merge(&mut self, other: &Self) {
        self.used = other.used;
        for place in 0..other.used {
            for axis in 0..3 {
                self.bounds[place][axis] = self.bounds[place][axis].union(&other.bounds[place][axis]);
                self.counts[place][axis] += other.counts[place][axis];
            }
        }
    }

    /// The plane with the least sum of area times blocks; the first of equals. `None` if all middles share a bin, or where
    /// boxes have no end. The axes go side by side, one in each lane.
    #[inline(always)]
    pub(super) fn best(&self, plan: Plan) -> Option<Candidate> {
        let used = self.used.min(MAX_BINS);
        let mut behind = [[0.0; 4]; MAX_BINS];
        let mut right = [Bounds::EMPTY; 3];
        let mut all = [0; 4];
        for at in (1..used).rev() {
            self.gather(at, &mut right, &mut all);
            behind[at] = plan.costs(&right, all);
        }
        let mut left = [Bounds::EMPTY; 3];
        let mut before = [0; 4];
        for (all, first) in all.iter_mut().zip(self.counts[0]) {
            *all += first;
        }
        let mut least = [f32::INFINITY; 4];
        let mut places = [0; 4];
        for (at, behind) in behind.iter().enumerate().take(used).skip(1) {
            self.gather(at - 1, &mut left, &mut before);
            let costs = plan.costs(&left, before);
            for lane in 0..4 {
                let cost = costs[lane] + behind[lane];
                let better = (cost < least[lane]) & (before[lane] > 0) & (before[lane] < all[lane]);
                least[lane] = if better { cost } else { least[lane] };
                places[lane] = if better { at as u32 } else { places[lane] };
            }
        }
        let axis = (1..3).fold(0, |best, axis| if least[axis] < least[best] { axis } else { best });
        let at = places[axis] as usize;
        (at > 0).then_some(Candidate { cost: least[axis], axis, at })
    }

    /// Adds the bins at a place along all axes.
    #[inline(always)]
    fn gather(&self, place: usize, bounds: &mut [Bounds; 3], counts: &mut [u32; 4]) {
        for (all, bin) in bounds.iter_mut().zip(&self.bounds[place]) {
            *all = all.union(bin);
        }
        for (all, count) in counts.iter_mut().zip(self.counts[place]) {
            *all += count;
        }
    }

    /// The boxes of both sides of a split.
    #[inline(always)]
    pub(super) fn sides(&self, split: &Candidate) -> [Bounds; 2] {
        let union = |bins: &[[Bounds; 3]]| {
            bins.iter().fold(Bounds::EMPTY, |all, bounds| all.union(&bounds[split.axis % 3]))
        };
        let (left, right) = self.bounds[..self.used].split_at(split.at);
        [union(left), union(right)]
    }

    /// How many items lie before a split.
    pub(super) fn before(&self, split: &Candidate) -> usize {
        self.counts[..split.at].iter().map(|counts| counts[split.axis] as usize).sum()
    }
}
