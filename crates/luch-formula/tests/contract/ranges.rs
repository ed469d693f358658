//! Ranges hold every value and every derivative.

use crate::samples::{coordinate, formula, tape};
use luch_formula::{Interval, IntervalDerivative, Tape};
use proptest::prelude::*;

/// Points of a box: corners, the middle, and given parts of the sides.
fn points(sides: [Interval; 3], parts: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let corner = |corner: usize| {
        std::array::from_fn(|axis| if corner >> axis & 1 == 0 { sides[axis].low } else { sides[axis].high })
    };
    let inner = |part: &[f64; 3]| {
        std::array::from_fn(|axis: usize| {
            let Interval { low, high, .. } = sides[axis];
            (low + part[axis] * (high - low)).clamp(low, high)
        })
    };
    (0..8).map(corner).chain([sides.map(|side| side.middle())]).chain(parts.iter().map(inner)).collect()
}

fn side() -> impl Strategy<Value = Interval> {
    let width = prop_oneof![1 => Just(0.0), 3 => 0.0..0.01, 3 => 0.0..3.0, 1 => 0.0..1e3];
    (coordinate(), width).prop_map(|(low, width)| {
        let low = if low.is_nan() { 0.0 } else { low };
        Interval::new(low, low + width)
    })
}

fn parts() -> impl Strategy<Value = Vec<[f64; 3]>> {
    prop::collection::vec([0.0..=1.0, 0.0..=1.0, 0.0..=1.0], 12)
}

/// The derivative along x, with y and z at rest anywhere in their sides.
fn along_x(tape: &Tape, sides: [Interval; 3]) -> IntervalDerivative {
    let rests = |value| IntervalDerivative { value, derivative: Interval::point(0.0) };
    let moves = IntervalDerivative { value: sides[0], derivative: Interval::point(1.0) };
    tape.interval_derivative(&[moves, rests(sides[1]), rests(sides[2])])
}

fn holds(text: &str, sides: [Interval; 3], parts: &[[f64; 3]]) -> Result<(), TestCaseError> {
    let tape = tape(text);
    let range = tape.interval(&sides);
    let slope = along_x(&tape, sides);
    prop_assert!(same(slope.value, range), "{} {:?} {:?}", text, slope.value, range);
    for point in points(sides, parts) {
        if point.iter().any(|coordinate| coordinate.is_nan()) {
            continue;
        }
        let mut by_x = [0.0];
        let value = tape.gradient(&point, &mut by_x);
        prop_assert!(range.contains(value), "{} at {:?}: {} not in {:?}", text, point, value, range);
        let derivative = slope.derivative;
        if !value.is_nan() && !derivative.partial {
            // Of infinite values the derivative says nothing.
            let known = value.is_finite() && !by_x[0].is_nan();
            prop_assert!(
                !known || derivative.contains(by_x[0]),
                "{} at {:?}: slope {} not in {:?}",
                text,
                point,
                by_x[0],
                derivative
            );
        }
        // The range of a point holds its value.
        prop_assert!(tape.interval(&point.map(Interval::point)).contains(value), "{} {:?}", text, point);
    }
    Ok(())
}

fn same(a: Interval, b: Interval) -> bool {
    a == b
}

proptest! {
    #![proptest_config(crate::samples::cases(1500))]

    #[test]
    fn ranges_hold_values_and_slopes(text in formula(), sides in [side(), side(), side()], parts in parts()) {
        holds(&text, sides, &parts)?;
    }

    #[test]
    fn the_mean_value_theorem_is_true_of_bounded_slopes(
        text in formula(), sides in [side(), side(), side()], parts in parts(),
    ) {
        let tape = tape(&text);
        for part in parts {
            let [_, y, z] = sides.map(|side| (side.low + part[1] * side.width()).clamp(side.low, side.high));
            let row = [sides[0], Interval::point(y), Interval::point(z)];
            let slope = along_x(&tape, row);
            if !slope.derivative.is_bounded() || !slope.value.is_bounded() || !row[0].is_bounded() {
                continue;
            }
            // f(b) − f(a), with its rounding, must meet f′ · (b − a), with its rounding.
            let (a, b) = (row[0].low, (row[0].low + part[0] * row[0].width()).min(row[0].high));
            let at = |x: f64| tape.interval(&[Interval::point(x), row[1], row[2]]);
            let (from, to) = (at(a), at(b));
            let change = [to.low - from.high, to.high - from.low];
            let length = b - a;
            let bound = [slope.derivative.low * length, slope.derivative.high * length];
            let slack = 1e-12 * (change[0].abs() + change[1].abs() + bound[0].abs() + bound[1].abs());
            prop_assert!(
                change[1] >= bound[0] - slack && change[0] <= bound[1] + slack,
                "{} from {} to {} at {} {}: {:?} {:?}", text, a, b, y, z, change, bound
            );
        }
    }
}

#[test]
fn every_function_holds_its_values_on_a_grid_of_boxes() {
    let parts: Vec<[f64; 3]> = (0..20).map(|i| [f64::from(i) / 20.0, 0.5, 0.5]).collect();
    let texts = crate::samples::ONE.map(|name| format!("{name}(x)"));
    let pairs = [
        "mod(x, 0.7)",
        "mod(y, x)",
        "atan2(x, y)",
        "atan2(y, x)",
        "x^y",
        "y^x",
        "x^3.5",
        "x^-2",
        "x^5",
        "x^65",
        "x^-65",
        "noise(x, y, z)",
    ];
    for text in texts.iter().map(String::as_str).chain(pairs) {
        for start in -16..16 {
            for width in [0.0, 0.001, 0.2, 0.5, 3.0, 20.0] {
                let low = f64::from(start) * 0.5;
                let side = Interval::new(low, low + width);
                for rest in [-1.5, 0.0, 2.0] {
                    holds(text, [side, Interval::new(rest, rest + 0.5 * width), side], &parts).unwrap();
                }
            }
        }
    }
}

#[test]
fn ranges_are_tight_where_that_is_easy() {
    let over = |text: &str, low: f64, high: f64| {
        let tape = tape(text);
        tape.interval(&[Interval::new(low, high), Interval::point(0.0), Interval::point(0.0)])
    };
    let near = |range: Interval, low: f64, high: f64| {
        let slack = 1e-13;
        assert!(
            range.low <= low && range.low > low - slack && range.high >= high && range.high < high + slack,
            "{range:?}"
        );
        assert!(!range.partial);
    };
    near(over("x^2", -1.0, 2.0), 0.0, 4.0);
    near(over("x*x", -1.0, 2.0), 0.0, 4.0);
    near(over("x^3", -2.0, 1.0), -8.0, 1.0);
    near(over("x^4", -2.0, 1.0), 0.0, 16.0);
    near(over("abs(x)", -2.0, 1.0), 0.0, 2.0);
    near(over("sin(x)", 0.0, 1.0), 0.0, libm::sin(1.0));
    near(over("sin(x)", 1.0, 2.0), libm::sin(1.0), 1.0);
    near(over("cos(x)", 3.0, 4.0), -1.0, libm::cos(4.0));
    near(over("cosh(x)", -1.0, 2.0), 1.0, libm::cosh(2.0));
    near(over("mod(x, 1)", 2.25, 2.5), 0.25, 0.5);
    near(over("mod(x, 1)", 2.25, 3.5), 0.0, 1.0);
    near(over("if(x > 3, 100, x)", 0.0, 1.0), 0.0, 1.0);
    near(over("x < 3", 0.0, 1.0), 1.0, 1.0);
    near(over("erf(x)", 0.0, 2.0), 0.0, libm::erf(2.0));
    // The domain of the root: undefined to the left, and told so.
    let root = over("sqrt(x)", -1.0, 4.0);
    assert!(root.partial && root.low == 0.0 && root.high >= 2.0);
    assert!(over("sqrt(x)", -2.0, -1.0).is_empty());
    assert!(over("1/x", -1.0, 1.0) == Interval::WHOLE);
    let quiet = over("noise(x, 0.5, 0.5)", 0.25, 0.2500001);
    assert!(quiet.width() < 1e-5);
}

#[test]
fn jumps_and_poles_have_no_bounded_slope() {
    for text in [
        "floor(x)",
        "round(x)",
        "sign(x)",
        "1/x",
        "tan(pi/2*(x + 1))",
        "if(x > 0, 1, 0)",
        "x > 0",
        "mod(x, 1)",
        "sqrt(x)",
        "cbrt(x)",
        "ln(x)",
        "atan2(x, -1)",
        "min(sqrt(x), 5)",
        "gamma(x)",
        "ceil(x) + x",
        "atan(1/x)",
    ] {
        let sides = [Interval::new(-0.6, 0.6), Interval::point(0.0), Interval::point(0.0)];
        assert!(!along_x(&tape(text), sides).derivative.is_bounded(), "{text}");
    }
    for text in [
        "abs(x)",
        "max(x, 0)",
        "sin(x)",
        "floor(x + 0.5 + 10*0)*0 + x^3",
        "if(x > 2, 1, x)",
        "noise(x, x, x)",
    ] {
        let sides = [Interval::new(-0.4, 0.4), Interval::point(0.0), Interval::point(0.0)];
        assert!(along_x(&tape(text), sides).derivative.is_bounded(), "{text}");
    }
}
