//! How far a rendering is, and how long it will take.

use super::{FEWEST_FOR_ERROR, Goal};
use crate::film::{ErrorEstimate, Film};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// How far a rendering is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Samples in the film, all pixels together.
    pub samples: u64,
    /// Mean samples of a pixel.
    pub samples_per_pixel: f64,
    /// Samples of a pixel that are asked for, if a number is.
    pub samples_wanted: Option<u64>,
    /// Time since the job began.
    pub elapsed: Duration,
    /// Samples a second since the job began.
    pub rate: f64,
    /// The latest error estimate.
    pub error: Option<ErrorEstimate>,
    /// Guess of the time to the nearest goal.
    pub remaining: Option<Duration>,
}

/// Follows a job from its own thread and tells others.
#[derive(Debug)]
pub(super) struct Tracker {
    /// Samples added by this job.
    pub(super) samples: AtomicU64,
    before: u64,
    /// Those of them that the goal asks for.
    before_of_goal: u64,
    pixels: u64,
    goal: Goal,
    started: Instant,
    errors: Mutex<Errors>,
}

#[derive(Debug, Default)]
struct Errors {
    latest: Option<(u64, ErrorEstimate)>,
    /// Exponent of the fall of the error with samples, as seen so far.
    slope: Option<f64>,
    ended: Option<Duration>,
}

impl Tracker {
    pub(super) fn new(film: &Film, goal: &Goal) -> Self {
        Self {
            samples: AtomicU64::new(0),
            before: film.total_samples(),
            before_of_goal: film.samples_within(&goal.samples),
            pixels: u64::from(film.width()) * u64::from(film.height()),
            goal: goal.clone(),
            started: Instant::now(),
            errors: Mutex::new(Errors::default()),
        }
    }

    fn errors(&self) -> MutexGuard<'_, Errors> {
        self.errors.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Looks at the film's error.
    pub(super) fn note_error(&self, film: &Film) {
        let Some(error) = film.error() else { return };
        let samples = film.total_samples();
        let mut errors = self.errors();
        if let Some((earlier, before)) = errors.latest
            && samples >= earlier * 2
            && error.rmse > 0.0
            && before.rmse > 0.0
        {
            let slope = libm::log(before.rmse / error.rmse) / libm::log(samples as f64 / earlier as f64);
            errors.slope = Some(slope.clamp(0.4, 1.5));
        }
        if errors.latest.is_none_or(|(earlier, _)| samples >= earlier * 2) {
            errors.latest = Some((samples, error));
        } else if let Some((_, latest)) = &mut errors.latest {
            *latest = error;
        }
    }

    /// Stops the clock.
    pub(super) fn freeze(&self) {
        let elapsed = self.started.elapsed();
        self.errors().ended.get_or_insert(elapsed);
    }

    pub(super) fn progress(&self) -> Progress {
        let (error, slope, ended) = {
            let errors = self.errors();
            (errors.latest.map(|(_, error)| error), errors.slope, errors.ended)
        };
        let elapsed = ended.unwrap_or_else(|| self.started.elapsed());
        let added = self.samples.load(Ordering::Relaxed);
        let samples = self.before + added;
        let rate = added as f64 / elapsed.as_secs_f64().max(1e-9);
        let per_pixel = samples as f64 / self.pixels as f64;
        let wanted = Some(self.goal.samples.end.saturating_sub(self.goal.samples.start))
            .filter(|count| *count < super::ENDLESS);

        let by_time = self.goal.time.map(|time| time.saturating_sub(elapsed));
        let after = |missing: f64| Duration::try_from_secs_f64((missing / rate).max(0.0)).ok();
        let by_samples = wanted.and_then(|count| {
            after(count as f64 * self.pixels as f64 - (self.before_of_goal + added) as f64)
        });
        let by_error = self.goal.relative_error.zip(error).and_then(|(goal, error)| {
            let needed = per_pixel * libm::pow(error.relative / goal, 1.0 / slope.unwrap_or(0.5));
            // Judged at doublings only.
            let needed = libm::exp2(libm::ceil(libm::log2(needed.max(FEWEST_FOR_ERROR as f64))));
            after((needed - per_pixel) * self.pixels as f64)
        });
        Progress {
            samples,
            samples_per_pixel: per_pixel,
            samples_wanted: wanted,
            elapsed,
            rate,
            error,
            remaining: [by_time, by_samples, by_error].into_iter().flatten().min(),
        }
    }
}
