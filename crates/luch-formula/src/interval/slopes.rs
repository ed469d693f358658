//! Ranges of derivatives.
//!
//! The formulas are those of the evaluators, so that computed derivatives lie inside. Where a function may jump the range is the
//! whole line.

use super::binary::{add, divide, multiply, square, whole_quotient};
use super::functions::{GAMMA_SLACK, cell, noise, noise_around, outward};
use super::{Interval, binary, unary, whole_power};
use crate::noise::{MOST_CURVED, STEEPEST, noise as noise_at};
use crate::operation::{Binary, Unary};
use crate::special::digamma;
use std::f64::consts::{FRAC_2_SQRT_PI, LOG2_E, LOG10_E};

const ONE: Interval = Interval { low: 1.0, high: 1.0, partial: false };

fn negate(x: Interval) -> Interval {
    Interval { low: -x.high, high: -x.low, partial: x.partial }
}

fn subtract(a: Interval, b: Interval) -> Interval {
    add(a, negate(b))
}

/// No slope if the function is constant here, else any.
fn unless(constant: bool) -> Interval {
    if constant { Interval::ZERO } else { Interval::WHOLE }
}

/// The range of the derivative of a function of one number, from those of its argument and its value.
pub(crate) fn unary_slope(function: Unary, x: Interval, value: Interval) -> Interval {
    let one_less_square = || multiply(subtract(ONE, x), add(ONE, x));
    let root = |x: Interval| unary(Unary::SquareRoot, x);
    match function {
        Unary::Negate => Interval::point(-1.0),
        Unary::Absolute if x.low > 0.0 => ONE,
        Unary::Absolute if x.high < 0.0 => Interval::point(-1.0),
        Unary::Absolute => Interval::new(-1.0, 1.0),
        Unary::Sign => unless(!x.contains_zero()),
        Unary::Not | Unary::Floor | Unary::Ceil | Unary::Round => unless(value.low == value.high),
        Unary::SquareRoot => divide(Interval::point(0.5), value),
        Unary::CubeRoot => divide(ONE, multiply(Interval::point(3.0), square(value))),
        Unary::Exp => value,
        Unary::Ln => divide(ONE, x),
        Unary::Log2 => divide(Interval::point(LOG2_E), x),
        Unary::Log10 => divide(Interval::point(LOG10_E), x),
        Unary::Sin => unary(Unary::Cos, x),
        Unary::Cos => negate(unary(Unary::Sin, x)),
        // A range without ends has a pole in it.
        Unary::Tan if !value.is_bounded() => Interval::WHOLE,
        Unary::Tan => add(ONE, square(value)),
        Unary::Asin => divide(ONE, root(one_less_square())),
        Unary::Acos => negate(divide(ONE, root(one_less_square()))),
        Unary::Atan => divide(ONE, add(ONE, square(x))),
        Unary::Sinh => unary(Unary::Cosh, x),
        Unary::Cosh => unary(Unary::Sinh, x),
        Unary::Tanh => subtract(ONE, square(value)),
        Unary::Asinh => divide(ONE, root(add(ONE, square(x)))),
        Unary::Acosh => divide(ONE, root(multiply(subtract(x, ONE), add(ONE, x)))),
        Unary::Atanh => divide(ONE, one_less_square()),
        Unary::Gamma | Unary::LnGamma if x.low <= 0.0 => Interval::WHOLE,
        Unary::Gamma => multiply(value, digamma_range(x)),
        Unary::LnGamma => digamma_range(x),
        Unary::ErrorFunction => {
            multiply(Interval::point(FRAC_2_SQRT_PI), unary(Unary::Exp, negate(square(x))))
        }
    }
}

/// ψ rises from −∞ at zero.
fn digamma_range(x: Interval) -> Interval {
    let ends = Interval { low: digamma(x.low), high: digamma(x.high), partial: false };
    let range = outward(ends, GAMMA_SLACK);
    Interval { low: range.low - GAMMA_SLACK, high: range.high + GAMMA_SLACK, partial: false }
}

/// The ranges of the partial derivatives of a function of two numbers; least and greatest are not among them.
pub(crate) fn binary_slopes(function: Binary, a: Interval, b: Interval, value: Interval) -> [Interval; 2] {
    match function {
        Binary::Add | Binary::Minimum | Binary::Maximum => [ONE, ONE],
        Binary::Subtract => [ONE, Interval::point(-1.0)],
        Binary::Multiply => [b, a],
        Binary::Divide => [divide(ONE, b), negate(divide(value, b))],
        Binary::Power => {
            let less = subtract(b, ONE);
            let first = binary(Binary::Multiply, b, binary(Binary::Power, a, less, false), false);
            let second = if a.low > 0.0 {
                binary(Binary::Multiply, value, unary(Unary::Ln, a), false)
            } else {
                Interval::WHOLE
            };
            [first, second]
        }
        Binary::Modulo => match whole_quotient(a, b) {
            Some(turns) => [ONE, Interval::point(-turns)],
            None => [Interval::WHOLE; 2],
        },
        Binary::Angle if a.contains_zero() && b.low <= 0.0 => [Interval::WHOLE; 2],
        Binary::Angle => {
            let squares = add(square(a), square(b));
            [divide(b, squares), negate(divide(a, squares))]
        }
        Binary::Less | Binary::LessOrEqual | Binary::Equal | Binary::NotEqual | Binary::And | Binary::Or => {
            [unless(value.low == value.high); 2]
        }
    }
}

/// The range of the derivative of a power with a whole exponent of at least 2.
pub(crate) fn whole_power_slope(base: Interval, exponent: u8) -> Interval {
    let less = if exponent == 2 { base } else { whole_power(base, exponent - 1) };
    multiply(Interval::point(f64::from(exponent)), less)
}

/// The ranges of noise and of its three partial derivatives.
pub(crate) fn noise_with_slopes(place: [Interval; 3]) -> NoiseRange {
    let most = Interval { low: -STEEPEST, high: STEEPEST, partial: false };
    let Some(cell) = cell(place) else {
        return NoiseRange { value: noise(place), slopes: [Interval::UNKNOWN; 3] };
    };
    if place.iter().any(Interval::is_empty) {
        return NoiseRange { value: Interval::EMPTY, slopes: [Interval::UNKNOWN; 3] };
    }
    let [x, y, z] = cell.middle;
    let middle = noise_at(x, y, z);
    let reach = MOST_CURVED * cell.reach + 1e-12;
    let slopes = middle.gradient.map(|slope| {
        Interval { low: slope - reach, high: slope + reach, partial: false }.intersection(&most)
    });
    let partial = place.iter().any(|range| range.partial);
    NoiseRange { value: noise_around(&middle, &cell).partial_if(partial), slopes }
}

/// Ranges of noise and of its partial derivatives.
pub(crate) struct NoiseRange {
    pub(crate) value: Interval,
    pub(crate) slopes: [Interval; 3],
}

/// A slope times a derivative; nothing times anything is nothing.
pub(crate) fn chain(slope: Interval, derivative: Interval) -> Interval {
    if slope == Interval::ZERO || derivative == Interval::ZERO {
        return Interval::ZERO;
    }
    binary(Binary::Multiply, slope, derivative, false)
}
