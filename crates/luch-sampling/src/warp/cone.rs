//! A cone about +Z, uniform by solid angle; how a sphere is seen from outside.

use std::f32::consts::{PI, TAU};

use glam::Vec3;

use super::planar::disc;

/// The directions within some angle of +Z.
///
/// It remembers 1 − cos of that angle, not the cosine, so cones as narrow as a distant star keep full precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    one_minus_cos: f32,
}

impl Cone {
    /// The cone of a half-angle in radians, in (0, π]; `None` for anything else.
    pub fn from_half_angle(half_angle: f32) -> Option<Self> {
        if !(half_angle > 0.0 && half_angle <= PI) {
            return None;
        }
        let sin_half = libm::sinf(0.5 * half_angle);
        Self::of(2.0 * sin_half * sin_half)
    }

    /// The cone whose half-angle, at most π/2, has this squared sine, in (0, 1]; `None` for anything else.
    ///
    /// A sphere of radius r at distance d > r fills the cone of squared sine r²/d².
    pub fn from_sin_squared(sin_squared: f32) -> Option<Self> {
        if !(sin_squared > 0.0 && sin_squared <= 1.0) {
            return None;
        }
        // 1 − √(1 − s) without cancellation.
        Self::of(sin_squared / (1.0 + (1.0 - sin_squared).sqrt()))
    }

    /// A cone so narrow that its density overflows is none.
    fn of(one_minus_cos: f32) -> Option<Self> {
        let cone = Self { one_minus_cos };
        (one_minus_cos > 0.0 && (1.0 / cone.solid_angle()).is_finite()).then_some(cone)
    }

    /// Solid angle in steradians: 2π(1 − cos).
    #[inline]
    pub fn solid_angle(&self) -> f32 {
        TAU * self.one_minus_cos
    }

    /// A direction of the cone, uniform by solid angle.
    #[inline]
    pub fn sample(&self, u: [f32; 2]) -> Vec3 {
        // A disc of radius r becomes a cap of height h = r²(1 − cos); its rim has the sine √(h(2 − h)).
        let point = disc(u);
        let height = (point.length_squared() * self.one_minus_cos).min(self.one_minus_cos);
        let scale = (self.one_minus_cos * (2.0 - height)).sqrt();
        Vec3::new(point.x * scale, point.y * scale, 1.0 - height)
    }

    /// Density per solid angle: one over the solid angle inside the cone, zero outside.
    #[inline]
    pub fn pdf(&self, direction: Vec3) -> f32 {
        // Near the pole 1 − z cancels; there the height follows from the sine: h(2 − h) = x² + y².
        let sin_squared = direction.x * direction.x + direction.y * direction.y;
        let height = if direction.z > 0.0 {
            sin_squared / (1.0 + (1.0 - sin_squared).max(0.0).sqrt())
        } else {
            1.0 - direction.z
        };
        if height <= self.one_minus_cos * (1.0 + 1e-6) { 1.0 / self.solid_angle() } else { 0.0 }
    }
}
