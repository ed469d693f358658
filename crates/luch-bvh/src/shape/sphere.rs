//! The sphere.

use super::{WideRay, dot, minus, wide};
use crate::aabb::PADDING;
use crate::{Aabb, Crossing, Ray};
use glam::Vec3;

/// All points at one distance from a centre; the outside is the front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// The middle.
    pub center: Vec3,
    /// The distance; spheres without a positive finite one are never hit.
    pub radius: f32,
}

impl Sphere {
    /// The box of the sphere, a trifle too large; empty if the sphere cannot be hit.
    pub fn bounds(&self) -> Aabb {
        if !self.is_sound() {
            return Aabb::empty();
        }
        let around = Aabb { min: self.center - self.radius, max: self.center + self.radius };
        around.padded(self.radius * PADDING)
    }

    /// Where the ray goes in and where it comes out, as far as these lie on the ray. `u` and `v` are 0.
    ///
    /// The quadratic in the stable form: the discriminant from the point of the line nearest to the centre, the root without
    /// cancellation first and the other by the product of both (Haines et al., *Ray Tracing Gems* (2019), chapter 7).
    pub fn crossings(&self, ray: &Ray) -> [Option<Crossing>; 2] {
        let Some(ray) = WideRay::new(ray).filter(|_| self.is_sound()) else { return [None; 2] };
        let center = wide(self.center);
        let radius = f64::from(self.radius);
        let to_center = minus(center, ray.origin);
        let a = dot(ray.direction, ray.direction);
        let middle = dot(to_center, ray.direction) / a;
        let off = minus(ray.at(middle), center);
        let squared = (radius * radius - dot(off, off)) / a;
        if squared.is_nan() || squared < 0.0 {
            return [None; 2];
        }
        let half = squared.sqrt();
        let larger = if middle < 0.0 { middle - half } else { middle + half };
        let product = (dot(to_center, to_center) - radius * radius) / a;
        let smaller = if larger == 0.0 { 0.0 } else { product / larger };
        let (enter, leave) = if smaller <= larger { (smaller, larger) } else { (larger, smaller) };
        let crossing = |t, front| ray.on_ray(t).map(|t| Crossing { t, u: 0.0, v: 0.0, front });
        [crossing(enter, true), crossing(leave, false)]
    }

    fn is_sound(&self) -> bool {
        self.center.is_finite() && self.radius > 0.0 && self.radius.is_finite()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    fn parameters(sphere: Sphere, ray: Ray) -> [Option<f32>; 2] {
        sphere.crossings(&ray).map(|crossing| crossing.map(|crossing| crossing.t))
    }

    #[test]
    fn in_and_out_at_any_scale() {
        for scale in [1e-18_f32, 1e-6, 1.0, 1e6, 1e18] {
            let sphere = Sphere { center: Vec3::X * scale, radius: scale };
            let ray = Ray::new(vec3(-3.0, 0.0, 0.0) * scale, Vec3::X * scale);
            assert_eq!(parameters(sphere, ray), [Some(3.0), Some(5.0)]);
        }
    }

    #[test]
    fn only_the_way_out_from_inside() {
        let sphere = Sphere { center: Vec3::ZERO, radius: 2.0 };
        assert_eq!(parameters(sphere, Ray::new(Vec3::ZERO, Vec3::Y)), [None, Some(2.0)]);
        let surface = Ray { t_min: 0.5, ..Ray::new(Vec3::Y * 2.0, -Vec3::Y) };
        assert_eq!(parameters(sphere, surface), [None, Some(4.0)]);
    }

    #[test]
    fn a_far_small_sphere_keeps_its_digits() {
        let sphere = Sphere { center: vec3(0.0, 0.0, 1e6), radius: 0.25 };
        assert_eq!(parameters(sphere, Ray::new(Vec3::ZERO, Vec3::Z)), [Some(999_999.75), Some(1_000_000.25)]);
    }

    #[test]
    fn touched_and_missed() {
        let sphere = Sphere { center: Vec3::ZERO, radius: 1.0 };
        let beside = |x: f32| parameters(sphere, Ray::new(vec3(x, 0.0, -5.0), Vec3::Z));
        assert_eq!(beside(1.0), [Some(5.0), Some(5.0)]);
        assert_eq!(beside(1.0_f32.next_up()), [None, None]);
        let unsound = Sphere { center: Vec3::ZERO, radius: f32::NAN };
        assert_eq!(parameters(unsound, Ray::new(Vec3::ZERO, Vec3::Z)), [None, None]);
        assert!(unsound.bounds().is_empty());
    }
}
