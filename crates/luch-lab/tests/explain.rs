//! Explanations of pixels add up, and say of scenes with known answers what is known.

use luch::prelude::*;
use luch::render::{LightSource, PathTracer};
use luch::scene::preset;
use luch_lab::explain::{ExplainError, Technique, explain};

fn seen(mut scene: Scene, size: u32) -> (World, View) {
    (scene.settings.width, scene.settings.height) = (size, size);
    let view = View::new(&scene.cameras[0].camera, &scene.settings);
    (World::build(scene).expect("a sound scene"), view)
}

fn sums(light: impl Iterator<Item = [f64; 3]>) -> [f64; 3] {
    light.fold([0.0; 3], |sum, light| [0, 1, 2].map(|channel| sum[channel] + light[channel]))
}

#[test]
fn parts_and_branches_add_up_to_the_pixel() {
    let (world, view) = seen(preset::cornell_box(), 16);
    for pixel in [[3, 4], [8, 12], [15, 15]] {
        let found =
            explain(&world, &view, PathTracer::default(), pixel, 5..205, &Stop::new()).expect("explained");
        // Single precision sums of few portions each.
        let near = |a: [f64; 3], b: [f64; 3]| {
            (0..3).all(|channel| (a[channel] - b[channel]).abs() <= 1e-5 * b[channel].max(1e-9))
        };
        assert!(near(sums(found.by_technique.iter().map(|part| part.light)), found.own_mean));
        assert!(near(sums(found.by_source.iter().map(|part| part.light)), found.own_mean));
        let shares: f64 = found.by_technique.iter().map(|part| part.share).sum();
        assert!((shares - 1.0).abs() < 1e-5 && (found.tree.share() - 1.0).abs() < 1e-5);
        assert_eq!(found.tree.paths, 200);
        assert_eq!(found.ends.iter().map(|(_, count)| count).sum::<u64>(), 200);
        assert_eq!(found.running.last().map(|row| row.samples), Some(200));
        assert!(found.brightest.windows(2).all(|pair| pair[0].share >= pair[1].share));
    }
}

#[test]
fn the_picture_is_the_film_of_these_samples() {
    let (world, view) = seen(preset::cornell_box(), 10);
    let tracer = PathTracer::default();
    let mut film = Film::new(10, 10);
    render_pass(&world, &view, &tracer, &mut film, 0..32, &Stop::new(), &Default::default()).expect("done");
    let pixels = film.read(|pixel, _| pixel);
    // A corner bundle is cut at the edges.
    for [x, y] in [[0, 0], [5, 3], [9, 2], [9, 9]] {
        let found = explain(&world, &view, tracer, [x, y], 0..32, &Stop::new()).expect("explained");
        let pixel = pixels.pixels()[(y * 10 + x) as usize];
        for channel in 0..3 {
            let off = (found.picture_mean[channel] - pixel.mean[channel]).abs();
            // The film rounds each sample to its step.
            assert!(off <= film.step(), "{x},{y}: {off}");
        }
    }
}

#[test]
fn an_enclosure_gives_a_half_a_quarter_an_eighth() {
    let (world, view) = seen(preset::furnace(Rgb::gray(0.5), Rgb::gray(3.0)), 8);
    let found =
        explain(&world, &view, PathTracer::default(), [4, 4], 0..4096, &Stop::new()).expect("explained");
    assert!((found.own_mean[0] - 6.0).abs() <= 4.0 * found.own_error.max(1e-5));
    for depth in 0..5 {
        let of_depth = found.by_technique.iter().filter(|part| part.kind.0 == depth);
        let (light, variance) = of_depth.fold((0.0, 0.0), |(light, variance): (f64, f64), part| {
            // At most twice the sum if both vary together.
            (light + part.light[0], variance + 2.0 * part.variance)
        });
        let error = (variance / 4096.0).sqrt();
        let truth = 3.0 * libm::pow(0.5, f64::from(depth));
        assert!((light - truth).abs() <= 4.0 * error + 1e-5 && error < 0.02, "{depth}: {light} ± {error}");
    }
    let lamp = found.by_technique.iter().find(|part| part.kind == (0, Technique::Specular));
    assert_eq!(lamp.map(|part| part.samples), Some(4096));
    assert_eq!(found.by_source[0].kind, Some(LightSource::Instance(0)));
}

#[test]
fn what_cannot_be_explained_is_said() {
    let (world, view) = seen(preset::cornell_box(), 8);
    let ask = |pixel, samples| explain(&world, &view, PathTracer::default(), pixel, samples, &Stop::new());
    let outside = ExplainError::NoSuchPixel { pixel: [8, 0], width: 8, height: 8 };
    assert_eq!(ask([8, 0], 0..4).err(), Some(outside));
    assert_eq!(ask([0, 0], 4..4).err(), Some(ExplainError::Samples(0)));
    assert_eq!(ask([0, 0], 0..u64::MAX).err(), Some(ExplainError::Samples(u64::MAX)));
    let stopped = Stop::new();
    stopped.request();
    let end = explain(&world, &view, PathTracer::default(), [0, 0], 0..4, &stopped);
    assert_eq!(end.err(), Some(ExplainError::Stopped));
}
