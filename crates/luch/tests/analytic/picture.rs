//! How places of the scene become pixels: edges, lens, and the lecture's glossy disc.

use super::formulas::disc_left_of;
use super::measure::{DIRECT, PATH, PLAIN, aimed, expect, pixels_over_seeds, render, settings};
use super::stage::{facing_down, lamp, put, world};
use glam::{Affine3A, Vec3};
use luch::prelude::*;
use luch::sampling::Sequence;
use luch::scene::preset::parallelogram;
use luch::scene::{Filter, Integrator as Name, Projection, Surface};

/// A glowing half-plane at `z` that faces +Z: the points with p · (`cos`, `sin`) > `offset`.
fn half_plane(angle: f32, offset: f32, z: f32) -> World {
    let (sin, cos) = libm::sincosf(angle);
    let (normal, along) = (Vec3::new(cos, sin, 0.0), Vec3::new(-sin, cos, 0.0));
    let corner = normal * offset - along * 500.0 + Vec3::Z * z;
    let mut scene = Scene::default();
    let mesh = parallelogram(corner, normal * 500.0, along * 1000.0);
    put(&mut scene, Shape::Mesh(mesh), lamp(1.0), Affine3A::IDENTITY);
    world(scene)
}

/// Part of a filter of radius `radius` to the left of `x`, in pixels from its centre; and its density there.
fn window(filter: Filter, x: f64) -> (f64, f64) {
    match filter {
        Filter::Box { radius } => {
            let t = (x / f64::from(radius)).clamp(-1.0, 1.0);
            ((t + 1.0) / 2.0, if t.abs() < 1.0 { 0.5 / f64::from(radius) } else { 0.0 })
        }
        Filter::Tent { radius } => {
            let t = (x / f64::from(radius)).clamp(-1.0, 1.0);
            let rest = 1.0 - t.abs();
            let part = if t < 0.0 { rest * rest / 2.0 } else { 1.0 - rest * rest / 2.0 };
            (part, rest / f64::from(radius))
        }
        _ => unreachable!("only windows with a closed form are used here"),
    }
}

/// Part of the filter about a pixel's centre that lies in the half-plane; lengths in pixels.
fn coverage(filter: Filter, angle: f32, offset: f64, center: [f64; 2]) -> f64 {
    const LINES: i32 = 4000;
    const REACH: f64 = 2.0;
    let (sin, cos) = libm::sincos(f64::from(angle));
    let step = 2.0 * REACH / f64::from(LINES);
    (0..LINES)
        .map(|line| {
            let y = -REACH + (f64::from(line) + 0.5) * step;
            let edge = (offset - sin * (center[1] + y)) / cos - center[0];
            window(filter, y).1 * (1.0 - window(filter, edge).0) * step
        })
        .sum()
}

/// A film of four by four pixels of one metre each, about the origin.
fn square_on() -> Camera {
    Camera { projection: Projection::Orthographic { height: 4.0 }, ..aimed(Vec3::Z * 5.0, Vec3::ZERO) }
}

/// Centre of a pixel of that film.
fn center(pixel: usize) -> [f64; 2] {
    [(pixel % 4) as f64 - 1.5, 1.5 - (pixel / 4) as f64]
}

#[test]
fn an_edge_covers_its_part_of_every_filter() {
    const SEEDS: u64 = 48;
    const SAMPLES: u64 = 256;
    let (angle, offset) = (0.6, 0.35);
    let world = half_plane(angle, offset, 0.0);
    for filter in [Filter::Box { radius: 0.5 }, Filter::Tent { radius: 1.0 }, Filter::Box { radius: 1.25 }] {
        for sequence in Sequence::ALL {
            let like = luch::scene::Settings { filter, ..settings(4, 4, sequence, 0) };
            let pixels =
                pixels_over_seeds(&world, &square_on(), &like, Name::Path { max_depth: 0 }, SAMPLES, SEEDS);
            for (i, estimate) in pixels.iter().enumerate() {
                let truth = coverage(filter, angle, f64::from(offset), center(i));
                let (mean, error) = (estimate.mean().unwrap(), estimate.standard_error().unwrap());
                // Slivers thinner than one sample of all cannot be told from nothing.
                let one = 1.0 / (SEEDS * SAMPLES) as f64;
                let name = sequence.name();
                assert!(error <= 0.005, "{filter:?} with {name}, pixel {i}: standard error {error}");
                let off = (mean - truth).abs();
                assert!(
                    off <= 4.0 * error + one,
                    "{filter:?} with {name}, pixel {i}: {mean}, expected {truth} ± {error}"
                );
            }
        }
    }
}

#[test]
fn coverage_converges_with_the_number_of_samples() {
    let (angle, offset) = (0.6, 0.35);
    let world = half_plane(angle, offset, 0.0);
    let filter = Filter::Box { radius: 0.5 };
    for sequence in Sequence::ALL {
        let squared_error = |samples: u64| -> f64 {
            let film = |seed| {
                render(
                    &world,
                    &square_on(),
                    &settings(4, 4, sequence, seed),
                    Name::Path { max_depth: 0 },
                    samples,
                )
            };
            let off = |seed| -> f64 {
                let one = |(i, pixel): (usize, &luch::render::PixelEstimate)| {
                    let off = pixel.mean[0] - coverage(filter, angle, f64::from(offset), center(i));
                    off * off
                };
                film(seed).iter().enumerate().map(one).sum()
            };
            (0..32).map(off).sum()
        };
        // 64 times the samples: at least an eighth of the error, up to the noise of a hundred-odd squares.
        let ratio = (squared_error(16) / squared_error(1024)).sqrt();
        assert!(ratio > 6.5, "{}: the error fell by {ratio}", sequence.name());
    }
}

#[test]
fn what_lies_at_the_focus_distance_is_sharp_and_what_does_not_is_blurred_by_the_lens() {
    let (radius, focus) = (0.3, 4.0);
    let lens = |camera: Camera| Camera { lens_radius: radius, focus_distance: focus, ..camera };
    let wide = lens(Camera::looking_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, 0.02));
    let sharp = half_plane(0.0, 0.0, -focus);
    let film = render(&sharp, &wide, &settings(8, 8, Sequence::Sobol, 1), PATH, 256);
    for (i, pixel) in film.iter().enumerate() {
        match i % 8 {
            0..3 => assert_eq!(pixel.mean[0], 0.0, "pixel {i}"),
            5..8 => assert_eq!(pixel.mean[0], 1.0, "pixel {i}"),
            // The edge runs between the two columns in the middle.
            _ => {}
        }
    }
    // Rays of one pixel meet at the focus and spread behind it: at 6 m each is half its place on the lens away, mirrored.
    let narrow = lens(aimed(Vec3::ZERO, Vec3::NEG_Z));
    for offset in [-0.03_f32, 0.06] {
        let blurred = half_plane(0.0, offset, -6.0);
        let part = disc_left_of(f64::from(-2.0 * offset / radius));
        expect("behind the focus", &blurred, &narrow, part, &[PATH]);
    }
    // In front of it, at 2 m, each is half its place away, not mirrored.
    expect("before the focus", &half_plane(0.0, 0.06, -2.0), &narrow, disc_left_of(-0.4), &[PATH]);
    // With parallel rays the same holds.
    let parallel = Camera { projection: Projection::Orthographic { height: 1e-4 }, ..narrow };
    expect("parallel", &half_plane(0.0, 0.06, -6.0), &parallel, disc_left_of(-0.4), &[PATH]);
}

#[test]
fn the_glossy_disc_sees_the_lamp_with_the_part_of_its_area_that_points_there() {
    let (color, glossiness) = (0.8_f32, 0.8_f32);
    let largest = libm::tanf((1.0 - glossiness) * std::f32::consts::FRAC_PI_2);
    // A normal of slope p turns the view from straight above by 2 atan p.
    for slope in [0.15_f32, 0.25] {
        let mut scene = Scene::default();
        let glossy =
            Material::new(Surface::Glossy { color: Rgb::gray(color).into(), glossiness: glossiness.into() });
        put(&mut scene, Shape::Plane, glossy, Affine3A::IDENTITY);
        let radius = libm::tanf(2.0 * libm::atanf(slope));
        put(&mut scene, Shape::Disc { radius }, lamp(3.0), facing_down(Vec3::Y));
        let part = f64::from(slope / largest) * f64::from(slope / largest);
        let camera = aimed(Vec3::Y * 0.5, Vec3::ZERO);
        expect("glossy", &world(scene), &camera, f64::from(color) * 3.0 * part, &[PATH, PLAIN, DIRECT]);
    }
}
