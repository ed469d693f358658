//! A packet in a mesh.

use super::{Leaves, Stacks, Waiting, walk};
use crate::scene_tree::{Filter, InstanceHit};
use crate::simd::batch::Answer;
use crate::simd::frustum::Frustum;
use crate::simd::lanes::Isa;
use crate::simd::level::Task;
use crate::simd::mesh::Mesh;
use crate::simd::packet::{Packet, Pieces};
use crate::simd::walk::Stack;
use crate::wide::{LEAF, WideNode};
use crate::{Hit, Ray};
use std::marker::PhantomData;

/// Which hits of a mesh count.
pub(super) struct Rules<'a, 'f> {
    pub(super) cull_back: bool,
    /// Who is asked; nobody if all count.
    pub(super) asked: Option<Asked<'a, 'f>>,
}

/// Who is asked about hits, and what he is told.
pub(super) struct Asked<'a, 'f> {
    pub(super) filter: &'a mut Filter<'f>,
    /// Number of the first ray in the batch.
    pub(super) first: usize,
    pub(super) instance: u32,
    /// The pieces of the rays inside the box of the instance.
    pub(super) pieces: &'a Pieces,
}

impl Rules<'_, '_> {
    #[inline(always)]
    fn accept(&mut self, lane: usize, hit: &Hit) -> bool {
        let Some(asked) = &mut self.asked else { return true };
        let hit = Hit { t: asked.pieces.interval(lane).clamp(hit.t), ..*hit };
        (asked.filter)(asked.first + lane, &InstanceHit { instance: asked.instance, hit })
    }
}

/// Takes up to sixteen rays through a mesh of at least one node; false if they do not run the same way and nothing was done.
#[inline(always)]
pub(in crate::simd) fn trace<I: Isa, const ANY: bool>(
    mesh: &Mesh,
    rays: &[Ray],
    first: usize,
    stacks: &mut Stacks,
    answer: &mut Answer,
) -> bool {
    let mut packet = Packet::new::<I>(rays);
    if packet.sound != 0 {
        let Some(frustum) = Frustum::new::<I>(&packet, &mesh.tree().bounds()) else { return false };
        let rules = &mut Rules { cull_back: false, asked: None };
        let (waiting, level) = (&mut stacks.object.together, PhantomData);
        I::call(Through::<I, ANY> { mesh, packet: &mut packet, frustum: &frustum, rules, waiting, level });
    }
    for lane in 0..rays.len() {
        answer(first + lane, packet.best(lane));
    }
    true
}

/// A packet through a mesh of at least one node.
pub(super) struct Through<'a, 'r, 'f, I, const ANY: bool> {
    pub(super) mesh: &'a Mesh,
    pub(super) packet: &'a mut Packet,
    pub(super) frustum: &'a Frustum,
    pub(super) rules: &'a mut Rules<'r, 'f>,
    pub(super) waiting: &'a mut Waiting,
    pub(super) level: PhantomData<I>,
}

impl<I: Isa, const ANY: bool> Task for Through<'_, '_, '_, I, ANY> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { mesh, packet, frustum, rules, waiting, .. } = self;
        let mut leaves = Triangles::<ANY> { mesh, rules };
        walk::<I, _>(mesh.tree(), packet, frustum, waiting, &mut leaves);
    }
}

struct Triangles<'a, 'r, 'f, const ANY: bool> {
    mesh: &'a Mesh,
    rules: &'a mut Rules<'r, 'f>,
}

impl<const ANY: bool> Leaves for Triangles<'_, '_, '_, ANY> {
    #[inline(always)]
    fn leaf<I: Isa>(&mut self, packet: &mut Packet, leaf: usize, rays: u32) -> bool {
        let Self { mesh, rules } = self;
        I::call(Leaf::<I, ANY> { mesh, packet, rules, leaf, rays, level: PhantomData })
    }

    #[inline(always)]
    fn prefetch<I: Isa>(&self, nodes: &[WideNode], child: u32) {
        let place = (child & !LEAF) as usize;
        let start: *const u8 = match child & LEAF == 0 {
            true => nodes.as_ptr().wrapping_add(place).cast(),
            false => self.mesh.blocks().as_ptr().wrapping_add(place).cast(),
        };
        for line in 0..3 {
            I::prefetch(start.wrapping_add(64 * line));
        }
    }
}

/// Tests the triangles of a leaf.
struct Leaf<'a, 'r, 'f, I, const ANY: bool> {
    mesh: &'a Mesh,
    packet: &'a mut Packet,
    rules: &'a mut Rules<'r, 'f>,
    leaf: usize,
    rays: u32,
    level: PhantomData<I>,
}

impl<I: Isa, const ANY: bool> Task for Leaf<'_, '_, '_, I, ANY> {
    type Output = bool;

    #[inline(always)]
    fn run(self) -> bool {
        let Self { packet, rules, mut rays, .. } = self;
        let block = self.mesh.block(self.leaf);
        let mut changed = false;
        for place in 0..block.count() {
            let Some(mut found) = packet.triangle::<I>(block, place, rays, rules.cull_back) else { continue };
            let primitive = block.primitive(place);
            if rules.asked.is_some() {
                let asked = found.rays;
                for lane in (0..16).filter(|lane| asked >> lane & 1 == 1) {
                    if !rules.accept(lane, &found.hit(lane, primitive)) {
                        found.rays &= !(1 << lane);
                    }
                }
            }
            if ANY {
                packet.end::<I>(found.rays);
                rays &= !found.rays;
            } else {
                packet.take::<I>(&found, primitive);
            }
            changed = true;
        }
        changed
    }
}

/// Some rays of a packet, one after the other, through the whole mesh.
pub(super) struct Alone<'a, 'r, 'f, I, const ANY: bool> {
    pub(super) mesh: &'a Mesh,
    pub(super) packet: &'a mut Packet,
    pub(super) rules: &'a mut Rules<'r, 'f>,
    pub(super) stack: &'a mut Stack,
    /// A bit for each of them.
    pub(super) rays: u32,
    pub(super) level: PhantomData<I>,
}

impl<I: Isa, const ANY: bool> Task for Alone<'_, '_, '_, I, ANY> {
    type Output = bool;

    #[inline(always)]
    fn run(self) -> bool {
        let Self { mesh, packet, rules, stack, .. } = self;
        let (from, cull_back) = (mesh.tree().root(), rules.cull_back);
        let mut changed = false;
        for lane in (0..16).filter(|lane| self.rays >> lane & 1 == 1) {
            let ray = packet.ray(lane);
            let accept = |hit: &Hit| rules.accept(lane, hit);
            if ANY {
                if mesh.any_from::<I>(from, &ray, stack, cull_back, accept) {
                    packet.end::<I>(1 << lane);
                    changed = true;
                }
            } else {
                let (bound, best) = (packet.bound[lane], packet.best(lane));
                let hit = mesh.nearest_from::<I>(from, &ray, bound, best, stack, cull_back, accept);
                if let Some(hit) = hit {
                    packet.set_best(lane, &hit);
                    changed = true;
                }
            }
        }
        changed
    }
}
