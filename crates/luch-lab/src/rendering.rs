//! The laboratory in the renderer: how fast pictures converge, and whether what they say of their own error is true.
//!
//! [`study`] renders a scene by several sequences and integrators, with independent repetitions, and holds them against a [`Truth`];
//! [`coverage`] asks how often the error that a picture states held the truth.
//!
//! ```
//! use luch_lab::rendering::{StudyPlan, Subject, Truth, Work, study};
//! use luch_sampling::Sequence;
//!
//! let scene = luch_scene::preset::furnace(luch_image::Rgb::gray(0.5), luch_image::Rgb::WHITE);
//! let subject = Subject::new(scene, None, Default::default())?;
//! let plan = StudyPlan { sequences: vec![Sequence::Sobol], samples: vec![1, 2, 4, 8, 16], truth: Truth::Value(2.0), ..Default::default() };
//! let found = study(&subject, &plan, &Work::default())?;
//! let last = found.series[0].rows.last().unwrap();
//! assert!(last.relative_rmse.unwrap() < 0.1 && last.bias_z.unwrap().abs() < 4.0);
//! # Ok::<(), luch_lab::rendering::RenderingError>(())
//! ```
//!
//! Pixels of a [bundle](luch_render::BUNDLE) share part of their noise. Whatever is said here of the mean of many pixels therefore comes from
//! [`Film::mean`](luch_render::Film::mean), which compares streams bundle by bundle, or from the scatter of independent renders; never from
//! pixels counted as if they were independent.

mod classes;
mod coverage;
mod coverage_page;
mod law;
mod page;
mod reading;
mod reference;
mod study;
#[cfg(test)]
mod tests;

pub use classes::PixelClass;
pub use coverage::{ClassCoverage, CoveragePlan, CoverageStudy, coverage};
pub use law::{Exponent, exponent};
pub use reading::{Measured, Reading, Tally, binomial_interval};
pub use reference::{Reference, Truth};
pub use study::{Row, Series, Study, StudyPlan, study};

use luch_image::tone::Tone;
use luch_render::{Film, Integrator, Stop, Stopped, UnsoundScene, View, World, from_settings, render_pass};
use luch_sampling::{Sequence, hash};
use luch_scene::{Camera, Integrator as Name, Scene, Settings};
use std::sync::atomic::AtomicU64;
use std::time::{Duration, Instant};

/// What is rendered.
#[derive(Debug)]
pub struct Subject {
    world: World,
    camera: Camera,
    settings: Settings,
    tone: Tone,
}

impl Subject {
    /// A scene with its settings, seen by a camera, or by its first. `tone` is how it is shown: FLIP compares what is seen.
    ///
    /// # Errors
    /// If the scene cannot be rendered, or has no camera.
    pub fn new(scene: Scene, camera: Option<Camera>, tone: Tone) -> Result<Self, RenderingError> {
        let camera = camera.or_else(|| scene.camera(None).copied()).ok_or(RenderingError::NoCamera)?;
        let settings = scene.settings;
        Ok(Self { world: World::build(scene)?, camera, settings, tone })
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.settings.width, self.settings.height]
    }

    /// Number of pixels.
    pub fn pixels(&self) -> u64 {
        u64::from(self.settings.width) * u64::from(self.settings.height)
    }

    /// What one rendering needs.
    fn start(&self, sequence: Sequence, integrator: Name, seed: u64) -> Run<'_> {
        let settings = Settings { sequence, integrator, seed, ..self.settings };
        let view = View::new(&self.camera, &settings);
        let film = Film::new(view.width(), view.height());
        Run { world: &self.world, integrator: from_settings(integrator, &view), view, film }
    }
}

/// A rendering that is taken further and further.
struct Run<'a> {
    world: &'a World,
    view: View,
    integrator: Box<dyn Integrator>,
    film: Film,
}

impl Run<'_> {
    /// Until every pixel has `samples`.
    fn advance(&mut self, samples: u64, work: &Work<'_>) -> Result<(), Stopped> {
        // Passes double, as everywhere.
        let mut end = self.film.min_samples().max(1);
        loop {
            end = end.min(samples);
            render_pass(
                self.world,
                &self.view,
                &*self.integrator,
                &mut self.film,
                0..end,
                work.stop,
                work.done,
            )?;
            if end == samples {
                return Ok(());
            }
            end = end.saturating_mul(2);
        }
    }
}

/// How work is watched and ended.
#[derive(Clone, Copy)]
pub struct Work<'a> {
    /// Ends it.
    pub stop: &'a Stop,
    /// Counts samples as they are made; [`StudyPlan::work`] and [`CoveragePlan::work`] tell how many there will be.
    pub done: &'a AtomicU64,
    /// Time spent so far, by any clock. Times are reported and decide nothing.
    pub clock: &'a dyn Fn() -> Duration,
}

impl Default for Work<'_> {
    /// Nobody watches; time is that on the wall.
    fn default() -> Self {
        static START: std::sync::OnceLock<Instant> = std::sync::OnceLock::new();
        static DONE: AtomicU64 = AtomicU64::new(0);
        static STOP: std::sync::OnceLock<Stop> = std::sync::OnceLock::new();
        Self {
            stop: STOP.get_or_init(Stop::new),
            done: &DONE,
            clock: &|| START.get_or_init(Instant::now).elapsed(),
        }
    }
}

impl std::fmt::Debug for Work<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Work").field("stop", &self.stop).field("done", &self.done).finish_non_exhaustive()
    }
}

/// Why nothing was found.
#[derive(Debug, thiserror::Error)]
pub enum RenderingError {
    /// The scene has none.
    #[error("the scene has no camera")]
    NoCamera,
    /// It cannot be rendered.
    #[error(transparent)]
    Unsound(#[from] UnsoundScene),
    /// The work was stopped.
    #[error(transparent)]
    Stopped(#[from] Stopped),
    /// The reference has another size.
    #[error(
        "the reference has {}×{} pixels and the picture {}×{}: the sizes must be equal",
        .reference[0], .reference[1], .picture[0], .picture[1]
    )]
    Size {
        /// Width and height of the reference.
        reference: [u32; 2],
        /// Width and height of the picture.
        picture: [u32; 2],
    },
    /// The reference is no light.
    #[error("the reference has {0} pixels that are infinite or not a number")]
    NotFinite(usize),
    /// A film of which some pixels have no samples.
    #[error("the film of the reference is not finished: some of its pixels have no samples of both streams")]
    Unfinished,
    /// A plan that cannot be followed.
    #[error("{0}")]
    Plan(&'static str),
}

/// Seeds of repetition `number` of an experiment; those of references and of repetitions never meet but by chance.
fn seed_of(seed: u64, purpose: u64, number: u64) -> u64 {
    hash::combine(hash::combine(seed, purpose), number)
}

/// Purposes of seeds.
const REPLICATE: u64 = 1;
const REFERENCE: u64 = 2;
const PILOT: u64 = 3;

/// The name of an integrator on the command line, with the length of paths.
fn name_of(integrator: Name) -> String {
    match integrator {
        Name::Path { max_depth } => format!("path:{max_depth}"),
        Name::PlainPath { max_depth } => format!("plain-path:{max_depth}"),
        Name::Direct => "direct".to_owned(),
        Name::Occlusion { distance } if distance.is_infinite() => "occlusion".to_owned(),
        Name::Occlusion { distance } => format!("occlusion:{distance}"),
        Name::Inspect(property) => property.name().to_owned(),
    }
}
