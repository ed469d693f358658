//! Problems with known answers: what Monte Carlo is first tried on.
//!
//! ```
//! use luch_lab::integral::HashedPoints;
//! use luch_lab::problem::Problem;
//!
//! let run = Problem::named("acute").unwrap().run(100_000, &HashedPoints { seed: 1 });
//! assert!((run.truth - (53.0 / 150.0 - std::f64::consts::PI / 40.0)).abs() < 1e-15);
//! assert!(run.z_score.abs() < 4.0);
//! ```

mod lamp;
mod picture;
pub mod polygon;
mod triangle;

pub use lamp::{Blocker, Lamp, LampShape, Quantity};
pub use triangle::{TriangleDomain, Wanted};

use crate::figure::{Axis, Between, Figure, Ink};
use crate::integral::{Integral, IntegralError, Points};
use luch_sampling::check::student_quantile;
use serde::Serialize;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A problem with a known answer: the mean of a function of some numbers between 0 and 1.
#[derive(Clone, Debug)]
pub struct Problem {
    /// A short name.
    pub name: String,
    /// What is asked, in a sentence.
    pub description: String,
    /// The exact answer.
    pub truth: f64,
    kind: Kind,
}

#[derive(Clone, Debug)]
enum Kind {
    Pi,
    Triangle { domain: TriangleDomain, wanted: Wanted },
    Cos77(Box<Integral>),
    Lamp { lamp: Lamp, quantity: Quantity },
    Edge { angle: f64, offset: f64 },
    Glossy { glossiness: f64 },
    Furnace { albedo: f64 },
}

/// What a run found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Run {
    /// The problem's name.
    pub name: String,
    /// The estimate.
    pub estimate: f64,
    /// Its standard error, from 16 independent randomisations; zero if it is not known.
    pub standard_error: f64,
    /// Whether the error is known: points without chance say nothing of it.
    pub has_error: bool,
    /// The exact answer.
    pub truth: f64,
    /// (estimate − truth) / standard error; zero where both vanish, and where the error is not known.
    pub z_score: f64,
    /// Points used.
    pub samples: u64,
    /// Estimates along the way.
    pub rows: Vec<Progress>,
    /// What was done and what it shows, in a few sentences.
    pub explanation: String,
    /// The problem, with some of its points.
    pub figure: Figure,
    /// The estimate along the way, with its error.
    pub progress: Figure,
}

/// An estimate along the way.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Progress {
    /// Points so far.
    pub samples: u64,
    /// The estimate.
    pub estimate: f64,
    /// Its standard error.
    pub standard_error: f64,
}

/// Independent randomisations of a run.
const REPLICATES: u64 = 16;

/// Most scatterings of a path in the furnace.
const SCATTERINGS: usize = 32;

/// ∫cos⁷⁷ over the half turn: √π Γ(39)/Γ(39.5).
pub const COS77: f64 = 0.284_730_875_959_477_4;

impl Problem {
    /// Names of all problems that need no parameters.
    pub const NAMES: [&'static str; 16] = [
        "pi",
        "acute",
        "obtuse",
        "obtuse-rectangle",
        "obtuse-disc",
        "obtuse-ball",
        "cos77",
        "cos77-normal",
        "furnace",
        "lamp",
        "lamp-irradiance",
        "lamp-rectangle",
        "lamp-disc-edge",
        "lamp-disc",
        "edge",
        "glossy",
    ];

    /// The problem of this name; `None` if there is none.
    pub fn named(name: &str) -> Option<Self> {
        let half = || Lamp::half_covered(-0.25);
        Some(match name {
            "pi" => Self {
                name: "pi".into(),
                description:
                    "π as four times the share of the unit square inside the disc (x−½)² + (y−½)² ≤ ¼".into(),
                truth: PI,
                kind: Kind::Pi,
            },
            "acute" => Self::triangle(TriangleDomain::Square, Wanted::Acute),
            "obtuse" => Self::triangle(TriangleDomain::Square, Wanted::Obtuse),
            "obtuse-rectangle" => Self::triangle(TriangleDomain::Rectangle, Wanted::Obtuse),
            "obtuse-disc" => Self::triangle(TriangleDomain::Disc, Wanted::Obtuse),
            "obtuse-ball" => Self::triangle(TriangleDomain::Ball, Wanted::Obtuse),
            "cos77" => Self::cos77("uniform").ok()?,
            "cos77-normal" => Self::cos77("normal(0, 0.15)").ok()?,
            "furnace" => Self::furnace(0.5),
            "lamp" => Self::lamp(half(), Quantity::VisibleFraction),
            "lamp-irradiance" => Self::lamp(half(), Quantity::FormFactor),
            "lamp-rectangle" => Self::lamp(Lamp::over_rectangle([0.6, 0.6]), Quantity::VisibleFraction),
            "lamp-disc-edge" => Self::lamp(Lamp::disc_with_edge(0.3), Quantity::VisibleFraction),
            "lamp-disc" => Self::lamp(Lamp::over_disc(0.7), Quantity::VisibleFraction),
            "edge" => Self::edge(0.35, 0.1),
            "glossy" => Self::glossy(0.8),
            _ => return None,
        })
    }

    /// The probability of an acute or obtuse triangle of three uniform points.
    pub fn triangle(domain: TriangleDomain, wanted: Wanted) -> Self {
        Self {
            name: format!("{}-{}", wanted.name(), domain.name()),
            description: format!(
                "the probability that three uniform points of {} make an {} triangle",
                domain.description(),
                wanted.name()
            ),
            truth: triangle::probability(domain, wanted),
            kind: Kind::Triangle { domain, wanted },
        }
    }

    /// ∫cos⁷⁷x dx over [−π/2, π/2] with points drawn by a density, as [`Density::parse`](crate::integral::Density::parse) reads it.
    ///
    /// # Errors
    ///
    /// The text is no density.
    pub fn cos77(density: &str) -> Result<Self, IntegralError> {
        let integral = Integral::new("cos(x)^77", "x=-pi/2..pi/2")?.with_density(density)?;
        Ok(Self {
            name: format!("cos77 by {density}"),
            description: format!("the integral of cos⁷⁷x from −π/2 to π/2, x drawn by {density}"),
            truth: COS77,
            kind: Kind::Cos77(Box::new(integral)),
        })
    }

    /// How much of a lamp is seen from a point, or how much light comes from it.
    pub fn lamp(lamp: Lamp, quantity: Quantity) -> Self {
        let asked = match quantity {
            Quantity::VisibleFraction => "the share of the lamp's area that the point sees",
            Quantity::FormFactor => "the form factor of the visible part: irradiance over π times radiance",
        };
        Self {
            name: format!("lamp: {}", quantity.name()),
            description: asked.to_owned(),
            truth: lamp.exact(quantity),
            kind: Kind::Lamp { lamp, quantity },
        }
    }

    /// The share of a pixel on one side of an edge, whose normal has this angle and which passes the pixel's middle at this
    /// distance, in pixels.
    pub fn edge(angle: f64, offset: f64) -> Self {
        Self {
            name: "edge".into(),
            description: "anti-aliasing: the share of a pixel that an edge covers".into(),
            truth: polygon::area(&covered(angle, offset)),
            kind: Kind::Edge { angle, offset },
        }
    }

    /// The mean of (dx² + dy²)/R² over the disc of the lecture's glossy reflection, R = tan((1 − glossiness)π/2): ½ if points are
    /// uniform in the disc. The glossiness is cut to 0.001 … 0.999.
    pub fn glossy(glossiness: f64) -> Self {
        let glossiness = if glossiness.is_nan() { 0.5 } else { glossiness.clamp(0.001, 0.999) };
        Self {
            name: "glossy".into(),
            description: format!(
                "the disc of a glossy reflection, glossiness {glossiness}: radius tan((1−g)π/2) = {:.6}; the mean of r²/R² is ½ where points are uniform",
                glossy_radius(glossiness)
            ),
            truth: 0.5,
            kind: Kind::Glossy { glossiness },
        }
    }

    /// The radiance in a closed furnace whose walls emit 1 and reflect this part of what arrives, by paths that roulette ends: a path
    /// of k scatterings has seen k + 1. The albedo is cut to 0 … 0.7, paths to 32 scatterings, and the truth to as many terms of the
    /// geometric series.
    pub fn furnace(albedo: f64) -> Self {
        let albedo = if albedo.is_nan() { 0.5 } else { albedo.clamp(0.0, 0.7) };
        Self {
            name: "furnace".into(),
            description: format!(
                "the radiance in a closed furnace of emission 1 and albedo {albedo}: 1/(1−a), by paths that end at random"
            ),
            truth: (1.0 - libm::pow(albedo, SCATTERINGS as f64 + 1.0)) / (1.0 - albedo),
            kind: Kind::Furnace { albedo },
        }
    }

    /// How many numbers a sample takes.
    pub fn dimensions(&self) -> usize {
        match &self.kind {
            Kind::Pi | Kind::Lamp { .. } | Kind::Edge { .. } | Kind::Glossy { .. } => 2,
            Kind::Triangle { domain, .. } => 3 * domain.dimensions(),
            Kind::Cos77(_) => 1,
            Kind::Furnace { .. } => SCATTERINGS,
        }
    }

    /// One sample; its mean over the unit cube is the answer.
    pub fn sample(&self, u: &[f64]) -> f64 {
        match &self.kind {
            Kind::Pi => {
                let (x, y) = (u[0] - 0.5, u[1] - 0.5);
                if x * x + y * y <= 0.25 { 4.0 } else { 0.0 }
            }
            Kind::Triangle { domain, wanted } => {
                f64::from(u8::from(triangle::is_wanted(*domain, *wanted, u)))
            }
            Kind::Cos77(integral) => {
                let mut x = [0.0];
                let pdf = integral.density.draw(u, &integral.domain, &mut x);
                // Outside the domain a draw counts as zero.
                if integral.domain.contains(&x) { integral.value(&x) / pdf } else { 0.0 }
            }
            Kind::Lamp { lamp, quantity } => lamp.sample(*quantity, [u[0], u[1]]),
            Kind::Edge { angle, offset } => {
                let side = (u[0] - 0.5) * libm::cos(*angle) + (u[1] - 0.5) * libm::sin(*angle);
                f64::from(u8::from(side <= *offset))
            }
            Kind::Glossy { glossiness } => {
                let radius = glossy_radius(*glossiness);
                let [x, y] = glossy_place(*glossiness, [u[0], u[1]]);
                (x * x + y * y) / (radius * radius)
            }
            Kind::Furnace { albedo } => 1.0 + u.iter().take_while(|u| **u < *albedo).count() as f64,
        }
    }

    /// The answer by about `budget` points (at least 32), in 16 independent randomisations.
    pub fn run(&self, budget: u64, points: &dyn Points) -> Run {
        let dimensions = self.dimensions();
        let each = (budget / REPLICATES).clamp(2, 1 << 40);
        let mut sums = [0.0f64; REPLICATES as usize];
        let mut rows = Vec::new();
        let mut room = vec![0.0; 1024 * dimensions];
        let (mut done, mut next) = (0u64, 2u64);
        while done < each {
            let length = (next.min(each) - done).min(1024);
            for (replicate, sum) in sums.iter_mut().enumerate() {
                let uniform = &mut room[..length as usize * dimensions];
                points.fill(replicate as u64, done, dimensions, uniform);
                *sum += uniform.chunks(dimensions).map(|u| self.sample(u)).sum::<f64>();
            }
            done += length;
            if done == next.min(each) {
                rows.push(progress(&sums, done));
                next = next.saturating_mul(2);
            }
        }
        let last = progress(&sums, each);
        let distance = last.estimate - self.truth;
        // Where every sample is the same, sums of them differ from the truth by rounding only.
        let is_rounding = distance.abs() <= 1e-14 * self.truth.abs();
        let has_error = points.is_random();
        let z_score = if is_rounding || !has_error { 0.0 } else { distance / last.standard_error };
        Run {
            name: self.name.clone(),
            estimate: last.estimate,
            standard_error: last.standard_error,
            has_error,
            truth: self.truth,
            z_score,
            samples: last.samples,
            explanation: self.explanation(&last, has_error.then_some(z_score)),
            figure: picture::of(self, points),
            progress: self.progress_figure(&rows),
            rows,
        }
    }

    fn explanation(&self, last: &Progress, z_score: Option<f64>) -> String {
        let verdict = match z_score {
            Some(z) if z.abs() < 3.0 => format!("{z:+.2} standard errors away, as it should be"),
            Some(z) => format!("{z:+.2} standard errors away, which chance hardly does"),
            None => format!(
                "off by {:+.2e}; points without chance say nothing of their error",
                last.estimate - self.truth
            ),
        };
        let error =
            if z_score.is_some() { format!(" ± {:.2e}", last.standard_error) } else { String::new() };
        let more = match &self.kind {
            Kind::Pi => "Each point is a coin that falls into the disc with probability π/4, so independent points have the error 1.642/√N.".to_owned(),
            Kind::Triangle { .. } => "At most one angle of a triangle is obtuse, so three signs of dot products decide.".to_owned(),
            Kind::Cos77(integral) => {
                let shape = if integral.density.is_uniform() {
                    "Uniform points mostly fall where the integrand is nearly zero."
                } else {
                    "Points fall where the integrand is large; each counts for the integrand over the density, and what falls outside the domain counts for nothing."
                };
                shape.to_owned()
            }
            Kind::Lamp { quantity: Quantity::VisibleFraction, .. } => "A point of the lamp is seen if nothing stands between; the exact share is a polygon cut by the shadow.".to_owned(),
            Kind::Lamp { quantity: Quantity::FormFactor, .. } => "Parts of the lamp count by the cosines and the distance, so the share of the light is not the share of the area.".to_owned(),
            Kind::Edge { .. } => "Each point of the pixel is on one side of the edge or the other; the mean is the shade that a smooth edge needs.".to_owned(),
            Kind::Furnace { .. } => "Each scattering survives with the probability of the albedo, so what is left carries as much as before: roulette costs no weight, only variance. Nobody needs to know beforehand how long paths will be.".to_owned(),
            Kind::Glossy { .. } => "The radius is the root of a uniform number times R: without the root the points would crowd in the middle.".to_owned(),
        };
        format!(
            "{}: {:.8}{error} after {} points; exact {:.8}; {verdict}. {more}",
            capital(&self.description),
            last.estimate,
            last.samples,
            self.truth,
        )
    }

    fn progress_figure(&self, rows: &[Progress]) -> Figure {
        // Two-sided 95 % with 15 degrees of freedom.
        let reach = student_quantile(0.975, (REPLICATES - 1) as f64);
        let band = rows.iter().map(|row| Between {
            x: row.samples as f64,
            low: row.estimate - reach * row.standard_error,
            high: row.estimate + reach * row.standard_error,
        });
        Figure::new(format!("{}: the estimate closes in", self.name))
            .with_x(Axis::log2("points N"))
            .with_y(Axis::linear("estimate"))
            .band("95 % interval", Ink::Sky, band.collect())
            .marked(
                "estimate",
                Ink::Blue,
                crate::figure::Marker::Disc,
                rows.iter().map(|row| [row.samples as f64, row.estimate]).collect(),
            )
            .level("exact", self.truth)
    }
}

fn progress(sums: &[f64], each: u64) -> Progress {
    let means: Vec<f64> = sums.iter().map(|sum| sum / each as f64).collect();
    let n = means.len() as f64;
    let estimate = means.iter().sum::<f64>() / n;
    let variance = means.iter().map(|mean| (mean - estimate) * (mean - estimate)).sum::<f64>() / (n - 1.0);
    Progress { samples: each * REPLICATES, estimate, standard_error: (variance / n).sqrt() }
}

fn capital(text: &str) -> String {
    let mut characters = text.chars();
    characters.next().map(|first| first.to_uppercase().chain(characters).collect()).unwrap_or_default()
}

/// The radius of the lecture's disc: tan((1 − g)π/2).
pub fn glossy_radius(glossiness: f64) -> f64 {
    libm::tan((1.0 - glossiness) * FRAC_PI_2)
}

/// A uniform point of the disc of a glossy reflection.
pub fn glossy_place(glossiness: f64, u: [f64; 2]) -> [f64; 2] {
    let (radius, angle) = (glossy_radius(glossiness) * u[0].sqrt(), TAU * u[1]);
    [radius * libm::cos(angle), radius * libm::sin(angle)]
}

/// The part of the unit pixel on the covered side of an edge.
fn covered(angle: f64, offset: f64) -> Vec<[f64; 2]> {
    let pixel = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let (c, s) = (libm::cos(angle), libm::sin(angle));
    polygon::clip(&pixel, [c, s], offset + 0.5 * (c + s))
}

#[cfg(test)]
mod tests;
