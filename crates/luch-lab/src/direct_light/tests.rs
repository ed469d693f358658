//! Known fractions and irradiances.

use super::*;
use crate::integral::SequencePoints;
use glam::{Affine3A, Mat3, Quat};
use luch_image::{Bitmap, Image, Rgb};
use luch_mesh::TriangleMesh;
use luch_sampling::Sequence;
use luch_scene::{Camera, Emission, Environment, Id, Light, Material, Shape, Surface};

const POINTS: SequencePoints = SequencePoints { sequence: Sequence::Sobol, seed: 4 };

fn lamp(radiance: f32) -> Material {
    let emission = Some(Emission { radiance: Rgb::gray(radiance).into(), two_sided: false });
    Material { emission, ..Material::new(Surface::Absorber) }
}

/// A rectangle that faces down.
fn ceiling(scene: &mut Scene, low: [f32; 2], high: [f32; 2], height: f32, material: Material) {
    let corner = |x: f32, z: f32| Vec3::new(x, height, z);
    let corners = vec![
        corner(low[0], low[1]),
        corner(high[0], low[1]),
        corner(high[0], high[1]),
        corner(low[0], high[1]),
    ];
    let shape = scene.add_shape(Shape::Mesh(TriangleMesh::new(corners, vec![[0, 1, 2], [0, 2, 3]])));
    let material = scene.add_material(material);
    scene.add_instance(shape, material, Affine3A::IDENTITY);
}

fn built(mut scene: Scene) -> World {
    scene.add_camera(Camera::looking_at(Vec3::ZERO, Vec3::X, Vec3::Y, 1.0));
    World::build(scene).unwrap()
}

fn asked(world: &World, at: Vec3, samples: u64) -> DirectLight {
    direct_light(world, &Query { at, normal: Vec3::Y * 3.0, samples, points: &POINTS }, &|_| true, &|_, _| {})
}

fn expect(found: Measured, truth: f64, what: &str) {
    let off = (found.mean - truth).abs();
    assert!(off <= 4.0 * found.standard_error + 2e-6 * truth.abs(), "{what}: {found:?}, expected {truth}");
    assert!(found.standard_error <= 0.01 * truth + 1e-9, "{what}: {found:?} is too noisy to tell");
}

#[test]
fn a_rectangle_behind_a_half_plane() {
    let mut scene = Scene::default();
    ceiling(&mut scene, [-1.0, -0.5], [1.0, 0.5], 3.0, lamp(2.0));
    ceiling(&mut scene, [-1e4, -1e4], [0.0, 1e4], 1.0, Material::new(Surface::Absorber));
    let world = built(scene);
    // Ground truth 4.4 (a): visible fraction and form factor of what is visible.
    for (p, fraction, factor) in [
        (-0.5, 0.0, 0.0),
        (-0.25, 0.25, 0.014_066_780),
        (0.0, 0.5, 0.032_408_078),
        (0.2, 0.7, 0.046_860_819),
        (0.5, 1.0, 0.062_095_951),
    ] {
        let found = asked(&world, Vec3::X * p, 1 << 16);
        assert_eq!(found.lamps.len(), 1);
        let seen = &found.lamps[0];
        assert!((seen.area.unwrap() - 2.0).abs() < 1e-9 && seen.kind == LampKind::Surface);
        expect(seen.visible.unwrap(), fraction, "visible fraction");
        expect(seen.irradiance, 2.0 * std::f64::consts::PI * factor, "irradiance");
        assert_eq!(found.total, seen.irradiance);
    }
}

#[test]
fn lamps_of_all_kinds_add_up() {
    let mut scene = Scene::default();
    let material = scene.add_material(lamp(1.0));
    let sphere = scene.add_shape(Shape::Sphere { radius: 0.5 });
    let up = Affine3A::from_scale_rotation_translation(Vec3::splat(2.0), Quat::IDENTITY, Vec3::Y * 3.0);
    scene.add_instance(sphere, material, up);
    let disc = scene.add_shape(Shape::Disc { radius: 1.0 });
    let placement = Affine3A::from_rotation_translation(
        Quat::from_rotation_x(std::f32::consts::PI),
        Vec3::new(0.0, 1.5, 50.0),
    );
    scene.add_instance(disc, material, placement);
    scene.instances[1].name = "far disc".into();
    scene.lights.push(Light::Point { position: Vec3::new(9.0, 2.0, 0.0), intensity: Rgb::gray(5.0) });
    let direction = Vec3::new(0.6, -0.8, 0.0);
    scene.lights.push(Light::Sun { direction, irradiance: Rgb::gray(3.0), angular_radius: 0.01 });
    let world = built(scene);
    assert_eq!(names(&world.scene), ["object 1", "far disc", "point 1", "sun 2"]);
    let found = asked(&world, Vec3::ZERO, 1 << 14);
    let lamps = &found.lamps;
    // Ground truth 4.3: a sphere overhead, s² = 1/9; of its area the part within the cone is seen, (1 − s)/2.
    expect(lamps[0].irradiance, std::f64::consts::PI / 9.0, "sphere");
    expect(lamps[0].visible.unwrap(), 1.0 / 3.0, "sphere");
    let cosine = 2.0 / 85f64.sqrt();
    expect(lamps[2].irradiance, 5.0 * cosine / 85.0, "point");
    expect(lamps[3].irradiance, 3.0 * 0.8, "sun");
    expect(lamps[2].visible.unwrap(), 1.0, "point");
    let sum: f64 = lamps.iter().map(|lamp| lamp.irradiance.mean).sum();
    assert!((found.total.mean - sum).abs() < 1e-6 * sum);
    let one = Query { at: Vec3::ZERO, normal: Vec3::Y, samples: 64, points: &POINTS };
    let only = direct_light(&world, &one, &|name| name == "far disc", &|_, _| {});
    assert_eq!(only.lamps.len(), 1);
}

#[test]
fn the_sky_beside_a_wall() {
    let wall = |scene: &mut Scene| {
        let corners = [[-1.0, 0.0, -1e4], [-1.0, 0.0, 1e4], [-1.0, 1.0, 1e4], [-1.0, 1.0, -1e4]];
        let mesh = TriangleMesh::new(corners.map(Vec3::from_array).to_vec(), vec![[0, 1, 2], [0, 2, 3]]);
        let (shape, material) =
            (scene.add_shape(Shape::Mesh(mesh)), scene.add_material(Material::new(Surface::Absorber)));
        scene.add_instance(shape, material, Affine3A::IDENTITY);
    };
    // Ground truth 4.4 (e).
    let open = 0.853_553_391;
    let mut scene = Scene::default();
    wall(&mut scene);
    scene.environment = Some(Environment::Constant { radiance: Rgb::gray(2.0) });
    let found = asked(&built(scene), Vec3::ZERO, 1 << 16);
    expect(found.lamps[0].visible.unwrap(), open, "even sky");
    expect(found.total, 2.0 * std::f64::consts::PI * open, "even sky");
    // A picture that is bright in one place, which is drawn by its brightness, adds nothing to what is hidden.
    let mut scene = Scene::default();
    wall(&mut scene);
    let pixels = (0..16 * 8).map(|at| Rgb::gray(if at == 37 { 40.0 } else { 0.5 })).collect();
    scene.add_image(Bitmap::from_rgb(&Image::from_pixels(16, 8, pixels).unwrap()));
    let (image, rotation) = (Id::new(0), Mat3::IDENTITY);
    scene.environment = Some(Environment::LatLong { image, scale: Rgb::gray(1.0), rotation });
    let (some, many) =
        (asked(&built(scene.clone()), Vec3::ZERO, 1 << 13), asked(&built(scene), Vec3::ZERO, 1 << 17));
    assert!(some.total.standard_error < 0.02 * some.total.mean, "{some:?}");
    let error = libm::hypot(some.total.standard_error, many.total.standard_error);
    assert!((some.total.mean - many.total.mean).abs() < 4.0 * error);
}
