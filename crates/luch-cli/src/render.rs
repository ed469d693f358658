//! `luch render`: a job, watched until it is done or somebody has seen enough.

mod plan;
mod resume;
mod saver;

use crate::args::{ProgressStyle, RenderArgs};
use crate::failure::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::layers::NEVER;
use crate::progress::{self, Reporter};
use crate::terminal;
use luch::render::{Ending, JobEnd, JobPlan, RenderJob, from_settings};
use plan::Plan;
use saver::Saver;
use std::sync::Arc;
use std::time::Duration;

/// Time between two looks at the job: how late its end or a wish to end may be noticed.
const LOOK: Duration = Duration::from_millis(10);

pub(crate) fn run(args: &RenderArgs) -> Result<Outcome, Failure> {
    let interrupt = Interrupt::install()?;
    let plan = Plan::make(args)?;
    let Plan { world, view, film, goal, sources, files, endless } = plan;
    let threads = args.work.threads.map(usize::from);
    let saver = Arc::new(Saver::new(files, sources, &world, &view, threads, interrupt.pen()));
    let style = if args.work.quiet { ProgressStyle::None } else { args.work.progress };
    let mut reporter = Reporter::new(style, endless, goal.time);
    reporter.start(&progress::Start {
        scene: &saver.sources.provenance.source,
        fingerprint: saver.sources.fingerprint.to_hex(),
        width: view.width(),
        height: view.height(),
        samples_in_film: film.mean_samples(),
        outputs: saver.paths(),
    });

    interrupt.work_begins();
    let snapshots = Arc::clone(&saver);
    let job = RenderJob::start(JobPlan {
        world: Arc::clone(&world),
        view: Arc::clone(&view),
        integrator: from_settings(world.scene.settings.integrator, &view),
        film,
        goal,
        threads,
        snapshot_every: args.work.every.min(NEVER),
        on_snapshot: Box::new(move |film, _| snapshots.snapshot(film)),
    })?;
    while !job.is_finished() {
        if interrupt.wait(LOOK) {
            job.cancel();
        }
        reporter.look(&job.progress());
    }
    let end = job.join();
    let interrupted = end.ending == Ending::Cancelled;

    let troubles = saver.finish(&end.film)?;
    reporter.end(&end, saver.paths());
    if reporter.tells() {
        summarise(&end, &saver, troubles.is_empty());
    }
    if !troubles.is_empty() {
        return Err(Failure::new(troubles.join("\nerror: ")));
    }
    Ok(if interrupted { Outcome::Interrupted } else { Outcome::Done })
}

/// What happened, in a few lines.
fn summarise(end: &JobEnd, saver: &Saver, saved: bool) {
    let progress = &end.progress;
    let how = match end.ending {
        Ending::Samples => "done",
        Ending::Time => "time is over",
        Ending::Error => "the error is small enough",
        Ending::Cancelled => "interrupted",
    };
    let error = progress.error.map_or(String::new(), |error| {
        format!(", estimated error {} %", terminal::short(error.relative * 100.0))
    });
    terminal::complain(&format!(
        "{how}: {} samples per pixel in {} s ({}samples/s){error}",
        terminal::samples(progress.samples_per_pixel),
        terminal::short(progress.elapsed.as_secs_f64()),
        terminal::metric(progress.rate),
    ));
    let losses = end.film.losses();
    if losses.saturated > 0 {
        terminal::complain(&format!(
            "warning: {} numbers of samples were too bright to be added in full and were cut",
            losses.saturated
        ));
    }
    if losses.invalid > 0 {
        terminal::complain(&format!(
            "warning: {} numbers of samples were infinite or not numbers and count as black",
            losses.invalid
        ));
    }
    if saved {
        let paths: Vec<String> = saver.paths().iter().map(|path| path.display().to_string()).collect();
        terminal::complain(&format!("wrote {}", paths.join(", ")));
    }
    if end.ending == Ending::Cancelled {
        let advice = match saver.keeps_films() {
            true => format!("continue with: {}", resume::command()),
            false => "no film was kept: the work cannot be continued".to_owned(),
        };
        terminal::complain(&advice);
    }
}
