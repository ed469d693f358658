//! One case, one integrator, one sequence: is it the truth?

use super::measure::{Look, TruthError, render, settings};
use super::{Case, Kind, Way};
use luch_render::{Stop, World};
use luch_sampling::check::regularized_beta;
use luch_sampling::{Sequence, hash};
use serde::Serialize;

/// Largest distance from the truth, in standard errors, that a row by itself may have.
pub const DISTANCE: f64 = 4.0;
/// How improbable that distance is, either way, where standard errors are known exactly. From 32 replicates they are not: by Student's t,
/// 4.56 of these are as improbable.
const IMPROBABLE: f64 = 6.334e-5;
/// Relative rounding of some dozen operations in single precision; matters only where the variance vanishes.
const ROUNDING: f64 = 1e-5;
/// Side of the film where every sample must be the truth, and samples of its pixels.
const SIDE: u32 = 12;
const SAMPLES: u64 = 8;

/// How much is done for a verdict.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Effort {
    /// Another seed gives other samples.
    pub seed: u64,
    /// The standard error that is demanded, relative to the truth; from 10⁻⁵ to 1.
    pub relative_error: f64,
}

impl Default for Effort {
    fn default() -> Self {
        Self { seed: 1, relative_error: 0.005 }
    }
}

/// What was found beside what is true.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Verdict {
    /// How the truth was to be found.
    pub kind: Kind,
    /// What was found.
    pub mean: f64,
    /// Its standard error; of an exact case the largest standard deviation of any pixel.
    pub standard_error: f64,
    /// What is true.
    pub truth: f64,
    /// How far off the mean is; of an exact case the channel of the pixel that is farthest off.
    pub off: f64,
    /// How far off in standard errors, up to what rounding may do; `None` for exact cases.
    pub z: Option<f64>,
    /// How probable it is by chance to be as far off or farther, by Student's t; of exact cases 1 if all is within rounding, and 0 if not.
    pub p_value: f64,
    /// Independent replicates that the standard error is from.
    pub replicates: u64,
    /// Camera samples.
    pub samples: u64,
}

impl Verdict {
    /// Whether the variance is so small that nothing but rounding is seen, and the probability is none.
    pub fn is_rounding(&self) -> bool {
        self.kind == Kind::Exact || self.standard_error <= 10.0 * ROUNDING * self.truth.abs()
    }

    /// Whether the standard error is small enough to tell.
    pub fn tells(&self, effort: Effort) -> bool {
        self.kind == Kind::Exact || self.standard_error <= effort.relative_error * self.truth.abs()
    }

    /// What is wrong with it as the only verdict there is: off as improbably far as [`DISTANCE`] standard errors of a normal number, or too
    /// noisy to tell.
    pub fn complaint(&self, effort: Effort) -> Option<String> {
        let Self { mean, truth, off, standard_error, .. } = self;
        match self.z {
            None if self.p_value > 0.0 => None,
            None => {
                Some(format!("a pixel is {off:+e} off the exact {truth:.6}, or varies by {standard_error:e}"))
            }
            Some(_) if self.p_value >= IMPROBABLE && self.tells(effort) => None,
            Some(z) => Some(format!(
                "{mean:.6}, expected {truth:.6}: {z:+.2} standard errors off, one is {:.3} % of the truth",
                100.0 * standard_error / truth
            )),
        }
    }
}

/// Renders a case by one of its ways with one sequence and holds it against the truth. A pure function: the same on every machine.
///
/// # Errors
///
/// The scene is unsound, samples were lost, or `stop` came due.
pub fn judge(
    case: &Case,
    way: Way,
    sequence: Sequence,
    effort: Effort,
    stop: &Stop,
) -> Result<Verdict, TruthError> {
    judge_in(&case.world()?, case, way, sequence, effort, stop)
}

/// [`judge`] in the world of the case.
pub(super) fn judge_in(
    world: &World,
    case: &Case,
    way: Way,
    sequence: Sequence,
    effort: Effort,
    stop: &Stop,
) -> Result<Verdict, TruthError> {
    // Rows do not share their samples: what one has by chance says nothing of another.
    let words = [case.family.name(), &case.name, &way.name(), sequence.name()];
    let letters = words.iter().flat_map(|word| word.bytes().chain([0]));
    let seed = letters.fold(effort.seed, |seed, letter| hash::combine(seed, u64::from(letter)));
    match way.kind {
        Kind::Exact => {
            let settings = settings(SIDE, SIDE, sequence, seed);
            let film = render(world, &case.camera, &settings, way.integrator, SAMPLES, stop)?;
            Ok(exact(case.truth, &film))
        }
        Kind::Estimated => {
            let look =
                Look { world, camera: &case.camera, reads: case.reads, way: way.integrator, sequence, seed };
            let seen = look.measure(effort.relative_error, stop)?;
            let mean = seen.replicates.mean().unwrap_or(f64::NAN);
            let standard_error = seen.replicates.standard_error().unwrap_or(f64::NAN);
            let z = distance(mean - case.truth, standard_error, case.truth);
            Ok(Verdict {
                kind: way.kind,
                mean,
                standard_error,
                truth: case.truth,
                off: mean - case.truth,
                z: Some(z),
                p_value: two_sided(z, (seen.replicates.count() - 1) as f64),
                replicates: seen.replicates.count(),
                samples: seen.samples,
            })
        }
    }
}

/// In standard errors, after what rounding may do is taken off.
fn distance(off: f64, standard_error: f64, truth: f64) -> f64 {
    let beyond = off.abs() - ROUNDING * truth.abs();
    if beyond <= 0.0 { 0.0 } else { (beyond / standard_error).copysign(off) }
}

/// The probability that a number of Student's t is as far from zero or farther; nought for what is no number.
fn two_sided(t: f64, degrees: f64) -> f64 {
    let square = t * t;
    if square.is_nan() || square.is_infinite() {
        return 0.0;
    }
    regularized_beta(degrees / (degrees + square), 0.5 * degrees, 0.5)
}

fn exact(truth: f64, film: &[luch_render::PixelEstimate]) -> Verdict {
    let channels = || film.iter().flat_map(|pixel| pixel.mean);
    let off = channels().map(|mean| mean - truth).fold(0.0, |most: f64, off| {
        // Not a number is the farthest of all.
        if off.abs() <= most.abs() { most } else { off }
    });
    // Both streams have samples.
    let variances = film.iter().flat_map(|pixel| pixel.variance.unwrap_or([f64::NAN; 3]));
    let spread = variances.map(f64::sqrt).fold(0.0, |most: f64, one| if one <= most { most } else { one });
    let is_good = off.abs() <= ROUNDING * truth && spread <= ROUNDING * truth;
    Verdict {
        kind: Kind::Exact,
        mean: channels().sum::<f64>() / (3 * film.len()) as f64,
        standard_error: spread,
        truth,
        off,
        z: None,
        p_value: if is_good { 1.0 } else { 0.0 },
        replicates: film.len() as u64,
        samples: SAMPLES * film.len() as u64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn probabilities_are_those_of_tables() {
        // Two-sided quantiles of Student's t with 31 degrees of freedom.
        for (t, p) in [(0.0, 1.0), (2.039_513_446, 0.05), (2.744_041_919, 0.01)] {
            assert!(
                (two_sided(t, 31.0) - p).abs() < 1e-9 && two_sided(t, 31.0) == two_sided(-t, 31.0),
                "{t}"
            );
        }
        assert_eq!([f64::INFINITY, f64::NAN].map(|t| two_sided(t, 31.0)), [0.0; 2]);
    }

    #[test]
    fn rounding_is_forgiven_and_nothing_else() {
        assert_eq!(distance(0.9e-5, 0.0, 1.0), 0.0);
        assert_eq!(distance(-1.1e-5, 0.0, 1.0), f64::NEG_INFINITY);
        assert!((distance(0.02, 0.01, 1.0) - 1.999).abs() < 1e-12);
        assert!(distance(f64::NAN, 0.1, 1.0).is_nan() && distance(0.1, f64::NAN, 1.0).is_nan());
    }
}
