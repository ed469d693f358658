//! Groups of lights that are near one another and shine the same way: how the tree of lights is built.
//!
//! Groups are split where intensity × extent² × spread of normals of both parts is least (the surface area orientation heuristic
//! of Conty Estevez and Kulla 2018, on 12 bins along each axis), until a node has eight. The result does not depend on threads.

use super::bounds::{LightBounds, union};
use super::node::{LEAF, Node, WIDTH};
use glam::Vec3;
use rayon::prelude::*;
use std::ops::Range;

/// Bins along an axis.
const BINS: usize = 12;

/// From this depth on groups are halved by number, so that no arrangement makes the tree too deep for a trail.
const DEEP: u32 = 10;

/// Below this number of lights a part is built by one thread.
const PARALLEL: usize = 8192;

/// An emitter to be put into the tree.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leaf {
    pub(crate) bounds: LightBounds,
    pub(crate) emitter: u32,
}

/// The nodes over leaves, of which there is at least one; the first is the root, children count from the start of the list.
pub(crate) fn nodes(leaves: &mut [Leaf], depth: u32) -> Vec<Node> {
    let groups = groups(leaves, depth);
    let mut node = Node::empty();
    let mut parts: Vec<&mut [Leaf]> = Vec::with_capacity(groups.len());
    let mut rest = leaves;
    for group in &groups {
        let (part, others) = rest.split_at_mut(group.len());
        parts.push(part);
        rest = others;
    }
    let bounds: Vec<LightBounds> = parts.iter().map(|part| union_of(part)).collect();
    let subtree = |part: &mut &mut [Leaf]| if part.len() > 1 { nodes(part, depth + 1) } else { Vec::new() };
    let subtrees: Vec<Vec<Node>> = match groups.iter().map(Range::len).sum::<usize>() >= PARALLEL {
        true => parts.par_iter_mut().map(subtree).collect(),
        false => parts.iter_mut().map(subtree).collect(),
    };
    let mut all = Vec::with_capacity(1 + subtrees.iter().map(Vec::len).sum::<usize>());
    all.push(Node::empty());
    for (lane, (part, mut subtree)) in parts.iter().zip(subtrees).enumerate() {
        let first = all.len() as u32;
        let child = if part.len() == 1 { LEAF | part[0].emitter } else { first };
        node.set(lane, &bounds[lane], child);
        for below in &mut subtree {
            below.shift(first);
        }
        all.append(&mut subtree);
    }
    all[0] = node;
    all
}

fn union_of(part: &[Leaf]) -> LightBounds {
    match part {
        [leaf] => leaf.bounds,
        _ => union(part),
    }
}

/// Splits a group until there are eight or each has one light.
fn groups(leaves: &mut [Leaf], depth: u32) -> Vec<Range<usize>> {
    if leaves.len() <= WIDTH {
        return (0..leaves.len()).map(|i| i..i + 1).collect();
    }
    let mut groups = Vec::with_capacity(WIDTH);
    groups.push(0..leaves.len());
    while groups.len() < WIDTH {
        // The largest group, the first of equals.
        let mut largest = 0;
        for (i, group) in groups.iter().enumerate() {
            if group.len() > groups[largest].len() {
                largest = i;
            }
        }
        let group = groups[largest].clone();
        if group.len() < 2 {
            break;
        }
        let middle = group.start + split(&mut leaves[group.clone()], depth >= DEEP);
        groups[largest] = group.start..middle;
        groups.insert(largest + 1, middle..group.end);
    }
    groups
}

/// What a bin holds.
#[derive(Clone, Copy)]
struct Bin {
    low: Vec3,
    high: Vec3,
    axes: Vec3,
    intensity: f32,
    count: usize,
}

impl Bin {
    const EMPTY: Bin =
        Bin { low: Vec3::INFINITY, high: Vec3::NEG_INFINITY, axes: Vec3::ZERO, intensity: 0.0, count: 0 };

    fn add(&mut self, bounds: &LightBounds) {
        self.low = self.low.min(bounds.center - bounds.radius);
        self.high = self.high.max(bounds.center + bounds.radius);
        // What shines all round has no direction.
        if bounds.cos_normals > 0.0 {
            self.axes += bounds.axis * bounds.intensity;
        }
        self.intensity += bounds.intensity;
        self.count += 1;
    }

    fn join(&self, other: &Bin) -> Bin {
        Bin {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            axes: self.axes + other.axes,
            intensity: self.intensity + other.intensity,
            count: self.count + other.count,
        }
    }

    fn cost(&self) -> f32 {
        if self.count == 0 {
            return 0.0;
        }
        // The mean of unit vectors is as long as they agree. The measure of the paper runs from π for one normal to 4π for all.
        let agreement = (self.axes.length() / self.intensity).min(1.0);
        self.intensity * (self.high - self.low).length_squared() * (4.0 - 3.0 * agreement)
    }
}

/// Puts the leaves into two parts, and returns where the second begins.
fn split(leaves: &mut [Leaf], by_number: bool) -> usize {
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for leaf in leaves.iter() {
        low = low.min(leaf.bounds.center);
        high = high.max(leaf.bounds.center);
    }
    let extent = high - low;
    let widest = extent.max_element();
    let half = leaves.len() / 2;
    if widest <= 0.0 {
        return half;
    }
    if by_number {
        let axis = (0..3).find(|&i| extent[i] == widest).unwrap_or(0);
        let key = |leaf: &Leaf| (leaf.bounds.center[axis], leaf.emitter);
        leaves.select_nth_unstable_by(half, |a, b| {
            let (a, b) = (key(a), key(b));
            a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))
        });
        return half;
    }
    let scale = extent.map(|e| if e > 0.0 { BINS as f32 / e } else { 0.0 });
    let bin_of =
        |center: Vec3, axis: usize| (((center[axis] - low[axis]) * scale[axis]) as usize).min(BINS - 1);
    let mut bins = [[Bin::EMPTY; BINS]; 3];
    for leaf in leaves.iter() {
        for (axis, bins) in bins.iter_mut().enumerate() {
            bins[bin_of(leaf.bounds.center, axis)].add(&leaf.bounds);
        }
    }
    let mut best: Option<(f32, usize, usize)> = None;
    for (axis, bins) in bins.iter().enumerate() {
        if extent[axis] <= 0.0 {
            continue;
        }
        let mut after = [Bin::EMPTY; BINS + 1];
        for i in (0..BINS).rev() {
            after[i] = after[i + 1].join(&bins[i]);
        }
        let mut before = Bin::EMPTY;
        for i in 1..BINS {
            before = before.join(&bins[i - 1]);
            if before.count == 0 || after[i].count == 0 {
                continue;
            }
            // Thin parts are no better for being thin across a short side.
            let cost = (before.cost() + after[i].cost()) * (widest / extent[axis]);
            if best.is_none_or(|(least, ..)| cost < least) {
                best = Some((cost, axis, i));
            }
        }
    }
    let Some((_, axis, border)) = best else { return half };
    let mut middle = 0;
    for i in 0..leaves.len() {
        if bin_of(leaves[i].bounds.center, axis) < border {
            leaves.swap(i, middle);
            middle += 1;
        }
    }
    middle
}
