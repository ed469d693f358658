//! Numbers side by side, in loops that the compiler turns into vector code.

use crate::simd::{Level, Task, dispatch_at};
use std::ops::{Add, Mul, Sub};

/// Runs a task of the build with vector instructions. Boxes have eight lanes: above AVX2 there is nothing to gain.
#[inline]
pub(super) fn run<T: Task>(task: T) -> T::Output {
    dispatch_at(Level::current().min(Level::Avx2), task)
}

/// So many numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lanes<const N: usize>(pub(super) [f32; N]);

impl<const N: usize> Lanes<N> {
    #[inline(always)]
    pub(super) fn splat(value: f32) -> Self {
        Self([value; N])
    }

    #[inline(always)]
    fn with(self, other: Self, of: impl Fn(f32, f32) -> f32) -> Self {
        let mut lanes = self.0;
        for (lane, other) in lanes.iter_mut().zip(other.0) {
            *lane = of(*lane, other);
        }
        Self(lanes)
    }

    /// Lane by lane the smaller; `self` where `other` is not a number.
    #[inline(always)]
    pub(super) fn smaller(self, other: Self) -> Self {
        self.with(other, |a, b| if b < a { b } else { a })
    }

    /// Lane by lane the larger; `self` where `other` is not a number.
    #[inline(always)]
    pub(super) fn larger(self, other: Self) -> Self {
        self.with(other, |a, b| if b > a { b } else { a })
    }

    /// The bits of each lane that are set in `ones`.
    ///
    /// With all of them: the same numbers. But where the compiler does not know that it is all of them, it cannot turn a
    /// minimum that goes back to where it came from into a masked store, and a load that follows does not wait for one.
    #[inline(always)]
    pub(super) fn masked(self, ones: u32) -> Self {
        let mut lanes = self.0;
        for lane in &mut lanes {
            *lane = f32::from_bits(lane.to_bits() & ones);
        }
        Self(lanes)
    }
}

impl<const N: usize> Add for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.with(other, |a, b| a + b)
    }
}

impl<const N: usize> Sub for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.with(other, |a, b| a - b)
    }
}

impl<const N: usize> Mul for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.with(other, |a, b| a * b)
    }
}
