//! Two levels: instances in the world, triangles in an instance.
//!
//! A leaf of the world, the entrance to an instance and the way back from one are events. What counts when is told in
//! [`scene_tree`](crate::SceneTree); here is how a slot remembers it.

use super::{DONE, NO_HIT, Slot, Space};
use crate::scene_tree::{Filter, Geometry, InstanceHit, Placed, SceneTree, bound_inside};
use crate::simd::block::Block;
use crate::simd::ray::Prepared;
use crate::tree::Tree;
use crate::wide::{EMPTY, LEAF};
use crate::{Hit, Interval, Ray};

/// The way back from an instance.
const RETURN: u32 = DONE - 1;
/// The entrance to an instance: its number follows in the lower bits.
const ENTRANCE: u32 = LEAF | 1 << 30;

/// A scene, the rays as they were given, which hits count, and where answers go.
pub(crate) struct World<'a, 'f, R> {
    scene: &'a SceneTree,
    rays: &'a [Ray],
    accept: &'a mut Filter<'f>,
    answer: R,
    any: bool,
}

/// Where a ray is, and what it has found in the world.
#[derive(Clone, Copy)]
pub(crate) struct State<'a> {
    /// The tree the slot is in.
    tree: &'a Tree,
    /// Its triangles; none in the world.
    blocks: &'a [Block],
    /// The instance the slot is in.
    placed: Option<&'a Placed>,
    instance: u32,
    event_from: u32,
    /// The piece of the ray inside that instance's box.
    interval: Interval,
    /// The ray in the world, and the bound there.
    outside: Prepared,
    bound: f32,
    best: Option<InstanceHit>,
}

impl<'a, 'f, R> World<'a, 'f, R> {
    /// `None` for a scene with more instances than an entrance can number. With `any` the first hit ends a ray.
    pub(crate) fn new(
        scene: &'a SceneTree,
        rays: &'a [Ray],
        accept: &'a mut Filter<'f>,
        answer: R,
        any: bool,
    ) -> Option<Self> {
        let most = (RETURN - ENTRANCE) as usize;
        let fits = scene.placed().len() < most && scene.tree().leaves() < most;
        fits.then_some(Self { scene, rays, accept, answer, any })
    }
}

impl<'a, R: FnMut(usize, Option<InstanceHit>)> World<'a, '_, R> {
    /// Looks for a hit of a shape; true if that answers the query.
    fn meet_shape(
        &mut self,
        slot: &mut Slot<State<'a>>,
        geometry: &Geometry,
        placed: &Placed,
        instance: u32,
        interval: Interval,
    ) -> bool {
        let index = slot.index as usize;
        let ray = placed.toward_object(&self.rays[index]);
        let of_world = |hit: &Hit| InstanceHit { instance, hit: Hit { t: interval.clamp(hit.t), ..*hit } };
        let mut hits = geometry.hits(&ray, placed.cull_back);
        let found = hits.find(|hit| !placed.filtered || (self.accept)(index, &of_world(hit)));
        let Some(hit) = found.map(|hit| of_world(&hit)) else { return false };
        if !self.any && hit.precedes(slot.state.best.as_ref(), slot.bound) {
            slot.bound = hit.hit.t;
            slot.state.best = Some(hit);
        }
        self.any
    }

    /// Goes into an instance; true if that answers the query.
    fn enter(&mut self, slot: &mut Slot<State<'a>>, instance: u32, interval: Interval) -> bool {
        let scene = self.scene;
        let Some(placed) = scene.placed()[instance as usize].as_ref() else { return false };
        let geometry = &scene.geometries()[placed.geometry as usize];
        let Geometry::Triangles(triangles) = geometry else {
            return self.meet_shape(slot, geometry, placed, instance, interval);
        };
        let mesh = triangles.mesh();
        if mesh.tree().root() == EMPTY {
            return false;
        }
        let inside = match placed.is_identity() {
            true => Some(slot.ray),
            false => Prepared::new(&placed.toward_object(&self.rays[slot.index as usize])),
        };
        let Some(inside) = inside else { return false };
        let bound = bound_inside(&interval, slot.bound);
        slot.state = State {
            tree: mesh.tree(),
            blocks: mesh.blocks(),
            placed: Some(placed),
            instance,
            event_from: RETURN,
            interval,
            outside: slot.ray,
            bound: slot.bound,
            best: slot.state.best,
        };
        slot.bound = if bound < inside.t_max { bound } else { inside.t_max };
        slot.ray = inside;
        slot.put_off(RETURN, f32::NEG_INFINITY);
        slot.put_off(mesh.tree().root(), f32::NEG_INFINITY);
        false
    }

    /// Comes back from an instance.
    fn leave(&mut self, slot: &mut Slot<State<'a>>) {
        let state = &mut slot.state;
        slot.ray = state.outside;
        slot.bound = state.bound;
        if slot.best.primitive != NO_HIT {
            let hit = Hit { t: state.interval.clamp(slot.best.t), ..slot.best };
            let hit = InstanceHit { instance: state.instance, hit };
            if hit.precedes(state.best.as_ref(), slot.bound) {
                slot.bound = hit.hit.t;
                state.best = Some(hit);
            }
            slot.best.primitive = NO_HIT;
        }
        state.tree = self.scene.tree();
        state.blocks = &[];
        state.placed = None;
        state.event_from = LEAF;
    }
}

// SAFETY: a ray begins at the root of the world. `enter` puts off the root of a mesh after the state says that the slot is in
// its tree; the way back is met when nothing of that tree waits any more. A leaf has at most four entrances.
unsafe impl<'a, R: FnMut(usize, Option<InstanceHit>)> Space<'a> for World<'a, '_, R> {
    type State = State<'a>;

    #[inline(always)]
    fn event_from(slot: &Slot<State<'a>>) -> u32 {
        slot.state.event_from
    }

    fn begin(&mut self, slot: &mut Slot<State<'a>>) -> bool {
        let scene = self.scene;
        let tree = scene.tree();
        slot.state = State {
            tree,
            blocks: &[],
            placed: None,
            instance: 0,
            event_from: LEAF,
            interval: slot.ray.whole(),
            outside: slot.ray,
            bound: slot.bound,
            best: None,
        };
        slot.current = if tree.root() == EMPTY { DONE } else { tree.root() };
        let whole = slot.ray.whole();
        scene.unbounded().iter().any(|&instance| {
            let placed = scene.placed()[instance as usize].as_ref();
            placed.is_some_and(|placed| {
                let geometry = &scene.geometries()[placed.geometry as usize];
                self.meet_shape(slot, geometry, placed, instance, whole)
            })
        })
    }

    #[inline(always)]
    fn tree(&self, slot: &Slot<State<'a>>) -> &'a Tree {
        slot.state.tree
    }

    #[inline(always)]
    fn blocks(&self, slot: &Slot<State<'a>>) -> &'a [Block] {
        slot.state.blocks
    }

    #[inline(always)]
    fn cull_back(&self, slot: &Slot<State<'a>>) -> bool {
        slot.state.placed.is_some_and(|placed| placed.cull_back)
    }

    #[inline(always)]
    fn accept(&mut self, slot: &Slot<State<'a>>, hit: &Hit) -> bool {
        let State { placed, instance, interval, .. } = &slot.state;
        if !placed.is_some_and(|placed| placed.filtered) {
            return true;
        }
        let hit = Hit { t: interval.clamp(hit.t), ..*hit };
        (self.accept)(slot.index as usize, &InstanceHit { instance: *instance, hit })
    }

    #[inline(never)]
    fn event(&mut self, slot: &mut Slot<State<'a>>) -> bool {
        if slot.current == RETURN {
            self.leave(slot);
            return false;
        }
        let scene = self.scene;
        if slot.current >= ENTRANCE {
            let instance = slot.current - ENTRANCE;
            let bounds = scene.placed()[instance as usize].as_ref().and_then(|placed| placed.bounds);
            return match bounds.and_then(|bounds| slot.ray.interval(&bounds)) {
                Some(interval) if interval.near <= slot.bound => self.enter(slot, instance, interval),
                _ => false,
            };
        }
        // The nearest entrance on top. There are four at most.
        let mut entrances = [(f32::NEG_INFINITY, 0); 4];
        let mut count = 0;
        for (instance, bounds) in scene.bvh().entries((slot.current & !LEAF) as usize) {
            if let Some(interval) = slot.ray.interval(bounds)
                && interval.near <= slot.bound
            {
                let mut place = count;
                while place > 0 && entrances[place - 1].0 < interval.near {
                    entrances[place] = entrances[place - 1];
                    place -= 1;
                }
                entrances[place] = (interval.near, ENTRANCE + instance);
                count += 1;
            }
        }
        for &(near, entrance) in &entrances[..count] {
            slot.put_off(entrance, near);
        }
        false
    }

    #[inline(always)]
    fn answer(&mut self, slot: &Slot<State<'a>>) {
        let met = slot.best().map(|hit| InstanceHit { instance: 0, hit });
        (self.answer)(slot.index as usize, if self.any { met } else { slot.state.best });
    }

    #[inline(always)]
    fn miss(&mut self, index: usize) {
        (self.answer)(index, None);
    }
}
