//! Flat targets: the unit disc and the triangle.

use crate::trig;
use glam::{Vec2, Vec3};
use std::f32::consts::FRAC_1_PI;

/// A point of the unit disc, uniform by area: the concentric map of Shirley and Chiu (1997), in Cline's form.
#[inline(always)]
pub fn disc(u: [f32; 2]) -> Vec2 {
    Vec2::from_array(trig::concentric(2.0 * u[0] - 1.0, 2.0 * u[1] - 1.0))
}

/// Density of [`disc`] per area: 1/π inside.
#[inline]
pub fn disc_pdf_area(point: Vec2) -> f32 {
    if point.length_squared() <= 1.0 + 4.0 * f32::EPSILON { FRAC_1_PI } else { 0.0 }
}

/// Barycentric weights of a point of a triangle, uniform by area; they are not negative and add to one.
///
/// Heitz, "A low-distortion map between triangle and square" (2019): no square root, and neighbours stay neighbours.
#[inline]
pub fn triangle(u: [f32; 2]) -> Vec3 {
    let (mut a, mut b) = (u[0], u[1]);
    if b > a {
        a *= 0.5;
        b -= a;
    } else {
        b *= 0.5;
        a -= b;
    }
    Vec3::new(a, b, (1.0 - a - b).max(0.0))
}

/// Density of [`triangle`] per area: one over the area; zero for a triangle without area.
#[inline]
pub fn triangle_pdf_area(area: f32) -> f32 {
    if area > 0.0 { 1.0 / area } else { 0.0 }
}
