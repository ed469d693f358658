//! The lecture's glossy reflection: a mirror whose normal is tilted at random.
//!
//! The tilted normal is m = normalize(n + dx·t + dy·b) with (dx, dy) uniform in the disc of radius
//! R = tan((1 − glossiness) π/2), and the light is `color` times what the mirror m shows. So every drawn direction above the surface
//! weighs exactly `color`, and a direction below the surface weighs nothing.
//!
//! The density follows by two Jacobians. A slope p = (dx, dy) has density 1 / (π R²); d²p = dω_m / cos³θ_m; and reflection
//! gives dω_m = dω_i / (4 |o·m|). Hence pdf(i) = 1 / (4 π R² cos³θ_m |o·m|) where tan θ_m ≤ R, else 0. For o and i above the surface m
//! is the half vector of both: a normal turned away from o (o·m < 0) sends i below the surface.
//!
//! The model is not reciprocal: value / cos i is not symmetric, because no masking balances the cosine. Both sides are alike.

use super::{BsdfSample, BsdfValue, flip, mirror, same_side};
use glam::Vec3;
use luch_image::Rgb;
use luch_sampling::warp::disc;
use std::f32::consts::{FRAC_PI_2, PI};

/// Below this radius single precision cannot resolve the disc: the mirror takes over.
const SMALLEST_RADIUS: f32 = 1e-3;
/// Smallest glossiness, a disc of radius about 6400.
const LEAST_GLOSSINESS: f32 = 1e-4;

/// A mirror with a uniformly tilted normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glossy {
    color: Rgb,
    radius: f32,
}

impl Glossy {
    /// `glossiness` 1 is a mirror; smaller is more blurred; kept in 10⁻⁴ to 1. `color` is the fraction reflected.
    pub fn new(color: Rgb, glossiness: f32) -> Self {
        let glossiness = glossiness.clamp(LEAST_GLOSSINESS, 1.0);
        let radius = libm::tanf((1.0 - glossiness) * FRAC_PI_2);
        Self { color, radius: if radius < SMALLEST_RADIUS { 0.0 } else { radius } }
    }

    /// Fraction of light that is reflected.
    pub fn color(&self) -> Rgb {
        self.color
    }

    /// Radius of the disc of slopes (dx, dy); 0 for the mirror.
    pub fn radius(&self) -> f32 {
        self.radius
    }

    pub(super) fn is_mirror(&self) -> bool {
        self.radius == 0.0
    }

    pub(super) fn evaluate(&self, outgoing: Vec3, incoming: Vec3) -> BsdfValue {
        if self.is_mirror() || !same_side(outgoing, incoming) {
            return BsdfValue::NONE;
        }
        let tilted = (outgoing + incoming).normalize_or_zero();
        let cosine = tilted.z.abs();
        let slope_squared = (tilted.x * tilted.x + tilted.y * tilted.y) / (cosine * cosine);
        if slope_squared > self.radius * self.radius || cosine == 0.0 {
            return BsdfValue::NONE;
        }
        let pdf = self.density(cosine, outgoing.dot(tilted).abs());
        BsdfValue { value: self.color * pdf, pdf }
    }

    pub(super) fn sample(&self, outgoing: Vec3, u: [f32; 2]) -> Option<BsdfSample> {
        if self.is_mirror() {
            return BsdfSample::checked(mirror(outgoing), self.color, 1.0, true);
        }
        let upper = if outgoing.z < 0.0 { flip(outgoing) } else { outgoing };
        let slope = disc(u) * self.radius;
        let tilted = slope.extend(1.0).normalize();
        let incoming = (2.0 * upper.dot(tilted) * tilted - upper).normalize_or_zero();
        if incoming.z <= 0.0 {
            return None;
        }
        // The density comes from the drawn normal: rounding at the rim of the disc must not lose the sample.
        let pdf = self.density(tilted.z, upper.dot(tilted).abs());
        let incoming = if outgoing.z < 0.0 { flip(incoming) } else { incoming };
        BsdfSample::checked(incoming, self.color * pdf, pdf, false)
    }

    /// Density of the reflected direction for a normal at `normal_cosine` from +Z, `outgoing_cosine` from the viewer.
    fn density(&self, normal_cosine: f32, outgoing_cosine: f32) -> f32 {
        let slope_density = 1.0 / (PI * self.radius * self.radius);
        slope_density / (4.0 * normal_cosine * normal_cosine * normal_cosine * outgoing_cosine)
    }
}

#[cfg(test)]
mod tests;
