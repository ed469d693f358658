//! Russian roulette and splitting, judged by variance × time.

use crate::figure::{Axis, Figure, Ink};
use luch_sampling::{Estimate, hash};
use serde::Serialize;

/// A sum of two stages, as a path has them: the first gives something at once and a weight, the second an amount for that weight.
///
/// The estimate is `direct + weight × amount`, all three independent. Going on with rate q (below 1 by roulette, above 1 by
/// splitting into q parts) costs `first_cost + q second_cost`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct TwoStages {
    /// Mean of what the first stage gives at once.
    pub direct_mean: f64,
    /// Variance of that.
    pub direct_variance: f64,
    /// Mean of the weight.
    pub weight_mean: f64,
    /// Variance of the weight.
    pub weight_variance: f64,
    /// Mean of the amount.
    pub amount_mean: f64,
    /// Variance of the amount.
    pub amount_variance: f64,
    /// Time of the first stage.
    pub first_cost: f64,
    /// Time of the second.
    pub second_cost: f64,
}

impl TwoStages {
    /// The variance when the second stage is done at a rate, always the same: roulette below 1; above, as many whole parts as the
    /// rate says and one more by chance.
    ///
    /// Given the weight w, the second stages number n with mean q; the estimate w/q·Σ amounts has the variance
    /// w²(v/q + m² Var(n)/q²) and that of the direct part, v and m being variance and mean of the amount.
    pub fn variance(&self, rate: f64) -> f64 {
        let fraction = rate - rate.floor();
        let number_variance = fraction * (1.0 - fraction);
        let weight_square = self.weight_variance + self.weight_mean * self.weight_mean;
        let m2 = self.amount_mean * self.amount_mean;
        self.direct_variance
            + self.weight_variance * m2
            + weight_square * (self.amount_variance / rate + m2 * number_variance / (rate * rate))
    }

    /// Mean time of an estimate.
    pub fn cost(&self, rate: f64) -> f64 {
        self.first_cost + rate * self.second_cost
    }

    /// Variance × time: what counts. The less, the better.
    pub fn work(&self, rate: f64) -> f64 {
        self.variance(rate) * self.cost(rate)
    }

    /// The rate of least work, from 1/64 to 64: roulette in steps of 1/256, splitting into whole parts.
    pub fn best_rate(&self) -> f64 {
        let rates = (1..=64)
            .map(f64::from)
            .chain((1..256).map(|i| f64::from(i) / 256.0).filter(|rate| *rate >= 1.0 / 64.0));
        rates.min_by(|a, b| self.work(*a).total_cmp(&self.work(*b))).unwrap_or(1.0)
    }

    /// The same by playing: weights and amounts take two values each with the given means and variances.
    pub fn play(&self, rate: f64, rounds: u64, seed: u64) -> Estimate {
        let unit = |word: u64| (word >> 11) as f64 / 9_007_199_254_740_992.0;
        let coin = |mean: f64, variance: f64, word: u64| {
            if word >> 63 == 0 { mean - variance.sqrt() } else { mean + variance.sqrt() }
        };
        (0..rounds)
            .map(|round| {
                let key = hash::combine(seed, round);
                let weight = coin(self.weight_mean, self.weight_variance, hash::word(key, 0));
                let extra = u64::from(unit(hash::word(key, 1)) < rate - rate.floor());
                let number = rate.floor() as u64 + extra;
                let amounts =
                    (0..number).map(|i| coin(self.amount_mean, self.amount_variance, hash::word(key, 2 + i)));
                let direct = coin(self.direct_mean, self.direct_variance, hash::word(key, 2 + number));
                direct + weight / rate * amounts.sum::<f64>()
            })
            .collect()
    }
}

/// Variance × time against the rate, for some kinds of stages, each relative to rate 1.
pub fn stages_figure(stages: &[(String, TwoStages)]) -> Figure {
    let mut figure = Figure::new("Roulette and splitting: variance × time")
        .with_caption("Relative to going on exactly once. Left of 1 by Russian roulette, right by splitting: roulette pays where the second stage is dear and matters little, splitting where it is cheap and uncertain.")
        .with_x(Axis::log10("rate of going on"))
        .with_y(Axis::log10("variance × time"));
    for (at, (name, stage)) in stages.iter().enumerate() {
        let rates = (0..=240).map(|i| libm::pow(10.0, -1.2 + 2.4 * f64::from(i) / 240.0));
        let curve = rates.map(|rate| [rate, stage.work(rate) / stage.work(1.0)]).collect();
        figure = figure.line(format!("{name} (best {:.2})", stage.best_rate()), Ink::of(at), curve);
    }
    figure.place("once", 1.0)
}
