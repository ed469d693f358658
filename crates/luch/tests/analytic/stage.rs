//! Things that scenes are made of.

use glam::{Affine3A, Quat, Vec3};
use luch::prelude::*;
use luch::scene::preset::parallelogram;
use luch::scene::{Environment, Surface};

/// A gray Lambertian material.
pub(crate) fn gray(albedo: f32) -> Material {
    Material::diffuse(Rgb::gray(albedo))
}

/// A lamp of radiance `radiance` that reflects nothing.
pub(crate) fn lamp(radiance: f32) -> Material {
    Material::emitter(Rgb::gray(radiance))
}

/// Swallows everything.
pub(crate) fn black() -> Material {
    Material::new(Surface::Absorber)
}

/// Puts a shape of one material into a scene.
pub(crate) fn put(scene: &mut Scene, shape: Shape, material: Material, placement: Affine3A) {
    let shape = scene.add_shape(shape);
    let material = scene.add_material(material);
    scene.add_instance(shape, material, placement);
}

/// The plane y = 0 with a gray top.
pub(crate) fn floor(scene: &mut Scene, albedo: f32) {
    put(scene, Shape::Plane, gray(albedo), Affine3A::IDENTITY);
}

/// A horizontal rectangle from `low` to `high` in x and z, at a height, that faces downward.
pub(crate) fn ceiling(scene: &mut Scene, low: [f32; 2], high: [f32; 2], height: f32, material: Material) {
    let corner = Vec3::new(low[0], height, low[1]);
    let mesh = parallelogram(corner, Vec3::X * (high[0] - low[0]), Vec3::Z * (high[1] - low[1]));
    put(scene, Shape::Mesh(mesh), material, Affine3A::IDENTITY);
}

/// A placement that turns a disc or plane to face downward at `center`.
pub(crate) fn facing_down(center: Vec3) -> Affine3A {
    Affine3A::from_rotation_translation(Quat::from_rotation_x(std::f32::consts::PI), center)
}

/// Surrounds a scene with radiance `radiance`.
pub(crate) fn surround(scene: &mut Scene, radiance: f32) {
    scene.environment = Some(Environment::Constant { radiance: Rgb::gray(radiance) });
}

/// The world of a scene. It must have a camera, whichever is used to look.
pub(crate) fn world(mut scene: Scene) -> World {
    scene.add_camera(Camera::looking_at(Vec3::ZERO, Vec3::X, Vec3::Y, 1.0));
    World::build(scene).expect("the scene is sound")
}
