//! Surfaces with a ray test of their own, such as height fields and formulas.

use crate::{Aabb, Crossing, Hit, Ray};
use std::fmt::Debug;

/// A surface that rays find by a test of its own.
///
/// The test must be a pure function of ray and surface.
pub trait Traced: Debug + Send + Sync {
    /// A box around it, not too small; empty for what can never be hit.
    fn bounds(&self) -> Aabb;

    /// The first crossing whose `t`, rounded to single precision, lies in the ray's interval, ends included.
    fn nearest(&self, ray: &Ray) -> Option<TracedHit>;
}

/// Where a ray meets a [`Traced`] surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TracedHit {
    /// Where along the ray, and from which side.
    pub crossing: Crossing,
    /// Which part of the surface.
    pub primitive: u32,
}

/// All hits of a surface, nearest first; those from behind are left out where `cull_back` says so.
pub(super) fn hits_along(surface: &dyn Traced, ray: &Ray, cull_back: bool) -> impl Iterator<Item = Hit> {
    let first = surface.nearest(ray);
    let further = move |hit: &TracedHit| {
        // Past the one that was found: a pass through the same place twice would give it two chances to be there.
        let t_min = hit.crossing.t.next_up();
        if t_min <= ray.t_max { surface.nearest(&Ray { t_min, ..*ray }) } else { None }
    };
    let seen = std::iter::successors(first, further).filter(move |hit| hit.crossing.front || !cull_back);
    seen.map(|TracedHit { crossing, primitive }| Hit {
        t: crossing.t,
        u: crossing.u,
        v: crossing.v,
        primitive,
    })
}
