//! Many rays in flight, each a node or a leaf at a time.
//!
//! A single ray waits: for memory, and for the processor to notice that it guessed wrong which child comes next. Here a turn
//! takes every ray one step onward, and the steps of different rays overlap. A step has no branch that depends on
//! the data: children are sorted by a network, pushed whether there are any or not, and the next one is popped. Lists tell
//! whose turn is at a node, whose at a leaf, and whose journey has come to an event: its end, or another space.

mod alone;
mod world;

pub(super) use alone::Alone;
pub(crate) use world::World;

use super::block::{Block, Edges};
use super::lanes::{Isa, Mask};
use super::ray::Prepared;
use super::walk::SLACK;
use crate::tree::Tree;
use crate::wide::{LEAF, MAX_WAITING};
use crate::{Hit, Ray};
use std::mem::MaybeUninit;

/// Rays in flight.
const RAYS: usize = 32;
/// Below the first child that waits: so many entries that are never stale, the last of them [`DONE`].
const FLOOR: usize = 8;
/// Entries of a stack.
const ENTRIES: usize = FLOOR + 2 * MAX_WAITING + 2 * SLACK;
/// The reference under all others: the ray has been everywhere.
pub(super) const DONE: u32 = u32::MAX;

/// A ray in flight.
#[repr(C, align(64))]
pub(crate) struct Slot<S> {
    pub(super) ray: Prepared,
    /// What lies farther cannot count.
    pub(super) bound: f32,
    /// Entries on the stack.
    height: u32,
    /// Where it is.
    pub(super) current: u32,
    /// Which ray of the batch it is.
    pub(super) index: u32,
    /// The best hit so far; [`NO_HIT`] as primitive if there is none.
    best: Hit,
    pub(super) state: S,
    edges: Edges,
    candidates: u32,
    distances: [f32; ENTRIES],
    references: [u32; ENTRIES],
}

/// Stands for the lack of a hit.
const NO_HIT: u32 = u32::MAX;

/// What rays travel through.
///
/// # Safety
///
/// Below [`Space::event_from`], [`Space::begin`], [`Space::event`] and nobody else may make `current` or put off anything but
/// references of the tree the slot is in. That is at most two trees at a time, and no more than eight entries beside.
pub(crate) unsafe trait Space<'a> {
    /// What a slot has to remember beyond its ray.
    type State: Copy;

    /// References from here on are events.
    fn event_from(slot: &Slot<Self::State>) -> u32;
    /// Puts a ray that is known to be sound on its way: its place and its state, which nobody has written before. True if an
    /// any-hit query is answered at once.
    fn begin(&mut self, slot: &mut Slot<Self::State>) -> bool;
    fn tree(&self, slot: &Slot<Self::State>) -> &'a Tree;
    /// The triangles of the leaves of the tree, unless leaves are events.
    fn blocks(&self, slot: &Slot<Self::State>) -> &'a [Block];
    fn cull_back(&self, slot: &Slot<Self::State>) -> bool;
    fn accept(&mut self, slot: &Slot<Self::State>, hit: &Hit) -> bool;
    /// Deals with an event other than the end; true if an any-hit query is answered.
    fn event(&mut self, slot: &mut Slot<Self::State>) -> bool;
    /// The ray of the slot has been everywhere.
    fn answer(&mut self, slot: &Slot<Self::State>);
    /// The ray cannot meet anything.
    fn miss(&mut self, index: usize);
}

impl<S: Copy> Slot<S> {
    /// The best hit so far.
    #[inline(always)]
    pub(super) fn best(&self) -> Option<Hit> {
        (self.best.primitive != NO_HIT).then_some(self.best)
    }

    /// Puts off a reference.
    #[inline(always)]
    fn put_off(&mut self, reference: u32, distance: f32) {
        let height = self.height as usize;
        (self.distances[height], self.references[height]) = (distance, reference);
        self.height += 1;
    }

    /// Answers an any-hit query with yes: nothing waits any more.
    #[inline(always)]
    fn end(&mut self) {
        self.best.primitive = 0;
        self.height = FLOOR as u32;
    }

    /// The height of the stack without the entries on top that lie too far.
    ///
    /// Eight are looked at together. They were written in earlier turns, so no load waits for a store.
    #[inline(always)]
    fn fresh<I: Isa, const ANY: bool>(&self) -> u32 {
        if ANY {
            return self.height;
        }
        let mut top = self.height;
        loop {
            // SAFETY: the stack is never lower than its floor.
            let window = unsafe { &*self.distances.as_ptr().add(top as usize - FLOOR).cast() };
            let stale = I::stale(window, self.bound);
            top -= stale;
            if stale < FLOOR as u32 {
                return top;
            }
        }
    }

    /// Goes on to the entry below `top`.
    #[inline(always)]
    fn pop<'a, I: Isa, P: Space<'a, State = S>>(&mut self, top: u32, space: &P) {
        self.height = top - 1;
        // SAFETY: below the top is at least the floor.
        self.current = unsafe { *self.references.get_unchecked(top as usize - 1) };
        // Which address it is must not become a branch.
        let reference = self.current as usize;
        let number = reference & !(LEAF as usize);
        let node = space.tree(self).nodes().as_ptr().wrapping_add(number).addr();
        let block = space.blocks(self).as_ptr().wrapping_add(number).addr();
        let leaf = 0_usize.wrapping_sub(reference >> 31);
        let start: *const u8 = std::ptr::without_provenance(node ^ (node ^ block) & leaf);
        I::prefetch(start);
        I::prefetch(start.wrapping_add(64));
        I::prefetch(start.wrapping_add(128));
        I::prefetch(start.wrapping_add(192 - (leaf & 64)));
    }
}

/// Takes the rays of `order` through `space`.
#[inline(always)]
pub(crate) fn trace<'a, I: Isa, S: Space<'a>, const ANY: bool>(
    space: &mut S,
    rays: &[Ray],
    mut order: impl Iterator<Item = usize>,
) {
    let mut slots: [MaybeUninit<Slot<S::State>>; RAYS] = [const { MaybeUninit::uninit() }; RAYS];
    let slots: *mut Slot<S::State> = slots.as_mut_ptr().cast();
    let mut lists = Lists { nodes: [0; RAYS], leaves: [0; RAYS], events: [0; RAYS], candidates: [0; RAYS] };
    let (mut nodes, mut leaves, mut events) = (0, 0, 0);
    macro_rules! append {
        ($slot:expr, $place:expr) => {{
            let leaf = ($slot.current >> 31) as usize;
            let event = usize::from($slot.current >= S::event_from($slot));
            // SAFETY: no slot is in two lists, so none has more than `RAYS - 1` entries while this one is in none.
            unsafe {
                *lists.nodes.get_unchecked_mut(nodes) = $place;
                *lists.leaves.get_unchecked_mut(leaves) = $place;
                *lists.events.get_unchecked_mut(events) = $place;
            }
            nodes += 1 - leaf;
            leaves += leaf - event;
            events += event;
        }};
    }
    for place in 0..RAYS {
        // SAFETY: the place is in the array; `begin` writes before anything reads.
        if unsafe { begin(slots.add(place), space, rays, &mut order) } {
            let slot = unsafe { &*slots.add(place) };
            append!(slot, place as u32);
        }
    }
    while nodes + leaves + events > 0 {
        let turn = nodes;
        nodes = 0;
        for at in 0..turn {
            let place = unsafe { *lists.nodes.get_unchecked(at) };
            let slot = unsafe { &mut *slots.add(place as usize) };
            let node = unsafe { space.tree(slot).nodes().get_unchecked(slot.current as usize) };
            let entered = slot.ray.spread::<I>().enter(node, slot.bound);
            let top = slot.fresh::<I, ANY>();
            let height = slot.height as usize;
            unsafe {
                let references = slot.references.as_mut_ptr().add(height);
                if ANY {
                    I::push(entered.met, &node.children, references);
                } else {
                    let distances = slot.distances.as_mut_ptr().add(height);
                    I::push_sorted(entered.near, entered.met, &node.children, distances, references);
                }
            }
            let met = entered.met.bits();
            let top = if met == 0 { top } else { slot.height + met.count_ones() };
            slot.pop::<I, S>(top, space);
            append!(slot, place);
        }
        let turn = leaves;
        leaves = 0;
        let mut candidates = 0;
        for at in 0..turn {
            let place = unsafe { *lists.leaves.get_unchecked(at) };
            let slot = unsafe { &mut *slots.add(place as usize) };
            let block = unsafe { space.blocks(slot).get_unchecked((slot.current & !LEAF) as usize) };
            (slot.edges, slot.candidates) = block.edges::<I>(&slot.ray);
            unsafe { *lists.candidates.get_unchecked_mut(candidates) = place };
            candidates += usize::from(slot.candidates != 0);
        }
        for at in 0..candidates {
            let place = unsafe { *lists.candidates.get_unchecked(at) };
            let slot = unsafe { &mut *slots.add(place as usize) };
            let block = unsafe { space.blocks(slot).get_unchecked((slot.current & !LEAF) as usize) };
            let hits = block.decide::<I>(&slot.ray, &slot.edges, slot.candidates, space.cull_back(slot));
            let mut lanes = hits.lanes;
            while lanes != 0 {
                let hit = hits.hit(lanes.trailing_zeros() as usize, block);
                lanes &= lanes - 1;
                if ANY {
                    if space.accept(slot, &hit) {
                        slot.end();
                        break;
                    }
                } else if hit.precedes(slot.best().as_ref(), slot.bound) && space.accept(slot, &hit) {
                    slot.bound = hit.t;
                    slot.best = hit;
                }
            }
        }
        for at in 0..turn {
            let place = unsafe { *lists.leaves.get_unchecked(at) };
            let slot = unsafe { &mut *slots.add(place as usize) };
            slot.pop::<I, S>(slot.fresh::<I, ANY>(), space);
            append!(slot, place);
        }
        let turn = events;
        events = 0;
        for at in 0..turn {
            let place = unsafe { *lists.events.get_unchecked(at) };
            let slot = unsafe { &mut *slots.add(place as usize) };
            if slot.current == DONE {
                space.answer(slot);
                if !unsafe { begin(slot, space, rays, &mut order) } {
                    continue;
                }
            } else {
                if space.event(slot) {
                    slot.end();
                }
                slot.pop::<I, S>(slot.fresh::<I, ANY>(), space);
            }
            append!(slot, place);
        }
    }
}

/// Who is where.
struct Lists {
    nodes: [u32; RAYS],
    leaves: [u32; RAYS],
    events: [u32; RAYS],
    /// Those at a leaf that may have met one of its triangles.
    candidates: [u32; RAYS],
}

/// Puts the next sound ray into a slot; false if there is none.
///
/// # Safety
///
/// The slot must be writable.
#[inline(always)]
unsafe fn begin<'a, S: Space<'a>>(
    slot: *mut Slot<S::State>,
    space: &mut S,
    rays: &[Ray],
    order: &mut impl Iterator<Item = usize>,
) -> bool {
    for index in order {
        match Prepared::new(&rays[index]) {
            None => space.miss(index),
            Some(ray) => {
                // SAFETY: the caller vouches for the place; only fields that were written are read later.
                unsafe {
                    (&raw mut (*slot).bound).write(ray.t_max);
                    (&raw mut (*slot).ray).write(ray);
                    (&raw mut (*slot).height).write(FLOOR as u32);
                    (&raw mut (*slot).index).write(index as u32);
                    (&raw mut (*slot).best).write(Hit { t: 0.0, u: 0.0, v: 0.0, primitive: NO_HIT });
                    (&raw mut (*slot).distances).cast::<[f32; FLOOR]>().write([f32::NEG_INFINITY; FLOOR]);
                    (&raw mut (*slot).references).cast::<[u32; FLOOR]>().write([DONE; FLOOR]);
                    if space.begin(&mut *slot) {
                        (*slot).end();
                        (*slot).current = DONE;
                    }
                }
                return true;
            }
        }
    }
    false
}
