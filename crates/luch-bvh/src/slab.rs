//! The piece of a ray inside a box, and why a tree cannot change a hit.
//!
//! # The test
//!
//! For a box and a ray the *interval* is
//!
//! ```text
//! near = max(t_min, max over axes of (plane facing the ray  - origin) · near_inverse)
//! far  = min(t_max, min over axes of (plane behind it       - origin) · far_inverse)
//! ```
//!
//! with `near_inverse = 1/direction · (1 - 2⁻²⁰)` and `far_inverse = 1/direction · (1 + 2⁻²⁰)`: some 16 units in the last
//! place too wide on either side, which covers the rounding of the formula itself three times over (Ize, "Robust BVH Ray
//! Traversal", JCGT 2013). The interval is empty unless `near <= far`. Where the direction has a zero and the origin lies
//! exactly in the plane, 0·∞ is not a number; the comparisons are written so that it is passed over: the ray runs inside
//! the closed slab.
//!
//! # The theorem
//!
//! *A tree returns the hit that the loop over all primitives returns, bit for bit, whatever its shape.*
//!
//! Three rules make it so.
//!
//! 1. The test of a primitive is a pure function of ray and primitive. Its raw `t` is accepted only inside the ray's own
//!    `[t_min, t_max]`, never compared with the best hit so far.
//! 2. The accepted `t` is *clamped* into the interval of the primitive's own box, and the hit is dropped if that interval
//!    is empty ([`SlabRay::clamp`]). The loop over all primitives does the same.
//! 3. A node is passed over only if `near <= min(far, best)` fails for its box, `best` being the `t` of the best hit so
//!    far (or `t_max`). Of two hits the lesser `(t, primitive)` wins.
//!
//! *Proof.* Let box P lie inside box N. On each axis the plane of N facing the ray is not beyond that of P, so, as
//! rounded subtraction and rounded multiplication by a fixed number are monotone, `near` of N is at most `near` of P; when
//! the product is not a number for P, origin and plane agree, so the plane of N is there or before it and its product is
//! not a number either or -∞, which both leave the maximum alone; when it is not a number for N only, N leaves the maximum
//! alone. Likewise `far` of N is at least `far` of P. Node boxes are exact unions (minimum and maximum round nothing), so
//! every ancestor N of primitive P has `near(N) <= near(P)` and `far(P) <= far(N)`.
//! Let P have the clamped hit `t`, so `near(P) <= t <= far(P)`, and let `t <= best` at any moment. Then
//! `near(N) <= t <= min(far(N), best)` for every ancestor N: none is passed over. So each primitive whose hit is not
//! beaten is tested, and the least `(t, primitive)` of all is found; the order of visits does not matter since the
//! least of a finite set is the same in any order. ∎
//!
//! Nothing here depends on how the tree was built, and a vector unit that evaluates the same two formulas gives the same
//! bits. The build need not even be good, only correct: each primitive in one leaf, each box the union of what is below.
//!
//! What the clamping costs in truth is nothing one can see: boxes of primitives are padded beyond the rounding error of
//! the primitive tests, so a hit is moved by less than its own error.

use crate::{Aabb, Ray};

/// How much nearer the near end and how much farther the far end is taken: 2⁻²⁰ of it.
const MARGIN: f32 = 1.0 / 1_048_576.0;

/// A piece of a ray, `near <= far`, both ends included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Least parameter.
    pub near: f32,
    /// Greatest parameter.
    pub far: f32,
}

impl Interval {
    /// The parameter itself, or the end it lies beyond.
    #[inline(always)]
    pub fn clamp(&self, t: f32) -> f32 {
        let t = if t < self.near { self.near } else { t };
        if t > self.far { self.far } else { t }
    }
}

/// A ray prepared for box tests.
#[derive(Clone, Copy, Debug)]
pub struct SlabRay {
    pub(crate) origin: [f32; 3],
    /// Factors of the near ends: reciprocal direction, made smaller by 2⁻²⁰ of it.
    pub(crate) near_inverse: [f32; 3],
    /// Factors of the far ends: reciprocal direction, made larger by 2⁻²⁰ of it.
    pub(crate) far_inverse: [f32; 3],
    /// Whether the ray runs toward lesser coordinates, so that the greater plane is the near one.
    pub(crate) backward: [bool; 3],
    /// The ray's own, at least zero.
    pub(crate) t_min: f32,
    /// The ray's own, finite.
    pub(crate) t_max: f32,
}

impl SlabRay {
    /// Prepares a ray; `None` for one that can meet nothing: a number missing in origin or direction, a direction of
    /// length zero (no component above 2⁻¹²⁷), or `t_min <= t_max` false. A negative `t_min` counts as zero.
    #[inline]
    pub fn new(ray: &Ray) -> Option<Self> {
        let t_min = if ray.t_min < 0.0 { 0.0 } else { ray.t_min };
        let t_max = if ray.t_max > f32::MAX { f32::MAX } else { ray.t_max };
        let reaches = ray.direction.abs().max_element().recip().is_finite();
        let starts = ray.origin.is_finite() && ray.direction.is_finite();
        if !starts || !reaches || t_min.is_nan() || t_max.is_nan() || t_min > t_max {
            return None;
        }
        let inverse = ray.direction.to_array().map(f32::recip);
        Some(Self {
            origin: ray.origin.to_array(),
            near_inverse: inverse.map(|inverse| inverse * (1.0 - MARGIN)),
            far_inverse: inverse.map(|inverse| inverse * (1.0 + MARGIN)),
            backward: ray.direction.to_array().map(f32::is_sign_negative),
            t_min,
            t_max,
        })
    }

    /// The piece of the ray inside the box, within the ray's own `t_min` and `t_max`.
    #[inline(always)]
    pub fn interval(&self, bounds: &Aabb) -> Option<Interval> {
        let mut near = self.t_min;
        let mut far = self.t_max;
        for axis in 0..3 {
            let (low, high) = (bounds.min[axis], bounds.max[axis]);
            let (first, last) = if self.backward[axis] { (high, low) } else { (low, high) };
            near = larger(near, (first - self.origin[axis]) * self.near_inverse[axis]);
            far = smaller(far, (last - self.origin[axis]) * self.far_inverse[axis]);
        }
        (near <= far).then_some(Interval { near, far })
    }

    /// Rule 2 of the theorem: moves the `t` of a hit into the interval of its own box; `None` if there is no interval.
    #[inline(always)]
    pub fn clamp(&self, bounds: &Aabb, t: f32) -> Option<f32> {
        Some(self.interval(bounds)?.clamp(t))
    }
}

/// The larger of both; `so_far` if the other is not a number. One instruction on most machines.
#[inline(always)]
pub(crate) fn larger(so_far: f32, value: f32) -> f32 {
    if value > so_far { value } else { so_far }
}

/// The smaller of both; `so_far` if the other is not a number.
#[inline(always)]
pub(crate) fn smaller(so_far: f32, value: f32) -> f32 {
    if value < so_far { value } else { so_far }
}
