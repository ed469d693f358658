//! The binary tree all builders make.

use super::bounds::{Bounds, Scale};

/// A node of the binary tree. Two siblings stand side by side.
#[derive(Clone, Copy, Debug)]
pub(super) struct BinaryNode(Bounds);

/// A binary tree. The root is node 0, and no child stands before its parent.
#[derive(Clone, Debug)]
pub(super) struct Binary {
    pub(super) nodes: Vec<BinaryNode>,
    /// Primitives, leaf by leaf.
    pub(super) order: Vec<u32>,
    /// Measure of areas.
    pub(super) scale: Scale,
}

impl Binary {
    /// Of each node the length of the longest way down to a leaf.
    pub(super) fn heights(&self) -> Vec<u8> {
        let mut heights = vec![0; self.nodes.len()];
        for (place, node) in self.nodes.iter().enumerate().rev() {
            if !node.is_leaf() {
                let left = node.index() as usize;
                heights[place] = 1 + heights[left].max(heights[left + 1]);
            }
        }
        heights
    }
}

impl BinaryNode {
    /// A leaf of `count` primitives, at most 127, from place `first` of the order on.
    pub(super) fn leaf(bounds: &Bounds, first: u32, count: u32) -> Self {
        Self::pack(bounds, first, count)
    }

    /// A node whose children are `left` and the one after.
    pub(super) fn inner(bounds: &Bounds, left: u32) -> Self {
        Self::pack(bounds, left, 0)
    }

    fn pack(bounds: &Bounds, index: u32, count: u32) -> Self {
        Self(bounds.with_note(index & 0xffff, index >> 16 | count << 16))
    }

    /// The box.
    #[inline(always)]
    pub(super) fn bounds(&self) -> Bounds {
        self.0
    }

    /// The first child, or the first place of a leaf.
    #[inline(always)]
    pub(super) fn index(&self) -> u32 {
        let [low, high] = self.0.note();
        low | high << 16
    }

    /// How many primitives a leaf has; 0 for an inner node.
    #[inline(always)]
    pub(super) fn count(&self) -> u32 {
        self.0.note()[1] >> 16
    }

    /// The same node in another list: its children `offset` further on, or its primitives `first`.
    pub(super) fn moved(&self, offset: u32, first: u32) -> Self {
        if self.is_leaf() {
            Self::leaf(&self.bounds(), self.index() + first, self.count())
        } else {
            Self::inner(&self.bounds(), self.index().wrapping_add(offset))
        }
    }

    #[inline(always)]
    pub(super) fn is_leaf(&self) -> bool {
        self.count() > 0
    }
}

/// A tree in pieces, as several threads grow them.
pub(super) enum Piece {
    /// One piece.
    Grown(Grown),
    /// Two pieces side by side.
    Pair(Bounds, Box<[Piece; 2]>),
}

/// Nodes numbered from zero, the root first, and the primitives of their leaves.
#[derive(Clone, Debug, Default)]
pub(super) struct Grown {
    pub(super) nodes: Vec<BinaryNode>,
    pub(super) order: Vec<u32>,
}

impl Piece {
    /// All nodes in one list.
    pub(super) fn joined(self) -> Grown {
        match self {
            Self::Grown(grown) => grown,
            pair => {
                let (nodes, order) = pair.size();
                let mut all = Grown { nodes: Vec::with_capacity(nodes), order: Vec::with_capacity(order) };
                all.nodes.push(BinaryNode::leaf(&Bounds::EMPTY, 0, 0));
                pair.append(&mut all, 0);
                all
            }
        }
    }

    fn size(&self) -> (usize, usize) {
        match self {
            Self::Grown(grown) => (grown.nodes.len(), grown.order.len()),
            Self::Pair(_, pieces) => {
                let [(a, b), (c, d)] = [pieces[0].size(), pieces[1].size()];
                (1 + a + c, b + d)
            }
        }
    }

    /// Puts the root at `place` and the rest at the end.
    fn append(self, all: &mut Grown, place: usize) {
        match self {
            Self::Grown(mut grown) => {
                // The first of the rest has number 1.
                let offset = (all.nodes.len() as u32).wrapping_sub(1);
                let first = all.order.len() as u32;
                all.nodes[place] = grown.nodes[0].moved(offset, first);
                all.nodes.extend(grown.nodes[1..].iter().map(|node| node.moved(offset, first)));
                all.order.append(&mut grown.order);
            }
            Self::Pair(bounds, pieces) => {
                let left = all.nodes.len();
                all.nodes[place] = BinaryNode::inner(&bounds, left as u32);
                all.nodes.extend([BinaryNode::leaf(&Bounds::EMPTY, 0, 0); 2]);
                let [first, second] = *pieces;
                first.append(all, left);
                second.append(all, left + 1);
            }
        }
    }
}
