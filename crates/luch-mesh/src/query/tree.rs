//! A tree of boxes over triangles: the frame of nearest points, winding numbers and overlaps.
//!
//! Triangles stand in the order of a space-filling curve (Morton codes of their middles); the tree over that order is a
//! complete binary one, so it needs no pointers: the children of node `n` are `2n` and `2n + 1`. The same for any number of
//! threads.

use glam::Vec3;
use luch_bvh::Aabb;
use rayon::prelude::*;

/// Triangles in a leaf.
const LEAF: usize = 4;

pub(crate) struct BoxTree {
    /// Triangle numbers along the curve.
    order: Vec<u32>,
    /// Node 1 is the root; nodes from `leaves` on are leaves.
    boxes: Vec<Aabb>,
    leaves: usize,
}

impl BoxTree {
    /// A tree over boxes; those that are empty or not finite are left out.
    pub(crate) fn new(count: usize, bounds_of: impl Fn(usize) -> Aabb + Sync) -> Self {
        let is_sound = |bounds: &Aabb| !bounds.is_empty() && bounds.min.is_finite() && bounds.max.is_finite();
        let whole = (0..count)
            .into_par_iter()
            .map(&bounds_of)
            .filter(is_sound)
            .reduce(Aabb::empty, |one, other| one.union(&other));
        let origin = whole.min.as_dvec3();
        let extent = (whole.max.as_dvec3() - origin).max_element().max(f64::MIN_POSITIVE);
        let code = |bounds: &Aabb| {
            let middle = (bounds.min.as_dvec3() + bounds.max.as_dvec3()) / 2.0 - origin;
            let [x, y, z] = (middle / extent * 2_097_151.0).to_array().map(|along| spread(along as u64));
            x | y << 1 | z << 2
        };
        let mut keyed: Vec<(u64, u32)> = (0..count as u32)
            .into_par_iter()
            .filter_map(|i| {
                let bounds = bounds_of(i as usize);
                is_sound(&bounds).then(|| (code(&bounds), i))
            })
            .collect();
        keyed.par_sort_unstable();
        let order: Vec<u32> = keyed.par_iter().map(|&(_, triangle)| triangle).collect();
        drop(keyed);
        let leaves = order.len().div_ceil(LEAF).next_power_of_two();
        let mut boxes = vec![Aabb::empty(); 2 * leaves];
        boxes[leaves..].par_iter_mut().zip(order.par_chunks(LEAF)).for_each(|(leaf, triangles)| {
            for &triangle in triangles {
                *leaf = leaf.union(&bounds_of(triangle as usize));
            }
        });
        let mut first = leaves / 2;
        while first > 0 {
            let (above, below) = boxes.split_at_mut(2 * first);
            above[first..].par_iter_mut().zip(below.par_chunks(2)).for_each(|(node, children)| {
                *node = children[0].union(&children[1]);
            });
            first /= 2;
        }
        Self { order, boxes, leaves }
    }

    /// The triangles along the curve.
    pub(crate) fn order(&self) -> &[u32] {
        &self.order
    }

    /// True if there is nothing in the tree.
    pub(crate) fn is_empty(&self) -> bool {
        self.order.is_empty()
    }

    /// How many nodes there are, numbered from 1; the numbers below are those of leaves' ancestors.
    pub(crate) fn node_count(&self) -> usize {
        self.boxes.len()
    }

    /// The box of a node.
    pub(crate) fn bounds(&self, node: usize) -> &Aabb {
        &self.boxes[node]
    }

    /// The triangles of a leaf; `None` for inner nodes.
    pub(crate) fn leaf(&self, node: usize) -> Option<&[u32]> {
        let leaf = node.checked_sub(self.leaves)?;
        let start = (leaf * LEAF).min(self.order.len());
        Some(&self.order[start..(start + LEAF).min(self.order.len())])
    }

    /// Hands the triangles of all leaves whose box meets `bounds` to `visit`, until it returns false.
    pub(crate) fn overlapping(&self, bounds: &Aabb, mut visit: impl FnMut(u32) -> bool) {
        let meets = |node: usize| {
            let other = &self.boxes[node];
            bounds.min.cmple(other.max).all() && other.min.cmple(bounds.max).all()
        };
        let mut stack = [0usize; 64];
        let mut height = 1;
        stack[0] = 1;
        while height > 0 {
            height -= 1;
            let node = stack[height];
            if !meets(node) {
                continue;
            }
            if let Some(triangles) = self.leaf(node) {
                if !triangles.iter().all(|&triangle| visit(triangle)) {
                    return;
                }
            } else {
                stack[height] = 2 * node + 1;
                stack[height + 1] = 2 * node;
                height += 2;
            }
        }
    }
}

/// The box of a triangle's corners.
pub(crate) fn bounds_of(corners: [Vec3; 3]) -> Aabb {
    let [a, b, c] = corners;
    Aabb { min: a.min(b).min(c), max: a.max(b).max(c) }
}

/// Puts two zeros after each of the lowest 21 bits.
fn spread(number: u64) -> u64 {
    let mut bits = number & 0x1f_ffff;
    bits = (bits | bits << 32) & 0x001f_0000_0000_ffff;
    bits = (bits | bits << 16) & 0x001f_0000_ff00_00ff;
    bits = (bits | bits << 8) & 0x100f_00f0_0f00_f00f;
    bits = (bits | bits << 4) & 0x10c3_0c30_c30c_30c3;
    (bits | bits << 2) & 0x1249_2492_4924_9249
}
