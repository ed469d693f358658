//! Boxes as the build handles them: four lanes at a time, and measured in units that neither overflow nor vanish.

use super::lanes::Lanes;
use crate::Aabb;
use glam::Vec3;

/// What is noted in a fourth lane stands in the fraction of a number from 1 to 2. Arithmetic runs over all four lanes, and on
/// the very small numbers that small integers would be, it is a hundred times slower.
const NOTE: u32 = 0x3f80_0000;

/// A box in eight lanes: the least coordinates, a note, the greatest ones negated, a note. So both corners of a union are the
/// lesser of two, and all of it is one instruction. Notes mean nothing to the box.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(super) struct Bounds([f32; 8]);

impl Bounds {
    pub(super) const EMPTY: Self = Self([f32::INFINITY; 8]);

    #[inline(always)]
    pub(super) fn union(&self, other: &Self) -> Self {
        Self(self.lanes().smaller(other.lanes()).0)
    }

    #[inline(always)]
    pub(super) fn lanes(&self) -> Lanes<8> {
        Lanes(self.0)
    }

    /// The box of such lanes.
    #[inline(always)]
    pub(super) fn of_lanes(lanes: Lanes<8>) -> Self {
        Self(lanes.0)
    }

    #[inline(always)]
    pub(super) fn grow(&mut self, [x, y, z, w]: [f32; 4]) {
        *self = self.union(&Self([x, y, z, w, -x, -y, -z, -w]));
    }

    /// The least coordinate along an axis.
    #[inline(always)]
    pub(super) fn low(&self, axis: usize) -> f32 {
        self.0[axis % 4]
    }

    /// The greatest coordinate along an axis.
    #[inline(always)]
    pub(super) fn high(&self, axis: usize) -> f32 {
        -self.0[4 + axis % 4]
    }

    /// The least coordinates.
    #[inline(always)]
    pub(super) fn lows(&self) -> [f32; 4] {
        let [x, y, z, w, ..] = self.0;
        [x, y, z, w]
    }

    /// The greatest coordinates.
    #[inline(always)]
    pub(super) fn highs(&self) -> [f32; 4] {
        let [.., x, y, z, w] = self.0;
        [-x, -y, -z, -w]
    }

    /// The same box with 23 bits noted in each fourth lane.
    #[inline(always)]
    pub(super) fn with_note(mut self, low: u32, high: u32) -> Self {
        self.0[3] = f32::from_bits(NOTE | low);
        self.0[7] = f32::from_bits(NOTE | high);
        self
    }

    /// What is noted.
    #[inline(always)]
    pub(super) fn note(&self) -> [u32; 2] {
        [self.0[3], self.0[7]].map(|lane| lane.to_bits() & !NOTE)
    }

    /// The part inside both.
    #[inline(always)]
    pub(super) fn intersection(&self, other: &Self) -> Self {
        Self(self.lanes().larger(other.lanes()).0)
    }

    #[inline(always)]
    pub(super) fn is_empty(&self) -> bool {
        (0..3).any(|axis| self.low(axis) > self.high(axis))
    }

    #[inline(always)]
    pub(super) fn of(bounds: &Aabb) -> Self {
        let Aabb { min, max } = bounds;
        Self([min.x, min.y, min.z, 0.0, -max.x, -max.y, -max.z, 0.0])
    }

    #[inline(always)]
    pub(super) fn aabb(&self) -> Aabb {
        let corner = |lanes: [f32; 4]| Vec3::new(lanes[0], lanes[1], lanes[2]);
        Aabb { min: corner(self.lows()), max: corner(self.highs()) }
    }
}

/// A power of two that brings the coordinates of all boxes near one, so that areas neither overflow nor vanish.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale(f32);

impl Scale {
    pub(super) fn of(whole: &Bounds) -> Self {
        let sizes = (0..3).flat_map(|axis| [whole.low(axis).abs(), whole.high(axis).abs()]);
        let largest = sizes.filter(|size| size.is_finite()).fold(f32::MIN_POSITIVE, f32::max);
        // The exponent of the largest coordinate, negated: 2⁻ᵉ, kept inside the range of normal numbers.
        let exponent = (largest.to_bits() >> 23) as i32 - 127;
        Self(f32::from_bits(((126 - exponent).clamp(1, 254) as u32) << 23))
    }

    /// The box of nothing but the middle.
    #[inline(always)]
    pub(super) fn middle(self, bounds: &Bounds) -> Lanes<8> {
        let sides = bounds.lanes() * Lanes::<8>::splat(self.0);
        let [a, b, c, d, e, f, g, h] = sides.0;
        sides - Lanes([e, f, g, h, a, b, c, d])
    }

    /// The middle along one axis; the same bits as [`Scale::middle`].
    #[inline(always)]
    pub(super) fn middle_along(self, low: f32, high: f32) -> f32 {
        low * self.0 + high * self.0
    }

    /// Half of the surface area.
    #[inline(always)]
    pub(super) fn half_area(self, bounds: &Bounds) -> f32 {
        let mut size = bounds.highs();
        for (high, low) in size.iter_mut().zip(bounds.lows()) {
            *high = *high * self.0 - low * self.0;
        }
        size[0] * size[1] + (size[0] + size[1]) * size[2]
    }

    /// Half of the surface area of each of three boxes; the fourth number means nothing.
    #[inline(always)]
    pub(super) fn half_areas(self, boxes: &[Bounds; 3]) -> Lanes<4> {
        let scale = Lanes::<8>::splat(self.0);
        let [a, b, c] = [0, 1, 2].map(|lane: usize| (boxes[lane].lanes() * scale).0);
        let size = |axis: usize| {
            let high = Lanes([-a[4 + axis], -b[4 + axis], -c[4 + axis], 0.0]);
            high - Lanes([a[axis], b[axis], c[axis], 0.0])
        };
        let (x, y, z) = (size(0), size(1), size(2));
        x * y + (x + y) * z
    }
}
