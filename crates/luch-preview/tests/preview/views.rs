//! What the tests share: the renderer's rays, written down again from its documentation, and random meshes.

use glam::{Affine3A, Vec2, Vec3};
use luch_bvh::Ray;
use luch_mesh::TriangleMesh;
use luch_preview::Size;
use luch_sampling::hash;
use luch_scene::{Camera, Projection};

/// The ray through a place of the picture, in pixels from its upper left corner: through the slopes
/// `(x − width/2) s` and `(height/2 − y) s`, with `s = 2 tan(angle/2) / height` or, if rays are parallel, metres per row.
/// Its parameter is the depth.
pub(crate) fn ray(camera: &Camera, size: Size, place: Vec2) -> Ray {
    let half_height = match camera.projection {
        Projection::Perspective { field_of_view_y } => libm::tanf(field_of_view_y / 2.0),
        Projection::Orthographic { height } => height / 2.0,
    };
    let scale = 2.0 * half_height / size.height as f32;
    let x = (place.x - size.width as f32 / 2.0) * scale;
    let y = (size.height as f32 / 2.0 - place.y) * scale;
    let axes = camera.orientation;
    match camera.projection {
        Projection::Perspective { .. } => Ray::new(camera.position, axes * Vec3::new(x, y, -1.0)),
        Projection::Orthographic { .. } => {
            Ray::new(camera.position + axes * Vec3::new(x, y, 0.0), axes * Vec3::NEG_Z)
        }
    }
}

/// A number from 0 to 1.
pub(crate) fn random(seed: u64, position: u64) -> f32 {
    hash::unit_f32(hash::word(seed, position) as u32)
}

/// A point of the cube from −1 to 1.
pub(crate) fn random_point(seed: u64, position: u64) -> Vec3 {
    Vec3::from_array([0, 1, 2].map(|axis| random(seed, 3 * position + axis) * 2.0 - 1.0))
}

/// Triangles anywhere in a cube of half this size.
pub(crate) fn soup(seed: u64, count: u64, size: f32) -> TriangleMesh {
    let positions = (0..3 * count).map(|i| random_point(seed, i) * size).collect();
    let triangles = (0..count as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    TriangleMesh::new(positions, triangles)
}

/// A mesh with its vertices moved at random by up to `by`: still closed if it was, but crumpled.
pub(crate) fn crumpled(mut mesh: TriangleMesh, seed: u64, by: f32) -> TriangleMesh {
    for (position, i) in mesh.positions.iter_mut().zip(0..) {
        *position += random_point(seed, i) * by;
    }
    mesh.normals = Default::default();
    mesh
}

/// The mesh put somewhere.
pub(crate) fn placed(mesh: &TriangleMesh, placement: &Affine3A) -> TriangleMesh {
    let positions = mesh.positions.iter().map(|&position| placement.transform_point3(position)).collect();
    TriangleMesh::new(positions, mesh.triangles.clone())
}

/// Pinholes and parallel rays from outside, near by and within.
pub(crate) fn cameras() -> Vec<Camera> {
    let looking = |position, target, angle| Camera::looking_at(position, target, Vec3::Y, angle);
    let outside = looking(Vec3::new(3.0, 2.0, 4.0), Vec3::ZERO, 0.7);
    let parallel = |height| Camera { projection: Projection::Orthographic { height }, ..outside };
    vec![
        outside,
        looking(Vec3::new(-0.4, 1.1, 1.3), Vec3::new(0.3, 0.0, 0.0), 1.9),
        looking(Vec3::new(0.1, 0.2, -0.1), Vec3::new(1.0, 0.3, 0.2), 2.6),
        looking(Vec3::new(40.0, 3.0, 2.0), Vec3::ZERO, 0.06),
        parallel(3.0),
        Camera { position: Vec3::new(0.1, 0.0, 0.2), ..parallel(1.0) },
    ]
}
