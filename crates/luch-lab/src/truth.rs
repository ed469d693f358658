//! Scenes whose radiance is known, and whether the renderer finds it.
//!
//! A [`Case`] is a scene, a camera, the integrators that apply and the true radiance in closed form. [`judge`] renders it by one
//! integrator with one sequence and says how many standard errors it is off, and how probable that is by chance alone.
//! [`run`] does so for many, [`Judgement`] looks at all of them together.
//!
//! ```
//! use luch_lab::truth::{Effort, Family, judge};
//! use luch_render::Stop;
//! use luch_sampling::Sequence;
//!
//! let case = &Family::F4.cases()[0];
//! assert_eq!(case.truth, 4.0 / 3.0);
//! let verdict = judge(case, case.ways[0], Sequence::Sobol, Effort::default(), &Stop::new())?;
//! assert!(verdict.z.unwrap().abs() < 4.0 && verdict.standard_error < 0.005 * case.truth);
//! # Ok::<(), luch_lab::truth::TruthError>(())
//! ```
//!
//! The numbers F1 to F15 are those of a list of such scenes; F9 and F16 need fog, F13 light from a point over a mirror, which no path
//! from the camera can find: these are not here.

mod bodies;
mod enclosures;
mod family;
pub mod formulas;
mod hidden;
mod judge;
mod lamps;
pub mod measure;
mod page;
mod partly;
mod picture;
pub mod stage;
mod suite;
#[cfg(test)]
mod tests;

pub use family::{Family, MISSING};
pub use judge::{DISTANCE, Effort, Verdict, judge};
pub use measure::TruthError;
pub use page::{histogram, table, z_scores};
pub use suite::{Choice, Judgement, Row, run};

use luch_render::World;
use luch_scene::{Camera, Integrator, Scene};
use serde::Serialize;

/// Paths without an end of their own; roulette ends them.
const ENDLESS: u32 = 1 << 20;

/// A picture whose radiance is known.
#[derive(Clone, Debug)]
pub struct Case {
    /// What it belongs to.
    pub family: Family,
    /// What is seen; no two cases of a family have the same.
    pub name: String,
    /// The scene.
    pub scene: Scene,
    /// The eye.
    pub camera: Camera,
    /// Where in the picture the truth is.
    pub reads: Reads,
    /// The integrators that must find it.
    pub ways: Vec<Way>,
    /// The radiance in the first channel, in closed form.
    pub truth: f64,
}

/// Where in a picture the truth is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reads {
    /// Every pixel shows it.
    EveryPixel,
    /// The mean over the whole picture is it.
    WholePicture,
}

/// An integrator, and what is expected of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Way {
    /// The integrator.
    pub integrator: Integrator,
    /// How it must find the truth.
    pub kind: Kind,
}

/// How the truth is to be found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// By every sample, without any variance.
    Exact,
    /// By the mean.
    Estimated,
}

/// The integrators, without their depths.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Technique {
    /// Light sampling and BSDF sampling together.
    Path,
    /// BSDF sampling alone.
    PlainPath,
    /// One scattering.
    Direct,
    /// The open part of the hemisphere.
    Occlusion,
}

impl Technique {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Path, Self::PlainPath, Self::Direct, Self::Occlusion];

    /// The name used on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Path => "path",
            Self::PlainPath => "plain-path",
            Self::Direct => "direct",
            Self::Occlusion => "occlusion",
        }
    }

    /// The member with this [`name`](Self::name), or `None`.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|technique| technique.name() == name)
    }
}

impl Way {
    /// Light sampling and BSDF sampling together, until roulette ends the path.
    pub const PATH: Integrator = Integrator::Path { max_depth: ENDLESS };
    /// BSDF sampling alone, until roulette ends the path.
    pub const PLAIN: Integrator = Integrator::PlainPath { max_depth: ENDLESS };
    /// One scattering.
    pub const DIRECT: Integrator = Integrator::Direct;
    /// The open part of the hemisphere.
    pub const OCCLUSION: Integrator = Integrator::Occlusion { distance: f32::INFINITY };

    /// Which integrator it is; `None` for one that shows a property.
    pub fn technique(&self) -> Option<Technique> {
        match self.integrator {
            Integrator::Path { .. } => Some(Technique::Path),
            Integrator::PlainPath { .. } => Some(Technique::PlainPath),
            Integrator::Direct => Some(Technique::Direct),
            Integrator::Occlusion { .. } => Some(Technique::Occlusion),
            Integrator::Inspect(_) => None,
        }
    }

    /// As on the command line: `path`, `path:3`, `direct`.
    pub fn name(&self) -> String {
        match self.integrator {
            Integrator::Path { max_depth: ENDLESS } => "path".to_owned(),
            Integrator::Path { max_depth } => format!("path:{max_depth}"),
            Integrator::PlainPath { max_depth: ENDLESS } => "plain-path".to_owned(),
            Integrator::PlainPath { max_depth } => format!("plain-path:{max_depth}"),
            Integrator::Direct => "direct".to_owned(),
            Integrator::Occlusion { distance } if distance.is_infinite() => "occlusion".to_owned(),
            Integrator::Occlusion { distance } => format!("occlusion:{distance}"),
            Integrator::Inspect(property) => property.name().to_owned(),
        }
    }
}

impl Case {
    /// A case that nobody has to find yet, with the truth in every pixel.
    pub fn new(family: Family, name: impl Into<String>, scene: &Scene, camera: Camera, truth: f64) -> Self {
        let mut scene = scene.clone();
        if scene.cameras.is_empty() {
            scene.add_camera(camera);
        }
        let (reads, ways) = (Reads::EveryPixel, Vec::new());
        Self { family, name: name.into(), scene, camera, reads, ways, truth }
    }

    /// The same with integrators whose mean must be the truth.
    #[must_use]
    pub fn by(self, integrators: &[Integrator]) -> Self {
        self.with(integrators, Kind::Estimated)
    }

    /// The same with integrators whose every sample must be the truth.
    #[must_use]
    pub fn exactly_by(self, integrators: &[Integrator]) -> Self {
        self.with(integrators, Kind::Exact)
    }

    fn with(mut self, integrators: &[Integrator], kind: Kind) -> Self {
        self.ways.extend(integrators.iter().map(|&integrator| Way { integrator, kind }));
        self
    }

    /// The scene, made ready.
    ///
    /// # Errors
    ///
    /// The scene is unsound; those of [`cases`] are not.
    pub fn world(&self) -> Result<World, TruthError> {
        Ok(World::build(self.scene.clone())?)
    }
}

/// Every case of every family.
pub fn cases() -> Vec<Case> {
    Family::ALL.into_iter().flat_map(Family::cases).collect()
}
