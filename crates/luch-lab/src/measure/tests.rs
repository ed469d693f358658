//! Known answers of the measures.

use super::*;
use crate::generator::Generator;
use crate::points::{PointSet, Rule};

const INDEPENDENT: Rule = Rule::Independent(Generator::DEFAULT);

/// Discrepancies are small differences of sums up to 8, made of up to 16384 products rounded to 10⁻¹⁶ each.
fn close(value: f64, expected: f64) {
    assert!((value - expected).abs() <= 16_384.0 * f64::EPSILON, "{value}, expected {expected}");
}

#[test]
fn discrepancies_of_sobol_and_halton() {
    // Computed once with an independent implementation.
    let sobol = Rule::Sobol.points(64, 2, 0, 0).unwrap();
    close(l2_star(&sobol), 0.012_869_849_626_468_8);
    close(centred_squared(&sobol), 0.000_240_019_626_087_44);
    close(wrap_around_squared(&sobol), 0.000_253_601_206_673_61);
    let halton = Rule::Halton.points(64, 2, 0, 0).unwrap();
    close(l2_star(&halton), 0.016_409_436_360_002_3);
    let sobol = Rule::Sobol.points(128, 5, 0, 0).unwrap();
    close(centred_squared(&sobol), 0.000_799_805_954_129_429);
    close(wrap_around_squared(&sobol), 0.002_301_485_559_941_696);
    close(l2_star(&sobol), 0.008_165_499_418_031_6);
    let halton = Rule::Halton.points(100, 7, 0, 0).unwrap();
    close(centred_squared(&halton), 0.011_093_969_686_959_637);
    close(wrap_around_squared(&halton), 0.021_391_776_555_880_45);
    close(l2_star(&halton), 0.014_106_178_821_641_7);
}

#[test]
fn midpoints_have_the_least_discrepancy() {
    for n in [1, 7, 100] {
        let points = Rule::Midpoints.points(n, 1, 0, 0).unwrap();
        let exact = 1.0 / (12.0 * (n * n) as f64);
        assert!((l2_star_squared(&points) - exact).abs() < 1e-15);
        // In two dimensions the second coordinate zero adds nothing: a star discrepancy of one dimension.
        let flat: Vec<[f64; 2]> = points.iter().map(|p| [p[0], 0.0]).collect();
        close(star_discrepancy_2d(&flat), 1.0f64.max(0.5 / n as f64));
    }
    let empty = PointSet::from_flat(2, Vec::new()).unwrap();
    assert_eq!((l2_star(&empty), centred_squared(&empty), wrap_around_squared(&empty)), (0.0, 0.0, 0.0));
}

#[test]
fn discrepancy_of_independent_points_has_the_known_mean() {
    for d in [1, 2, 4] {
        let (n, replicates) = (32, 2000);
        let values: Vec<f64> =
            (0..replicates).map(|r| l2_star_squared(&INDEPENDENT.points(n, d, 5, r).unwrap())).collect();
        let mean = values.iter().sum::<f64>() / replicates as f64;
        let variance = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / (replicates - 1) as f64;
        let expected = (libm::pow(2.0, -(d as f64)) - libm::pow(3.0, -(d as f64))) / n as f64;
        let error = (variance / replicates as f64).sqrt();
        assert!((mean - expected).abs() < 4.0 * error, "{d}: {mean} ± {error}, {expected}");
    }
}

/// The star discrepancy by its definition: all boxes whose sides end on coordinates or 1, open and closed.
fn star_by_loops(points: &[[f64; 2]]) -> f64 {
    let ends = |axis: usize| points.iter().map(|p| p[axis]).chain([1.0]).collect::<Vec<_>>();
    let mut worst = 0.0f64;
    for &a in &ends(0) {
        for &b in &ends(1) {
            let open = points.iter().filter(|p| p[0] < a && p[1] < b).count();
            let closed = points.iter().filter(|p| p[0] <= a && p[1] <= b).count();
            let n = points.len() as f64;
            worst = worst.max(a * b - open as f64 / n).max(closed as f64 / n - a * b);
        }
    }
    worst
}

#[test]
fn star_discrepancy_is_what_loops_find() {
    for rule in [INDEPENDENT, Rule::Sobol, Rule::Hammersley, Rule::Jittered] {
        for n in [1, 4, 9, 64, 100] {
            let n = rule.nearest_count(n, 2) as usize;
            let points = rule.points(n, 2, 3, 0).unwrap().pair(0, 1).unwrap();
            assert!((star_discrepancy_2d(&points) - star_by_loops(&points)).abs() < 1e-15, "{rule:?} {n}");
        }
    }
    assert_eq!(star_discrepancy_2d(&[[0.5, 0.5], [0.5, 0.5]]), star_by_loops(&[[0.5, 0.5], [0.5, 0.5]]));
    assert_eq!(star_discrepancy_2d(&[]), 1.0);
}

/// The largest empty box by trying all pairs of sides.
fn box_by_loops(points: &[[f64; 2]]) -> f64 {
    let ends = |axis: usize| points.iter().map(|p| p[axis]).chain([0.0, 1.0]).collect::<Vec<_>>();
    let (xs, ys) = (ends(0), ends(1));
    let mut best = 0.0f64;
    for &a in &xs {
        for &b in xs.iter().filter(|b| **b > a) {
            for &c in &ys {
                for &d in ys.iter().filter(|d| **d > c) {
                    let inside = |p: &&[f64; 2]| p[0] > a && p[0] < b && p[1] > c && p[1] < d;
                    if points.iter().find(inside).is_none() {
                        best = best.max((b - a) * (d - c));
                    }
                }
            }
        }
    }
    best
}

#[test]
fn largest_empty_box_is_what_loops_find() {
    for rule in [INDEPENDENT, Rule::Sobol, Rule::Midpoints, Rule::Jittered] {
        for n in [1, 4, 9, 25] {
            for replicate in 0..4 {
                let points = rule.points(n, 2, 3, replicate).unwrap().pair(0, 1).unwrap();
                let found = largest_empty_box_2d(&points);
                assert!((found.area() - box_by_loops(&points)).abs() < 1e-15, "{rule:?} {n}");
                let inside = |p: &&[f64; 2]| {
                    (0..2).all(|axis| p[axis] > found.low[axis] && p[axis] < found.high[axis])
                };
                assert_eq!(points.iter().find(inside), None);
            }
        }
    }
    assert_eq!(largest_empty_box_2d(&[]).area(), 1.0);
}

#[test]
fn dispersion_of_simple_sets() {
    let middle = PointSet::from_flat(2, vec![0.5, 0.5]).unwrap();
    let ball = largest_empty_ball(&middle, 1e-6).unwrap();
    assert!(ball.radius <= 0.5f64.sqrt() && ball.bound >= 0.5f64.sqrt(), "{ball:?}");
    // A grid of middles: the corners of the square and of its cells are farthest, √d/(2k) away.
    for d in [1, 2, 3] {
        let grid = Rule::Midpoints.points(4usize.pow(d), d as usize, 0, 0).unwrap();
        let exact = f64::from(d).sqrt() / 8.0;
        let ball = largest_empty_ball(&grid, 1e-4).unwrap();
        assert!(ball.radius <= exact * (1.0 + 1e-12) && ball.bound >= exact * (1.0 - 1e-12), "{d} {ball:?}");
        close(least_distance(&grid, false), 0.25);
    }
    let near = PointSet::from_flat(2, vec![0.02, 0.5, 0.99, 0.5]).unwrap();
    close(least_distance(&near, false), 0.97);
    close(least_distance(&near, true), 0.03);
    assert!(largest_empty_ball(&PointSet::from_flat(2, Vec::new()).unwrap(), 0.1).is_none());
}

#[test]
fn power_of_jittered_and_independent_points() {
    // Jittered, n cells a side: 1 − Π sinc²(πk/n); independent: 1. Power is nearly exponential, so its variance its square.
    let sinc = |t: f64| if t == 0.0 { 1.0 } else { libm::sin(t) / t };
    let (side, replicates) = (8usize, 2000);
    for frequency in [[1, 0], [3, 0], [5, 2], [7, 7], [12, 3]] {
        for rule in [Rule::Jittered, INDEPENDENT] {
            let values: Vec<f64> = (0..replicates)
                .map(|r| power(&rule.points(side * side, 2, 8, r).unwrap(), &frequency))
                .collect();
            let mean = values.iter().sum::<f64>() / replicates as f64;
            let factors =
                frequency.map(|k| sinc(std::f64::consts::PI * f64::from(k) / side as f64)).map(|s| s * s);
            let expected = if rule == INDEPENDENT { 1.0 } else { 1.0 - factors[0] * factors[1] };
            let variance =
                values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / (replicates - 1) as f64;
            let error = (variance / replicates as f64).sqrt();
            assert!(
                (mean - expected).abs() < 4.0 * error,
                "{rule:?} {frequency:?}: {mean} ± {error}, {expected}"
            );
        }
    }
}

#[test]
fn the_whole_spectrum_agrees_with_single_frequencies() {
    let set = Rule::BlueNoise.points(256, 2, 1, 0).unwrap();
    let whole = spectrum(&set.pair(0, 1).unwrap(), 24);
    for frequency in [[0, 0], [1, 0], [-3, 5], [24, -24], [7, 11], [-7, -11]] {
        let (one, all) = (power(&set, &frequency), whole.at(frequency).unwrap());
        assert!((one - all).abs() < 1e-9 * one.max(1.0), "{frequency:?}: {one} {all}");
    }
    assert_eq!(whole.at([25, 0]), None);
    assert_eq!(whole.rings.len(), 24);
    // Blue: hardly any power in the waves longer than half the mean distance allows.
    assert!(whole.rings[..6].iter().all(|ring| ring.mean < 0.25), "{:?}", &whole.rings[..8]);
    let counted: u32 = whole.rings[..2].iter().map(|ring| ring.count).sum();
    assert_eq!(counted, 8 + 12);
}

#[test]
fn qualities_of_known_nets() {
    let sobol = Rule::Sobol.points(64, 3, 0, 0).unwrap();
    // The first three dimensions of Sobol's sequence: t = 0 in the first two, 1 in all three.
    assert_eq!(quality(&sobol), Some(1));
    let diagonal = PointSet::from_flat(2, (0..16).flat_map(|i| [f64::from(i) / 16.0; 2]).collect()).unwrap();
    assert_eq!(quality(&diagonal), Some(3));
    assert_eq!(quality(&INDEPENDENT.points(3, 2, 0, 0).unwrap()), None);
    assert_eq!(quality(&PointSet::from_flat(1, vec![1.0]).unwrap()), None);
    assert_eq!(pair_qualities(&sobol).unwrap().len(), 3);
}
