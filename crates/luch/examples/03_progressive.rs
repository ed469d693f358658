//! A picture that grows while you watch: snapshots go to the file until the error is small, or a time is over.
//!
//! `cargo run --release -p luch --example 03_progressive -- growing.png`
#![allow(clippy::print_stdout)]

use luch::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).map_or_else(|| "growing.png".into(), PathBuf::from);

    let scene = luch::scene::preset::cornell_box();
    let view = Arc::new(View::new(&scene.cameras[0].camera, &scene.settings));
    let snapshot = path.clone();
    let job = RenderJob::start(JobPlan {
        world: Arc::new(World::build(scene)?),
        film: Film::new(view.width(), view.height()),
        view,
        integrator: Box::new(PathTracer::default()),
        goal: Goal { relative_error: Some(0.1), ..Goal::default() },
        threads: None,
        snapshot_every: Duration::from_millis(500),
        on_snapshot: Box::new(move |film, progress| {
            let written = save_image(&snapshot, &film.to_image(), &Default::default(), &Default::default());
            println!("{:6.1} samples a pixel, {written:?}", progress.samples_per_pixel);
        }),
    })?;

    // Meanwhile this thread is free: to draw, to listen, or to lose patience.
    while !job.is_finished() && job.progress().elapsed < Duration::from_secs(5) {
        std::thread::sleep(Duration::from_millis(10));
    }
    job.cancel();
    let end = job.join();
    println!("ended by {:?} at {:?}", end.ending, end.progress.error);
    save_image(&path, &end.film.to_image(), &Default::default(), &Default::default())?;
    Ok(())
}
