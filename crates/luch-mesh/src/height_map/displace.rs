//! Displacement: an image moves the positions of a mesh along its normals.

use glam::{DVec3, Vec2};
use luch_image::{Bitmap, Encoding};

use super::Channel;
use super::image::value_of;
use crate::PolygonMesh;
use crate::polygon_mesh::CornerAttribute;

/// How an image displaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Displacement {
    /// How far a difference of one in the image moves, in metres.
    pub scale: f64,
    /// The value that moves nothing.
    pub middle: f64,
    /// What of a pixel counts.
    pub channel: Channel,
    /// Whether the sRGB curve is undone; stored numbers are taken as they are otherwise.
    pub encoding: Encoding,
}

/// Moves each position along its normal by `scale · (value − middle)`; the value is read at its uv of set 0, bilinear
/// between the centres of pixels, the image repeated. A position with several uvs takes the mean of their values and one with
/// several normals their mean, so nothing tears. Normals are then found anew, hard and smooth edges as they were.
///
/// Positions without uv, without normal, or with a value that is not finite stay. Returns how many moved.
pub fn displace(mesh: &mut PolygonMesh, image: &Bitmap, displacement: &Displacement) -> usize {
    let Some(uvs) = mesh.uv_sets.first().filter(|_| image.width > 0 && image.height > 0) else { return 0 };
    let faces = face_normals(mesh);
    let count = mesh.positions.len();
    let (mut normals, mut values, mut corners) =
        (vec![DVec3::ZERO; count], vec![0.0; count], vec![0u32; count]);
    for (corner, &position) in mesh.corners.iter().enumerate() {
        let position = position as usize;
        let at = |indices: &[u32]| indices.get(corner).map_or(position, |&k| k as usize);
        let Some(uv) = uvs.values.get(at(&uvs.corners)).filter(|_| position < count) else { continue };
        values[position] += sample(image, *uv, displacement);
        corners[position] += 1;
        let shading = mesh.normals.values.get(at(&mesh.normals.corners));
        normals[position] += shading.map_or(faces[corner], |normal| normal.as_dvec3());
    }
    let mut moved = 0;
    for (place, ((normal, value), corners)) in
        mesh.positions.iter_mut().zip(normals.iter().zip(values).zip(corners))
    {
        let Some(normal) = normal.try_normalize().filter(|_| corners > 0) else { continue };
        let distance = displacement.scale * (value / f64::from(corners) - displacement.middle);
        let there = (place.as_dvec3() + normal * distance).as_vec3();
        if there.is_finite() {
            moved += usize::from(there != *place);
            *place = there;
        }
    }
    renew_normals(mesh);
    moved
}

/// Bilinear between the centres of four pixels; the picture repeats in both directions.
fn sample(image: &Bitmap, uv: Vec2, displacement: &Displacement) -> f64 {
    let along = |t: f32, count: u32| {
        let t = f64::from(t);
        let place = (t - t.floor()) * f64::from(count) - 0.5;
        let first = place.floor();
        let wrapped = |k: f64| (k as i64).rem_euclid(i64::from(count)) as u32;
        ([wrapped(first), wrapped(first + 1.0)], place - first)
    };
    if !uv.is_finite() {
        return f64::NAN;
    }
    let ([left, right], s) = along(uv.x, image.width);
    // Rows count from the top, v from the bottom.
    let ([upper, lower], t) = along(1.0 - uv.y, image.height);
    let value =
        |x: u32, y: u32| f64::from(value_of(displacement.channel, image.linear(x, y, displacement.encoding)));
    let row = |y: u32| value(left, y) * (1.0 - s) + value(right, y) * s;
    row(upper) * (1.0 - t) + row(lower) * t
}

/// For each corner the unit normal of its face; zero where there is none.
fn face_normals(mesh: &PolygonMesh) -> Vec<DVec3> {
    let mut normals = vec![DVec3::ZERO; mesh.corners.len()];
    for (face, area) in area_normals(mesh).into_iter().enumerate() {
        normals[mesh.face(face)].fill(area.normalize_or_zero());
    }
    normals
}

/// For each face twice its area times its normal, by Newell's sum over the outer border.
fn area_normals(mesh: &PolygonMesh) -> Vec<DVec3> {
    let place = |corner: usize| {
        mesh.positions.get(mesh.corners[corner] as usize).map_or(DVec3::NAN, |p| p.as_dvec3())
    };
    let of_face = |face: usize| {
        let border = mesh.borders(face)[0].clone();
        let Some(origin) = border.clone().next().map(place) else { return DVec3::ZERO };
        let next = |corner: usize| if corner + 1 == border.end { border.start } else { corner + 1 };
        border.clone().map(|corner| (place(corner) - origin).cross(place(next(corner)) - origin)).sum()
    };
    (0..mesh.face_count()).map(of_face).collect()
}

/// Each normal value becomes the mean, by area, of the faces whose corners share it.
fn renew_normals(mesh: &mut PolygonMesh) {
    if mesh.normals.is_empty() {
        return;
    }
    let mut sums = vec![DVec3::ZERO; mesh.normals.values.len()];
    for (face, area) in area_normals(mesh).into_iter().enumerate() {
        for corner in mesh.face(face) {
            let CornerAttribute { corners, .. } = &mesh.normals;
            let index = corners.get(corner).unwrap_or(&mesh.corners[corner]);
            if let Some(sum) = sums.get_mut(*index as usize) {
                *sum += area;
            }
        }
    }
    for (normal, sum) in mesh.normals.values.iter_mut().zip(sums) {
        if let Some(unit) = sum.try_normalize() {
            *normal = unit.as_vec3();
        }
    }
}
