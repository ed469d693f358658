//! A packet in a world of instances.
//!
//! What counts when is told in [`scene_tree`](crate::SceneTree).

use super::triangles::{Alone, Asked, Rules, Through};
use super::{InMesh, Leaves, PACKET, Stacks, Waiting, walk};
use crate::scene_tree::{Filter, Geometry, InstanceHit, Placed, SceneTree, bound_inside};
use crate::simd::frustum::Frustum;
use crate::simd::lanes::Isa;
use crate::simd::level::Task;
use crate::simd::mesh::Mesh;
use crate::simd::packet::{Packet, Pieces};
use crate::wide::{EMPTY, WideNode};
use crate::{Hit, Ray};
use std::array::from_fn;
use std::marker::PhantomData;

/// Takes up to sixteen rays, the first of which has the number `first` in its batch, through a scene. False if they do not run
/// the same way and nothing was done.
#[inline(always)]
pub(crate) fn trace<I: Isa, const ANY: bool>(
    scene: &SceneTree,
    rays: &[Ray],
    first: usize,
    filter: &mut Filter,
    stacks: &mut Stacks,
    answer: &mut impl FnMut(usize, Option<InstanceHit>),
) -> bool {
    let mut packet = Packet::new::<I>(rays);
    let mut instances = [0; PACKET];
    if packet.sound != 0 {
        let Some(frustum) = Frustum::new::<I>(&packet, &scene.bounds()) else { return false };
        let (instances, waiting, level) = (&mut instances, &mut stacks.world, PhantomData);
        let world = World::<ANY> { scene, rays, first, filter, stacks: &mut stacks.object, instances };
        I::call(Whole::<I, ANY> { world, packet: &mut packet, frustum: &frustum, waiting, level });
    }
    for lane in 0..rays.len() {
        let instance = instances[lane & 15];
        answer(first + lane, packet.best(lane).map(|hit| InstanceHit { instance, hit }));
    }
    true
}

/// A packet through everything.
struct Whole<'a, 'f, I, const ANY: bool> {
    world: World<'a, 'f, ANY>,
    packet: &'a mut Packet,
    frustum: &'a Frustum,
    waiting: &'a mut Waiting,
    level: PhantomData<I>,
}

impl<I: Isa, const ANY: bool> Task for Whole<'_, '_, I, ANY> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { mut world, packet, frustum, waiting, .. } = self;
        let scene = world.scene;
        for &instance in scene.unbounded() {
            let pieces = packet.whole();
            world.enter::<I>(packet, instance, &pieces, packet.sound);
        }
        if scene.tree().root() != EMPTY {
            walk::<I, _>(scene.tree(), packet, frustum, waiting, &mut world);
        }
    }
}

/// The leaves of the world.
struct World<'a, 'f, const ANY: bool> {
    scene: &'a SceneTree,
    /// As they were given.
    rays: &'a [Ray],
    /// Number of the first of them in the batch.
    first: usize,
    filter: &'a mut Filter<'f>,
    stacks: &'a mut InMesh,
    /// The instances of the best hits.
    instances: &'a mut [u32; PACKET],
}

impl<const ANY: bool> Leaves for World<'_, '_, ANY> {
    #[inline(always)]
    fn leaf<I: Isa>(&mut self, packet: &mut Packet, leaf: usize, rays: u32) -> bool {
        // Those nearer to the first of the rays come first. There are four at most.
        let lane = (rays.trailing_zeros() & 15) as usize;
        let mut order = [(0.0, 0, Pieces::NONE); 4];
        let mut count = 0;
        for (instance, bounds) in self.scene.bvh().entries(leaf) {
            let pieces = packet.pieces::<I>(bounds);
            if pieces.rays & rays != 0 {
                let mut place = count;
                while place > 0 && order[place - 1].0 > pieces.near[lane] {
                    order[place] = order[place - 1];
                    place -= 1;
                }
                order[place] = (pieces.near[lane], instance, pieces);
                count += 1;
            }
        }
        let mut changed = false;
        for (_, instance, pieces) in &order[..count] {
            let rays = rays & pieces.rays & packet.reached::<I>(&pieces.near);
            if rays != 0 {
                changed |= self.enter::<I>(packet, *instance, pieces, rays);
            }
        }
        changed
    }

    /// The tree of the world is small.
    #[inline(always)]
    fn prefetch<I: Isa>(&self, _: &[WideNode], _: u32) {}
}

impl<const ANY: bool> World<'_, '_, ANY> {
    /// Takes rays into an instance; `pieces` are inside its box. True if a bound has changed.
    #[inline(always)]
    fn enter<I: Isa>(&mut self, packet: &mut Packet, instance: u32, pieces: &Pieces, rays: u32) -> bool {
        let scene = self.scene;
        let Some(placed) = scene.placed()[instance as usize].as_ref() else { return false };
        match &scene.geometries()[placed.geometry as usize] {
            Geometry::Triangles(triangles) => {
                let mesh = triangles.mesh();
                mesh.tree().root() != EMPTY
                    && self.enter_mesh::<I>(packet, mesh, placed, instance, pieces, rays)
            }
            shape => self.meet_shape::<I>(packet, shape, placed, instance, pieces, rays),
        }
    }

    #[inline(never)]
    fn meet_shape<I: Isa>(
        &mut self,
        packet: &mut Packet,
        shape: &Geometry,
        placed: &Placed,
        instance: u32,
        pieces: &Pieces,
        rays: u32,
    ) -> bool {
        let mut changed = false;
        for lane in (0..16).filter(|lane| rays >> lane & 1 == 1) {
            let interval = pieces.interval(lane);
            let of_world =
                |hit: &Hit| InstanceHit { instance, hit: Hit { t: interval.clamp(hit.t), ..*hit } };
            let ray = placed.toward_object(&self.rays[lane]);
            let mut hits = shape.hits(&ray, placed.cull_back);
            let index = self.first + lane;
            let found = hits.find(|hit| !placed.filtered || (self.filter)(index, &of_world(hit)));
            if let Some(hit) = found {
                changed |= self.take(packet, lane, &of_world(&hit));
            }
        }
        changed
    }

    /// Takes over a hit if it is the best; true if it is.
    #[inline(always)]
    fn take(&mut self, packet: &mut Packet, lane: usize, hit: &InstanceHit) -> bool {
        let lane = lane & 15;
        if ANY {
            packet.set_best(lane, &Hit { t: f32::NEG_INFINITY, u: 0.0, v: 0.0, primitive: 0 });
            return true;
        }
        let instance = self.instances[lane];
        let best = packet.best(lane).map(|hit| InstanceHit { instance, hit });
        if !hit.precedes(best.as_ref(), packet.bound[lane]) {
            return false;
        }
        self.instances[lane] = hit.instance;
        packet.set_best(lane, &hit.hit);
        true
    }

    #[inline(always)]
    fn enter_mesh<I: Isa>(
        &mut self,
        packet: &mut Packet,
        mesh: &Mesh,
        placed: &Placed,
        instance: u32,
        pieces: &Pieces,
        rays: u32,
    ) -> bool {
        let mut inside = match placed.is_identity() {
            true => *packet,
            false => {
                let last = self.rays.len() - 1;
                let moved: [Ray; PACKET] =
                    from_fn(|lane| placed.toward_object(&self.rays[if lane > last { 0 } else { lane }]));
                Packet::new::<I>(&moved)
            }
        };
        // What a ray has found in the world only prunes in here.
        inside.restart(rays, |lane| bound_inside(&pieces.interval(lane), packet.bound[lane]));
        if inside.sound == 0 {
            return false;
        }
        let first = self.first;
        let filter = &mut *self.filter;
        let asked = placed.filtered.then_some(Asked { filter, first, instance, pieces });
        let mut rules = Rules { cull_back: placed.cull_back, asked };
        let frustum = match inside.sound.count_ones() {
            0..=2 => None,
            _ => Frustum::new::<I>(&inside, &mesh.tree().bounds()),
        };
        let (rules, level) = (&mut rules, PhantomData);
        let InMesh { together: waiting, alone: stack } = &mut *self.stacks;
        match &frustum {
            Some(frustum) => {
                let packet = &mut inside;
                I::call(Through::<I, ANY> { mesh, packet, frustum, rules, waiting, level });
            }
            // Few, or not the same way in there.
            None => {
                let rays = inside.sound;
                let packet = &mut inside;
                I::call(Alone::<I, ANY> { mesh, packet, rules, stack, rays, level });
            }
        }
        let mut changed = false;
        for lane in (0..16).filter(|lane| rays >> lane & 1 == 1) {
            if let Some(hit) = inside.best(lane) {
                let hit = Hit { t: pieces.interval(lane).clamp(hit.t), ..hit };
                changed |= self.take(packet, lane, &InstanceHit { instance, hit });
            }
        }
        changed
    }
}
