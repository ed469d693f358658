//! What is kept of many samples.

use luch_sampling::estimate::ExactSum;

/// Sums of samples and of their squares. They merge exactly: order and threads change no bit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sums {
    count: u64,
    sum: ExactSum,
    squares: ExactSum,
    outside: u64,
    not_finite: u64,
    greatest: f64,
}

impl Sums {
    /// The sums of some samples, of which `outside` fell outside the domain.
    pub(crate) fn of(samples: &[f64], outside: u64) -> Self {
        // Eight running sums: a fixed order, and wide enough for vector instructions.
        let (mut sums, mut squares, mut greatest) = ([0.0f64; 8], [0.0f64; 8], [0.0f64; 8]);
        let mut not_finite = 0;
        let mut take = |lane: usize, sample: f64| {
            let is_finite = sample.abs() < f64::INFINITY;
            not_finite += u64::from(!is_finite);
            let sample = if is_finite { sample } else { 0.0 };
            sums[lane] += sample;
            squares[lane] += sample * sample;
            let size = sample.abs();
            greatest[lane] = if size > greatest[lane] { size } else { greatest[lane] };
        };
        let groups = samples.chunks_exact(8);
        let rest = groups.remainder();
        for group in groups {
            (0..8).for_each(|lane| take(lane, group[lane]));
        }
        rest.iter().enumerate().for_each(|(lane, &sample)| take(lane, sample));
        let mut all = Self { count: samples.len() as u64, outside, not_finite, ..Self::default() };
        for lane in 0..8 {
            // Sums of finite numbers may overflow all the same.
            if sums[lane].is_finite() && squares[lane].is_finite() {
                all.sum.add(sums[lane]);
                all.squares.add(squares[lane]);
            } else {
                all.not_finite += 1;
            }
            all.greatest = all.greatest.max(greatest[lane]);
        }
        all
    }

    /// Adds others.
    pub fn merge(&mut self, other: &Self) {
        self.count += other.count;
        self.sum.merge(&other.sum);
        self.squares.merge(&other.squares);
        self.outside += other.outside;
        self.not_finite += other.not_finite;
        self.greatest = self.greatest.max(other.greatest);
    }

    /// Samples.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Samples that fell outside the domain and counted as zero.
    pub fn outside(&self) -> u64 {
        self.outside
    }

    /// Samples that were infinite or undefined; they counted as zero, so the mean is not to be trusted if there are any.
    pub fn not_finite(&self) -> u64 {
        self.not_finite
    }

    /// The greatest size of a sample.
    pub fn greatest(&self) -> f64 {
        self.greatest
    }

    /// The mean; `None` without samples.
    pub fn mean(&self) -> Option<f64> {
        (self.count > 0).then(|| self.sum.value() / self.count as f64)
    }

    /// Unbiased variance of one sample, as if samples were independent; `None` below two.
    pub fn variance(&self) -> Option<f64> {
        let mean = self.mean().filter(|_| self.count >= 2)?;
        let n = self.count as f64;
        Some((self.squares.value() - n * mean * mean).max(0.0) / (n - 1.0))
    }

    /// Standard error of the mean of independent samples; `None` below two.
    pub fn standard_error(&self) -> Option<f64> {
        Some((self.variance()? / self.count as f64).sqrt())
    }

    /// Distance from the truth in standard errors.
    pub fn z_score(&self, truth: f64) -> Option<f64> {
        let distance = self.mean()? - truth;
        Some(if distance == 0.0 { 0.0 } else { distance / self.standard_error()? })
    }
}
