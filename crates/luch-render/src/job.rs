//! A rendering that goes on by itself: a thread, goals, pause, cancel, snapshots.

mod control;
mod progress;

use control::Control;
pub use progress::Progress;
use progress::Tracker;

use crate::film::Film;
use crate::integrator::Integrator;
use crate::pass::render_pass;
use crate::view::View;
use crate::world::World;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::ops::Range;
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// More samples than a pixel can have of one randomisation.
const ENDLESS: u64 = 1 << 33;

/// Fewest samples of a pixel at which an error estimate may end the work.
const FEWEST_FOR_ERROR: u64 = 16;

/// Least time between snapshots: some samples should be made in between.
const SHORTEST_BETWEEN_SNAPSHOTS: Duration = Duration::from_millis(10);

/// When a rendering is done: when the first of its goals is reached.
#[derive(Clone, Debug, PartialEq)]
pub struct Goal {
    /// The samples that every pixel should have; none other are made.
    pub samples: Range<u64>,
    /// Time from the start of the job.
    pub time: Option<Duration>,
    /// Relative error of the picture ([`ErrorEstimate::relative`](crate::ErrorEstimate)), judged whenever the number of
    /// samples has doubled.
    pub relative_error: Option<f64>,
}

impl Default for Goal {
    /// None at all: until cancelled.
    fn default() -> Self {
        Self { samples: 0..ENDLESS, time: None, relative_error: None }
    }
}

impl Goal {
    /// The first `count` samples of every pixel.
    pub fn samples(count: u64) -> Self {
        Self { samples: 0..count, ..Self::default() }
    }
}

/// Why a rendering ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// Every pixel has the samples asked for.
    Samples,
    /// The time is over.
    Time,
    /// The error is small enough.
    Error,
    /// It was cancelled.
    Cancelled,
}

/// What a rendering leaves behind.
#[derive(Debug)]
pub struct JobEnd {
    /// The film as it is now.
    pub film: Film,
    /// Why it ended.
    pub ending: Ending,
    /// The last progress.
    pub progress: Progress,
}

/// What is done with the film at each snapshot.
pub type OnSnapshot = Box<dyn FnMut(&Film, &Progress) + Send>;

/// What to do, from now on, in a thread of its own.
pub struct JobPlan {
    /// What is rendered.
    pub world: Arc<World>,
    /// From where.
    pub view: Arc<View>,
    /// How.
    pub integrator: Box<dyn Integrator>,
    /// Where the samples go; may hold some already.
    pub film: Film,
    /// Until when.
    pub goal: Goal,
    /// Worker threads; `None` for one on each processor.
    pub threads: Option<usize>,
    /// Time between snapshots, at least 10 ms; the first is taken as soon as every pixel has a sample.
    pub snapshot_every: Duration,
    /// Is shown the film at each snapshot; rendering waits for it.
    pub on_snapshot: OnSnapshot,
}

/// A rendering under way.
#[derive(Debug)]
pub struct RenderJob {
    control: Arc<Control>,
    tracker: Arc<Tracker>,
    thread: Option<JoinHandle<(Film, Ending)>>,
}

/// The threads could not be had.
#[derive(Debug, thiserror::Error)]
#[error("cannot start the threads of the rendering: {0}")]
pub struct StartError(String);

impl RenderJob {
    /// Starts rendering.
    ///
    /// # Errors
    /// If the system refuses the threads.
    pub fn start(plan: JobPlan) -> Result<Self, StartError> {
        let pool = ThreadPoolBuilder::new()
            .num_threads(plan.threads.unwrap_or(0))
            .thread_name(|i| format!("render {i}"))
            .build()
            .map_err(|error| StartError(error.to_string()))?;
        let control = Arc::new(Control::default());
        let tracker = Arc::new(Tracker::new(&plan.film, &plan.goal));
        let (job_control, job_tracker) = (Arc::clone(&control), Arc::clone(&tracker));
        let thread = std::thread::Builder::new()
            .name("render job".into())
            .spawn(move || Worker { pool, control: job_control, tracker: job_tracker, plan }.run())
            .map_err(|error| StartError(error.to_string()))?;
        Ok(Self { control, tracker, thread: Some(thread) })
    }

    /// How far it is.
    pub fn progress(&self) -> Progress {
        self.tracker.progress()
    }

    /// True once the work has ended; [`RenderJob::join`] then returns at once.
    pub fn is_finished(&self) -> bool {
        self.thread.as_ref().is_none_or(JoinHandle::is_finished)
    }

    /// Asks for the end; samples finished so far are kept.
    pub fn cancel(&self) {
        self.control.cancel();
    }

    /// Holds the work until [`RenderJob::resume`].
    pub fn pause(&self) {
        self.control.pause();
    }

    /// Goes on after a pause.
    pub fn resume(&self) {
        self.control.resume();
    }

    /// Waits for the end.
    ///
    /// # Panics
    /// If the rendering thread panicked.
    pub fn join(mut self) -> JobEnd {
        let thread = self.thread.take().expect("a job is joined once");
        match thread.join() {
            Ok((film, ending)) => JobEnd { film, ending, progress: self.tracker.progress() },
            Err(panic) => std::panic::resume_unwind(panic),
        }
    }
}

impl Drop for RenderJob {
    /// A job that nobody waits for is cancelled.
    fn drop(&mut self) {
        if let Some(thread) = self.thread.take() {
            self.control.cancel();
            // Its panic, if any, has nobody left to hear it.
            let _ = thread.join();
        }
    }
}

/// The job's own thread.
struct Worker {
    pool: ThreadPool,
    control: Arc<Control>,
    tracker: Arc<Tracker>,
    plan: JobPlan,
}

impl Worker {
    fn run(mut self) -> (Film, Ending) {
        let started = Instant::now();
        let time_up = self.plan.goal.time.and_then(|time| started.checked_add(time));
        let every = self.plan.snapshot_every.max(SHORTEST_BETWEEN_SNAPSHOTS);
        // None if that is past the end of time.
        let mut next_snapshot = started.checked_add(every);
        let wanted = self.plan.goal.samples.clone();
        let mut end = wanted.start;
        let mut first = true;
        let ending = 'work: loop {
            if self.reached_error() {
                break Ending::Error;
            }
            if end >= wanted.end {
                break Ending::Samples;
            }
            // Quality is best at powers of two: every pass doubles.
            end = wanted.start.saturating_add((end - wanted.start).saturating_mul(2).max(1)).min(wanted.end);
            let range = wanted.start..end;
            loop {
                if self.control.is_cancelled() {
                    break 'work Ending::Cancelled;
                }
                if time_up.is_some_and(|moment| Instant::now() >= moment) {
                    break 'work Ending::Time;
                }
                self.control.wait_while_paused();
                let deadline = [time_up, next_snapshot].into_iter().flatten().min();
                let stop = self.control.stop(deadline);
                let Self { pool, tracker, plan, .. } = &mut self;
                let pass = pool.install(|| {
                    let film = &mut plan.film;
                    render_pass(
                        &plan.world,
                        &plan.view,
                        &*plan.integrator,
                        film,
                        range.clone(),
                        &stop,
                        &tracker.samples,
                    )
                });
                let complete = pass.is_ok();
                if next_snapshot.is_some_and(|moment| Instant::now() >= moment) || (complete && first) {
                    self.snapshot();
                    next_snapshot = Instant::now().checked_add(every);
                }
                if complete {
                    first = false;
                    break;
                }
            }
            self.tracker.note_error(&self.plan.film);
        };
        self.tracker.note_error(&self.plan.film);
        self.tracker.freeze();
        (self.plan.film, ending)
    }

    fn snapshot(&mut self) {
        self.tracker.note_error(&self.plan.film);
        let progress = self.tracker.progress();
        (self.plan.on_snapshot)(&self.plan.film, &progress);
    }

    /// Whether the error asked for is reached, judged between passes only.
    fn reached_error(&self) -> bool {
        let Some(goal) = self.plan.goal.relative_error else { return false };
        self.plan.film.min_samples() >= FEWEST_FOR_ERROR
            && self.plan.film.error().is_some_and(|error| error.relative <= goal)
    }
}
