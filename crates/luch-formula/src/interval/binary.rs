//! Ranges of functions of two numbers.

use super::Interval;
use super::functions::{SLACK, down, outward, quick, up};
use crate::operation::Binary;

/// The range of a function over two ranges.
pub(crate) fn binary(function: Binary, a: Interval, b: Interval, same: bool) -> Interval {
    let partial = a.partial | b.partial;
    match function {
        // These give the defined operand where the other is undefined.
        Binary::Minimum => return minimum(a, b),
        Binary::Maximum => return maximum(a, b),
        // These are defined everywhere.
        Binary::Less => return compare(a, b, a.high < b.low, a.low >= b.high),
        Binary::LessOrEqual => return compare(a, b, a.high <= b.low, a.low > b.high),
        Binary::Equal | Binary::NotEqual => {
            let single = a.low == a.high && b.low == b.high && a.low == b.low;
            let apart = a.high < b.low || b.high < a.low;
            let equal = compare(a, b, single, apart);
            if function == Binary::Equal {
                return equal;
            }
            return Interval { low: 1.0 - equal.high, high: 1.0 - equal.low, partial: false };
        }
        Binary::And => {
            return Interval::claim(match (a.truth(), b.truth()) {
                (Some(true), Some(true)) => Some(true),
                (Some(false), _) | (_, Some(false)) => Some(false),
                _ => None,
            });
        }
        Binary::Or => {
            return Interval::claim(match (a.truth(), b.truth()) {
                (Some(false), Some(false)) => Some(false),
                (Some(true), _) | (_, Some(true)) => Some(true),
                _ => None,
            });
        }
        _ => {}
    }
    if a.is_empty() || b.is_empty() {
        return if function == Binary::Power { Interval::UNKNOWN } else { Interval::EMPTY };
    }
    let result = match function {
        Binary::Add => add(a, b),
        Binary::Subtract => add(a, Interval { low: -b.high, high: -b.low, partial: false }),
        Binary::Multiply if same => square(a),
        Binary::Multiply => multiply(a, b),
        Binary::Divide => divide(a, b),
        Binary::Power => power(a, b),
        Binary::Modulo => modulo(a, b),
        _ => angle(a, b),
    };
    result.partial_if(partial)
}

fn compare(a: Interval, b: Interval, surely: bool, never: bool) -> Interval {
    // Nothing undefined compares; and then it is unequal, less than nothing.
    let defined = !a.partial && !b.partial;
    Interval::claim(if a.is_empty() || b.is_empty() || never {
        Some(false)
    } else if surely && defined {
        Some(true)
    } else {
        None
    })
}

fn minimum(a: Interval, b: Interval) -> Interval {
    let both = Interval {
        low: if a.low < b.low { a.low } else { b.low },
        high: if a.high < b.high { a.high } else { b.high },
        partial: a.partial & b.partial,
    };
    with_gaps(both, a, b)
}

fn maximum(a: Interval, b: Interval) -> Interval {
    let both = Interval {
        low: if a.low > b.low { a.low } else { b.low },
        high: if a.high > b.high { a.high } else { b.high },
        partial: a.partial & b.partial,
    };
    with_gaps(both, a, b)
}

/// Where one operand is undefined the other one counts alone.
fn with_gaps(both: Interval, a: Interval, b: Interval) -> Interval {
    let partial = both.partial;
    let mut result = if a.is_empty() || b.is_empty() { Interval::EMPTY } else { both };
    if a.partial {
        result = result.hull(&b);
    }
    if b.partial {
        result = result.hull(&a);
    }
    Interval { partial, ..result }
}

pub(super) fn add(a: Interval, b: Interval) -> Interval {
    // ∞ − ∞ is undefined.
    let partial = (a.high == f64::INFINITY && b.low == f64::NEG_INFINITY)
        || (a.low == f64::NEG_INFINITY && b.high == f64::INFINITY);
    let (mut low, mut high) = (a.low + b.low, a.high + b.high);
    if partial {
        // Opposite infinities may meet at one end.
        low = if low.is_nan() { f64::NEG_INFINITY } else { low };
        high = if high.is_nan() { f64::INFINITY } else { high };
    }
    Interval {
        // A sum that is zero is exact, and so is one with zero.
        low: if low == 0.0 || a.low == 0.0 || b.low == 0.0 { low } else { down(low) },
        high: if high == 0.0 || a.high == 0.0 || b.high == 0.0 { high } else { up(high) },
        partial,
    }
}

/// A product of ends, zero if one of them is.
fn product(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { 0.0 } else { a * b }
}

pub(super) fn multiply(a: Interval, b: Interval) -> Interval {
    // Nearly always all is finite, and no end is zero. A product that is not a number fails the test.
    let [ll, lh, hl, hh] = [a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high];
    let finite = (ll.abs() + lh.abs()) + (hl.abs() + hh.abs()) <= f64::MAX;
    if finite && ll != 0.0 && lh != 0.0 && hl != 0.0 && hh != 0.0 {
        let least = |a: f64, b: f64| if a < b { a } else { b };
        let greatest = |a: f64, b: f64| if a > b { a } else { b };
        return Interval {
            low: down(least(least(ll, lh), least(hl, hh))),
            high: up(greatest(greatest(ll, lh), greatest(hl, hh))),
            partial: false,
        };
    }
    multiply_any(a, b)
}

fn multiply_any(a: Interval, b: Interval) -> Interval {
    let infinite = |range: &Interval| range.low == f64::NEG_INFINITY || range.high == f64::INFINITY;
    let partial = (a.contains_zero() && infinite(&b)) || (b.contains_zero() && infinite(&a));
    let products =
        [product(a.low, b.low), product(a.low, b.high), product(a.high, b.low), product(a.high, b.high)];
    let (mut low, mut high) = (products[0], products[0]);
    for product in &products[1..] {
        low = if *product < low { *product } else { low };
        high = if *product > high { *product } else { high };
    }
    // Zero is exact, unless numbers that are not zero have a product too small to be seen.
    let exact = |end: f64| end == 0.0 && !vanishes(a, b);
    Interval {
        low: if exact(low) { low } else { down(low) },
        high: if exact(high) { high } else { up(high) },
        partial,
    }
}

/// Whether some product of ends is zero though none of them is.
fn vanishes(a: Interval, b: Interval) -> bool {
    let small = |x: f64, y: f64| x != 0.0 && y != 0.0 && x * y == 0.0;
    small(a.low, b.low) || small(a.low, b.high) || small(a.high, b.low) || small(a.high, b.high)
}

pub(super) fn square(a: Interval) -> Interval {
    let (nearest, farthest) = magnitudes(a);
    Interval {
        low: down(nearest * nearest).max(0.0),
        high: if farthest == 0.0 { 0.0 } else { up(farthest * farthest) },
        partial: false,
    }
}

/// The least and the greatest size of its numbers.
pub(super) fn magnitudes(a: Interval) -> (f64, f64) {
    let (low, high) = (a.low.abs(), a.high.abs());
    let nearest = if a.contains_zero() { 0.0 } else { quick(low, high).low };
    (nearest, quick(low, high).high)
}

pub(super) fn divide(a: Interval, b: Interval) -> Interval {
    let infinite = |range: &Interval| range.low == f64::NEG_INFINITY || range.high == f64::INFINITY;
    if b.contains_zero() {
        return Interval::WHOLE.partial_if(a.contains_zero() || (infinite(&a) && infinite(&b)));
    }
    let partial = infinite(&a) && infinite(&b);
    let quotients = [a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high];
    let mut result = Interval { low: f64::INFINITY, high: f64::NEG_INFINITY, partial };
    for quotient in quotients {
        if quotient.is_nan() {
            // ∞ / ∞: anything of that sign.
            return Interval::WHOLE.partial_if(true);
        }
        result = result.hull(&Interval { low: quotient, high: quotient, partial });
    }
    Interval {
        low: if result.low == 0.0 && a.low == 0.0 && b.low > 0.0 { 0.0 } else { down(result.low) },
        high: if result.high == 0.0 && a.high == 0.0 && b.low > 0.0 { 0.0 } else { up(result.high) },
        partial,
    }
}

fn power(a: Interval, b: Interval) -> Interval {
    let whole = b.low == b.high && b.low == b.low.trunc();
    if a.low < 0.0 {
        // Negative numbers have whole powers only.
        if !(whole && b.low.abs() < 1e15) {
            return Interval::UNKNOWN;
        }
        if a.contains_zero() && b.low < 0.0 {
            return Interval::WHOLE;
        }
        let even = b.low % 2.0 == 0.0;
        let (nearest, farthest) = magnitudes(a);
        let corners = |x: f64, y: f64| quick(libm::pow(x, b.low), libm::pow(y, b.low));
        return if even {
            outward(corners(nearest, farthest), SLACK).within(0.0, f64::INFINITY)
        } else {
            outward(corners(a.low, a.high), SLACK)
        };
    }
    if a.low == 0.0 && b.low <= 0.0 {
        // 1 / (−0)³ is −∞.
        return Interval::WHOLE;
    }
    // For positive numbers the logarithm b ln a has its extremes in the corners.
    let mut result = Interval { low: f64::INFINITY, high: f64::NEG_INFINITY, partial: false };
    for corner in [
        libm::pow(a.low, b.low),
        libm::pow(a.low, b.high),
        libm::pow(a.high, b.low),
        libm::pow(a.high, b.high),
    ] {
        result = result.hull(&Interval { low: corner, high: corner, partial: false });
    }
    if a.high == f64::INFINITY || b.high == f64::INFINITY || b.low == f64::NEG_INFINITY {
        result = result.hull(&Interval::new(0.0, f64::INFINITY));
    }
    outward(result, SLACK).within(0.0, f64::INFINITY)
}

fn modulo(a: Interval, b: Interval) -> Interval {
    let finite = a.is_bounded() && b.is_bounded();
    if !finite {
        return Interval::UNKNOWN;
    }
    // The remainder lies between zero and the divisor; that sum is exact or rounds to the divisor.
    let around =
        Interval { low: quick(b.low, 0.0).low, high: quick(0.0, b.high).high, partial: b.contains_zero() };
    if b.low != b.high || b.low == 0.0 {
        return around;
    }
    let turn = whole_quotient(a, b);
    match turn {
        None => around,
        Some(turns) => {
            let back = -turns * b.low;
            let moved = add(a, Interval { low: down(back), high: up(back), partial: false });
            moved.intersection(&around)
        }
    }
}

/// The whole part of a quotient by one number, if it is surely the same everywhere.
pub(super) fn whole_quotient(a: Interval, b: Interval) -> Option<f64> {
    if b.low != b.high || b.low == 0.0 {
        return None;
    }
    let quotient = divide(a, b);
    let (first, last) = (quotient.low.floor(), quotient.high.floor());
    (first == last && first.abs() < 9e15).then_some(first)
}

/// The angle of points (b, a).
fn angle(a: Interval, b: Interval) -> Interval {
    use std::f64::consts::PI;
    // Across the negative x axis the angle jumps, and the sign of zero decides on which side a point of it lies.
    if a.contains_zero() && b.low <= 0.0 {
        return outward(Interval { low: -PI, high: PI, partial: false }, SLACK);
    }
    let mut result = Interval { low: f64::INFINITY, high: f64::NEG_INFINITY, partial: false };
    for corner in [
        libm::atan2(a.low, b.low),
        libm::atan2(a.low, b.high),
        libm::atan2(a.high, b.low),
        libm::atan2(a.high, b.high),
    ] {
        result = result.hull(&Interval { low: corner, high: corner, partial: false });
    }
    outward(result, SLACK)
}
