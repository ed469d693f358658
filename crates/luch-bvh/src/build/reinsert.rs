//! Making a binary tree better: take a node out and put it back where it costs least.
//!
//! Meister & Bittner, "Parallel Reinsertion for Bounding Volume Hierarchy Optimization" (2018). The best places of many nodes
//! are searched for at once in the tree as it is; then they are taken one after the other, the greatest gain first, and those
//! that touch what was already changed are left for the next pass. The order is fixed, so the result is the same for any
//! number of threads.

use super::binary::{Binary, BinaryNode};
use super::binned::MAX_DEPTH;
use rayon::prelude::*;

/// Goes over the tree so many times, each time over one in `share` of all nodes, those of the largest areas; leaves alone what
/// that would make too deep.
pub(super) fn improve(tree: &mut Binary, passes: usize, share: usize) {
    let mut changed = Changing::new(tree);
    let rounds = (0..passes).take_while(|_| changed.pass(share) > 0).count();
    if rounds == 0 {
        return;
    }
    let better = Binary { nodes: changed.in_order(), order: Vec::new(), scale: tree.scale };
    if better.heights()[0] as u32 <= MAX_DEPTH {
        tree.nodes = better.nodes;
    }
}

/// Where a node would go, and how much area that saves.
#[derive(Clone, Copy)]
struct Move {
    node: u32,
    beside: u32,
    gain: f32,
}

/// A tree whose nodes know their parents.
struct Changing<'a> {
    tree: &'a Binary,
    nodes: Vec<BinaryNode>,
    parents: Vec<u32>,
    areas: Vec<f32>,
}

/// The node that shares a parent: pairs begin at odd places.
fn sibling(node: u32) -> u32 {
    ((node - 1) ^ 1) + 1
}

impl<'a> Changing<'a> {
    fn new(tree: &'a Binary) -> Self {
        let mut parents = vec![0; tree.nodes.len()];
        for (place, node) in tree.nodes.iter().enumerate() {
            if !node.is_leaf() {
                let left = node.index() as usize;
                parents[left] = place as u32;
                parents[left + 1] = place as u32;
            }
        }
        let areas = tree.nodes.par_iter().map(|node| tree.scale.half_area(&node.bounds())).collect();
        Self { tree, nodes: tree.nodes.clone(), parents, areas }
    }

    /// Moves what gains by it; returns how many nodes that were.
    fn pass(&mut self, share: usize) -> usize {
        // The root and its children stay where they are.
        let mut tried: Vec<u32> = (3..self.nodes.len() as u32).collect();
        let count = tried.len() / share;
        if count == 0 {
            return 0;
        }
        let larger_first = |a: &u32, b: &u32| {
            let [a_area, b_area] = [a, b].map(|node| self.areas[*node as usize]);
            b_area.total_cmp(&a_area).then(a.cmp(b))
        };
        tried.select_nth_unstable_by(count, larger_first);
        tried.truncate(count);
        tried.par_sort_unstable();
        let mut moves: Vec<Move> =
            tried.par_iter().map_init(Vec::new, |stack, node| self.best(*node, stack)).flatten().collect();
        moves.par_sort_unstable_by(|a, b| b.gain.total_cmp(&a.gain).then(a.node.cmp(&b.node)));
        let mut touched = vec![false; self.nodes.len()];
        let mut made = 0;
        for step in &moves {
            let places = [step.node, sibling(step.node), self.parents[step.node as usize], step.beside]
                .map(|node| node as usize);
            let above = self.parents[step.beside as usize] as usize;
            if places.iter().any(|place| touched[*place]) || touched[above] {
                continue;
            }
            for place in places {
                touched[place] = true;
            }
            touched[above] = true;
            self.make(step);
            made += 1;
        }
        made
    }

    /// The best place for a node: searched for from its own place upward and from there down, never further into a subtree
    /// than it could still gain.
    fn best(&self, node: u32, stack: &mut Vec<(f32, u32)>) -> Option<Move> {
        let scale = self.tree.scale;
        let bounds = self.nodes[node as usize].bounds();
        let area = self.areas[node as usize];
        let parent = self.parents[node as usize];
        let mut best: Option<Move> = None;
        let mut most = 0.0;
        // Taking the node out saves its parent; further up it makes boxes smaller.
        let mut saved = self.areas[parent as usize];
        let mut pivot = parent;
        let mut without = self.nodes[sibling(node) as usize].bounds();
        let mut beside = sibling(node);
        loop {
            stack.clear();
            stack.push((saved, beside));
            while let Some((saved, beside)) = stack.pop() {
                if saved - area <= most {
                    continue;
                }
                let there = &self.nodes[beside as usize];
                let rest = saved - scale.half_area(&there.bounds().union(&bounds));
                if rest > most && beside != sibling(node) {
                    most = rest;
                    best = Some(Move { node, beside, gain: rest });
                }
                if !there.is_leaf() {
                    let saved = rest + self.areas[beside as usize];
                    stack.push((saved, there.index()));
                    stack.push((saved, there.index() + 1));
                }
            }
            if pivot == 0 {
                return best;
            }
            if pivot != parent {
                without = without.union(&self.nodes[beside as usize].bounds());
                saved += self.areas[pivot as usize] - scale.half_area(&without);
            }
            beside = sibling(pivot);
            pivot = self.parents[pivot as usize];
        }
    }

    /// Takes the node out, its sibling into the place of both, and puts it beside another.
    fn make(&mut self, step: &Move) {
        let Move { node, beside, .. } = *step;
        let parent = self.parents[node as usize];
        let pair = node.min(sibling(node));
        self.put(parent, self.nodes[sibling(node) as usize]);
        self.put(sibling(node), self.nodes[beside as usize]);
        let bounds = self.nodes[node as usize].bounds().union(&self.nodes[beside as usize].bounds());
        self.put(beside, BinaryNode::inner(&bounds, pair));
        self.refit(parent);
        self.refit(beside);
    }

    /// Writes a node into a place, and the place into its children.
    fn put(&mut self, place: u32, node: BinaryNode) {
        self.nodes[place as usize] = node;
        if !node.is_leaf() {
            let left = node.index() as usize;
            self.parents[left] = place;
            self.parents[left + 1] = place;
        }
    }

    /// Makes all boxes on the way to the root fit again.
    fn refit(&mut self, from: u32) {
        let mut place = from;
        loop {
            let node = self.nodes[place as usize];
            let mut bounds = node.bounds();
            if !node.is_leaf() {
                let left = node.index() as usize;
                bounds = self.nodes[left].bounds().union(&self.nodes[left + 1].bounds());
                self.nodes[place as usize] = BinaryNode::inner(&bounds, node.index());
            }
            self.areas[place as usize] = self.tree.scale.half_area(&bounds);
            if place == 0 {
                return;
            }
            place = self.parents[place as usize];
        }
    }

    /// The nodes, parents before children again.
    fn in_order(&self) -> Vec<BinaryNode> {
        let mut nodes = Vec::with_capacity(self.nodes.len());
        nodes.push(self.nodes[0]);
        let mut waiting = vec![0_usize];
        while let Some(place) = waiting.pop() {
            let node = nodes[place];
            if node.is_leaf() {
                continue;
            }
            let (old, new) = (node.index() as usize, nodes.len());
            nodes[place] = BinaryNode::inner(&node.bounds(), new as u32);
            nodes.extend_from_slice(&self.nodes[old..old + 2]);
            waiting.extend([new + 1, new]);
        }
        nodes
    }
}
