//! One ray of a packet, and the pieces of its rays inside a box.

use super::{NO_HIT, Packet, Row};
use crate::simd::lanes::{Isa, Lanes, Mask};
use crate::simd::ray::Prepared;
use crate::{Aabb, Interval};
use std::array::from_fn;

/// The pieces of rays inside a box.
#[derive(Clone, Copy)]
pub(in crate::simd) struct Pieces {
    /// A bit for each ray that has one.
    pub(in crate::simd) rays: u32,
    pub(in crate::simd) near: Row,
    pub(in crate::simd) far: Row,
}

impl Pieces {
    pub(in crate::simd) const NONE: Self = Self { rays: 0, near: [0.0; 16], far: [0.0; 16] };

    /// The piece of one ray.
    #[inline(always)]
    pub(in crate::simd) fn interval(&self, lane: usize) -> Interval {
        Interval { near: self.near[lane & 15], far: self.far[lane & 15] }
    }
}

impl Packet {
    /// One of the sound rays, ready to go on alone.
    #[inline(always)]
    pub(in crate::simd) fn ray(&self, lane: usize) -> Prepared {
        let lane = lane & 15;
        let has = |bits: u32| bits >> lane & 1 == 1;
        let of = |rows: &[Row; 3]| from_fn(|axis| rows[axis][lane]);
        let along = if has(self.along[0]) { 0 } else { 1 + usize::from(has(self.along[2])) };
        Prepared::from_parts(
            of(&self.origin),
            Interval { near: self.t_min[lane], far: self.t_max[lane] },
            [of(&self.near_inverse), of(&self.far_inverse)],
            from_fn(|axis| has(self.backward[axis])),
            along,
            of(&self.shear),
            has(self.ahead),
        )
    }

    /// The pieces of the rays that count.
    pub(in crate::simd) fn whole(&self) -> Pieces {
        Pieces { rays: self.sound, near: self.t_min, far: self.t_max }
    }

    /// The pieces inside a box, as [`SlabRay::interval`](crate::SlabRay::interval).
    #[inline(always)]
    pub(in crate::simd) fn pieces<I: Isa>(&self, bounds: &Aabb) -> Pieces {
        let splat = I::Sixteen::splat;
        let mut near = I::Sixteen::load(&self.t_min);
        let mut far = I::Sixteen::load(&self.t_max);
        for axis in 0..3 {
            let backward = I::Sixteen::mask(self.backward[axis]);
            let (low, high) = (splat(bounds.min[axis]), splat(bounds.max[axis]));
            let first = I::Sixteen::select(backward, high, low);
            let last = I::Sixteen::select(backward, low, high);
            let origin = I::Sixteen::load(&self.origin[axis]);
            near = near.larger((first - origin) * I::Sixteen::load(&self.near_inverse[axis]));
            far = far.smaller((last - origin) * I::Sixteen::load(&self.far_inverse[axis]));
        }
        let rays = near.at_most(far).bits() & self.sound;
        Pieces { rays, near: near.to_array(), far: far.to_array() }
    }

    /// A bit for each ray whose bound lies at or beyond `near`.
    #[inline(always)]
    pub(in crate::simd) fn reached<I: Isa>(&self, near: &Row) -> u32 {
        I::Sixteen::load(near).at_most(I::Sixteen::load(&self.bound)).bits()
    }

    /// Lets the sound ones among `rays`, and no others, begin without a hit and with bounds of at most `bound`.
    #[inline(always)]
    pub(in crate::simd) fn restart(&mut self, rays: u32, bound: impl Fn(usize) -> f32) {
        self.sound &= rays;
        self.primitive = [f32::from_bits(NO_HIT); 16];
        for lane in 0..16 {
            self.bound[lane] = match self.sound >> lane & 1 == 1 {
                true => crate::slab::smaller(self.t_max[lane], bound(lane)),
                false => f32::NEG_INFINITY,
            };
        }
    }
}
