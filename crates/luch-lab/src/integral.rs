//! Integrals of formulas: a box, a density, points, and an honest error.
//!
//! An integral is the mean of `formula / density` over points drawn by the density. [`Integral`] holds what is asked;
//! [`Points`] gives uniform points; [`Integral::estimate`] sums, [`convergence`] measures how the error falls, [`until`] goes on
//! until an error is reached, and says so when the variance may be infinite.
//!
//! ```
//! use luch_lab::integral::{HashedPoints, Integral};
//!
//! let bell = Integral::new("cos(x)^77", "x=-pi/2..pi/2")?
//!     .with_density("normal(0, 0.15)")?
//!     .with_truth("sqrt(pi)*gamma(39)/gamma(39.5)")?;
//! let sums = bell.estimate(&HashedPoints { seed: 1 }, 0, 10_000);
//! assert!(sums.z_score(bell.truth.unwrap()).unwrap().abs() < 4.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod adaptive;
mod convergence;
mod density;
mod domain;
mod points;
mod quantile;
mod rule_points;
mod suite;
mod sums;
mod tail;
mod text_error;

pub use adaptive::{Coverage, Look, Outcome, Target, Verdict, coverage, until, until_watched};
pub use convergence::{Convergence, Row, SlopeFit, convergence, convergence_figure};
pub use density::{AxisDensity, Density, Drawn, Share};
pub use domain::{Domain, MOST_DIMENSIONS, Side};
pub use points::{HashedPoints, Points, SequencePoints};
pub(crate) use quantile::normal_quantile;
pub use rule_points::RulePoints;
pub use suite::{SuiteMember, suite};
pub use sums::Sums;
pub use tail::{Tail, tail_of};
pub use text_error::TextError;

use luch_formula::{Formula, FormulaError, Tape, TapeError};
use rayon::prelude::*;

/// Points that are summed together: the unit of parallel work, the same for every number of threads.
const CHUNK: u64 = 4096;

/// What is to be integrated.
#[derive(Clone, Debug)]
pub struct Integral {
    /// The integrand as it was written.
    pub formula: Formula,
    /// Over which box.
    pub domain: Domain,
    /// How points are drawn.
    pub density: Density,
    /// The known value.
    pub truth: Option<f64>,
    tape: Tape,
}

/// Why there is no integral.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum IntegralError {
    /// The integrand cannot be understood.
    #[error("in the formula: {0}")]
    Formula(#[from] FormulaError),
    /// The integrand cannot be computed.
    #[error("in the formula: {0}")]
    Tape(#[from] TapeError),
    /// The box cannot be understood.
    #[error("in the domain: {0}")]
    Domain(#[source] TextError),
    /// The density cannot be understood, or not sampled on the box.
    #[error("in the density: {0}")]
    Density(#[source] TextError),
    /// The known value cannot be understood.
    #[error("in the truth: {0}")]
    Truth(#[source] TextError),
}

impl Integral {
    /// The integral of a formula over a box, with uniform points; over infinite sides with a density still to be given.
    ///
    /// # Errors
    ///
    /// The formula or the box cannot be understood.
    pub fn new(formula: &str, domain: &str) -> Result<Self, IntegralError> {
        let domain = Domain::parse(domain).map_err(IntegralError::Domain)?;
        Self::of(Formula::new(formula), domain)
    }

    /// The same from parts; the formula may have parameters.
    ///
    /// # Errors
    ///
    /// The formula cannot be understood.
    pub fn of(formula: Formula, domain: Domain) -> Result<Self, IntegralError> {
        let names = domain.names();
        let expression = formula.parse(&names)?;
        let tape = Tape::new(&expression, &names)?;
        let density = Density::uniform(&domain);
        Ok(Self { formula, domain, density, truth: None, tape })
    }

    /// The same with another density.
    ///
    /// # Errors
    ///
    /// The text is no density for this box.
    pub fn with_density(mut self, text: &str) -> Result<Self, IntegralError> {
        self.density = Density::parse(text, &self.domain).map_err(IntegralError::Density)?;
        Ok(self)
    }

    /// The same with a known value, a formula without variables.
    ///
    /// # Errors
    ///
    /// The text has no value.
    pub fn with_truth(mut self, text: &str) -> Result<Self, IntegralError> {
        let value = text_error::constant(text, 0, text).map_err(IntegralError::Truth)?;
        if !value.is_finite() {
            let error = TextError::new(format!("the value {value} is not finite"), text, 0);
            return Err(IntegralError::Truth(error));
        }
        self.truth = Some(value);
        Ok(self)
    }

    /// How many dimensions.
    pub fn dimensions(&self) -> usize {
        self.domain.dimensions()
    }

    /// The integrand at a point.
    pub fn value(&self, point: &[f64]) -> f64 {
        self.tape.value(point)
    }

    /// The mean over the first `count` points of a replicate. The same bits for every number of threads.
    pub fn estimate(&self, points: &dyn Points, replicate: u64, count: u64) -> Sums {
        self.sums_of(points, replicate, 0, count)
    }

    /// The sums over `count` points from number `first` on.
    pub fn sums_of(&self, points: &dyn Points, replicate: u64, first: u64, count: u64) -> Sums {
        let chunks = count.div_ceil(CHUNK);
        let chunk = |room: &mut Room<'_>, number: u64| {
            let begin = number * CHUNK;
            let length = CHUNK.min(count - begin) as usize;
            self.weights(points, replicate, first + begin, length, room);
            Sums::of(&room.weights[..length], room.outside)
        };
        if chunks <= 1 {
            return if count == 0 { Sums::default() } else { chunk(&mut self.room(), 0) };
        }
        let merge = |mut a: Sums, b: Sums| {
            a.merge(&b);
            a
        };
        // Sums merge exactly, so it does not matter which thread takes what.
        (0..chunks)
            .into_par_iter()
            .fold(
                || (self.room(), Sums::default()),
                |(mut room, sums), number| {
                    let more = chunk(&mut room, number);
                    (room, merge(sums, more))
                },
            )
            .map(|(_, sums)| sums)
            .reduce(Sums::default, merge)
    }

    /// The first `count` values of integrand over density: what the mean is taken of.
    pub fn samples(&self, points: &dyn Points, replicate: u64, count: usize) -> Vec<f64> {
        let mut room = self.room();
        let mut samples = Vec::new();
        while samples.len() < count {
            let length = (count - samples.len()).min(CHUNK as usize);
            self.weights(points, replicate, samples.len() as u64, length, &mut room);
            samples.extend_from_slice(&room.weights[..length]);
        }
        samples
    }

    fn room(&self) -> Room<'_> {
        let dimensions = self.dimensions();
        Room {
            evaluator: self.tape.evaluator(),
            uniform: vec![0.0; CHUNK as usize * dimensions],
            places: vec![vec![0.0; CHUNK as usize]; dimensions],
            pdfs: vec![1.0; CHUNK as usize],
            weights: vec![0.0; CHUNK as usize],
            outside: 0,
        }
    }

    /// Fills the weights of some points: integrand over density, zero outside the domain.
    fn weights(&self, points: &dyn Points, replicate: u64, first: u64, length: usize, room: &mut Room<'_>) {
        let dimensions = self.dimensions();
        let uniform = &mut room.uniform[..length * dimensions];
        points.fill(replicate, first, dimensions, uniform);
        let is_uniform = self.density.is_uniform();
        let pdfs = &mut room.pdfs[..length];
        room.outside = 0;
        for (axis, (density, side)) in self.density.axes().iter().zip(self.domain.sides()).enumerate() {
            let places = &mut room.places[axis][..length];
            let us = uniform.iter().skip(axis).step_by(dimensions);
            if is_uniform {
                let (low, scale) = (side.low, side.length());
                places.iter_mut().zip(us).for_each(|(x, &u)| *x = low + u * scale);
                continue;
            }
            for ((x, &u), pdf) in places.iter_mut().zip(us).zip(pdfs.iter_mut()) {
                let drawn = density.draw(u, side);
                // Not a number marks what is outside until the integrand has been computed.
                let is_inside = side.low <= drawn.x && drawn.x <= side.high;
                *x = drawn.x.clamp(side.low, side.high);
                let before = if axis == 0 { 1.0 } else { *pdf };
                *pdf = if is_inside { before * drawn.pdf } else { f64::NAN };
            }
        }
        let places: Vec<&[f64]> = room.places.iter().map(|places| &places[..length]).collect();
        let weights = &mut room.weights[..length];
        room.evaluator.evaluate(&places, weights);
        if is_uniform {
            let volume = self.domain.volume();
            weights.iter_mut().for_each(|weight| *weight *= volume);
            return;
        }
        for (weight, pdf) in weights.iter_mut().zip(pdfs.iter()) {
            if pdf.is_nan() {
                *weight = 0.0;
                room.outside += 1;
            } else {
                *weight = if *weight == 0.0 { 0.0 } else { *weight / pdf };
            }
        }
    }

    /// A place where the density is zero though the integrand is not: what lies there is never sampled. Looked for at 4096
    /// places of each finite side; `None` if none was found.
    pub fn blind_spot(&self) -> Option<Vec<f64>> {
        if self.density.is_uniform() || !self.domain.volume().is_finite() {
            return None;
        }
        let dimensions = self.dimensions();
        let mut uniform = vec![0.0; 4096 * dimensions];
        HashedPoints { seed: 0x5eed }.fill(0, 0, dimensions, &mut uniform);
        uniform.chunks(dimensions).find_map(|u| {
            let sides = self.domain.sides().iter().zip(u);
            let point: Vec<f64> = sides.map(|(side, u)| side.low + u * side.length()).collect();
            let value = self.value(&point);
            (self.density.pdf(&point, &self.domain) == 0.0 && value != 0.0).then_some(point)
        })
    }
}

/// Memory for a chunk.
struct Room<'t> {
    evaluator: luch_formula::Evaluator<'t>,
    uniform: Vec<f64>,
    places: Vec<Vec<f64>>,
    pdfs: Vec<f64>,
    weights: Vec<f64>,
    outside: u64,
}

#[cfg(test)]
mod tests;
