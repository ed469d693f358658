//! Boxes as the build handles them: four lanes at a time, and measured in units that neither overflow nor vanish.

use crate::Aabb;
use glam::Vec3;

/// What is noted in a fourth lane stands in the fraction of a number from 1 to 2. Arithmetic runs over all four lanes, and on
/// the very small numbers that small integers would be, it is a hundred times slower.
const NOTE: u32 = 0x3f80_0000;

/// A box in two vectors of four lanes; the fourth means nothing to the box.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
pub(super) struct Bounds {
    pub(super) low: [f32; 4],
    pub(super) high: [f32; 4],
}

impl Bounds {
    pub(super) const EMPTY: Self = Self { low: [f32::INFINITY; 4], high: [f32::NEG_INFINITY; 4] };

    #[inline(always)]
    pub(super) fn union(&self, other: &Self) -> Self {
        Self { low: least(self.low, other.low), high: greatest(self.high, other.high) }
    }

    #[inline(always)]
    pub(super) fn grow(&mut self, point: [f32; 4]) {
        self.low = least(self.low, point);
        self.high = greatest(self.high, point);
    }

    /// The same box with 23 bits noted in each fourth lane.
    #[inline(always)]
    pub(super) fn with_note(mut self, low: u32, high: u32) -> Self {
        self.low[3] = f32::from_bits(NOTE | low);
        self.high[3] = f32::from_bits(NOTE | high);
        self
    }

    /// What is noted.
    #[inline(always)]
    pub(super) fn note(&self) -> [u32; 2] {
        [self.low[3], self.high[3]].map(|lane| lane.to_bits() & !NOTE)
    }

    /// The part inside both.
    #[inline(always)]
    pub(super) fn intersection(&self, other: &Self) -> Self {
        Self { low: greatest(self.low, other.low), high: least(self.high, other.high) }
    }

    pub(super) fn is_empty(&self) -> bool {
        (0..3).any(|axis| self.low[axis] > self.high[axis])
    }

    pub(super) fn of(bounds: &Aabb) -> Self {
        let lanes = |corner: Vec3| [corner.x, corner.y, corner.z, 0.0];
        Self { low: lanes(bounds.min), high: lanes(bounds.max) }
    }

    pub(super) fn aabb(&self) -> Aabb {
        let corner = |lanes: [f32; 4]| Vec3::new(lanes[0], lanes[1], lanes[2]);
        Aabb { min: corner(self.low), max: corner(self.high) }
    }
}

/// Lane by lane; one instruction on most machines. Both sides are numbers.
#[inline(always)]
pub(super) fn least(a: [f32; 4], b: [f32; 4]) -> [f32; 4] {
    std::array::from_fn(|lane| if b[lane] < a[lane] { b[lane] } else { a[lane] })
}

#[inline(always)]
pub(super) fn greatest(a: [f32; 4], b: [f32; 4]) -> [f32; 4] {
    std::array::from_fn(|lane| if b[lane] > a[lane] { b[lane] } else { a[lane] })
}

/// A power of two that brings the coordinates of all boxes near one, so that areas neither overflow nor vanish.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale(f32);

impl Scale {
    pub(super) fn of(whole: &Bounds) -> Self {
        let sizes = [whole.low, whole.high].concat().into_iter().map(f32::abs);
        let largest = sizes.filter(|size| size.is_finite()).fold(f32::MIN_POSITIVE, f32::max);
        // The exponent of the largest coordinate, negated: 2⁻ᵉ, kept inside the range of normal numbers.
        let exponent = (largest.to_bits() >> 23) as i32 - 127;
        Self(f32::from_bits(((126 - exponent).clamp(1, 254) as u32) << 23))
    }

    /// The middle of the box, along each axis.
    #[inline(always)]
    pub(super) fn middle(self, bounds: &Bounds) -> [f32; 4] {
        std::array::from_fn(|lane| bounds.low[lane] * self.0 + bounds.high[lane] * self.0)
    }

    /// The middle along one axis; the same bits as [`Scale::middle`].
    #[inline(always)]
    pub(super) fn middle_along(self, low: f32, high: f32) -> f32 {
        low * self.0 + high * self.0
    }

    /// Half of the surface area.
    #[inline(always)]
    pub(super) fn half_area(self, bounds: &Bounds) -> f32 {
        let size: [f32; 4] =
            std::array::from_fn(|lane| bounds.high[lane] * self.0 - bounds.low[lane] * self.0);
        size[0] * size[1] + (size[0] + size[1]) * size[2]
    }
}
