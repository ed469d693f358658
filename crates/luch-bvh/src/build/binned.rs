//! Top-down: sort the middles into bins along each axis and split between two of them.
//!
//! Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies" (2007). A leaf costs what its blocks of four cost, not
//! its primitives, and four or fewer are never split. Each level of the tree reads its items twice: once into the bins, which
//! also tell the boxes of the children, and once to part them, which tells the boxes of the children's middles. Counts,
//! minima and maxima are all that is gathered across threads, and those are exact in any grouping, so the tree is the same
//! for any number of threads.

use super::binary::{BinaryNode, Grown, Piece};
use super::bins::{Bins, Candidate, Cut, Grid};
use super::bounds::Bounds;
use super::few;
use super::item::Item;
use super::lanes::run;
use super::partition::{Middles, partition, partition_apart};
use super::plan::{Extent, Plan};
use crate::simd::Task;
use rayon::prelude::*;

/// No way through a binary tree is longer, unless there are more than 2²⁶ items; then it is by some levels.
pub(super) const MAX_DEPTH: u32 = 64;
/// Pieces of the tree with more items are shared out to threads.
const PIECE: usize = 4096;
/// The items of one node are shared out to threads in portions of so many.
const PORTION: usize = 8192;

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
pub(super) fn grow(buffers: Buffers, extent: Extent, depth: u32, plan: Plan) -> Piece {
    if buffers.items.len() <= PIECE {
        return Piece::Grown(run(Grow { buffers, extent, depth, plan }));
    }
    let Split { at, extents } = if buffers.items.len() <= 2 * PORTION {
        run(SplitOnce { items: buffers.items, spare: buffers.spare, extent, depth, plan })
    } else {
        split_parallel(buffers.items, buffers.spare, &extent, depth, plan)
    };
    let [left, right] = buffers.split(at);
    let (left, right) =
        rayon::join(|| grow(left, extents[0], depth + 1, plan), || grow(right, extents[1], depth + 1, plan));
    Piece::Pair(extent.bounds, Box::new([left, right]))
}

/// Grows several trees on one thread, one over each group of items; the groups are told by their ends. The roots come first.
pub(super) fn grow_side_by_side(
    buffers: Buffers,
    ends: impl ExactSizeIterator<Item = usize>,
    depth: u32,
    plan: Plan,
) -> Grown {
    run(GrowSeveral { buffers, ends, depth, plan })
}

struct Grow<'a> {
    buffers: Buffers<'a>,
    extent: Extent,
    depth: u32,
    plan: Plan,
}

impl Task for Grow<'_> {
    type Output = Grown;
    #[inline(always)]
    fn run(self) -> Grown {
        let mut grower = Grower::new(self.buffers.items.len(), self.plan);
        let end = self.buffers.items.len();
        let root = Job { start: 0, end, swapped: false, depth: self.depth, place: 0, extent: self.extent };
        grower.waiting.push(root);
        grower.grow(self.buffers);
        grower.grown
    }
}

struct GrowSeveral<'a, I> {
    buffers: Buffers<'a>,
    ends: I,
    depth: u32,
    plan: Plan,
}

impl<I: ExactSizeIterator<Item = usize>> Task for GrowSeveral<'_, I> {
    type Output = Grown;
    #[inline(always)]
    fn run(self) -> Grown {
        let Self { buffers, ends, depth, plan } = self;
        let mut grower = Grower::new(buffers.items.len(), plan);
        grower.grown.nodes.resize(ends.len(), BinaryNode::leaf(&Bounds::EMPTY, 0, 0));
        let mut start = 0;
        for (place, end) in ends.enumerate() {
            let extent = Extent::within(&buffers.items[start..end], plan.scale);
            grower.waiting.push(Job { start, end, swapped: false, depth, place, extent });
            start = end;
        }
        // The first is to be taken first.
        grower.waiting.reverse();
        grower.grow(buffers);
        grower.grown
    }
}

/// Items that are to become a tree.
struct Job {
    start: usize,
    end: usize,
    /// Whether they lie in the second buffer.
    swapped: bool,
    depth: u32,
    place: usize,
    extent: Extent,
}

/// Grows one piece on one thread.
struct Grower {
    grown: Grown,
    bins: Bins,
    waiting: Vec<Job>,
    plan: Plan,
}

impl Grower {
    #[inline(always)]
    fn new(count: usize, plan: Plan) -> Self {
        let mut nodes = Vec::with_capacity(2 * count / plan.leaf() + 1);
        nodes.push(BinaryNode::leaf(&Bounds::EMPTY, 0, 0));
        let grown = Grown { nodes, order: Vec::with_capacity(count) };
        Self { grown, bins: Bins::new(), waiting: Vec::new(), plan }
    }

    /// Grows all that waits, what lies in front first.
    #[inline(always)]
    fn grow(&mut self, buffers: Buffers) {
        let Buffers { items: first, spare: second } = buffers;
        while let Some(job) = self.waiting.pop() {
            let Job { start, end, swapped, depth, place, extent } = job;
            let (items, spare) =
                if swapped { (&mut *second, &mut *first) } else { (&mut *first, &mut *second) };
            let (items, spare) = (&mut items[start..end], &mut spare[start..end]);
            if items.len() <= self.plan.leaf() {
                let order = self.grown.order.len() as u32;
                self.grown.order.extend(items.iter().map(Item::primitive));
                self.grown.nodes[place] = BinaryNode::leaf(&extent.bounds, order, items.len() as u32);
                continue;
            }
            let Split { at, extents: [left, right] } =
                split(&mut self.bins, items, spare, &extent, depth, self.plan);
            let children = self.grown.nodes.len();
            self.grown.nodes[place] = BinaryNode::inner(&extent.bounds, children as u32);
            self.grown.nodes.extend([BinaryNode::leaf(&Bounds::EMPTY, 0, 0); 2]);
            let (depth, swapped, middle) = (depth + 1, !swapped, start + at);
            self.waiting.push(Job { start: middle, end, swapped, depth, place: children + 1, extent: right });
            self.waiting.push(Job { start, end: middle, swapped, depth, place: children, extent: left });
        }
    }
}

/// How many items the first child has, and what is known of both.
struct Split {
    at: usize,
    extents: [Extent; 2],
}

impl Split {
    #[inline(always)]
    fn new(at: usize, [left, right]: [Bounds; 2], middles: Middles) -> Self {
        let [left_middles, right_middles] = middles.0;
        let extents = [
            Extent { bounds: left, middles: left_middles },
            Extent { bounds: right, middles: right_middles },
        ];
        Self { at, extents }
    }
}

struct SplitOnce<'a> {
    items: &'a mut [Item],
    spare: &'a mut [Item],
    extent: Extent,
    depth: u32,
    plan: Plan,
}

impl Task for SplitOnce<'_> {
    type Output = Split;
    #[inline(always)]
    fn run(self) -> Split {
        split(&mut Bins::new(), self.items, self.spare, &self.extent, self.depth, self.plan)
    }
}

/// The grid of the bins; `None` if there is nothing to tell the items apart by, or no level to spare.
#[inline(always)]
fn grid(extent: &Extent, count: usize, depth: u32, plan: Plan) -> Option<Grid> {
    // A split in the middle needs this many levels more; below that no freedom is left.
    let levels = usize::BITS - (count - 1).leading_zeros();
    if depth + levels < plan.depth { Grid::new(&extent.middles, count, plan) } else { None }
}

/// Puts the items into `spare`, those of the first child before the others.
#[inline(always)]
fn split(
    bins: &mut Bins,
    items: &mut [Item],
    spare: &mut [Item],
    extent: &Extent,
    depth: u32,
    plan: Plan,
) -> Split {
    let count = items.len();
    if plan.leaf() < count && count <= 2 * plan.leaf() {
        let parted = few::split(items, spare, plan.scale);
        // No more is to be known of children that are leaves or again so few.
        return Split::new(parted.at, parted.sides, Middles::EMPTY);
    }
    if let Some(grid) = grid(extent, count, depth, plan) {
        bins.fill(items, &grid);
        if let Some(best) = bins.best(plan) {
            let middles = partition(items, spare, &Cut::new(grid, &best));
            return Split::new(bins.before(&best), bins.sides(&best), middles);
        }
    }
    halve(items, spare, &extent.middles, plan)
}

/// The same for many items on all threads.
fn split_parallel(items: &mut [Item], spare: &mut [Item], extent: &Extent, depth: u32, plan: Plan) -> Split {
    if let Some(grid) = grid(extent, items.len(), depth, plan) {
        let filled = fill_portions(items, &grid);
        if let Some(Found { best, sides }) = find(&merged(&filled), plan) {
            let at = filled.iter().map(|bins| bins.before(&best)).sum();
            let cut = Cut::new(grid, &best);
            let (mut front, mut back) = spare.split_at_mut(at);
            let mut jobs = Vec::with_capacity(filled.len());
            for (items, bins) in items.chunks(PORTION).zip(filled) {
                let before = bins.before(&best);
                let (first, rest) = front.split_at_mut(before);
                front = rest;
                let (second, rest) = back.split_at_mut(items.len() - before);
                back = rest;
                jobs.push(Part { items, targets: [first, second], cut: &cut });
            }
            let middles = jobs.into_par_iter().map(run).reduce(|| Middles::EMPTY, |a, b| a.union(&b));
            return Split::new(at, sides, middles);
        }
    }
    halve(items, spare, &extent.middles, plan)
}

/// The bins of each portion of the items.
fn fill_portions(items: &[Item], grid: &Grid) -> Vec<Bins> {
    items.par_chunks(PORTION).map(|items| run(Fill { items, grid })).collect()
}

fn merged(filled: &[Bins]) -> Bins {
    let mut bins = Bins::new();
    filled.iter().for_each(|filled| bins.merge(filled));
    bins
}

/// The best split of many items and the boxes of both sides.
pub(super) struct Found {
    pub(super) best: Candidate,
    pub(super) sides: [Bounds; 2],
}

/// The best split by bins, which are filled on all threads.
pub(super) fn best_split(items: &[Item], grid: &Grid, plan: Plan) -> Option<Found> {
    find(&merged(&fill_portions(items, grid)), plan)
}

fn find(bins: &Bins, plan: Plan) -> Option<Found> {
    run(Find { bins, plan })
}

struct Find<'a> {
    bins: &'a Bins,
    plan: Plan,
}

impl Task for Find<'_> {
    type Output = Option<Found>;
    #[inline(always)]
    fn run(self) -> Option<Found> {
        let best = self.bins.best(self.plan)?;
        Some(Found { sides: self.bins.sides(&best), best })
    }
}

struct Fill<'a> {
    items: &'a [Item],
    grid: &'a Grid,
}

impl Task for Fill<'_> {
    type Output = Bins;
    #[inline(always)]
    fn run(self) -> Bins {
        let mut bins = Bins::new();
        bins.fill(self.items, self.grid);
        bins
    }
}

struct Part<'a> {
    items: &'a [Item],
    targets: [&'a mut [Item]; 2],
    cut: &'a Cut,
}

impl Task for Part<'_> {
    type Output = Middles;
    #[inline(always)]
    fn run(self) -> Middles {
        partition_apart(self.items, self.targets, self.cut)
    }
}

/// Splits in the middle along the widest axis, whole blocks first; where middles coincide, in the order as it is.
fn halve(items: &mut [Item], spare: &mut [Item], middles: &Bounds, plan: Plan) -> Split {
    let at = (items.len() / 2).next_multiple_of(plan.leaf());
    let sizes = [0, 1, 2].map(|axis| middles.high(axis) - middles.low(axis));
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
    let (left, right) = items.split_at(at);
    Split { at, extents: [left, right].map(|items| Extent::of(items, plan.scale)) }
}
