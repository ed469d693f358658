//! Known answers: scenes without noise, known powers, noise that is known to be normal.

use super::*;
use crate::integral::normal_quantile;
use crate::report::Report;
use luch_image::Rgb;
use luch_mesh::TriangleMesh;
use luch_scene::preset::{cornell_box, parallelogram};
use luch_scene::{Environment, Filter, Material, Shape};

fn subject(mut scene: Scene, width: u32, height: u32) -> Subject {
    (scene.settings.width, scene.settings.height) = (width, height);
    Subject::new(scene, None, Tone::default()).unwrap()
}

fn put(scene: &mut Scene, mesh: TriangleMesh, material: Material) {
    let (shape, material) = (scene.add_shape(Shape::Mesh(mesh)), scene.add_material(material));
    scene.add_instance(shape, material, glam::Affine3A::IDENTITY);
}

/// Nothing but a sky: every sample is the answer.
fn sky() -> Scene {
    let mut scene =
        Scene { environment: Some(Environment::Constant { radiance: Rgb::gray(0.75) }), ..Scene::default() };
    scene.add_camera(Camera::looking_at(glam::Vec3::ZERO, glam::Vec3::X, glam::Vec3::Y, 1.0));
    scene
}

/// A floor under a large lamp, all of it in sight: a smooth integrand in each pixel.
fn lamp_over_floor() -> Scene {
    use glam::Vec3;
    let mut scene = Scene::default();
    let floor = parallelogram(Vec3::new(-50.0, 0.0, -50.0), 100.0 * Vec3::Z, 100.0 * Vec3::X);
    put(&mut scene, floor, Material::diffuse(Rgb::gray(0.5)));
    let lamp = parallelogram(Vec3::new(-1.0, 2.0, -1.0), 2.0 * Vec3::X, 2.0 * Vec3::Z);
    put(&mut scene, lamp, Material::emitter(Rgb::gray(4.0)));
    scene.add_camera(Camera::looking_at(Vec3::new(0.0, 1.0, 3.0), Vec3::ZERO, Vec3::Y, 0.3));
    scene.settings.filter = Filter::Box { radius: 0.5 };
    scene
}

#[test]
fn without_noise_there_is_no_error() {
    let subject = subject(sky(), 20, 14);
    let plan =
        StudyPlan { truth: Truth::Value(0.75), samples: vec![1, 2, 8], replicates: 3, ..Default::default() };
    let done = AtomicU64::new(0);
    let work = Work { done: &done, ..Work::default() };
    let found = study(&subject, &plan, &work).unwrap();
    assert_eq!(done.into_inner(), plan.work(&subject));
    assert_eq!(found.series.len(), 4);
    for one in &found.series {
        assert!(one.is_exact && one.exponent.is_none() && one.equal_error_factor.is_none());
        for row in &one.rows {
            assert_eq!((row.relative_rmse, row.flip, row.bias_z), (None, 0.0, None));
        }
    }
    let html = found.page(Report::new("sky"), "clock", Some(&Tone::default())).to_html();
    assert!(html.contains("exact") && html.matches("<img").count() == 1 + 2 * 4);

    let plan = CoveragePlan { renders: 4, truth: Truth::Value(0.75), ..Default::default() };
    let found = coverage(&subject, &plan, &Work::default()).unwrap();
    assert!(found.classes.iter().all(|class| class.certain == 1.0 && class.student.is_empty()));
    found.page(Report::new("sky")).to_html();
}

#[test]
fn errors_fall_with_the_root_of_independent_samples() {
    let subject = subject(cornell_box(), 16, 12);
    let plan = StudyPlan {
        sequences: vec![Sequence::Independent],
        samples: vec![1, 2, 4, 8, 16, 32, 64],
        replicates: 6,
        truth: Truth::Samples(1024),
        ..Default::default()
    };
    let found = study(&subject, &plan, &Work::default()).unwrap();
    let one = &found.series[0];
    let exponent = one.exponent.unwrap();
    let [low, high] = exponent.interval.unwrap();
    // Half the interval is about two standard errors: four of them.
    let error = (high - low) / 4.0;
    assert!((exponent.value + 0.5).abs() < 4.0 * error && error < 0.06, "{exponent:?}");
    assert!(one.rows.iter().filter_map(|row| row.bias_z).all(|z| z.abs() < 4.0), "{:?}", one.rows);
    assert!(one.rows.windows(2).all(|pair| pair[1].flip < pair[0].flip));
    assert!((one.equal_error_factor.unwrap() - 1.0).abs() < 1e-9 && one.equal_time_factor == Some(1.0));
    // What others than the clock say is the same again.
    let plan = StudyPlan { samples: vec![4, 8], truth: Truth::Samples(64), ..plan };
    let again = || serde_json::to_string(&study(&subject, &plan, &Work::default()).unwrap()).unwrap();
    assert_eq!(again(), again());
}

/// Direct light shares nothing among pixels. The lamp has a form factor in closed form, but the reference need not be exact: its noise is taken
/// off, which this tests as well.
#[test]
fn even_points_are_better_where_pixels_are_smooth() {
    let subject = subject(lamp_over_floor(), 16, 12);
    let plan = StudyPlan {
        sequences: vec![Sequence::Independent, Sequence::Sobol],
        integrators: vec![Name::Direct],
        samples: vec![4, 8, 16, 32, 64],
        truth: Truth::Samples(2048),
        ..Default::default()
    };
    let found = study(&subject, &plan, &Work::default()).unwrap();
    let [independent, sobol] = [0, 1].map(|at| &found.series[at]);
    let (plain, even) = (independent.exponent.unwrap(), sobol.exponent.unwrap());
    assert!((plain.value + 0.5).abs() < 0.1, "{plain:?}");
    // Clearly steeper than independent points can be.
    assert!(even.interval.unwrap()[1] < -0.65, "{even:?}");
    assert!(sobol.equal_error_factor.unwrap() > 4.0, "{:?}", sobol.equal_error_factor);
    // The first pixel row's truth by a study against itself: paths of one scattering are the same light.
    let against_path = StudyPlan {
        integrators: vec![Name::Path { max_depth: 1 }],
        sequences: vec![Sequence::Sobol],
        ..plan
    };
    let last = study(&subject, &against_path, &Work::default()).unwrap();
    assert!((last.references[0].mean / found.references[0].mean - 1.0).abs() < 1e-3);
}

/// Normal numbers for the streams of a pixel.
fn toy(render: u64, pixels: u64, deviation: impl Fn(u64) -> f64) -> Vec<[f64; 2]> {
    let normal = |at: u64| {
        let word = luch_sampling::hash::word(luch_sampling::hash::combine(0x746f79, render), at);
        normal_quantile(((word >> 12) as f64 + 0.5) / (1u64 << 52) as f64)
    };
    (0..pixels)
        .map(|pixel| {
            let [a, b] = [0, 1].map(|stream| deviation(pixel) * normal(2 * pixel + stream));
            [(a + b) / 2.0, (a - b).abs() / 2.0]
        })
        .collect()
}

#[test]
fn intervals_of_normal_noise_hold_as_often_as_they_say() {
    let levels = [0.5, 0.68, 0.9, 0.95, 0.99];
    for reading in [Reading::Student(1.0), Reading::Normal] {
        let mut tally = Tally::new(reading, &levels);
        (0..100).for_each(|render| tally.add(toy(render, 200, |pixel| 1.0 + pixel as f64)));
        assert_eq!(tally.trials(), 20_000.0);
        for found in tally.measured() {
            let expected = reading.expected(found.level);
            let error = (expected * (1.0 - expected) / 20_000.0).sqrt();
            assert!((found.coverage - expected).abs() < 4.0 * error, "{reading:?} {found:?} {expected}");
            // 1.96 errors to each side, whatever renders say of their scatter.
            let width = (found.interval[1] - found.interval[0]) / (2.0 * 1.96 * error);
            assert!((0.6..1.6).contains(&width), "{width}");
        }
    }
    // By Student's t that is the level itself; ± 1.96 of two streams hold 70 % and not 95 %.
    assert!(levels.iter().all(|level| (Reading::Student(1.0).expected(*level) - level).abs() < 1e-9));
    assert!((Reading::Normal.expected(0.95) - 0.6996).abs() < 1e-3);
}

#[test]
fn pixels_that_err_together_count_once() {
    let mut tally = Tally::new(Reading::Student(1.0), &[0.68]);
    for render in 0..50 {
        let one = toy(render, 1, |_| 1.0)[0];
        tally.add(vec![one; 300]);
    }
    let found = tally.measured()[0];
    let alone = binomial_interval(50.0 * found.coverage, 50.0, 0.95);
    assert!(found.interval.iter().zip(alone).all(|(a, b)| (a - b).abs() < 0.01), "{found:?} {alone:?}");
}

#[test]
fn binomial_intervals_are_those_of_tables() {
    // Clopper and Pearson's interval of 8 in 10: 0.4439 to 0.9748; of 0 in 20: 0 to 0.1684.
    let [low, high] = binomial_interval(8.0, 10.0, 0.95);
    assert!((low - 0.4439).abs() < 1e-4 && (high - 0.9748).abs() < 1e-4, "{low} {high}");
    let [low, high] = binomial_interval(0.0, 20.0, 0.95);
    assert!(low == 0.0 && (high - 0.1684).abs() < 1e-4, "{high}");
}

#[test]
fn stated_errors_of_a_box_are_right_on_average() {
    let subject = subject(cornell_box(), 16, 12);
    let plan = CoveragePlan {
        renders: 60,
        sequence: Sequence::Independent,
        truth: Truth::Samples(1024),
        ..Default::default()
    };
    let done = AtomicU64::new(0);
    let found = coverage(&subject, &plan, &Work { done: &done, ..Work::default() }).unwrap();
    assert_eq!(done.into_inner(), plan.work(&subject));
    let all = &found.classes[0];
    assert_eq!((all.name.as_str(), all.pixels), ("all", 192));
    // Twin streams estimate the variance without bias.
    let off = (all.stated_over_true - 1.0).abs();
    assert!(off < 4.0 * all.stated_over_true_error && all.stated_over_true_error < 0.05, "{all:?}");
    // 16 samples of independent paths are not far from normal.
    let middle = all.student.iter().find(|found| found.level == 0.68).unwrap();
    assert!((middle.coverage - 0.68).abs() < 0.06, "{middle:?}");
    let mean = found.mean.student.iter().find(|found| found.level == 0.95).unwrap();
    assert!(mean.interval[1] > 0.9, "{mean:?}");
    let page = found.page(Report::new("box"));
    assert!(page.to_html().contains("noisy") && page.data.contains_key("results"));
}

#[test]
fn plans_that_cannot_be_followed_say_so() {
    let subject = subject(sky(), 4, 4);
    let work = Work::default();
    let says = |plan: StudyPlan| study(&subject, &plan, &work).unwrap_err().to_string();
    assert!(says(StudyPlan { samples: vec![0, 1], ..Default::default() }).contains("from 1 on"));
    assert!(says(StudyPlan { replicates: 0, ..Default::default() }).contains("repetitions"));
    assert!(says(StudyPlan { truth: Truth::Samples(1), ..Default::default() }).contains("2 samples"));
    assert!(
        says(StudyPlan { truth: Truth::Film(Box::new(Film::new(4, 4))), ..Default::default() })
            .contains("not finished")
    );
    let small = Truth::Picture { light: luch_image::Image::filled(3, 4, Rgb::WHITE), standard_error: None };
    assert!(says(StudyPlan { truth: small, ..Default::default() }).contains("3×4"));
    let broken = luch_image::Image::filled(4, 4, Rgb::gray(f32::NAN));
    let broken = Truth::Picture { light: broken, standard_error: None };
    assert!(says(StudyPlan { truth: broken, ..Default::default() }).contains("16 pixels"));
    let silent = Truth::Picture { light: luch_image::Image::filled(4, 4, Rgb::WHITE), standard_error: None };
    let plan = CoveragePlan { truth: silent, ..Default::default() };
    assert!(coverage(&subject, &plan, &work).unwrap_err().to_string().contains("stderr"));
    let stop = Stop::new();
    stop.request();
    let stopped = study(&subject, &StudyPlan::default(), &Work { stop: &stop, ..Work::default() });
    assert!(matches!(stopped, Err(RenderingError::Stopped(_))));
}

#[test]
fn laws_are_found_again() {
    let samples = [1, 2, 4, 8, 16];
    let squares: Vec<Vec<f64>> = (0..4)
        .map(|r| samples.iter().map(|&n| 3.0 / (n * n) as f64 * (1.0 + 0.1 * f64::from(r)) + 0.001).collect())
        .collect();
    let found = exponent(&samples, &squares, 0.001, 0.001).unwrap();
    assert!((found.value + 1.0).abs() < 1e-12 && found.sizes == 5, "{found:?}");
    assert!(found.interval.unwrap().iter().all(|end| (end + 1.0).abs() < 1e-9));
    assert_eq!(exponent(&samples, &squares, 0.001, 10.0), None);
    let curve = [[1.0, 8.0], [4.0, 4.0], [16.0, 1.0]];
    assert_eq!(
        [16.0, 4.0, 2.0, 1.0, 0.5]
            .map(|e| law::samples_for(&curve, -1.0, e).map(|n| (n * 1e6).round() / 1e6)),
        [Some(0.5), Some(4.0), Some(8.0), Some(16.0), Some(32.0)]
    );
}
