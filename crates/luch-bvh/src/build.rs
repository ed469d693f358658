//! Building: split boxes in two by the surface area heuristic until few are left.
//!
//! Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies" (2007): centroids fall into bins along each axis,
//! and the plane between two bins with the least expected cost splits. Counts, minima and maxima are all that is gathered
//! across threads, and those are exact in any grouping, so the tree is the same for any number of threads.

mod bins;
mod sweep;

use crate::Aabb;
use crate::tree::{Child, MAX_DEPTH, Node, Tree};
use bins::Bins;
use glam::Vec3;
use rayon::prelude::*;

/// How much time a build takes for how good a tree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Quality {
    /// 16 bins along the widest axis only; up to four primitives always make a leaf.
    Fast,
    /// 16 bins along each axis, every split tried between 8 primitives and fewer; a leaf where that is cheapest.
    #[default]
    Balanced,
    /// 32 bins along each axis, every split tried between 256 primitives and fewer.
    Best,
}

/// What a quality means.
#[derive(Clone, Copy)]
struct Settings {
    bins: usize,
    all_axes: bool,
    /// Nodes of so few primitives try every split of the sorted centroids.
    sweep: usize,
}

/// A leaf holds no more.
const MAX_LEAF: usize = 4;
/// The most primitives between which every split is tried.
const MAX_SWEEP: usize = 256;
/// Nodes of more references are worked on by several threads.
const PARALLEL: usize = 8192;
/// What visiting an inner node costs, in primitive tests.
const NODE_COST: f64 = 2.0;

impl Quality {
    /// All of them, quickest build first.
    pub const ALL: [Self; 3] = [Self::Fast, Self::Balanced, Self::Best];

    fn settings(self) -> Settings {
        match self {
            Self::Fast => Settings { bins: 16, all_axes: false, sweep: 0 },
            Self::Balanced => Settings { bins: 16, all_axes: true, sweep: 8 },
            Self::Best => Settings { bins: 32, all_axes: true, sweep: MAX_SWEEP },
        }
    }
}

/// A primitive to be put into the tree.
#[derive(Clone, Copy)]
pub(crate) struct Reference {
    pub(crate) bounds: Aabb,
    pub(crate) primitive: u32,
}

impl Reference {
    /// `None` for an empty box or one that is not a number: such a primitive is never hit.
    pub(crate) fn new(bounds: Aabb, primitive: u32) -> Option<Self> {
        (!bounds.is_empty()).then_some(Self { bounds, primitive })
    }
}

/// Sorts the references into leaf order and returns the tree over their places.
pub(crate) fn build(references: &mut [Reference], quality: Quality) -> Tree {
    if references.is_empty() {
        return Tree { nodes: Vec::new(), root: Child::default(), bounds: Aabb::empty() };
    }
    let mut nodes = Vec::new();
    let branch = fill(&mut nodes, references, 0, 0, quality.settings());
    Tree { nodes, root: branch.child, bounds: branch.bounds }
}

/// The root of a finished part of the tree.
struct Branch {
    child: Child,
    bounds: Aabb,
}

/// Appends the nodes over `references`, which begin at place `first`, in depth-first order.
fn fill(
    nodes: &mut Vec<Node>,
    references: &mut [Reference],
    first: u32,
    depth: usize,
    settings: Settings,
) -> Branch {
    let extent = Extent::of(references);
    let Some(middle) = split(references, &extent, depth, settings) else {
        return Branch {
            child: Child { index: first, count: references.len() as u32 },
            bounds: extent.bounds,
        };
    };
    let index = nodes.len();
    nodes.push(Node::new([Child::default(); 2], [Aabb::empty(); 2]));
    let parallel = references.len() > PARALLEL;
    let (front, back) = references.split_at_mut(middle);
    let start = first + middle as u32;
    let (left, right) = if parallel {
        let mut other = Vec::new();
        let (left, mut right) = rayon::join(
            || fill(nodes, front, first, depth + 1, settings),
            || fill(&mut other, back, start, depth + 1, settings),
        );
        append(nodes, other, &mut right);
        (left, right)
    } else {
        let left = fill(nodes, front, first, depth + 1, settings);
        (left, fill(nodes, back, start, depth + 1, settings))
    };
    nodes[index] = Node::new([left.child, right.child], [left.bounds, right.bounds]);
    Branch { child: Child { index: index as u32, count: 0 }, bounds: extent.bounds }
}

/// Appends nodes that were numbered from zero.
fn append(nodes: &mut Vec<Node>, mut other: Vec<Node>, root: &mut Branch) {
    let offset = nodes.len() as u32;
    let shift = |child: &mut Child| {
        if !child.is_leaf() {
            child.index += offset;
        }
    };
    for node in &mut other {
        node.children.iter_mut().for_each(shift);
    }
    shift(&mut root.child);
    nodes.append(&mut other);
}

/// The box of some references and the box of their centroids.
#[derive(Clone, Copy)]
struct Extent {
    bounds: Aabb,
    centroids: Aabb,
}

impl Extent {
    fn of(references: &[Reference]) -> Self {
        if references.len() > PARALLEL {
            let chunks = references.par_chunks(PARALLEL).map(Self::of);
            return chunks.reduce(Self::empty, |a, b| Self {
                bounds: a.bounds.union(&b.bounds),
                centroids: a.centroids.union(&b.centroids),
            });
        }
        let mut extent = Self::empty();
        for reference in references {
            extent.bounds = extent.bounds.union(&reference.bounds);
            extent.centroids.grow(reference.bounds.centroid());
        }
        extent
    }

    fn empty() -> Self {
        Self { bounds: Aabb::empty(), centroids: Aabb::empty() }
    }
}

/// Where a node is best split, and what it is expected to cost.
#[derive(Clone, Copy)]
struct Candidate {
    cost: f64,
    axis: usize,
    /// The first bin, or the first place after sorting, of the second part.
    at: usize,
}

/// Puts the references of the first child before the others and returns how many they are; `None` to make a leaf.
fn split(references: &mut [Reference], extent: &Extent, depth: usize, settings: Settings) -> Option<usize> {
    let count = references.len();
    if count == 1 || (count <= MAX_LEAF && settings.sweep == 0) {
        return None;
    }
    if extent.centroids.min == extent.centroids.max {
        return (count > MAX_LEAF).then(|| halve(references, &extent.centroids));
    }
    // A split in the middle needs this many levels more; below that no freedom is left.
    let levels = usize::BITS as usize - (count - 1).leading_zeros() as usize;
    if depth + levels >= MAX_DEPTH {
        return (count > MAX_LEAF).then(|| halve(references, &extent.centroids));
    }
    let whole = extent.bounds.half_area();
    let leaf_cost = if count <= MAX_LEAF { (count as f64 - NODE_COST) * whole } else { f64::INFINITY };
    if count <= settings.sweep {
        return match sweep::best(references) {
            Some(best) if best.cost < leaf_cost => {
                sweep::sort(references, best.axis);
                Some(best.at)
            }
            _ => (count > MAX_LEAF).then(|| halve(references, &extent.centroids)),
        };
    }
    let bins = Bins::of(references, &extent.centroids, settings);
    match bins.best() {
        Some(best) if best.cost < leaf_cost => {
            Some(partition(references, |reference| bins.place(reference, best.axis) < best.at))
        }
        _ => (count > MAX_LEAF).then(|| halve(references, &extent.centroids)),
    }
}

/// Splits in the middle along the widest axis; where centroids coincide, in the middle of the order as it is.
fn halve(references: &mut [Reference], centroids: &Aabb) -> usize {
    let middle = references.len() / 2;
    let axis = widest(centroids.max - centroids.min);
    references.select_nth_unstable_by(middle, sweep::along(axis));
    middle
}

fn widest(size: Vec3) -> usize {
    size.max_position()
}

/// Moves what `belongs` to the front and returns how much that is. The order depends on nothing but the input.
fn partition(references: &mut [Reference], belongs: impl Fn(&Reference) -> bool) -> usize {
    let (mut low, mut high) = (0, references.len());
    loop {
        while low < high && belongs(&references[low]) {
            low += 1;
        }
        while low < high && !belongs(&references[high - 1]) {
            high -= 1;
        }
        if low >= high {
            return low;
        }
        references.swap(low, high - 1);
        low += 1;
        high -= 1;
    }
}
