//! Radiance toward a camera with a standard error from independent replicates, and its comparison with the truth.

use glam::Vec3;
use luch::prelude::*;
use luch::render::PixelEstimate;
use luch::sampling::{Estimate, Sequence};
use luch::scene::{Filter, Integrator as Name};

/// Bundles of pixels are independent randomisations of the samples: where all see the same, each is a replicate.
const COLUMNS: u32 = 32;
const ROWS: u32 = 16;
/// Pixels along a side of a bundle.
const BUNDLE: u32 = 4;
/// Samples of a pixel in the pilot, which chooses the size of the run and is thrown away.
const PILOT: u64 = 32;
/// Most samples of a pixel.
const MOST: u64 = 1 << 14;
/// Relative standard error that runs are planned for, and the one that is demanded.
const PLANNED: f64 = 0.0042;
const DEMANDED: f64 = 0.005;
/// Largest distance from the truth in standard errors.
const DISTANCE: f64 = 4.0;
/// Relative rounding of some dozen operations in single precision; matters only where the variance vanishes.
const ROUNDING: f64 = 1e-5;

/// Paths without an end of their own; roulette ends them.
const ENDLESS: u32 = 1 << 20;
/// Light sampling and BSDF sampling together.
pub(crate) const PATH: Name = Name::Path { max_depth: ENDLESS };
/// BSDF sampling alone.
pub(crate) const PLAIN: Name = Name::PlainPath { max_depth: ENDLESS };
/// One scattering.
pub(crate) const DIRECT: Name = Name::Direct;
/// The open part of the hemisphere.
pub(crate) const OCCLUSION: Name = Name::Occlusion { distance: f32::INFINITY };

/// A camera that looks at a point so narrowly that radiance is constant over the film.
pub(crate) fn aimed(eye: Vec3, target: Vec3) -> Camera {
    Camera::looking_at(eye, target, Vec3::Y, 1e-4)
}

/// Settings of a small film.
pub(crate) fn settings(width: u32, height: u32, sequence: Sequence, seed: u64) -> Settings {
    Settings { width, height, sequence, seed, filter: Filter::Box { radius: 0.5 }, ..Settings::default() }
}

/// Renders a film; its means, row by row.
pub(crate) fn render(
    world: &World,
    camera: &Camera,
    settings: &Settings,
    way: Name,
    samples: u64,
) -> Vec<PixelEstimate> {
    let view = View::new(camera, settings);
    let integrator = from_settings(way, &view);
    let mut film = Film::new(view.width(), view.height());
    render_pass(world, &view, integrator.as_ref(), &mut film, 0..samples, &Stop::new(), &Default::default())
        .expect("nobody stops this");
    assert!(film.losses().is_none(), "samples were lost: {:?}", film.losses());
    film.read(|pixel, _| pixel).pixels().to_vec()
}

/// The first channel of a film whose pixels all see the same, bundle by bundle.
fn replicates(
    world: &World,
    camera: &Camera,
    way: Name,
    sequence: Sequence,
    seed: u64,
    samples: u64,
) -> Estimate {
    let settings = settings(COLUMNS, ROWS, sequence, seed);
    let pixels = render(world, camera, &settings, way, samples);
    let bundles = (0..ROWS / BUNDLE).flat_map(|y| (0..COLUMNS / BUNDLE).map(move |x| (x, y)));
    let mean = |(x, y): (u32, u32)| {
        let places =
            (0..BUNDLE * BUNDLE).map(|i| (y * BUNDLE + i / BUNDLE) * COLUMNS + x * BUNDLE + i % BUNDLE);
        let sum: f64 = places.map(|place| pixels[place as usize].mean[0]).sum();
        sum / f64::from(BUNDLE * BUNDLE)
    };
    bundles.map(mean).collect()
}

/// The radiance that `camera` sees. A run that ends above the demanded error is thrown away and made again with twice
/// the samples and another seed; the choice looks at the spread alone, so it leans to no side.
pub(crate) fn measure(world: &World, camera: &Camera, way: Name, sequence: Sequence) -> Estimate {
    let pilot = replicates(world, camera, way, sequence, 1, PILOT);
    let ratio = relative_error(&pilot) / PLANNED;
    let wanted = PILOT as f64 * ratio * ratio;
    let mut samples = (wanted.min(MOST as f64) as u64).clamp(PILOT, MOST).next_power_of_two();
    for seed in 2.. {
        let estimate = replicates(world, camera, way, sequence, seed, samples);
        // A little less than is demanded, of the mean instead of the truth.
        if relative_error(&estimate) <= 0.95 * DEMANDED || samples >= MOST {
            return estimate;
        }
        samples *= 2;
    }
    unreachable!("there are fewer doublings than seeds")
}

/// The standard error of an estimate over its mean.
fn relative_error(estimate: &Estimate) -> f64 {
    estimate.standard_error().unwrap_or(0.0) / estimate.mean().unwrap_or(0.0).abs().max(f64::MIN_POSITIVE)
}

/// What is wrong with an estimate of `truth`, if anything.
pub(crate) fn complaint(estimate: &Estimate, truth: f64) -> Option<String> {
    let (mean, error) =
        (estimate.mean().expect("replicates"), estimate.standard_error().expect("replicates"));
    let off = (mean - truth).abs();
    let good =
        estimate.not_finite() == 0 && off <= DISTANCE * error + ROUNDING * truth && error <= DEMANDED * truth;
    let percent = 100.0 * error / truth;
    (!good).then(|| {
        format!(
            "{mean:.6}, expected {truth:.6}: {:.1} standard errors off, one is {percent:.3} % of the truth",
            off / error
        )
    })
}

/// Every way with every sequence must find `truth`.
#[track_caller]
pub(crate) fn expect(what: &str, world: &World, camera: &Camera, truth: f64, ways: &[Name]) {
    let mut complaints = String::new();
    for &way in ways {
        for sequence in Sequence::ALL {
            if let Some(complaint) = complaint(&measure(world, camera, way, sequence), truth) {
                complaints += &format!("\n  {way:?} with {}: {complaint}", sequence.name());
            }
        }
    }
    assert!(complaints.is_empty(), "{what}:{complaints}");
}

/// Every sample of every pixel of a picture must be `truth`: there is no variance at all.
#[track_caller]
pub(crate) fn expect_exactly(what: &str, world: &World, camera: &Camera, truth: f64, ways: &[Name]) {
    for &way in ways {
        for sequence in Sequence::ALL {
            let pixels = render(world, camera, &settings(12, 12, sequence, 3), way, 8);
            for (i, pixel) in pixels.iter().enumerate() {
                let name = sequence.name();
                for mean in pixel.mean {
                    let off = (mean - truth).abs();
                    assert!(
                        off <= ROUNDING * truth,
                        "{what}, {way:?} with {name}: pixel {i} is {mean}, expected {truth}"
                    );
                }
                let variance = pixel.variance.expect("both streams have samples")[0];
                assert!(
                    variance.sqrt() <= ROUNDING * truth,
                    "{what}, {way:?} with {name}: pixel {i} varies by {variance:e}"
                );
            }
        }
    }
}

/// The mean over `seeds` independent films, pixel by pixel.
pub(crate) fn pixels_over_seeds(
    world: &World,
    camera: &Camera,
    like: &Settings,
    way: Name,
    samples: u64,
    seeds: u64,
) -> Vec<Estimate> {
    let mut estimates = vec![Estimate::new(); (like.width * like.height) as usize];
    for seed in 0..seeds {
        let film = render(world, camera, &Settings { seed, ..*like }, way, samples);
        for (estimate, pixel) in estimates.iter_mut().zip(film) {
            estimate.add(pixel.mean[0]);
        }
    }
    estimates
}
