//! A mesh as a field: its signed distance.

use glam::{DVec3, Vec3};

use super::field::{Field, Interval, Points, Region};
use crate::TriangleMesh;
use crate::query::Surface;

/// Nearer than this part of a coordinate the direction to the nearest point is rounding, and the triangle's normal is taken.
const NEAR: f64 = 1e-5;

/// The signed distance of a mesh, negative inside; see [`Surface::signed_distance`] for how inside is told.
///
/// Points are rounded to single precision. Infinite if there are no triangles.
pub struct MeshDistance<'a> {
    mesh: &'a TriangleMesh,
    surface: Surface<'a>,
    /// Whether the distance is continuous. About a mesh with holes the sign changes in them, away from the mesh.
    is_continuous: bool,
}

impl<'a> MeshDistance<'a> {
    /// Builds the trees.
    pub fn new(mesh: &'a TriangleMesh) -> Self {
        let is_continuous = crate::measure::closedness(&crate::weld::weld_exact(mesh).mesh).is_closed();
        Self { mesh, surface: Surface::new(mesh), is_continuous }
    }

    /// The distance of one point.
    pub fn at(&self, point: DVec3) -> f64 {
        self.surface.signed_distance(point.as_vec3()).unwrap_or(f64::INFINITY)
    }

    fn gradient(&self, point: DVec3) -> DVec3 {
        let point: Vec3 = point.as_vec3();
        let Some(nearest) = self.surface.nearest(point) else { return DVec3::NAN };
        if nearest.distance > NEAR * f64::from(point.abs().max_element()) {
            let away = point.as_dvec3() - nearest.point;
            let sign = self.surface.signed_distance(point).map_or(1.0, f64::signum);
            return away.normalize_or_zero() * sign;
        }
        let [a, b, c] = self.mesh.corners(nearest.triangle as usize).map(|corner| corner.as_dvec3());
        (b - a).cross(c - a).normalize_or_zero()
    }
}

impl Field for MeshDistance<'_> {
    fn values(&self, points: Points<'_>, values: &mut [f64]) {
        for (value, point) in values.iter_mut().zip(points.iter()) {
            *value = self.at(point);
        }
    }

    fn gradients(&self, points: Points<'_>, gradients: &mut [DVec3]) {
        for (gradient, point) in gradients.iter_mut().zip(points.iter()) {
            *gradient = self.gradient(point);
        }
    }

    /// A distance changes by no more than the way that is gone.
    fn range(&self, region: &Region) -> Interval {
        let middle = (region.min + region.max) / 2.0;
        let reach = region.size().length() / 2.0;
        let rounding = 1e-6 * (middle.abs().max_element() + reach);
        let distance = self.at(middle);
        if distance.is_nan() || !self.is_continuous {
            return Interval::EVERYTHING;
        }
        Interval { low: distance - reach - rounding, high: distance + reach + rounding }
    }
}
