//! Triangles: three corners and what can be asked of them.
//!
//! [`watertight`](ShearedRay::hit) is the test the trees use; [`cramer`] is the textbook one, kept to compare with.

mod cramer;
mod nearest_point;
mod watertight;

pub use cramer::{CramerSolution, cramer, solve};
pub use nearest_point::{TrianglePoint, nearest_point};
pub use watertight::ShearedRay;

use crate::Aabb;
use crate::aabb::PADDING;
use glam::Vec3;

/// Three corners, counter-clockwise seen from outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// First corner.
    pub a: Vec3,
    /// Second corner.
    pub b: Vec3,
    /// Third corner.
    pub c: Vec3,
}

impl Triangle {
    /// Takes three corners out of a list; `None` if an index is too large.
    pub fn of_mesh(positions: &[Vec3], corners: [u32; 3]) -> Option<Self> {
        let at = |index: u32| positions.get(index as usize).copied();
        Some(Self { a: at(corners[0])?, b: at(corners[1])?, c: at(corners[2])? })
    }

    /// Whether all coordinates are finite.
    pub fn is_finite(&self) -> bool {
        self.a.is_finite() && self.b.is_finite() && self.c.is_finite()
    }

    /// The box of the corners, each side moved outward by 2⁻²⁰ of the largest extent and then to the next number.
    ///
    /// The watertight test places a corner with an error of some 5·2⁻²⁴ of its distance from the ray's origin, which is at
    /// most the distance of the hit plus the extent of the triangle. The margin of [`SlabRay`](crate::SlabRay) covers the
    /// first part, this margin the second: a hit on the very rim of a large triangle is not lost to its box.
    pub fn bounds(&self) -> Aabb {
        let bounds = Aabb::of_points([self.a, self.b, self.c]);
        bounds.padded((bounds.max - bounds.min).max_element() * PADDING)
    }

    /// The point with the given weights: `(1-u-v)·A + u·B + v·C`.
    pub fn at(&self, u: f32, v: f32) -> Vec3 {
        self.a * (1.0 - u - v) + self.b * u + self.c * v
    }
}
