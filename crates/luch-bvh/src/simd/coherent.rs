//! Sixteen rays through one tree together.
//!
//! A node is looked at once for all of them: boxes beside the [`Frustum`] are dropped eight at a time, the others are tested
//! against all rays when their turn comes. Where few rays are left these go on alone.

use super::batch::Answer;
use super::frustum::Frustum;
use super::lanes::Isa;
use super::level::Task;
use super::mesh::Mesh;
use super::packet::Packet;
use super::ray::Prepared;
use super::walk::{SLACK, Stack};
use crate::Ray;
use crate::wide::{LEAF, MAX_WAITING};
use std::marker::PhantomData;

/// As many rays go on alone, or fewer.
const FEW: u32 = 2;

/// What waits, and a stack for rays on their own.
pub(super) struct Stacks {
    distances: [f32; MAX_WAITING + SLACK],
    /// Nodes times eight plus the number of a child.
    children: [u32; MAX_WAITING + SLACK],
    alone: Stack,
}

impl Stacks {
    pub(super) fn new() -> Self {
        Self {
            distances: [0.0; MAX_WAITING + SLACK],
            children: [0; MAX_WAITING + SLACK],
            alone: Stack::new(),
        }
    }
}

/// Takes up to sixteen rays through a mesh of at least one node; false if they do not run the same way and nothing was done.
#[inline(always)]
pub(super) fn trace<I: Isa, const ANY: bool>(
    mesh: &Mesh,
    rays: &[Ray],
    first: usize,
    stacks: &mut Stacks,
    answer: &mut Answer,
) -> bool {
    let mut packet = Packet::new::<I>(rays);
    if packet.sound != 0 {
        let Some(frustum) = Frustum::new::<I>(&packet, &mesh.tree().bounds()) else { return false };
        let mut walk = Walk { mesh, rays, stacks, packet: &mut packet, frustum };
        if walk.packet.agrees() {
            walk.run::<I, ANY, true>();
        } else {
            walk.run::<I, ANY, false>();
        }
    }
    for lane in 0..rays.len() {
        answer(first + lane, packet.best(lane));
    }
    true
}

struct Walk<'a> {
    mesh: &'a Mesh,
    rays: &'a [Ray],
    stacks: &'a mut Stacks,
    packet: &'a mut Packet,
    frustum: Frustum,
}

impl Walk<'_> {
    #[inline(always)]
    fn run<I: Isa, const ANY: bool, const AGREE: bool>(&mut self) {
        let nodes = self.mesh.tree().nodes();
        let root = self.mesh.tree().root();
        if root & LEAF != 0 {
            self.leaf::<I, ANY>(root, self.packet.sound);
            return;
        }
        let mut height = 0;
        let mut reach = self.packet.reach::<I>();
        let mut current = root;
        loop {
            // SAFETY: `current` is a node; the depth of the tree bounds what waits.
            unsafe {
                let node = nodes.get_unchecked(current as usize);
                let beside = self.frustum.beside::<I>(node);
                let codes: [u32; 8] = std::array::from_fn(|child| current << 3 | child as u32);
                let children = self.stacks.children.as_mut_ptr().add(height);
                let distances = self.stacks.distances.as_mut_ptr().add(height);
                I::push_sorted(beside.near, beside.met, &codes, distances, children);
                height += super::lanes::Mask::bits(beside.met).count_ones() as usize;
            }
            loop {
                if height == 0 {
                    return;
                }
                height -= 1;
                // SAFETY: what is below the top was written, and leads to a child of a node.
                let (near, code) = unsafe {
                    (
                        *self.stacks.distances.get_unchecked(height),
                        *self.stacks.children.get_unchecked(height),
                    )
                };
                if near > reach {
                    continue;
                }
                let node = unsafe { nodes.get_unchecked((code >> 3) as usize) };
                let child = (code & 7) as usize;
                let rays = self.packet.enter::<I, AGREE>(node, child);
                if rays == 0 {
                    continue;
                }
                let reference = node.children[child];
                if rays.count_ones() <= FEW {
                    self.alone::<I, ANY>(reference, rays);
                    reach = self.packet.reach::<I>();
                } else if reference & LEAF == 0 {
                    current = reference;
                    break;
                } else if self.leaf::<I, ANY>(reference, rays) {
                    reach = self.packet.reach::<I>();
                }
            }
        }
    }

    /// Tests the triangles of a leaf; true if a bound has changed.
    #[inline(always)]
    fn leaf<I: Isa, const ANY: bool>(&mut self, reference: u32, rays: u32) -> bool {
        let block = self.mesh.block((reference & !LEAF) as usize);
        let mut changed = false;
        let mut rays = rays;
        for place in 0..block.count() {
            let Some(found) = self.packet.triangle::<I>(block, place, rays, false) else {
                continue;
            };
            let primitive = block.primitive(place);
            if ANY {
                self.packet.end::<I>(found.rays);
                rays &= !found.rays;
            } else {
                self.packet.take::<I>(&found, primitive);
            }
            changed = true;
        }
        changed
    }

    /// Lets rays go on alone from a node or leaf.
    #[inline(always)]
    fn alone<I: Isa, const ANY: bool>(&mut self, from: u32, rays: u32) {
        let Self { mesh, rays: all, stacks, packet, .. } = self;
        let stack = &mut stacks.alone;
        I::call(Single::<I, ANY> { mesh, all, packet, stack, from, rays, level: PhantomData });
    }
}

/// Some rays of a packet, one after the other.
struct Single<'a, I, const ANY: bool> {
    mesh: &'a Mesh,
    all: &'a [Ray],
    packet: &'a mut Packet,
    stack: &'a mut Stack,
    from: u32,
    /// A bit for each of them.
    rays: u32,
    level: PhantomData<I>,
}

impl<I: Isa, const ANY: bool> Task for Single<'_, I, ANY> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { mesh, packet, stack, from, .. } = self;
        for lane in (0..16).filter(|lane| self.rays >> lane & 1 == 1) {
            let Some(ray) = Prepared::new(&self.all[lane]) else { continue };
            if ANY {
                if mesh.any_from::<I>(from, &ray, stack, false, |_| true) {
                    packet.end::<I>(1 << lane);
                }
            } else {
                let (bound, best) = (packet.bound[lane], packet.best(lane));
                let hit = mesh.nearest_from::<I>(from, &ray, bound, best, stack, false, |_| true);
                if let Some(hit) = hit {
                    packet.set_best(lane, &hit);
                }
            }
        }
    }
}
