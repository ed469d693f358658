//! One point or many, all levels, simplified or not: the same bits.

use crate::samples::{VARIABLES, bits, coordinate, formula, tape};
use luch_formula::{Expression, Interval, Level, Tape, TapeError, parse};
use proptest::prelude::*;

/// Values and derivatives one by one and in bulk.
fn agree(text: &str, points: &[[f64; 3]]) -> Result<(), TestCaseError> {
    let tape = tape(text);
    let columns: [Vec<f64>; 3] = std::array::from_fn(|axis| points.iter().map(|point| point[axis]).collect());
    let inputs: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let single: Vec<f64> = points.iter().map(|point| tape.value(point)).collect();
    let mut slopes: [Vec<f64>; 3] = Default::default();
    for (point, value) in points.iter().zip(&single) {
        let mut gradient = [0.0; 3];
        let again = tape.gradient(point, &mut gradient);
        prop_assert_eq!(again.to_bits(), value.to_bits());
        for (list, slope) in slopes.iter_mut().zip(gradient) {
            list.push(slope);
        }
    }
    for level in Level::ALL {
        let mut evaluator = tape.evaluator_at(level);
        let mut values = vec![7.0; points.len()];
        evaluator.evaluate(&inputs, &mut values);
        prop_assert_eq!(bits(&values), bits(&single), "{} {:?}", text, level);
        let mut lists = [vec![7.0; points.len()], vec![7.0; points.len()], vec![7.0; points.len()]];
        let mut parts: Vec<&mut [f64]> = lists.iter_mut().map(Vec::as_mut_slice).collect();
        values.fill(7.0);
        evaluator.gradients(&inputs, &mut values, &mut parts);
        prop_assert_eq!(bits(&values), bits(&single), "{} {:?}", text, level);
        for (list, slopes) in lists.iter().zip(&slopes) {
            prop_assert_eq!(bits(list), bits(slopes), "{} {:?}", text, level);
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(crate::samples::cases(400))]

    #[test]
    fn many_points_have_the_values_of_single_ones(
        text in formula(),
        points in prop::collection::vec([coordinate(), coordinate(), coordinate()], 1..40),
    ) {
        agree(&text, &points)?;
    }

    #[test]
    fn simplified_tapes_agree_inside_their_box(
        text in formula(),
        low in [coordinate(), coordinate(), coordinate()],
        width in [0.0..2.0, 0.0..2.0, 0.0..2.0],
        inside in prop::collection::vec([0.0..=1.0, 0.0..=1.0, 0.0..=1.0], 12),
    ) {
        prop_assume!(low.iter().all(|low| low.is_finite()));
        let tape = tape(&text);
        let sides: [Interval; 3] = std::array::from_fn(|axis| Interval::new(low[axis], low[axis] + width[axis]));
        let traced = tape.trace(&sides);
        let shorter = tape.simplify(&traced.choices);
        prop_assert!(shorter.operations() <= tape.operations());
        prop_assert_eq!(traced.value, tape.interval(&sides));
        for part in inside {
            let point: [f64; 3] = std::array::from_fn(|axis: usize| {
                f64::clamp(sides[axis].low + part[axis] * width[axis], sides[axis].low, sides[axis].high)
            });
            prop_assert_eq!(shorter.value(&point).to_bits(), tape.value(&point).to_bits(), "{}", text);
        }
        // A second look decides no less.
        let again = shorter.trace(&sides);
        prop_assert!(shorter.simplify(&again.choices).operations() <= shorter.operations());
    }
}

#[test]
fn blocks_of_every_length_are_whole() {
    for count in [0_usize, 1, 7, 8, 9, 127, 128, 129, 300] {
        let points: Vec<[f64; 3]> =
            (0..count).map(|i| [0.1 * i as f64 - 3.0, 0.5, -0.25 * i as f64]).collect();
        agree("min(x^2 + sin(y*z), x^5/(z - 1), noise(x, y, z)) + if(x > z, x, y)^3", &points).unwrap();
    }
}

#[test]
fn every_function_agrees_in_bulk() {
    let points: Vec<[f64; 3]> = (0..60).map(|i| [0.17 * f64::from(i) - 5.0, 0.3, 0.7]).collect();
    for name in crate::samples::ONE {
        agree(&format!("{name}(x)"), &points).unwrap();
    }
    for exponent in -70..70 {
        agree(&format!("x^{exponent}"), &points).unwrap();
    }
}

#[test]
fn decided_sides_are_left_out() {
    let tape = tape("min((x - 10)^2 + y^2 - 1, (x + 10)^2 + y^2 - 1, z + 100)");
    let near_ten = [Interval::new(8.0, 12.0), Interval::new(-2.0, 2.0), Interval::new(-1.0, 1.0)];
    let traced = tape.trace(&near_ten);
    assert_eq!(traced.choices.decided(), 2);
    let shorter = tape.simplify(&traced.choices);
    assert_eq!(shorter.operations(), 5);
    assert_eq!(shorter.value(&[10.0, 0.0, 0.0]), -1.0);
    let choice = self::tape("if(x > 0, sin(x), cos(y)*cos(z))");
    let right = [Interval::new(1.0, 2.0), Interval::WHOLE, Interval::WHOLE];
    assert_eq!(choice.simplify(&choice.trace(&right).choices).operations(), 1);
}

#[test]
fn registers_are_used_again() {
    let terms: Vec<String> = (1..200).map(|i| format!("sin({i}*x)")).collect();
    let tape = tape(&terms.join(" + "));
    assert_eq!(tape.operations(), 198 + 199 + 198);
    // Three inputs, 198 constants, and what a sum needs at once.
    assert!(tape.registers() <= 3 + 198 + 3, "{}", tape.registers());
    let point = [0.3, 0.0, 0.0];
    let exact: f64 = (1..200).map(|i| libm::sin(f64::from(i) * 0.3)).sum();
    assert!((tape.value(&point) - exact).abs() < 1e-12);
}

#[test]
fn several_outputs_share_their_steps() {
    let [sum, square] = ["x + y", "(x + y)^2"].map(|text| parse(text, &VARIABLES).unwrap());
    let tape = Tape::of_many(&[&sum, &square], &VARIABLES).unwrap();
    assert_eq!((tape.outputs(), tape.operations()), (2, 2));
    let mut values = [0.0; 2];
    tape.values(&[1.0, 2.0, 0.0], &mut values);
    assert_eq!(values, [3.0, 9.0]);
    let (mut sums, mut squares) = ([0.0; 2], [0.0; 2]);
    tape.evaluator().evaluate_many(&[&[1.0, 2.0], &[2.0, 2.0], &[0.0; 2]], &mut [&mut sums, &mut squares]);
    assert_eq!((sums, squares), ([3.0, 4.0], [9.0, 16.0]));
    let mut ranges = [Interval::UNKNOWN; 2];
    tape.intervals(&[Interval::new(0.0, 1.0); 3], &mut ranges);
    assert!(ranges[0].contains(2.0) && ranges[1].contains(4.0) && ranges[1].low == 0.0);
}

#[test]
fn missing_inputs_are_named() {
    let product = parse("x*w", &["x", "w"]).unwrap();
    let error = Tape::new(&product, &VARIABLES).unwrap_err();
    assert_eq!(error, TapeError::MissingInput { name: "w".into(), inputs: "x, y, z".into() });
    assert_eq!(Tape::of_many(&[], &VARIABLES).unwrap_err(), TapeError::NoOutput);
    // Inputs that are not used are allowed, as are results that are inputs or constants.
    for text in ["y", "3"] {
        assert_eq!(tape(text).value(&[1.0, 3.0, 2.0]), 3.0);
        agree(text, &[[1.0, 3.0, 2.0]; 20]).unwrap();
    }
    assert_eq!(Tape::new(&Expression::constant(2.0), &[]).unwrap().value(&[]), 2.0);
}

#[test]
fn thirty_two_variables_are_no_trouble() {
    let names: Vec<String> = (0..32).map(|i| format!("u{i}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let tape = Tape::new(&parse(&names.join("*"), &names).unwrap(), &names).unwrap();
    assert_eq!(tape.value(&[2.0; 32]), 4_294_967_296.0);
    let mut gradient = [0.0; 32];
    tape.gradient(&[2.0; 32], &mut gradient);
    assert_eq!(gradient, [2_147_483_648.0; 32]);
}
