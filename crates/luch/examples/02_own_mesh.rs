//! A mesh of your own, made point by point, in the sun.
//!
//! `cargo run --release -p luch --example 02_own_mesh -- mesh.png`

use glam::{Affine3A, Vec3};
use luch::mesh::TriangleMesh;
use luch::prelude::*;
use luch::scene::{Environment, Light};
use std::path::PathBuf;
use std::sync::atomic::AtomicU64;

/// A pyramid on a square; corners run counter-clockwise seen from outside.
fn pyramid() -> TriangleMesh {
    let positions = vec![
        Vec3::new(-1.0, 0.0, 1.0),
        Vec3::new(1.0, 0.0, 1.0),
        Vec3::new(1.0, 0.0, -1.0),
        Vec3::new(-1.0, 0.0, -1.0),
        Vec3::new(0.0, 1.4, 0.0),
    ];
    TriangleMesh::new(positions, vec![[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [2, 1, 0], [3, 2, 0]])
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).map_or_else(|| "mesh.png".into(), PathBuf::from);

    let mut scene = Scene::default();
    let stone = scene.add_material(Material::diffuse(Rgb::new(0.7, 0.55, 0.35)));
    let shape = scene.add_shape(Shape::Mesh(pyramid()));
    scene.add_instance(shape, stone, Affine3A::from_rotation_y(0.4));
    let grass = scene.add_material(Material::diffuse(Rgb::new(0.25, 0.35, 0.12)));
    let ground = scene.add_shape(Shape::Plane);
    scene.add_instance(ground, grass, Affine3A::IDENTITY);
    scene.environment = Some(Environment::Constant { radiance: Rgb::new(0.2, 0.3, 0.5) });
    let direction = Vec3::new(0.6, -0.5, -0.4).normalize();
    scene.lights.push(Light::Sun { direction, irradiance: Rgb::gray(3.0), angular_radius: 0.005 });
    scene.add_camera(Camera::looking_at(Vec3::new(0.0, 1.5, 4.5), 0.5 * Vec3::Y, Vec3::Y, 0.7));
    (scene.settings.width, scene.settings.height) = (320, 240);

    let view = View::new(&scene.cameras[0].camera, &scene.settings);
    let world = World::build(scene)?;
    let mut film = Film::new(view.width(), view.height());
    render_pass(&world, &view, &PathTracer::default(), &mut film, 0..32, &Stop::new(), &AtomicU64::new(0))?;
    save_image(&path, &film.to_image(), &Default::default(), &Default::default())?;
    Ok(())
}
