//! Surfaces that are there in part: alpha, masks, sides, mixtures.

use super::formulas::polygon;
use super::measure::{DIRECT, PATH, PLAIN, aimed, expect, expect_exactly};
use super::stage::{black, ceiling, floor, gray, lamp, put, surround, world};
use glam::{Affine3A, DVec3, Vec3, Vec4};
use luch::image::{Bitmap, Encoding, Pixels};
use luch::mesh::{Attribute, TriangleMesh, generate};
use luch::prelude::*;
use luch::scene::preset::{material_ball, parallelogram};
use luch::scene::{
    Channel, ColorValue, Emission, Id, Opacity, ScalarValue, Sides, Surface, Texture, TextureFilter,
    TextureUse, Wrap,
};

const WAYS: [luch::scene::Integrator; 3] = [PATH, PLAIN, DIRECT];

fn half() -> Opacity {
    Opacity::Blend { alpha: 0.5.into() }
}

/// A floor of albedo 1 under a lamp of radiance 4 that spans −1 to 1 in x and z at height 1, and what a point of it receives.
fn lit_floor() -> (Scene, f64) {
    let mut scene = Scene::default();
    floor(&mut scene, 1.0);
    ceiling(&mut scene, [-1.0; 2], [1.0; 2], 1.0, lamp(4.0));
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, z]| DVec3::new(x, 1.0, z));
    (scene, 4.0 * polygon(DVec3::ZERO, DVec3::Y, &corners))
}

/// Looks at the origin from just above the floor.
fn low() -> Camera {
    aimed(Vec3::new(0.02, 0.1, 0.03), Vec3::ZERO)
}

/// Looks up at the lamp of [`lit_floor`] from just above the floor.
fn up() -> Camera {
    aimed(Vec3::new(0.2, 0.1, 0.3), Vec3::new(0.25, 1.0, 0.3))
}

#[test]
fn each_half_transparent_sheet_halves_what_is_seen_and_what_arrives() {
    for sheets in 1..=2 {
        let (mut scene, open) = lit_floor();
        for i in 0..sheets {
            let sheet = Material { opacity: half(), ..black() };
            put(
                &mut scene,
                Shape::Plane,
                sheet,
                Affine3A::from_translation(Vec3::Y * (0.4 + 0.2 * i as f32)),
            );
        }
        let world = world(scene);
        let left = libm::pow(0.5, f64::from(sheets));
        expect("seen", &world, &up(), 4.0 * left, &WAYS);
        expect("received", &world, &low(), open * left, &WAYS);
    }
}

#[test]
fn a_lamp_that_is_half_there_shines_half() {
    let (mut scene, open) = lit_floor();
    scene.materials[1].opacity = half();
    let rectangle = world(scene.clone());
    expect("seen", &rectangle, &up(), 2.0, &WAYS);
    expect("received", &rectangle, &low(), open / 2.0, &WAYS);
    for shape in [Shape::Sphere { radius: 0.7 }, Shape::Disc { radius: 1.0 }] {
        let mut scene = scene.clone();
        scene.shapes[1] = shape.into();
        scene.instances[1].placement = super::stage::facing_down(Vec3::Y);
        let there = {
            let mut scene = scene.clone();
            scene.materials[1].opacity = Opacity::Opaque;
            super::measure::measure(&world(scene), &low(), PLAIN, luch::sampling::Sequence::Sobol)
        };
        // A sphere that is half there also lets its far side's back through, which does not shine.
        for way in [PATH, DIRECT, PLAIN] {
            let half =
                super::measure::measure(&world(scene.clone()), &low(), way, luch::sampling::Sequence::Sobol);
            let off = half.mean().unwrap() - there.mean().unwrap() / 2.0;
            let error = half.standard_error().unwrap() + there.standard_error().unwrap() / 2.0;
            assert!(off.abs() <= 4.0 * error, "{way:?}: {half:?} is not half of {there:?}");
            assert!(error < 0.01 * half.mean().unwrap());
        }
    }
}

#[test]
fn a_masked_lamp_shines_where_it_is_there() {
    let (mut scene, _) = lit_floor();
    // Alpha rises along x from 0 to 1: the half at x > 0 is there.
    scene.shapes[1] = Shape::Mesh(rising_alpha(Vec3::new(-1.0, 1.0, -1.0), 2.0)).into();
    scene.materials[1].opacity = Opacity::Mask { alpha: vertex_alpha(), cutoff: 0.5 };
    let world = world(scene);
    let corners = [[0.0, -1.0], [1.0, -1.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, z]| DVec3::new(x, 1.0, z));
    expect("masked", &world, &low(), 4.0 * polygon(DVec3::ZERO, DVec3::Y, &corners), &WAYS);
}

/// A horizontal square of side `side` that faces downward, its vertex alpha rising from 0 to 1 along x.
fn rising_alpha(corner: Vec3, side: f32) -> TriangleMesh {
    let mut mesh = parallelogram(corner, Vec3::X * side, Vec3::Z * side);
    let alpha = |p: &Vec3| Vec4::new(1.0, 1.0, 1.0, (p.x - corner.x) / side);
    mesh.colors = Attribute::per_position(mesh.positions.iter().map(alpha).collect());
    mesh
}

fn vertex_alpha() -> ScalarValue {
    ScalarValue { vertex_alpha: true, ..1.0.into() }
}

#[test]
fn vertex_alpha_is_interpolated_and_cut_at_the_cutoff() {
    let behind = |opacity: Opacity, x: f32| {
        let mut scene = Scene::default();
        ceiling(&mut scene, [-9.0; 2], [9.0; 2], 2.0, lamp(3.0));
        let sheet = Material { opacity, ..black() };
        put(&mut scene, Shape::Mesh(rising_alpha(Vec3::new(0.0, 1.0, 0.0), 1.0)), sheet, Affine3A::IDENTITY);
        (world(scene), aimed(Vec3::new(x, 0.0, 0.4), Vec3::new(x, 1.0, 0.4)))
    };
    for x in [0.2_f32, 0.5, 0.7] {
        let (world, camera) = behind(Opacity::Blend { alpha: vertex_alpha() }, x);
        expect("blend", &world, &camera, 3.0 * f64::from(1.0 - x), &WAYS);
        let halved = ScalarValue { factor: 0.5, ..vertex_alpha() };
        let (world, camera) = behind(Opacity::Blend { alpha: halved }, x);
        expect("blend", &world, &camera, 3.0 * f64::from(1.0 - 0.5 * x), &WAYS);
    }
    for (x, truth) in [(0.45, 3.0), (0.55, 0.0)] {
        let (world, camera) = behind(Opacity::Mask { alpha: vertex_alpha(), cutoff: 0.5 }, x);
        expect_exactly("mask", &world, &camera, truth, &WAYS);
    }
}

#[test]
fn a_texture_can_cut_out() {
    let mut scene = Scene::default();
    ceiling(&mut scene, [-9.0; 2], [9.0; 2], 2.0, lamp(3.0));
    let pixels = Pixels::U8(vec![[255, 255, 255, 51], [255, 255, 255, 255]]);
    scene.add_image(Bitmap { width: 2, height: 1, pixels, encoding: Encoding::Srgb, has_alpha: true });
    let texture = scene.add_texture(Texture::Image {
        image: Id::new(0),
        encoding: Encoding::Srgb,
        wrap: [Wrap::Clamp; 2],
        filter: TextureFilter::Nearest,
    });
    let alpha = ScalarValue::textured(TextureUse::new(texture), Channel::Alpha);
    let sheet = Material { opacity: Opacity::Blend { alpha }, ..black() };
    let mesh = generate::plane(glam::Vec2::ONE, [1, 1]);
    let low_u = mesh
        .corner_uvs(0, 0)
        .unwrap()
        .iter()
        .zip(mesh.corners(0))
        .min_by(|a, b| a.0.x.total_cmp(&b.0.x))
        .unwrap()
        .1;
    put(&mut scene, Shape::Mesh(mesh), sheet, Affine3A::from_translation(Vec3::Y));
    let world = world(scene);
    let side = low_u.x.signum() * 0.25;
    // Alpha is not a colour: 51 of 255 is one fifth, whatever curve the colours have.
    let look = |x: f32| aimed(Vec3::new(x, 0.0, 0.1), Vec3::new(x, 1.0, 0.1));
    expect("thin half", &world, &look(side), 3.0 * 0.8, &WAYS);
    expect_exactly("whole half", &world, &look(-side), 0.0, &WAYS);
}

#[test]
fn what_has_only_a_front_lets_rays_from_behind_pass() {
    let (scene, open) = lit_floor();
    let sheet = Material { sides: Sides::Front, ..black() };
    // Rays from the floor to the lamp come from below: a sheet that faces up is not there for them, one that faces down is.
    for (placement, part) in
        [(Affine3A::from_translation(Vec3::Y * 0.5), 1.0), (super::stage::facing_down(Vec3::Y * 0.5), 0.0)]
    {
        let mut scene = scene.clone();
        put(&mut scene, Shape::Plane, sheet.clone(), placement);
        let world = world(scene);
        expect_exactly("seen", &world, &up(), 4.0 * part, &WAYS);
        if part > 0.0 {
            expect("received", &world, &low(), open, &WAYS);
        } else {
            expect_exactly("received", &world, &low(), 0.0, &WAYS);
        }
    }
}

#[test]
fn a_lamp_that_has_only_a_front_has_no_shining_back() {
    let (mut scene, _) = lit_floor();
    scene.materials[1].sides = Sides::Front;
    scene.materials[1].emission = Some(Emission { radiance: Rgb::gray(4.0).into(), two_sided: true });
    // Turned over, its back looks at the floor.
    let turned = Affine3A::from_translation(Vec3::Y) * super::stage::facing_down(Vec3::Y);
    scene.instances[1].placement = turned;
    expect_exactly("back", &world(scene), &low(), 0.0, &WAYS);
}

#[test]
fn a_mixture_reflects_the_mean_of_its_parts() {
    for weight in [0.0_f32, 0.3, 1.0] {
        let mut scene = Scene::default();
        let first = scene.add_material(gray(0.2));
        let second = scene.add_material(gray(0.9));
        let mixed = Material::new(Surface::Mix { first, second, weight: weight.into() });
        put(&mut scene, Shape::Plane, mixed, Affine3A::IDENTITY);
        surround(&mut scene, 2.0);
        let truth = 2.0 * f64::from(0.2 + weight * 0.7);
        expect("mixture", &world(scene), &low(), truth, &WAYS);
    }
    // Nested: half of half.
    let mut scene = Scene::default();
    let first = scene.add_material(gray(0.0));
    let second = scene.add_material(gray(0.8));
    let inner = scene.add_material(Material::new(Surface::Mix { first, second, weight: 0.5.into() }));
    let outer = Material::new(Surface::Mix { first, second: inner, weight: 0.5.into() });
    put(&mut scene, Shape::Plane, outer, Affine3A::IDENTITY);
    surround(&mut scene, 1.0);
    expect("nested mixture", &world(scene), &low(), 0.2, &WAYS);
}

#[test]
fn vertex_colours_multiply() {
    let mut scene = Scene::default();
    let mut mesh = parallelogram(Vec3::new(-1.0, 0.0, -1.0), Vec3::Z * 2.0, Vec3::X * 2.0);
    mesh.colors =
        Attribute::per_position(mesh.positions.iter().map(|p| Vec4::splat((p.x + 1.0) / 2.0)).collect());
    let color = ColorValue { vertex_color: true, ..Rgb::gray(0.8).into() };
    put(&mut scene, Shape::Mesh(mesh), Material::new(Surface::Diffuse { color }), Affine3A::IDENTITY);
    surround(&mut scene, 1.0);
    let world = world(scene);
    for x in [-0.5_f32, 0.0, 0.6] {
        let camera = aimed(Vec3::new(x, 1.0, 0.2), Vec3::new(x, 0.0, 0.2));
        expect("vertex colour", &world, &camera, f64::from(0.8 * (x + 1.0) / 2.0), &WAYS);
    }
}

#[test]
fn a_white_body_that_is_partly_there_vanishes_in_white_light() {
    let scene = material_ball(Shape::Sphere { radius: 1.0 }, Material { opacity: half(), ..gray(1.0) });
    let camera = scene.cameras[0].camera;
    let world = world(scene);
    expect_exactly("half a ball", &world, &camera, 1.0, &[PLAIN]);
    expect("half a ball", &world, &camera, 1.0, &[PATH]);
}
