//! Every problem finds its answer, with points of two kinds.

use super::*;
use crate::integral::{HashedPoints, SequencePoints};
use luch_sampling::Sequence;

#[test]
fn every_problem_finds_its_answer() {
    for (at, name) in Problem::NAMES.into_iter().enumerate() {
        let problem = Problem::named(name).unwrap();
        let seed = 40 + at as u64;
        let independent = problem.run(1 << 17, &HashedPoints { seed });
        let sobol = problem.run(1 << 17, &SequencePoints { sequence: Sequence::Sobol, seed });
        for run in [&independent, &sobol] {
            // 15 degrees of freedom: beyond 5.2 lies one in ten thousand.
            assert!(run.z_score.abs() < 5.2, "{}", run.explanation);
            assert!(run.standard_error < 0.01, "{}", run.explanation);
            assert_eq!(run.samples, 1 << 17);
            assert!(run.rows.len() > 10 && run.figure.layers.len() >= 2);
        }
        // In many dimensions the gain is too small to be seen in every run.
        if problem.dimensions() <= 2 {
            assert!(sobol.standard_error < independent.standard_error, "{name}");
        }
    }
    assert!(Problem::named("rho").is_none());
    let tiny = Problem::named("pi").unwrap().run(0, &HashedPoints { seed: 0 });
    assert_eq!(tiny.samples, 32);
}

#[test]
fn the_known_values() {
    for (name, truth) in [
        ("acute", 0.274_793_516_993_588_5),
        ("obtuse", 0.725_206_483_006_411_5),
        ("obtuse-rectangle", 0.798_374_285_126_921),
        ("obtuse-disc", 0.719_715_265_430_649),
        ("obtuse-ball", 0.528_571_428_571_429),
        ("cos77", 0.284_730_875_959_477_4),
    ] {
        assert!((Problem::named(name).unwrap().truth - truth).abs() < 1e-15, "{name}");
    }
}

#[test]
fn lamps_have_their_exact_values() {
    // Ground truth of the half-plane: place, visible fraction, form factor, form factor without blocker.
    for (p, visible, factor, whole) in [
        (-0.5, 0.0, 0.0, 0.062_095_951),
        (-0.25, 0.25, 0.014_066_780, 0.064_122_100),
        (0.0, 0.5, 0.032_408_078, 0.064_816_157),
        (0.2, 0.7, 0.046_860_819, 0.064_370_868),
        (0.5, 1.0, 0.062_095_951, 0.062_095_951),
    ] {
        let lamp = Lamp::half_covered(p);
        assert!((lamp.exact(Quantity::VisibleFraction) - visible).abs() < 1e-9, "{p}");
        assert!((lamp.exact(Quantity::FormFactor) - factor).abs() < 5.1e-10, "{p}");
        let free = Lamp { blockers: Vec::new(), ..lamp };
        assert!((free.exact(Quantity::FormFactor) - whole).abs() < 5.1e-10, "{p}");
    }
    for (point, visible) in [([0.0, 0.0], 0.75), ([0.3, 0.1], 0.75), ([0.6, 0.6], 0.7975), ([1.6, 0.0], 1.0)]
    {
        let exact = Lamp::over_rectangle(point).exact(Quantity::VisibleFraction);
        assert!((exact - visible).abs() < 1e-12, "{point:?}: {exact}");
    }
    for (s, visible) in [(-0.5, 0.195_501_109), (0.3, 0.688_081_168)] {
        let exact = Lamp::disc_with_edge(s).exact(Quantity::VisibleFraction);
        assert!((exact - visible).abs() < 5.1e-10, "{s}: {exact}");
    }
    for (p, visible) in [(0.0, 0.36), (0.3, 0.391_406_57), (0.7, 0.588_432_43), (1.2, 0.824_299_82)] {
        let exact = Lamp::over_disc(p).exact(Quantity::VisibleFraction);
        assert!((exact - visible).abs() < 5.1e-9, "{p}: {exact}");
    }
}

#[test]
fn several_blockers_are_counted_once() {
    let half = |x: f64| Blocker::Rectangle { height: 2.0, middle: [x, 0.0], sides: [0.4, 2.0] };
    let lamp = Lamp { blockers: vec![half(-0.1), half(0.1), half(0.0)], ..Lamp::over_rectangle([0.1, 0.2]) };
    let run = Problem::lamp(lamp, Quantity::FormFactor).run(1 << 18, &HashedPoints { seed: 9 });
    assert!(run.z_score.abs() < 5.2 && run.truth > 0.0, "{}", run.explanation);
}

#[test]
fn the_glossy_disc_is_uniform() {
    for glossiness in [0.0, 0.3, 0.5, 0.9, 1.0, f64::NAN] {
        assert!(Problem::glossy(glossiness).run(1 << 14, &HashedPoints { seed: 2 }).z_score.abs() < 5.2);
    }
    assert!((glossy_radius(0.5) - 1.0).abs() < 1e-15);
    assert!((glossy_radius(2.0 / 3.0) - 1.0 / 3f64.sqrt()).abs() < 1e-15);
    // Rings of equal area and equal angles hold equal counts.
    let mut counts = vec![0; 64];
    for i in 0..64_000u64 {
        let u = [1, 2].map(|key| luch_sampling::hash::word(key, i) as f64 / 18_446_744_073_709_551_616.0);
        let [x, y] = glossy_place(0.8, u);
        let ring = ((x * x + y * y) / (glossy_radius(0.8) * glossy_radius(0.8)) * 8.0) as usize;
        let angle = libm::atan2(y, x) / TAU + 0.5;
        counts[ring.min(7) * 8 + ((angle * 8.0) as usize).min(7)] += 1;
    }
    let test = luch_sampling::check::chi_square(&counts, &[1000.0; 64]);
    assert!(test.p_value > 1e-3, "{test:?}");
}

#[test]
fn edges_at_every_angle() {
    for i in 0..12 {
        let problem = Problem::edge(f64::from(i) * 0.55, -0.3 + 0.05 * f64::from(i));
        let run = problem.run(1 << 14, &SequencePoints { sequence: Sequence::Sobol, seed: i as u64 });
        assert!(run.z_score.abs() < 5.2, "{}", run.explanation);
    }
    assert_eq!(Problem::edge(0.0, 0.0).truth, 0.5);
}
