//! A tree over boxes; what is in them only the caller knows.

use crate::build::{Quality, Reference, build};
use crate::tree::{Stack, Statistics, Tree};
use crate::{Aabb, Hit, Ray, SlabRay};
use glam::Vec3;

/// A tree over anything that has a box. Boxes that are empty or not a number are left out and never met.
#[derive(Clone, Debug)]
pub struct Bvh {
    tree: Tree,
    /// In leaf order.
    boxes: Vec<Aabb>,
    /// Index of each box as it was given, in leaf order.
    primitives: Vec<u32>,
}

/// The primitive nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearestPoint {
    /// Its point nearest to the one asked about.
    pub point: Vec3,
    /// The distance between both.
    pub distance: f32,
    /// Index of the primitive as it was given to the build.
    pub primitive: u32,
}

impl Bvh {
    /// Builds the tree on as many threads as the rayon pool has; the result is the same for any number of them.
    /// At most 2³² boxes; those beyond are left out.
    pub fn build(boxes: &[Aabb], quality: Quality) -> Self {
        let numbered = (0..u32::MAX).zip(boxes);
        let mut references: Vec<_> =
            numbered.filter_map(|(primitive, bounds)| Reference::new(*bounds, primitive)).collect();
        let tree = build(&mut references, quality);
        Self {
            tree,
            boxes: references.iter().map(|reference| reference.bounds).collect(),
            primitives: references.iter().map(|reference| reference.primitive).collect(),
        }
    }

    /// The box of all boxes.
    pub fn bounds(&self) -> Aabb {
        self.tree.bounds
    }

    /// The size and worth of the tree.
    pub fn statistics(&self) -> Statistics {
        let bytes = self.boxes.len() * (size_of::<Aabb>() + size_of::<u32>());
        self.tree.statistics(bytes)
    }

    /// The nearest hit; of equally near ones that of the lowest primitive.
    ///
    /// `leaf` tests one primitive. It must be a pure function of primitive and ray, which is always the ray given here. Its
    /// `t` is clamped into the interval of the primitive's box ([`SlabRay::clamp`]), and its `primitive` is set.
    pub fn nearest(&self, ray: &Ray, mut leaf: impl FnMut(u32, &Ray) -> Option<Hit>) -> Option<Hit> {
        let slab = SlabRay::new(ray)?;
        let mut best: Option<Hit> = None;
        self.visit(&slab, slab.t_max, &mut Stack::new(), |place, mut bound| {
            let primitive = self.primitives[place];
            if let Some(hit) = Self::clamped(&slab, &self.boxes[place], primitive, leaf(primitive, ray))
                && hit.precedes(best.as_ref(), bound)
            {
                bound = hit.t;
                best = Some(hit);
            }
            bound
        });
        best
    }

    /// Whether the ray meets any primitive; `leaf` as in [`Bvh::nearest`].
    pub fn any(&self, ray: &Ray, mut leaf: impl FnMut(u32, &Ray) -> bool) -> bool {
        let Some(slab) = SlabRay::new(ray) else { return false };
        let mut found = false;
        self.visit(&slab, slab.t_max, &mut Stack::new(), |place, bound| {
            found =
                found || (slab.interval(&self.boxes[place]).is_some() && leaf(self.primitives[place], ray));
            if found { f32::NEG_INFINITY } else { bound }
        });
        found
    }

    /// The primitive nearest to `point`, not farther than `max_distance`; of equally near ones the lowest.
    ///
    /// `nearest_on` finds the point of a primitive nearest to `point`. It must be a pure function.
    pub fn nearest_point(
        &self,
        point: Vec3,
        max_distance: f32,
        mut nearest_on: impl FnMut(u32) -> Option<Vec3>,
    ) -> Option<NearestPoint> {
        if !point.is_finite() || max_distance.is_nan() || max_distance < 0.0 {
            return None;
        }
        let mut best: Option<(f32, NearestPoint)> = None;
        let limit = max_distance * max_distance;
        self.tree.walk_near(point, limit, |places, mut bound| {
            for place in places {
                let primitive = self.primitives[place];
                let Some(found) = nearest_on(primitive) else { continue };
                // Never nearer than its own box, as in the theorem of rays.
                let squared = (found - point).length_squared().max(self.boxes[place].distance_squared(point));
                let precedes = best.is_none_or(|(least, best)| {
                    squared < least || (squared == least && primitive < best.primitive)
                });
                if squared <= bound && precedes {
                    bound = squared;
                    best =
                        Some((squared, NearestPoint { point: found, distance: squared.sqrt(), primitive }));
                }
            }
            bound
        });
        best.map(|(_, nearest)| nearest)
    }

    /// Hands the place of every box that may matter to `visit`, which returns the bound from now on.
    #[inline(always)]
    pub(crate) fn visit(
        &self,
        ray: &SlabRay,
        bound: f32,
        stack: &mut Stack,
        mut visit: impl FnMut(usize, f32) -> f32,
    ) {
        self.tree.walk(ray, bound, stack, |places, mut bound| {
            for place in places {
                bound = visit(place, bound);
            }
            bound
        });
    }

    /// Index of the primitive at a place, as it was given.
    pub(crate) fn primitive(&self, place: usize) -> u32 {
        self.primitives[place]
    }

    /// The box at a place.
    pub(crate) fn bounds_at(&self, place: usize) -> &Aabb {
        &self.boxes[place]
    }

    fn clamped(slab: &SlabRay, bounds: &Aabb, primitive: u32, hit: Option<Hit>) -> Option<Hit> {
        let hit = hit?;
        let on_ray = slab.t_min <= hit.t && hit.t <= slab.t_max;
        let t = slab.clamp(bounds, hit.t)?;
        on_ray.then_some(Hit { t, primitive, ..hit })
    }
}
