//! Scenes made in code, for tests, examples and benchmarks.

use crate::{Camera, Environment, Material, Scene, Shape};
use glam::{Affine3A, Vec3};
use luch_image::Rgb;
use luch_mesh::TriangleMesh;

/// A parallelogram of two triangles: `corner`, and the two edges that leave it. It faces along `first × second`.
pub fn parallelogram(corner: Vec3, first: Vec3, second: Vec3) -> TriangleMesh {
    TriangleMesh::new(
        vec![corner, corner + first, corner + first + second, corner + second],
        vec![[0, 1, 2], [0, 2, 3]],
    )
}

/// The box of six parallelograms that stands on a base: `corner` below, `first` and `second` along the floor, `up` upward.
fn block(corner: Vec3, first: Vec3, second: Vec3, up: Vec3) -> TriangleMesh {
    let p = |a: f32, b: f32, c: f32| corner + first * a + second * b + up * c;
    let positions = (0..8).map(|i| p((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2 & 1) as f32)).collect();
    // With `first × second` pointing along `up`.
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    TriangleMesh::new(positions, triangles)
}

/// A box in the style of Cornell: white, red and green walls, two blocks and a lamp in the ceiling.
///
/// It spans −1 to 1 in x and z and 0 to 2 in y and is open toward +Z, where the camera stands.
pub fn cornell_box() -> Scene {
    let mut scene = Scene::default();
    let white = scene.add_material(Material::diffuse(Rgb::gray(0.73)));
    let red = scene.add_material(Material::diffuse(Rgb::new(0.63, 0.06, 0.05)));
    let green = scene.add_material(Material::diffuse(Rgb::new(0.14, 0.45, 0.09)));
    let lamp = scene.add_material(Material::emitter(Rgb::new(17.0, 12.0, 4.0)));
    let (x, y, z) = (Vec3::X, Vec3::Y, Vec3::Z);
    let parts = [
        (parallelogram(-x - z, 2.0 * z, 2.0 * x), white),
        (parallelogram(-x - z + 2.0 * y, 2.0 * x, 2.0 * z), white),
        (parallelogram(-x - z, 2.0 * x, 2.0 * y), white),
        (parallelogram(-x - z, 2.0 * y, 2.0 * z), red),
        (parallelogram(x - z, 2.0 * z, 2.0 * y), green),
        (parallelogram(Vec3::new(-0.25, 1.999, -0.25), 0.5 * x, 0.5 * z), lamp),
        (
            block(
                Vec3::new(-0.72, 0.0, -0.28),
                Vec3::new(0.57, 0.0, 0.17),
                Vec3::new(0.17, 0.0, -0.57),
                1.2 * y,
            ),
            white,
        ),
        (
            block(
                Vec3::new(0.03, 0.0, 0.55),
                Vec3::new(0.57, 0.0, 0.17),
                Vec3::new(0.17, 0.0, -0.57),
                0.6 * y,
            ),
            white,
        ),
    ];
    for (mesh, material) in parts {
        let shape = scene.add_shape(Shape::Mesh(mesh));
        scene.add_instance(shape, material, Affine3A::IDENTITY);
    }
    scene.add_camera(Camera::looking_at(Vec3::new(0.0, 1.0, 4.9), Vec3::new(0.0, 1.0, 0.0), Vec3::Y, 0.5));
    scene.settings.width = 256;
    scene.settings.height = 256;
    scene
}

/// A closed sphere of radius 1, seen from within, that reflects `albedo` and emits `radiance` everywhere.
///
/// Every pixel is `radiance / (1 − albedo)` (ground truth F1).
pub fn furnace(albedo: Rgb, radiance: Rgb) -> Scene {
    let mut scene = Scene::default();
    let mut material = Material::diffuse(albedo);
    material.emission = Some(crate::Emission { radiance: radiance.into(), two_sided: true });
    let material = scene.add_material(material);
    let shape = scene.add_shape(Shape::Sphere { radius: 1.0 });
    scene.add_instance(shape, material, Affine3A::IDENTITY);
    scene.add_camera(Camera::looking_at(Vec3::new(0.2, 0.1, 0.3), Vec3::new(1.0, 0.3, -0.2), Vec3::Y, 1.2));
    scene.settings.width = 8;
    scene.settings.height = 8;
    scene
}

/// One shape of one material in a uniform environment of radiance 1, filling most of the picture.
pub fn material_ball(shape: Shape, material: Material) -> Scene {
    let mut scene = Scene::default();
    let material = scene.add_material(material);
    let shape = scene.add_shape(shape);
    scene.add_instance(shape, material, Affine3A::IDENTITY);
    scene.environment = Some(Environment::Constant { radiance: Rgb::WHITE });
    scene.add_camera(Camera::looking_at(Vec3::new(0.0, 0.0, 4.0), Vec3::ZERO, Vec3::Y, 0.5));
    scene.settings.width = 16;
    scene.settings.height = 16;
    scene
}
