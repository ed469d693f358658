//! Samples on a regular lattice: voxels, scans, fields that were sampled.

use glam::DVec3;

use super::field::{Field, Interval, Points, Region};
use super::{ImplicitError, MOST_SAMPLES};

/// Values at the points of a lattice, in single precision; between them they are interpolated trilinearly.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Where the first sample lies, in metres.
    pub origin: DVec3,
    /// The distance of samples along each axis, in metres; positive.
    pub spacing: DVec3,
    counts: [usize; 3],
    values: Vec<f32>,
}

impl Grid {
    /// A grid of samples of which x runs fastest, then y, then z; at least two along each axis. It lies at the origin with a
    /// spacing of one.
    pub fn new(counts: [usize; 3], values: Vec<f32>) -> Result<Self, ImplicitError> {
        let [x, y, z] = counts;
        let total = x.checked_mul(y).and_then(|area| area.checked_mul(z));
        if counts.iter().any(|&count| count < 2) || total != Some(values.len()) {
            return Err(ImplicitError::SampleCount { given: values.len(), x, y, z });
        }
        if values.len() > MOST_SAMPLES {
            return Err(ImplicitError::TooManySamples { samples: values.len() as f64, most: MOST_SAMPLES });
        }
        Ok(Self { origin: DVec3::ZERO, spacing: DVec3::ONE, counts, values })
    }

    /// How many samples there are along each axis.
    pub fn counts(&self) -> [usize; 3] {
        self.counts
    }

    /// The samples, x fastest.
    pub fn samples(&self) -> &[f32] {
        &self.values
    }

    /// The samples, to be changed.
    pub fn samples_mut(&mut self) -> &mut [f32] {
        &mut self.values
    }

    /// The place of a sample in the list.
    #[inline]
    pub fn place(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.counts[1] + y) * self.counts[0] + x
    }

    /// One sample.
    #[inline]
    pub fn at(&self, sample: [usize; 3]) -> f32 {
        self.values[self.place(sample)]
    }

    /// Where a sample lies.
    pub fn position(&self, sample: [usize; 3]) -> DVec3 {
        self.origin + self.spacing * DVec3::from(sample.map(|n| n as f64))
    }

    /// The same with one more layer of samples on every side that lie outside everything, so that a surface is closed where
    /// the grid ends: exactly at its outermost samples.
    pub fn closed(&self) -> Result<Self, ImplicitError> {
        let counts = self.counts.map(|count| count + 2);
        let total = counts.iter().map(|&count| count as f64).product::<f64>();
        if total > MOST_SAMPLES as f64 {
            return Err(ImplicitError::TooManySamples { samples: total, most: MOST_SAMPLES });
        }
        let mut values = vec![f32::INFINITY; counts.iter().product()];
        for (row, samples) in self.values.chunks_exact(self.counts[0]).enumerate() {
            let (y, z) = (row % self.counts[1], row / self.counts[1]);
            let start = ((z + 1) * counts[1] + y + 1) * counts[0] + 1;
            values[start..start + samples.len()].copy_from_slice(samples);
        }
        Ok(Self { origin: self.origin - self.spacing, spacing: self.spacing, counts, values })
    }

    /// The cell of a coordinate and the fraction within it; outside, the nearest border.
    fn cell(&self, axis: usize, coordinate: f64) -> (usize, f64) {
        let last = (self.counts[axis] - 1) as f64;
        let along = ((coordinate - self.origin[axis]) / self.spacing[axis]).clamp(0.0, last);
        // What is not a number becomes 0 by the cast.
        let cell = (along as usize).min(self.counts[axis] - 2);
        (cell, along - cell as f64)
    }

    fn corners(&self, cell: [usize; 3]) -> [f64; 8] {
        let first = self.place(cell);
        let [row, slice] = [self.counts[0], self.counts[0] * self.counts[1]];
        std::array::from_fn(|c| {
            f64::from(self.values[first + (c & 1) + (c >> 1 & 1) * row + (c >> 2) * slice])
        })
    }
}

impl Field for Grid {
    fn values(&self, points: Points<'_>, values: &mut [f64]) {
        for (value, point) in values.iter_mut().zip(points.iter()) {
            let [x, y, z] = [0, 1, 2].map(|axis| self.cell(axis, point[axis]));
            let [a, b, c, d, e, f, g, h] = self.corners([x.0, y.0, z.0]);
            // At a sample only that sample counts: others may be infinite.
            let mix = |low: f64, high: f64, t: f64| match t {
                0.0 => low,
                1.0 => high,
                t => low * (1.0 - t) + high * t,
            };
            let low = mix(mix(a, b, x.1), mix(c, d, x.1), y.1);
            let high = mix(mix(e, f, x.1), mix(g, h, x.1), y.1);
            *value = mix(low, high, z.1);
        }
    }

    fn gradients(&self, points: Points<'_>, gradients: &mut [DVec3]) {
        for (gradient, point) in gradients.iter_mut().zip(points.iter()) {
            let place = [0, 1, 2].map(|axis| self.cell(axis, point[axis]));
            let corners = self.corners(place.map(|(cell, _)| cell));
            for axis in 0..3 {
                // The differences along four edges, weighted by the other two axes.
                let [one, other] = super::cell::other_axes(axis);
                let (t, u) = (place[one].1, place[other].1);
                let slope = |n: usize| {
                    let start = (n & 1) << one | (n >> 1) << other;
                    corners[start | 1 << axis] - corners[start]
                };
                let low = slope(0) * (1.0 - t) + slope(1) * t;
                let high = slope(2) * (1.0 - t) + slope(3) * t;
                gradient[axis] = (low * (1.0 - u) + high * u) / self.spacing[axis];
            }
        }
    }

    /// From the least to the greatest sample of all cells that the region touches.
    fn range(&self, region: &Region) -> Interval {
        let low = [0, 1, 2].map(|axis| self.cell(axis, region.min[axis]).0);
        let high = [0, 1, 2].map(|axis| self.cell(axis, region.max[axis]).0 + 1);
        let mut range = Interval { low: f64::INFINITY, high: f64::NEG_INFINITY };
        for z in low[2]..=high[2] {
            for y in low[1]..=high[1] {
                let start = self.place([low[0], y, z]);
                for &value in &self.values[start..=start + high[0] - low[0]] {
                    let value = f64::from(value);
                    if !value.is_finite() {
                        return Interval::EVERYTHING;
                    }
                    range = Interval { low: range.low.min(value), high: range.high.max(value) };
                }
            }
        }
        // Interpolation rounds.
        let slack = 1e-12 * range.low.abs().max(range.high.abs());
        Interval { low: range.low - slack, high: range.high + slack }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::implicit::field::PointList;

    /// Trilinear interpolation reproduces x y z and its gradient.
    #[test]
    fn products_of_coordinates_are_exact() {
        let mut grid = Grid::new([3, 4, 5], vec![0.0; 60]).unwrap();
        grid.origin = DVec3::new(-1.0, 0.5, 2.0);
        grid.spacing = DVec3::new(0.5, 1.0, 0.25);
        for z in 0..5 {
            for y in 0..4 {
                for x in 0..3 {
                    let p = grid.position([x, y, z]);
                    let place = grid.place([x, y, z]);
                    grid.samples_mut()[place] = (p.x * p.y * p.z) as f32;
                }
            }
        }
        let points = [DVec3::new(-0.3, 1.7, 2.6), DVec3::new(0.0, 3.5, 3.0), DVec3::new(-1.0, 0.5, 2.0)];
        let list: PointList = points.into_iter().collect();
        let (mut values, mut gradients) = ([0.0; 3], [DVec3::ZERO; 3]);
        grid.values(list.points(), &mut values);
        grid.gradients(list.points(), &mut gradients);
        for (n, p) in points.iter().enumerate() {
            assert!((values[n] - p.x * p.y * p.z).abs() < 1e-6);
            assert!((gradients[n] - DVec3::new(p.y * p.z, p.x * p.z, p.x * p.y)).length() < 1e-5);
            let range = grid.range(&Region { min: *p, max: *p });
            assert!(range.low <= values[n] && values[n] <= range.high);
        }
        assert_eq!(grid.range(&Region::cube(f64::INFINITY)).high, grid.range(&Region::cube(1e9)).high);
    }

    #[test]
    fn counts_that_lie_are_refused() {
        assert!(Grid::new([2, 2, 2], vec![0.0; 7]).is_err());
        assert!(Grid::new([1, 2, 4], vec![0.0; 8]).is_err());
        assert!(Grid::new([usize::MAX, 2, usize::MAX], vec![0.0; 8]).is_err());
    }
}
