//! Bins of centroids along each axis, and the best plane between two of them.

use super::{Candidate, PARALLEL, Reference, Settings, widest};
use crate::Aabb;
use glam::Vec3;
use rayon::prelude::*;

const MAX_BINS: usize = 32;

#[derive(Clone, Copy)]
struct Bin {
    bounds: Aabb,
    count: u32,
}

const EMPTY: Bin = Bin { bounds: Aabb::empty(), count: 0 };

/// Centroids sorted roughly along each axis.
#[derive(Clone)]
pub(super) struct Bins {
    bins: [[Bin; MAX_BINS]; 3],
    used: usize,
    axes: std::ops::Range<usize>,
    low: Vec3,
    scale: Vec3,
}

impl Bins {
    pub(super) fn of(references: &[Reference], centroids: &Aabb, settings: Settings) -> Self {
        let used = settings.bins.min(references.len().max(4));
        let size = centroids.max - centroids.min;
        let axes = if settings.all_axes { 0..3 } else { widest(size)..widest(size) + 1 };
        let scale = Vec3::from_array(size.to_array().map(|size| used as f32 / size));
        let mut bins = Self { bins: [[EMPTY; MAX_BINS]; 3], used, axes, low: centroids.min, scale };
        if references.len() > PARALLEL {
            let empty = bins.clone();
            let filled = references.par_chunks(PARALLEL).map(|chunk| {
                let mut bins = empty.clone();
                bins.add(chunk);
                bins
            });
            bins = filled.reduce(|| empty.clone(), Self::merged);
        } else {
            bins.add(references);
        }
        bins
    }

    fn add(&mut self, references: &[Reference]) {
        for reference in references {
            for axis in self.axes.clone() {
                let place = self.place(reference, axis);
                let bin = &mut self.bins[axis][place];
                bin.bounds = bin.bounds.union(&reference.bounds);
                bin.count += 1;
            }
        }
    }

    fn merged(mut self, other: Self) -> Self {
        for axis in self.axes.clone() {
            for (bin, more) in self.bins[axis].iter_mut().zip(&other.bins[axis]) {
                bin.bounds = bin.bounds.union(&more.bounds);
                bin.count += more.count;
            }
        }
        self
    }

    /// The bin of a reference. The cast turns what is not a number, 0·∞ where all centroids agree, into bin 0.
    #[inline(always)]
    pub(super) fn place(&self, reference: &Reference, axis: usize) -> usize {
        let centroid = reference.bounds.min[axis] * 0.5 + reference.bounds.max[axis] * 0.5;
        let place = ((centroid - self.low[axis]) * self.scale[axis]) as u32;
        place.min(self.used as u32 - 1) as usize
    }

    /// The plane with the least sum of area times count; the first of equals. `None` if all centroids share a bin.
    pub(super) fn best(&self) -> Option<Candidate> {
        let mut best: Option<Candidate> = None;
        for axis in self.axes.clone() {
            let bins = &self.bins[axis][..self.used];
            let mut behind = [0.0; MAX_BINS];
            let mut right = EMPTY;
            for at in (1..self.used).rev() {
                right.bounds = right.bounds.union(&bins[at].bounds);
                right.count += bins[at].count;
                behind[at] = right.bounds.half_area() * f64::from(right.count);
            }
            let all = right.count + bins[0].count;
            let mut left = EMPTY;
            for at in 1..self.used {
                left.bounds = left.bounds.union(&bins[at - 1].bounds);
                left.count += bins[at - 1].count;
                let cost = left.bounds.half_area() * f64::from(left.count) + behind[at];
                let splits = left.count > 0 && left.count < all;
                if splits && cost < best.map_or(f64::INFINITY, |best| best.cost) {
                    best = Some(Candidate { cost, axis, at });
                }
            }
        }
        best
    }
}
