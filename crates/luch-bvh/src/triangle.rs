//! Triangles: three corners and what can be asked of them.
//!
//! [`watertight`](ShearedRay::hit) is the test the trees use; [`cramer`] is the textbook one, kept to compare with.

mod clip;
mod cramer;
mod nearest_point;
mod watertight;

pub(crate) use clip::TriangleClip;
pub use cramer::{CramerSolution, cramer, solve};
pub use nearest_point::{TrianglePoint, nearest_point};
pub use watertight::ShearedRay;
pub(crate) use watertight::{RESIDUAL, SAFE, exact_crossing};

use crate::Aabb;
use crate::aabb::PADDING;
use crate::slab::larger;
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

    /// The box of the corners, each side moved outward by 2⁻¹⁸ of the largest extent and 2⁻²² of its own coordinate.
    ///
    /// That covers the error of a hit as far as the margin of [`SlabRay`](crate::SlabRay) does not: the proof is in
    /// [`slab`](crate::slab). The corners lie inside whatever is rounded, since a rounded difference with something that is
    /// not negative is never greater.
    pub fn bounds(&self) -> Aabb {
        let bounds = Aabb::of_points([self.a, self.b, self.c]);
        let [x, y, z] = (bounds.max - bounds.min).to_array();
        Self::padded(&bounds, larger(larger(x, y), z) * PADDING)
    }

    fn padded(bounds: &Aabb, margin: f32) -> Aabb {
        let beyond = |side: f32| margin + side.abs() * Self::ROUNDING;
        let min = bounds.min.to_array().map(|low| low - beyond(low));
        let max = bounds.max.to_array().map(|high| high + beyond(high));
        Aabb { min: Vec3::from_array(min), max: Vec3::from_array(max) }
    }

    /// Part of a coordinate that covers its rounding: 2⁻²².
    pub(crate) const ROUNDING: f32 = 1.0 / 4_194_304.0;

    /// The point with the given weights: `(1-u-v)·A + u·B + v·C`.
    pub fn at(&self, u: f32, v: f32) -> Vec3 {
        self.a * (1.0 - u - v) + self.b * u + self.c * v
    }
}
