//! From the binary tree to nodes of eight children, laid out for the caches.
//!
//! The first nodes stand level by level: every ray needs them and together they fit the second cache. Below, each subtree
//! stands depth-first, so that what a ray visits next is near. Leaves stand in the order of their nodes.

use super::binary::Binary;
use super::costs::Costs;
use crate::Aabb;
use crate::wide::{EMPTY, LEAF, MAX_WIDE_DEPTH, NO_PRIMITIVE, Wide, WideNode};
use rayon::prelude::*;
use std::collections::VecDeque;

/// Nodes that stand level by level: half a mebibyte of them.
const LEVEL_BY_LEVEL: usize = 2048;

/// Up to eight binary nodes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Children {
    nodes: [u32; 8],
    count: usize,
}

impl Children {
    pub(super) fn of(node: u32) -> Self {
        Self { nodes: [node; 8], count: 1 }
    }

    pub(super) fn as_slice(&self) -> &[u32] {
        &self.nodes[..self.count]
    }

    /// Puts two siblings in the place of their parent.
    pub(super) fn replace(&mut self, place: usize, left: u32) {
        self.nodes[place] = left;
        self.nodes[self.count] = left + 1;
        self.count += 1;
    }
}

/// Makes the wide tree.
pub(super) fn collapse(tree: &Binary) -> Wide {
    let Some(root) = tree.nodes.first() else {
        return Wide { nodes: Vec::new(), leaves: Vec::new(), root: EMPTY, bounds: Aabb::empty() };
    };
    let collapse = Collapse { tree, costs: Costs::of(tree), heights: tree.heights() };
    let bounds = root.bounds().aabb();
    if root.is_leaf() {
        return Wide { nodes: Vec::new(), leaves: vec![collapse.leaf(0)], root: LEAF, bounds };
    }
    let mut part = Part::default();
    let mut waiting = VecDeque::from([Waiting { node: 0, level: 0, parent: 0, place: 0 }]);
    while part.nodes.len() < LEVEL_BY_LEVEL
        && let Some(next) = waiting.pop_front()
    {
        let index = part.nodes.len() as u32;
        if index > 0 {
            part.nodes[next.parent as usize].children[next.place] = index;
        }
        collapse.place(&mut part, next, |inner| waiting.push_back(inner));
    }
    let below: Vec<Part> = waiting
        .par_iter()
        .map(|root| {
            let mut part = Part::default();
            collapse.place_all(&mut part, *root);
            part
        })
        .collect();
    let (nodes, leaves) = below
        .iter()
        .fold((0, 0), |(nodes, leaves), part| (nodes + part.nodes.len(), leaves + part.leaves.len()));
    part.nodes.reserve_exact(nodes);
    part.leaves.reserve_exact(leaves);
    for (root, mut below) in waiting.into_iter().zip(below) {
        let (nodes, leaves) = (part.nodes.len() as u32, part.leaves.len() as u32);
        for child in below.nodes.iter_mut().flat_map(|node| &mut node.children) {
            if *child & LEAF != 0 {
                *child += leaves;
            } else if *child != EMPTY {
                *child += nodes;
            }
        }
        part.nodes[root.parent as usize].children[root.place] = nodes;
        part.nodes.append(&mut below.nodes);
        part.leaves.append(&mut below.leaves);
    }
    Wide { nodes: part.nodes, leaves: part.leaves, root: 0, bounds }
}

/// A binary node that is to become a wide one, and where to write that down.
#[derive(Clone, Copy)]
struct Waiting {
    node: u32,
    level: usize,
    parent: u32,
    place: usize,
}

/// A part of the tree, numbered from zero.
#[derive(Default)]
struct Part {
    nodes: Vec<WideNode>,
    leaves: Vec<[u32; 4]>,
}

struct Collapse<'a> {
    tree: &'a Binary,
    costs: Costs,
    heights: Vec<u8>,
}

impl Collapse<'_> {
    /// Appends one node and its leaves; its inner children go to `inner`.
    fn place(&self, part: &mut Part, waiting: Waiting, mut inner: impl FnMut(Waiting)) {
        let parent = part.nodes.len() as u32;
        let mut node = WideNode::empty();
        for (place, &child) in self.children(waiting).as_slice().iter().enumerate() {
            let binary = &self.tree.nodes[child as usize];
            let reference = if binary.is_leaf() {
                part.leaves.push(self.leaf(child));
                LEAF | (part.leaves.len() - 1) as u32
            } else {
                inner(Waiting { node: child, level: waiting.level + 1, parent, place });
                EMPTY
            };
            node.set(place, &binary.bounds().aabb(), reference);
        }
        part.nodes.push(node);
    }

    /// Appends a node and all below it, depth-first.
    fn place_all(&self, part: &mut Part, waiting: Waiting) {
        let index = part.nodes.len();
        let mut below = [None; 8];
        self.place(part, waiting, |inner| below[inner.place] = Some(inner));
        for inner in below.into_iter().flatten() {
            part.nodes[index].children[inner.place] = part.nodes.len() as u32;
            self.place_all(part, inner);
        }
    }

    /// The children of least cost, or where that would lead too deep, those three levels below: a binary tree of
    /// height h thus never needs more than h/3 levels.
    fn children(&self, waiting: Waiting) -> Children {
        let mut children = Children::of(waiting.node);
        self.costs.open(self.tree, &mut children);
        let left = MAX_WIDE_DEPTH - waiting.level - 1;
        let height = |node: &u32| usize::from(self.heights[*node as usize]);
        if children.as_slice().iter().any(|child| height(child) > 3 * left) {
            children = Children::of(waiting.node);
            for _ in 0..3 {
                for place in 0..children.as_slice().len() {
                    let node = &self.tree.nodes[children.as_slice()[place] as usize];
                    if !node.is_leaf() {
                        children.replace(place, node.index());
                    }
                }
            }
        }
        children
    }

    fn leaf(&self, node: u32) -> [u32; 4] {
        let node = &self.tree.nodes[node as usize];
        let first = node.index() as usize;
        let mut leaf = [NO_PRIMITIVE; 4];
        for (lane, primitive) in leaf.iter_mut().zip(&self.tree.order[first..first + node.count() as usize]) {
            *lane = *primitive;
        }
        leaf
    }
}
