//! The textbook test: the plane of the triangle and barycentric coordinates at once, by Cramer's rule.
//!
//! With `P = A + λ2 (B-A) + λ3 (C-A)` and `P = O + γ D` the unknowns solve
//!
//! ```text
//! λ2 (B-A) + λ3 (C-A) - γ D = O - A
//! ```
//!
//! three equations in three unknowns. Its determinants are mixed products `(a × b) · c` of the columns. `γ` is the distance
//! only when `D` has unit length; otherwise it counts lengths of `D`, as `t` does everywhere here.

use super::Triangle;
use crate::slab::smaller;
use crate::{Crossing, Ray};
use glam::Vec3;

/// The solution of the system, wherever it lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CramerSolution {
    /// The determinant of the system: positive when the ray comes against the normal, zero when it runs along the plane.
    pub determinant: f32,
    /// Weight of B.
    pub lambda2: f32,
    /// Weight of C.
    pub lambda3: f32,
    /// Parameter along the ray.
    pub gamma: f32,
}

/// Solves the system; `None` when its determinant is zero or no number.
pub fn solve(ray: &Ray, triangle: &Triangle) -> Option<CramerSolution> {
    let mixed = |a: Vec3, b: Vec3, c: Vec3| a.cross(b).dot(c);
    let a = triangle.b - triangle.a;
    let b = triangle.c - triangle.a;
    let c = -ray.direction;
    let h = ray.origin - triangle.a;
    let determinant = mixed(a, b, c);
    (determinant != 0.0 && determinant.is_finite()).then(|| CramerSolution {
        determinant,
        lambda2: mixed(h, b, c) / determinant,
        lambda3: mixed(a, h, c) / determinant,
        gamma: mixed(a, b, h) / determinant,
    })
}

/// Where the ray meets the triangle, from either side. Rays through a shared edge may slip between two triangles: this is
/// the test to learn from and to compare with, not the one to render with.
pub fn cramer(ray: &Ray, triangle: &Triangle) -> Option<Crossing> {
    let CramerSolution { determinant, lambda2, lambda3, gamma } = solve(ray, triangle)?;
    let inside = lambda2 >= 0.0 && lambda3 >= 0.0 && lambda2 + lambda3 <= 1.0;
    let on_ray = ray.t_min.max(0.0) <= gamma && gamma <= ray.t_max.min(f32::MAX);
    (inside && on_ray).then_some(Crossing {
        t: gamma + 0.0,
        u: lambda2 + 0.0,
        v: smaller(1.0 - lambda2, lambda3 + 0.0),
        front: determinant > 0.0,
    })
}
