//! How fast the errors fall: slopes of RMSE ~ N^s against theory and known measurements.

use luch_sampling::check::fit_slope;
use luch_sampling::{Domain, Sampler, Sequence};

const REPLICATES: u32 = 96;
const FIRST: u32 = 6;
const LAST: u32 = 14;
const NORMAL: [f64; 4] = [1.0, 0.732_050_8, 0.618_033_99, 0.414_213_56];
const E_MINUS_1: f64 = std::f64::consts::E - 1.0;

#[derive(Clone, Copy, Debug, PartialEq)]
enum Integrand {
    /// Mean of e^x over the coordinates.
    Additive,
    /// Product of e^x.
    Smooth,
    /// An oblique ramp, flat below a plane.
    Kink,
    /// Inside of a ball.
    Ball,
    /// One side of an oblique plane.
    HalfSpace,
}

use Integrand::{Additive, Ball, HalfSpace, Kink, Smooth};

const INTEGRANDS: [Integrand; 5] = [Additive, Smooth, Kink, Ball, HalfSpace];

/// Values of all five integrands in `d` dimensions.
fn values(u: [f32; 4], exponentials: [f64; 4], d: usize) -> [f64; 5] {
    let mut plane = 0.0;
    let mut radius2 = 0.0;
    for (x, n) in u.iter().map(|&x| f64::from(x)).zip(NORMAL).take(d) {
        plane += n * (x - 0.45);
        radius2 += (x - 0.5) * (x - 0.5);
    }
    let exponentials = &exponentials[..d];
    [
        exponentials.iter().sum::<f64>() / d as f64,
        exponentials.iter().map(|e| e / E_MINUS_1).product(),
        plane.max(0.0),
        f64::from(radius2 <= 0.25),
        f64::from(plane > 0.0),
    ]
}

/// ∫ over the unit cube of (n·x − t)₊^p by inclusion and exclusion of corners: Σ ± (n·corner − t)₊^(d+p) / Π n / (d+p)!.
fn ramp_mean(d: usize, power: u32) -> f64 {
    let normal = &NORMAL[..d];
    let threshold = 0.45 * normal.iter().sum::<f64>();
    let mut sum = 0.0;
    for corner in 0..1u32 << d {
        let height: f64 = (0..d).filter(|i| corner >> i & 1 == 1).map(|i| normal[i]).sum::<f64>() - threshold;
        let sign = if (d as u32 - corner.count_ones()).is_multiple_of(2) { 1.0 } else { -1.0 };
        if height > 0.0 {
            sum += sign * (0..d as u32 + power).fold(1.0, |product, k| product * height / f64::from(k + 1));
        }
    }
    sum / normal.iter().product::<f64>()
}

fn truths(d: usize) -> [f64; 5] {
    use std::f64::consts::PI;
    let ball = [1.0, PI / 4.0, PI / 6.0, PI * PI / 32.0][d - 1];
    [E_MINUS_1, 1.0, ramp_mean(d, 1), ball, ramp_mean(d, 0)]
}

/// Mean squared errors by dimension, integrand and size.
fn mean_squared_errors(sequence: Sequence) -> [[[f64; (LAST - FIRST + 1) as usize]; 5]; 4] {
    let mut errors = [[[0.0; (LAST - FIRST + 1) as usize]; 5]; 4];
    let truths: [[f64; 5]; 4] = std::array::from_fn(|d| truths(d + 1));
    for replicate in 0..REPLICATES {
        let mut sums = [[0.0; 5]; 4];
        for index in 0..1u64 << LAST {
            let u = Sampler::at(sequence, 2024, [replicate, 0], 2 * index).group(Domain::new(0, 0));
            let exponentials = u.map(|x| libm::exp(f64::from(x)));
            for (d, sums) in sums.iter_mut().enumerate() {
                for (sum, value) in sums.iter_mut().zip(values(u, exponentials, d + 1)) {
                    *sum += value;
                }
            }
            let count = index + 1;
            if count.is_power_of_two() && count.ilog2() >= FIRST {
                for d in 0..4 {
                    for k in 0..5 {
                        let error = sums[d][k] / count as f64 - truths[d][k];
                        errors[d][k][(count.ilog2() - FIRST) as usize] +=
                            error * error / f64::from(REPLICATES);
                    }
                }
            }
        }
    }
    errors
}

/// Slope of the root mean square error; `stride` 2 takes the powers of four.
fn slope(errors: &[f64], stride: usize) -> f64 {
    let points: Vec<[f64; 2]> = errors
        .iter()
        .enumerate()
        .step_by(stride)
        .map(|(step, error)| [f64::from(1u32 << (FIRST + step as u32)), error.sqrt()])
        .collect();
    fit_slope(&points).unwrap().slope
}

/// What is expected of one row of the table, and how closely. A dash in the table is `None`.
fn compare(sequence: Sequence, stride: usize, rows: &[(usize, [Option<f64>; 5])]) {
    let errors = mean_squared_errors(sequence);
    for (d, expected) in rows {
        for ((integrand, expected), errors) in INTEGRANDS.iter().zip(expected).zip(&errors[d - 1]) {
            let Some(expected) = expected else { continue };
            let rough = sequence != Sequence::Independent && !matches!(integrand, Additive | Smooth);
            let tolerance = if rough { 0.12 } else { 0.08 };
            let measured = slope(errors, stride);
            assert!(
                (measured - expected).abs() <= tolerance,
                "{sequence:?}, {integrand:?} in {d} dimensions: {measured:.3}, expected {expected}"
            );
        }
    }
}

#[test]
fn independent_errors_fall_by_one_half() {
    let half = Some(-0.5);
    compare(
        Sequence::Independent,
        1,
        &[(1, [half, half, half, None, None]), (2, [half; 5]), (3, [half; 5]), (4, [half; 5])],
    );
}

#[test]
fn stratified_errors_in_the_plane() {
    let row = [-1.0, -1.0, -1.01, -0.75, -0.77].map(Some);
    compare(Sequence::Stratified, 2, &[(2, row)]);
}

#[test]
fn halton_errors() {
    compare(
        Sequence::Halton,
        1,
        &[
            (1, [Some(-1.5), Some(-1.5), Some(-1.5), None, None]),
            (2, [-1.01, -1.02, -1.01, -0.72, -0.74].map(Some)),
            // Theory alone: −1 for smooth integrands, −1/2 − 1/(2d) for jumps.
            (3, [Some(-1.0), Some(-1.0), None, Some(-0.667), Some(-0.667)]),
            (4, [Some(-1.0), Some(-1.0), None, Some(-0.625), Some(-0.625)]),
        ],
    );
}

#[test]
fn sobol_errors() {
    compare(
        Sequence::Sobol,
        1,
        &[
            (1, [Some(-1.5), Some(-1.5), Some(-1.5), None, None]),
            (2, [-1.48, -1.45, -1.25, -0.73, -0.77].map(Some)),
            (3, [-1.51, -1.39, -1.0, -0.64, -0.67].map(Some)),
            (4, [-1.49, -1.33, -0.89, -0.62, -0.61].map(Some)),
        ],
    );
}

#[test]
fn sobol_beats_chance_a_hundredfold() {
    let at_1024 = |sequence| mean_squared_errors(sequence)[1][1][10 - FIRST as usize].sqrt();
    let ratio = at_1024(Sequence::Sobol) / at_1024(Sequence::Independent);
    assert!(ratio < 0.01, "{ratio}");
}

#[test]
fn means_of_the_ramps_are_right() {
    // One dimension: ∫(x − 0.45)₊ = 0.55²/2, share above = 0.55.
    assert!((ramp_mean(1, 1) - 0.151_25).abs() < 1e-15);
    assert!((ramp_mean(1, 0) - 0.55).abs() < 1e-15);
}
