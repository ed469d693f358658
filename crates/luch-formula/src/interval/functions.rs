//! Ranges of functions of one number, and of noise.
//!
//! The mathematics library errs by up to about two units of the last place, and need not be monotone within that. So the values at
//! the ends are moved outward by nine units.

use super::Interval;
use super::binary::magnitudes;
use crate::noise::{MOST_CURVED, Noise, STEEPEST, noise as noise_at};
use crate::operation::{Unary, unary as unary_at};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Nine units of the last place.
pub(super) const SLACK: f64 = 2e-15;

/// The gamma function of the library errs by some units more, and digamma by its sum.
pub(super) const GAMMA_SLACK: f64 = 1e-13;

/// The rounding of noise: some hundred operations on numbers of size one.
const NOISE_SLACK: f64 = 1e-13;

/// A number below, by one or two units of the last place, without a branch: ε|v| is one unit at least, and what is added to it
/// serves numbers near zero. From +∞ the greatest number is taken first.
#[inline]
pub(crate) fn down(value: f64) -> f64 {
    let value = if value > f64::MAX { f64::MAX } else { value };
    value - (value.abs() * f64::EPSILON + f64::MIN_POSITIVE)
}

/// A number above; see [`down`].
#[inline]
pub(crate) fn up(value: f64) -> f64 {
    let value = if value < -f64::MAX { -f64::MAX } else { value };
    value + (value.abs() * f64::EPSILON + f64::MIN_POSITIVE)
}

/// The range of two numbers that are defined.
#[inline]
pub(super) fn quick(a: f64, b: f64) -> Interval {
    Interval { low: if a < b { a } else { b }, high: if a < b { b } else { a }, partial: false }
}

/// Moved outward by a part of each end; infinite ends come back to the greatest number.
pub(super) fn outward(range: Interval, slack: f64) -> Interval {
    let low = if range.low == f64::INFINITY { f64::MAX } else { range.low };
    let high = if range.high == f64::NEG_INFINITY { -f64::MAX } else { range.high };
    Interval {
        low: if low == f64::NEG_INFINITY { low } else { (low - low.abs() * slack).next_down() },
        high: if high == f64::INFINITY { high } else { (high + high.abs() * slack).next_up() },
        partial: range.partial,
    }
}

/// The range of a function over a range.
pub(crate) fn unary(function: Unary, x: Interval) -> Interval {
    if function == Unary::Not {
        return Interval::claim(x.truth().map(|truth| !truth));
    }
    if x.is_empty() {
        return Interval::EMPTY;
    }
    let at = |x: f64| unary_at(function, crate::operation::Once([x]));
    let both = |x: Interval| quick(at(x.low), at(x.high));
    let infinite = x.low == f64::NEG_INFINITY || x.high == f64::INFINITY;
    let everywhere = f64::INFINITY;
    let result = match function {
        Unary::Negate => Interval { low: -x.high, high: -x.low, partial: false },
        Unary::Absolute => {
            let (low, high) = magnitudes(x);
            Interval { low, high, partial: false }
        }
        Unary::Sign | Unary::Floor | Unary::Ceil | Unary::Round | Unary::Not => both(x),
        Unary::SquareRoot => match inside(x, 0.0, everywhere) {
            None => Interval::EMPTY,
            Some(x) => {
                // The root is rounded rightly; a root that is zero is exact.
                let (low, high) = (x.low.sqrt(), x.high.sqrt());
                let low = if low == 0.0 { 0.0 } else { down(low) };
                Interval { low, high: if high == 0.0 { 0.0 } else { up(high) }, partial: x.partial }
            }
        },
        Unary::CubeRoot | Unary::Sinh | Unary::Asinh => outward(both(x), SLACK),
        Unary::Atan => outward(both(x), SLACK).within(-FRAC_PI_2.next_up(), FRAC_PI_2.next_up()),
        Unary::Exp => outward(both(x), SLACK).within(0.0, everywhere),
        Unary::Tanh | Unary::ErrorFunction => outward(both(x), SLACK).within(-1.0, 1.0),
        Unary::Ln | Unary::Log2 | Unary::Log10 => inside(x, 0.0, everywhere).map_or(Interval::EMPTY, |x| {
            // Whatever the sign of zero.
            let low = if x.low == 0.0 { f64::NEG_INFINITY } else { at(x.low) };
            let high = if x.high == 0.0 { f64::NEG_INFINITY } else { at(x.high) };
            outward(Interval { low, high, partial: x.partial }, SLACK)
        }),
        Unary::Sin => wave(x, 0.25, at).partial_if(infinite),
        Unary::Cos => wave(x, 0.0, at).partial_if(infinite),
        Unary::Tan => {
            // The poles stand a quarter and three quarters of a turn from zero.
            if infinite || meets_whole(x, 0.5 * TAU, 0.5) {
                Interval::WHOLE.partial_if(infinite)
            } else {
                outward(both(x), SLACK)
            }
        }
        Unary::Asin | Unary::Acos => {
            inside(x, -1.0, 1.0).map_or(Interval::EMPTY, |x| outward(both(x), SLACK).partial_if(x.partial))
        }
        Unary::Cosh => {
            let (nearest, farthest) = magnitudes(x);
            outward(quick(at(nearest), at(farthest)), SLACK).within(1.0, everywhere)
        }
        Unary::Acosh => inside(x, 1.0, everywhere).map_or(Interval::EMPTY, |x| {
            outward(both(x), SLACK).within(0.0, everywhere).partial_if(x.partial)
        }),
        Unary::Atanh => {
            inside(x, -1.0, 1.0).map_or(Interval::EMPTY, |x| outward(both(x), SLACK).partial_if(x.partial))
        }
        Unary::Gamma if x.low > 0.0 => valley(x, at, 0.885_603_194_410_888_7).within(0.0, everywhere),
        Unary::Gamma => Interval::UNKNOWN,
        Unary::LnGamma if x.low > 0.0 => valley(x, at, -0.121_486_290_535_849_6),
        Unary::LnGamma => Interval::WHOLE,
    };
    result.partial_if(x.partial)
}

/// What of a range lies in the domain of a function; partial if something does not.
fn inside(x: Interval, low: f64, high: f64) -> Option<Interval> {
    let partial = x.low < low || x.high > high;
    (x.high >= low && x.low <= high).then(|| x.within(low, high).partial_if(partial))
}

/// Whether (x / unit) − phase surely meets no whole number: false says so.
#[inline]
fn meets_whole(x: Interval, unit: f64, phase: f64) -> bool {
    let (first, last) = (x.low / unit - phase, x.high / unit - phase);
    // The quotient and the constant err by some units of the last place.
    let slack = SLACK * (1.0 + first.abs() + last.abs());
    floor(last + slack) >= first - slack
}

/// Added to numbers that are not too large it leaves no room for fractions.
const WHOLE: f64 = 1.5 * (1_u64 << 52) as f64;

/// Rounding down without a call: to the nearest whole number, and one less if that is above.
#[inline]
fn floor(x: f64) -> f64 {
    if x.abs() < 1e15 {
        let nearest = (x + WHOLE) - WHOLE;
        if nearest > x { nearest - 1.0 } else { nearest }
    } else {
        x.floor()
    }
}

/// The ranges of sine and cosine; what both need is computed once.
pub(crate) fn sine_and_cosine(x: Interval) -> SineAndCosine {
    if !(x.low.is_finite() && x.high.is_finite() && x.high - x.low >= NARROW) {
        return SineAndCosine { sine: unary(Unary::Sin, x), cosine: unary(Unary::Cos, x) };
    }
    let ((sin_low, cos_low), (sin_high, cos_high)) = (libm::sincos(x.low), libm::sincos(x.high));
    let sine = between_ends(x, 0.25, quick(sin_low, sin_high));
    let cosine = between_ends(x, 0.0, quick(cos_low, cos_high));
    SineAndCosine { sine: sine.partial_if(x.partial), cosine: cosine.partial_if(x.partial) }
}

/// Two ranges.
pub(crate) struct SineAndCosine {
    pub(crate) sine: Interval,
    pub(crate) cosine: Interval,
}

/// What is narrower is as good as one number.
const NARROW: f64 = 1e-12;

/// A wave between −1 and 1 whose crest stands at `crest` turns.
fn wave(x: Interval, crest: f64, at: impl Fn(f64) -> f64) -> Interval {
    let whole = Interval { low: -1.0, high: 1.0, partial: false };
    if !(x.low.is_finite() && x.high.is_finite()) {
        return whole;
    }
    if x.high - x.low < NARROW {
        let value = at(x.low);
        // No wave is steeper than 1. Near its zeros the ends tell more.
        if value.abs() > 0.01 {
            let reach = up(x.high - x.low) + SLACK;
            return Interval { low: value - reach, high: value + reach, partial: false }.within(-1.0, 1.0);
        }
    }
    between_ends(x, crest, quick(at(x.low), at(x.high)))
}

/// A wave whose values at the ends are known.
fn between_ends(x: Interval, crest: f64, ends: Interval) -> Interval {
    let ends = outward(ends, SLACK).within(-1.0, 1.0);
    Interval {
        low: if meets_whole(x, TAU, crest + 0.5) { -1.0 } else { ends.low },
        high: if meets_whole(x, TAU, crest) { 1.0 } else { ends.high },
        partial: false,
    }
}

/// Where Γ has its least value right of zero; OEIS A030169.
const LEAST_OF_GAMMA: f64 = 1.461_632_144_968_362_3;

/// A function that falls to the least value of Γ and rises from there.
fn valley(x: Interval, at: impl Fn(f64) -> f64, least: f64) -> Interval {
    let mut ends = quick(at(x.low), at(x.high));
    if x.low <= LEAST_OF_GAMMA.next_up() && x.high >= LEAST_OF_GAMMA.next_down() {
        ends.low = if ends.low < least { ends.low } else { least };
    }
    let range = outward(ends, GAMMA_SLACK);
    // Near the zeros of ln Γ the error is no longer relative.
    Interval { low: range.low - 1e-15, high: range.high + 1e-15, partial: false }
}

/// The range of a power with a whole exponent of at least 2.
pub(crate) fn whole_power(base: Interval, exponent: u8) -> Interval {
    if base.is_empty() {
        return Interval::EMPTY;
    }
    let (low, high) = if exponent.is_multiple_of(2) {
        let (nearest, farthest) = magnitudes(base);
        (size_down(nearest, exponent), size_up(farthest, exponent))
    } else {
        let low = if base.low < 0.0 { -size_up(-base.low, exponent) } else { size_down(base.low, exponent) };
        let high =
            if base.high < 0.0 { -size_down(-base.high, exponent) } else { size_up(base.high, exponent) };
        (low, high)
    };
    Interval { low, high, partial: base.partial }
}

/// The power of a number that is not negative, each product rounded down. The order of products is that of the evaluators.
fn size_down(base: f64, exponent: u8) -> f64 {
    products(base, exponent, |x, y| down(x * y).max(0.0))
}

fn size_up(base: f64, exponent: u8) -> f64 {
    products(base, exponent, |x, y| if x == 0.0 || y == 0.0 { 0.0 } else { up(x * y) })
}

fn products(base: f64, exponent: u8, product: impl Fn(f64, f64) -> f64) -> f64 {
    let (mut square, mut rest, mut power) = (base, exponent, None);
    while rest != 0 {
        if rest & 1 == 1 {
            power = Some(power.map_or(square, |power| product(power, square)));
        }
        rest >>= 1;
        if rest != 0 {
            square = product(square, square);
        }
    }
    power.unwrap_or(1.0)
}

/// The middle of a box, how far its ends are from there, and the sum of that; none if an end is infinite.
pub(super) struct Cell {
    pub(super) middle: [f64; 3],
    pub(super) reach: f64,
}

pub(super) fn cell(place: [Interval; 3]) -> Option<Cell> {
    if place.iter().any(|range| !(range.low.is_finite() && range.high.is_finite())) {
        return None;
    }
    let middle = place.map(|range| range.middle());
    let mut reach = 0.0;
    for (range, middle) in place.iter().zip(middle) {
        reach = up(reach + up(up(range.high - middle).max(up(middle - range.low))));
    }
    Some(Cell { middle, reach })
}

/// The range of noise.
pub(crate) fn noise(place: [Interval; 3]) -> Interval {
    let partial = place.iter().any(|range| range.partial);
    if place.iter().any(Interval::is_empty) {
        return Interval::EMPTY;
    }
    match cell(place) {
        None => Interval { low: -1.0, high: 1.0, partial: true },
        Some(cell) => {
            let [x, y, z] = cell.middle;
            noise_around(&noise_at(x, y, z), &cell).partial_if(partial)
        }
    }
}

/// The range of noise in a cell: its value in the middle, and as far from it as the steepest slope leads; or as the slopes there
/// lead, and half the greatest curvature.
pub(super) fn noise_around(middle: &Noise, cell: &Cell) -> Interval {
    let steepest = middle.gradient.iter().fold(0.0_f64, |most, slope| most.max(slope.abs()));
    let slope = steepest + 0.5 * MOST_CURVED * cell.reach;
    let slope = if slope < STEEPEST { slope } else { STEEPEST };
    let reach = up(up(slope) * cell.reach) + NOISE_SLACK * (1.0 + cell.reach);
    Interval { low: middle.value - reach, high: middle.value + reach, partial: false }
        .within(-1.0 - NOISE_SLACK, 1.0 + NOISE_SLACK)
}
