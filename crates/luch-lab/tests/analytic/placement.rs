//! An instance is the same as its mesh put into the world by hand.

use super::world;
use glam::{Affine3A, EulerRot, Mat3, Quat, Vec3};
use luch_image::Rgb;
use luch_lab::truth::measure::{pixels_over_seeds, settings};
use luch_lab::truth::stage::{floor, gray, lamp, put, surround};
use luch_mesh::{TriangleMesh, generate};
use luch_render::World;
use luch_sampling::{Estimate, Sequence};
use luch_scene::{Camera, Integrator as Name, Material, Reflectance, Scene, Shape, Surface};

/// Turned, moved, stretched; `mirrored` turns it inside out as well.
fn placement(mirrored: bool) -> Affine3A {
    let scale = Vec3::new(if mirrored { -1.3 } else { 1.3 }, 0.7, 1.1);
    let turned = Mat3::from_quat(Quat::from_euler(EulerRot::XYZ, 0.5, 0.4, 0.3)) * Mat3::from_diagonal(scale);
    Affine3A::from_mat3_translation(turned, Vec3::new(0.2, 1.0, -0.3))
}

/// The scene around it; `things` with their placements.
fn scene(things: Vec<(TriangleMesh, Material, Affine3A)>) -> World {
    let mut scene = Scene::default();
    floor(&mut scene, 0.5);
    surround(&mut scene, 0.2);
    put(
        &mut scene,
        Shape::Sphere { radius: 0.6 },
        lamp(9.0),
        Affine3A::from_translation(Vec3::new(1.0, 3.0, 2.0)),
    );
    for (mesh, material, placement) in things {
        put(&mut scene, Shape::Mesh(mesh), material, placement);
    }
    world(scene)
}

fn baked(mesh: &TriangleMesh, placement: &Affine3A) -> TriangleMesh {
    let mut mesh = mesh.clone();
    mesh.transform(placement);
    mesh
}

/// Both worlds must look alike within their errors, pixel by pixel and as a whole.
#[track_caller]
fn expect_alike(what: &str, one: &World, other: &World) {
    const SEEDS: u64 = 24;
    let camera = Camera::looking_at(Vec3::new(0.5, 2.5, 4.0), Vec3::new(0.2, 0.9, -0.3), Vec3::Y, 0.6);
    let film = |world: &World, sequence: Sequence, way: Name| {
        pixels_over_seeds(world, &camera, &settings(6, 6, sequence, 0), way, 48, SEEDS).unwrap()
    };
    let way = Name::Path { max_depth: 4 };
    // Different sequences, so that the two are independent.
    let (a, b) = (film(one, Sequence::Sobol, way), film(other, Sequence::Halton, way));
    let (mut total, mut variance, mut light) = (0.0, 0.0, 0.0);
    for (i, (a, b)) in a.iter().zip(&b).enumerate() {
        let off = a.mean().unwrap() - b.mean().unwrap();
        let square = |e: &Estimate| e.standard_error().unwrap() * e.standard_error().unwrap();
        let squared = square(a) + square(b);
        assert!(
            off.abs() <= 4.0 * squared.sqrt() + 1e-5,
            "{what}: pixel {i} differs by {off} ± {}",
            squared.sqrt()
        );
        total += off;
        variance += squared;
        light += a.mean().unwrap();
    }
    let error = variance.sqrt();
    assert!(total.abs() <= 4.0 * error, "{what}: the pictures differ by {total} ± {error}");
    assert!(error <= 0.005 * light, "{what}: the error {error} of {light} is too large to tell");
}

#[test]
fn a_placed_mesh_looks_like_one_in_place_mirrored_or_not() {
    let mesh = generate::torus(0.7, 0.3, 20, 10);
    let gold = || {
        let reflectance = Reflectance::Color(Rgb::new(0.9, 0.6, 0.3).into());
        Material::new(Surface::Conductor { reflectance, roughness: 0.6.into(), compensated: true })
    };
    for mirrored in [false, true] {
        let placement = placement(mirrored);
        for (name, material) in [("diffuse", gray(0.7)), ("gold", gold())] {
            let placed = scene(vec![(mesh.clone(), material.clone(), placement)]);
            let in_place = scene(vec![(baked(&mesh, &placement), material, Affine3A::IDENTITY)]);
            expect_alike(name, &placed, &in_place);
        }
    }
}

#[test]
fn a_placed_lamp_shines_like_one_in_place_mirrored_or_not() {
    // Open, so that front and back matter.
    let mesh = generate::cone(0.6, 0.3, 0.8, 12, 1, false);
    for mirrored in [false, true] {
        let placement = placement(mirrored);
        let placed = scene(vec![(mesh.clone(), lamp(3.0), placement)]);
        let in_place = scene(vec![(baked(&mesh, &placement), lamp(3.0), Affine3A::IDENTITY)]);
        expect_alike("lamp", &placed, &in_place);
    }
}

#[test]
fn many_instances_of_one_mesh_look_like_one_mesh_of_many() {
    let mesh = generate::cuboid(Vec3::splat(0.5), [1, 1, 1]);
    let places: Vec<Affine3A> = (0..5)
        .map(|i| {
            let turned = Mat3::from_rotation_y(i as f32)
                * Mat3::from_diagonal(Vec3::new(1.0, 0.5 + 0.2 * i as f32, 1.0));
            Affine3A::from_mat3_translation(turned, Vec3::new(0.6 * i as f32 - 1.0, 0.6, -0.3 * i as f32))
        })
        .collect();
    let placed = {
        let mut scene = Scene::default();
        floor(&mut scene, 0.5);
        surround(&mut scene, 0.2);
        put(
            &mut scene,
            Shape::Sphere { radius: 0.6 },
            lamp(9.0),
            Affine3A::from_translation(Vec3::new(1.0, 3.0, 2.0)),
        );
        let (shape, material) = (scene.add_shape(Shape::Mesh(mesh.clone())), scene.add_material(gray(0.7)));
        for &place in &places {
            scene.add_instance(shape, material, place);
        }
        world(scene)
    };
    let mut all = TriangleMesh::default();
    for place in &places {
        all.append(&baked(&mesh, place), 0);
    }
    expect_alike("instances", &placed, &scene(vec![(all, gray(0.7), Affine3A::IDENTITY)]));
}
