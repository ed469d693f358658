//! A box with rounded edges and corners.

use glam::{DVec3, Vec2, Vec3};

use super::assembly::{Assembly, Corner};
use crate::PolygonMesh;

/// The most pieces of half a rounded edge.
pub const MAX_ROUNDING: u32 = 512;

/// See [`super::Generator::RoundedCuboid`].
///
/// Each of the six sides is a grid that bends with the surface, up to the middle of the edges; a corner is so made of
/// three squares, and everything of quads.
pub(super) fn rounded_cuboid(size: Vec3, radius: f32, segments: u32) -> PolygonMesh {
    let half = size.as_dvec3() / 2.0;
    let radius = f64::from(radius).min(half.min_element());
    let segments = segments.clamp(1, MAX_ROUNDING);
    // Tangents of the angles from the straight part to the middle of an edge.
    let tangents: Vec<f64> = (0..=segments)
        .map(|k| match k {
            _ if k == segments => 1.0,
            _ => libm::tan(f64::from(k) / f64::from(segments) * std::f64::consts::FRAC_PI_4),
        })
        .collect();
    // From the lower middle of an edge to the upper: the bend, the straight part, the bend.
    let lines = 2 * segments + 2;
    let line = |k: u32| {
        let (sign, place) = if k <= segments { (-1.0, segments - k) } else { (1.0, k - segments - 1) };
        Line { sign, tangent: sign * tangents[place as usize] }
    };
    let mut assembly = Assembly::default();
    for axis in 0..3 {
        for outward in [1.0, -1.0] {
            // Right × up = outward.
            let (right, up) = ((axis + 1) % 3, (axis + 2) % 3);
            let (right, up) = if outward > 0.0 { (right, up) } else { (up, right) };
            let corner = |column: u32, row: u32| {
                let (across, along) = (line(column), line(row));
                let (mut direction, mut signs) = (DVec3::ZERO, DVec3::ZERO);
                (direction[axis], signs[axis]) = (outward, outward);
                (direction[right], signs[right]) = (across.tangent, across.sign);
                (direction[up], signs[up]) = (along.tangent, along.sign);
                let normal = direction.normalize();
                let position = signs * (half - radius) + normal * radius;
                let part = |axis: usize| (0.5 + 0.5 * position[axis] / half[axis]) as f32;
                Corner { position, normal, uv: Vec2::new(part(right), part(up)) }
            };
            for row in 0..lines - 1 {
                for column in 0..lines - 1 {
                    let cell = [(column, row), (column + 1, row), (column + 1, row + 1), (column, row + 1)];
                    assembly.face(&cell.map(|(column, row)| corner(column, row)));
                }
            }
        }
    }
    assembly.finish()
}

/// A line of a side's grid.
#[derive(Clone, Copy)]
struct Line {
    /// On which side of the middle.
    sign: f64,
    /// The tangent of the angle by which the surface is bent there.
    tangent: f64,
}
