//! Samples a second of a pass over the Cornell box, against the plain path tracer in the same run.
//!
//! `cargo bench -p luch-render --bench pass`

use luch_render::{Film, Integrator, PathTracer, PlainPathTracer, Stop, View, World, render_pass};
use rayon::ThreadPoolBuilder;
use std::io::Write;
use std::sync::atomic::AtomicU64;
use std::time::Instant;

/// Samples of a pixel in one measurement, and measurements of which the median counts.
const SAMPLES: u64 = 8;
const RUNS: usize = 5;

/// Median samples a second.
fn rate(world: &World, view: &View, integrator: &dyn Integrator, threads: usize) -> f64 {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("threads for the measurement");
    let measure = |run: usize| {
        let mut film = Film::new(view.width(), view.height());
        let count = AtomicU64::new(0);
        // The first run only warms up; each has other samples.
        let first = run as u64 * SAMPLES;
        let started = Instant::now();
        let pass = pool.install(|| {
            let range = first..first + SAMPLES;
            render_pass(world, view, integrator, &mut film, range, &Stop::new(), &count)
        });
        let elapsed = started.elapsed().as_secs_f64();
        assert!(pass.is_ok(), "nobody asked to stop");
        film.total_samples() as f64 / elapsed
    };
    let mut rates: Vec<f64> = (0..=RUNS).map(measure).skip(1).collect();
    rates.sort_by(f64::total_cmp);
    rates[RUNS / 2]
}

fn main() -> std::io::Result<()> {
    let scene = luch_scene::preset::cornell_box();
    let view = View::new(&scene.cameras[0].camera, &scene.settings);
    let world = World::build(scene).expect("the preset is sound");
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "Cornell box, {}×{} pixels, {SAMPLES} samples each, median of {RUNS}",
        view.width(),
        view.height()
    )?;
    writeln!(out, "threads  path [M/s]  plain path [M/s]  path / plain path")?;
    for threads in [1, 2] {
        let path = rate(&world, &view, &PathTracer::default(), threads);
        let plain = rate(&world, &view, &PlainPathTracer { max_depth: 64 }, threads);
        let (millions, ratio) = ([path / 1e6, plain / 1e6], path / plain);
        writeln!(out, "{threads:7}  {:10.3}  {:16.3}  {ratio:17.3}", millions[0], millions[1])?;
    }
    Ok(())
}
