//! Every split of the sorted centroids, for nodes of few references.

use super::{Candidate, Reference};
use crate::Aabb;
use std::cmp::Ordering;

/// The order along an axis: by centroid, then by primitive, so that no two are equal.
pub(super) fn along(axis: usize) -> impl FnMut(&Reference, &Reference) -> Ordering {
    let key =
        move |reference: &Reference| reference.bounds.min[axis] * 0.5 + reference.bounds.max[axis] * 0.5;
    move |a, b| key(a).total_cmp(&key(b)).then(a.primitive.cmp(&b.primitive))
}

pub(super) fn sort(references: &mut [Reference], axis: usize) {
    references.sort_unstable_by(along(axis));
}

/// The split with the least sum of area times count; the first of equals. Leaves the references in some order.
pub(super) fn best(references: &mut [Reference]) -> Option<Candidate> {
    let count = references.len();
    let mut best: Option<Candidate> = None;
    let mut behind = [0.0; super::MAX_SWEEP];
    for axis in 0..3 {
        sort(references, axis);
        let mut right = Aabb::empty();
        for at in (1..count).rev() {
            right = right.union(&references[at].bounds);
            behind[at] = right.half_area() * (count - at) as f64;
        }
        let mut left = Aabb::empty();
        for at in 1..count {
            left = left.union(&references[at - 1].bounds);
            let cost = left.half_area() * at as f64 + behind[at];
            if cost < best.map_or(f64::INFINITY, |best| best.cost) {
                best = Some(Candidate { cost, axis, at });
            }
        }
    }
    best
}
