//! Ranges of numbers that hold every value a calculation can take.
//!
//! Sound in both senses: a range holds the true values of the function, and the numbers that the evaluators compute for it.
//! Sums, products, quotients and roots are rounded outward by one or two units of the last place; rounding is monotone, so computed
//! numbers cannot leave the range either. Functions of the mathematics library get more room, see [`functions`].

mod binary;
mod functions;
mod slopes;

pub(crate) use binary::binary;
pub(crate) use functions::{SineAndCosine, down, noise, sine_and_cosine, unary, up, whole_power};
pub(crate) use slopes::{binary_slopes, chain, noise_with_slopes, unary_slope, whole_power_slope};

/// All numbers from `low` to `high`, both included. Ends may be infinite, and then infinite values are included too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The least number.
    pub low: f64,
    /// The greatest number; below `low` only if there are no numbers at all.
    pub high: f64,
    /// Whether the function may be undefined (not a number) somewhere, as √x is left of zero.
    pub partial: bool,
}

impl Interval {
    /// Every number.
    pub const WHOLE: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY, partial: false };
    /// Nothing is known: every number, or none.
    pub const UNKNOWN: Self = Self { partial: true, ..Self::WHOLE };
    /// No number anywhere.
    pub const EMPTY: Self = Self { low: f64::INFINITY, high: f64::NEG_INFINITY, partial: true };
    pub(crate) const ZERO: Self = Self { low: 0.0, high: 0.0, partial: false };

    /// The numbers between two, in either order; unknown if one is not a number.
    pub fn new(a: f64, b: f64) -> Self {
        if a.is_nan() || b.is_nan() {
            return Self::UNKNOWN;
        }
        Self { low: if a < b { a } else { b }, high: if a < b { b } else { a }, partial: false }
    }

    /// One number; empty if it is none.
    pub fn point(value: f64) -> Self {
        if value.is_nan() { Self::EMPTY } else { Self { low: value, high: value, partial: false } }
    }

    /// Whether no number is in it.
    pub fn is_empty(&self) -> bool {
        self.low > self.high
    }

    /// Whether both ends are finite and the function is defined everywhere.
    pub fn is_bounded(&self) -> bool {
        !self.partial && self.low > f64::NEG_INFINITY && self.high < f64::INFINITY
    }

    /// Whether a value is allowed: it lies inside, or it is not a number and the function may be undefined.
    pub fn contains(&self, value: f64) -> bool {
        if value.is_nan() { self.partial } else { self.low <= value && value <= self.high }
    }

    /// Whether zero lies inside.
    pub fn contains_zero(&self) -> bool {
        self.low <= 0.0 && self.high >= 0.0
    }

    /// The greatest number less the least.
    pub fn width(&self) -> f64 {
        self.high - self.low
    }

    /// The middle; finite if the ends are.
    pub fn middle(&self) -> f64 {
        0.5 * self.low + 0.5 * self.high
    }

    /// The least range that holds both.
    #[must_use]
    pub fn hull(&self, other: &Self) -> Self {
        Self {
            low: if self.low < other.low { self.low } else { other.low },
            high: if self.high > other.high { self.high } else { other.high },
            partial: self.partial | other.partial,
        }
    }

    /// What lies in both. Undefined places remain only if both have some.
    #[must_use]
    pub fn intersection(&self, other: &Self) -> Self {
        Self {
            low: if self.low > other.low { self.low } else { other.low },
            high: if self.high < other.high { self.high } else { other.high },
            partial: self.partial & other.partial,
        }
    }

    pub(crate) fn partial_if(mut self, partial: bool) -> Self {
        self.partial |= partial;
        self
    }

    /// Cut to the values a function can have at all.
    pub(crate) fn within(self, low: f64, high: f64) -> Self {
        Self {
            low: if self.low < low { low } else { self.low },
            high: if self.high > high { high } else { self.high },
            partial: self.partial,
        }
    }

    /// Whether the number counts as true everywhere, nowhere, or neither is sure.
    pub(crate) fn truth(&self) -> Option<bool> {
        if self.is_empty() || (self.low == 0.0 && self.high == 0.0) {
            // What is undefined is not true.
            Some(false)
        } else if !self.partial && !self.contains_zero() {
            Some(true)
        } else {
            None
        }
    }

    /// What a comparison gives.
    pub(crate) fn claim(known: Option<bool>) -> Self {
        match known {
            Some(true) => Self { low: 1.0, high: 1.0, partial: false },
            Some(false) => Self::ZERO,
            None => Self { low: 0.0, high: 1.0, partial: false },
        }
    }
}

/// A range of values, and of derivatives along one parameter.
///
/// A bounded derivative vouches for continuity: wherever the function may jump or is undefined, the derivative is
/// unbounded. In kinks it holds the slopes of both sides, so that the mean value theorem is true of it: for a and b inside,
/// f(b) − f(a) lies in the derivative times (b − a).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IntervalDerivative {
    /// The values.
    pub value: Interval,
    /// The derivatives.
    pub derivative: Interval,
}
