//! The level every processor has: arrays, and loops the compiler may turn into whatever vectors there are.

use super::lanes::{Isa, Lanes, Mask};
use super::level::{Task, run_portable};
use crate::slab::{larger, smaller};
use std::array::from_fn;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

/// The portable level.
#[derive(Clone, Copy)]
pub(crate) struct Portable;

/// Numbers in an array.
#[derive(Clone, Copy)]
pub(crate) struct Array<const N: usize>([f32; N]);

/// All ones for yes, all zeroes for no.
#[derive(Clone, Copy)]
pub(crate) struct Flags<const N: usize>([u32; N]);

impl<const N: usize> Array<N> {
    #[inline(always)]
    fn with(self, other: Self, of: impl Fn(f32, f32) -> f32) -> Self {
        Self(from_fn(|lane| of(self.0[lane], other.0[lane])))
    }

    #[inline(always)]
    fn compared(self, other: Self, of: impl Fn(f32, f32) -> bool) -> Flags<N> {
        Flags(from_fn(|lane| if of(self.0[lane], other.0[lane]) { u32::MAX } else { 0 }))
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident,)*) => {$(
        impl<const N: usize> $operator for Array<N> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.with(other, |a, b| a.$method(b))
            }
        }
    )*};
}
operators!(Add add, Sub sub, Mul mul, Div div,);

impl<const N: usize> BitAnd for Flags<N> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self(from_fn(|lane| self.0[lane] & other.0[lane]))
    }
}

impl<const N: usize> BitOr for Flags<N> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self(from_fn(|lane| self.0[lane] | other.0[lane]))
    }
}

impl<const N: usize> Not for Flags<N> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self(self.0.map(|flag| !flag))
    }
}

impl<const N: usize> Mask for Flags<N> {
    #[inline(always)]
    fn bits(self) -> u32 {
        (0..N).fold(0, |bits, lane| bits | (self.0[lane] & 1) << lane)
    }
}

impl<const N: usize> Lanes<N> for Array<N> {
    type Mask = Flags<N>;

    #[inline(always)]
    fn splat(value: f32) -> Self {
        Self([value; N])
    }

    #[inline(always)]
    fn load(values: &[f32; N]) -> Self {
        Self(*values)
    }

    #[inline(always)]
    fn to_array(self) -> [f32; N] {
        self.0
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.map(f32::abs))
    }

    #[inline(always)]
    fn larger(self, value: Self) -> Self {
        self.with(value, larger)
    }

    #[inline(always)]
    fn smaller(self, value: Self) -> Self {
        self.with(value, smaller)
    }

    #[inline(always)]
    fn below(self, other: Self) -> Flags<N> {
        self.compared(other, |a, b| a < b)
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> Flags<N> {
        self.compared(other, |a, b| a <= b)
    }

    #[inline(always)]
    fn equals(self, other: Self) -> Flags<N> {
        self.compared(other, |a, b| a == b)
    }

    #[inline(always)]
    fn mask(bits: u32) -> Flags<N> {
        Flags(from_fn(|lane| 0_u32.wrapping_sub(bits >> lane & 1)))
    }

    #[inline(always)]
    fn select(mask: Flags<N>, yes: Self, no: Self) -> Self {
        Self(from_fn(|lane| if mask.0[lane] != 0 { yes.0[lane] } else { no.0[lane] }))
    }

    #[inline(always)]
    fn signs(self) -> u32 {
        (0..N).fold(0, |bits, lane| bits | self.0[lane].to_bits() >> 31 << lane)
    }
}

impl Isa for Portable {
    type Four = Array<4>;
    type Eight = Array<8>;
    type Sixteen = Array<16>;

    #[inline(always)]
    unsafe fn push_sorted(
        near: Array<8>,
        mask: Flags<8>,
        children: &[u32; 8],
        distances: *mut f32,
        references: *mut u32,
    ) {
        let mut bits = mask.bits();
        let mut count = 0;
        while bits != 0 {
            let child = bits.trailing_zeros() as usize;
            bits &= bits - 1;
            let mut place = count;
            // SAFETY: at most eight entries are written, and only those already written are read.
            unsafe {
                while place > 0 && *distances.add(place - 1) < near.0[child] {
                    *distances.add(place) = *distances.add(place - 1);
                    *references.add(place) = *references.add(place - 1);
                    place -= 1;
                }
                *distances.add(place) = near.0[child];
                *references.add(place) = children[child];
            }
            count += 1;
        }
    }

    #[inline(always)]
    unsafe fn push(mask: Flags<8>, children: &[u32; 8], references: *mut u32) {
        let bits = mask.bits();
        let mut count = 0;
        for (lane, child) in children.iter().enumerate() {
            // SAFETY: `count` is at most 7 here.
            unsafe { *references.add(count) = *child };
            count += (bits >> lane & 1) as usize;
        }
    }

    #[inline(always)]
    fn differing(numbers: &[u32; 4], value: u32) -> u32 {
        (0..4).fold(0, |bits, lane| bits | u32::from(numbers[lane] != value) << lane)
    }

    #[inline(always)]
    fn call<T: Task>(task: T) -> T::Output {
        run_portable(task)
    }

    #[inline(always)]
    fn prefetch<T>(_: *const T) {}
}
