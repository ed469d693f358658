//! Intervals from stated errors, and how often they hold.

use crate::integral::normal_quantile;
use luch_sampling::check::{regularized_beta, student_quantile};
use serde::Serialize;
use std::f64::consts::FRAC_2_PI;

/// How an error that is stated as one number is read as an interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Reading {
    /// By Student's t with so many degrees of freedom. Two streams give one: their difference is one number.
    Student(f64),
    /// By the normal distribution, as if the error were known and not estimated.
    Normal,
}

impl Reading {
    /// Half the width of an interval of this level (0 to 1), in stated errors.
    pub fn reach(self, level: f64) -> f64 {
        let below = 0.5 + 0.5 * level;
        match self {
            Self::Student(degrees) => student_quantile(below, degrees),
            Self::Normal => normal_quantile(below),
        }
    }

    /// How often such an interval holds the truth if the mean is normal and its error is estimated from two streams.
    pub fn expected(self, level: f64) -> f64 {
        // Student's t with one degree is Cauchy's distribution.
        FRAC_2_PI * libm::atan(self.reach(level))
    }
}

/// How often intervals of one level held the truth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Measured {
    /// What was stated.
    pub level: f64,
    /// What was found.
    pub coverage: f64,
    /// Ends of its binomial interval at 95 %.
    pub interval: [f64; 2],
}

impl Measured {
    /// Whether the level is beyond the interval, and more than half a point off: what is less matters to nobody.
    pub fn is_missed(&self) -> bool {
        (self.level < self.interval[0] || self.level > self.interval[1])
            && (self.coverage - self.level).abs() > 0.005
    }
}

/// Counts intervals that hold the truth, render by render.
#[derive(Clone, Debug)]
pub struct Tally {
    reaches: Vec<f64>,
    levels: Vec<f64>,
    /// `[render]`: trials, and hits of each level.
    renders: Vec<(f64, Vec<f64>)>,
}

impl Tally {
    /// No render yet.
    pub fn new(reading: Reading, levels: &[f64]) -> Self {
        let reaches = levels.iter().map(|&level| reading.reach(level)).collect();
        Self { reaches, levels: levels.to_vec(), renders: Vec::new() }
    }

    /// A render: distances from the truth and stated errors of what was estimated together.
    pub fn add(&mut self, estimates: impl IntoIterator<Item = [f64; 2]>) {
        let (mut trials, mut hits) = (0.0, vec![0.0; self.reaches.len()]);
        for [distance, error] in estimates {
            trials += 1.0;
            for (hit, reach) in hits.iter_mut().zip(&self.reaches) {
                *hit += f64::from(u8::from(distance.abs() <= reach * error));
            }
        }
        self.renders.push((trials, hits));
    }

    /// Estimates so far.
    pub fn trials(&self) -> f64 {
        self.renders.iter().map(|(trials, _)| trials).sum()
    }

    /// What was found. Only renders are independent of one another, so the binomial intervals are those of as many independent trials as
    /// would scatter like the renders do (Kish, "Survey sampling", 1965: the design effect).
    pub fn measured(&self) -> Vec<Measured> {
        let (trials, count) = (self.trials(), self.renders.len() as f64);
        let measured = |(at, &level): (usize, &f64)| {
            let coverage = self.renders.iter().map(|(_, hits)| hits[at]).sum::<f64>() / trials;
            let scatter: f64 =
                self.renders.iter().map(|(own, hits)| hits[at] - coverage * own).map(|d| d * d).sum();
            let variance = scatter / (trials * trials) * count / (count - 1.0);
            let effective = coverage * (1.0 - coverage) / variance;
            // Where all or none hold the truth nothing scatters, and a render counts as one trial.
            let effective = if effective.is_finite() {
                effective.clamp(count.min(trials), trials.max(1.0))
            } else {
                count.min(trials)
            };
            Measured { level, coverage, interval: binomial_interval(coverage * effective, effective, 0.95) }
        };
        if trials > 0.0 && count > 1.0 {
            self.levels.iter().enumerate().map(measured).collect()
        } else {
            Vec::new()
        }
    }
}

/// The interval of a probability of which `hits` of `trials` came true (Clopper, Pearson 1934): it holds the probability at least as often as
/// `level` says. Numbers need not be whole.
pub fn binomial_interval(hits: f64, trials: f64, level: f64) -> [f64; 2] {
    let tail = 0.5 * (1.0 - level);
    let quantile = |probability: f64, a: f64, b: f64| {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if regularized_beta(middle, a, b) < probability { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    };
    let misses = trials - hits;
    [
        if hits > 0.0 { quantile(tail, hits, misses + 1.0) } else { 0.0 },
        if misses > 0.0 { quantile(1.0 - tail, hits + 1.0, misses) } else { 1.0 },
    ]
}
