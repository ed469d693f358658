//! One ray through both levels, and the queries of a scene.
//!
//! What a caller brings is asked through a `dyn`, and only about hits of instances that are filtered. So the kernels are
//! compiled once, in this crate, and not again for every caller.

use super::{InstanceHit, SceneTree};
use crate::simd::{
    FEW, Isa, Kernel, PACKET, PacketStacks, Prepared, Stack, World, any_in_mesh, launch, nearest_in_mesh,
    trace, trace_world, walk,
};
use crate::{Coherence, Hit, Interval, Ray};

/// Told the index of a ray and a hit of it: whether the hit counts.
pub(crate) type Filter<'f> = dyn FnMut(usize, &InstanceHit) -> bool + 'f;

/// See [`SceneTree::nearest_filtered`].
#[inline(never)]
pub(super) fn nearest(scene: &SceneTree, ray: &Ray, filter: &mut Filter) -> Option<InstanceHit> {
    launch(Nearest { scene, ray, filter })
}

/// See [`SceneTree::any_filtered`].
#[inline(never)]
pub(super) fn any(scene: &SceneTree, ray: &Ray, filter: &mut Filter) -> bool {
    launch(Any { scene, ray, filter })
}

/// See [`SceneTree::nearest_filtered_batch`]; there are at least as many `hits` as `rays`.
#[inline(never)]
pub(super) fn nearest_batch(
    scene: &SceneTree,
    rays: &[Ray],
    hits: &mut [Option<InstanceHit>],
    coherence: Coherence,
    filter: &mut Filter,
) {
    if let Some(triangles) = &scene.alone {
        let mut answer =
            |index: usize, hit: Option<Hit>| hits[index] = hit.map(|hit| InstanceHit { instance: 0, hit });
        return nearest_in_mesh(triangles.mesh(), rays, coherence, &mut answer);
    }
    let answer = |index: usize, hit| hits[index] = hit;
    launch(Batch::<_, false> { scene, rays, coherence, filter, answer });
}

/// See [`SceneTree::any_filtered_batch`]; there are at least as many places in `met` as `rays`.
#[inline(never)]
pub(super) fn any_batch(
    scene: &SceneTree,
    rays: &[Ray],
    met: &mut [bool],
    coherence: Coherence,
    filter: &mut Filter,
) {
    if let Some(triangles) = &scene.alone {
        let mut answer = |index: usize, hit: Option<Hit>| met[index] = hit.is_some();
        return any_in_mesh(triangles.mesh(), rays, coherence, &mut answer);
    }
    let answer = |index: usize, hit: Option<InstanceHit>| met[index] = hit.is_some();
    launch(Batch::<_, true> { scene, rays, coherence, filter, answer });
}

/// One stack for each level.
pub(super) struct Stacks {
    world: Stack,
    object: Stack,
}

impl Stacks {
    pub(super) fn new() -> Self {
        Self { world: Stack::new(), object: Stack::new() }
    }
}

impl SceneTree {
    #[inline(always)]
    pub(super) fn search<I: Isa>(
        &self,
        index: usize,
        ray: &Ray,
        stacks: &mut Stacks,
        filter: &mut Filter,
    ) -> Option<InstanceHit> {
        if let Some(triangles) = &self.alone {
            let mesh = triangles.mesh();
            let hit = mesh.nearest::<I>(ray, f32::INFINITY, &mut stacks.object, false, |_| true)?;
            return Some(InstanceHit { instance: 0, hit });
        }
        let prepared = Prepared::new(ray)?;
        let whole = prepared.whole();
        let mut bound = whole.far;
        let mut best: Option<InstanceHit> = None;
        let Stacks { world, object } = stacks;
        let mut visit = |instance: u32, interval: Interval, mut bound: f32| {
            let accept = |hit: &InstanceHit| filter(index, hit);
            if let Some(hit) = self.instance_hit::<I>(instance, ray, interval, bound, object, accept)
                && hit.precedes(best.as_ref(), bound)
            {
                bound = hit.hit.t;
                best = Some(hit);
            }
            bound
        };
        for &instance in &self.unbounded {
            bound = visit(instance, whole, bound);
        }
        walk::<I>(self.tree.tree(), &prepared, bound, world, |leaf, mut bound| {
            for (instance, bounds) in self.tree.entries(leaf) {
                if let Some(interval) = prepared.interval(bounds)
                    && interval.near <= bound
                {
                    bound = visit(instance, interval, bound);
                }
            }
            bound
        });
        best
    }

    /// The hit of one instance unless it lies beyond `bound`.
    #[inline(always)]
    fn instance_hit<I: Isa>(
        &self,
        instance: u32,
        ray: &Ray,
        interval: Interval,
        bound: f32,
        stack: &mut Stack,
        mut filter: impl FnMut(&InstanceHit) -> bool,
    ) -> Option<InstanceHit> {
        let placed = self.placed[instance as usize].as_ref()?;
        let geometry = &self.geometries[placed.geometry as usize];
        let of_world = |hit: &Hit| InstanceHit { instance, hit: Hit { t: interval.clamp(hit.t), ..*hit } };
        let ray = placed.toward_object(ray);
        let bound = bound_inside(&interval, bound);
        let accept = |hit: &Hit| !placed.filtered || filter(&of_world(hit));
        let hit = geometry.nearest::<I>(&ray, bound, stack, placed.cull_back, accept);
        hit.map(|hit| of_world(&hit))
    }

    #[inline(always)]
    pub(super) fn meets<I: Isa>(
        &self,
        index: usize,
        ray: &Ray,
        stacks: &mut Stacks,
        filter: &mut Filter,
    ) -> bool {
        if let Some(triangles) = &self.alone {
            return triangles.mesh().any::<I>(ray, &mut stacks.object, false, |_| true);
        }
        let Some(prepared) = Prepared::new(ray) else { return false };
        let Stacks { world, object } = stacks;
        let whole = prepared.whole();
        let mut met = |instance: u32, interval: Interval| {
            let Some(placed) = self.placed[instance as usize].as_ref() else { return false };
            let geometry = &self.geometries[placed.geometry as usize];
            let ray = placed.toward_object(ray);
            geometry.any::<I>(&ray, object, placed.cull_back, |hit| {
                let of_world = InstanceHit { instance, hit: Hit { t: interval.clamp(hit.t), ..*hit } };
                !placed.filtered || filter(index, &of_world)
            })
        };
        if self.unbounded.iter().any(|&instance| met(instance, whole)) {
            return true;
        }
        let mut found = false;
        walk::<I>(self.tree.tree(), &prepared, whole.far, world, |leaf, bound| {
            for (instance, bounds) in self.tree.entries(leaf) {
                if !found && let Some(interval) = prepared.interval(bounds) {
                    found = met(instance, interval);
                }
            }
            if found { f32::NEG_INFINITY } else { bound }
        });
        found
    }
}

/// What prunes inside an instance: the bound of the world, unless clamping into the instance's interval may pull a hit in
/// front of it.
pub(crate) fn bound_inside(interval: &Interval, bound: f32) -> f32 {
    if interval.far <= bound { f32::INFINITY } else { bound }
}

/// The nearest hit of one ray.
struct Nearest<'a, 'f> {
    scene: &'a SceneTree,
    ray: &'a Ray,
    filter: &'a mut Filter<'f>,
}

impl Kernel for Nearest<'_, '_> {
    type Output = Option<InstanceHit>;
    #[inline(always)]
    fn run<I: Isa>(self) -> Option<InstanceHit> {
        self.scene.search::<I>(0, self.ray, &mut Stacks::new(), self.filter)
    }
}

/// Whether one ray meets anything.
struct Any<'a, 'f> {
    scene: &'a SceneTree,
    ray: &'a Ray,
    filter: &'a mut Filter<'f>,
}

impl Kernel for Any<'_, '_> {
    type Output = bool;
    #[inline(always)]
    fn run<I: Isa>(self) -> bool {
        self.scene.meets::<I>(0, self.ray, &mut Stacks::new(), self.filter)
    }
}

/// Every ray of a batch; `ANY` ends each at the first hit, of which nothing but that it is there is told.
struct Batch<'a, 'f, R, const ANY: bool> {
    scene: &'a SceneTree,
    rays: &'a [Ray],
    coherence: Coherence,
    filter: &'a mut Filter<'f>,
    answer: R,
}

impl<R: FnMut(usize, Option<InstanceHit>), const ANY: bool> Kernel for Batch<'_, '_, R, ANY> {
    type Output = ();
    #[inline(always)]
    fn run<I: Isa>(self) {
        let Self { scene, rays, coherence, filter, mut answer } = self;
        // Packets whose rays do not run the same way after all are left to the queue.
        let mut others = Vec::new();
        if rays.len() < FEW || coherence == Coherence::Incoherent {
            others.push(0..rays.len());
        } else {
            let mut stacks = PacketStacks::new();
            for (packet, rays) in rays.chunks(PACKET).enumerate() {
                let first = packet * PACKET;
                if !trace_world::<I, ANY>(scene, rays, first, filter, &mut stacks, &mut answer) {
                    others.push(first..first + rays.len());
                }
            }
        }
        if others.is_empty() {
            return;
        }
        let others = others.into_iter().flatten();
        if rays.len() >= FEW
            && let Some(mut world) = World::new(scene, rays, &mut *filter, &mut answer, ANY)
        {
            return trace::<I, _, ANY>(&mut world, rays, others);
        }
        let mut stacks = Stacks::new();
        others.for_each(|index| {
            let ray = &rays[index];
            let hit = if ANY {
                let nothing = Hit { t: 0.0, u: 0.0, v: 0.0, primitive: 0 };
                let met = scene.meets::<I>(index, ray, &mut stacks, filter);
                met.then_some(InstanceHit { instance: 0, hit: nothing })
            } else {
                scene.search::<I>(index, ray, &mut stacks, filter)
            };
            answer(index, hit);
        });
    }
}
