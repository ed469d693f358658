//! Derivatives against exact ones and against differences.

use crate::samples::{VARIABLES, tape};
use luch_formula::{Tape, parse};

/// Functions of x and their derivatives, and a range in which both are defined.
const EXACT: [(&str, &str, [f64; 2]); 47] = [
    ("3", "0", [-2.0, 2.0]),
    ("x", "1", [-2.0, 2.0]),
    ("-x", "-1", [-2.0, 2.0]),
    ("x + 2x", "3", [-2.0, 2.0]),
    ("x*x*x", "3x^2", [-2.0, 2.0]),
    ("x^7", "7x^6", [-2.0, 2.0]),
    ("x^-3", "-3*x^-4", [0.5, 2.0]),
    ("x^2.5", "2.5*x^1.5", [0.1, 2.0]),
    ("x^x", "x^x*(ln(x) + 1)", [0.1, 2.0]),
    ("2^x", "2^x*ln(2)", [-2.0, 2.0]),
    ("1/x", "-1/x^2", [0.1, 2.0]),
    ("(x + 1)/(x - 3)", "-4/(x - 3)^2", [-2.0, 2.0]),
    ("abs(x)", "sign(x)", [-2.0, 2.0]),
    ("sqrt(x)", "0.5/sqrt(x)", [0.1, 2.0]),
    ("cbrt(x)", "1/(3*cbrt(x)^2)", [-2.0, -0.1]),
    ("exp(3x)", "3exp(3x)", [-2.0, 2.0]),
    ("ln(x)", "1/x", [0.1, 2.0]),
    ("log2(x)", "1/(x*ln(2))", [0.1, 2.0]),
    ("log10(x)", "1/(x*ln(10))", [0.1, 2.0]),
    ("sin(x^2)", "2x*cos(x^2)", [-2.0, 2.0]),
    ("cos(x)", "-sin(x)", [-2.0, 2.0]),
    ("tan(x)", "1/cos(x)^2", [-1.5, 1.5]),
    ("asin(x)", "1/sqrt(1 - x^2)", [-0.9, 0.9]),
    ("acos(x)", "-1/sqrt(1 - x^2)", [-0.9, 0.9]),
    ("atan(x)", "1/(1 + x^2)", [-2.0, 2.0]),
    ("sinh(x)", "cosh(x)", [-2.0, 2.0]),
    ("cosh(x)", "sinh(x)", [-2.0, 2.0]),
    ("tanh(x)", "1/cosh(x)^2", [-2.0, 2.0]),
    ("asinh(x)", "1/sqrt(1 + x^2)", [-2.0, 2.0]),
    ("acosh(x)", "1/sqrt(x^2 - 1)", [1.1, 3.0]),
    ("atanh(x)", "1/(1 - x^2)", [-0.9, 0.9]),
    ("erf(x)", "2/sqrt(pi)*exp(-x^2)", [-2.0, 2.0]),
    ("normal(x)", "-x*normal(x)", [-2.0, 2.0]),
    ("normal(x, 1, 2)", "(1 - x)/4*normal(x, 1, 2)", [-2.0, 2.0]),
    // ψ(x + 1) − ψ(x) = 1/x.
    ("lgamma(x + 1) - lgamma(x)", "1/x", [0.1, 5.0]),
    ("gamma(x + 1)/gamma(x)", "1", [0.1, 5.0]),
    ("floor(x) + ceil(x) + round(x) + sign(x)", "0", [-2.0, 2.0]),
    ("mod(x, 0.7)", "1", [-2.0, 2.0]),
    ("mod(5, x)", "-floor(5/x)", [0.3, 2.0]),
    ("atan2(x, 2)", "2/(x^2 + 4)", [-2.0, 2.0]),
    ("atan2(2, x)", "-2/(x^2 + 4)", [-2.0, 2.0]),
    ("min(x, x^2)", "if(x < x^2, 1, 2x)", [-2.0, 2.0]),
    ("max(x, x^2)", "if(x > x^2, 1, 2x)", [-2.0, 2.0]),
    ("if(x < 1, x^2, 3x)", "if(x < 1, 2x, 3)", [-2.0, 2.0]),
    ("hypot(x, 2)", "x/hypot(x, 2)", [-2.0, 2.0]),
    ("smoothstep(-1, 1, x)", "t = clamp((x + 1)/2, 0, 1); 3t*(1 - t)", [-2.0, 2.0]),
    ("clamp(x, -1, 1)", "-1 < x and x < 1", [-2.0, 2.0]),
];

#[test]
fn derivatives_are_the_exact_ones() {
    for (text, derivative, [low, high]) in EXACT {
        let (tape, exact) = (tape(text), tape(derivative));
        for i in 0..200 {
            // An odd step, so that kinks and jumps are not met.
            let x = low + (high - low) * (f64::from(i) + 0.337) / 200.0;
            let mut gradient = [0.0; 3];
            tape.gradient(&[x, 0.0, 0.0], &mut gradient);
            let exact = exact.value(&[x, 0.0, 0.0]);
            // Cancellation in differences of ψ costs three digits at most.
            let bound = 1e-12 * (1.0 + exact.abs());
            assert!((gradient[0] - exact).abs() < bound, "{text} at {x}: {} and {exact}", gradient[0]);
            assert_eq!(gradient[1..], [0.0, 0.0]);
        }
    }
}

#[test]
fn derivatives_agree_with_central_differences() {
    let texts = [
        "(x^2+9/4*y^2+z^2-1)^3 - x^2*z^3 - 9/80*y^2*z^3",
        "sin(x*y) + cos(y/(z^2 + 1))*exp(-x^2)",
        "noise(3x, 2y, z)",
        "fbm(x, y, z, 4)",
        "atan2(y, x + 3) * hypot(x, y, z)",
        "r = hypot(x, y); (r - 2)^2 + z^2 - 0.25",
        "ln(x^2 + y^2 + 1)^3 + (x^2 + 1)^(y + 0.5)",
        "tanh(x) * asinh(y) / (2 + erf(z))",
    ];
    // Error of (f(x + h) − f(x − h)) / 2h: rounding 2ε|f|/h, cut-off h²/6 · |f‴|; here |f| and |f‴| are below 10⁴.
    let step = 1e-5;
    let bound = 4.0 * f64::EPSILON * 1e4 / step + step * step / 6.0 * 1e4;
    for text in texts {
        let tape = tape(text);
        for i in 0..100 {
            let point = [0.819, 0.671, 0.549].map(|ratio| 2.0 * (f64::from(i) * ratio).fract() - 1.0);
            let mut gradient = [0.0; 3];
            tape.gradient(&point, &mut gradient);
            for axis in 0..3 {
                let at = |moved: f64| {
                    let mut point = point;
                    point[axis] += moved;
                    tape.value(&point)
                };
                let difference = (at(step) - at(-step)) / (2.0 * step);
                assert!((gradient[axis] - difference).abs() < bound, "{text} at {point:?} along {axis}");
            }
        }
    }
}

#[test]
fn only_the_asked_inputs_are_derived() {
    let product = Tape::new(&parse("x*y*z", &VARIABLES).unwrap(), &VARIABLES).unwrap();
    let mut by_x = [0.0];
    assert_eq!(product.gradient(&[2.0, 3.0, 4.0], &mut by_x), 24.0);
    assert_eq!(by_x, [12.0]);
    assert_eq!(product.gradient(&[2.0, 3.0, 4.0], &mut []), 24.0);
}

#[test]
fn infinite_slopes_do_not_reach_numbers_that_stand_still() {
    // √x is vertical at zero; y does not care.
    let tape = tape("sqrt(x) + y^2");
    let mut gradient = [0.0; 3];
    tape.gradient(&[0.0, 3.0, 0.0], &mut gradient);
    assert_eq!(gradient, [f64::INFINITY, 6.0, 0.0]);
}
