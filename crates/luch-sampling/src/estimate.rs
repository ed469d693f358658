//! Estimate: a running mean with an error bar that merges exactly.

mod exact_sum;

pub use exact_sum::ExactSum;

use crate::check::student_quantile;

/// What is known about an expected value after some samples.
///
/// The sums of the samples and of their squares are kept exactly, as whole numbers of over four thousand bits, and
/// rounded only when asked for. So the order of the samples and the way they were split over threads cannot change a single
/// bit of any answer: [`merge`](Self::merge) is associative and commutative. An estimate takes about two kilobytes; it is
/// made for experiments and tests, not for pixels.
///
/// The error bar holds for independent samples. Points of a low-discrepancy sequence are not independent: there, add one
/// mean per independent randomisation.
///
/// ```
/// use luch_sampling::Estimate;
/// let mut estimate = Estimate::new();
/// for value in [2.0, 4.0, 4.0, 6.0] {
///     estimate.add(value);
/// }
/// assert_eq!(estimate.mean(), Some(4.0));
/// assert_eq!(estimate.variance(), Some(8.0 / 3.0));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Estimate {
    count: u64,
    not_finite: u64,
    sum: ExactSum,
    squares: ExactSum,
}

/// A range of values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl Interval {
    /// Whether `value` lies in the range, ends included.
    pub fn contains(&self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }
}

impl Estimate {
    /// An estimate without samples.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a sample. Infinities and not-a-numbers are counted apart and enter no sum.
    #[inline]
    pub fn add(&mut self, sample: f64) {
        if sample.is_finite() {
            self.count += 1;
            self.sum.add(sample);
            self.squares.add_product(sample, sample);
        } else {
            self.not_finite += 1;
        }
    }

    /// Adds all samples of another estimate; the same bits as if they had been added here, in any order.
    pub fn merge(&mut self, other: &Self) {
        self.count += other.count;
        self.not_finite += other.not_finite;
        self.sum.merge(&other.sum);
        self.squares.merge(&other.squares);
    }

    /// Number of finite samples.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Number of samples that were infinite or not a number.
    pub fn not_finite(&self) -> u64 {
        self.not_finite
    }

    /// Mean of the finite samples; `None` without any.
    pub fn mean(&self) -> Option<f64> {
        (self.count > 0).then(|| self.sum.mean(self.count))
    }

    /// Unbiased variance of one sample, free of cancellation; `None` below two samples.
    pub fn variance(&self) -> Option<f64> {
        let mean = self.mean().filter(|_| self.count >= 2)?;
        // Σ(x−m)² = Σx² − 2mΣx + nm², exactly, for the rounded mean m; the rest of the mean is a tiny correction.
        let mut deviations = self.squares.clone();
        deviations.add_scaled(&self.sum, -mean);
        deviations.add_scaled(&self.sum, -mean);
        deviations.add_repeated_square(self.count, mean);
        let mut remainder = self.sum.clone();
        remainder.add_repeated(self.count, -mean);
        let (n, rest) = (self.count as f64, remainder.value());
        Some((deviations.value() - rest * rest / n).max(0.0) / (n - 1.0))
    }

    /// Standard error of the mean; `None` below two samples.
    pub fn standard_error(&self) -> Option<f64> {
        Some((self.variance()? / self.count as f64).sqrt())
    }

    /// Distance of the mean from the truth in standard errors, with sign; `None` below two samples.
    ///
    /// Zero when both the distance and the error vanish, infinite when only the error does.
    pub fn z_score(&self, truth: f64) -> Option<f64> {
        let distance = self.mean()? - truth;
        let error = self.standard_error()?;
        Some(if distance == 0.0 { 0.0 } else { distance / error })
    }

    /// The interval that holds the truth with probability `level` (in (0, 1)) by Student's t, when the mean is about normal.
    ///
    /// `None` below two samples or for another level.
    pub fn confidence_interval(&self, level: f64) -> Option<Interval> {
        if !(level > 0.0 && level < 1.0) {
            return None;
        }
        let (mean, error) = (self.mean()?, self.standard_error()?);
        let reach = error * student_quantile(0.5 + 0.5 * level, (self.count - 1) as f64);
        Some(Interval { low: mean - reach, high: mean + reach })
    }
}

impl Extend<f64> for Estimate {
    fn extend<T: IntoIterator<Item = f64>>(&mut self, samples: T) {
        samples.into_iter().for_each(|sample| self.add(sample));
    }
}

impl FromIterator<f64> for Estimate {
    fn from_iter<T: IntoIterator<Item = f64>>(samples: T) -> Self {
        let mut estimate = Self::new();
        estimate.extend(samples);
        estimate
    }
}

#[cfg(test)]
mod tests;
