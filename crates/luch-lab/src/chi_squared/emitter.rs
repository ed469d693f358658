//! Directions to lamps: each shape from near, from afar, at flat angles and from behind.

use super::Routine;
use glam::{Affine3A, Quat, Vec3};
use luch_bvh::Ray;
use luch_image::Rgb;
use luch_mesh::TriangleMesh;
use luch_render::{SurfacePoint, World};
use luch_scene::{Camera, Emission, Material, Scene, Shape, Surface};
use std::sync::Arc;

/// The world of a scene that is sound but for its missing camera.
pub(super) fn built(mut scene: Scene) -> Option<Arc<World>> {
    scene.add_camera(Camera::looking_at(Vec3::ZERO, Vec3::X, Vec3::Y, 1.0));
    World::build(scene).ok().map(Arc::new)
}

/// A material that shines.
pub(super) fn glowing(two_sided: bool) -> Material {
    Material {
        emission: Some(Emission { radiance: Rgb::gray(2.0).into(), two_sided }),
        ..Material::new(Surface::Absorber)
    }
}

/// The density with which light sampling draws a direction, as a ray that goes there reports it.
fn density(world: &World, from: Vec3, direction: Vec3) -> f32 {
    let World { scene, geometry, lights, .. } = world;
    let ray = Ray::new(from, direction);
    match geometry.nearest_hit(scene, &ray, 0) {
        Some(hit) => lights.pdf_of_hit(from, Vec3::ZERO, &SurfacePoint::new(scene, geometry, &ray, hit)),
        None => lights.beyond(scene, from, Vec3::ZERO, direction).map(|light| light.pdf).sum(),
    }
}

/// Light sampling of a whole world from a place; `axis` is about where the light is.
pub(super) fn toward(
    name: &str,
    parameters: &str,
    world: Option<Arc<World>>,
    from: Vec3,
    axis: Vec3,
) -> Option<Routine> {
    let world = world?;
    let asked = Arc::clone(&world);
    Some(Routine::directions(
        name,
        parameters,
        axis,
        move |[u, v, choice, _]| {
            let sample = world.lights.sample(&world.scene, from, Vec3::ZERO, f64::from(choice), [u, v])?;
            Some(sample.incoming)
        },
        move |direction| density(&asked, from, direction),
    ))
}

fn alone(shape: Shape, two_sided: bool, placement: Affine3A) -> Option<Arc<World>> {
    let mut scene = Scene::default();
    let (shape, material) = (scene.add_shape(shape), scene.add_material(glowing(two_sided)));
    scene.add_instance(shape, material, placement);
    built(scene)
}

fn mesh(name: &str, parameters: &str, corners: &[Vec3], faces: &[[u32; 3]], from: Vec3) -> Option<Routine> {
    let shape = Shape::Mesh(TriangleMesh::new(corners.to_vec(), faces.to_vec()));
    let middle = corners.iter().sum::<Vec3>() / corners.len() as f32;
    let two_sided = parameters.contains("behind");
    toward(name, parameters, alone(shape, two_sided, Affine3A::IDENTITY), from, middle - from)
}

fn flat() -> Vec<Option<Routine>> {
    let corner = Vec3::new(-0.5, 1.0, -0.4);
    let quad =
        |edges: [Vec3; 2]| [corner, corner + edges[0], corner + edges[0] + edges[1], corner + edges[1]];
    let right = quad([Vec3::new(1.0, 0.25, 0.0), Vec3::new(0.0, 0.0, 0.75)]);
    let long = quad([Vec3::new(4.0, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.5)]);
    let skew = quad([Vec3::new(1.0, 0.25, 0.5), Vec3::new(0.25, 0.0, 0.75)]);
    let halves = [[0, 1, 2], [2, 3, 0]];
    let triangle = [Vec3::new(-0.5, 1.0, -0.4), Vec3::new(0.7, 1.1, -0.3), Vec3::new(-0.1, 0.9, 0.8)];
    let (near, far) = (Vec3::new(0.1, 0.0, 0.2), Vec3::new(3.0, -12.0, 5.0));
    let one = [[0, 1, 2]];
    vec![
        mesh("triangle", "near, by solid angle", &triangle, &one, near),
        mesh("triangle", "very near, by solid angle", &triangle, &one, Vec3::new(0.05, 0.95, 0.05)),
        mesh("triangle", "at a flat angle, by solid angle", &triangle, &one, Vec3::new(0.8, 0.85, 0.6)),
        mesh("triangle", "far, by area", &triangle, &one, far),
        mesh("triangle", "behind its two sides", &triangle, &one, Vec3::new(0.2, 2.2, 0.1)),
        mesh("rectangle", "near, by solid angle", &right, &halves, near),
        mesh("rectangle", "very near, by solid angle", &right, &halves, Vec3::new(-0.2, 0.95, 0.05)),
        mesh("rectangle", "long, by solid angle", &long, &halves, Vec3::new(1.0, -1.0, 0.1)),
        mesh("rectangle", "far, by area", &right, &halves, far),
        mesh("rectangle", "behind its two sides", &right, &halves, Vec3::new(0.2, 2.2, 0.1)),
        mesh("parallelogram", "near, by solid angle", &skew, &halves, near),
        mesh("parallelogram", "far, by area", &skew, &halves, far),
    ]
}

/// Lamps of eight triangles that do not hide one another.
fn octahedra() -> Vec<Option<Routine>> {
    let corners = [Vec3::X, Vec3::Y * 0.7, Vec3::Z * 1.3, Vec3::NEG_X * 0.8, Vec3::NEG_Y, Vec3::NEG_Z * 0.9];
    let faces = [[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]];
    vec![
        mesh("mesh", "octahedron, near", &corners, &faces, Vec3::new(0.4, 0.9, 1.1)),
        mesh("mesh", "octahedron, far", &corners, &faces, Vec3::new(-5.0, 9.0, 4.0)),
    ]
}

fn round() -> Vec<Option<Routine>> {
    let center = Vec3::new(0.2, 0.5, -0.3);
    // A similarity: three times a sphere of radius 0.2.
    let placement =
        Affine3A::from_scale_rotation_translation(Vec3::splat(3.0), Quat::from_rotation_x(1.0), center);
    let axis = Vec3::new(0.48, 0.6, 0.64);
    let ball = |parameters, from| {
        let shape = Shape::Sphere { radius: 0.2 };
        toward("sphere", parameters, alone(shape, true, placement), from, center - from)
    };
    let disc = |parameters, from: Vec3| {
        let shape = Shape::Disc { radius: 0.5 };
        let world = alone(shape, from.y < 0.0, Affine3A::from_scale(Vec3::splat(2.0)));
        toward("disc", parameters, world, from, -from)
    };
    vec![
        ball("near, by solid angle", center - axis * 1.2),
        ball("very near, by solid angle", center - axis * 0.61),
        ball("far, by solid angle", center - axis * 40.0),
        ball("from inside, by area", center + Vec3::new(0.2, 0.1, -0.25)),
        disc("near, by area", Vec3::new(0.3, 0.2, 0.1)),
        disc("aside, by area", Vec3::new(1.6, 0.8, -0.4)),
        disc("far, by area", Vec3::new(3.0, 30.0, -5.0)),
        disc("behind its two sides", Vec3::new(0.1, -1.0, 0.2)),
    ]
}

pub(super) fn routines() -> Vec<Routine> {
    [flat(), octahedra(), round()].into_iter().flatten().flatten().collect()
}
