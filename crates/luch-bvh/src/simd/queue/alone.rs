//! A mesh, and nothing else.

use super::{DONE, Slot, Space};
use crate::Hit;
use crate::simd::accept::Accept;
use crate::simd::block::Block;
use crate::simd::mesh::Mesh;
use crate::tree::Tree;

/// A mesh, which hits count, and where answers go.
pub(in crate::simd) struct Alone<'a, A, R> {
    pub(in crate::simd) mesh: &'a Mesh,
    pub(in crate::simd) cull_back: bool,
    pub(in crate::simd) accept: A,
    pub(in crate::simd) answer: R,
}

// SAFETY: a ray begins at the root, and nothing is ever put off here.
unsafe impl<'a, A: Accept, R: FnMut(usize, Option<Hit>)> Space<'a> for Alone<'a, A, R> {
    type State = ();

    #[inline(always)]
    fn event_from(_: &Slot<()>) -> u32 {
        DONE
    }

    #[inline(always)]
    fn begin(&mut self, slot: &mut Slot<()>) -> bool {
        slot.current = self.mesh.tree().root();
        false
    }

    #[inline(always)]
    fn tree(&self, _: &Slot<()>) -> &'a Tree {
        self.mesh.tree()
    }

    #[inline(always)]
    fn blocks(&self, _: &Slot<()>) -> &'a [Block] {
        self.mesh.blocks()
    }

    #[inline(always)]
    fn cull_back(&self, _: &Slot<()>) -> bool {
        self.cull_back
    }

    #[inline(always)]
    fn accept(&mut self, slot: &Slot<()>, hit: &Hit) -> bool {
        self.accept.accept(slot.index as usize, hit)
    }

    #[inline(always)]
    fn event(&mut self, _: &mut Slot<()>) -> bool {
        false
    }

    #[inline(always)]
    fn answer(&mut self, slot: &Slot<()>) {
        (self.answer)(slot.index as usize, slot.best());
    }

    #[inline(always)]
    fn miss(&mut self, index: usize) {
        (self.answer)(index, None);
    }
}
