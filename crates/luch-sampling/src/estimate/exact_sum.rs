//! A sum of doubles, and of products of doubles, without rounding.
//!
//! A long fixed-point number (Kulisch 1971; Neal, "Fast exact summation using small and large superaccumulators", 2015): it
//! reaches from the square of the smallest double, 2⁻²¹⁴⁸, past the square of the largest, 2²⁰⁴⁸, with room for 2⁶⁴ terms.

/// Limbs of 32 bits: 2148 + 2048 + 64 + 64 bits, rounded up.
const LIMBS: usize = 136;

/// Weight of bit 0 is 2 to the minus this.
const POINT: i32 = 2148;

/// Carries are spread before the spare bits of a limb could overflow: each addition moves a limb by less than 2³³.
const MOST_PENDING: u32 = 1 << 28;

/// An exact sum.
#[derive(Clone, Debug)]
pub struct ExactSum {
    /// Base 2³² digits, each with spare bits and a sign of its own.
    limbs: [i64; LIMBS],
    /// Additions since the carries were last spread.
    pending: u32,
}

/// A finite double as whole number times a power of two, with sign.
struct Parts {
    negative: bool,
    mantissa: u64,
    exponent: i32,
}

impl Parts {
    fn of(value: f64) -> Self {
        let bits = value.to_bits();
        let (biased, fraction) = ((bits >> 52 & 0x7ff) as i32, bits & ((1 << 52) - 1));
        let negative = bits >> 63 == 1;
        if biased == 0 {
            Self { negative, mantissa: fraction, exponent: -1074 }
        } else {
            Self { negative, mantissa: fraction | 1 << 52, exponent: biased - 1075 }
        }
    }
}

impl Default for ExactSum {
    fn default() -> Self {
        Self { limbs: [0; LIMBS], pending: 0 }
    }
}

impl PartialEq for ExactSum {
    fn eq(&self, other: &Self) -> bool {
        let (mut a, mut b) = (self.clone(), other.clone());
        a.spread_carries();
        b.spread_carries();
        a.limbs == b.limbs
    }
}

impl Eq for ExactSum {}

impl ExactSum {
    /// Zero.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a finite number; others are ignored.
    #[inline]
    pub fn add(&mut self, value: f64) {
        if value.is_finite() {
            let Parts { negative, mantissa, exponent } = Parts::of(value);
            self.add_at(negative, mantissa, exponent + POINT);
        }
    }

    /// Adds the product of two finite numbers, without rounding it; others are ignored.
    #[inline]
    pub fn add_product(&mut self, first: f64, second: f64) {
        if first.is_finite() && second.is_finite() {
            let (a, b) = (Parts::of(first), Parts::of(second));
            let product = u128::from(a.mantissa) * u128::from(b.mantissa);
            let bit = a.exponent + b.exponent + POINT;
            let negative = a.negative != b.negative;
            self.add_at(negative, product as u64, bit);
            self.add_at(negative, (product >> 64) as u64, bit + 64);
        }
    }

    /// Adds another sum.
    pub fn merge(&mut self, other: &Self) {
        self.spread_carries();
        let mut other = other.clone();
        other.spread_carries();
        for (limb, add) in self.limbs.iter_mut().zip(other.limbs) {
            *limb += add;
        }
        self.spread_carries();
    }

    /// The sum, rounded to the nearest double (ties to even), infinite where doubles end.
    pub fn value(&self) -> f64 {
        self.rounded_quotient(1)
    }

    /// The sum divided by a count, rounded once; the quotient by zero is not a number.
    pub(super) fn mean(&self, count: u64) -> f64 {
        if count == 0 { f64::NAN } else { self.rounded_quotient(count) }
    }

    /// Adds `factor` times a sum of doubles (not of products).
    pub(super) fn add_scaled(&mut self, sum: &Self, factor: f64) {
        let mut sum = sum.clone();
        let negative = sum.make_positive();
        let factor = Parts::of(factor);
        for (place, &limb) in sum.limbs.iter().enumerate().filter(|(_, limb)| **limb != 0) {
            let product = u128::from(limb as u64) * u128::from(factor.mantissa);
            let bit = 32 * place as i32 + factor.exponent;
            self.add_at(negative != factor.negative, product as u64, bit);
            self.add_at(negative != factor.negative, (product >> 64) as u64, bit + 64);
        }
    }

    /// Adds `count` times a number.
    pub(super) fn add_repeated(&mut self, count: u64, value: f64) {
        let Parts { negative, mantissa, exponent } = Parts::of(value);
        let product = u128::from(count) * u128::from(mantissa);
        self.add_at(negative, product as u64, exponent + POINT);
        self.add_at(negative, (product >> 64) as u64, exponent + POINT + 64);
    }

    /// Adds `count` times the square of a number.
    pub(super) fn add_repeated_square(&mut self, count: u64, value: f64) {
        let Parts { mantissa, exponent, .. } = Parts::of(value);
        let square = u128::from(mantissa) * u128::from(mantissa);
        for (shift, part) in [(0, square as u64), (64, (square >> 64) as u64)] {
            let product = u128::from(part) * u128::from(count);
            let bit = 2 * exponent + POINT + shift;
            self.add_at(false, product as u64, bit);
            self.add_at(false, (product >> 64) as u64, bit + 64);
        }
    }

    /// Adds a whole number at a bit position. Bits below position 0 or past the end must be zero.
    #[inline]
    fn add_at(&mut self, negative: bool, magnitude: u64, bit: i32) {
        if magnitude == 0 {
            return;
        }
        // A subnormal factor may start below the point, then with zeros there.
        let (magnitude, bit) = if bit < 0 { (magnitude >> -bit, 0) } else { (magnitude, bit as usize) };
        let shifted = u128::from(magnitude) << (bit % 32);
        let place = bit / 32;
        for (offset, limb) in self.limbs.iter_mut().skip(place).take(3).enumerate() {
            let digit = (shifted >> (32 * offset)) as u32;
            *limb += if negative { -i64::from(digit) } else { i64::from(digit) };
        }
        self.pending += 1;
        if self.pending >= MOST_PENDING {
            self.spread_carries();
        }
    }

    /// Brings every digit but the highest into 0..2³²; the highest holds the sign. Then equal sums have equal digits.
    fn spread_carries(&mut self) {
        let mut carry = 0;
        for limb in &mut self.limbs[..LIMBS - 1] {
            let digit = *limb + carry;
            *limb = digit & 0xffff_ffff;
            carry = digit >> 32;
        }
        self.limbs[LIMBS - 1] += carry;
        self.pending = 0;
    }

    /// Replaces a negative sum by its opposite, with carries spread; tells whether it was negative.
    fn make_positive(&mut self) -> bool {
        self.spread_carries();
        let negative = self.limbs[LIMBS - 1] < 0;
        if negative {
            for limb in &mut self.limbs {
                *limb = -*limb;
            }
            self.spread_carries();
        }
        negative
    }

    /// Long division by a small number, then one rounding.
    fn rounded_quotient(&self, divisor: u64) -> f64 {
        let mut digits = self.clone();
        let negative = digits.make_positive();
        let mut remainder = 0u64;
        for limb in digits.limbs.iter_mut().rev() {
            let dividend = u128::from(remainder) << 32 | *limb as u128;
            *limb = (dividend / u128::from(divisor)) as i64;
            remainder = (dividend % u128::from(divisor)) as u64;
        }
        let magnitude = digits.round(remainder != 0);
        if negative { -magnitude } else { magnitude }
    }

    /// The nearest double to a positive sum with carries spread; `sticky` tells of a non-zero rest below it.
    fn round(&self, sticky: bool) -> f64 {
        let Some(top) = self.limbs.iter().rposition(|&limb| limb != 0) else { return 0.0 };
        let top_bit = 32 * top as i32 + 63 - self.limbs[top].leading_zeros() as i32;
        // The lowest bit a double of this size can hold.
        let last_bit = (top_bit - 52).max(POINT - 1074);
        let bit =
            |position: i32| position >= 0 && self.limbs[position as usize / 32] >> (position % 32) & 1 == 1;
        let mut mantissa = 0u64;
        for position in (last_bit..=top_bit).rev() {
            mantissa = mantissa << 1 | u64::from(bit(position));
        }
        let half = bit(last_bit - 1);
        let below = sticky || (0..last_bit - 1).any(bit);
        if half && (below || mantissa & 1 == 1) {
            mantissa += 1;
        }
        // Scaling by a power of two is exact here, in two steps so that neither factor leaves the range of doubles.
        let exponent = last_bit - POINT;
        if mantissa == 0 { 0.0 } else { libm::ldexp(mantissa as f64, exponent) }
    }
}
