//! An instance made ready for rays.

use super::{Geometry, Instance};
use crate::{Aabb, Ray};
use glam::{Affine3A, Vec3};

/// An instance with the inverse of its placement and its box in the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placed {
    /// Rows of the linear part of the map from the world into the geometry's space.
    linear: [Vec3; 3],
    translation: Vec3,
    /// Whether the placement changes nothing, so that rays need not be taken anywhere.
    is_identity: bool,
    pub(crate) geometry: u32,
    pub(crate) cull_back: bool,
    pub(crate) filtered: bool,
    /// `None` if it has no end.
    pub(crate) bounds: Option<Aabb>,
}

impl Placed {
    /// `None` if the placement cannot be inverted.
    pub(super) fn new(instance: &Instance, geometry: &Geometry) -> Option<Self> {
        let Instance { geometry: index, placement, cull_back, filtered } = *instance;
        let (linear, translation) = inverse(&placement)?;
        let bounds = geometry.bounds().map(|bounds| bounds.transformed(&placement));
        let is_identity = placement == Affine3A::IDENTITY;
        Some(Self { linear, translation, is_identity, geometry: index, cull_back, filtered, bounds })
    }

    /// Whether the placement changes nothing.
    pub(crate) fn is_identity(&self) -> bool {
        self.is_identity
    }

    /// The same ray in the space of the geometry; `t` keeps its meaning.
    #[inline(always)]
    pub(crate) fn toward_object(&self, ray: &Ray) -> Ray {
        if self.is_identity {
            return *ray;
        }
        let rows = |vector: Vec3| Vec3::from_array(self.linear.map(|row| row.dot(vector)));
        Ray { origin: rows(ray.origin) + self.translation, direction: rows(ray.direction), ..*ray }
    }
}

/// Rows and translation of the inverse, by cofactors in double precision and rounded once.
fn inverse(map: &Affine3A) -> Option<([Vec3; 3], Vec3)> {
    let entry = |row: usize, column: usize| f64::from(map.matrix3.col(column % 3)[row % 3]);
    let cofactor = |row: usize, column: usize| {
        entry(row + 1, column + 1) * entry(row + 2, column + 2)
            - entry(row + 1, column + 2) * entry(row + 2, column + 1)
    };
    let determinant: f64 = (0..3).map(|column| entry(0, column) * cofactor(0, column)).sum();
    let wide = [0, 1, 2].map(|row| [0, 1, 2].map(|column| cofactor(column, row) / determinant));
    let moved =
        wide.map(|row| -(0..3).map(|column| row[column] * f64::from(map.translation[column])).sum::<f64>());
    let linear = wide.map(|row| Vec3::from_array(row.map(|value| value as f32)));
    let translation = Vec3::from_array(moved.map(|value| value as f32));
    let sound = determinant != 0.0 && translation.is_finite() && linear.iter().all(|row| row.is_finite());
    sound.then_some((linear, translation))
}
