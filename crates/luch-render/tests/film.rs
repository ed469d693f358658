//! What the film promises: exact sums, honest errors, nothing lost in silence.

#![expect(
    clippy::single_range_in_vec_init,
    reason = "samples are given as lists of ranges, some of which have one"
)]

mod film {
    pub(crate) mod pattern;
}

use film::pattern::{Pattern, StopAfter, expected_mean, render, small_view};
use luch_render::{Film, MergeError, PathTracer, Ranges, Stop, World, render_pass};
use luch_sampling::{Estimate, Sequence};
use proptest::prelude::*;
use std::ops::Range;
use std::sync::atomic::AtomicU64;

/// A set of indices.
fn ranges(of: &[Range<u64>]) -> Ranges {
    let mut ranges = Ranges::default();
    of.iter().for_each(|range| ranges.insert(range.clone()));
    ranges
}

#[test]
fn sums_are_those_of_integers() {
    // A size that is no multiple of the tile's.
    let view = small_view(37, 35, Sequence::Independent);
    let mut film = Film::new(37, 35);
    render(&mut film, &view, &Pattern::Wild, 0..21);
    let losses = film.losses();
    let mut seen = luch_render::Losses::default();
    let mut expected = Vec::new();
    for y in 0..35 {
        for x in 0..37 {
            expected.push(expected_mean(&view, Pattern::Wild, [x, y], 0..21, &mut seen));
        }
    }
    let means = film.read(|estimate, count| {
        assert_eq!(count, 21);
        estimate.mean
    });
    for (place, (mean, expected)) in means.pixels().iter().zip(&expected).enumerate() {
        assert_eq!(mean.map(f64::to_bits), expected.map(f64::to_bits), "pixel {place}");
    }
    assert_eq!(losses, seen);
    assert!(losses.saturated > 100 && losses.invalid > 100 && !losses.is_none());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn a_film_depends_only_on_which_samples_it_holds(
        cuts in prop::collection::btree_set(1u64..40, 0..6),
        order in any::<u64>(),
        films in 1usize..4,
    ) {
        let view = small_view(9, 5, Sequence::Sobol);
        let mut whole = Film::new(9, 5);
        render(&mut whole, &view, &Pattern::Wild, 0..40);
        // The same samples in pieces, shuffled, dealt to several films.
        let borders: Vec<u64> = std::iter::once(0).chain(cuts).chain([40]).collect();
        let mut pieces: Vec<Range<u64>> = borders.windows(2).map(|w| w[0]..w[1]).collect();
        pieces.sort_by_key(|piece| luch_sampling::hash::combine(order, piece.start));
        let mut parts = vec![Film::new(9, 5); films];
        for (i, piece) in pieces.into_iter().enumerate() {
            render(&mut parts[i % films], &view, &Pattern::Wild, piece);
        }
        parts.rotate_left((order % films as u64) as usize);
        let mut merged = Film::new(9, 5);
        for part in &parts {
            merged.merge(part).unwrap();
        }
        prop_assert_eq!(merged, whole);
    }
}

#[test]
fn samples_that_do_not_fit_are_counted() {
    let view = small_view(4, 4, Sequence::Sobol);
    for (value, saturated, invalid) in [
        (f32::NAN, 0, 3),
        (f32::INFINITY, 0, 3),
        (f32::NEG_INFINITY, 0, 3),
        (1e30, 3, 0),
        (-1e30, 3, 0),
        (f32::MAX, 3, 0),
        (6.0e7, 0, 0),
        (1e-30, 0, 0),
    ] {
        let mut film = Film::new(4, 4);
        render(&mut film, &view, &Pattern::Constant(value), 0..2);
        let losses = film.losses();
        assert_eq!([losses.saturated, losses.invalid], [saturated * 32, invalid * 32], "{value}");
        // A merge carries them along.
        let mut other = Film::new(4, 4);
        render(&mut other, &view, &Pattern::Constant(value), 2..4);
        film.merge(&other).unwrap();
        assert_eq!(film.losses().saturated, saturated * 64);
        assert_eq!(film.losses().invalid, invalid * 64);
        let mean = film.read(|estimate, _| estimate.mean[1] as f32);
        // What is cut is cut at 2^26.
        let cut = if value.is_finite() { value.clamp(-67_108_864.0, 67_108_864.0) } else { 0.0 };
        assert!((mean.get(1, 2) - cut).abs() <= film.step() as f32, "{value}: {}", mean.get(1, 2));
    }
}

#[test]
fn streams_are_even_and_odd_and_count_alike() {
    let view = small_view(3, 2, Sequence::Sobol);
    // Even indices give 1, odd ones 3: the mean of the streams is 2 however many there are of each.
    for range in [0..2, 0..7, 1..2, 3..12] {
        let mut film = Film::new(3, 2);
        render(&mut film, &view, &Pattern::Parity, range.clone());
        let (even, odd) =
            (range.clone().filter(|i| i % 2 == 0).count(), range.clone().filter(|i| i % 2 == 1).count());
        film.read(|estimate, count| {
            assert_eq!(count as usize, even + odd);
            let mean = if even == 0 {
                3.0
            } else if odd == 0 {
                1.0
            } else {
                2.0
            };
            assert_eq!(estimate.mean, [mean; 3], "{range:?}");
            // ((1 − 3) / 2)²
            assert_eq!(estimate.variance, (even > 0 && odd > 0).then_some([1.0; 3]), "{range:?}");
        });
        assert_eq!(film.error().is_some(), even > 0 && odd > 0);
        if let Some(error) = film.error() {
            assert!((error.rmse - 1.0).abs() < 1e-5 && (error.relative - 0.5).abs() < 1e-5, "{error:?}");
        }
    }
}

#[test]
fn the_twin_streams_tell_the_variance_without_bias() {
    // Uniform numbers: mean 1/2, variance of a pixel of n independent samples 1 / 12 n.
    let count = 16;
    let view = small_view(96, 96, Sequence::Independent);
    let mut film = Film::new(96, 96);
    render(&mut film, &view, &Pattern::Uniform, 0..count);
    let mut variance = Estimate::new();
    film.read(|estimate, _| variance.add(estimate.variance.unwrap()[0]));
    let truth = 1.0 / (12.0 * count as f64);
    let error = variance.standard_error().unwrap();
    assert!(error < 0.02 * truth, "the test is too coarse: {error} of {truth}");
    let z = variance.z_score(truth).unwrap();
    assert!(z.abs() < 4.0, "estimated {:?}, true {truth}, z = {z}", variance.mean());
}

#[test]
fn the_error_is_honest_for_every_sequence() {
    // ((A − B) / 2)² and ((A + B) / 2 − μ)² have the same mean if the streams are independent and alike.
    for sequence in Sequence::ALL {
        let view = small_view(96, 96, sequence);
        for count in [2, 8, 20] {
            let mut film = Film::new(96, 96);
            render(&mut film, &view, &Pattern::Step, 0..count);
            let (mut difference, mut variance) = (Estimate::new(), Estimate::new());
            film.read(|estimate, _| {
                let off = estimate.mean[0] - Pattern::STEP_MEAN;
                difference.add(estimate.variance.unwrap()[0] - off * off);
                variance.add(estimate.variance.unwrap()[0]);
            });
            let z = difference.z_score(0.0).unwrap();
            assert!(z.abs() < 4.0, "{sequence:?} at {count}: z = {z}");
            let resolution = difference.standard_error().unwrap() / variance.mean().unwrap();
            assert!(resolution < 0.05, "{sequence:?}: the test is too coarse: {resolution}");
        }
    }
}

#[test]
fn memory_is_flat() {
    for [width, height] in [[256, 256], [1920, 1080], [33, 33]] {
        let film = Film::new(width, height);
        let per_pixel = film.memory() as f64 / f64::from(width * height);
        assert!((72.0..=80.0).contains(&per_pixel), "{per_pixel} bytes a pixel");
    }
    let view = small_view(64, 64, Sequence::Sobol);
    let mut film = Film::new(64, 64);
    let before = film.memory();
    for index in 0..200 {
        render(&mut film, &view, &Pattern::Uniform, index..index + 1);
    }
    assert_eq!(film.memory(), before);
    assert_eq!(film.coverage()[0].samples.as_slice(), [0..200]);
}

#[test]
fn a_film_says_what_it_holds() {
    let view = small_view(70, 40, Sequence::Sobol);
    let mut film = Film::new(70, 40);
    assert_eq!((film.total_samples(), film.min_samples(), film.mean_samples()), (0, 0, 0.0));
    assert!(film.gaps().is_empty() && film.error().is_none() && film.holds(&(5..5)) && !film.holds(&(0..1)));
    render(&mut film, &view, &Pattern::Uniform, 0..4);
    render(&mut film, &view, &Pattern::Uniform, 10..14);
    // Twice is once.
    render(&mut film, &view, &Pattern::Uniform, 2..4);
    assert_eq!(film.gaps(), ranges(&[4..10]));
    assert!(film.holds(&(0..4)) && film.holds(&(11..14)) && !film.holds(&(3..5)) && !film.holds(&(9..11)));
    assert_eq!((film.total_samples(), film.min_samples(), film.mean_samples()), (70 * 40 * 8, 8, 8.0));
    assert_eq!(film.coverage().len(), 1);
    assert_eq!(film.coverage()[0].samples, ranges(&[0..4, 10..14]));
    assert_eq!(film.coverage()[0].tiles, 6);

    // Stopped midway, tiles differ.
    let stop = Stop::new();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let world = World::build(luch_scene::preset::cornell_box()).unwrap();
    let integrator = StopAfter::new(Pattern::Uniform, 2, &stop);
    let count = AtomicU64::new(0);
    let pass = pool.install(|| render_pass(&world, &view, &integrator, &mut film, 4..10, &stop, &count));
    assert!(pass.is_err());
    let coverage = film.coverage();
    assert!(coverage.len() > 1, "{coverage:?}");
    assert_eq!(coverage.iter().map(|c| c.tiles).sum::<usize>(), 6);
    assert_eq!(film.total_samples(), 70 * 40 * 8 + count.into_inner());
    assert_eq!((film.min_samples(), film.gaps()), (8, ranges(&[4..10])));
    let counts = film.sample_counts();
    assert!(counts.pixels().contains(&8.0) && counts.pixels().iter().any(|count| *count > 8.0));
    // And go on as if nothing had been.
    render(&mut film, &view, &Pattern::Uniform, 0..14);
    let mut straight = Film::new(70, 40);
    render(&mut straight, &view, &Pattern::Uniform, 0..14);
    assert_eq!(film, straight);
}

#[test]
fn a_failed_merge_changes_nothing() {
    let view = small_view(40, 33, Sequence::Sobol);
    let mut film = Film::new(40, 33);
    render(&mut film, &view, &Pattern::Uniform, 0..8);
    let before = film.clone();
    assert_eq!(film.merge(&Film::new(33, 40)), Err(MergeError::Size(40, 33, 33, 40)));
    assert_eq!(film, before);
    // The last tile alone overlaps: whatever came before it must not have been added.
    let mut other = Film::new(40, 33);
    render(&mut other, &view, &Pattern::Uniform, 6..12);
    assert_eq!(film.merge(&other), Err(MergeError::Overlap { samples: 6..8, x: 0, y: 0 }));
    assert_eq!(film, before);
    let error = film.merge(&other).unwrap_err().to_string();
    assert!(error.contains("6..8") && error.contains("(0, 0)"), "{error}");
    assert_eq!(film.merge(&film.clone()), Err(MergeError::Overlap { samples: 0..8, x: 0, y: 0 }));
    assert_eq!(film, before);
}

#[test]
fn a_merge_that_overlaps_in_one_tile_changes_none() {
    let view = small_view(96, 32, Sequence::Sobol);
    let world = World::build(luch_scene::preset::cornell_box()).unwrap();
    let partial = |batches| {
        let mut film = Film::new(96, 32);
        let stop = Stop::new();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        let integrator = StopAfter::new(Pattern::Uniform, batches, &stop);
        let pass = pool
            .install(|| render_pass(&world, &view, &integrator, &mut film, 0..4, &stop, &AtomicU64::new(0)));
        assert!(pass.is_err());
        film
    };
    let (one, two) = (partial(1), partial(2));
    let mut film = two.clone();
    assert!(matches!(film.merge(&one), Err(MergeError::Overlap { .. })));
    assert_eq!(film, two);
}

#[test]
fn the_picture_is_made_of_means() {
    let mut scene = luch_scene::preset::cornell_box();
    (scene.settings.width, scene.settings.height) = (20, 12);
    let view = luch_render::View::new(&scene.cameras[0].camera, &scene.settings);
    let world = World::build(scene).unwrap();
    let mut film = Film::new(20, 12);
    render_pass(&world, &view, &PathTracer::default(), &mut film, 0..8, &Stop::new(), &AtomicU64::new(0))
        .unwrap();
    let (picture, error) = (film.to_image(), film.standard_error());
    let means = film.read(|estimate, _| Some(estimate));
    for ((color, error), estimate) in picture.pixels().iter().zip(error.pixels()).zip(means.pixels()) {
        let estimate = estimate.unwrap();
        assert_eq!(color.to_array(), estimate.mean.map(|v| v as f32));
        assert_eq!(error.to_array(), estimate.variance.unwrap().map(|v| v.sqrt() as f32));
    }
    assert!(film.losses().is_none());
}
