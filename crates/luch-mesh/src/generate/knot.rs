//! Round tubes along curves whose frames are known: torus knots and springs.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3, Vec2};

use super::MAX_DIVISIONS;
use super::circle::{around, on_circle};
use super::grid::{Grid, Join, Sample};
use crate::PolygonMesh;

/// The most turns of a knot around either circle of its torus.
pub const MAX_KNOT_TURNS: u32 = 256;
/// The most turns of a spring.
pub const MAX_SPRING_TURNS: f32 = 1024.0;

/// A torus knot.
#[derive(Clone, Copy, Debug)]
pub(super) struct TorusKnot {
    pub around_axis: u32,
    pub around_tube: u32,
    pub major_radius: f64,
    pub minor_radius: f64,
}

/// A point of a curve, with a unit vector square to it.
struct Frame {
    place: DVec3,
    tangent: DVec3,
    outward: DVec3,
}

impl Frame {
    /// A point of the tube of `radius` about the curve.
    fn sample(&self, turn: DVec2, radius: f64) -> Sample {
        let normal = self.outward * turn.x - self.tangent.cross(self.outward) * turn.y;
        Sample { position: self.place + normal * radius, normal }
    }
}

impl TorusKnot {
    /// The numbers of turns without their common factor, which would only go around again.
    pub(super) fn new(turns: [u32; 2], major_radius: f32, minor_radius: f32) -> Self {
        let [p, q] = turns.map(|n| n.min(MAX_KNOT_TURNS));
        let (p, q) = if p == 0 && q == 0 { (1, 0) } else { (p, q) };
        let factor = greatest_common_divisor(p, q);
        Self {
            around_axis: p / factor,
            around_tube: q / factor,
            major_radius: f64::from(major_radius),
            minor_radius: f64::from(minor_radius),
        }
    }

    fn frame(&self, part: u32, whole: u32) -> Frame {
        let at =
            |turns: u32| on_circle((u64::from(turns) * u64::from(part) % u64::from(whole)) as u32, whole);
        let (turn, tube) = (at(self.around_axis), at(self.around_tube));
        let distance = self.major_radius + self.minor_radius * tube.x;
        let along = DVec3::new(-turn.y, 0.0, -turn.x) * (distance * f64::from(self.around_axis))
            + around(turn, -tube.y, tube.x) * (self.minor_radius * f64::from(self.around_tube));
        // The knot lies on the torus, so the torus' normal is square to it, and comes back to itself.
        Frame {
            place: around(turn, distance, self.minor_radius * tube.y),
            tangent: along.normalize_or(DVec3::Y),
            outward: around(turn, tube.x, tube.y),
        }
    }

    /// The length of the curve: the trapezoid rule, which for smooth periodic functions is as exact as the numbers.
    pub(super) fn length(&self) -> f64 {
        let (p, q) = (f64::from(self.around_axis), f64::from(self.around_tube));
        let steps = 4096 + 64 * (self.around_axis + self.around_tube);
        let speed = |step: u32| {
            let tube = libm::cos(TAU * f64::from(step) / f64::from(steps));
            DVec2::new(p * (self.major_radius + self.minor_radius * tube), q * self.minor_radius).length()
        };
        // The speed depends on the angle around the tube alone.
        (0..steps).map(speed).sum::<f64>() * TAU / f64::from(steps)
    }
}

/// See [`super::Generator::TorusKnot`].
pub(super) fn torus_knot(knot: TorusKnot, tube_radius: f32, segments: u32, sides: u32) -> PolygonMesh {
    let (segments, sides) = (segments.clamp(3, MAX_DIVISIONS), sides.clamp(3, MAX_DIVISIONS));
    let frames: Vec<Frame> = (0..segments).map(|k| knot.frame(k, segments)).collect();
    Grid::ring(segments, sides)
        .mesh(|column, row| frames[column as usize].sample(on_circle(row, sides), f64::from(tube_radius)))
}

/// How many pieces a spring has along its wire.
pub(super) fn spring_pieces(turns: f32, segments: u32) -> u32 {
    let pieces = turns.clamp(0.0, MAX_SPRING_TURNS) * segments.clamp(3, MAX_DIVISIONS) as f32;
    (pieces.ceil() as u32).max(1)
}

/// See [`super::Generator::Spring`].
pub(super) fn spring(
    radius: f32,
    tube_radius: f32,
    pitch: f32,
    turns: f32,
    segments: u32,
    sides: u32,
) -> PolygonMesh {
    let (pieces, sides) = (spring_pieces(turns, segments), sides.clamp(3, MAX_DIVISIONS));
    let (radius, turns) = (f64::from(radius), f64::from(turns.clamp(0.0, MAX_SPRING_TURNS)));
    let height = f64::from(pitch) * turns;
    let frame = |piece: u32| {
        let part = f64::from(piece) / f64::from(pieces);
        let angle = part * turns * TAU;
        let turn = DVec2::new(libm::cos(angle), libm::sin(angle));
        let along = DVec3::new(-turn.y, 0.0, -turn.x) * radius + DVec3::Y * (f64::from(pitch) / TAU);
        Frame {
            place: around(turn, radius, (part - 0.5) * height),
            tangent: along.normalize_or(DVec3::Y),
            outward: around(turn, 1.0, 0.0),
        }
    };
    let frames: Vec<Frame> = (0..=pieces).map(frame).collect();
    let grid = Grid { columns: pieces, rows: sides, join: Join::Open, rows_joined: true, poles: [false; 2] };
    let mut mesh = grid
        .mesh(|column, row| frames[column as usize].sample(on_circle(row, sides), f64::from(tube_radius)));
    // Two flat ends with rims that are sharp.
    mesh.normals.corners.clone_from(&mesh.corners);
    for (column, frame) in [(0, &frames[0]), (pieces, &frames[pieces as usize])] {
        let is_start = column == 0;
        let rows = (0..sides).map(|k| if is_start { k } else { sides - 1 - k });
        let corners: Vec<u32> = rows.clone().map(|row| row * (pieces + 1) + column).collect();
        mesh.add_face(&corners);
        let normal = mesh.normals.values.len() as u32;
        mesh.normals.values.push((frame.tangent * if is_start { -1.0 } else { 1.0 }).as_vec3());
        mesh.normals.corners.extend(rows.clone().map(|_| normal));
        let uvs = &mut mesh.uv_sets[0];
        let first = uvs.values.len() as u32;
        let side = if is_start { 1.0 } else { -1.0 };
        let flat = rows
            .map(|row| on_circle(row, sides))
            .map(|turn| Vec2::new((0.5 + 0.5 * turn.x) as f32, (0.5 + 0.5 * side * turn.y) as f32));
        uvs.values.extend(flat);
        uvs.corners.extend(first..first + sides);
    }
    mesh
}

/// Euclid; zero only if both are.
pub(crate) fn greatest_common_divisor(one: u32, other: u32) -> u32 {
    if other == 0 { one } else { greatest_common_divisor(other, one % other) }
}
