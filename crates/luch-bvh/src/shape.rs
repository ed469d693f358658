//! Shapes with an exact ray test of their own: sphere, frustum, disc, parallelogram, plane.
//!
//! All reckon in double precision from single precision numbers, so the only rounding that shows is that of the result.
//! Like every leaf test they are pure functions of ray and shape and accept `t` inside the ray's own interval only.

mod flat;
mod frustum;
mod sphere;

pub use flat::{Disc, Parallelogram, Plane};
pub use frustum::{Frustum, FrustumPart};
pub use sphere::Sphere;

use crate::{Ray, SlabRay};
use glam::Vec3;

/// Origin and direction in double precision.
struct WideRay {
    origin: [f64; 3],
    direction: [f64; 3],
    t_min: f64,
    t_max: f64,
}

impl WideRay {
    /// `None` for a ray that can meet nothing, as [`SlabRay::new`] judges.
    fn new(ray: &Ray) -> Option<Self> {
        let slab = SlabRay::new(ray)?;
        let (t_min, t_max) = (f64::from(slab.t_min), f64::from(slab.t_max));
        Some(Self { origin: wide(ray.origin), direction: wide(ray.direction), t_min, t_max })
    }

    fn at(&self, t: f64) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.origin[axis] + self.direction[axis] * t)
    }

    /// Rounds `t` if it lies on the ray.
    fn on_ray(&self, t: f64) -> Option<f32> {
        // Adding zero makes a negative zero positive.
        (self.t_min <= t && t <= self.t_max).then_some(t as f32 + 0.0)
    }
}

fn wide(vector: Vec3) -> [f64; 3] {
    vector.to_array().map(f64::from)
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
