//! Which kernel takes a batch.

use super::accept::Accept;
use super::coherent;
use super::lanes::Isa;
use super::level::Kernel;
use super::mesh::Mesh;
use super::queue::{Alone, trace};
use super::walk::Stack;
use crate::wide::EMPTY;
use crate::{Coherence, Hit, Ray};

/// Fewer rays are not worth a queue or a packet.
const FEW: usize = 8;
/// Rays of a packet.
const PACKET: usize = 16;

/// Every ray of a batch through a mesh; `ANY` ends each at the first hit, of which nothing but that it is there is told.
pub(crate) struct MeshBatch<'a, A, R, const ANY: bool> {
    pub(crate) mesh: &'a Mesh,
    pub(crate) rays: &'a [Ray],
    pub(crate) cull_back: bool,
    pub(crate) coherence: Coherence,
    pub(crate) accept: A,
    pub(crate) answer: R,
}

impl<A: Accept, R: FnMut(usize, Option<Hit>), const ANY: bool> Kernel for MeshBatch<'_, A, R, ANY> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa>(mut self) {
        let Self { mesh, rays, cull_back, .. } = self;
        if mesh.tree().root() == EMPTY {
            (0..rays.len()).for_each(|index| (self.answer)(index, None));
        } else if rays.len() < FEW {
            let mut stack = Stack::new();
            for (index, ray) in rays.iter().enumerate() {
                let accept = |hit: &Hit| self.accept.accept(index, hit);
                let hit = if ANY {
                    let met = mesh.any::<I>(ray, &mut stack, cull_back, accept);
                    met.then_some(Hit { t: 0.0, u: 0.0, v: 0.0, primitive: 0 })
                } else {
                    mesh.nearest::<I>(ray, f32::INFINITY, &mut stack, cull_back, accept)
                };
                (self.answer)(index, hit);
            }
        } else if self.coherence == Coherence::Incoherent {
            let mut space = Alone { mesh, cull_back, accept: self.accept, answer: self.answer };
            trace::<I, _, ANY>(&mut space, rays, 0..rays.len());
        } else {
            // Packets whose rays do not run the same way after all are left to the queue.
            let mut others = Vec::new();
            let mut stacks = coherent::Stacks::new();
            for (packet, rays) in rays.chunks(PACKET).enumerate() {
                let first = packet * PACKET;
                let (accept, answer) = (&mut self.accept, &mut self.answer);
                if !coherent::trace::<I, A, ANY>(mesh, rays, first, cull_back, accept, &mut stacks, answer) {
                    others.push(first..first + rays.len());
                }
            }
            if !others.is_empty() {
                let mut space = Alone { mesh, cull_back, accept: self.accept, answer: self.answer };
                trace::<I, _, ANY>(&mut space, rays, others.into_iter().flatten());
            }
        }
    }
}
