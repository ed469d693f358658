//! Expressions put together by programs.

use crate::samples::{VARIABLES, coordinate, formula};
use luch_formula::{Expression, Tape, parse};
use proptest::prelude::*;

fn value(expression: &Expression, point: [f64; 3]) -> f64 {
    Tape::new(expression, &VARIABLES).unwrap().value(&point)
}

fn ball() -> Expression {
    parse("hypot(x, y, z) - 1", &VARIABLES).unwrap()
}

#[test]
fn operators_build_what_text_builds() {
    let [x, y] = ["x", "y"].map(Expression::variable);
    let pairs = [
        (&x + &y * 2.0, "x + y*2"),
        (1.0 - (&x / &y), "1 - x/y"),
        (-x.clone() + 3.0, "3 - x"),
        (x.squared().sin().min(&y), "min(sin(x^2), y)"),
        (x.is_less(&y).and(x.is_equal(1.0)).logical_not(), "not (x < y and x == 1)"),
        (x.is_at_most(0.0).select(&x, &y), "if(x <= 0, x, y)"),
        (x.clamp(0.0, 1.0).mix(&y, 0.5), "mix(clamp(x, 0, 1), y, 0.5)"),
        (x.smoothstep(0.0, &y).modulo(2.0), "mod(smoothstep(0, y, x), 2)"),
        (x.atan2(&y).pow(-2.0), "atan2(x, y)^-2"),
        (Expression::length(&[&x, &y]), "hypot(x, y)"),
    ];
    for (built, text) in pairs {
        let read = parse(text, &["x", "y"]).unwrap();
        assert_eq!(built.operations(), read.operations(), "{text}");
        for point in [[0.5, 2.0, 0.0], [-1.5, 0.25, 0.0], [1.0, 1.0, 0.0]] {
            assert_eq!(value(&built, point).to_bits(), value(&read, point).to_bits(), "{text}");
        }
    }
}

#[test]
fn constants_fold_and_identities_are_exact() {
    for (text, same) in [
        ("x*1", "x"),
        ("1*x/1", "x"),
        ("x - 0", "x"),
        ("--x", "x"),
        ("x^1", "x"),
        ("x^0", "1"),
        ("x - -y", "x + y"),
        ("-x + y", "y - x"),
        ("abs(-x)", "abs(x)"),
        ("abs(abs(x))", "abs(x)"),
        ("min(x, x)", "x"),
        ("x/4", "0.25*x"),
        ("y*x", "x*y"),
        ("if(2 > 1, x, y)", "x"),
        ("if(x, y, y)", "y"),
        ("x^(1/2)", "sqrt(x)"),
        ("e^x", "exp(x)"),
        ("-1*x", "-x"),
        ("sin(pi/6 + x - x)", "sin(pi/6 + x - x)"),
    ] {
        assert_eq!(parse(text, &["x", "y"]).unwrap(), parse(same, &["x", "y"]).unwrap(), "{text}");
    }
    // These are not identities of all numbers: infinite ones, −0.
    for text in ["x*0", "x - x", "x/x", "x + 0", "0*x + 1"] {
        assert!(parse(text, &["x"]).unwrap().operations() > 0, "{text}");
    }
    assert_eq!(parse("(x + y)^2 + sin(y + x)", &["x", "y"]).unwrap().operations(), 4);
}

#[test]
fn substitution_is_done_at_once() {
    let [x, y] = ["x", "y"].map(Expression::variable);
    let difference = &x - &y;
    assert_eq!(difference.substitute(&[("x", &y), ("y", &x)]), &y - &x);
    assert_eq!(difference.substitute(&[("x", 5.0), ("y", 3.0)]).as_constant(), Some(2.0));
    assert_eq!(difference.substitute(&[("w", &y)]), difference);
}

#[test]
fn solids_are_combined() {
    let (here, there) = (ball(), ball().translated([1.5, 0.0, 0.0]));
    let both = here.union(&there);
    assert!(
        value(&both, [0.0; 3]) < 0.0
            && value(&both, [1.5, 0.0, 0.0]) < 0.0
            && value(&both, [3.0, 0.0, 0.0]) > 0.0
    );
    let lens = here.intersection(&there);
    assert!(value(&lens, [0.75, 0.0, 0.0]) < 0.0 && value(&lens, [0.0; 3]) > 0.0);
    let bitten = here.difference(&there);
    assert!(value(&bitten, [0.0; 3]) < 0.0 && value(&bitten, [0.75, 0.0, 0.0]) > 0.0);
    // A rounded seam adds material near it, a quarter of the width in the middle, and none far away.
    let blended = here.smooth_union(&there, 0.4);
    let seam = [0.75, 0.7, 0.0];
    assert!((value(&both, seam) - value(&blended, seam) - 0.1).abs() < 1e-15);
    assert_eq!(value(&both, [-1.0, 0.0, 0.0]), value(&blended, [-1.0, 0.0, 0.0]));
    assert_eq!(here.smooth_union(&there, 0.0), both);
    let carved = here.smooth_difference(&there, 0.4);
    assert!(value(&carved, [0.5, 0.0, 0.0]) >= value(&bitten, [0.5, 0.0, 0.0]));
    assert_eq!(value(&here.offset(0.5), [1.5, 0.0, 0.0]), 0.0);
    let shell = here.shell(0.2);
    assert!(value(&shell, [1.0, 0.0, 0.0]) < 0.0 && value(&shell, [0.0; 3]) > 0.0);
}

#[test]
fn many_parts_join_in_logarithmic_depth() {
    let parts: Vec<Expression> =
        (0..200).map(|i| ball().translated([3.0 * f64::from(i), 0.0, 0.0])).collect();
    let row = Expression::least(&parts);
    assert_eq!(value(&row, [300.0, 0.0, 0.0]), -1.0);
    assert_eq!(value(&Expression::greatest(&parts[..2]), [0.0; 3]), 2.0);
    assert_eq!(value(&Expression::sum(&parts[..2]), [0.0; 3]), 1.0);
    assert_eq!(Expression::sum(&[]).as_constant(), Some(0.0));
    assert_eq!(Expression::least(&[]).as_constant(), Some(f64::INFINITY));
}

#[test]
fn moves_take_points_along() {
    let point_like = parse("x + 10y + 100z", &VARIABLES).unwrap();
    let turned = point_like.rotated([0.0, 0.0, 1.0], std::f64::consts::FRAC_PI_2);
    // What stood at (1, 0, 0) stands at (0, 1, 0).
    assert!((value(&turned, [0.0, 1.0, 0.0]) - 1.0).abs() < 1e-14);
    let skew = point_like.rotated([1.0, 2.0, -0.5], 1.2).rotated([1.0, 2.0, -0.5], -1.2);
    assert!((value(&skew, [0.3, -0.4, 0.9]) - value(&point_like, [0.3, -0.4, 0.9])).abs() < 1e-12);
    assert_eq!(point_like.rotated([0.0; 3], 1.0), point_like);
    assert!((value(&ball().scaled(3.0), [4.0, 0.0, 0.0]) - 1.0).abs() < 1e-15);
    // Twisted by a quarter turn a unit: at height 1 what was along x points along −z, as a turn about y does.
    let bar = parse("abs(z) - 0.1 + 0*y", &VARIABLES).unwrap().twisted(std::f64::consts::FRAC_PI_2);
    assert!(value(&bar, [1.0, 0.0, 0.0]) < 0.0 && value(&bar, [1.0, 1.0, 0.0]) > 0.0);
    assert!(value(&bar, [0.0, 1.0, 1.0]) < 0.0);
    let by_turn = point_like.rotated([0.0, 1.0, 0.0], 0.7);
    let by_twist = point_like.twisted(0.7);
    assert!((value(&by_turn, [0.3, 1.0, 0.2]) - value(&by_twist, [0.3, 1.0, 0.2])).abs() < 1e-12);
    let row = ball().repeated([4.0, 0.0, 0.0]);
    assert_eq!(value(&row, [8.0, 0.0, 0.0]), -1.0);
    assert_eq!(value(&row, [-6.0, 0.0, 0.0]), 1.0);
    let matrix = [[1.0, 0.0, 0.0, -2.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    assert_eq!(value(&ball().transformed(&matrix), [2.0, 0.0, 0.0]), -1.0);
}

proptest! {
    #![proptest_config(crate::samples::cases(300))]

    #[test]
    fn substituted_values_are_the_values_there(
        text in formula(), inner in formula(), point in [coordinate(), coordinate(), coordinate()],
    ) {
        // A constant put in for an exponent would turn a power into multiplications.
        let [outer, inner] = [text, format!("{inner} + 0*y")].map(|text| parse(&text, &VARIABLES).unwrap());
        let composed = outer.substitute(&[("x", &inner)]);
        let [_, y, z] = point;
        let expected = value(&outer, [value(&inner, point), y, z]);
        prop_assert!(value(&composed, point).to_bits() == expected.to_bits());
    }

    #[test]
    fn equal_texts_give_equal_expressions(text in formula()) {
        let [first, second] = [&text, &text].map(|text| parse(text, &VARIABLES).unwrap());
        prop_assert_eq!(first, second);
    }
}
