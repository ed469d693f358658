//! Pieces of a plane and the plane itself.

use super::{WideRay, cross, dot, minus, wide};
use crate::aabb::PADDING;
use crate::{Aabb, Crossing, Ray};
use glam::Vec3;

/// A round piece of a plane; the side the normal points to is the front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// The middle.
    pub center: Vec3,
    /// Across the disc; any non-zero length.
    pub normal: Vec3,
    /// Distance of the rim from the middle.
    pub radius: f32,
}

/// A piece of a plane between two edges: `corner + u · edge_u + v · edge_v` with `u` and `v` in 0..=1. A rectangle if the
/// edges are at right angles. The front is where `edge_u × edge_v` points to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parallelogram {
    /// The point with `u = v = 0`.
    pub corner: Vec3,
    /// From the corner to the point with `u = 1`.
    pub edge_u: Vec3,
    /// From the corner to the point with `v = 1`.
    pub edge_v: Vec3,
}

/// A plane without end; the side the normal points to is the front. It has no box, so no tree can hold it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Any point of it.
    pub point: Vec3,
    /// Across the plane; any non-zero length.
    pub normal: Vec3,
}

impl Disc {
    /// The box of the disc, a trifle too large; empty if the disc cannot be hit.
    pub fn bounds(&self) -> Aabb {
        let normal = wide(self.normal);
        let squared = dot(normal, normal);
        let sound = self.center.is_finite() && self.radius >= 0.0 && self.radius.is_finite();
        if !sound || squared == 0.0 || !squared.is_finite() {
            return Aabb::empty();
        }
        // The extent along an axis is the radius times the sine of the angle between axis and normal.
        let half = normal.map(|n| ((1.0 - n * n / squared).max(0.0).sqrt() * f64::from(self.radius)) as f32);
        let half = Vec3::from_array(half);
        Aabb { min: self.center - half, max: self.center + half }.padded(self.radius * PADDING)
    }

    /// Where the ray crosses the disc. `u` and `v` are 0.
    pub fn crossing(&self, ray: &Ray) -> Option<Crossing> {
        let ray = WideRay::new(ray)?;
        let crossing = cross_plane(&ray, self.center, wide(self.normal))?;
        let off = minus(ray.at(crossing.t), wide(self.center));
        let radius = f64::from(self.radius);
        (radius >= 0.0 && dot(off, off) <= radius * radius).then_some(())?;
        ray.on_ray(crossing.t).map(|t| Crossing { t, u: 0.0, v: 0.0, front: crossing.front })
    }
}

impl Parallelogram {
    /// The box of the four corners, a trifle too large; empty if a number is missing.
    pub fn bounds(&self) -> Aabb {
        let (far_u, far_v) = (self.corner + self.edge_u, self.corner + self.edge_v);
        let corners = [self.corner, far_u, far_v, far_u + self.edge_v];
        if !corners.iter().all(|corner| corner.is_finite()) {
            return Aabb::empty();
        }
        let bounds = Aabb::of_points(corners);
        bounds.padded((bounds.max - bounds.min).max_element() * PADDING)
    }

    /// Where the ray crosses the parallelogram, `u` and `v` counted along its edges.
    pub fn crossing(&self, ray: &Ray) -> Option<Crossing> {
        let ray = WideRay::new(ray)?;
        let (edge_u, edge_v) = (wide(self.edge_u), wide(self.edge_v));
        let normal = cross(edge_u, edge_v);
        let crossing = cross_plane(&ray, self.corner, normal)?;
        let from_corner = minus(ray.at(crossing.t), wide(self.corner));
        let area = dot(normal, normal);
        let u = dot(cross(from_corner, edge_v), normal) / area;
        let v = dot(cross(edge_u, from_corner), normal) / area;
        ((0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v)).then_some(())?;
        let t = ray.on_ray(crossing.t)?;
        Some(Crossing { t, u: u as f32 + 0.0, v: v as f32 + 0.0, front: crossing.front })
    }
}

impl Plane {
    /// Where the ray crosses the plane. `u` and `v` are 0.
    pub fn crossing(&self, ray: &Ray) -> Option<Crossing> {
        let ray = WideRay::new(ray)?;
        let crossing = cross_plane(&ray, self.point, wide(self.normal))?;
        ray.on_ray(crossing.t).map(|t| Crossing { t, u: 0.0, v: 0.0, front: crossing.front })
    }
}

struct PlaneCrossing {
    t: f64,
    front: bool,
}

/// `None` for a ray along the plane, also within it.
fn cross_plane(ray: &WideRay, point: Vec3, normal: [f64; 3]) -> Option<PlaneCrossing> {
    let along = dot(ray.direction, normal);
    let t = dot(minus(wide(point), ray.origin), normal) / along;
    (along != 0.0 && t.is_finite()).then_some(PlaneCrossing { t, front: along < 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    #[test]
    fn the_rim_of_a_disc_belongs_to_it() {
        let disc = Disc { center: vec3(0.0, 1.0, 0.0), normal: vec3(0.0, 3.0, 0.0), radius: 2.0 };
        let down = |x: f32| disc.crossing(&Ray::new(vec3(x, 5.0, 0.0), -Vec3::Y));
        assert_eq!(down(2.0), Some(Crossing { t: 4.0, u: 0.0, v: 0.0, front: true }));
        assert_eq!(down(2.001), None);
        let up = disc.crossing(&Ray::new(Vec3::ZERO, Vec3::Y)).unwrap();
        assert!(!up.front && up.t == 1.0);
        assert!(disc.bounds().contains(vec3(2.0, 1.0, -2.0)) && disc.bounds().max.y < 1.001);
    }

    #[test]
    fn a_parallelogram_counts_along_its_edges() {
        let shape =
            Parallelogram { corner: Vec3::ZERO, edge_u: vec3(4.0, 0.0, 0.0), edge_v: vec3(1.0, 2.0, 0.0) };
        let at = |x: f32, y: f32| shape.crossing(&Ray::new(vec3(x, y, 3.0), -Vec3::Z));
        assert_eq!(at(2.5, 1.0), Some(Crossing { t: 3.0, u: 0.5, v: 0.5, front: true }));
        assert_eq!(at(5.0, 2.0), Some(Crossing { t: 3.0, u: 1.0, v: 1.0, front: true }));
        assert_eq!(at(0.0, 1.0), None);
        assert!(shape.bounds().contains(vec3(5.0, 2.0, 0.0)));
    }

    #[test]
    fn planes_are_crossed_ahead_only_and_never_along() {
        let plane = Plane { point: vec3(7.0, 0.0, -2.0), normal: Vec3::Y };
        let from = |direction| plane.crossing(&Ray::new(Vec3::Y, direction)).map(|crossing| crossing.t);
        assert_eq!(from(vec3(1.0, -0.5, 0.0)), Some(2.0));
        assert_eq!(from(Vec3::Y), None);
        assert_eq!(from(Vec3::X), None);
        assert_eq!(from(Vec3::NAN), None);
        assert_eq!(
            Plane { point: Vec3::ZERO, normal: Vec3::ZERO }.crossing(&Ray::new(Vec3::Y, -Vec3::Y)),
            None
        );
    }
}
