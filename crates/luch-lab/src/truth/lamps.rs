//! F10, F12 and F14: lamps over a Lambert floor, by light sampling and BSDF sampling together, by BSDF sampling alone, and
//! by one scattering; each scene has one, so all agree.

use super::formulas::{disc, polygon, sphere};
use super::stage::{aimed, aimed_at_floor, ceiling, facing_down, floor, gray, lamp, put};
use super::{Case, Family, Reads, Way};
use glam::{Affine3A, DVec3, Mat3, Vec3};
use luch_image::Rgb;
use luch_scene::preset::parallelogram;
use luch_scene::{Camera, Emission, Integrator, Light, Projection, Scene, Shape};
use std::f32::consts::PI;

const ALBEDO: f32 = 0.6;
const RADIANCE: f32 = 5.0;
/// Light sampling of a lamp that cannot be hit is not for plain paths.
const SAMPLED: [Integrator; 2] = [Way::PATH, Way::DIRECT];
const ALL: [Integrator; 3] = [Way::PATH, Way::PLAIN, Way::DIRECT];

fn over_floor(build: impl FnOnce(&mut Scene)) -> Scene {
    let mut scene = Scene::default();
    floor(&mut scene, ALBEDO);
    build(&mut scene);
    scene
}

pub(super) fn sun_point_and_spot() -> Vec<Case> {
    let camera = aimed_at_floor(0.3, 0.1);
    let case = |name: &str, light, truth| {
        Case::new(Family::F10, name, &over_floor(|scene| scene.lights.push(light)), camera, truth)
    };
    let towards = Vec3::new(0.48, 0.6, 0.64);
    let sun = |angular_radius| Light::Sun { direction: -towards, irradiance: Rgb::gray(3.0), angular_radius };
    // A disc wholly above the horizon gives what its centre would: the vector irradiance of a cone lies along its axis.
    let under_sun = f64::from(ALBEDO * 3.0 * towards.y / PI);
    let position = Vec3::new(0.5, 2.0, -0.3);
    let way = position - Vec3::new(0.3, 0.0, 0.1);
    let under_point = f64::from(ALBEDO * 7.0 * way.normalize().y / (PI * way.length_squared()));
    let spot = |inner_angle, outer_angle| Light::Spot {
        position,
        direction: Vec3::NEG_Y,
        intensity: Rgb::gray(7.0),
        inner_angle,
        outer_angle,
    };
    let (low, high) = (libm::cos(0.8), libm::cos(0.1));
    let part = (f64::from(way.normalize().y) - low) / (high - low);
    let point = Light::Point { position, intensity: Rgb::gray(7.0) };
    vec![
        case("sun without size", sun(0.0), under_sun).exactly_by(&SAMPLED),
        case("small sun", sun(0.01), under_sun).by(&SAMPLED),
        case("large sun", sun(0.2), under_sun).by(&SAMPLED),
        case("wide sun", sun(0.4), under_sun).by(&ALL),
        case("point", point, under_point).exactly_by(&SAMPLED),
        case("spot", spot(0.3, 0.5), under_point).exactly_by(&SAMPLED),
        case("beside the spot", spot(0.05, 0.1), 0.0).exactly_by(&SAMPLED),
        case("rim of the spot", spot(0.1, 0.8), under_point * part * part).exactly_by(&SAMPLED),
    ]
}

pub(super) fn sunlit_sphere() -> Vec<Case> {
    let mut scene = Scene::default();
    put(&mut scene, Shape::Sphere { radius: 1.0 }, gray(ALBEDO), Affine3A::IDENTITY);
    scene.lights.push(Light::Sun { direction: Vec3::NEG_Z, irradiance: Rgb::gray(2.0), angular_radius: 0.0 });
    let full = f64::from(ALBEDO * 2.0 / PI);
    let from = |x: f32, height| Camera {
        projection: Projection::Orthographic { height },
        ..aimed(Vec3::new(x, 0.0, 5.0), Vec3::new(x, 0.0, 0.0))
    };
    let point = |x: f32| {
        let cosine = (1.0 - f64::from(x) * f64::from(x)).sqrt();
        Case::new(Family::F12, format!("{x} from the middle"), &scene, from(x, 1e-5), full * cosine)
            .by(&SAMPLED)
    };
    // Two thirds of the full value on π/4 of the square around it.
    let truth = full * 2.0 / 3.0 * std::f64::consts::FRAC_PI_4;
    let whole = Case::new(Family::F12, "the whole of it", &scene, from(0.0, 2.0), truth).by(&[Way::DIRECT]);
    let whole = Case { reads: Reads::WholePicture, ..whole };
    [0.0, 0.3, 0.7, 0.9].into_iter().map(point).chain([whole]).collect()
}

fn corners(corner: Vec3, first: Vec3, second: Vec3) -> [DVec3; 4] {
    [corner, corner + first, corner + first + second, corner + second].map(|p| p.as_dvec3())
}

/// What a point of the floor receives from a polygon, as a form factor.
fn factor(x: f32, z: f32, corners: &[DVec3]) -> f64 {
    polygon(Vec3::new(x, 0.0, z).as_dvec3(), DVec3::Y, corners)
}

pub(super) fn over_a_floor() -> Vec<Case> {
    let mut cases = rectangles();
    cases.extend(discs_and_spheres());
    cases
}

/// A case at a point of the floor whose lamp fills the form factor `factor`.
fn case(name: String, scene: &Scene, [x, z]: [f32; 2], factor: f64) -> Case {
    let truth = f64::from(ALBEDO) * f64::from(RADIANCE) * factor;
    Case::new(Family::F14, format!("{name} from ({x}, {z})"), scene, aimed_at_floor(x, z), truth)
}

fn rectangles() -> Vec<Case> {
    let mut cases = Vec::new();
    let scene = over_floor(|scene| ceiling(scene, [-0.5, -0.5], [0.5, 0.5], 1.0, lamp(RADIANCE)));
    let square = corners(Vec3::new(-0.5, 1.0, -0.5), Vec3::X, Vec3::Z);
    for [x, z] in [[0.0, 0.0], [-0.7, 0.6], [1.2, 0.0]] {
        cases.push(case("rectangle".into(), &scene, [x, z], factor(x, z, &square)).by(&ALL));
    }
    let scene = over_floor(|scene| ceiling(scene, [-2.0, -1.0], [1.0, 2.0], 0.15, lamp(RADIANCE)));
    let low = corners(Vec3::new(-2.0, 0.15, -1.0), Vec3::X * 3.0, Vec3::Z * 3.0);
    cases.push(case("low rectangle".into(), &scene, [0.2, 0.1], factor(0.2, 0.1, &low)).by(&ALL));

    // It faces +X, and a part of it lies below the floor.
    let (corner, first, second) = (Vec3::new(0.0, -0.5, -1.0), Vec3::Y * 2.0, Vec3::Z * 2.0);
    let standing = corners(corner, first, second);
    let with = |material| {
        let mesh = Shape::Mesh(parallelogram(corner, first, second));
        over_floor(|scene| put(scene, mesh, material, Affine3A::IDENTITY))
    };
    let scene = with(lamp(RADIANCE));
    for [x, z] in [[0.5, 0.0], [0.3, 0.7]] {
        let name = "rectangle cut by the horizon".to_owned();
        cases.push(case(name, &scene, [x, z], factor(x, z, &standing)).by(&ALL));
    }
    // Behind it there is no light, unless both sides shine.
    cases.push(case("back of a rectangle".into(), &scene, [-0.5, 0.0], 0.0).exactly_by(&ALL));
    let mut both = lamp(RADIANCE);
    both.emission = Some(Emission { radiance: Rgb::gray(RADIANCE).into(), two_sided: true });
    let factor = factor(-0.5, 0.0, &standing);
    cases.push(case("two-sided rectangle".into(), &with(both), [-0.5, 0.0], factor).by(&ALL));
    cases
}

fn discs_and_spheres() -> Vec<Case> {
    let mut cases = Vec::new();
    let (radius, height) = (1.0, 1.5);
    // A scaled and turned placement stands for a radius of its own.
    let placement = facing_down(Vec3::new(0.0, height, 0.0)) * Affine3A::from_scale(Vec3::splat(2.0));
    let scene =
        over_floor(|scene| put(scene, Shape::Disc { radius: radius / 2.0 }, lamp(RADIANCE), placement));
    for x in [0.0, 0.5, 1.3] {
        let factor = disc(f64::from(radius), f64::from(height), f64::from(x));
        cases.push(case("disc".into(), &scene, [x, 0.0], factor).by(&ALL));
    }
    let (radius, distance) = (1.0_f32, 1.6_f32);
    for degrees in [0.0_f64, 70.0, 90.0] {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        let center = Vec3::new(sin as f32, cos as f32, 0.0) * distance;
        let placement = Affine3A::from_mat3_translation(Mat3::from_diagonal(Vec3::splat(0.5)), center);
        let scene =
            over_floor(|scene| put(scene, Shape::Sphere { radius: radius * 2.0 }, lamp(RADIANCE), placement));
        let factor = sphere(f64::from(radius), f64::from(distance), degrees.to_radians());
        cases.push(case(format!("sphere at {degrees}°"), &scene, [0.0, 0.0], factor).by(&ALL));
    }
    let scene = over_floor(|scene| {
        ceiling(scene, [-2.0, -1.0], [-0.5, 1.0], 1.0, lamp(1.0));
        let placement = Affine3A::from_translation(Vec3::new(1.5, 1.0, 0.0));
        put(scene, Shape::Sphere { radius: 0.8 }, lamp(4.0), placement);
    });
    let left = factor(0.0, 0.0, &corners(Vec3::new(-2.0, 1.0, -1.0), Vec3::X * 1.5, Vec3::Z * 2.0));
    let right = sphere(f64::from(0.8_f32), libm::sqrt(3.25), libm::atan(1.5));
    let sum = (left + 4.0 * right) / f64::from(RADIANCE);
    cases.push(case("rectangle and sphere".into(), &scene, [0.0, 0.0], sum).by(&ALL));
    cases
}
