//! What an instance can be a copy of.

use super::Traced;
use super::traced::hits_along;
use crate::shape::{Disc, Frustum, Parallelogram, Plane, Sphere};
use crate::simd::{Isa, Stack};
use crate::{Aabb, Crossing, Hit, Ray, TriangleBvh};
use std::sync::Arc;

/// What an instance can be a copy of.
#[derive(Clone, Debug)]
pub enum Geometry {
    /// A triangle mesh and its tree, shared by all who place it.
    Triangles(Arc<TriangleBvh>),
    /// A sphere.
    Sphere(Sphere),
    /// A cylinder, a cone or what lies between.
    Frustum(Frustum),
    /// A round piece of a plane.
    Disc(Disc),
    /// A piece of a plane between two edges.
    Parallelogram(Parallelogram),
    /// A plane without end. It has no box, so every ray is tested against every instance of one.
    Plane(Plane),
    /// A surface with a ray test of its own, shared by all who place it.
    Traced(Arc<dyn Traced>),
}

impl Geometry {
    /// A box around it; `None` for a plane. Empty for what can never be hit.
    pub fn bounds(&self) -> Option<Aabb> {
        match self {
            Self::Triangles(triangles) => Some(triangles.bounds()),
            Self::Sphere(sphere) => Some(sphere.bounds()),
            Self::Frustum(frustum) => Some(frustum.bounds()),
            Self::Disc(disc) => Some(disc.bounds()),
            Self::Parallelogram(parallelogram) => Some(parallelogram.bounds()),
            Self::Plane(_) => None,
            Self::Traced(traced) => Some(traced.bounds()),
        }
    }

    /// The nearest accepted hit. One of a mesh beyond `bound` may be left out.
    #[inline(always)]
    pub(super) fn nearest<I: Isa>(
        &self,
        ray: &Ray,
        bound: f32,
        stack: &mut Stack,
        cull_back: bool,
        accept: impl FnMut(&Hit) -> bool,
    ) -> Option<Hit> {
        match self {
            Self::Triangles(triangles) => triangles.mesh().nearest::<I>(ray, bound, stack, cull_back, accept),
            shape => shape.hits(ray, cull_back).find(accept),
        }
    }

    /// Whether there is any accepted hit.
    #[inline(always)]
    pub(super) fn any<I: Isa>(
        &self,
        ray: &Ray,
        stack: &mut Stack,
        cull_back: bool,
        mut accept: impl FnMut(&Hit) -> bool,
    ) -> bool {
        match self {
            Self::Triangles(triangles) => triangles.mesh().any::<I>(ray, stack, cull_back, accept),
            shape => shape.hits(ray, cull_back).any(|hit| accept(&hit)),
        }
    }

    /// The hits of a shape, nearest first.
    pub(crate) fn hits(&self, ray: &Ray, cull_back: bool) -> impl Iterator<Item = Hit> {
        let crossings: [Option<Crossing>; 2] = match self {
            Self::Triangles(_) | Self::Traced(_) => [None; 2],
            Self::Sphere(sphere) => sphere.crossings(ray),
            Self::Frustum(frustum) => frustum.crossings(ray),
            Self::Disc(disc) => [disc.crossing(ray), None],
            Self::Parallelogram(parallelogram) => [parallelogram.crossing(ray), None],
            Self::Plane(plane) => [plane.crossing(ray), None],
        };
        let seen = crossings.into_iter().flatten().filter(move |crossing| crossing.front || !cull_back);
        let known = seen.map(|crossing| Hit { t: crossing.t, u: crossing.u, v: crossing.v, primitive: 0 });
        let traced =
            if let Self::Traced(traced) = self { Some(hits_along(&**traced, ray, cull_back)) } else { None };
        known.chain(traced.into_iter().flatten())
    }
}
