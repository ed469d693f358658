//! A ray and the interval of it that counts.

use glam::Vec3;

/// A half-open piece of a straight line: the points `origin + t · direction` with `t_min ≤ t ≤ t_max`.
///
/// The direction need not have unit length; `t` is measured in lengths of it, so an affine map of origin and direction
/// leaves every `t` as it was.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where the ray starts.
    pub origin: Vec3,
    /// Where it goes; any non-zero length.
    pub direction: Vec3,
    /// Nearest parameter that counts, at least zero.
    pub t_min: f32,
    /// Farthest parameter that counts; may be infinite.
    pub t_max: f32,
}

impl Ray {
    /// The whole half-line from `origin` along `direction`.
    #[inline]
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        Self { origin, direction, t_min: 0.0, t_max: f32::INFINITY }
    }

    /// The segment from `from` to `to`, both ends included: `t` runs from 0 to 1.
    #[inline]
    pub fn segment(from: Vec3, to: Vec3) -> Self {
        Self { origin: from, direction: to - from, t_min: 0.0, t_max: 1.0 }
    }

    /// The point at parameter `t`.
    #[inline]
    pub fn at(&self, t: f32) -> Vec3 {
        self.origin + self.direction * t
    }
}
