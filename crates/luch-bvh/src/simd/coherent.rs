//! Sixteen rays through one tree together.
//!
//! A node is looked at once for all of them: boxes beside the [`Frustum`] are dropped eight at a time, the others are tested
//! against all rays when their turn comes. Rays stay together to the leaves, however few enter.

mod triangles;
mod world;

pub(super) use triangles::trace;
pub(crate) use world::trace as trace_world;

use super::frustum::Frustum;
use super::lanes::{Isa, Mask};
use super::packet::Packet;
use super::walk::{SLACK, Stack};
use crate::tree::Tree;
use crate::wide::{LEAF, MAX_WAITING, WideNode};

/// Rays of a packet.
pub(crate) const PACKET: usize = 16;

/// What waits on the way through one tree.
struct Waiting {
    distances: [f32; MAX_WAITING + SLACK],
    /// Nodes times eight plus the number of a child.
    children: [u32; MAX_WAITING + SLACK],
}

impl Waiting {
    fn new() -> Self {
        Self { distances: [0.0; MAX_WAITING + SLACK], children: [0; MAX_WAITING + SLACK] }
    }
}

/// What waits in the world, in a mesh, and for rays on their own.
pub(crate) struct Stacks {
    world: Waiting,
    object: InMesh,
}

/// What waits in a mesh, and for rays on their own in there.
struct InMesh {
    together: Waiting,
    alone: Stack,
}

impl Stacks {
    pub(crate) fn new() -> Self {
        let object = InMesh { together: Waiting::new(), alone: Stack::new() };
        Self { world: Waiting::new(), object }
    }
}

/// What becomes of rays at a leaf.
trait Leaves {
    /// Returns true if the bound of a ray has changed.
    fn leaf<I: Isa>(&mut self, packet: &mut Packet, leaf: usize, rays: u32) -> bool;
    /// Asks for what a child of a node leads to.
    fn prefetch<I: Isa>(&self, nodes: &[WideNode], child: u32);
}

/// Takes the sound rays of a packet from the root of a tree, which is not empty, to its leaves.
#[inline(always)]
fn walk<I: Isa, L: Leaves>(
    tree: &Tree,
    packet: &mut Packet,
    frustum: &Frustum,
    waiting: &mut Waiting,
    leaves: &mut L,
) {
    if packet.agrees() {
        walk_some::<I, L, true>(tree, packet, frustum, waiting, leaves);
    } else {
        walk_some::<I, L, false>(tree, packet, frustum, waiting, leaves);
    }
}

/// [`walk`]; with `AGREE` all rays run to the same side on all axes.
#[inline(always)]
fn walk_some<I: Isa, L: Leaves, const AGREE: bool>(
    tree: &Tree,
    packet: &mut Packet,
    frustum: &Frustum,
    waiting: &mut Waiting,
    leaves: &mut L,
) {
    let nodes = tree.nodes();
    let root = tree.root();
    if root & LEAF != 0 {
        leaves.leaf::<I>(packet, (root & !LEAF) as usize, packet.sound);
        return;
    }
    let mut height = 0;
    let mut reach = packet.reach::<I>();
    let mut current = root;
    loop {
        // SAFETY: `current` is a node; the depth of the tree bounds what waits.
        unsafe {
            let node = nodes.get_unchecked(current as usize);
            let beside = frustum.beside::<I>(node);
            let codes: [u32; 8] = std::array::from_fn(|child| current << 3 | child as u32);
            let children = waiting.children.as_mut_ptr().add(height);
            let distances = waiting.distances.as_mut_ptr().add(height);
            I::push_sorted(beside.near, beside.met, &codes, distances, children);
            let met = beside.met.bits();
            for child in (0..8).filter(|child| met >> child & 1 == 1) {
                leaves.prefetch::<I>(nodes, node.children[child]);
            }
            height += met.count_ones() as usize;
        }
        loop {
            if height == 0 {
                return;
            }
            height -= 1;
            // SAFETY: what is below the top was written, and leads to a child of a node.
            let (near, code) = unsafe {
                (*waiting.distances.get_unchecked(height), *waiting.children.get_unchecked(height))
            };
            if near > reach {
                continue;
            }
            let node = unsafe { nodes.get_unchecked((code >> 3) as usize) };
            let child = (code & 7) as usize;
            let rays = packet.enter::<I, AGREE>(node, child);
            if rays == 0 {
                continue;
            }
            let reference = node.children[child];
            if reference & LEAF == 0 {
                current = reference;
                break;
            }
            if leaves.leaf::<I>(packet, (reference & !LEAF) as usize, rays) {
                reach = packet.reach::<I>();
            }
        }
    }
}
