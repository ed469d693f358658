//! Polynomials go a way of their own; it finds what ranges find.

use crate::samples::{VARIABLES, tape};
use luch_formula::{FirstRoot, RootFinder, Tape};
use proptest::prelude::*;

const TOLERANCE: f64 = 1e-9;

/// A ray and the range of its parameter.
#[derive(Clone, Debug)]
struct Ray {
    origin: [f64; 3],
    direction: [f64; 3],
    range: [f64; 2],
}

fn at(tape: &Tape, ray: &Ray, t: f64) -> f64 {
    tape.value(&std::array::from_fn::<_, 3, _>(|axis| ray.origin[axis] + t * ray.direction[axis]))
}

/// Both ways tell the same, or differ where the tolerance allows it.
fn agree(text: &str, ray: &Ray) -> Result<(), TestCaseError> {
    let tape = tape(text);
    let [first, last] = ray.range;
    let quick = RootFinder::new(&tape, TOLERANCE).first(&ray.origin, &ray.direction, first, last);
    let sure =
        RootFinder::new(&tape, TOLERANCE).intervals_only().first(&ray.origin, &ray.direction, first, last);
    if let FirstRoot::Crossing(t) = quick
        && t - TOLERANCE > first
        && t + TOLERANCE < last
    {
        let (before, behind) = (at(&tape, ray, t - TOLERANCE), at(&tape, ray, t + TOLERANCE));
        // A ray that grazes may have no sign that rounding leaves sure.
        let sure = before.abs().max(behind.abs()) > 1e-14;
        prop_assert!(before * behind <= 0.0 || !sure, "{text} {ray:?}: {quick:?}, {before:e} {behind:e}");
    }
    match (quick, sure) {
        (FirstRoot::None, FirstRoot::None) => {}
        (FirstRoot::Crossing(a), FirstRoot::Crossing(b)) if (a - b).abs() <= 2.0 * TOLERANCE => {}
        // Where a ray grazes the values between both are rounding alone.
        (FirstRoot::Crossing(a), FirstRoot::Crossing(b)) => {
            for step in 0..=8 {
                let value = at(&tape, ray, a + (b - a) * f64::from(step) / 8.0);
                prop_assert!(value.abs() < 1e-12, "{text} {ray:?}: {a} {b} {value:e}");
            }
        }
        // A touch is within rounding of zero all the way to what the other has found.
        (FirstRoot::None, FirstRoot::Touching(t)) | (FirstRoot::Touching(t), FirstRoot::None) => {
            prop_assert!(at(&tape, ray, t).abs() < 1e-9, "{text} {ray:?}: {quick:?} {sure:?}");
        }
        (
            FirstRoot::Crossing(a) | FirstRoot::Touching(a),
            FirstRoot::Crossing(b) | FirstRoot::Touching(b),
        ) => {
            for step in 0..=8 {
                let t = a + (b - a) * f64::from(step) / 8.0;
                prop_assert!(at(&tape, ray, t).abs() < 1e-9, "{text} {ray:?}: {quick:?} {sure:?}");
            }
        }
        _ => prop_assert!(false, "{text} {ray:?}: {quick:?} {sure:?}"),
    }
    Ok(())
}

/// Polynomials of degree 8 at most.
fn polynomial() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        3 => prop::sample::select(&VARIABLES[..]).prop_map(str::to_owned),
        1 => (-20_i32..20).prop_map(|tenths| format!("({})", f64::from(tenths) / 10.0)),
    ];
    let sum = |inner: BoxedStrategy<String>| {
        (prop::sample::select(&["+", "-"][..]), inner.clone(), inner)
            .prop_map(|(operator, a, b)| format!("({a} {operator} {b})"))
    };
    let linear = sum(sum(leaf.boxed()).boxed()).boxed();
    let square = prop_oneof![
        linear.clone().prop_map(|a| format!("{a}^2/3")),
        (linear.clone(), linear.clone()).prop_map(|(a, b)| format!("{a}*{b}")),
        linear.clone(),
    ];
    let quadric = sum(square.boxed()).boxed();
    prop_oneof![
        quadric.clone(),
        sum(quadric.clone()),
        (quadric.clone(), quadric.clone()).prop_map(|(a, b)| format!("-({a}*{b})")),
        (quadric.clone(), linear).prop_map(|(a, b)| format!("{a}^3 - {b}^5")),
        quadric.prop_map(|a| format!("{a}^4 - 0.01")),
    ]
}

fn ray() -> impl Strategy<Value = Ray> {
    let coordinate =
        || prop_oneof![3 => -2.0..2.0, 1 => (-4_i32..5).prop_map(|halves| f64::from(halves) / 2.0)];
    let three = || [coordinate(), coordinate(), coordinate()];
    (three(), three(), -3.0..0.0, 0.1..6.0).prop_map(|(origin, direction, first, length)| Ray {
        origin,
        direction,
        range: [first, first + length],
    })
}

proptest! {
    #![proptest_config(crate::samples::cases(1500))]

    #[test]
    fn both_ways_agree(text in polynomial(), ray in ray()) {
        let direction: f64 = ray.direction.iter().map(|d| d.abs()).sum();
        prop_assume!(direction > 0.1);
        agree(&text, &ray)?;
    }

    #[test]
    fn rays_that_graze_a_ball_are_told(
        angle in 0.0..6.2,
        offset in prop_oneof![
            Just(0.0), -1e-3..1e-3, -1e-7..1e-7, -1e-13..1e-13, (-40_i32..40).prop_map(|n| f64::from(n) * 1e-17)
        ],
    ) {
        // The closest point is 1 + offset from the middle.
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        let distance = 1.0 + offset;
        let ray = Ray { origin: [distance * cos - 3.0 * sin, distance * sin + 3.0 * cos, 0.0],
            direction: [sin, -cos, 0.0], range: [0.0, 6.0] };
        for text in ["x^2 + y^2 + z^2 - 1", "(x^2 + y^2 + z^2 - 1)*(x^2 + y^2 + 3)*(z - 2)"] {
            let found = RootFinder::new(&tape(text), TOLERANCE).first(&ray.origin, &ray.direction, 0.0, 6.0);
            // The chord has half the length √(1 − d²); rounding moves d by some units of the last place.
            match offset {
                o if o < -1e-14 => {
                    let expected = 3.0 - (1.0 - distance * distance).sqrt();
                    let off = 2.0 * TOLERANCE + 4e-15 / (-2.0 * o).sqrt();
                    prop_assert!(matches!(found.parameter(), Some(t) if (t - expected).abs() < off), "{text} {o:e} {found:?}");
                }
                o if o > 1e-14 => prop_assert_eq!(found, FirstRoot::None),
                _ => prop_assert!(found.parameter().is_none_or(|t| (t - 3.0).abs() < 1e-6), "{text} {found:?}"),
            }
            agree(text, &ray)?;
        }
    }
}

#[test]
fn double_and_triple_roots_are_found_by_both_ways() {
    let ray = Ray { origin: [0.0, 0.1, 0.2], direction: [1.0, 0.0, 0.0], range: [-2.0, 3.0] };
    for text in [
        "(x - 0.3)^2*(x + 5)",
        "(x - 0.3)^2*(x - 0.3001)",
        "(x - 0.3)^3",
        "(x - 0.3)^4*(x - 1)",
        "(x - 0.3)^2*(x + 1.9)^2",
        "(x + y)^2 - 2*x*y - 0.01",
        "(x - 0.3)^6 - 1e-30",
        "0*x",
        "0*x + 1e-300",
    ] {
        agree(text, &ray).unwrap();
    }
}

#[test]
fn wide_ranges_and_great_numbers_are_no_trouble() {
    let sphere = tape("x^2 + y^2 + z^2 - 1");
    for last in [10.0, 1e4, 1e9, 1e150, 1e300, f64::INFINITY] {
        let found = RootFinder::new(&sphere, 1e-9).first(&[0.0, 0.0, -3.0], &[0.0, 0.0, 1.0], 0.0, last);
        assert!(matches!(found, FirstRoot::Crossing(t) if (t - 2.0).abs() <= 1e-9), "{last}: {found:?}");
    }
    // No tolerance: as near as numbers come.
    let found = RootFinder::new(&sphere, 0.0).first(&[0.1, 0.0, -3.0], &[0.0, 0.0, 1.0], 0.0, 10.0);
    let exact = 3.0 - 0.99_f64.sqrt();
    assert!(matches!(found, FirstRoot::Crossing(t) if (t - exact).abs() < 2e-15), "{found:?}");
    // Steps are counted here too.
    let found = RootFinder::new(&tape("(x^2 - 0.01)*(x^2 - 0.04)*(x^2 - 0.02)"), 1e-9).most_steps(3).first(
        &[0.0; 3],
        &[1.0, 0.0, 0.0],
        -1.0,
        3.0,
    );
    assert!(matches!(found, FirstRoot::Exhausted(t) if t <= -0.2), "{found:?}");
}
