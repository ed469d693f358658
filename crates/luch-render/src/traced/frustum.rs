//! Cylinders and cones. Texture coordinates are those of the mesh generator: u runs around from +x over −z, v upward; each disc
//! carries the inscribed circle of the square.

use glam::{Vec2, Vec3};
use luch_bvh::shape::{self, FrustumPart};
use luch_scene::Frustum;
use std::f32::consts::TAU;

pub(super) fn test(frustum: &Frustum) -> shape::Frustum {
    let Frustum { bottom_radius, top_radius, height, capped } = *frustum;
    shape::Frustum { bottom_radius, top_radius, height, capped }
}

/// The radius grows by so much for each metre upward.
fn slope(frustum: &Frustum) -> f32 {
    (frustum.top_radius - frustum.bottom_radius) / frustum.height
}

fn radius_at(frustum: &Frustum, y: f32) -> f32 {
    0.5 * (frustum.bottom_radius + frustum.top_radius) + slope(frustum) * y
}

pub(super) fn point(frustum: &Frustum, near: Vec3, part: f32) -> Vec3 {
    let half = 0.5 * frustum.height;
    match FrustumPart::of(part) {
        FrustumPart::Top => Vec3::new(near.x, half, near.z),
        FrustumPart::Bottom => Vec3::new(near.x, -half, near.z),
        FrustumPart::Side => {
            let y = near.y.clamp(-half, half);
            let radius = radius_at(frustum, y);
            let off = (near.x * near.x + near.z * near.z).sqrt();
            let scale = if off > 0.0 { radius / off } else { 0.0 };
            Vec3::new(near.x * scale, y, near.z * scale)
        }
    }
}

pub(super) fn normal(frustum: &Frustum, point: Vec3, part: f32) -> Vec3 {
    match FrustumPart::of(part) {
        FrustumPart::Top => Vec3::Y,
        FrustumPart::Bottom => Vec3::NEG_Y,
        FrustumPart::Side => {
            let outward = Vec3::new(point.x, 0.0, point.z).try_normalize();
            // At the point of a cone every direction around is as good as another.
            outward.map_or(Vec3::Y * -slope(frustum).signum(), |outward| outward - Vec3::Y * slope(frustum))
        }
    }
}

pub(super) fn uv(frustum: &Frustum, point: Vec3, part: f32) -> Vec2 {
    let disc = |radius: f32, up: f32| Vec2::new(point.x, up * point.z) / (2.0 * radius) + Vec2::splat(0.5);
    match FrustumPart::of(part) {
        FrustumPart::Top => disc(frustum.top_radius, -1.0),
        FrustumPart::Bottom => disc(frustum.bottom_radius, 1.0),
        FrustumPart::Side => {
            let turn = libm::atan2f(-point.z, point.x) / TAU;
            Vec2::new(if turn < 0.0 { turn + 1.0 } else { turn }, point.y / frustum.height + 0.5)
        }
    }
}

pub(super) fn uv_step(frustum: &Frustum, point: Vec3, part: f32, step: Vec3) -> Vec2 {
    match FrustumPart::of(part) {
        FrustumPart::Top => Vec2::new(step.x, -step.z) / (2.0 * frustum.top_radius),
        FrustumPart::Bottom => Vec2::new(step.x, step.z) / (2.0 * frustum.bottom_radius),
        FrustumPart::Side => {
            let ring = point.x * point.x + point.z * point.z;
            let turned = (point.z * step.x - point.x * step.z) / (TAU * ring);
            Vec2::new(turned, step.y / frustum.height)
        }
    }
}

pub(super) fn tangent(point: Vec3, part: f32) -> Vec3 {
    match FrustumPart::of(part) {
        FrustumPart::Side => Vec3::new(point.z, 0.0, -point.x),
        _ => Vec3::X,
    }
}
