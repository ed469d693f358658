//! Paths of a bundle help one another; the mean of what they find is that of paths alone, whatever surfaces are made of.

use glam::{Affine3A, Vec3};
use luch_image::Rgb;
use luch_mesh::{TriangleMesh, generate};
use luch_render::{Film, PathTracer, Stop, View, World, render_pass};
use luch_scene::preset::parallelogram;
use luch_scene::{
    Camera, Environment, Light, Material, Metal, Principled, Reflectance, Scene, Shape, Surface,
};
use std::sync::atomic::AtomicU64;

/// Largest distance of both means in standard errors.
const DISTANCE: f64 = 4.0;
/// Largest standard error of either mean, as part of it.
const DEMANDED: f64 = 0.008;

fn conductor(roughness: f32, compensated: bool) -> Material {
    let reflectance = Reflectance::Metal(Metal::Gold);
    Material::new(Surface::Conductor { reflectance, roughness: roughness.into(), compensated })
}

/// Surfaces of every kind of scattering.
fn surfaces() -> Vec<(&'static str, Material)> {
    let plastic = Principled { base_color: Rgb::new(0.7, 0.3, 0.2).into(), ..Principled::default() };
    let thin = Principled { transmission: 0.6.into(), thin_walled: true, ..plastic.clone() };
    let dielectric = |roughness: f32| Surface::Dielectric {
        ior: 1.5,
        roughness: roughness.into(),
        tint: Rgb::WHITE.into(),
    };
    let phong = Surface::Phong {
        diffuse: Rgb::gray(0.4).into(),
        specular: Rgb::gray(0.5).into(),
        exponent: 30.0.into(),
    };
    vec![
        ("diffuse", Material::diffuse(Rgb::new(0.8, 0.5, 0.3))),
        ("rough metal of one bounce", conductor(0.6, false)),
        ("polished metal of one bounce", conductor(0.2, false)),
        ("rough metal", conductor(0.6, true)),
        ("mirror", conductor(0.0, true)),
        ("plastic", Material::new(Surface::Principled(plastic))),
        ("film", Material::new(Surface::Principled(thin))),
        ("ground glass", Material::new(dielectric(0.5))),
        ("clear glass", Material::new(dielectric(0.0))),
        ("phong", Material::new(phong)),
        ("glossy", Material::new(Surface::Glossy { color: Rgb::gray(0.8).into(), glossiness: 0.8.into() })),
    ]
}

/// What lights a room.
#[derive(Clone, Copy, Debug)]
enum Lighting {
    /// A lamp that has two sides, near a wall, and a smaller one.
    Lamps,
    /// A glowing ball, which bundles do not sample together.
    Ball,
    /// A point and the sky.
    PointAndSky,
}

/// An open room whose floor is of one material and what stands in it of another.
fn room(floor: &Material, body: &Material, lighting: Lighting) -> Scene {
    let mut scene = Scene::default();
    let white = scene.add_material(Material::diffuse(Rgb::gray(0.7)));
    let floor = scene.add_material(floor.clone());
    let body = scene.add_material(body.clone());
    let mut put = |mesh: TriangleMesh, material| {
        let shape = scene.add_shape(Shape::Mesh(mesh));
        scene.add_instance(shape, material, Affine3A::IDENTITY);
    };
    put(parallelogram(Vec3::new(-1.0, 0.0, 1.0), 2.0 * Vec3::X, -2.0 * Vec3::Z), floor);
    put(parallelogram(Vec3::new(-1.0, 0.0, -1.0), 2.0 * Vec3::X, 2.0 * Vec3::Y), white);
    put(parallelogram(Vec3::new(-1.0, 0.0, 1.0), -2.0 * Vec3::Z, 2.0 * Vec3::Y), white);
    let shape = scene.add_shape(Shape::Mesh(generate::cuboid(Vec3::splat(0.6), [1; 3])));
    let place = Affine3A::from_translation(Vec3::new(0.1, 0.45, -0.1)) * Affine3A::from_rotation_y(0.5);
    scene.add_instance(shape, body, place * Affine3A::from_rotation_x(0.3));
    let lamp = |scene: &mut Scene, radiance: f32, shape: Shape, place: Vec3| {
        let mut lamp = Material::emitter(Rgb::new(1.0, 0.9, 0.8) * radiance);
        lamp.surface = Surface::Diffuse { color: Rgb::gray(0.5).into() };
        if let Some(emission) = &mut lamp.emission {
            emission.two_sided = true;
        }
        let (material, shape) = (scene.add_material(lamp), scene.add_shape(shape));
        scene.add_instance(shape, material, Affine3A::from_translation(place));
    };
    let sheet = |side: f32| Shape::Mesh(parallelogram(Vec3::ZERO, side * Vec3::X, side * Vec3::Z));
    match lighting {
        Lighting::Lamps => {
            lamp(&mut scene, 6.0, sheet(0.7), Vec3::new(-0.9, 1.2, -0.6));
            lamp(&mut scene, 40.0, sheet(0.2), Vec3::new(0.7, 0.9, 0.3));
        }
        Lighting::Ball => lamp(&mut scene, 20.0, Shape::Sphere { radius: 0.2 }, Vec3::new(0.5, 1.4, 0.2)),
        Lighting::PointAndSky => {
            let (position, intensity) = (Vec3::new(0.6, 1.2, 0.8), Rgb::gray(2.0));
            scene.lights.push(Light::Point { position, intensity });
            scene.environment = Some(Environment::Constant { radiance: Rgb::new(0.3, 0.4, 0.5) });
        }
    }
    scene.add_camera(Camera::looking_at(Vec3::new(0.8, 1.1, 2.6), Vec3::new(0.0, 0.4, 0.0), Vec3::Y, 0.6));
    (scene.settings.width, scene.settings.height) = (16, 16);
    scene
}

/// Mean and standard error of the picture's green, with as many samples as it takes.
fn measure(scene: &Scene, reuse: bool) -> (f64, f64) {
    let mut scene = scene.clone();
    scene.settings.seed = u64::from(reuse);
    let view = View::new(&scene.cameras[0].camera, &scene.settings);
    let world = World::build(scene).unwrap();
    let integrator = PathTracer { max_depth: 6, reuse };
    let mut film = Film::new(view.width(), view.height());
    let mut count = 128;
    loop {
        let progress = AtomicU64::new(0);
        render_pass(&world, &view, &integrator, &mut film, 0..count, &Stop::new(), &progress).unwrap();
        let estimate = film.mean().unwrap();
        let (mean, error) = (estimate.mean[1], estimate.standard_error[1]);
        if error <= DEMANDED * mean || count == 1 << 14 {
            return (mean, error);
        }
        count *= 2;
    }
}

fn compare(what: &str, scene: &Scene) {
    let (alone, alone_error) = measure(scene, false);
    let (together, together_error) = measure(scene, true);
    let error = (alone_error * alone_error + together_error * together_error).sqrt();
    assert!(error < 2.0 * DEMANDED * alone, "{what}: the test is too coarse: {alone} ± {error}");
    let z = (together - alone) / error;
    assert!(z.abs() < DISTANCE, "{what}: {together} together, {alone} alone, {z:.1} standard errors apart");
}

#[test]
fn first_points_of_every_kind() {
    let gray = Material::diffuse(Rgb::gray(0.5));
    for (name, material) in surfaces() {
        compare(&format!("{name} floor by lamps"), &room(&material, &gray, Lighting::Lamps));
    }
}

#[test]
fn second_points_of_every_kind() {
    let gray = Material::diffuse(Rgb::gray(0.5));
    for (name, material) in surfaces() {
        compare(&format!("{name} body by lamps"), &room(&gray, &material, Lighting::Lamps));
    }
}

#[test]
fn first_and_second_points_without_lamps_to_share() {
    for (name, material) in surfaces() {
        for lighting in [Lighting::Ball, Lighting::PointAndSky] {
            compare(&format!("{name} by {lighting:?}"), &room(&material, &material, lighting));
        }
    }
}
