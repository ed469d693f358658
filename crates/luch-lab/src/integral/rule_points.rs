//! Points of the laboratory's rules as a source for integrals.

use super::Points;
use crate::points::{Design, PointSet, Rule};
use std::sync::OnceLock;

/// Numbers of points that every sequence has.
const ALL: u64 = 1 << 32;

/// Points of a rule. Sequences give any stretch; sets that are made for their size are made when [`sized`](Points::sized) is asked for
/// one. Points that the rule does not have, past its accepted numbers or dimensions, are not numbers: take sizes from
/// [`Rule::nearest_count`] and dimensions that [`Rule::accepts`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RulePoints {
    /// Where points come from.
    pub rule: Rule,
    /// Any number.
    pub seed: u64,
}

impl RulePoints {
    /// Whether sets depend on their size.
    fn is_sized(&self) -> bool {
        !(self.rule.is_sequence() && self.rule.is_streamed())
    }
}

impl Points for RulePoints {
    fn fill(&self, replicate: u64, first: u64, dimensions: usize, out: &mut [f64]) {
        let count = if self.is_sized() { first + (out.len() / dimensions.max(1)) as u64 } else { ALL };
        let whole = Whole { source: *self, count, made: OnceLock::new() };
        whole.fill(replicate, first, dimensions, out);
    }

    fn is_random(&self) -> bool {
        self.rule.is_random()
    }

    fn sized(&self, samples: u64) -> Option<Box<dyn Points>> {
        let whole = Whole { source: *self, count: samples, made: OnceLock::new() };
        self.is_sized().then(|| Box::new(whole) as Box<dyn Points>)
    }
}

/// A set of one size; the one that is used first is kept.
struct Whole {
    source: RulePoints,
    count: u64,
    made: OnceLock<Made>,
}

struct Made {
    replicate: u64,
    points: Option<PointSet>,
}

impl Points for Whole {
    fn fill(&self, replicate: u64, first: u64, dimensions: usize, out: &mut [f64]) {
        let RulePoints { rule, seed } = self.source;
        if rule.is_streamed() {
            let design = Design { count: self.count, dimensions, seed, replicate };
            if dimensions == 0 || rule.fill(&design, first, out).is_err() {
                out.fill(f64::NAN);
            }
            return;
        }
        let make = || rule.points(self.count as usize, dimensions, seed, replicate).ok();
        let kept = self.made.get_or_init(|| Made { replicate, points: make() });
        let other;
        let points = if kept.replicate == replicate
            && kept.points.as_ref().is_none_or(|points| points.dimensions() == dimensions)
        {
            &kept.points
        } else {
            other = make();
            &other
        };
        let start = first as usize * dimensions;
        match points.as_ref().and_then(|points| points.flat().get(start..start + out.len())) {
            Some(numbers) => out.copy_from_slice(numbers),
            None => out.fill(f64::NAN),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integral::{Integral, convergence};

    #[test]
    fn every_rule_integrates() {
        let integral =
            Integral::new("exp(x + y)/(exp(1) - 1)^2", "x=0..1, y=0..1").unwrap().with_truth("1").unwrap();
        for rule in Rule::ALL {
            let points = RulePoints { rule, seed: 3 };
            let sizes: Vec<u64> = [64, 256, 1024].map(|size| rule.nearest_count(size, 2)).to_vec();
            let found = convergence(rule.name(), &integral, &points, &sizes, 8);
            let last = found.rows.last().unwrap();
            // One sample has a standard deviation of 0.42.
            assert!(last.mean.is_finite() && last.rmse < 4.0 * 0.42 / 32.0, "{rule:?}: {last:?}");
        }
    }

    #[test]
    fn what_a_rule_has_not_is_no_number() {
        let points = RulePoints { rule: Rule::Jittered, seed: 1 };
        let mut out = [0.0; 14];
        points.sized(7).unwrap().fill(0, 0, 2, &mut out);
        assert!(out.iter().all(|x| x.is_nan()));
        points.sized(9).unwrap().fill(0, 2, 2, &mut out);
        assert!(out.iter().all(|x| (0.0..1.0).contains(x)));
    }
}
