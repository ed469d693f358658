//! Repeatable random numbers: SplitMix64 (Steele, Lea, Flood 2014).

use glam::{Quat, Vec3, vec3};

pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In 0..1.
    pub(crate) fn unit(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / 16_777_216.0
    }

    /// In -1..1.
    pub(crate) fn signed(&mut self) -> f32 {
        2.0 * self.unit() - 1.0
    }

    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.bits() % count as u64) as usize
    }

    /// In the cube from -1 to 1.
    pub(crate) fn vector(&mut self) -> Vec3 {
        vec3(self.signed(), self.signed(), self.signed())
    }

    pub(crate) fn rotation(&mut self) -> Quat {
        Quat::from_xyzw(self.signed(), self.signed(), self.signed(), 1.5).normalize()
    }
}
