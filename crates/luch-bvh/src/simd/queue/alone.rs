//! A mesh, and nothing else.

use super::{DONE, Slot, Space};
use crate::Hit;
use crate::simd::batch::Answer;
use crate::simd::block::Block;
use crate::simd::mesh::Mesh;
use crate::tree::Tree;

/// A mesh, and where answers go.
pub(in crate::simd) struct Alone<'a, 'f> {
    pub(in crate::simd) mesh: &'a Mesh,
    pub(in crate::simd) answer: &'a mut Answer<'f>,
}

// SAFETY: a ray begins at the root, and nothing is ever put off here.
unsafe impl<'a> Space<'a> for Alone<'a, '_> {
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
        false
    }

    #[inline(always)]
    fn accept(&mut self, _: &Slot<()>, _: &Hit) -> bool {
        true
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
