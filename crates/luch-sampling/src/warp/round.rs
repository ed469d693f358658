//! Directions of the whole sphere and of the hemisphere about +Z.

use super::planar::disc;
use crate::trig;
use glam::Vec3;
use std::f32::consts::FRAC_1_PI;

/// A direction of the hemisphere z ≥ 0, uniform by solid angle.
#[inline]
pub fn hemisphere(u: [f32; 2]) -> Vec3 {
    // A disc of radius r becomes a cap of height r², which has the same share of the area.
    let point = disc(u);
    let r2 = point.length_squared().min(1.0);
    let scale = (2.0 - r2).sqrt();
    Vec3::new(point.x * scale, point.y * scale, 1.0 - r2)
}

/// Density of [`hemisphere`] per solid angle: 1/2π above the horizon.
#[inline]
pub fn hemisphere_pdf(direction: Vec3) -> f32 {
    if direction.z >= 0.0 { 0.5 * FRAC_1_PI } else { 0.0 }
}

/// A direction of the hemisphere z > 0 with density cos θ/π: a point of the disc lifted to the sphere (Malley).
///
/// The height is never zero, so the density of a sample is positive.
#[inline(always)]
pub fn cosine_hemisphere(u: [f32; 2]) -> Vec3 {
    let point = disc(u);
    // At the rim rounding could reach the horizon, where the density is zero.
    Vec3::new(point.x, point.y, (1.0 - point.length_squared()).max(1e-9).sqrt())
}

/// Density of [`cosine_hemisphere`] per solid angle.
#[inline]
pub fn cosine_hemisphere_pdf(direction: Vec3) -> f32 {
    direction.z.max(0.0) * FRAC_1_PI
}

/// A direction of the whole sphere, uniform by solid angle.
#[inline]
pub fn sphere(u: [f32; 2]) -> Vec3 {
    let z = 1.0 - 2.0 * u[0];
    // 1 − z² without cancellation near the poles.
    let radius = 2.0 * (u[0] * (1.0 - u[0])).sqrt();
    let [sine, cosine] = trig::sin_cos_turns(u[1]);
    Vec3::new(radius * cosine, radius * sine, z)
}

/// Density of [`sphere`] per solid angle: 1/4π everywhere.
#[inline]
pub fn sphere_pdf() -> f32 {
    0.25 * FRAC_1_PI
}
