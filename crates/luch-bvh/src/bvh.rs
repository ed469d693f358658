//! A tree over boxes; what is in them only the caller knows.

use crate::build::{Item, Quality, build_wide, items};
use crate::simd::{Isa, Kernel, Prepared, Stack, launch, walk};
use crate::tree::{Statistics, Tree};
use crate::wide::NO_PRIMITIVE;
use crate::{Aabb, Hit, Ray, SlabRay};
use glam::Vec3;

/// A tree over anything that has a box. Boxes that are empty or not a number are left out and never met.
#[derive(Clone, Debug)]
pub struct Bvh {
    tree: Tree,
    leaves: Vec<Leaf>,
}

/// Up to four boxes and their numbers, [`NO_PRIMITIVE`] where there is none.
#[derive(Clone, Copy, Debug)]
struct Leaf {
    boxes: [Aabb; 4],
    primitives: [u32; 4],
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
        let boxes = &boxes[..boxes.len().min(u32::MAX as usize)];
        let item = |primitive: usize| Item::new(&boxes[primitive], primitive as u32);
        let wide = build_wide(items(boxes.len(), item), quality, None);
        let own = |primitive: u32| match primitive {
            NO_PRIMITIVE => Aabb::empty(),
            primitive => boxes[primitive as usize],
        };
        let leaf = |primitives: &[u32; 4]| Leaf { boxes: primitives.map(own), primitives: *primitives };
        let leaves = wide.leaves.iter().map(leaf).collect();
        Self { tree: Tree::new(wide), leaves }
    }

    /// The box of all boxes.
    pub fn bounds(&self) -> Aabb {
        self.tree.bounds()
    }

    /// The size and worth of the tree.
    pub fn statistics(&self) -> Statistics {
        self.tree.statistics(|leaf| self.leaves[leaf].entries().count(), size_of_val(self.leaves.as_slice()))
    }

    /// The nearest hit; of equally near ones that of the lowest primitive.
    ///
    /// `leaf` tests one primitive. It must be a pure function of primitive and ray, which is always the ray given here. Its
    /// `t` is clamped into the interval of the primitive's box ([`SlabRay::clamp`]), and its `primitive` is set.
    pub fn nearest(&self, ray: &Ray, mut leaf: impl FnMut(u32, &Ray) -> Option<Hit>) -> Option<Hit> {
        let slab = SlabRay::new(ray)?;
        let mut best: Option<Hit> = None;
        self.visit(ray, |primitive, bounds, mut bound| {
            if let Some(hit) = Self::clamped(&slab, bounds, primitive, leaf(primitive, ray))
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
        self.visit(ray, |primitive, bounds, bound| {
            found = found || (slab.interval(bounds).is_some() && leaf(primitive, ray));
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
        self.tree.walk_near(point, limit, |leaf, mut bound| {
            for (primitive, bounds) in self.leaves[leaf].entries() {
                let Some(found) = nearest_on(primitive) else { continue };
                // Never nearer than its own box, as in the theorem of rays.
                let squared = (found - point).length_squared().max(bounds.distance_squared(point));
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

    /// Hands every primitive whose leaf may matter to `visit`, with its box and the bound so far; `visit` returns the bound
    /// from now on, -∞ to end.
    fn visit(&self, ray: &Ray, visit: impl FnMut(u32, &Aabb, f32) -> f32) {
        if let Some(ray) = Prepared::new(ray) {
            launch(Visit { bvh: self, ray: &ray, visit });
        }
    }

    fn clamped(slab: &SlabRay, bounds: &Aabb, primitive: u32, hit: Option<Hit>) -> Option<Hit> {
        let hit = hit?;
        let on_ray = slab.t_min <= hit.t && hit.t <= slab.t_max;
        let t = slab.clamp(bounds, hit.t)?;
        on_ray.then_some(Hit { t, primitive, ..hit })
    }

    pub(crate) fn tree(&self) -> &Tree {
        &self.tree
    }

    /// The numbers and boxes in a leaf.
    pub(crate) fn entries(&self, leaf: usize) -> impl Iterator<Item = (u32, &Aabb)> {
        self.leaves[leaf].entries()
    }
}

impl Leaf {
    fn entries(&self) -> impl Iterator<Item = (u32, &Aabb)> {
        let all = self.primitives.iter().copied().zip(&self.boxes);
        all.take_while(|(primitive, _)| *primitive != NO_PRIMITIVE)
    }
}

struct Visit<'a, F> {
    bvh: &'a Bvh,
    ray: &'a Prepared,
    visit: F,
}

impl<F: FnMut(u32, &Aabb, f32) -> f32> Kernel for Visit<'_, F> {
    type Output = ();
    #[inline(always)]
    fn run<I: Isa>(mut self) {
        let Self { bvh, ray, .. } = self;
        walk::<I>(&bvh.tree, ray, ray.whole().far, &mut Stack::new(), |leaf, mut bound| {
            for (primitive, bounds) in bvh.entries(leaf) {
                bound = (self.visit)(primitive, bounds, bound);
            }
            bound
        });
    }
}
