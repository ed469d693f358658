//! What every integrator promises, and what single ones show of scenes that are known.

mod integrators {
    pub(crate) mod odd;
    pub(crate) mod shown;
}

use integrators::odd;
use luch_image::Rgb;
use luch_render::{
    BUNDLE, CameraSample, Film, Inspect, Integrator, Occlusion, PathTracer, PlainPathTracer, Stop, View,
    World,
};
use luch_render::{from_settings, render_pass};
use luch_sampling::hash;
use luch_scene::{Integrator as Name, Property, Scene};
use std::sync::atomic::AtomicU64;

/// Every member of the family.
fn integrators(view: &View) -> Vec<(String, Box<dyn Integrator>)> {
    let mut all: Vec<(String, Box<dyn Integrator>)> = vec![
        ("path".into(), Box::new(PathTracer::default())),
        ("path of no bounce".into(), Box::new(PathTracer { max_depth: 0, ..PathTracer::default() })),
        ("path alone".into(), Box::new(PathTracer { reuse: false, ..PathTracer::default() })),
        ("plain path".into(), Box::new(PlainPathTracer { max_depth: 64 })),
        ("direct".into(), from_settings(Name::Direct, view)),
        ("occlusion".into(), Box::new(Occlusion { distance: f32::INFINITY })),
        ("near occlusion".into(), Box::new(Occlusion { distance: 0.5 })),
    ];
    for property in Property::ALL {
        all.push((format!("inspect {}", property.name()), Box::new(Inspect::new(property, view))));
    }
    all
}

fn shoot(
    scene: &Scene,
    world: &World,
    integrator: &dyn Integrator,
    count: u64,
) -> (View, Vec<CameraSample>, Vec<Rgb>) {
    let view = View::new(&scene.cameras[0].camera, &scene.settings);
    let samples = bundles(&view, count).concat();
    // What stands there before must not matter.
    let mut radiance = vec![Rgb::gray(f32::NAN); samples.len()];
    integrator.radiance(world, &samples, &mut radiance, &Stop::new()).unwrap();
    (view, samples, radiance)
}

/// All samples of the picture with indices below `count`, bundle by bundle.
fn bundles(view: &View, count: u64) -> Vec<Vec<CameraSample>> {
    let mut all = Vec::new();
    for index in 0..count {
        for top in (0..view.height()).step_by(BUNDLE as usize) {
            for left in (0..view.width()).step_by(BUNDLE as usize) {
                let pixels: Vec<[u32; 2]> = (top..view.height().min(top + BUNDLE))
                    .flat_map(|y| (left..view.width().min(left + BUNDLE)).map(move |x| [x, y]))
                    .collect();
                let (size, number) = (pixels.len() as u32, all.len() as u32);
                let start = |(lane, pixel): (u32, &[u32; 2])| {
                    view.start_bundled(*pixel, index, number, [left, top], [lane, size])
                };
                all.push((0..).zip(&pixels).map(start).collect());
            }
        }
    }
    all
}

fn bits(radiance: &[Rgb]) -> Vec<[u32; 3]> {
    radiance.iter().map(|rgb| rgb.to_array().map(f32::to_bits)).collect()
}

#[test]
fn nobody_is_changed_by_who_travels_beside_it() {
    for (name, scene) in [("cornell", odd::small_cornell()), ("everything", odd::everything())] {
        let world = World::build(scene.clone()).unwrap();
        let view = View::new(&scene.cameras[0].camera, &scene.settings);
        for (which, integrator) in integrators(&view) {
            let (_, _, together) = shoot(&scene, &world, &*integrator, 3);
            let together = bits(&together);
            let bundles = bundles(&view, 3);
            for size in [1, 7, 64] {
                let mut apart = Vec::new();
                for some in bundles.chunks(size) {
                    let samples = some.concat();
                    let mut radiance = vec![Rgb::BLACK; samples.len()];
                    integrator.radiance(&world, &samples, &mut radiance, &Stop::new()).unwrap();
                    apart.extend(radiance);
                }
                assert!(bits(&apart) == together, "{which} of {name} in batches of {size} bundles");
            }
            // Shuffled.
            let mut order: Vec<usize> = (0..bundles.len()).collect();
            order.sort_by_key(|&i| hash::mix64(i as u64));
            let shuffled = order.iter().flat_map(|&i| bundles[i].clone()).collect::<Vec<_>>();
            let mut radiance = vec![Rgb::BLACK; shuffled.len()];
            integrator.radiance(&world, &shuffled, &mut radiance, &Stop::new()).unwrap();
            let mut starts = vec![0; bundles.len()];
            for i in 1..bundles.len() {
                starts[i] = starts[i - 1] + bundles[i - 1].len();
            }
            let mut back = vec![Rgb::BLACK; shuffled.len()];
            let mut shown = radiance.into_iter();
            for &i in &order {
                back[starts[i]..starts[i] + bundles[i].len()].fill_with(|| shown.next().unwrap());
            }
            assert!(bits(&back) == together, "{which} of {name} shuffled");
        }
    }
}

#[test]
fn odd_scenes_are_finite() {
    for (name, scene) in odd::all() {
        let world = World::build(scene.clone()).unwrap_or_else(|error| panic!("{name}: {error}"));
        let view = View::new(&scene.cameras[0].camera, &scene.settings);
        for (which, integrator) in integrators(&view) {
            let (_, _, radiance) = shoot(&scene, &world, &*integrator, 4);
            let bad = radiance.iter().find(|rgb| !rgb.is_finite());
            assert!(bad.is_none(), "{which} of {name}: {bad:?}");
            if !which.starts_with("inspect") {
                assert!(
                    radiance.iter().all(|rgb| rgb.to_array().iter().all(|v| *v >= 0.0)),
                    "{which} of {name}"
                );
            }
        }
    }
}

#[test]
fn no_samples_are_no_work() {
    let scene = odd::small_cornell();
    let world = World::build(scene.clone()).unwrap();
    let view = View::new(&scene.cameras[0].camera, &scene.settings);
    for (which, integrator) in integrators(&view) {
        assert_eq!(integrator.radiance(&world, &[], &mut [], &Stop::new()), Ok(()), "{which}");
    }
}

#[test]
fn a_stop_is_heard() {
    let scene = odd::small_cornell();
    let world = World::build(scene.clone()).unwrap();
    let view = View::new(&scene.cameras[0].camera, &scene.settings);
    let stop = Stop::new();
    stop.request();
    for (which, integrator) in integrators(&view) {
        let samples = [view.start([3, 3], 0)];
        let answer = integrator.radiance(&world, &samples, &mut [Rgb::BLACK], &stop);
        assert_eq!(answer, Err(luch_render::Stopped), "{which}");
    }
}

/// Mean luminance of a picture and its standard error by the twin streams.
fn mean_and_error(scene: Scene, integrator: &dyn Integrator, count: u64) -> (f64, f64) {
    let view = View::new(&scene.cameras[0].camera, &scene.settings);
    let world = World::build(scene).unwrap();
    let mut film = Film::new(view.width(), view.height());
    render_pass(&world, &view, integrator, &mut film, 0..count, &Stop::new(), &AtomicU64::new(0)).unwrap();
    let estimate = film.mean().unwrap();
    (estimate.mean[1], estimate.standard_error[1])
}

#[test]
fn the_picture_does_not_depend_on_the_scale() {
    // Not the path as it runs, which differs in the last bits, but what it tends to; other seeds, so that the comparison is fair.
    let plain = PlainPathTracer { max_depth: 64 };
    for (integrator, count) in [(&PathTracer::default() as &dyn Integrator, 64), (&plain, 400)] {
        let (mean, error) = mean_and_error(odd::cornell_of_scale(1.0, 0), integrator, count);
        assert!(error < 0.02 * mean, "the test is too coarse: {mean} ± {error}");
        for (seed, scale) in [1e-4, 1e-2, 100.0, 1e4, 1e6].into_iter().enumerate() {
            let (other, its_error) =
                mean_and_error(odd::cornell_of_scale(scale, seed as u64 + 1), integrator, count);
            let z = (other - mean) / (error * error + its_error * its_error).sqrt();
            assert!(
                z.abs() < 4.0,
                "scale {scale}: {other} ± {its_error}, at scale 1 {mean} ± {error}: z = {z}"
            );
        }
    }
}

#[test]
fn both_path_tracers_agree() {
    for (name, scene) in [("cornell", odd::small_cornell()), ("everything", odd::everything())] {
        let (path, path_error) = mean_and_error(scene.clone(), &PathTracer::default(), 256);
        let mut other = scene;
        other.settings.seed = 99;
        let (plain, plain_error) = mean_and_error(other, &PlainPathTracer { max_depth: 64 }, 1024);
        let error = (path_error * path_error + plain_error * plain_error).sqrt();
        assert!(error < 0.03 * path, "{name}: the test is too coarse: {path} ± {error}");
        assert!((path - plain).abs() < 4.0 * error, "{name}: {path} and {plain} ± {error}");
    }
}
