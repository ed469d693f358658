//! The first root is found, is the first, and is not made up.

use luch_formula::{FirstRoot, RootFinder, Tape, first_root, parse};
use proptest::prelude::*;

fn of_t(text: &str) -> Tape {
    Tape::new(&parse(text, &["t"]).unwrap_or_else(|error| panic!("{error}")), &["t"]).unwrap()
}

fn find(text: &str, first: f64, last: f64, tolerance: f64) -> FirstRoot {
    RootFinder::new(&of_t(text), tolerance).first(&[0.0], &[1.0], first, last)
}

/// A product of factors.
fn product(roots: &[f64]) -> String {
    roots.iter().map(|root| format!("(t - ({root}))")).collect::<Vec<_>>().join("*")
}

#[test]
fn roots_of_wilkinsons_polynomial_come_in_order() {
    let roots: Vec<f64> = (1..=20).map(f64::from).collect();
    let tape = of_t(&product(&roots));
    let mut finder = RootFinder::new(&tape, 1e-10);
    for root in roots {
        let found = finder.first(&[0.0], &[1.0], root - 0.5, 30.0);
        assert!(matches!(found, FirstRoot::Crossing(t) if (t - root).abs() <= 1e-10), "{root}: {found:?}");
    }
    assert_eq!(finder.first(&[0.0], &[1.0], 20.5, 1e6), FirstRoot::None);
}

#[test]
fn double_roots_are_touched() {
    for text in ["(t - 0.3)^2", "(t - 0.3)^4", "abs(t - 0.3)", "(t - 0.3)^2*(t - 2)", "1 - cos(t - 0.3)"] {
        let found = find(text, -1.0, 3.0, 1e-6);
        assert!(matches!(found, FirstRoot::Touching(t) if (t - 0.3).abs() <= 1e-4), "{text}: {found:?}");
    }
    // Clearly above zero there is no root; what the tolerance cannot tell apart is touched.
    assert_eq!(find("(t - 0.3)^2 + 1e-6", -1.0, 3.0, 1e-6), FirstRoot::None);
    assert!(find("(t - 0.3)^3", -1.0, 3.0, 1e-6).parameter().is_some());
}

#[test]
fn there_is_none_where_there_is_none() {
    for text in [
        "t^2 + 1",
        "exp(t)",
        "2 + sin(100t)",
        "3",
        "nan",
        "sqrt(-1 - t^2)",
        "1/t",
        "1/t^2",
        "1/t^3",
        "tan(t)/sin(t)*0 + 1",
    ] {
        assert_eq!(find(text, -1.0, 1.3, 1e-6), FirstRoot::None, "{text}");
    }
    assert_eq!(find("t", 1.0, -1.0, 1e-6), FirstRoot::None);
    assert_eq!(find("t", f64::NAN, 1.0, 1e-6), FirstRoot::None);
}

#[test]
fn thin_things_are_not_missed() {
    // A slab a millionth thick, far away.
    let found = find("abs(t - 12345.678) - 1e-6", 0.0, 1e9, 1e-9);
    assert!(matches!(found, FirstRoot::Crossing(t) if (t - (12_345.678 - 1e-6)).abs() < 2e-9), "{found:?}");
    // Two roots 1e-7 apart: the first.
    let found = find("(t - 0.5)*(t - 0.5000001)", 0.0, 1.0, 1e-12);
    assert!(matches!(found, FirstRoot::Crossing(t) if (t - 0.5).abs() < 1e-11), "{found:?}");
    // A fast wave: its first root is the first half wave.
    let found = find("cos(1000t)", 0.0, 10.0, 1e-12);
    assert!(
        matches!(found, FirstRoot::Crossing(t) if (t - std::f64::consts::PI / 2000.0).abs() < 1e-12),
        "{found:?}"
    );
}

#[test]
fn ends_belong_to_the_range() {
    assert!(matches!(find("t", 0.0, 1.0, 1e-9), FirstRoot::Crossing(t) if t == 0.0));
    assert!(matches!(find("t - 1", 0.0, 1.0, 1e-9), FirstRoot::Crossing(t) if t == 1.0));
    assert!(matches!(find("t - 1", 1.0, 1.0, 1e-9).parameter(), Some(t) if t == 1.0));
    assert_eq!(find("t - 2", 0.0, 1.0, 1e-9), FirstRoot::None);
    // Infinite ends.
    assert!(
        matches!(find("t - 7", f64::NEG_INFINITY, f64::INFINITY, 1e-9), FirstRoot::Crossing(t) if (t - 7.0).abs() < 1e-9)
    );
}

#[test]
fn jumps_are_told_from_crossings() {
    for text in ["if(t < 0.25, -1, 1)", "floor(4t) - 0.5", "sign(t - 0.25) + 0.5"] {
        let found = find(text, 0.0, 1.0, 1e-9);
        assert!(matches!(found, FirstRoot::Jump(t) if (t - 0.25).abs() < 1e-9), "{text}: {found:?}");
        assert_eq!(found.parameter(), None);
    }
    // Infinitely steep: nothing vouches for continuity.
    assert!(matches!(find("cbrt(t - 0.3)", 0.0, 1.0, 1e-9), FirstRoot::Jump(t) if (t - 0.3).abs() < 1e-9));
}

#[test]
fn budgets_are_kept() {
    let tape = of_t("sin(1/t)*0 + 0*t");
    let found = RootFinder::new(&tape, 0.0).most_steps(100).first(&[0.0], &[1.0], 1.0, 2.0);
    assert!(matches!(found, FirstRoot::Touching(_) | FirstRoot::Exhausted(_)), "{found:?}");
    let noisy = of_t("sin(1e9*t)*sin(1e9*t)");
    let found = RootFinder::new(&noisy, 1e-18).most_steps(50).first(&[0.0], &[1.0], 0.1, 1.0);
    assert!(matches!(found, FirstRoot::Exhausted(t) if (0.1..1.0).contains(&t)), "{found:?}");
}

#[test]
fn rays_meet_the_torus_where_the_quartic_says() {
    let variables = ["x", "y", "z"];
    let torus = parse("(hypot(x, y) - 1)^2 + z^2 - 0.0625", &variables).unwrap();
    let tape = Tape::new(&torus, &variables).unwrap();
    let mut finder = RootFinder::new(&tape, 1e-10);
    let mut hits = 0;
    for i in 0..2000 {
        let [a, b] = [0.754_877, 0.569_84].map(|step: f64| 3.0 * (f64::from(i) * step).fract() - 1.5);
        let (origin, direction) = ([a, b, 3.0], [0.1, -0.05, -1.0]);
        let found = finder.first(&origin, &direction, 0.0, 10.0);
        // March: the function is a distance here in its root, so that no step of this size can hide two crossings for long.
        let at = |t: f64| {
            let point: [f64; 3] = std::array::from_fn(|axis| origin[axis] + t * direction[axis]);
            tape.value(&point)
        };
        let marched =
            (0..10_000).map(|step| f64::from(step) * 1e-3).find(|&t| at(t) > 0.0 && at(t + 1e-3) <= 0.0);
        match (found, marched) {
            (FirstRoot::Crossing(t), Some(before)) => {
                hits += 1;
                assert!(t >= before - 1e-9 && t <= before + 1e-3 + 1e-9, "{i}: {t} {before}");
                assert!(at(t).abs() < 1e-8);
            }
            // A grazing ray may enter and leave between two steps.
            (FirstRoot::Crossing(t), None) => assert!(at(t).abs() < 1e-8 && at(t + 1e-3) > -1e-5),
            (FirstRoot::None, None) => {}
            other => panic!("{i}: {other:?}"),
        }
    }
    assert!(hits > 500);
}

proptest! {
    #![proptest_config(crate::samples::cases(500))]

    #[test]
    fn the_first_of_random_roots_is_found(
        mut roots in prop::collection::vec(-50_i32..50, 1..7),
        start in -60.0_f64..60.0,
    ) {
        // Simple roots at multiples of 0.1, at least 0.1 apart.
        roots.sort_unstable();
        roots.dedup();
        let roots: Vec<f64> = roots.into_iter().map(|tenths| f64::from(tenths) / 10.0).collect();
        let expected = roots.iter().copied().find(|root| *root >= start);
        prop_assume!(roots.iter().all(|root| (root - start).abs() > 1e-6));
        let found = first_root(&of_t(&product(&roots)), start, 60.0, 1e-9);
        match (found, expected) {
            (Some(found), Some(expected)) => prop_assert!((found - expected).abs() <= 1e-9),
            (found, expected) => prop_assert_eq!(found, expected),
        }
    }
}
