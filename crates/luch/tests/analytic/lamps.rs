//! Ground truth F10, F12 and F14: lamps over a Lambert floor, by light sampling and BSDF sampling together, by BSDF sampling alone, and
//! by one scattering; each scene has one, so all agree.

use super::formulas::{disc, polygon, sphere};
use super::measure::{DIRECT, PATH, PLAIN, aimed, expect, expect_exactly, settings};
use super::stage::{ceiling, facing_down, floor, gray, lamp, put, world};
use glam::{Affine3A, DVec3, Mat3, Vec3};
use luch::prelude::*;
use luch::sampling::Sequence;
use luch::scene::preset::parallelogram;
use luch::scene::{Emission, Light, Projection};
use std::f32::consts::PI;

const ALBEDO: f32 = 0.6;
const RADIANCE: f32 = 5.0;

/// Looks at a point of the floor from so near that no lamp stands between.
fn at(x: f32, z: f32) -> Camera {
    aimed(Vec3::new(x + 0.02, 0.1, z + 0.03), Vec3::new(x, 0.0, z))
}

/// Every way must find the form factor `factor` at a point of the floor.
#[track_caller]
fn expect_factor(what: &str, world: &World, x: f32, z: f32, factor: f64) {
    let truth = f64::from(ALBEDO) * f64::from(RADIANCE) * factor;
    expect(&format!("{what} seen from ({x}, {z})"), world, &at(x, z), truth, &[PATH, PLAIN, DIRECT]);
}

fn over_floor(build: impl FnOnce(&mut Scene)) -> World {
    let mut scene = Scene::default();
    floor(&mut scene, ALBEDO);
    build(&mut scene);
    world(scene)
}

fn corners(corner: Vec3, first: Vec3, second: Vec3) -> [DVec3; 4] {
    [corner, corner + first, corner + first + second, corner + second].map(|p| p.as_dvec3())
}

#[test]
fn f10_sun_point_and_spot() {
    let towards = Vec3::new(0.48, 0.6, 0.64);
    let one = |light| over_floor(|scene| scene.lights.push(light));
    for angular_radius in [0.0, 0.01, 0.2] {
        let sun = one(Light::Sun { direction: -towards, irradiance: Rgb::gray(3.0), angular_radius });
        // A disc wholly above the horizon gives what its centre would: the vector irradiance of a cone lies along its axis.
        let truth = f64::from(ALBEDO * 3.0 * towards.y / PI);
        expect("sun", &sun, &at(0.3, 0.1), truth, &[PATH, DIRECT]);
        if angular_radius == 0.0 {
            expect_exactly("sun", &sun, &at(0.3, 0.1), truth, &[PATH, DIRECT]);
        }
    }
    let wide = one(Light::Sun { direction: -towards, irradiance: Rgb::gray(3.0), angular_radius: 0.4 });
    expect(
        "wide sun",
        &wide,
        &at(0.3, 0.1),
        f64::from(ALBEDO * 3.0 * towards.y / PI),
        &[PATH, PLAIN, DIRECT],
    );

    let place = Vec3::new(0.5, 2.0, -0.3);
    let way = place - Vec3::new(0.3, 0.0, 0.1);
    let truth = f64::from(ALBEDO * 7.0 * way.normalize().y / (PI * way.length_squared()));
    let point = one(Light::Point { position: place, intensity: Rgb::gray(7.0) });
    expect_exactly("point", &point, &at(0.3, 0.1), truth, &[PATH, DIRECT]);
    let spot = |inner_angle, outer_angle| Light::Spot {
        position: place,
        direction: Vec3::NEG_Y,
        intensity: Rgb::gray(7.0),
        inner_angle,
        outer_angle,
    };
    expect_exactly("spot", &one(spot(0.3, 0.5)), &at(0.3, 0.1), truth, &[PATH, DIRECT]);
    expect_exactly("beside the spot", &one(spot(0.05, 0.1)), &at(0.3, 0.1), 0.0, &[PATH, DIRECT]);
    let (low, high) = (libm::cos(0.8), libm::cos(0.1));
    let part = (f64::from(way.normalize().y) - low) / (high - low);
    expect_exactly(
        "rim of the spot",
        &one(spot(0.1, 0.8)),
        &at(0.3, 0.1),
        truth * part * part,
        &[PATH, DIRECT],
    );
}

#[test]
fn f12_a_lambert_sphere_with_the_sun_behind_the_viewer() {
    let mut scene = Scene::default();
    put(&mut scene, Shape::Sphere { radius: 1.0 }, gray(ALBEDO), Affine3A::IDENTITY);
    scene.lights.push(Light::Sun { direction: Vec3::NEG_Z, irradiance: Rgb::gray(2.0), angular_radius: 0.0 });
    let world = world(scene);
    let full = f64::from(ALBEDO * 2.0 / PI);
    for x in [0.0, 0.3, 0.7, 0.9] {
        let eye = Vec3::new(x, 0.0, 5.0);
        let cosine = (1.0 - f64::from(x) * f64::from(x)).sqrt();
        let camera = Camera {
            projection: Projection::Orthographic { height: 1e-5 },
            ..aimed(eye, Vec3::new(x, 0.0, 0.0))
        };
        expect("sphere", &world, &camera, full * cosine, &[PATH, DIRECT]);
    }
    // One pixel around the whole disc: two thirds of the full value on π/4 of the square.
    let eye =
        Camera { projection: Projection::Orthographic { height: 2.0 }, ..aimed(Vec3::Z * 5.0, Vec3::ZERO) };
    let like = settings(1, 1, Sequence::Sobol, 0);
    let estimate = &super::measure::pixels_over_seeds(&world, &eye, &like, DIRECT, 1024, 32)[0];
    let complaint = super::measure::complaint(estimate, full * 2.0 / 3.0 * std::f64::consts::FRAC_PI_4);
    assert!(complaint.is_none(), "{complaint:?}");
}

#[test]
fn f14_rectangle() {
    let world = over_floor(|scene| ceiling(scene, [-0.5, -0.5], [0.5, 0.5], 1.0, lamp(RADIANCE)));
    let lamp = corners(Vec3::new(-0.5, 1.0, -0.5), Vec3::X, Vec3::Z);
    for (x, z) in [(0.0, 0.0), (-0.7, 0.6), (1.2, 0.0)] {
        let factor = polygon(DVec3::new(f64::from(x), 0.0, f64::from(z)), DVec3::Y, &lamp);
        expect_factor("rectangle", &world, x, z, factor);
    }
}

#[test]
fn f14_rectangle_near_the_floor_standing_and_cut_by_the_horizon() {
    let near = over_floor(|scene| ceiling(scene, [-2.0, -1.0], [1.0, 2.0], 0.15, lamp(RADIANCE)));
    let low = corners(Vec3::new(-2.0, 0.15, -1.0), Vec3::X * 3.0, Vec3::Z * 3.0);
    expect_factor(
        "low rectangle",
        &near,
        0.2,
        0.1,
        polygon(DVec3::new(0.2, 0.0, 0.1).as_vec3().as_dvec3(), DVec3::Y, &low),
    );

    // It faces +X, and a part of it lies below the floor.
    let (corner, first, second) = (Vec3::new(0.0, -0.5, -1.0), Vec3::Y * 2.0, Vec3::Z * 2.0);
    let standing = over_floor(|scene| {
        put(scene, Shape::Mesh(parallelogram(corner, first, second)), lamp(RADIANCE), Affine3A::IDENTITY);
    });
    for (x, z) in [(0.5, 0.0), (0.3, 0.7)] {
        let factor = polygon(Vec3::new(x, 0.0, z).as_dvec3(), DVec3::Y, &corners(corner, first, second));
        expect_factor("standing rectangle", &standing, x, z, factor);
    }
    // Behind it there is no light, unless both sides shine.
    expect_exactly("behind", &standing, &at(-0.5, 0.0), 0.0, &[PATH, PLAIN, DIRECT]);
    let both = over_floor(|scene| {
        let mut material = lamp(RADIANCE);
        material.emission = Some(Emission { radiance: Rgb::gray(RADIANCE).into(), two_sided: true });
        put(scene, Shape::Mesh(parallelogram(corner, first, second)), material, Affine3A::IDENTITY);
    });
    let factor = polygon(DVec3::new(-0.5, 0.0, 0.0), DVec3::Y, &corners(corner, first, second));
    expect_factor("two-sided rectangle", &both, -0.5, 0.0, factor);
}

#[test]
fn f14_disc() {
    let (radius, height) = (1.0, 1.5);
    // A scaled and turned placement stands for a radius of its own.
    let placement = facing_down(Vec3::new(0.0, height, 0.0)) * Affine3A::from_scale(Vec3::splat(2.0));
    let world =
        over_floor(|scene| put(scene, Shape::Disc { radius: radius / 2.0 }, lamp(RADIANCE), placement));
    for x in [0.0, 0.5, 1.3] {
        expect_factor("disc", &world, x, 0.0, disc(f64::from(radius), f64::from(height), f64::from(x)));
    }
}

#[test]
fn f14_sphere() {
    let (radius, distance) = (1.0_f32, 1.6_f32);
    for degrees in [0.0_f64, 70.0, 90.0] {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        let center = Vec3::new(sin as f32, cos as f32, 0.0) * distance;
        let placement = Affine3A::from_mat3_translation(Mat3::from_diagonal(Vec3::splat(0.5)), center);
        let world =
            over_floor(|scene| put(scene, Shape::Sphere { radius: radius * 2.0 }, lamp(RADIANCE), placement));
        let factor = sphere(f64::from(radius), f64::from(distance), degrees.to_radians());
        expect_factor(&format!("sphere at {degrees}°"), &world, 0.0, 0.0, factor);
    }
}

#[test]
fn two_lamps_add_up() {
    let mut scene = Scene::default();
    floor(&mut scene, ALBEDO);
    ceiling(&mut scene, [-2.0, -1.0], [-0.5, 1.0], 1.0, lamp(1.0));
    put(
        &mut scene,
        Shape::Sphere { radius: 0.8 },
        lamp(4.0),
        Affine3A::from_translation(Vec3::new(1.5, 1.0, 0.0)),
    );
    let left =
        polygon(DVec3::ZERO, DVec3::Y, &corners(Vec3::new(-2.0, 1.0, -1.0), Vec3::X * 1.5, Vec3::Z * 2.0));
    let right = sphere(f64::from(0.8_f32), libm::sqrt(3.25), libm::atan(1.5));
    let truth = f64::from(ALBEDO) * (left + 4.0 * right);
    expect("two lamps", &world(scene), &at(0.0, 0.0), truth, &[PATH, PLAIN, DIRECT]);
}
