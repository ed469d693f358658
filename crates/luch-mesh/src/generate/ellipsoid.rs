//! Ellipsoids, and those between ellipsoid, box, cylinder and octahedron.

use glam::{DVec3, Vec3};

use super::MAX_DIVISIONS;
use super::circle::on_sphere;
use super::grid::{Grid, Sample};
use crate::PolygonMesh;

/// See [`super::Generator::Ellipsoid`].
pub(super) fn ellipsoid(radii: Vec3, segments: u32, rings: u32) -> PolygonMesh {
    let (segments, rings) = (segments.clamp(3, MAX_DIVISIONS), rings.clamp(2, MAX_DIVISIONS));
    let radii = radii.as_dvec3();
    Grid::ball(segments, rings).mesh(|column, row| {
        let direction = on_sphere(column, segments, row, rings);
        // Normals go by the inverse transpose.
        Sample { position: direction * radii, normal: (direction / radii).normalize_or(direction) }
    })
}

/// See [`super::Generator::Superellipsoid`].
///
/// (|x|^(2/e) + |z|^(2/e))^(e/n) + |y|^(2/n) = 1 for radii of 1 (Barr 1981, "Superquadrics and angle-preserving
/// transformations"); e and n are `around` and `upright`. The points lie in the directions of a sphere's: Barr's own
/// parameters crowd them at the edges.
pub(super) fn superellipsoid(
    radii: Vec3,
    around: f32,
    upright: f32,
    segments: u32,
    rings: u32,
) -> PolygonMesh {
    let (segments, rings) = (segments.clamp(3, MAX_DIVISIONS), rings.clamp(2, MAX_DIVISIONS));
    let radii = radii.as_dvec3();
    let [around, upright] = exponents(around, upright);
    Grid::ball(segments, rings).mesh(|column, row| {
        let direction = on_sphere(column, segments, row, rings);
        let size = direction.abs();
        let flat = libm::pow(size.x, 2.0 / around) + libm::pow(size.z, 2.0 / around);
        let whole = libm::pow(flat, around / upright) + libm::pow(size.y, 2.0 / upright);
        let position = direction * libm::pow(whole, -upright / 2.0) * radii;
        // Half the gradient, times n. Its direction is the same at every distance.
        let outer = libm::pow(flat, around / upright - 1.0);
        let slope = |size: f64, exponent: f64| libm::pow(size, 2.0 / exponent - 1.0);
        let gradient =
            DVec3::new(outer * slope(size.x, around), slope(size.y, upright), outer * slope(size.z, around));
        let on_axis = flat == 0.0;
        let gradient = if on_axis { DVec3::Y } else { gradient / radii };
        let signs = DVec3::new(sign(direction.x), sign(direction.y), sign(direction.z));
        Sample { position, normal: (gradient * signs).normalize_or(direction) }
    })
}

/// The exponents in force.
pub(super) fn exponents(around: f32, upright: f32) -> [f64; 2] {
    [around, upright].map(|exponent| f64::from(exponent).clamp(0.1, 2.0))
}

fn sign(number: f64) -> f64 {
    if number == 0.0 { 0.0 } else { number.signum() }
}
