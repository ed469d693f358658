//! Known integrals.

use super::quantile::normal_cumulative;
use super::*;
use luch_sampling::Sequence;
use std::ops::ControlFlow;

const INDEPENDENT: HashedPoints = HashedPoints { seed: 11 };

fn bell(density: &str) -> Integral {
    let bell = Integral::new("cos(x)^77", "x=-pi/2..pi/2").unwrap();
    bell.with_density(density).unwrap().with_truth("sqrt(pi)*gamma(39)/gamma(39.5)").unwrap()
}

/// The exact variance of a sample by a fine midpoint rule of (f/ρ)²ρ, smooth and tiny at both ends.
fn exact_variance(integral: &Integral) -> f64 {
    let side = &integral.domain.sides()[0];
    let steps = 200_000;
    let step = side.length() / f64::from(steps);
    let squares: f64 = (0..steps)
        .map(|i| side.low + (f64::from(i) + 0.5) * step)
        .map(|x| {
            let value = integral.value(&[x]);
            if value == 0.0 { 0.0 } else { value * value / integral.density.pdf(&[x], &integral.domain) }
        })
        .sum();
    let truth = integral.truth.unwrap();
    squares * step - truth * truth
}

#[test]
fn truth_of_the_bell() {
    assert!((bell("uniform").truth.unwrap() - 0.284_730_875_959_477_4).abs() < 1e-15);
}

#[test]
fn variances_of_the_bell() {
    // Density, variance of a sample.
    for (density, variance) in [
        ("uniform", 0.552_468_893_752_759),
        ("normal(0, 0.15)", 0.008_685_186_320_736_89),
        ("normal(0, 0.13)", 0.002_452_196_838_888_75),
        ("normal(0, 0.12)", 0.000_489_002_942_420_546),
        ("normal(0, 1/sqrt(77))", 8.752_705_742_72e-6),
        ("normal(0, 0.11323066)", 2.222_155_691e-6),
        ("normal(0, 0.10)", 0.003_356_583_149_37),
        ("normal(0, 0.08)", 0.128_679_367_386_951),
        ("0.1*uniform + 0.9*normal(0, 0.15)", 0.016_983_467_6),
        ("0.5*uniform + 0.5*normal(0, 0.15)", 0.074_925_240_4),
    ] {
        let integral = bell(density);
        let exact = exact_variance(&integral);
        // All digits given.
        assert!((exact / variance - 1.0).abs() < 5e-9, "{density}: {exact} against {variance}");
        // And what sampling finds: its own error from the scatter of squared deviations.
        let samples = integral.samples(&INDEPENDENT, 0, 1 << 17);
        let truth = integral.truth.unwrap();
        let estimate: luch_sampling::Estimate = samples.iter().map(|s| (s - truth) * (s - truth)).collect();
        // Narrower than the integrand, the fourth moment does not exist: there the error bar of the variance means nothing.
        if density != "normal(0, 0.08)" && density != "normal(0, 0.10)" {
            assert!(estimate.z_score(variance).unwrap().abs() < 4.0, "{density}: {:?}", estimate.mean());
        }
        let sums = integral.estimate(&INDEPENDENT, 0, 1 << 17);
        let by_sums = sums.variance().unwrap();
        let plain: luch_sampling::Estimate = samples.into_iter().collect();
        assert!((by_sums / plain.variance().unwrap() - 1.0).abs() < 1e-9);
        assert!(sums.z_score(truth).unwrap().abs() < 4.0, "{density}");
    }
}

#[test]
fn pi_and_the_obtuse_triangle() {
    let pi = Integral::new("4*((x-0.5)^2+(y-0.5)^2 <= 0.25)", "x=0..1,y=0..1").unwrap();
    let sums = pi.estimate(&INDEPENDENT, 0, 1 << 20);
    assert!(sums.z_score(std::f64::consts::PI).unwrap().abs() < 4.0);
    // The deviation of a sample is 1.642183367736877; the variance of the variance of a coin is p(1−p)(1−2p)²·4⁴/N.
    let (p, n) = (std::f64::consts::FRAC_PI_4, f64::from(1 << 20));
    let variance = 16.0 * p * (1.0 - p);
    assert!((variance.sqrt() - 1.642_183_367_736_324).abs() < 1e-14);
    let error = 16.0 * (1.0 - 2.0 * p).abs() * (p * (1.0 - p) / n).sqrt();
    assert!((sums.variance().unwrap() - variance).abs() < 4.0 * error);

    let obtuse = "ab = (b1-a1)*(c1-a1)+(b2-a2)*(c2-a2); bc = (a1-b1)*(c1-b1)+(a2-b2)*(c2-b2); ca = (a1-c1)*(b1-c1)+(a2-c2)*(b2-c2); min(ab, min(bc, ca)) < 0";
    let obtuse = Integral::new(obtuse, "a1..a2=0..1,b1..b2=0..1,c1..c2=0..1")
        .unwrap()
        .with_truth("97/150+pi/40")
        .unwrap();
    assert!((obtuse.truth.unwrap() - 0.725_206_483_006_411_5).abs() < 1e-15);
    let sums = obtuse.estimate(&INDEPENDENT, 0, 1 << 20);
    assert!(sums.z_score(obtuse.truth.unwrap()).unwrap().abs() < 4.0);
    assert!((sums.variance().unwrap().sqrt() - 0.446_410_170_148_355).abs() < 1e-3);
}

#[test]
fn threads_change_no_bit() {
    let integral = bell("0.1*uniform + 0.9*normal(0, 0.15)");
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let three = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
    let run = || integral.estimate(&SequencePoints { sequence: Sequence::Sobol, seed: 1 }, 0, 100_001);
    let (a, b) = (one.install(run), three.install(run));
    assert_eq!(a, b);
    // In two parts: the chunks are others, so only the last digits may differ.
    let points = SequencePoints { sequence: Sequence::Sobol, seed: 1 };
    let mut parts = integral.sums_of(&points, 0, 0, 33);
    parts.merge(&integral.sums_of(&points, 0, 33, 100_001 - 33));
    assert!((parts.mean().unwrap() - a.mean().unwrap()).abs() < 1e-14);
    assert_eq!(parts.count(), a.count());
}

#[test]
fn draws_outside_count_as_zero() {
    let integral = Integral::new("1", "x=-1..1").unwrap().with_density("normal(0,1)").unwrap();
    let sums = integral.estimate(&INDEPENDENT, 0, 1 << 16);
    let expected = 2.0 * normal_cumulative(-1.0) * f64::from(1 << 16);
    let error = (f64::from(1 << 16) * 0.317 * 0.683).sqrt();
    assert!((sums.outside() as f64 - expected).abs() < 4.0 * error);
    assert!(sums.z_score(2.0).unwrap().abs() < 4.0);
}

#[test]
fn slopes_of_the_bell_and_of_products() {
    let sizes: Vec<u64> = (6..=13).map(|k| 1 << k).collect();
    let smooth = Integral::new("exp(x+y)/(e-1)^2", "x=0..1,y=0..1").unwrap().with_truth("1").unwrap();
    for (sequence, expected) in [(Sequence::Independent, -0.5), (Sequence::Sobol, -1.45)] {
        let measured =
            convergence(sequence.name(), &smooth, &SequencePoints { sequence, seed: 5 }, &sizes, 48);
        let fit = measured.slope.unwrap();
        assert!((fit.slope - expected).abs() < 0.08, "{sequence:?}: {fit:?}");
        assert!(fit.low < fit.slope && fit.slope < fit.high && fit.high - fit.low < 0.3, "{fit:?}");
        let factor = measured.equal_error_factor.unwrap();
        if sequence == Sequence::Independent {
            // The mean square of 48 replicates has a relative error of √(2/48).
            assert!((factor - 1.0).abs() < 4.0 * (2.0f64 / 48.0).sqrt(), "{factor}");
        } else {
            assert!(factor > 1e5, "{factor}");
        }
    }
    let constant = Integral::new("2", "x=0..1").unwrap().with_truth("2").unwrap();
    let exact = convergence("exact", &constant, &INDEPENDENT, &sizes, 4);
    assert!(exact.is_exact && exact.slope.is_none() && exact.equal_error_factor.is_none());
    let nothing = convergence("none", &constant, &INDEPENDENT, &[], 0);
    assert!(nothing.rows.is_empty() && nothing.slope.is_none());
}

#[test]
fn the_rule_reaches_its_target_and_warns() {
    let sobol = SequencePoints { sequence: Sequence::Sobol, seed: 3 };
    let target = Target::parse("rel 1e-3 @ 95%").unwrap();
    for member in suite().unwrap() {
        let outcome = until(&member.integral, &sobol, target, 1 << 24);
        assert_eq!(outcome.verdict, Verdict::Reached, "{}: {outcome:?}", member.name);
        let truth = member.integral.truth.unwrap();
        let half_width = outcome.half_width.unwrap();
        assert!(half_width <= 1e-3 * outcome.estimate.abs());
        assert!(
            (outcome.estimate - truth).abs() < 2.0 * half_width + 1e-14 * truth.abs(),
            "{}: {outcome:?}",
            member.name
        );
    }
    let heavy = Integral::new("x^(-0.8)", "x=0..1").unwrap();
    let outcome = until(&heavy, &sobol, target, 1 << 22);
    assert_eq!((outcome.verdict, outcome.half_width), (Verdict::HeavyTail, None));
    assert!(outcome.warnings[0].contains("variance may be infinite"), "{:?}", outcome.warnings);
    let blind = Integral::new("1", "x=0..1").unwrap().with_density("table(1,0)").unwrap();
    let outcome = until(&blind, &sobol, target, 1 << 20);
    assert_eq!((outcome.verdict, outcome.half_width), (Verdict::BlindSpot, None));
    let undefined = Integral::new("sqrt(x)", "x=-1..1").unwrap();
    assert_eq!(until(&undefined, &sobol, target, 1 << 20).verdict, Verdict::NotFinite);
    let hard =
        until(&bell("uniform"), &HashedPoints { seed: 1 }, Target::parse("rel 1e-9").unwrap(), 1 << 14);
    assert_eq!(hard.verdict, Verdict::LimitReached);
    for text in ["", "rel", "rel x", "rel -1", "rel 1 @ 20%", "foo 1", "rel 1e-3 @ 95% x"] {
        assert!(Target::parse(text).is_err(), "{text}");
    }
}

#[test]
fn the_interval_holds_the_truth_as_often_as_it_says() {
    let target = Target::parse("rel 0.02 @ 90%").unwrap();
    let runs = 32;
    let points =
        |run| -> Box<dyn Points> { Box::new(SequencePoints { sequence: Sequence::Sobol, seed: 1000 + run }) };
    let measured = coverage(&points, target, 1 << 22, runs);
    let (held, all) = measured.iter().fold((0, 0), |(held, all), one| (held + one.held, all + one.runs));
    assert_eq!(all, runs * measured.len() as u64, "{measured:?}");
    // At least the nominal 90 %, less four standard errors.
    let error = (0.1 * 0.9 / all as f64).sqrt();
    assert!(held as f64 / all as f64 > 0.9 - 4.0 * error, "{measured:?}");
    for one in &measured {
        let error = (0.1 * 0.9 / one.runs as f64).sqrt();
        assert!(one.held as f64 / one.runs as f64 > 0.9 - 4.0 * error, "{one:?}");
    }
}

#[test]
fn whoever_watches_may_end_it_and_changes_nothing_else() {
    let integral = Integral::new("exp(x)", "x=0..1").unwrap();
    let points = SequencePoints { sequence: Sequence::Independent, seed: 2 };
    let target = Target::parse("rel 1e-9").unwrap();
    let limit = 1 << 24;
    let mut calls = 0;
    let whole = until_watched(&integral, &points, target, limit, &mut |_| {
        calls += 1;
        ControlFlow::Continue(())
    });
    assert_eq!(whole.verdict, Verdict::LimitReached);
    // The last doublings are watched more than once.
    assert!(calls > whole.looks.len());
    let ended = until_watched(&integral, &points, target, limit, &mut |looks| match looks.len() {
        0..10 => ControlFlow::Continue(()),
        _ => ControlFlow::Break(()),
    });
    assert_eq!(ended.verdict, Verdict::Interrupted);
    assert_eq!(ended.looks, whole.looks[..10]);
    assert_eq!(ended.half_width, Some(whole.looks[9].half_width));
}

#[test]
fn points_without_chance_tell_no_error() {
    use crate::points::Rule;
    let integral = Integral::new("exp(x)", "x=0..1").unwrap();
    let hammersley = RulePoints { rule: Rule::Hammersley, seed: 1 };
    let found = convergence("hammersley", &integral, &hammersley, &[16, 64], 4);
    assert!(
        !found.has_errors && !found.is_exact && found.slope.is_none() && found.equal_error_factor.is_none()
    );
    let known = integral.with_truth("exp(1) - 1").unwrap();
    let found = convergence("hammersley", &known, &hammersley, &[16, 64, 256], 4);
    assert!(found.has_errors && !found.is_exact && found.slope.is_some());
    // Cells that fit once by chance make no exact rule.
    let step = Integral::new("if(x < 0.3, 1, 0)", "x=0..1").unwrap().with_truth("0.3").unwrap();
    let jittered = RulePoints { rule: Rule::Jittered, seed: 1 };
    assert!(!convergence("jittered", &step, &jittered, &[10, 64], 4).is_exact);
}
