//! Things that the scenes of the cases are made of.

use glam::{Affine3A, Quat, Vec3};
use luch_image::Rgb;
use luch_scene::preset::parallelogram;
use luch_scene::{Camera, Environment, Material, Scene, Shape, Surface};

/// A gray Lambertian material.
pub fn gray(albedo: f32) -> Material {
    Material::diffuse(Rgb::gray(albedo))
}

/// A lamp of radiance `radiance` that reflects nothing.
pub fn lamp(radiance: f32) -> Material {
    Material::emitter(Rgb::gray(radiance))
}

/// Swallows everything.
pub fn black() -> Material {
    Material::new(Surface::Absorber)
}

/// Puts a shape of one material into a scene.
pub fn put(scene: &mut Scene, shape: Shape, material: Material, placement: Affine3A) {
    let shape = scene.add_shape(shape);
    let material = scene.add_material(material);
    scene.add_instance(shape, material, placement);
}

/// The plane y = 0 with a gray top.
pub fn floor(scene: &mut Scene, albedo: f32) {
    put(scene, Shape::Plane, gray(albedo), Affine3A::IDENTITY);
}

/// A horizontal rectangle from `low` to `high` in x and z, at a height, that faces downward.
pub fn ceiling(scene: &mut Scene, low: [f32; 2], high: [f32; 2], height: f32, material: Material) {
    let corner = Vec3::new(low[0], height, low[1]);
    let mesh = parallelogram(corner, Vec3::X * (high[0] - low[0]), Vec3::Z * (high[1] - low[1]));
    put(scene, Shape::Mesh(mesh), material, Affine3A::IDENTITY);
}

/// A placement that turns a disc or plane to face downward at `center`.
pub fn facing_down(center: Vec3) -> Affine3A {
    Affine3A::from_rotation_translation(Quat::from_rotation_x(std::f32::consts::PI), center)
}

/// Surrounds a scene with radiance `radiance`.
pub fn surround(scene: &mut Scene, radiance: f32) {
    scene.environment = Some(Environment::Constant { radiance: Rgb::gray(radiance) });
}

/// A camera that looks at a point so narrowly that radiance is constant over the film.
pub fn aimed(eye: Vec3, target: Vec3) -> Camera {
    Camera::looking_at(eye, target, Vec3::Y, 1e-4)
}

/// [`aimed`] at a point of the plane y = 0 from so near that nothing stands between.
pub fn aimed_at_floor(x: f32, z: f32) -> Camera {
    aimed(Vec3::new(x + 0.02, 0.1, z + 0.03), Vec3::new(x, 0.0, z))
}

/// A half-plane of radiance 1 at `z` that faces +Z: the points whose product with (cos `angle`, sin `angle`) exceeds `offset`.
pub fn half_plane(angle: f32, offset: f32, z: f32) -> Scene {
    let (sin, cos) = libm::sincosf(angle);
    let (normal, along) = (Vec3::new(cos, sin, 0.0), Vec3::new(-sin, cos, 0.0));
    let corner = normal * offset - along * 500.0 + Vec3::Z * z;
    let mut scene = Scene::default();
    let mesh = parallelogram(corner, normal * 500.0, along * 1000.0);
    put(&mut scene, Shape::Mesh(mesh), lamp(1.0), Affine3A::IDENTITY);
    scene
}
