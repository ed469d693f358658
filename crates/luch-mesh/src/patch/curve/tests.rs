use super::*;
use crate::patch::shapes;
use std::f64::consts::{PI, TAU};

/// Numbers without pattern, from -1 to 1.
fn noise(seed: u64, k: u64) -> f64 {
    2.0 * luch_sampling::hash::unit_f64((luch_sampling::hash::word(seed, k) >> 32) as u32) - 1.0
}

fn odd_curve(seed: u64) -> Curve {
    let degree = 1 + (seed % 5) as usize;
    let count = degree + 1 + (seed % 4) as usize;
    let points: Vec<_> = (0..count as u64)
        .map(|k| {
            let place = DVec3::new(noise(seed, 4 * k), noise(seed, 4 * k + 1), noise(seed, 4 * k + 2));
            ControlPoint::weighted(place, 1.5 + noise(seed, 4 * k + 3))
        })
        .collect();
    Curve::b_spline(degree, &points).unwrap()
}

fn same(one: &Curve, other: &Curve) {
    let [a, b] = [one.domain(), other.domain()];
    for k in 0..=64 {
        let t = f64::from(k) / 64.0;
        assert!(one.position(a.at(t)).distance(other.position(b.at(t))) < 1e-13, "at {t}");
    }
}

#[test]
fn the_circle_is_exact() {
    let circle = shapes::circle(2.0).unwrap();
    for k in 0..=1000 {
        let point = circle.evaluate(f64::from(k) / 1000.0);
        assert!((point.position.length() - 2.0).abs() < 1e-12);
        assert!(point.position.dot(point.first).abs() < 1e-12 * point.first.length());
        assert_eq!(point.position.y, 0.0);
    }
    assert!((circle.arc_length() - 2.0 * TAU).abs() < 1e-11, "{}", circle.arc_length());
}

#[test]
fn straight_lines_and_a_parabola_have_known_lengths() {
    let line = Curve::polyline(&[DVec3::ZERO, DVec3::X * 3.0, DVec3::new(3.0, 4.0, 0.0)]).unwrap();
    assert!((line.arc_length() - 7.0).abs() < 1e-12);
    // y = x² from 0 to 1: √5/2 + asinh(2)/4.
    let parabola = [DVec3::ZERO, DVec3::X * 0.5, DVec3::new(1.0, 1.0, 0.0)].map(ControlPoint::new);
    let truth = 5f64.sqrt() / 2.0 + libm::asinh(2.0) / 4.0;
    assert!((Curve::bezier(&parabola).unwrap().arc_length() - truth).abs() < 1e-12);
    // A cusp: the cubic with its two inner points crossed has a finite length all the same.
    let cusp = [(0.0, 0.0), (1.0, 1.0), (0.0, 1.0), (1.0, 0.0)]
        .map(|(x, y)| ControlPoint::new(DVec3::new(x, y, 0.0)));
    assert!(Curve::bezier(&cusp).unwrap().arc_length() > 1.0);
}

#[test]
fn a_new_knot_a_higher_degree_and_pieces_keep_the_curve() {
    for seed in 0..40 {
        let curve = odd_curve(seed);
        let mut refined = curve.clone();
        for t in [0.31, 0.77, 0.31] {
            if refined.knots().multiplicity(t) < refined.knots().degree() {
                refined = refined.with_knot(t).unwrap();
            }
        }
        same(&curve, &refined);
        same(&curve, &curve.elevated().unwrap());
        assert_eq!(curve.elevated().unwrap().knots().degree(), curve.knots().degree() + 1);
        let reversed = curve.reversed();
        for k in 0..=16 {
            let t = f64::from(k) / 16.0;
            assert!(curve.position(t).distance(reversed.position(1.0 - t)) < 1e-13);
        }
        let breaks = curve.knots().breaks();
        for (piece, ends) in curve.bezier_pieces().iter().zip(breaks.windows(2)) {
            for k in 0..=8 {
                let t = f64::from(k) / 8.0;
                let there = curve.position(ends[0] + (ends[1] - ends[0]) * t);
                assert!(piece.position(t).distance(there) < 1e-13);
            }
        }
    }
    assert!(odd_curve(3).with_knot(0.0).is_err() && odd_curve(3).with_knot(f64::NAN).is_err());
}

#[test]
fn knots_that_are_not_clamped_give_the_same_pieces() {
    let knots = Knots::new(3, (0..10).map(f64::from).collect()).unwrap();
    let points: Vec<_> =
        (0..6).map(|k| ControlPoint::new(DVec3::new(noise(9, 2 * k), noise(9, 2 * k + 1), 0.0))).collect();
    let curve = Curve::new(knots, &points).unwrap();
    for (piece, start) in curve.bezier_pieces().iter().zip([3.0, 4.0, 5.0]) {
        for k in 0..=8 {
            let t = f64::from(k) / 8.0;
            assert!(piece.position(t).distance(curve.position(start + t)) < 1e-13);
        }
    }
    assert_eq!(curve.bezier_pieces().len(), 3);
}

#[test]
fn derivatives_are_those_of_the_curve() {
    for seed in 0..40 {
        let curve = odd_curve(seed);
        for k in 1..16 {
            // Off the knots, where derivatives may jump.
            let t = f64::from(k) / 16.0 + 0.003;
            let step = 1e-5;
            let [below, here, above] = [t - step, t, t + step].map(|t| curve.evaluate(t));
            let first = (above.position - below.position) / (2.0 * step);
            let second = (above.first - below.first) / (2.0 * step);
            // Central differences are off by step²/6 of the third derivative, which stays below 10⁵ for these curves.
            let scale = 1.0 + here.first.length() + here.second.length();
            assert!(first.distance(here.first) < 1e-5 * scale, "{seed} {t}");
            assert!(second.distance(here.second) < 1e-5 * scale, "{seed} {t}");
        }
    }
}

#[test]
fn bad_points_are_refused() {
    let good = ControlPoint::new(DVec3::ONE);
    for bad in [
        ControlPoint::new(DVec3::NAN),
        ControlPoint::new(DVec3::splat(1e19)),
        ControlPoint::weighted(DVec3::ONE, 0.0),
        ControlPoint::weighted(DVec3::ONE, -1.0),
        ControlPoint::weighted(DVec3::ONE, f64::INFINITY),
    ] {
        assert!(Curve::bezier(&[good, bad]).is_err());
    }
    assert!(Curve::bezier(&[good]).is_err() && Curve::bezier(&[]).is_err());
    assert!(Curve::b_spline(3, &[good; 3]).is_err());
    assert!(Curve::b_spline(PI as usize, &[good; 4]).is_ok());
}
