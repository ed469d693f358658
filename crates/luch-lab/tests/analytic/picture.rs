//! How places of the scene become pixels: edges under filters, and what the lens leaves sharp.

use super::{render, world};
use glam::Vec3;
use luch_lab::truth::Way;
use luch_lab::truth::measure::{pixels_over_seeds, settings};
use luch_lab::truth::stage::{aimed, half_plane};
use luch_render::PixelEstimate;
use luch_sampling::Sequence;
use luch_scene::{Camera, Filter, Integrator as Name, Projection, Settings};

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
    let world = world(half_plane(angle, offset, 0.0));
    for filter in [Filter::Box { radius: 0.5 }, Filter::Tent { radius: 1.0 }, Filter::Box { radius: 1.25 }] {
        for sequence in Sequence::ALL {
            let like = Settings { filter, ..settings(4, 4, sequence, 0) };
            let pixels =
                pixels_over_seeds(&world, &square_on(), &like, Name::Path { max_depth: 0 }, SAMPLES, SEEDS)
                    .unwrap();
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
    let world = world(half_plane(angle, offset, 0.0));
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
                let one = |(i, pixel): (usize, &PixelEstimate)| {
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
fn what_lies_at_the_focus_distance_is_sharp() {
    let focus = 4.0;
    let eye = Camera::looking_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, 0.02);
    let eye = Camera { lens_radius: 0.3, focus_distance: focus, ..eye };
    let sharp = world(half_plane(0.0, 0.0, -focus));
    let film = render(&sharp, &eye, &settings(8, 8, Sequence::Sobol, 1), Way::PATH, 256);
    for (i, pixel) in film.iter().enumerate() {
        match i % 8 {
            0..3 => assert_eq!(pixel.mean[0], 0.0, "pixel {i}"),
            5..8 => assert_eq!(pixel.mean[0], 1.0, "pixel {i}"),
            // The edge runs between the two columns in the middle.
            _ => {}
        }
    }
}
