//! Sums that come out the same in any order: fixed-point numbers of 96 bits.

use bytemuck::{Pod, Zeroable};

/// A signed integer of 96 bits, least significant word first: a sum of samples in units of a film's step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Fixed96([u32; 3]);

impl Fixed96 {
    /// The value as a wide integer.
    pub(crate) fn to_i128(self) -> i128 {
        let [low, middle, high] = self.0;
        i128::from(low) | i128::from(middle) << 32 | i128::from(high as i32) << 64
    }

    /// The lowest 96 bits of a wide integer.
    pub(crate) fn from_i128(value: i128) -> Self {
        Self([value as u32, (value >> 32) as u32, (value >> 64) as u32])
    }

    /// Adds; wraps around past 2⁹⁵, which the limits of [`Step`] rule out.
    pub(crate) fn add(&mut self, units: i128) {
        *self = Self::from_i128(self.to_i128().wrapping_add(units));
    }
}

/// The unit of a film's sums: 2 to the power of `exponent`.
///
/// A sample is rounded to the nearest unit and cut at ±2^(62 + exponent), so that 2³³ samples, more than a pixel can have, stay below
/// 2⁹⁵ units. The usual exponent −36 keeps 1.5·10⁻¹¹ apart and samples up to 6.7·10⁷ whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Step {
    exponent: i8,
}

/// A sample in units, and whether it had to be changed to fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Quantized {
    pub(crate) units: i128,
    pub(crate) fate: Fate,
}

/// What became of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fate {
    /// Rounded to the nearest unit.
    Kept,
    /// Cut at the largest magnitude.
    Saturated,
    /// Infinite or not a number; counted as zero.
    Invalid,
}

impl Step {
    /// Exponents outside this range leave no room for samples or no digits for them.
    pub(crate) const EXPONENTS: std::ops::RangeInclusive<i8> = -60..=20;

    /// The step of 2^`exponent`, if that is in range.
    pub(crate) fn new(exponent: i8) -> Option<Self> {
        Self::EXPONENTS.contains(&exponent).then_some(Self { exponent })
    }

    /// The exponent.
    pub(crate) fn exponent(self) -> i8 {
        self.exponent
    }

    /// The unit.
    pub(crate) fn unit(self) -> f64 {
        power_of_two(i32::from(self.exponent))
    }

    /// A sample in units.
    pub(crate) fn quantize(self, sample: f32) -> Quantized {
        if !sample.is_finite() {
            return Quantized { units: 0, fate: Fate::Invalid };
        }
        // Scaling by a power of two is exact in f64 for every f32 and every exponent in range.
        let scaled = f64::from(sample) * power_of_two(-i32::from(self.exponent));
        let limit = power_of_two(62);
        if scaled.abs() > limit {
            Quantized { units: limit.copysign(scaled) as i128, fate: Fate::Saturated }
        } else {
            Quantized { units: i128::from(scaled.round_ties_even() as i64), fate: Fate::Kept }
        }
    }
}

/// 2 to the power of `exponent`, exactly, for normal results.
fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ninety_six_bits_hold_what_is_promised() {
        for value in
            [0, 1, -1, (1 << 94) + 12345, -(1 << 94) - 99, i128::from(i64::MIN), i128::from(u64::MAX)]
        {
            assert_eq!(Fixed96::from_i128(value).to_i128(), value);
        }
        let step = Step::new(-36).unwrap();
        let most = step.quantize(f32::MAX);
        assert_eq!(most.fate, Fate::Saturated);
        assert!(most.units.checked_mul(1 << 33).unwrap() <= 1 << 95);
    }

    #[test]
    fn quantizing_rounds_to_the_nearest_unit_and_names_what_does_not_fit() {
        let step = Step::new(-36).unwrap();
        for sample in [0.0_f32, 1.0, 0.1, 123.456, 1e-9, -2.5, 6.0e7] {
            let q = step.quantize(sample);
            assert_eq!(q.fate, Fate::Kept);
            assert!((q.units as f64 * step.unit() - f64::from(sample)).abs() <= step.unit() / 2.0);
        }
        for sample in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            assert_eq!(step.quantize(sample), Quantized { units: 0, fate: Fate::Invalid });
        }
        assert_eq!(step.quantize(-1e30).units, -(1 << 62));
    }
}
