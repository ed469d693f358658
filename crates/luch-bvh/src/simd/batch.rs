//! Which kernel takes a batch of rays through a mesh.

use super::coherent;
use super::lanes::Isa;
use super::level::{Kernel, launch};
use super::mesh::Mesh;
use super::queue::{Alone, trace};
use super::walk::Stack;
use crate::wide::EMPTY;
use crate::{Coherence, Hit, Ray};

/// Fewer rays are not worth a queue or a packet.
pub(crate) const FEW: usize = 8;

/// Told the index of a ray and the end of its journey.
pub(crate) type Answer<'f> = dyn FnMut(usize, Option<Hit>) + 'f;

/// The nearest hit of every ray, from either side.
#[inline(never)]
pub(crate) fn nearest_in_mesh(mesh: &Mesh, rays: &[Ray], coherence: Coherence, answer: &mut Answer) {
    launch(MeshBatch::<false> { mesh, rays, coherence, answer });
}

/// Any hit of every ray, of which nothing but that it is there is told.
#[inline(never)]
pub(crate) fn any_in_mesh(mesh: &Mesh, rays: &[Ray], coherence: Coherence, answer: &mut Answer) {
    launch(MeshBatch::<true> { mesh, rays, coherence, answer });
}

/// Every ray of a batch through a mesh; `ANY` ends each at the first hit.
struct MeshBatch<'a, 'f, const ANY: bool> {
    mesh: &'a Mesh,
    rays: &'a [Ray],
    coherence: Coherence,
    answer: &'a mut Answer<'f>,
}

impl<const ANY: bool> Kernel for MeshBatch<'_, '_, ANY> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa>(self) {
        let Self { mesh, rays, coherence, answer } = self;
        if mesh.tree().root() == EMPTY {
            (0..rays.len()).for_each(|index| answer(index, None));
            return;
        }
        if rays.len() < FEW {
            let mut stack = Stack::new();
            for (index, ray) in rays.iter().enumerate() {
                let hit = if ANY {
                    let met = mesh.any::<I>(ray, &mut stack, false, |_| true);
                    met.then_some(Hit { t: 0.0, u: 0.0, v: 0.0, primitive: 0 })
                } else {
                    mesh.nearest::<I>(ray, f32::INFINITY, &mut stack, false, |_| true)
                };
                answer(index, hit);
            }
            return;
        }
        let mut others = Vec::new();
        if coherence == Coherence::Incoherent {
            others.push(0..rays.len());
        } else {
            // Packets whose rays do not run the same way after all are left to the queue.
            let mut stacks = coherent::Stacks::new();
            for (packet, rays) in rays.chunks(coherent::PACKET).enumerate() {
                let first = packet * coherent::PACKET;
                if !coherent::trace::<I, ANY>(mesh, rays, first, &mut stacks, answer) {
                    others.push(first..first + rays.len());
                }
            }
        }
        if !others.is_empty() {
            let mut space = Alone { mesh, answer };
            trace::<I, _, ANY>(&mut space, rays, others.into_iter().flatten());
        }
    }
}
