//! Two levels of trees: geometries, and where copies of them stand in the world.
//!
//! A ray is taken into the space of an instance by the inverse of its placement. The direction is not made a unit vector
//! there, so `t` means the same in both spaces.
//!
//! The theorem of [`slab`](crate::slab) holds on both levels. The *hit of an instance* is the nearest accepted hit of its
//! geometry, its `t` clamped into the interval of the instance's own world box, and the least `(t, instance)` wins. Inside
//! the geometry the best hit so far may prune only while the far end of that interval lies beyond it: then a hit that is
//! pruned stays behind the best one when clamped. Otherwise clamping may pull it forward, so nothing is pruned.

mod geometry;
mod placed;
mod search;
mod traced;

pub use geometry::Geometry;
pub(crate) use placed::Placed;
pub(crate) use search::{Filter, bound_inside};
pub use traced::{Traced, TracedHit};

use crate::build::Quality;
use crate::tree::Tree;
use crate::{Aabb, Bvh, Coherence, Hit, Ray, TriangleBvh};
use glam::Affine3A;
use std::sync::Arc;

/// One copy of a geometry in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instance {
    /// Which geometry, as an index into the list given to [`SceneTree::build`].
    pub geometry: u32,
    /// From the space of the geometry into the world. A map that cannot be inverted makes an instance that is never hit.
    pub placement: Affine3A,
    /// Whether rays pass through faces from behind. Judged in the space of the geometry, so a mirrored copy keeps its outside.
    pub cull_back: bool,
    /// Whether the filter of [`SceneTree::nearest_filtered`] and [`SceneTree::any_filtered`] is asked about its hits.
    pub filtered: bool,
}

/// A ray meets an instance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InstanceHit {
    /// Index of the instance as it was given to the build.
    pub instance: u32,
    /// Where, within its geometry; `t` counts along the world ray. Shapes have the one primitive 0.
    pub hit: Hit,
}

/// Geometries, their instances and a tree over the world boxes of these.
#[derive(Clone, Debug)]
pub struct SceneTree {
    geometries: Vec<Geometry>,
    /// By instance; `None` for one that is never hit.
    placed: Vec<Option<Placed>>,
    /// Over the instances that have a box.
    tree: Bvh,
    /// Indices of the instances without one, always tested.
    unbounded: Vec<u32>,
    /// The triangles of the one instance that there is, if it stands where it was made: the world then needs no tree.
    /// Its hits lie within the boxes of its triangles and so within its own: clamping would change nothing.
    alone: Option<Arc<TriangleBvh>>,
}

impl SceneTree {
    /// Builds the tree over instances. An instance whose geometry is not in the list is never hit.
    pub fn build(geometries: Vec<Geometry>, instances: &[Instance], quality: Quality) -> Self {
        let place = |instance: &Instance| Placed::new(instance, geometries.get(instance.geometry as usize)?);
        let placed: Vec<_> = instances.iter().map(place).collect();
        let bounds = |placed: &Option<Placed>| placed.as_ref().and_then(|placed| placed.bounds);
        let boxes: Vec<_> = placed.iter().map(|placed| bounds(placed).unwrap_or(Aabb::empty())).collect();
        let is_unbounded =
            |placed: &Option<Placed>| placed.as_ref().is_some_and(|placed| placed.bounds.is_none());
        let numbered = (0..u32::MAX).zip(&placed);
        let unbounded = numbered.filter(|(_, placed)| is_unbounded(placed)).map(|(index, _)| index).collect();
        let alone = match instances {
            [only] if only.placement == Affine3A::IDENTITY && !only.filtered && !only.cull_back => {
                match geometries.get(only.geometry as usize) {
                    Some(Geometry::Triangles(triangles)) => Some(Arc::clone(triangles)),
                    _ => None,
                }
            }
            _ => None,
        };
        Self { tree: Bvh::build(&boxes, quality), geometries, placed, unbounded, alone }
    }

    /// The geometries as they were given.
    pub fn geometries(&self) -> &[Geometry] {
        &self.geometries
    }

    /// The box of all instances that have one.
    pub fn bounds(&self) -> Aabb {
        self.tree.bounds()
    }

    /// The nearest hit; of equally near ones that of the lowest instance, then of the lowest primitive.
    pub fn nearest(&self, ray: &Ray) -> Option<InstanceHit> {
        self.nearest_filtered(ray, |_| true)
    }

    /// The nearest hit that counts. Hits of instances that are not `filtered` all do; of the others those do for which
    /// `filter` is true, and the ray goes on through the rest. `filter` must be a pure function of the hit: it may be asked
    /// about any, in any order.
    pub fn nearest_filtered(
        &self,
        ray: &Ray,
        mut filter: impl FnMut(&InstanceHit) -> bool,
    ) -> Option<InstanceHit> {
        search::nearest(self, ray, &mut |_, hit| filter(hit))
    }

    /// Whether the ray meets anything.
    pub fn any(&self, ray: &Ray) -> bool {
        self.any_filtered(ray, |_| true)
    }

    /// Whether the ray meets anything that counts; `filter` as in [`SceneTree::nearest_filtered`].
    pub fn any_filtered(&self, ray: &Ray, mut filter: impl FnMut(&InstanceHit) -> bool) -> bool {
        search::any(self, ray, &mut |_, hit| filter(hit))
    }

    /// [`SceneTree::nearest`] of each ray, into the place of the same index; on the calling thread. Where the slices differ
    /// in length the rest of the longer one is left alone.
    pub fn nearest_batch(&self, rays: &[Ray], hits: &mut [Option<InstanceHit>], coherence: Coherence) {
        self.nearest_filtered_batch(rays, hits, coherence, |_, _| true);
    }

    /// [`SceneTree::any`] of each ray; as [`SceneTree::nearest_batch`].
    pub fn any_batch(&self, rays: &[Ray], met: &mut [bool], coherence: Coherence) {
        self.any_filtered_batch(rays, met, coherence, |_, _| true);
    }

    /// [`SceneTree::nearest_filtered`] of each ray; the filter is also told the index of the ray.
    pub fn nearest_filtered_batch(
        &self,
        rays: &[Ray],
        hits: &mut [Option<InstanceHit>],
        coherence: Coherence,
        mut filter: impl FnMut(usize, &InstanceHit) -> bool,
    ) {
        let rays = &rays[..rays.len().min(hits.len())];
        search::nearest_batch(self, rays, hits, coherence, &mut filter);
    }

    /// [`SceneTree::any_filtered`] of each ray; the filter is also told the index of the ray.
    pub fn any_filtered_batch(
        &self,
        rays: &[Ray],
        met: &mut [bool],
        coherence: Coherence,
        mut filter: impl FnMut(usize, &InstanceHit) -> bool,
    ) {
        let rays = &rays[..rays.len().min(met.len())];
        search::any_batch(self, rays, met, coherence, &mut filter);
    }

    /// The tree over the instances that have a box.
    pub(crate) fn bvh(&self) -> &Bvh {
        &self.tree
    }

    /// The nodes of that tree.
    pub(crate) fn tree(&self) -> &Tree {
        self.tree.tree()
    }

    /// By instance; `None` for one that is never hit.
    pub(crate) fn placed(&self) -> &[Option<Placed>] {
        &self.placed
    }

    /// Indices of the instances without a box.
    pub(crate) fn unbounded(&self) -> &[u32] {
        &self.unbounded
    }
}

impl InstanceHit {
    /// Whether this hit comes before the best one so far, by `(t, instance)`; without one, at or before `bound`.
    pub(crate) fn precedes(&self, best: Option<&Self>, bound: f32) -> bool {
        match best {
            Some(best) => {
                self.hit.t < best.hit.t || (self.hit.t == best.hit.t && self.instance < best.instance)
            }
            None => self.hit.t <= bound,
        }
    }
}
