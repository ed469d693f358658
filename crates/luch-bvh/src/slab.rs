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
//! with `near_inverse = 1/direction · (1 - 2⁻¹⁹)` and `far_inverse = 1/direction · (1 + 2⁻¹⁹)`: some 32 units in the last
//! place too wide on either side, which covers the rounding of the formula itself many times over (Ize, "Robust BVH Ray
//! Traversal", JCGT 2013) and the error of a hit in proportion to its distance. The interval is empty unless `near <= far`. Where the direction has a zero and the origin lies
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
//! # Spatial splits
//!
//! The best trees over triangles hold some of them in parts ([`Quality::Best`](crate::Quality)): the parts of a triangle
//! cover it, and a leaf knows only the box of its part. The box of a node then no longer contains the box of the whole
//! triangle, and the proof needs more: that *each hit of a triangle lies within the interval of one of its parts' boxes*.
//! Given that, `near(C) <= t <= far(C)` for such a part's box C and its ancestors, one leaf with the triangle is not passed
//! over, and its test gives the same hit as ever. Unlike the rest this rests on the size of rounding errors, so here are all
//! of them. Let u = 2⁻²⁴, *ext* the greatest extent of the triangle, z the axis the ray follows most, S = D.x/D.z.
//!
//! 1. The test computes weights a, b, c of equal sign, brought to a sum of 1 within 4u. Let Q be the point of the triangle
//!    that has exactly these weights (divided by their exact sum). It lies in some part; the box of each part that has it
//!    contains all that is within 64u·ext of Q along each axis, since boxes of parts, and of whole triangles, are padded by
//!    2⁻¹⁸ of the extent of the whole triangle, and by 4u of each coordinate for their own rounding.
//! 2. Along z: the corners' distances are rounded once, the weighted sum and the sum of weights cost 8u, the two factors of
//!    t 2u. So `|t·D.z - (Q.z - O.z)| <= 11u·(|Q.z - O.z| + ext)`; the ext stands for corners farther than Q.
//! 3. Across, say along x: a sheared corner (c.x - O.x) - S·(c.z - O.z) is wrong by at most u·|c.x - O.x| +
//!    3u·|S|·|c.z - O.z| + u·R, where R is the greatest sheared coordinate, R <= 2·ext but for terms of the distance times u.
//!    The weighted sum of the sheared corners would be zero without rounding. Edge functions lose all their digits when the
//!    ray runs along the plane of a triangle, so nothing is assumed about it: the test computes the sum, an error of
//!    3u·R, and where it exceeds 16u·R takes weights from double precision, which have 2⁻⁵⁰ of an error each. So the sum is
//!    at most 19.1u·R in either case, and with |S|·|Q.z - O.z| <= |Q.x - O.x| + (the errors) it follows that
//!    `|t·D.x - (Q.x - O.x)| <= 16u·|Q.x - O.x| + 57u·ext`.
//! 4. The ends of C's interval are wrong by 4u of themselves and made wider by 32u. The part of the error in proportion to
//!    |Q.x - O.x| is covered by that, the rest by the padding of 64u·ext (where the plane and Q lie on different sides of
//!    the origin, `t >= 0` leaves less error than padding). So `near(C) <= t <= far(C)`. The same holds for the box of the
//!    whole triangle: the clamping of rule 2 changes no hit of such a triangle.
//!
//! Numbers too small or too large for this to hold are kept out. Triangles of less than 2⁻²⁰ or more than 2¹⁰⁰ are never
//! split; with them and directions of at most 2¹⁰⁰ what is lost at the lower end of the range, some 2⁻¹⁵⁰ in t and in
//! products, is below u·ext. Components of a direction below 2⁻¹²⁶ count as zero, so reciprocals are exact to u or infinite;
//! in the latter case t·D.x is zero, and by 3. the origin lies between the planes. What overflows is no number and no
//! hit, in the loop as in the tree. Points nearest to a point lie in a part likewise, within its padding.
//!
//! What the clamping costs in truth is nothing one can see: boxes of primitives are padded beyond the rounding error of
//! the primitive tests, so a hit is moved by less than its own error.

use crate::{Aabb, Ray};

/// How much nearer the near end and how much farther the far end is taken: 2⁻¹⁹ of it.
pub(crate) const MARGIN: f32 = 1.0 / 524_288.0;

/// No component of a direction may be larger: 2¹⁰⁰.
pub(crate) const LONGEST: f32 = f32::from_bits((127 + 100) << 23);

/// The direction of a ray with components that have no reciprocal, those below 2⁻¹²⁶, taken for zero.
#[inline(always)]
pub(crate) fn direction(ray: &Ray) -> [f32; 3] {
    ray.direction.to_array().map(|side| if side.abs() < f32::MIN_POSITIVE { side * 0.0 } else { side })
}

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
    /// Factors of the near ends: reciprocal direction, made smaller by 2⁻¹⁹ of it.
    pub(crate) near_inverse: [f32; 3],
    /// Factors of the far ends: reciprocal direction, made larger by 2⁻¹⁹ of it.
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
    /// length zero or beyond sense (components below 2⁻¹²⁶ count as zero, one above 2¹⁰⁰ is too large), or
    /// `t_min <= t_max` false. A negative `t_min` counts as zero.
    #[inline]
    pub fn new(ray: &Ray) -> Option<Self> {
        let t_min = if ray.t_min < 0.0 { 0.0 } else { ray.t_min };
        let t_max = if ray.t_max > f32::MAX { f32::MAX } else { ray.t_max };
        let direction = direction(ray);
        let length = direction.into_iter().fold(0.0, |most, side| larger(most, side.abs()));
        let starts = ray.origin.is_finite() && ray.direction.is_finite();
        if !starts || length == 0.0 || length > LONGEST || t_min.is_nan() || t_max.is_nan() || t_min > t_max {
            return None;
        }
        let inverse = direction.map(f32::recip);
        Some(Self {
            origin: ray.origin.to_array(),
            near_inverse: inverse.map(|inverse| inverse * (1.0 - MARGIN)),
            far_inverse: inverse.map(|inverse| inverse * (1.0 + MARGIN)),
            backward: direction.map(f32::is_sign_negative),
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
