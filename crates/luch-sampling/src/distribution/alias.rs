//! Pick one of n by weight, in constant time.

use super::{DistributionError, check_weight};

/// A table that picks an index with probability proportional to its weight.
///
/// Walker's alias method in Vose's form (1991): n buckets of equal width, each shared by at most two indices. It costs 12
/// bytes an entry. For a picker that keeps the order of the indices, so that even numbers stay even, see
/// [`Piecewise1d`](super::piecewise1d::Piecewise1d).
#[derive(Clone, Debug)]
pub struct Alias {
    buckets: Box<[Bucket]>,
}

#[derive(Clone, Copy, Debug)]
struct Bucket {
    /// Share of the bucket that is its own, in [0, 1]; the rest is its alias's.
    own: f32,
    alias: u32,
    /// Probability of the index of this bucket.
    probability: f32,
}

/// What was picked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Picked {
    /// Position of the weight in the table.
    pub index: usize,
    /// Its probability; positive.
    pub probability: f32,
    /// What is left of `u`, in [0, 1) and uniform again. It has lost as many bits as the choice took.
    pub remapped: f32,
}

impl Alias {
    /// Builds the table in time proportional to the number of weights, of which there may be 2³².
    ///
    /// # Errors
    /// When there are no weights, all are zero, or one is negative, infinite or not a number.
    pub fn new(weights: &[f32]) -> Result<Self, DistributionError> {
        if weights.is_empty() {
            return Err(DistributionError::Empty);
        }
        if weights.len() > u32::MAX as usize {
            return Err(DistributionError::TooManyCells { cells: weights.len() });
        }
        let (mut total, mut heaviest) = (0.0, 0);
        for (index, &weight) in weights.iter().enumerate() {
            total += check_weight(index, weight)?;
            if weight > weights[heaviest] {
                heaviest = index;
            }
        }
        if total == 0.0 {
            return Err(DistributionError::AllZero);
        }

        // Shares of an average bucket: those below one are filled up by those above.
        let scale = weights.len() as f64 / total;
        let mut shares: Vec<f64> = weights.iter().map(|&weight| f64::from(weight) * scale).collect();
        let mut buckets: Vec<Bucket> = weights
            .iter()
            .enumerate()
            .map(|(index, &weight)| Bucket {
                own: 1.0,
                alias: index as u32,
                // A positive weight keeps a positive probability even where single precision ends.
                probability: if weight > 0.0 {
                    ((f64::from(weight) / total) as f32).max(f32::MIN_POSITIVE)
                } else {
                    0.0
                },
            })
            .collect();
        let (mut small, mut large): (Vec<usize>, Vec<usize>) =
            (0..weights.len()).partition(|&index| shares[index] < 1.0);
        while let (Some(&receiver), Some(&giver)) = (small.last(), large.last()) {
            small.pop();
            buckets[receiver].own = shares[receiver] as f32;
            buckets[receiver].alias = giver as u32;
            shares[giver] -= 1.0 - shares[receiver];
            if shares[giver] < 1.0 {
                large.pop();
                small.push(giver);
            }
        }
        // Rounding may leave a bucket unfilled: it is whole, unless it is of no weight and must never be picked.
        for index in small {
            if weights[index] == 0.0 {
                buckets[index].own = 0.0;
                buckets[index].alias = heaviest as u32;
            }
        }
        Ok(Self { buckets: buckets.into_boxed_slice() })
    }

    /// Number of weights.
    pub fn len(&self) -> usize {
        self.buckets.len()
    }

    /// Always false: an empty table cannot be built.
    pub fn is_empty(&self) -> bool {
        self.buckets.is_empty()
    }

    /// Picks an index; `u` in [0, 1).
    ///
    /// An `f32` has 24 bits, of which n entries use log₂ n to choose the bucket; the rest decides within. Tables of more
    /// than some thousand entries want [`sample_f64`](Self::sample_f64).
    #[inline]
    pub fn sample(&self, u: f32) -> Picked {
        self.sample_f64(f64::from(u))
    }

    /// Picks an index with all bits of a double; `u` in [0, 1).
    #[inline]
    pub fn sample_f64(&self, u: f64) -> Picked {
        let scaled = u.max(0.0) * self.buckets.len() as f64;
        let place = (scaled as usize).min(self.buckets.len() - 1);
        let bucket = self.buckets[place];
        let fraction = scaled - place as f64;
        let own = f64::from(bucket.own);
        let (index, rest) = if fraction < own {
            (place, fraction / own)
        } else {
            (bucket.alias as usize, if own < 1.0 { (fraction - own) / (1.0 - own) } else { 0.0 })
        };
        let remapped = (rest as f32).clamp(0.0, 1f32.next_down());
        Picked { index, probability: self.buckets[index].probability, remapped }
    }

    /// Probability of an index; zero when there is no such index.
    #[inline]
    pub fn pmf(&self, index: usize) -> f32 {
        self.buckets.get(index).map_or(0.0, |bucket| bucket.probability)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::check;

    #[test]
    fn bad_weights_are_refused() {
        assert_eq!(Alias::new(&[]).unwrap_err(), DistributionError::Empty);
        assert_eq!(Alias::new(&[0.0, 0.0]).unwrap_err(), DistributionError::AllZero);
        for bad in [-1.0, f32::NAN, f32::INFINITY] {
            let error = Alias::new(&[1.0, bad]).unwrap_err();
            assert!(matches!(error, DistributionError::BadWeight { index: 1, .. }), "{error}");
        }
    }

    #[test]
    fn one_weight_is_always_picked() {
        let alias = Alias::new(&[5.0]).unwrap();
        assert_eq!(alias.sample(0.25), Picked { index: 0, probability: 1.0, remapped: 0.25 });
        assert_eq!(alias.pmf(1), 0.0);
    }

    #[test]
    fn picks_follow_the_weights_and_leave_a_uniform_number() {
        let weights = [0.5, 0.0, 3.0, 1.0, 1e-3, 0.0, 7.0, 2.0];
        let alias = Alias::new(&weights).unwrap();
        let count = 1 << 20;
        let mut observed = [0u64; 8];
        let mut remapped = [0u64; 64];
        for i in 0..count {
            let picked = alias.sample((i as f32 + 0.5) / count as f32);
            assert_eq!(picked.probability, alias.pmf(picked.index));
            observed[picked.index] += 1;
            remapped[(picked.remapped * 64.0) as usize] += 1;
        }
        // An even u: every count is right to the few borders of buckets.
        for (index, &weight) in weights.iter().enumerate() {
            let expected = f64::from(weight) / 13.501 * f64::from(count);
            assert!(
                (observed[index] as f64 - expected).abs() <= 8.0,
                "{index}: {} {expected}",
                observed[index]
            );
        }
        let test = check::chi_square(&remapped, &[f64::from(count) / 64.0; 64]);
        assert!(test.p_value > 1e-3, "{test:?}");
    }

    proptest! {
        #[test]
        fn weightless_entries_are_never_picked(
            weights in prop::collection::vec(prop_oneof![Just(0.0f32), 0.0f32..1.0, 1e-38f32..1e-30, 1e30f32..1e38], 1..200),
            us in prop::collection::vec(0.0f32..1.0, 50),
        ) {
            if let Ok(alias) = Alias::new(&weights) {
                for u in us.into_iter().chain([0.0, 1f32.next_down()]) {
                    let picked = alias.sample(u);
                    prop_assert!(weights[picked.index] > 0.0);
                    prop_assert!(picked.probability > 0.0);
                    prop_assert!((0.0..1.0).contains(&picked.remapped));
                }
                let sum: f64 = (0..alias.len()).map(|index| f64::from(alias.pmf(index))).sum();
                prop_assert!((sum - 1.0).abs() < 1e-6);
            }
        }
    }
}
