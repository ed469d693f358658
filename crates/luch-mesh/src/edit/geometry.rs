//! Places, normals and areas of polygons, in double precision.

use std::ops::Range;

use glam::DVec3;

use crate::PolygonMesh;

/// The place of a vertex.
pub(super) fn place(mesh: &PolygonMesh, vertex: u32) -> DVec3 {
    mesh.positions[vertex as usize].as_dvec3()
}

/// The place of a corner.
pub(super) fn corner_place(mesh: &PolygonMesh, corner: usize) -> DVec3 {
    place(mesh, mesh.corners[corner])
}

/// Area times unit normal of a polygon that need not be flat (Newell's method).
pub(super) fn area_vector_of(mut points: impl Iterator<Item = DVec3>) -> DVec3 {
    let Some(first) = points.next() else { return DVec3::ZERO };
    // Relative to the first corner: no digits are lost far from the origin.
    let (mut sum, mut previous) = (DVec3::ZERO, DVec3::ZERO);
    for point in points {
        let spoke = point - first;
        sum += previous.cross(spoke);
        previous = spoke;
    }
    sum / 2.0
}

/// Area times unit normal of a border.
pub(super) fn area_vector(mesh: &PolygonMesh, border: Range<usize>) -> DVec3 {
    area_vector_of(border.map(|corner| corner_place(mesh, corner)))
}

/// The unit normal of a face by its outer border; zero if it has none.
pub(super) fn unit_normal(mesh: &PolygonMesh, face: usize) -> DVec3 {
    let outer = if mesh.holes.is_empty() { mesh.face(face) } else { mesh.borders(face)[0].clone() };
    area_vector(mesh, outer).try_normalize().unwrap_or(DVec3::ZERO)
}

/// The unit normals of all faces; zero where there is none.
pub(super) fn unit_normals(mesh: &PolygonMesh) -> Vec<DVec3> {
    (0..mesh.face_count()).map(|face| unit_normal(mesh, face)).collect()
}

/// The mean of the corners of a face.
pub(super) fn center(mesh: &PolygonMesh, face: usize) -> DVec3 {
    let corners = mesh.face(face);
    let count = corners.len().max(1) as f64;
    corners.map(|corner| corner_place(mesh, corner)).sum::<DVec3>() / count
}

/// The angle between two unit vectors, exact for small ones too; zero if one is zero.
pub(super) fn angle_between(one: DVec3, other: DVec3) -> f64 {
    libm::atan2(one.cross(other).length(), one.dot(other))
}

/// The corner before each corner in its border.
pub(super) fn previous_corners(half_edges: &crate::polygon_mesh::HalfEdges, count: usize) -> Vec<u32> {
    let mut previous: Vec<u32> = (0..count as u32).collect();
    for corner in 0..count as u32 {
        previous[half_edges.next(corner) as usize] = corner;
    }
    previous
}

/// Lowest and highest place of the marked vertices along an axis; `None` if none is finite.
pub(super) fn extent(mesh: &PolygonMesh, vertices: &[bool], axis: DVec3) -> Option<[f64; 2]> {
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    for (position, _) in mesh.positions.iter().zip(vertices).filter(|(_, marked)| **marked) {
        let along = position.as_dvec3().dot(axis);
        if along.is_finite() {
            range = [range[0].min(along), range[1].max(along)];
        }
    }
    (range[0] <= range[1]).then_some(range)
}

/// Two unit vectors at right angles to a unit vector and to each other, so that right × up = normal.
pub(super) fn plane_axes(normal: DVec3) -> [DVec3; 2] {
    // The axis least along the normal.
    let aside = match normal.abs().min_position() {
        0 => DVec3::X,
        1 => DVec3::Y,
        _ => DVec3::Z,
    };
    let right = aside.cross(normal).try_normalize().unwrap_or(DVec3::X);
    [right, normal.cross(right)]
}

/// A single-precision place that is finite, so that no result has infinities its source had not.
pub(super) fn to_position(point: DVec3) -> glam::Vec3 {
    let most = f64::from(f32::MAX);
    let clamped =
        DVec3::new(point.x.clamp(-most, most), point.y.clamp(-most, most), point.z.clamp(-most, most));
    clamped.as_vec3()
}
