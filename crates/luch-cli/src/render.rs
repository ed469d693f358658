//! `luch render`: a job, watched until it is done or somebody has seen enough.

mod plan;
mod resume;
mod saver;

use crate::args::{ProgressStyle, RenderArgs};
use crate::failure::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::layers::NEVER;
use crate::processor_time;
use crate::progress::{self, Alone, Reporter};
use crate::terminal;
use luch::render::{Ending, JobEnd, JobPlan, RenderJob, from_settings};
use plan::Plan;
pub(crate) use plan::announce;
use saver::Saver;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

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
    let saving = Arc::new(Mutex::new(Spent::default()));
    let spent_saving = Arc::clone(&saving);
    let before = processor_time::of_process();
    let job = RenderJob::start(JobPlan {
        world: Arc::clone(&world),
        view: Arc::clone(&view),
        integrator: from_settings(world.scene.settings.integrator, &view),
        film,
        goal,
        threads,
        snapshot_every: args.work.every.min(NEVER),
        on_snapshot: Box::new(move |film, _| {
            let (began, before) = (Instant::now(), processor_time::of_process());
            snapshots.snapshot(film);
            let mut spent = spent_saving.lock().unwrap_or_else(PoisonError::into_inner);
            let processor = processor_time::since(before, processor_time::of_process());
            spent.add(Spent { elapsed: began.elapsed(), processor: processor.unwrap_or_default() });
        }),
    })?;
    while !job.is_finished() {
        if interrupt.wait(LOOK) {
            job.cancel();
        }
        reporter.look(&job.progress());
    }
    let end = job.join();
    let processor = processor_time::since(before, processor_time::of_process());
    let saving = *saving.lock().unwrap_or_else(PoisonError::into_inner);
    // Nothing but saving goes on while the rendering waits for a snapshot.
    let alone = Alone {
        elapsed: end.progress.elapsed.saturating_sub(saving.elapsed),
        processor: processor.map(|time| time.saturating_sub(saving.processor)),
    };
    let interrupted = end.ending == Ending::Cancelled;

    let troubles = saver.finish(&end.film)?;
    reporter.end(&end, &alone, saver.paths());
    if reporter.tells() {
        summarise(&end, &alone, &saver, troubles.is_empty());
    }
    if !troubles.is_empty() {
        return Err(Failure::new(troubles.join("\nerror: ")));
    }
    Ok(if interrupted { Outcome::Interrupted } else { Outcome::Done })
}

/// What saving cost so far.
#[derive(Clone, Copy, Debug, Default)]
struct Spent {
    elapsed: Duration,
    processor: Duration,
}

impl Spent {
    fn add(&mut self, more: Self) {
        self.elapsed += more.elapsed;
        self.processor += more.processor;
    }
}

/// What happened, in a few lines.
fn summarise(end: &JobEnd, alone: &Alone, saver: &Saver, saved: bool) {
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
    let processor = alone.processor.map_or(String::new(), |time| {
        format!(", {} s of processor time", terminal::short(time.as_secs_f64()))
    });
    terminal::complain(&format!(
        "{how}: {} samples per pixel in {} s ({}samples/s){processor}{error}",
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
