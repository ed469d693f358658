//! Fourier power spectra.

use crate::points::PointSet;
use std::f64::consts::TAU;

/// Power |Σ exp(−2πi k·x)|²/N at one whole-number frequency: 1 on average for independent points and k ≠ 0; 0 for no points.
///
/// `frequency` has as many entries as the points have coordinates; missing ones count as 0.
pub fn power(points: &PointSet, frequency: &[i32]) -> f64 {
    if points.is_empty() {
        return 0.0;
    }
    let (mut real, mut imaginary) = (0.0, 0.0);
    for point in points {
        let turns: f64 = point.iter().zip(frequency).map(|(&x, &k)| x * f64::from(k)).sum();
        // Whole turns are taken off first: they cost digits only.
        let angle = TAU * (turns - turns.round());
        real += libm::cos(angle);
        imaginary += libm::sin(angle);
    }
    (real * real + imaginary * imaginary) / points.len() as f64
}

/// Power at all frequencies of a square, and its mean along circles.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    /// Frequencies run from −highest to highest along both axes.
    pub highest: u32,
    /// Power, row by row from the lowest second frequency, 2·highest + 1 in a row. The middle one, at frequency 0, is N.
    pub power: Vec<f64>,
    /// Mean along circles: entry r is for frequencies of length r − ½ to r + ½, from 1 to `highest`.
    pub rings: Vec<Ring>,
}

/// The mean of the power along a circle of frequencies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ring {
    /// Radius of the circle.
    pub radius: f64,
    /// Mean power.
    pub mean: f64,
    /// Sample variance of the power along the circle over its squared mean: how much it depends on direction; 1 is what chance gives.
    pub anisotropy: f64,
    /// Frequencies in the ring.
    pub count: u32,
}

impl Spectrum {
    /// The power at a frequency, or `None` outside of the square.
    pub fn at(&self, frequency: [i32; 2]) -> Option<f64> {
        let side = 2 * self.highest as usize + 1;
        let place =
            |k: i32| usize::try_from(i64::from(k) + i64::from(self.highest)).ok().filter(|&p| p < side);
        Some(self.power[place(frequency[1])? * side + place(frequency[0])?])
    }
}

/// The spectrum of points of the square up to `highest` (at most 1024) along each axis, in time N·highest².
pub fn spectrum(points: &[[f64; 2]], highest: u32) -> Spectrum {
    let highest = highest.clamp(1, 1024);
    let side = 2 * highest as usize + 1;
    // The other half of the plane mirrors this one, second frequencies 0 and above.
    let rows = highest as usize + 1;
    let mut sums = vec![[0.0f64; 2]; rows * side];
    let mut across = vec![[0.0f64; 2]; side];
    for &[x, y] in points {
        for (j, wave) in across.iter_mut().enumerate() {
            *wave = phasor(x * (j as f64 - f64::from(highest)));
        }
        for (row, sums) in sums.chunks_exact_mut(side).enumerate() {
            let [c, s] = phasor(y * row as f64);
            for (sum, [a, b]) in sums.iter_mut().zip(&across) {
                sum[0] += a * c - b * s;
                sum[1] += a * s + b * c;
            }
        }
    }
    let n = points.len().max(1) as f64;
    let mut power = vec![0.0; side * side];
    for row in 0..rows {
        for column in 0..side {
            let [re, im] = sums[row * side + column];
            let value = (re * re + im * im) / n;
            power[(highest as usize + row) * side + column] = value;
            power[(highest as usize - row) * side + (side - 1 - column)] = value;
        }
    }
    let rings = rings(&power, highest);
    Spectrum { highest, power, rings }
}

/// exp(−2πi·turns) as real and imaginary part.
fn phasor(turns: f64) -> [f64; 2] {
    let angle = TAU * (turns - turns.round());
    [libm::cos(angle), -libm::sin(angle)]
}

fn rings(power: &[f64], highest: u32) -> Vec<Ring> {
    let side = 2 * highest as usize + 1;
    let mut sums = vec![[0.0f64; 3]; highest as usize + 1];
    for (place, &value) in power.iter().enumerate() {
        let offset = |k: usize| k as f64 - f64::from(highest);
        let [kx, ky] = [offset(place % side), offset(place / side)];
        let radius = (kx * kx + ky * ky).sqrt().round() as usize;
        if let Some(sum) = sums.get_mut(radius).filter(|_| radius > 0) {
            *sum = [sum[0] + 1.0, sum[1] + value, sum[2] + value * value];
        }
    }
    let ring = |(radius, [count, sum, squares]): (usize, [f64; 3])| {
        let mean = sum / count;
        let variance = (squares - count * mean * mean) / (count - 1.0);
        Ring {
            radius: radius as f64,
            mean,
            anisotropy: if mean > 0.0 { variance / (mean * mean) } else { 0.0 },
            count: count as u32,
        }
    };
    sums.into_iter().enumerate().skip(1).map(ring).collect()
}
