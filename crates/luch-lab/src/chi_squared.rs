//! Every sampling routine of the renderer against its stated density, by χ².
//!
//! A [`Routine`] is something that draws and the density that it says it draws with. [`Routine::run`] counts samples in bins of about
//! equal probability, integrates the density over each, and compares (Pearson's test); the integral of the density is compared with
//! the share of tries that gave a sample. [`suite`] has them all: surfaces, lamps, the sky, the camera, warps and tables.
//!
//! ```
//! use luch_lab::chi_squared::{Family, Routine, run_all};
//! use luch_sampling::{check::FitSettings, warp};
//!
//! let right = Routine::directions("mine", "", glam::Vec3::Z, |u| Some(warp::hemisphere([u[0], u[1]])), warp::hemisphere_pdf);
//! let wrong = Routine::directions("mine", "", glam::Vec3::Z, |u| Some(warp::hemisphere([u[0], u[1]])), warp::cosine_hemisphere_pdf);
//! let found = run_all(&[right, wrong], FitSettings::default(), &|_| {});
//! assert!(found[0].agrees(0.01) && !found[1].agrees(0.01));
//! ```

mod bsdf;
mod camera;
mod emitter;
mod environment;
mod picture;
mod planted;
mod table;
mod warp;

use crate::figure::Sheet;
use glam::Vec3;
use luch_sampling::check::{
    Area, ChiSquare, DensityFit, FitSettings, SphereMap, chi_square, density_fit, kolmogorov_smirnov, sidak,
};
use luch_sampling::{Domain, Sampler, Sequence, hash};
use rayon::prelude::*;
use serde::Serialize;
use std::fmt;
use std::sync::atomic::{AtomicUsize, Ordering};

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Family {
    /// Directions in which surfaces scatter.
    Bsdf,
    /// Directions to lamps.
    Emitter,
    /// Directions to the sky and to suns.
    Environment,
    /// Places of the lens and of the pixel.
    Camera,
    /// Places and directions of the sampling library.
    Warp,
    /// Cells and things picked by weight.
    Table,
    /// Routines whose density is wrong on purpose: the test must reject them.
    Planted,
}

impl Family {
    /// All of them, those that are wrong on purpose last.
    pub const ALL: [Self; 7] =
        [Self::Bsdf, Self::Emitter, Self::Environment, Self::Camera, Self::Warp, Self::Table, Self::Planted];

    /// The name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Bsdf => "bsdf",
            Self::Emitter => "emitter",
            Self::Environment => "environment",
            Self::Camera => "camera",
            Self::Warp => "warp",
            Self::Table => "table",
            Self::Planted => "planted",
        }
    }
}

type Draw = Box<dyn Fn([f32; 4]) -> Option<[f64; 2]> + Send + Sync>;
type Pdf = Box<dyn Fn([f64; 2]) -> f64 + Send + Sync>;
type Pick = Box<dyn Fn(f64) -> Option<usize> + Send + Sync>;

/// Something that draws, and its stated density.
pub struct Routine {
    /// What kind of thing it is.
    pub family: Family,
    /// What people call it.
    pub name: String,
    /// Its number among those of the name, from 1.
    pub number: usize,
    /// With what parameters.
    pub parameters: String,
    kind: Kind,
}

enum Kind {
    /// Places of a rectangle.
    Places { area: Area, axes: [&'static str; 2], draw: Draw, pdf: Pdf },
    /// One of many, with these probabilities.
    Choice { probabilities: Vec<f64>, pick: Pick },
}

impl fmt::Debug for Routine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({})", self.id(), self.parameters)
    }
}

impl Routine {
    /// A routine that draws directions, with their density per solid angle; pictures of it have the axis as their pole.
    pub fn directions(
        name: impl Into<String>,
        parameters: impl Into<String>,
        axis: Vec3,
        draw: impl Fn([f32; 4]) -> Option<Vec3> + Send + Sync + 'static,
        pdf: impl Fn(Vec3) -> f32 + Send + Sync + 'static,
    ) -> Self {
        let map = SphereMap::about(axis);
        let kind = Kind::Places {
            area: SphereMap::AREA,
            axes: ["azimuth", "1 − cos of the angle to the axis"],
            draw: Box::new(move |u| draw(u).map(|direction| map.place(direction))),
            pdf: Box::new(move |place| f64::from(pdf(map.direction(place)))),
        };
        Self::of(name, parameters, kind)
    }

    /// A routine that draws places of a rectangle, with their density per area.
    pub fn places(
        name: impl Into<String>,
        parameters: impl Into<String>,
        area: Area,
        axes: [&'static str; 2],
        draw: impl Fn([f32; 4]) -> Option<[f64; 2]> + Send + Sync + 'static,
        pdf: impl Fn([f64; 2]) -> f64 + Send + Sync + 'static,
    ) -> Self {
        let kind = Kind::Places { area, axes, draw: Box::new(draw), pdf: Box::new(pdf) };
        Self::of(name, parameters, kind)
    }

    /// A routine that picks one of many, or none, by a number in [0, 1).
    pub fn choice(
        name: impl Into<String>,
        parameters: impl Into<String>,
        probabilities: Vec<f64>,
        pick: impl Fn(f64) -> Option<usize> + Send + Sync + 'static,
    ) -> Self {
        Self::of(name, parameters, Kind::Choice { probabilities, pick: Box::new(pick) })
    }

    fn of(name: impl Into<String>, parameters: impl Into<String>, kind: Kind) -> Self {
        Self { family: Family::Warp, name: name.into(), number: 1, parameters: parameters.into(), kind }
    }

    /// Its name and number, such as `conductor:3`.
    pub fn id(&self) -> String {
        format!("{}:{}", self.name, self.number)
    }

    /// Draws and compares.
    pub fn run(&self, settings: FitSettings) -> Verdict {
        let fit = match &self.kind {
            Kind::Places { area, draw, pdf, .. } => density_fit(*area, settings, draw, pdf),
            Kind::Choice { probabilities, pick } => choice_fit(probabilities, pick, settings),
        };
        let DensityFit { chi_square: ChiSquare { statistic, degrees, p_value, .. }, bins, integral, .. } =
            fit;
        Verdict {
            family: self.family,
            id: self.id(),
            parameters: self.parameters.clone(),
            samples: fit.tried,
            bins,
            statistic,
            degrees,
            p_value,
            integral,
            share: fit.drawn as f64 / fit.tried.max(1) as f64,
            fit,
        }
    }

    /// Samples, the integrated density, and how they differ, side by side; of a choice the shares. `None` if nothing is drawn.
    pub fn sheet(&self, settings: FitSettings) -> Option<Sheet> {
        let title = match self.parameters.is_empty() {
            true => self.id(),
            false => format!("{}: {}", self.id(), self.parameters),
        };
        match &self.kind {
            Kind::Places { area, axes, draw, pdf } => {
                picture::places(title, *area, *axes, settings, draw, pdf)
            }
            Kind::Choice { probabilities, pick } => {
                let counts = count_choices(probabilities, pick, settings);
                Some(picture::choice(title, probabilities, &counts, settings.samples))
            }
        }
    }
}

/// How a routine fared.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Verdict {
    /// What kind of thing it is.
    pub family: Family,
    /// Name and number.
    pub id: String,
    /// With what parameters.
    pub parameters: String,
    /// Samples tried.
    pub samples: u64,
    /// Bins they were counted in.
    pub bins: usize,
    /// χ².
    pub statistic: f64,
    /// Degrees of freedom.
    pub degrees: usize,
    /// Probability of a χ² at least as large if the density is right.
    pub p_value: f64,
    /// The integral of the stated density, by quadrature: 1, but for what is not drawn.
    pub integral: f64,
    /// The share of tries that gave a sample.
    pub share: f64,
    #[serde(skip)]
    fit: DensityFit,
}

impl Verdict {
    /// Whether counts and integral agree with the density at a level: that of one test, as [`level`] gives it.
    pub fn agrees(&self, level: f64) -> bool {
        self.fit.agrees(level)
    }
}

/// The level of one of so many tests, for a level of all (Šidák).
pub fn level(all: f64, tests: usize) -> f64 {
    sidak(all, tests.min(u32::MAX as usize) as u32)
}

/// The probability of p-values as uneven as these if all densities are right (Kolmogorov and Smirnov): verdicts that are always
/// too good, or often a little too bad, show here. `None` for fewer than ten.
pub fn evenness(verdicts: &[Verdict]) -> Option<f64> {
    let tested = verdicts.iter().filter(|verdict| verdict.degrees > 0);
    let values: Vec<f64> = tested.map(|verdict| verdict.p_value).collect();
    (values.len() >= 10).then(|| kolmogorov_smirnov(&values, |p| p).p_value)
}

/// Runs routines on the threads of the current pool; `done` is told of each that is ready how many are. The verdicts are in their order.
pub fn run_all(routines: &[Routine], settings: FitSettings, done: &(dyn Fn(usize) + Sync)) -> Vec<Verdict> {
    let ready = AtomicUsize::new(0);
    let run = |(place, routine): (usize, &Routine)| {
        // Numbers of their own for each, so that verdicts are independent.
        let seed = hash::combine(settings.seed, place as u64);
        let verdict = routine.run(FitSettings { seed, ..settings });
        done(ready.fetch_add(1, Ordering::Relaxed) + 1);
        verdict
    };
    routines.par_iter().enumerate().with_max_len(1).map(run).collect()
}

/// All routines of the renderer, and those that are wrong on purpose at the end.
pub fn suite() -> Vec<Routine> {
    let families = [
        (Family::Bsdf, bsdf::routines()),
        (Family::Emitter, emitter::routines()),
        (Family::Environment, environment::routines()),
        (Family::Camera, camera::routines()),
        (Family::Warp, warp::routines()),
        (Family::Table, table::routines()),
        (Family::Planted, planted::routines()),
    ];
    let mut all: Vec<Routine> = Vec::new();
    for (family, routines) in families {
        for mut routine in routines {
            routine.family = family;
            let same = |other: &&Routine| other.name == routine.name;
            routine.number = all.iter().rev().find(same).map_or(0, |other| other.number) + 1;
            all.push(routine);
        }
    }
    all
}

/// Whether a routine goes by this word: `all` (but what is wrong on purpose), a family, a name, or a name and number.
pub fn is_named(routine: &Routine, word: &str) -> bool {
    match word {
        "all" => routine.family != Family::Planted,
        _ => word == routine.family.name() || word == routine.name || word == routine.id(),
    }
}

fn count_choices(probabilities: &[f64], pick: &Pick, settings: FitSettings) -> Vec<u64> {
    let mut counts = vec![0u64; probabilities.len() + 1];
    for index in 0..settings.samples {
        let sampler = Sampler::at(Sequence::Independent, settings.seed, [0, 0], index);
        let u = hash::unit_f64(sampler.group_words(Domain::new(0, 0))[0]);
        let picked = pick(u).filter(|place| *place < probabilities.len());
        counts[picked.unwrap_or(probabilities.len())] += 1;
    }
    counts
}

fn choice_fit(probabilities: &[f64], pick: &Pick, settings: FitSettings) -> DensityFit {
    let mut counts = count_choices(probabilities, pick, settings);
    let n = settings.samples as f64;
    let integral: f64 = probabilities.iter().sum();
    let mut expected: Vec<f64> = probabilities.iter().map(|p| p * n).collect();
    let none = counts[probabilities.len()];
    let lost = (1.0 - integral) * n;
    // Sums of single precision miss one by less than a millionth.
    if none == 0 && lost.abs() < 1e-5 * n {
        counts.pop();
    } else {
        expected.push(lost.max(0.0));
    }
    let bins = expected.len();
    let chi_square = chi_square(&counts, &expected);
    DensityFit { chi_square, bins, integral, tried: settings.samples, drawn: settings.samples - none }
}

#[cfg(test)]
mod tests;
