//! Random formulas, and places to try them at.

use luch_formula::{Tape, parse};
use proptest::prelude::*;

pub(crate) const VARIABLES: [&str; 3] = ["x", "y", "z"];

/// Functions of one number.
pub(crate) const ONE: [&str; 29] = [
    "abs", "sign", "floor", "ceil", "round", "sqrt", "cbrt", "exp", "ln", "log2", "log10", "sin", "cos",
    "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "asinh", "acosh", "atanh", "gamma", "lgamma",
    "erf", "normal", "not", "-",
];

/// Functions of two numbers.
const TWO: [&str; 9] = ["min", "max", "mod", "atan2", "pow", "hypot", "step", "log", "noise"];

/// Operators.
const BETWEEN: [&str; 12] = ["+", "-", "*", "/", "<", "<=", ">", ">=", "==", "!=", "and", "or"];

/// Random formulas of x, y and z.
pub(crate) fn formula() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        4 => prop::sample::select(&VARIABLES[..]).prop_map(str::to_owned),
        1 => prop::sample::select(&["0", "1", "2", "0.5", "pi", "e", "10", "1e-3", "inf", "nan"][..]).prop_map(str::to_owned),
        1 => (-50_i32..50).prop_map(|tenths| format!("({})", f64::from(tenths) / 10.0)),
    ];
    leaf.prop_recursive(5, 24, 3, |inner| {
        prop_oneof![
            4 => (prop::sample::select(&BETWEEN[..]), inner.clone(), inner.clone())
                .prop_map(|(operator, a, b)| format!("({a} {operator} {b})")),
            3 => (prop::sample::select(&ONE[..]), inner.clone()).prop_map(|(name, a)| format!("({name} ({a}))")),
            2 => (prop::sample::select(&TWO[..]), inner.clone(), inner.clone())
                .prop_map(|(name, a, b)| format!("{name}({a}, {b})")),
            1 => (inner.clone(), -4_i32..9).prop_map(|(a, exponent)| format!("({a})^{exponent}")),
            1 => (inner.clone(), inner.clone(), inner.clone())
                .prop_map(|(a, b, c)| format!("if({a}, {b}, {c})")),
            1 => (inner.clone(), inner.clone(), inner.clone())
                .prop_map(|(a, b, c)| format!("min({a}, {b}, {c})")),
            1 => (inner.clone(), inner.clone(), inner)
                .prop_map(|(a, b, c)| format!("noise({a}, {b}, {c})")),
        ]
    })
}

pub(crate) fn tape(text: &str) -> Tape {
    let expression = parse(text, &VARIABLES).unwrap_or_else(|error| panic!("{error}"));
    Tape::new(&expression, &VARIABLES).expect("all variables are inputs")
}

/// Coordinates of all sizes, whole ones and odd ones among them.
pub(crate) fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -3.0..3.0,
        2 => (-6_i32..7).prop_map(|halves| f64::from(halves) / 2.0),
        1 => -300.0..300.0,
        1 => prop::sample::select(&[0.0, -0.0, 1e-300, -1e-9, 1e9, -1e200, 1e17, f64::INFINITY, f64::NEG_INFINITY, f64::NAN][..]),
    ]
}

/// The bits of a number; all that are none are one.
pub(crate) fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

/// So many cases, other ones each time; failures are shown and not stored.
pub(crate) fn cases(count: u32) -> ProptestConfig {
    ProptestConfig { cases: count, failure_persistence: None, ..ProptestConfig::default() }
}
