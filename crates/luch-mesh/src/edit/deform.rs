//! Deformations: maps of space that bend, twist, taper, shear, stretch, round and wave what is in it.
//!
//! Bending, twisting and tapering follow Barr, "Global and Local Deformations of Solid Primitives" (1984).

use std::f64::consts::TAU;

use glam::{DMat3, DVec3};

use super::geometry::{extent, to_position};
use super::place::{cofactors, rotation};
use super::{EditError, Field, Lattice, move_vertices, prepared, vertex_normals};
use crate::PolygonMesh;

/// The stretch of an axis over which a deformation grows from nothing to all; beyond its ends it stays as it is there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// The unit vector along the axis.
    pub axis: DVec3,
    /// A point on the axis.
    pub center: DVec3,
    /// Where it begins: a distance from the origin along the axis, in metres.
    pub low: f64,
    /// Where it ends.
    pub high: f64,
}

impl Span {
    /// The stretch that the marked vertices take along a direction of any length.
    pub fn of(mesh: &PolygonMesh, vertices: &[bool], axis: DVec3, center: DVec3) -> Result<Self, EditError> {
        let axis = axis.try_normalize().ok_or(EditError::NoDirection("axis"))?;
        let [low, high] = extent(mesh, vertices, axis).unwrap_or([0.0, 0.0]);
        Ok(Self { axis, center, low, high })
    }

    fn length(&self) -> f64 {
        self.high - self.low
    }

    /// Metres from the beginning.
    fn along(&self, point: DVec3) -> f64 {
        self.axis.dot(point) - self.low
    }

    /// From 0 at the beginning to 1 at the end.
    fn share(&self, point: DVec3) -> f64 {
        if self.length() > 0.0 { (self.along(point) / self.length()).clamp(0.0, 1.0) } else { 0.0 }
    }

    /// The nearest point on the axis.
    fn foot(&self, point: DVec3) -> DVec3 {
        self.center + self.axis * self.axis.dot(point - self.center)
    }
}

/// A map of space.
#[derive(Clone, Debug, PartialEq)]
pub enum Deformation {
    /// Turns about the axis, by so much at the end of the span. Volume stays in the limit of fine faces.
    Twist {
        /// Where.
        span: Span,
        /// The turn at the end, in radians.
        angle: f64,
    },
    /// Bends the axis to an arc of the same length, toward a direction.
    Bend {
        /// Where.
        span: Span,
        /// The angle of the arc, in radians.
        angle: f64,
        /// The unit vector it bends to, at right angles to the axis.
        toward: DVec3,
    },
    /// Scales away from the axis, from one at the beginning to a factor at the end of the span.
    Taper {
        /// Where.
        span: Span,
        /// The factor at the end.
        factor: f64,
    },
    /// Moves along a direction in proportion to the way along an axis. Volume stays.
    Shear {
        /// The unit vector whose way counts.
        axis: DVec3,
        /// A point that stays where it is.
        center: DVec3,
        /// How far for each metre.
        way: DVec3,
    },
    /// Scales along an axis, and across it by another factor.
    Stretch {
        /// The unit vector along the axis.
        axis: DVec3,
        /// A point that stays where it is.
        center: DVec3,
        /// The factor along.
        along: f64,
        /// The factor across.
        across: f64,
    },
    /// Moves toward a sphere.
    Spherify {
        /// Its centre.
        center: DVec3,
        /// Its radius.
        radius: f64,
        /// How far on the way: 0 not at all, 1 onto it.
        share: f64,
    },
    /// Moves along a direction by a sine.
    Wave {
        /// How far at most, and which way.
        height: DVec3,
        /// The unit vector along which the wave runs.
        along: DVec3,
        /// The length of the wave in metres.
        length: f64,
        /// Where in the wave the origin is, in radians.
        phase: f64,
    },
    /// Moves with a box of control points.
    Lattice(Lattice),
}

impl Deformation {
    /// Where a point goes.
    pub fn map(&self, point: DVec3) -> DVec3 {
        match self {
            Self::Twist { span, angle } => {
                let foot = span.foot(point);
                foot + rotation(span.axis, angle * span.share(point)) * (point - foot)
            }
            Self::Bend { span, angle, toward } => bend(span, *angle, *toward, point),
            Self::Taper { span, factor } => {
                let foot = span.foot(point);
                foot + (point - foot) * (1.0 + (factor - 1.0) * span.share(point))
            }
            Self::Shear { axis, center, way } => point + *way * axis.dot(point - *center),
            Self::Stretch { axis, center, along, across } => {
                let offset = point - *center;
                let part = *axis * axis.dot(offset);
                *center + part * *along + (offset - part) * *across
            }
            Self::Spherify { center, radius, share } => {
                let offset = point - *center;
                let direction = offset.try_normalize().unwrap_or(DVec3::ZERO);
                point.lerp(*center + direction * *radius, *share)
            }
            Self::Wave { height, along, length, phase } => {
                point + *height * libm::sin(TAU * along.dot(point) / length + phase)
            }
            Self::Lattice(lattice) => lattice.map(point),
        }
    }

    /// How space is stretched around a point, by central differences over a step.
    fn derivative(&self, point: DVec3, step: f64) -> DMat3 {
        let column =
            |axis: DVec3| (self.map(point + axis * step) - self.map(point - axis * step)) / (2.0 * step);
        DMat3::from_cols(column(DVec3::X), column(DVec3::Y), column(DVec3::Z))
    }
}

fn bend(span: &Span, angle: f64, toward: DVec3, point: DVec3) -> DVec3 {
    let length = span.length();
    if length <= 0.0 || angle.abs() < 1e-12 {
        return point;
    }
    let radius = length / angle;
    let along = span.along(point);
    let inside = along.clamp(0.0, length);
    // Along the axis to the beginning, then by the arc; what lies beyond goes straight on.
    let start = span.center + span.axis * (span.low - span.axis.dot(span.center));
    let aside = toward.dot(point - span.center);
    let rest = point - span.center - span.axis * span.axis.dot(point - span.center) - toward * aside;
    let turned = angle * inside / length;
    let (sine, cosine) = (libm::sin(turned), libm::cos(turned));
    let forward = span.axis * cosine + toward * sine;
    start
        + rest
        + span.axis * ((radius - aside) * sine)
        + toward * (radius - (radius - aside) * cosine)
        + forward * (along - inside)
}

/// Moves the marked vertices by a map. If all are marked normals go with the map, else faces that change get new ones.
pub fn deform(mesh: &PolygonMesh, vertices: &[bool], deformation: &Deformation) -> PolygonMesh {
    let is_whole = mesh.positions.iter().enumerate().all(|(v, _)| vertices.get(v).copied().unwrap_or(false));
    if !is_whole || mesh.normals.is_empty() {
        return move_vertices(mesh, vertices, |_, point| deformation.map(point));
    }
    let mut mesh = prepared(mesh).into_owned();
    let sizes = mesh.positions.iter().map(|position| position.as_dvec3().abs().max_element());
    let step = sizes.filter(|size| size.is_finite()).fold(1e-3, f64::max) * 1e-6;
    carry_normals(&mut mesh, |point| deformation.derivative(point, step));
    for position in &mut mesh.positions {
        let place = deformation.map(position.as_dvec3());
        if place.is_finite() {
            *position = to_position(place);
        }
    }
    mesh
}

/// Maps the normals by the derivative at their vertex; one for each pair of vertex and normal.
fn carry_normals(mesh: &mut PolygonMesh, derivative: impl Fn(DVec3) -> DMat3) {
    let mut numbers = std::collections::HashMap::new();
    let mut values = Vec::new();
    let mut corners = Vec::with_capacity(mesh.corners.len());
    let mut maps: Vec<Option<DMat3>> = vec![None; mesh.positions.len()];
    for (&vertex, &normal) in mesh.corners.iter().zip(&mesh.normals.corners) {
        let number = *numbers.entry([vertex, normal]).or_insert_with(|| {
            let old = mesh.normals.values[normal as usize];
            let map = maps[vertex as usize]
                .get_or_insert_with(|| cofactors(derivative(mesh.positions[vertex as usize].as_dvec3())));
            let new = (*map * old.as_dvec3()).try_normalize().map_or(old, DVec3::as_vec3);
            values.push(new);
            values.len() as u32 - 1
        });
        corners.push(number);
    }
    mesh.normals.values = values;
    mesh.normals.corners = corners;
}

/// Moves the marked vertices by a field in metres: along a direction, or along their normals. Where it is undefined nothing moves.
pub fn displace(
    mesh: &PolygonMesh,
    vertices: &[bool],
    field: &Field,
    direction: Option<DVec3>,
) -> PolygonMesh {
    let places: Vec<DVec3> = mesh.positions.iter().map(|position| position.as_dvec3()).collect();
    let distances = field.values(&places);
    let normals = if direction.is_none() { vertex_normals(mesh) } else { Vec::new() };
    let way =
        |vertex: usize| direction.unwrap_or_else(|| normals[vertex]).normalize_or_zero() * distances[vertex];
    move_vertices(mesh, vertices, |vertex, place| place + way(vertex))
}
