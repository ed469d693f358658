//! The Utah teapot from its Bezier patches.

use glam::{DVec3, Vec2};

use super::assembly::{Assembly, Corner};
use super::teapot_table::{Circle, FIRST_OF_LID, HANDLE, PROFILES, SPOUT, Section};
use crate::PolygonMesh;

/// The most pieces of a patch along each side.
pub const MAX_TEAPOT_DIVISIONS: u32 = 256;

/// The fewest: undivided, both halves of handle and spout would be flat and lie on one another.
pub(super) const LEAST_TEAPOT_DIVISIONS: u32 = 2;

/// See [`super::Generator::Teapot`].
pub(super) fn teapot(size: f32, divisions: u32) -> PolygonMesh {
    let divisions = divisions.clamp(LEAST_TEAPOT_DIVISIONS, MAX_TEAPOT_DIVISIONS);
    let mut assembly = Assembly::default();
    for (number, profile) in PROFILES.iter().enumerate() {
        if number == FIRST_OF_LID {
            assembly.begin_piece();
        }
        let patch = Patch { points: profile.each_ref().map(quarter) };
        for turns in 0..4 {
            assembly.patch(&patch, Image::Turned(turns), divisions, f64::from(size));
        }
    }
    for sections in [&HANDLE, &SPOUT] {
        // The lower end of the handle touches the body in a point.
        assembly.begin_piece();
        for rows in [[0, 1, 2, 3], [3, 4, 5, 6]] {
            // Rows run along, from the body away; upside down as the profiles are.
            let patch = Patch { points: rows.map(|row: usize| half(&sections[row])) };
            assembly.patch(&patch, Image::Mirrored, divisions, f64::from(size));
            assembly.patch(&patch, Image::Same, divisions, f64::from(size));
        }
    }
    assembly.finish()
}

/// A bicubic Bezier patch: four rows of four control points.
struct Patch {
    points: [[DVec3; 4]; 4],
}

/// What is done to a patch to get one of its likes. All of these move coordinates without rounding.
#[derive(Clone, Copy, PartialEq)]
enum Image {
    /// Nothing.
    Same,
    /// So many quarters of a turn about z.
    Turned(u32),
    /// y becomes −y.
    Mirrored,
}

impl Image {
    fn of(self, vector: DVec3) -> DVec3 {
        let DVec3 { x, y, z } = vector;
        match self {
            Self::Same | Self::Turned(0) => vector,
            Self::Turned(1) => DVec3::new(-y, x, z),
            Self::Turned(2) => DVec3::new(-x, -y, z),
            Self::Turned(_) => DVec3::new(y, -x, z),
            Self::Mirrored => DVec3::new(x, -y, z),
        }
    }
}

fn quarter(circle: &Circle) -> [DVec3; 4] {
    let Circle { radius, bulge, z } = *circle;
    [[radius, 0.0], [radius, bulge], [bulge, radius], [0.0, radius]].map(|[x, y]| DVec3::new(x, y, z))
}

fn half(section: &Section) -> [DVec3; 4] {
    let Section { first, last, width } = *section;
    [(first, 0.0), (first, -width), (last, -width), (last, 0.0)].map(|([x, z], y)| DVec3::new(x, y, z))
}

/// Bernstein polynomials of degree three. At the ends they are exactly 0 and 1, so patches that share a row of control
/// points share the points on it.
fn bernstein(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
}

/// Their derivatives.
fn slopes(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [-3.0 * s * s, 3.0 * s * (s - 2.0 * t), 3.0 * t * (2.0 * s - t), 3.0 * t * t]
}

fn mix(points: [DVec3; 4], weights: [f64; 4]) -> DVec3 {
    points[0] * weights[0] + points[1] * weights[1] + points[2] * weights[2] + points[3] * weights[3]
}

impl Patch {
    fn at(&self, along: [f64; 4], across: [f64; 4]) -> DVec3 {
        // Down each column first: on a shared row this picks the row exactly.
        let column = |k: usize| mix([0, 1, 2, 3].map(|row| self.points[row][k]), along);
        mix([0, 1, 2, 3].map(column), across)
    }

    /// The unit normal, across × along.
    fn normal(&self, along: f64, across: f64) -> DVec3 {
        let sideways = self.at(bernstein(along), slopes(across));
        let forward = self.at(slopes(along), bernstein(across));
        if let Some(normal) = sideways.cross(forward).try_normalize()
            && sideways.length_squared() > 1e-20
        {
            return normal;
        }
        // A row that is one point: beside it the sideways derivative grows with the mixed one.
        let grows = self.at(slopes(along), slopes(across)) * if along > 0.5 { -1.0 } else { 1.0 };
        grows.cross(forward).normalize_or(DVec3::Z)
    }
}

impl Assembly {
    fn patch(&mut self, patch: &Patch, image: Image, divisions: u32, size: f64) {
        // The mirror turns the patch round; going across the other way turns it back. Profiles run down and their
        // quarters counter-clockwise, so those go along the other way.
        let is_ring = matches!(image, Image::Turned(_));
        let step = |k: u32| f64::from(k) / f64::from(divisions);
        let upright = |v: DVec3| DVec3::new(v.x, v.z, -v.y);
        let corner = |column: u32, row: u32| {
            let across = step(if image == Image::Mirrored { divisions - column } else { column });
            let along = step(if is_ring { divisions - row } else { row });
            let position = patch.at(bernstein(along), bernstein(across));
            let normal = patch.normal(along, across) * if is_ring { -1.0 } else { 1.0 };
            let uv = Vec2::new(step(column) as f32, step(row) as f32);
            Corner { position: upright(image.of(position)) * size, normal: upright(image.of(normal)), uv }
        };
        let rows: Vec<Vec<Corner>> =
            (0..=divisions).map(|row| (0..=divisions).map(|column| corner(column, row)).collect()).collect();
        for pair in rows.windows(2) {
            for column in 0..divisions as usize {
                self.face(&[pair[0][column], pair[0][column + 1], pair[1][column + 1], pair[1][column]]);
            }
        }
    }
}
