//! Moving vertices: by affine maps, along normals, one by one.

use glam::{DAffine3, DMat3, DVec3};

use super::geometry::to_position;
use super::{prepared, refresh_normals, vertex_normals};
use crate::PolygonMesh;

/// Moves the marked vertices by an affine map.
///
/// If all vertices are marked, normals go along exactly, and a mirroring map reverses the faces so that what was outside
/// stays outside. Otherwise the faces that have changed their form get new normals.
pub fn transform(mesh: &PolygonMesh, vertices: &[bool], map: &DAffine3) -> PolygonMesh {
    let is_whole = mesh.positions.iter().enumerate().all(|(v, _)| vertices.get(v).copied().unwrap_or(false));
    if !is_whole {
        return move_vertices(mesh, vertices, |_, point| map.transform_point3(point));
    }
    let mut mesh = mesh.clone();
    for position in &mut mesh.positions {
        *position = to_position(map.transform_point3(position.as_dvec3()));
    }
    let linear = map.matrix3;
    let mirrors = linear.determinant() < 0.0;
    let normal_map = cofactors(linear) * if mirrors { -1.0 } else { 1.0 };
    for normal in &mut mesh.normals.values {
        *normal = (normal_map * normal.as_dvec3()).try_normalize().map_or(*normal, DVec3::as_vec3);
    }
    if mirrors {
        mesh.flip();
        mesh.normals.values.iter_mut().for_each(|normal| *normal = -*normal);
    }
    mesh
}

/// The inverse transpose up to a factor: the map of normals, defined for flattening maps too.
pub(super) fn cofactors(linear: DMat3) -> DMat3 {
    let (x, y, z) = (linear.x_axis, linear.y_axis, linear.z_axis);
    DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y))
}

/// Moves the marked vertices by a function of number and place. Faces that change their form get new normals; corners that shared one
/// share one again. A place that is not finite is not taken.
pub fn move_vertices(
    mesh: &PolygonMesh,
    vertices: &[bool],
    place_of: impl Fn(usize, DVec3) -> DVec3,
) -> PolygonMesh {
    let mut mesh = prepared(mesh).into_owned();
    let mut has_moved = vec![false; mesh.positions.len()];
    for (vertex, position) in mesh.positions.iter_mut().enumerate() {
        if vertices.get(vertex).copied().unwrap_or(false) {
            let place = place_of(vertex, position.as_dvec3());
            let place = if place.is_finite() { to_position(place) } else { *position };
            has_moved[vertex] = place != *position;
            *position = place;
        }
    }
    // A vertex whose faces are as they were keeps its normals.
    let mut is_stale = vec![false; mesh.positions.len()];
    for face in 0..mesh.face_count() {
        let corners = &mesh.corners[mesh.face(face)];
        if corners.iter().any(|&vertex| has_moved[vertex as usize]) {
            corners.iter().for_each(|&vertex| is_stale[vertex as usize] = true);
        }
    }
    let keeps: Vec<bool> = mesh.corners.iter().map(|&vertex| !is_stale[vertex as usize]).collect();
    refresh_normals(&mut mesh, |corner| keeps[corner]);
    mesh
}

/// Moves the marked vertices along their normals, so that flat faces end up at the distance in metres.
pub fn inflate(mesh: &PolygonMesh, vertices: &[bool], distance: f64) -> PolygonMesh {
    let ways = vertex_normals(mesh);
    move_vertices(mesh, vertices, |vertex, place| place + ways[vertex] * distance)
}

/// The lowest and the highest corner of the box around the marked vertices; zero if there are none.
pub fn vertex_bounds(mesh: &PolygonMesh, vertices: &[bool]) -> [DVec3; 2] {
    let along = |axis| super::geometry::extent(mesh, vertices, axis).unwrap_or([0.0; 2]);
    let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(along);
    [DVec3::new(x[0], y[0], z[0]), DVec3::new(x[1], y[1], z[1])]
}

/// The mean distance of the marked vertices from a point; zero if there are none.
pub fn mean_distance(mesh: &PolygonMesh, vertices: &[bool], center: DVec3) -> f64 {
    let marked = mesh.positions.iter().zip(vertices).filter(|(_, marked)| **marked);
    let distances = marked.map(|(position, _)| position.as_dvec3().distance(center));
    let distances: Vec<f64> = distances.filter(|distance| distance.is_finite()).collect();
    distances.iter().sum::<f64>() / distances.len().max(1) as f64
}

/// A turn about a unit axis through a point, by radians counter-clockwise seen from the axis's tip.
pub fn rotation_about(center: DVec3, axis: DVec3, angle: f64) -> DAffine3 {
    about_center(center, rotation(axis, angle))
}

/// A linear map that leaves a point where it is.
pub fn about_center(center: DVec3, linear: DMat3) -> DAffine3 {
    DAffine3 { matrix3: linear, translation: center - linear * center }
}

/// A turn about a unit axis, by the sine and cosine that are the same on every machine (Rodrigues' formula).
pub(super) fn rotation(axis: DVec3, angle: f64) -> DMat3 {
    let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
    let turned = |v: DVec3| v * cosine + axis.cross(v) * sine + axis * (axis.dot(v) * (1.0 - cosine));
    DMat3::from_cols(turned(DVec3::X), turned(DVec3::Y), turned(DVec3::Z))
}
