//! Top-down: sort the middles into bins along each axis and split between two of them.
//!
//! Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies" (2007). A leaf costs what its blocks of four cost, not
//! its primitives, and four or fewer are never split. Counts, minima and maxima are all that is gathered across threads,
//! and those are exact in any grouping, so the tree is the same for any number of threads.

use super::binary::{BinaryNode, Grown, Piece};
use super::bins::{Bins, Grid};
use super::bounds::{Bounds, Scale};
use super::few;
use super::item::Item;
use super::partition::{partition, partition_parallel};
use rayon::prelude::*;

/// No way through a binary tree is longer, unless there are more than 2²⁶ items; then it is by some levels.
pub(super) const MAX_DEPTH: u32 = 64;
/// Pieces of the tree with more items are shared out to threads.
const PIECE: usize = 4096;
/// The items of one node are shared out to threads in portions of so many.
pub(super) const PORTION: usize = 8192;

/// What a top-down build aims at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plan {
    pub(super) scale: Scale,
    /// The most items of a leaf: a power of two.
    pub(super) leaf: usize,
    /// The most bins along an axis.
    pub(super) bins: usize,
    /// The longest way through the tree.
    pub(super) depth: u32,
}

impl Plan {
    /// Leaf blocks that so many items need.
    #[inline(always)]
    pub(super) fn blocks(self, count: u32) -> f32 {
        count.div_ceil(self.leaf as u32) as f32
    }
}

/// The box of some items and the box of their middles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    pub(super) bounds: Bounds,
    pub(super) middles: Bounds,
}

impl Extent {
    pub(super) fn of(items: &[Item], scale: Scale) -> Self {
        let empty = Self { bounds: Bounds::EMPTY, middles: Bounds::EMPTY };
        if items.len() > 2 * PORTION {
            let portions = items.par_chunks(PORTION).map(|portion| Self::of(portion, scale));
            return portions.reduce(
                || empty,
                |a, b| Self { bounds: a.bounds.union(&b.bounds), middles: a.middles.union(&b.middles) },
            );
        }
        let mut extent = empty;
        for item in items {
            let bounds = item.bounds();
            extent.bounds = extent.bounds.union(&bounds);
            extent.middles.grow(scale.middle(&bounds));
        }
        extent
    }
}

/// Two buffers of the same length; the items lie in the first.
pub(super) struct Buffers<'a> {
    pub(super) items: &'a mut [Item],
    pub(super) spare: &'a mut [Item],
}

impl<'a> Buffers<'a> {
    /// Both sides of a split whose items lie in the second buffer.
    fn split(self, at: usize) -> [Buffers<'a>; 2] {
        let (items, more_items) = self.spare.split_at_mut(at);
        let (spare, more_spare) = self.items.split_at_mut(at);
        [Buffers { items, spare }, Buffers { items: more_items, spare: more_spare }]
    }
}

/// Grows the tree over the items, of which there is at least one.
pub(super) fn grow(buffers: Buffers, depth: u32, plan: Plan) -> Piece {
    if buffers.items.len() <= PIECE {
        let mut grower = Grower::new(buffers.items.len(), plan);
        grower.grow(buffers, depth, 0);
        return Piece::Grown(grower.grown);
    }
    let extent = Extent::of(buffers.items, plan.scale);
    let at = split(&mut Bins::new(), buffers.items, buffers.spare, &extent, depth, plan);
    let [left, right] = buffers.split(at);
    let (left, right) = rayon::join(|| grow(left, depth + 1, plan), || grow(right, depth + 1, plan));
    Piece::Pair(extent.bounds, Box::new([left, right]))
}

/// Grows several trees on one thread, one over each group of items; the groups are told by their ends. The roots come first.
pub(super) fn grow_side_by_side(
    buffers: Buffers,
    ends: impl ExactSizeIterator<Item = usize>,
    depth: u32,
    plan: Plan,
) -> Grown {
    let mut grower = Grower::new(buffers.items.len(), plan);
    grower.grown.nodes.resize(ends.len(), BinaryNode::leaf(&Bounds::EMPTY, 0, 0));
    let Buffers { mut items, mut spare } = buffers;
    let mut start = 0;
    for (place, end) in ends.enumerate() {
        let (mine, others) = items.split_at_mut(end - start);
        items = others;
        let (mine_spare, others) = spare.split_at_mut(end - start);
        spare = others;
        start = end;
        grower.grow(Buffers { items: mine, spare: mine_spare }, depth, place);
    }
    grower.grown
}

/// Grows one piece on one thread.
struct Grower {
    grown: Grown,
    bins: Bins,
    plan: Plan,
}

impl Grower {
    fn new(count: usize, plan: Plan) -> Self {
        let mut nodes = Vec::with_capacity(2 * count / plan.leaf + 1);
        nodes.push(BinaryNode::leaf(&Bounds::EMPTY, 0, 0));
        Self { grown: Grown { nodes, order: Vec::with_capacity(count) }, bins: Bins::new(), plan }
    }

    fn grow(&mut self, buffers: Buffers, depth: u32, place: usize) {
        let extent = Extent::of(buffers.items, self.plan.scale);
        let count = buffers.items.len();
        if count <= self.plan.leaf {
            let first = self.grown.order.len() as u32;
            self.grown.order.extend(buffers.items.iter().map(Item::primitive));
            self.grown.nodes[place] = BinaryNode::leaf(&extent.bounds, first, count as u32);
            return;
        }
        let at = split(&mut self.bins, buffers.items, buffers.spare, &extent, depth, self.plan);
        let children = self.grown.nodes.len();
        self.grown.nodes[place] = BinaryNode::inner(&extent.bounds, children as u32);
        self.grown.nodes.extend([BinaryNode::leaf(&Bounds::EMPTY, 0, 0); 2]);
        let [left, right] = buffers.split(at);
        self.grow(left, depth + 1, children);
        self.grow(right, depth + 1, children + 1);
    }
}

/// Puts the items into `spare`, those of the first child before the others, and returns how many they are.
fn split(
    bins: &mut Bins,
    items: &mut [Item],
    spare: &mut [Item],
    extent: &Extent,
    depth: u32,
    plan: Plan,
) -> usize {
    let count = items.len();
    if plan.leaf < count && count <= 2 * plan.leaf && plan.leaf == few::LEAF {
        return few::split(items, spare, plan.scale);
    }
    // A split in the middle needs this many levels more; below that no freedom is left.
    let levels = usize::BITS - (count - 1).leading_zeros();
    if depth + levels < plan.depth
        && let Some(grid) = Grid::new(&extent.middles, count, plan)
    {
        bins.fill(items, grid);
        if let Some(best) = bins.best(plan) {
            let before = |item: &Item| {
                let (low, high) = item.along(best.axis);
                grid.place_along(plan.scale.middle_along(low, high), best.axis) < best.at
            };
            return if count > 2 * PORTION {
                partition_parallel(items, spare, before)
            } else {
                partition(items, spare, before)
            };
        }
    }
    halve(items, spare, &extent.middles, plan)
}

/// Splits in the middle along the widest axis, whole blocks first; where middles coincide, in the order as it is.
fn halve(items: &mut [Item], spare: &mut [Item], middles: &Bounds, plan: Plan) -> usize {
    let at = (items.len() / 2).next_multiple_of(plan.leaf);
    let sizes = [0, 1, 2].map(|axis| middles.high[axis] - middles.low[axis]);
    let axis = (1..3).fold(0, |widest, axis| if sizes[axis] > sizes[widest] { axis } else { widest });
    if sizes[axis] > 0.0 {
        let middle = |item: &Item| {
            let (low, high) = item.along(axis);
            plan.scale.middle_along(low, high)
        };
        items.select_nth_unstable_by(at, |a, b| {
            middle(a).total_cmp(&middle(b)).then(a.primitive().cmp(&b.primitive()))
        });
    }
    spare.copy_from_slice(items);
    at
}
