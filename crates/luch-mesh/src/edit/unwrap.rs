//! Texture coordinates by projection.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3, Vec2};

use super::geometry::{corner_place, plane_axes, unit_normal};
use super::{EditError, prepared};
use crate::PolygonMesh;
use crate::polygon_mesh::CornerAttribute;

/// How places become texture coordinates. Sizes are those of the marked faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Projection {
    /// Along the axis onto a plane; the larger side runs from 0 to 1.
    Planar,
    /// Each face along the axis nearest to its normal; the largest side of the box runs from 0 to 1.
    Box,
    /// Around the axis: u once around, v from bottom to top. Faces across the seam go on past 1.
    Cylinder,
    /// Around the axis and from pole to pole.
    Sphere,
}

/// Gives the marked faces texture coordinates in set 0; others keep theirs, or get zero if there are none.
///
/// No face is smeared across the seam, and at a pole each face gets the u of its middle.
pub fn unwrap(
    mesh: &PolygonMesh,
    faces: &[bool],
    projection: Projection,
    axis: DVec3,
) -> Result<PolygonMesh, EditError> {
    let axis = axis.try_normalize().ok_or(EditError::NoDirection("axis"))?;
    let mut mesh = prepared(mesh).into_owned();
    if mesh.corners.is_empty() {
        return Ok(mesh);
    }
    let is_marked = |face: usize| faces.get(face).copied().unwrap_or(false);
    let mut vertices = vec![false; mesh.positions.len()];
    for face in (0..mesh.face_count()).filter(|&face| is_marked(face)) {
        mesh.corners[mesh.face(face)].iter().for_each(|&vertex| vertices[vertex as usize] = true);
    }
    let frame = Frame::new(&mesh, &vertices, axis);
    let old = mesh.uv_sets.first().filter(|uvs| !uvs.is_empty()).cloned();
    let mut uvs: Vec<Vec2> = match &old {
        Some(old) => old.corners.iter().map(|&number| old.values[number as usize]).collect(),
        None => vec![Vec2::ZERO; mesh.corners.len()],
    };
    for face in (0..mesh.face_count()).filter(|&face| is_marked(face)) {
        let range = mesh.face(face);
        let places: Vec<DVec3> = range.clone().map(|corner| corner_place(&mesh, corner)).collect();
        let found = match projection {
            Projection::Planar => places.iter().map(|&p| frame.planar(p)).collect(),
            Projection::Box => frame.boxed(&places, unit_normal(&mesh, face)),
            Projection::Cylinder => frame.round(&places, |height, _| (height - frame.low.z) / frame.size.z),
            Projection::Sphere => {
                let middle = frame.low.z + frame.size.z / 2.0;
                frame.round(&places, |height, radius| libm::atan2(height - middle, radius) / PI + 0.5)
            }
        };
        for (corner, uv) in range.zip(found) {
            uvs[corner] = if uv.is_finite() { uv.as_vec2() } else { Vec2::ZERO };
        }
    }
    let uvs = shared(&uvs);
    match mesh.uv_sets.first_mut() {
        Some(first) => *first = uvs,
        None => mesh.uv_sets.push(uvs),
    }
    Ok(mesh)
}

/// Equal values once.
fn shared(uvs: &[Vec2]) -> CornerAttribute<Vec2> {
    let mut numbers = std::collections::HashMap::new();
    let mut values = Vec::new();
    let corners = uvs.iter().map(|uv| {
        *numbers.entry(uv.to_array().map(f32::to_bits)).or_insert_with(|| {
            values.push(*uv);
            values.len() as u32 - 1
        })
    });
    let corners = corners.collect();
    CornerAttribute { values, corners }
}

/// Coordinates along two directions across the axis and along it, and the box in them.
struct Frame {
    axes: [DVec3; 3],
    low: DVec3,
    size: DVec3,
}

impl Frame {
    fn new(mesh: &PolygonMesh, vertices: &[bool], axis: DVec3) -> Self {
        let [right, up] = plane_axes(axis);
        let axes = [right, up, axis];
        let ranges = axes.map(|axis| super::geometry::extent(mesh, vertices, axis).unwrap_or([0.0; 2]));
        let low = DVec3::from_array(ranges.map(|range| range[0]));
        let size = DVec3::from_array(ranges.map(|range| {
            let size = range[1] - range[0];
            if size > 0.0 { size } else { 1.0 }
        }));
        Self { axes, low, size }
    }

    fn local(&self, point: DVec3) -> DVec3 {
        DVec3::from_array(self.axes.map(|axis| axis.dot(point)))
    }

    fn planar(&self, point: DVec3) -> DVec2 {
        (self.local(point) - self.low).truncate() / self.size.x.max(self.size.y)
    }

    fn boxed(&self, places: &[DVec3], normal: DVec3) -> Vec<DVec2> {
        let normal = self.local(normal);
        let axis = normal.abs().max_position();
        let (right, up) = ((axis + 1) % 3, (axis + 2) % 3);
        // Seen from outside, u runs to the right on every side.
        let sign = if normal[axis] < 0.0 { -1.0 } else { 1.0 };
        let scale = self.size.max_element();
        let uv = |point: &DVec3| {
            let local = (self.local(*point) - self.low) / scale;
            let u = if sign < 0.0 { self.size[right] / scale - local[right] } else { local[right] };
            DVec2::new(u, local[up])
        };
        places.iter().map(uv).collect()
    }

    /// u by the angle around the middle of the box; v by a function of height and distance from the axis.
    fn round(&self, places: &[DVec3], v: impl Fn(f64, f64) -> f64) -> Vec<DVec2> {
        let middle = (self.low + self.size / 2.0).truncate();
        let offsets: Vec<DVec2> = places.iter().map(|&p| self.local(p).truncate() - middle).collect();
        let smallest = self.size.truncate().max_element() * 1e-6;
        let angle = |offset: &DVec2| libm::atan2(offset.y, offset.x) / TAU + 0.5;
        // Angles are told from that of the face's middle, so that none jumps at the seam.
        let sum: DVec2 =
            offsets.iter().filter(|offset| offset.length() > smallest).map(|o| o.normalize_or_zero()).sum();
        let center = angle(&sum);
        let uv = |(point, offset): (&DVec3, &DVec2)| {
            // Whole turns only, so that neighbours have the very same u.
            let u = if offset.length() > smallest { angle(offset) } else { center };
            DVec2::new(u - (u - center).round(), v(self.local(*point).z, offset.length()))
        };
        places.iter().zip(&offsets).map(uv).collect()
    }
}
