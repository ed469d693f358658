//! What the signs mean.

use luch_formula::{Formula, constants, functions, parse, parse_equation};

fn value(text: &str) -> f64 {
    let expression = parse(text, &[]).unwrap_or_else(|error| panic!("{error}"));
    expression.as_constant().unwrap_or_else(|| panic!("{text} depends on nothing"))
}

#[test]
fn precedence_is_that_of_the_table() {
    // Each line: a text, and the same with all parentheses.
    let table = [
        ("1 + 2 * 3", "1 + (2 * 3)"),
        ("10 - 4 - 3", "(10 - 4) - 3"),
        ("100 / 5 / 2", "(100 / 5) / 2"),
        ("100 / 5 * 2", "(100 / 5) * 2"),
        ("2^3^2", "2^(3^2)"),
        ("-3^2", "-(3^2)"),
        ("(-3)^2", "9"),
        ("2^-2", "1/4"),
        ("2^-2^2", "2^(-(2^2))"),
        ("--3", "3"),
        ("-+-3", "3"),
        ("2*-3", "2*(-3)"),
        ("2 - -3", "5"),
        ("-2*-3", "6"),
        ("2^0.5", "sqrt(2)"),
        ("1 + 2 < 4 - 0", "(1 + 2) < (4 - 0)"),
        ("1 < 2 and 2 < 3", "1"),
        ("0 and 1 or 1", "(0 and 1) or 1"),
        ("1 or 1 and 0", "1 or (1 and 0)"),
        ("not 1 or 1", "(not 1) or 1"),
        ("not 0 and 0", "(not 0) and 0"),
        ("not not 3", "1"),
        ("not 1 < 2", "not (1 < 2)"),
        ("not 1 == 0", "not (1 == 0)"),
        ("1 and not 0", "1"),
        ("3 >= 3", "1"),
        ("3 > 3", "0"),
        ("3 != 3", "0"),
        ("nan == nan", "0"),
        ("nan != nan", "1"),
        ("not nan", "1"),
        ("if(nan, 1, 2)", "2"),
        ("if(-0.1, 1, 2)", "1"),
        ("2(3)", "6"),
        ("2(1 + 2)^2", "18"),
        ("2pi", "2*pi"),
        ("-2pi", "-(2*pi)"),
        ("2e", "2*e"),
        ("2e3", "2000"),
        ("2exp(0)", "2"),
        ("2E-1", "0.2"),
        ("7 - 2(3)", "1"),
        ("3 * 2(4)", "24"),
        (".5 + 1.", "1.5"),
        ("2 × 3 · 4 − 1", "23"),
        ("1 ≤ 2 and 2 ≥ 2 and 1 ≠ 2", "1"),
        ("a = 2; b = a^3; b - a", "6"),
        ("r=3;r", "3"),
        ("e = 5; e", "5"),
        ("min(4)", "4"),
        ("min(4, 2, 7, 3)", "2"),
        ("max(4, 2, 7, 3)", "7"),
        ("max(nan, 1)", "1"),
        ("clamp(5, 0, 1)", "1"),
        ("mix(2, 4, 0.25)", "2.5"),
        ("step(1, 1) + step(1, 0.9)", "1"),
        ("smoothstep(0, 2, 1)", "0.5"),
        ("mod(-1, 3)", "2"),
        ("mod(1, -3)", "-2"),
        ("mod(5.5, 2)", "1.5"),
        ("round(2.5) + round(-2.5)", "0"),
        ("round(0.49999999999999994)", "0"),
        ("sign(-3) + sign(0) + sign(2)", "0"),
        ("hypot(3, 4)", "5"),
        ("length(2, 3, 6)", "7"),
        ("gamma(6)", "120"),
        ("log(8, 2)", "ln(8)/ln(2)"),
        ("log(5)", "ln(5)"),
        ("pow(2, 10)", "1024"),
        ("cbrt(-27)", "-3"),
        ("tau - 2 pi", "0"),
        ("0^0", "1"),
        ("x1 = 2; 3x1", "6"),
    ];
    for (text, expected) in table {
        assert_eq!(value(text).to_bits(), value(expected).to_bits(), "{text}: {}", value(text));
    }
}

#[test]
fn the_heart_of_the_lecture_reads_as_typed() {
    let variables = ["x", "y", "z"];
    let heart = parse("(x^2+9/4*y^2+z^2-1)^3 - x^2*z^3 - 9/80*y^2*z^3", &variables).unwrap();
    let tape = luch_formula::Tape::new(&heart, &variables).unwrap();
    for i in 0..1000 {
        let [x, y, z] = [0.819, 0.671, 0.549].map(|step| 3.0 * (f64::from(i) * step).fract() - 1.5);
        let body = x * x + 2.25 * (y * y) + z * z - 1.0;
        let exact = body * body * body - x * x * (z * z * z) - 0.1125 * (y * y) * (z * z * z);
        // A dozen roundings of terms no larger than the sum of their sizes.
        let size = (x * x + 2.25 * y * y + z * z + 1.0).abs();
        let bound = 16.0 * f64::EPSILON * (size * size * size + 20.0);
        assert!((tape.value(&[x, y, z]) - exact).abs() <= bound);
    }
}

#[test]
fn parameters_are_values_and_definitions_stay_local() {
    let torus =
        Formula::new("r = hypot(x, y); (r - major)^2 + z^2 = minor^2").with("major", 2.0).with("minor", 0.5);
    let solid = torus.parse_equation(&["x", "y", "z"]).unwrap();
    let tape = luch_formula::Tape::new(&solid, &["x", "y", "z"]).unwrap();
    assert_eq!(tape.value(&[2.0, 0.0, 0.0]), -0.25);
    assert_eq!(tape.value(&[2.5, 0.0, 0.0]), 0.0);
    assert_eq!(
        torus.clone().with("minor", 1.0).parse_equation(&["x", "y", "z"]).unwrap().variables(),
        ["x", "y", "z"]
    );

    let text = serde_json::to_string(&torus).unwrap();
    assert_eq!(serde_json::from_str::<Formula>(&text).unwrap(), torus);
    assert_eq!(serde_json::from_str::<Formula>(r#"{"text":"x"}"#).unwrap(), Formula::new("x"));
}

#[test]
fn an_equation_is_the_difference_of_its_sides() {
    let sides = parse_equation("x^2 = y + 1", &["x", "y"]).unwrap();
    assert_eq!(sides, parse("x^2 - (y + 1)", &["x", "y"]).unwrap());
    assert_eq!(parse_equation("x^2", &["x"]).unwrap(), parse("x^2", &["x"]).unwrap());
    // The last part is the equation, even if it looks like a definition.
    assert_eq!(parse_equation("a = 2; x = a", &["x"]).unwrap(), parse("x - 2", &["x"]).unwrap());
}

#[test]
fn names_of_the_caller_come_before_constants_and_functions() {
    let variables = ["e", "gamma", "if"];
    let sum = parse("e + gamma + if", &variables).unwrap();
    let tape = luch_formula::Tape::new(&sum, &variables).unwrap();
    assert_eq!(tape.value(&[1.0, 10.0, 100.0]), 111.0);
}

#[test]
fn every_function_and_constant_has_a_description() {
    assert!(functions().len() > 40);
    for function in functions() {
        assert!(function.usage.starts_with(&format!("{}(", function.name)), "{}", function.usage);
        assert!(!function.meaning.is_empty());
        // With the arguments as described, the function is accepted: optional ones in brackets, and "…" for more.
        let arguments = function.usage[function.name.len() + 1..function.usage.len() - 1].replace(", …", "");
        let arguments = arguments.replace(" [", "").replace(']', "");
        let text = format!("{}({})", function.name, vec!["1"; arguments.split(',').count()].join(","));
        assert!(parse(&text, &[]).is_ok(), "{text}");
    }
    for constant in constants() {
        assert_eq!(value(constant.name).to_bits(), constant.value.to_bits());
    }
}
