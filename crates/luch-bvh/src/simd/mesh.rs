//! Triangles in blocks under a tree, and one ray through them.

use super::block::Block;
use super::lanes::Isa;
use super::ray::Prepared;
use super::walk::{Stack, walk_from};
use crate::tree::Tree;
use crate::{Hit, Ray};

/// A tree and the triangles of its leaves.
#[derive(Clone, Debug)]
pub(crate) struct Mesh {
    tree: Tree,
    blocks: Vec<Block>,
}

impl Mesh {
    /// # Panics
    ///
    /// Unless there is one block for each leaf.
    pub(crate) fn new(tree: Tree, blocks: Vec<Block>) -> Self {
        assert_eq!(tree.leaves(), blocks.len());
        Self { tree, blocks }
    }

    #[inline(always)]
    pub(crate) fn tree(&self) -> &Tree {
        &self.tree
    }

    #[inline(always)]
    pub(crate) fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// The block of a leaf the tree has handed out.
    #[inline(always)]
    pub(super) fn block(&self, leaf: usize) -> &Block {
        debug_assert!(leaf < self.blocks.len());
        // SAFETY: leaves of the tree are numbered below the number of blocks.
        unsafe { self.blocks.get_unchecked(leaf) }
    }

    /// The nearest hit below `from` at or before `bound`, better than `best`. The bound only prunes: it changes no hit, as
    /// the ray's own end might.
    #[expect(clippy::too_many_arguments, reason = "the state of a walk that another began")]
    #[inline(always)]
    pub(super) fn nearest_from<I: Isa>(
        &self,
        from: u32,
        ray: &Prepared,
        bound: f32,
        best: Option<Hit>,
        stack: &mut Stack,
        cull_back: bool,
        mut accept: impl FnMut(&Hit) -> bool,
    ) -> Option<Hit> {
        let mut best = best;
        walk_from::<I>(&self.tree, from, ray, bound, stack, |leaf, mut bound| {
            let block = self.block(leaf);
            let hits = block.hits::<I>(ray, cull_back);
            let mut lanes = hits.lanes;
            while lanes != 0 {
                let hit = hits.hit(lanes.trailing_zeros() as usize, block);
                lanes &= lanes - 1;
                if hit.precedes(best.as_ref(), bound) && accept(&hit) {
                    bound = hit.t;
                    best = Some(hit);
                }
            }
            bound
        });
        best
    }

    /// Whether there is any hit below `from`.
    #[inline(always)]
    pub(super) fn any_from<I: Isa>(
        &self,
        from: u32,
        ray: &Prepared,
        stack: &mut Stack,
        cull_back: bool,
        mut accept: impl FnMut(&Hit) -> bool,
    ) -> bool {
        let mut found = false;
        walk_from::<I>(&self.tree, from, ray, ray.t_max, stack, |leaf, bound| {
            let block = self.block(leaf);
            let hits = block.hits::<I>(ray, cull_back);
            let mut lanes = hits.lanes;
            while lanes != 0 && !found {
                found = accept(&hits.hit(lanes.trailing_zeros() as usize, block));
                lanes &= lanes - 1;
            }
            if found { f32::NEG_INFINITY } else { bound }
        });
        found
    }

    /// The nearest hit at or before `bound`.
    #[inline(always)]
    pub(crate) fn nearest<I: Isa>(
        &self,
        ray: &Ray,
        bound: f32,
        stack: &mut Stack,
        cull_back: bool,
        accept: impl FnMut(&Hit) -> bool,
    ) -> Option<Hit> {
        let ray = Prepared::new(ray)?;
        let bound = if bound < ray.t_max { bound } else { ray.t_max };
        self.nearest_from::<I>(self.tree.root(), &ray, bound, None, stack, cull_back, accept)
    }

    /// Whether there is any accepted hit.
    #[inline(always)]
    pub(crate) fn any<I: Isa>(
        &self,
        ray: &Ray,
        stack: &mut Stack,
        cull_back: bool,
        accept: impl FnMut(&Hit) -> bool,
    ) -> bool {
        let Some(ray) = Prepared::new(ray) else { return false };
        self.any_from::<I>(self.tree.root(), &ray, stack, cull_back, accept)
    }
}
