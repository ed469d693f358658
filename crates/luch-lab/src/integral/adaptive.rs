//! On until an error is reached: replicates of a net, doubled, with a price for every look.

use super::{HashedPoints, Integral, Points, Sums, Tail, TextError, suite, tail_of, text_error};
use luch_sampling::check::student_quantile;
use rayon::prelude::*;
use serde::Serialize;
use std::ops::ControlFlow;

/// The error that is wanted: `rel 1e-4 @ 95%`, `abs 0.001 @ 99%`, or both with `or`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Target {
    /// Half width of the interval, as a share of the estimate.
    pub relative: Option<f64>,
    /// Half width of the interval.
    pub absolute: Option<f64>,
    /// How often the interval has to hold the truth, 0.5 to 0.9999.
    pub confidence: f64,
}

impl Target {
    /// Reads a target.
    ///
    /// # Errors
    ///
    /// The text is no target.
    ///
    /// ```
    /// use luch_lab::integral::Target;
    /// let target = Target::parse("rel 1e-4 @ 95%").unwrap();
    /// assert_eq!((target.relative, target.absolute, target.confidence), (Some(1e-4), None, 0.95));
    /// ```
    pub fn parse(text: &str) -> Result<Self, TextError> {
        let expected = "expected such as `rel 1e-4 @ 95%` or `abs 0.01 @ 99%`";
        let (goals, confidence) = text.split_once('@').unwrap_or((text, "95%"));
        let mut target = Self { relative: None, absolute: None, confidence: 0.0 };
        let mut at = 0;
        for goal in goals.split(" or ") {
            let (start, words) = (at + goal.len() - goal.trim_start().len(), goal.trim());
            at += goal.len() + 4;
            let end = words.find(|letter: char| !letter.is_ascii_alphabetic()).unwrap_or(words.len());
            let (word, number) = words.split_at(end);
            if number.trim().is_empty() {
                return Err(TextError::new(expected, text, start));
            }
            let value = text_error::constant(text, start + word.len(), number)?;
            if !(value > 0.0 && value.is_finite()) {
                return Err(TextError::new(format!("an error must be positive, not {value}"), text, start));
            }
            match word {
                "rel" => target.relative = Some(value),
                "abs" => target.absolute = Some(value),
                _ => return Err(TextError::new(expected, text, start)),
            }
        }
        let place = text.len() - confidence.len();
        let trimmed = confidence.trim();
        target.confidence = match trimmed.strip_suffix('%') {
            Some(number) => text_error::constant(text, place, number)? / 100.0,
            None => text_error::constant(text, place, trimmed)?,
        };
        if !(0.5..=0.9999).contains(&target.confidence) {
            let message =
                format!("the confidence must be 50 % to 99.99 %, not {} %", target.confidence * 100.0);
            return Err(TextError::new(message, text, place));
        }
        Ok(target)
    }

    fn is_met(&self, estimate: f64, half_width: f64) -> bool {
        self.absolute.is_some_and(|goal| half_width <= goal)
            || self.relative.is_some_and(|goal| half_width <= goal * estimate.abs())
    }
}

/// Why it ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Verdict {
    /// The interval is as narrow as was asked.
    Reached,
    /// All points that were allowed are used.
    LimitReached,
    /// The variance may be infinite: no interval is given.
    HeavyTail,
    /// The integrand was infinite or undefined somewhere.
    NotFinite,
    /// The density is zero where the integrand is not.
    BlindSpot,
    /// Whoever watched asked for the end; the interval is that of the last look.
    Interrupted,
}

/// The state at one look.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Look {
    /// Points in all replicates together.
    pub samples: u64,
    /// Mean of the replicates.
    pub estimate: f64,
    /// Half width of the interval at this look's share of the error probability.
    pub half_width: f64,
}

/// What was found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Outcome {
    /// The estimate.
    pub estimate: f64,
    /// Half width of its interval; `None` where no interval would be honest.
    pub half_width: Option<f64>,
    /// Points in all.
    pub samples: u64,
    /// Why it ended.
    pub verdict: Verdict,
    /// All looks, the first first.
    pub looks: Vec<Look>,
    /// What the greatest samples tell.
    pub tail: Tail,
    /// What a reader must know, in sentences.
    pub warnings: Vec<String>,
}

/// Independent randomisations.
const REPLICATES: u64 = 16;
/// Points of each at the first look.
const FIRST: u64 = 64;
/// Points of one replicate between two moments at which the work can be ended.
const STRETCH: u64 = 1 << 17;
/// Points for the tail.
const TAIL_SAMPLES: usize = 1 << 14;

/// Doubles the points of 16 replicates until the interval is narrow enough, or `limit` points are used.
///
/// Look k (from 1) may err with probability (1 − confidence)/(k(k + 1)); these add up to 1 − confidence over all looks, so the
/// interval at the look that stops holds the truth with the confidence asked, as far as the mean of 16 replicates follows
/// Student's t. [`coverage`] measures that.
pub fn until(integral: &Integral, points: &dyn Points, target: Target, limit: u64) -> Outcome {
    until_watched(integral, points, target, limit, &mut |_| ControlFlow::Continue(()))
}

/// The same with somebody who watches: `watch` is called with the looks so far, several times a second in long work, and may ask
/// for the end.
pub fn until_watched(
    integral: &Integral,
    points: &dyn Points,
    target: Target,
    limit: u64,
    watch: &mut dyn FnMut(&[Look]) -> ControlFlow<()>,
) -> Outcome {
    let mut warnings = Vec::new();
    let tail = tail_of(&integral.samples(&HashedPoints { seed: 0x7a11 }, 0, TAIL_SAMPLES));
    let mut sums = vec![Sums::default(); REPLICATES as usize];
    let (mut looks, mut size) = (Vec::new(), 0u64);
    let blind = integral.blind_spot();
    let verdict = 'looks: loop {
        let next = (2 * size).max(FIRST);
        if size > 0 && next.saturating_mul(REPLICATES) > limit {
            break Verdict::LimitReached;
        }
        // Sums merge exactly, so that stretches change nothing.
        while size < next {
            if watch(&looks).is_break() && !looks.is_empty() {
                break 'looks Verdict::Interrupted;
            }
            let length = STRETCH.min(next - size);
            sums.par_iter_mut().enumerate().for_each(|(replicate, sums)| {
                sums.merge(&integral.sums_of(points, replicate as u64, size, length));
            });
            size += length;
        }
        let look = look(&sums, target, looks.len() as u32 + 1);
        looks.push(look);
        if sums.iter().any(|sums| sums.not_finite() > 0) {
            break Verdict::NotFinite;
        }
        if tail.is_heavy && size >= 1024 {
            break Verdict::HeavyTail;
        }
        // No scatter at all is believed only after many points: a rare event may not have happened yet.
        let is_convincing = look.half_width > 0.0 || size >= 4096;
        if is_convincing && !tail.is_heavy && target.is_met(look.estimate, look.half_width) {
            break Verdict::Reached;
        }
    };
    let last = looks.last().copied().unwrap_or(Look { samples: 0, estimate: 0.0, half_width: f64::INFINITY });
    let verdict = match blind {
        Some(point) => {
            let place: Vec<String> = integral
                .domain
                .names()
                .iter()
                .zip(&point)
                .map(|(name, x)| format!("{name} = {x:.6}"))
                .collect();
            warnings.push(format!(
                "the density is zero at {}, where the integrand is {:.4e}: that part is never sampled and is missing from the estimate",
                place.join(", "),
                integral.value(&point)
            ));
            Verdict::BlindSpot
        }
        None => verdict,
    };
    match verdict {
        Verdict::HeavyTail => warnings.push(format!(
            "the variance may be infinite: the tail falls as t^−{:.2} ± {:.2} (finite variance needs more than 2), and the greatest of {} samples holds {:.0} % of the sum of squares; choose a density that is greater where the integrand is great",
            tail.index, tail.index_error, tail.samples, 100.0 * tail.greatest_share
        )),
        Verdict::NotFinite => {
            let count: u64 = sums.iter().map(Sums::not_finite).sum();
            warnings.push(format!("the integrand was infinite or undefined at {count} points; they counted as zero"));
        }
        Verdict::LimitReached => warnings.push(format!("stopped at the limit of {limit} points, before the target")),
        Verdict::Interrupted => warnings.push("ended before the target".to_owned()),
        Verdict::Reached | Verdict::BlindSpot => {}
    }
    let outside: u64 = sums.iter().map(Sums::outside).sum();
    if outside * 10 > last.samples {
        warnings.push(format!(
            "{outside} of {} points fell outside the domain and counted as zero",
            last.samples
        ));
    }
    let is_honest = matches!(verdict, Verdict::Reached | Verdict::LimitReached | Verdict::Interrupted);
    Outcome {
        estimate: last.estimate,
        half_width: is_honest.then_some(last.half_width),
        samples: last.samples,
        verdict,
        looks,
        tail,
        warnings,
    }
}

fn look(sums: &[Sums], target: Target, number: u32) -> Look {
    let means: Vec<f64> = sums.iter().map(|sums| sums.mean().unwrap_or(0.0)).collect();
    let n = means.len() as f64;
    let estimate = means.iter().sum::<f64>() / n;
    let variance = means.iter().map(|mean| (mean - estimate) * (mean - estimate)).sum::<f64>() / (n - 1.0);
    let share = (1.0 - target.confidence) / (f64::from(number) * f64::from(number + 1));
    let reach = student_quantile(1.0 - 0.5 * share, n - 1.0);
    let samples = sums.iter().map(Sums::count).sum();
    Look { samples, estimate, half_width: reach * (variance / n).sqrt() }
}

/// How often the rule's interval held the truth.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Coverage {
    /// The member of the suite.
    pub name: String,
    /// Runs that gave an interval.
    pub runs: u64,
    /// Of these, how many intervals held the truth.
    pub held: u64,
    /// Mean number of points.
    pub samples: f64,
    /// Mean of |error| over half width.
    pub error_over_half_width: f64,
}

/// Runs the rule on every member of the [`suite`], `runs` times with points from `points(run)`.
pub fn coverage(
    points: &(dyn Fn(u64) -> Box<dyn Points> + Sync),
    target: Target,
    limit: u64,
    runs: u64,
) -> Vec<Coverage> {
    let members = suite().unwrap_or_default();
    members
        .iter()
        .map(|member| {
            let truth = member.integral.truth.unwrap_or(f64::NAN);
            let outcomes: Vec<Outcome> = (0..runs)
                .into_par_iter()
                .map(|run| until(&member.integral, &*points(run), target, limit))
                .collect();
            let intervals: Vec<(f64, f64)> = outcomes
                .iter()
                .filter_map(|outcome| Some(((outcome.estimate - truth).abs(), outcome.half_width?)))
                .collect();
            let count = intervals.len().max(1) as f64;
            // Half an ulp of the truth is no error of the rule.
            let slack = 1e-14 * truth.abs();
            Coverage {
                name: member.name.to_owned(),
                runs: intervals.len() as u64,
                held: intervals.iter().filter(|(error, half)| *error <= half + slack).count() as u64,
                samples: outcomes.iter().map(|outcome| outcome.samples as f64).sum::<f64>()
                    / outcomes.len().max(1) as f64,
                error_over_half_width: intervals
                    .iter()
                    .map(|(error, half)| error / half.max(f64::MIN_POSITIVE))
                    .sum::<f64>()
                    / count,
            }
        })
        .collect()
}
