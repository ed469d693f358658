//! How long a rendering takes to end once it is cancelled: many cancels at random moments of a large picture.
//!
//! `cargo run --release -p luch-render --example cancel_latency [CANCELS]`

use luch_render::{Film, Goal, JobPlan, PathTracer, RenderJob, View, World};
use luch_sampling::{Domain, Sampler, Sequence};
use std::io::Write;
use std::sync::Arc;
use std::time::{Duration, Instant};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let cancels: u64 = std::env::args().nth(1).map_or(Ok(40), |count| count.parse())?;
    let mut scene = luch_scene::preset::cornell_box();
    (scene.settings.width, scene.settings.height) = (1920, 1080);
    let view = Arc::new(View::new(&scene.cameras[0].camera, &scene.settings));
    let world = Arc::new(World::build(scene)?);

    let mut latencies = Vec::new();
    for index in 0..cancels {
        let job = RenderJob::start(JobPlan {
            world: Arc::clone(&world),
            view: Arc::clone(&view),
            integrator: Box::new(PathTracer::default()),
            film: Film::new(view.width(), view.height()),
            goal: Goal::default(),
            threads: None,
            snapshot_every: Duration::from_secs(1),
            on_snapshot: Box::new(|_, _| {}),
        })?;
        let [u, ..] = Sampler::at(Sequence::Independent, 0, [0, 0], index).group(Domain::new(0, 0));
        std::thread::sleep(Duration::from_secs_f32(0.02 + 1.5 * u));
        let asked = Instant::now();
        job.cancel();
        let end = job.join();
        latencies.push(asked.elapsed().as_secs_f64() * 1e3);
        drop(end);
    }
    latencies.sort_by(f64::total_cmp);
    let (median, most) = (latencies[latencies.len() / 2], latencies[latencies.len() - 1]);
    writeln!(
        std::io::stdout(),
        "{cancels} cancels at 1920×1080: median {median:.1} ms, longest {most:.1} ms"
    )?;
    Ok(())
}
