//! One ray through both levels.

use super::{InstanceHit, SceneTree};
use crate::simd::{All, Isa, Kernel, MeshBatch, Prepared, Stack, World, trace, walk};
use crate::{Coherence, Hit, Interval, Ray};

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
        ray: &Ray,
        stacks: &mut Stacks,
        mut filter: impl FnMut(&InstanceHit) -> bool,
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
            if let Some(hit) = self.instance_hit::<I>(instance, ray, interval, bound, object, &mut filter)
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
        filter: &mut impl FnMut(&InstanceHit) -> bool,
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
        ray: &Ray,
        stacks: &mut Stacks,
        mut filter: impl FnMut(&InstanceHit) -> bool,
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
                !placed.filtered || filter(&of_world)
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
pub(super) struct Nearest<'a, F> {
    pub(super) scene: &'a SceneTree,
    pub(super) ray: &'a Ray,
    pub(super) filter: F,
}

impl<F: FnMut(&InstanceHit) -> bool> Kernel for Nearest<'_, F> {
    type Output = Option<InstanceHit>;
    #[inline(always)]
    fn run<I: Isa>(self) -> Option<InstanceHit> {
        self.scene.search::<I>(self.ray, &mut Stacks::new(), self.filter)
    }
}

/// Whether one ray meets anything.
pub(super) struct Any<'a, F> {
    pub(super) scene: &'a SceneTree,
    pub(super) ray: &'a Ray,
    pub(super) filter: F,
}

impl<F: FnMut(&InstanceHit) -> bool> Kernel for Any<'_, F> {
    type Output = bool;
    #[inline(always)]
    fn run<I: Isa>(self) -> bool {
        self.scene.meets::<I>(self.ray, &mut Stacks::new(), self.filter)
    }
}

/// Every ray of a batch; `ANY` ends each at the first hit, of which nothing but that it is there is told.
pub(super) struct Batch<'a, F, R, const ANY: bool> {
    pub(super) scene: &'a SceneTree,
    pub(super) rays: &'a [Ray],
    pub(super) coherence: Coherence,
    pub(super) filter: F,
    pub(super) answer: R,
}

/// Fewer rays are not worth a queue.
const FEW: usize = 8;

impl<F, R, const ANY: bool> Kernel for Batch<'_, F, R, ANY>
where
    F: FnMut(usize, &InstanceHit) -> bool,
    R: FnMut(usize, Option<InstanceHit>),
{
    type Output = ();
    #[inline(always)]
    fn run<I: Isa>(self) {
        let Self { scene, rays, coherence, mut filter, mut answer } = self;
        if let Some(triangles) = &scene.alone {
            let mesh = triangles.mesh();
            let answer = |index: usize, hit: Option<Hit>| {
                answer(index, hit.map(|hit| InstanceHit { instance: 0, hit }))
            };
            MeshBatch::<_, _, ANY> { mesh, rays, cull_back: false, coherence, accept: All, answer }
                .run::<I>();
        } else if rays.len() >= FEW
            && let Some(mut world) = World::new(scene, rays, &mut filter, &mut answer, ANY)
        {
            trace::<I, _, ANY>(&mut world, rays, 0..rays.len());
        } else {
            let mut stacks = Stacks::new();
            for (index, ray) in rays.iter().enumerate() {
                let filter = |hit: &InstanceHit| filter(index, hit);
                let hit = if ANY {
                    let nothing = Hit { t: 0.0, u: 0.0, v: 0.0, primitive: 0 };
                    let met = scene.meets::<I>(ray, &mut stacks, filter);
                    met.then_some(InstanceHit { instance: 0, hit: nothing })
                } else {
                    scene.search::<I>(ray, &mut stacks, filter)
                };
                answer(index, hit);
            }
        }
    }
}
