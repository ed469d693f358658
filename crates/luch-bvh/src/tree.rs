//! The flat tree: 64-byte nodes that hold the boxes of both children, and the walk of a ray through them.

use crate::slab::{SlabRay, larger};
use crate::{Aabb, Interval};
use glam::Vec3;
use std::ops::Range;

/// No path from the root is longer; the build sees to it.
pub(crate) const MAX_DEPTH: usize = 64;

/// An inner node (`count` 0, `index` into the nodes) or a leaf (`count` primitives from place `index` on).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Child {
    pub(crate) index: u32,
    pub(crate) count: u32,
}

impl Child {
    pub(crate) fn is_leaf(self) -> bool {
        self.count > 0
    }

    pub(crate) fn places(self) -> Range<usize> {
        self.index as usize..(self.index + self.count) as usize
    }
}

/// Two children and their boxes: one cache line.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub(crate) struct Node {
    /// Rows min x, y, z, max x, y, z; one column for each child.
    planes: [[f32; 2]; 6],
    pub(crate) children: [Child; 2],
}

impl Node {
    pub(crate) fn new(children: [Child; 2], bounds: [Aabb; 2]) -> Self {
        let plane = |row: usize| bounds.map(|b| if row < 3 { b.min[row] } else { b.max[row - 3] });
        Self { planes: std::array::from_fn(plane), children }
    }

    pub(crate) fn bounds(&self, side: usize) -> Aabb {
        let corner = |row: usize| {
            Vec3::new(self.planes[row][side], self.planes[row + 1][side], self.planes[row + 2][side])
        };
        Aabb { min: corner(0), max: corner(3) }
    }
}

/// A child still to be visited and where the ray enters it.
#[derive(Clone, Copy, Default)]
struct Waiting {
    child: Child,
    near: f32,
}

/// The children a walk has put off. One serves a whole batch of rays.
pub(crate) struct Stack {
    /// One more than ever wait: the place above the top may be written.
    waiting: [Waiting; MAX_DEPTH + 1],
}

impl Stack {
    pub(crate) fn new() -> Self {
        Self { waiting: [Waiting::default(); MAX_DEPTH + 1] }
    }
}

/// A tree over places 0..n of whatever its owner keeps in the same order.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tree {
    pub(crate) nodes: Vec<Node>,
    pub(crate) root: Child,
    pub(crate) bounds: Aabb,
}

impl Tree {
    /// Hands every leaf that may hold a hit at or before the best one to `visit`, near ones first. `visit` takes the
    /// places of the leaf and the bound so far, and returns the bound from now on; -∞ ends the walk.
    #[inline(always)]
    pub(crate) fn walk(
        &self,
        ray: &SlabRay,
        bound: f32,
        stack: &mut Stack,
        mut visit: impl FnMut(Range<usize>, f32) -> f32,
    ) {
        let mut bound = bound;
        match ray.interval(&self.bounds) {
            Some(interval) if interval.near <= bound => {}
            _ => return,
        }
        // Rows of the planes facing the ray and behind it.
        let rows = [0, 1, 2].map(|axis| if ray.backward[axis] { [axis + 3, axis] } else { [axis, axis + 3] });
        // Near ends of both children, then far ends with the sign changed: four maxima, one vector. A sign rounds nothing.
        let [near, far] = [ray.near_inverse, ray.far_inverse];
        let inverse = [0, 1, 2].map(|axis| [near[axis], near[axis], -far[axis], -far[axis]]);
        let mut height = 0;
        let mut current = self.root;
        loop {
            if current.is_leaf() {
                bound = visit(current.places(), bound);
            } else {
                let node = &self.nodes[current.index as usize];
                let mut ends = [ray.t_min, ray.t_min, -bound, -bound];
                for (axis, rows) in rows.iter().enumerate() {
                    let [facing, behind] = rows.map(|row| node.planes[row]);
                    let planes = [facing[0], facing[1], behind[0], behind[1]];
                    let origin = ray.origin[axis];
                    ends = std::array::from_fn(|lane| {
                        larger(ends[lane], (planes[lane] - origin) * inverse[axis][lane])
                    });
                }
                let [left, right] = [ends[0] <= -ends[2], ends[1] <= -ends[3]];
                if left | right {
                    // No branch decides which child comes first; the other is always written and seldom counted.
                    let next = usize::from(right & (!left | (ends[1] < ends[0])));
                    let later = 1 - next;
                    stack.waiting[height] = Waiting { child: node.children[later], near: ends[later] };
                    height += usize::from(left & right);
                    current = node.children[next];
                    continue;
                }
            }
            loop {
                if height == 0 {
                    return;
                }
                height -= 1;
                let waiting = stack.waiting[height];
                if waiting.near <= bound {
                    current = waiting.child;
                    break;
                }
            }
        }
    }

    /// Hands every leaf that may hold a point at or within the squared distance `bound` to `visit`, near ones first;
    /// `visit` returns the bound from now on.
    pub(crate) fn walk_near(&self, point: Vec3, bound: f32, mut visit: impl FnMut(Range<usize>, f32) -> f32) {
        let mut bound = bound;
        let mut waiting = vec![(self.root, self.bounds.distance_squared(point))];
        if self.bounds.is_empty() {
            return;
        }
        while let Some((child, distance)) = waiting.pop() {
            if distance > bound {
                continue;
            }
            if child.is_leaf() {
                bound = visit(child.places(), bound);
                continue;
            }
            let node = &self.nodes[child.index as usize];
            let distance = [0, 1].map(|side| node.bounds(side).distance_squared(point));
            let nearer = usize::from(distance[1] < distance[0]);
            waiting.push((node.children[1 - nearer], distance[1 - nearer]));
            waiting.push((node.children[nearer], distance[nearer]));
        }
    }

    /// Measures the tree; `primitive_bytes` is what its owner keeps.
    pub(crate) fn statistics(&self, primitive_bytes: usize) -> Statistics {
        let whole = self.bounds.half_area();
        let share = |bounds: &Aabb| if whole > 0.0 { bounds.half_area() / whole } else { 1.0 };
        let mut statistics = Statistics {
            nodes: self.nodes.len(),
            leaves: 0,
            depth: 0,
            expected_cost: 0.0,
            memory_bytes: primitive_bytes + self.nodes.len() * size_of::<Node>(),
        };
        let mut waiting = vec![(self.root, self.bounds, 0)];
        while let Some((child, bounds, depth)) = waiting.pop() {
            if child.is_leaf() {
                statistics.leaves += 1;
                statistics.depth = statistics.depth.max(depth);
                statistics.expected_cost += share(&bounds) * f64::from(child.count);
            } else if let Some(node) = self.nodes.get(child.index as usize) {
                statistics.expected_cost += share(&bounds);
                for side in 0..2 {
                    waiting.push((node.children[side], node.bounds(side), depth + 1));
                }
            }
        }
        statistics
    }
}

/// The size and worth of a tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statistics {
    /// Inner nodes.
    pub nodes: usize,
    /// Leaves.
    pub leaves: usize,
    /// Inner nodes on the longest way from the root to a leaf; 0 for a single leaf.
    pub depth: usize,
    /// What a random ray through the whole box is expected to cost by the surface area heuristic: node visits plus
    /// primitive tests, one each.
    pub expected_cost: f64,
    /// Bytes of nodes and packed primitives.
    pub memory_bytes: usize,
}

/// Whether the clamped end of an interval lets a bound cut it short: beyond the interval's far end it may not.
pub(crate) fn bound_inside(interval: &Interval, bound: f32) -> f32 {
    if interval.far <= bound { f32::INFINITY } else { bound }
}
