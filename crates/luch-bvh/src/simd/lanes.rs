//! What kernels ask of a level: numbers side by side, and a few whole steps.

use super::level::Task;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

/// One answer for each lane.
pub(crate) trait Mask:
    Copy + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self>
{
    /// Lane `i` as bit `i`; all higher bits zero.
    fn bits(self) -> u32;
}

/// `N` numbers side by side. All operations round as the scalar ones do, none is fused.
pub(crate) trait Lanes<const N: usize>:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    type Mask: Mask;

    fn splat(value: f32) -> Self;
    fn load(values: &[f32; N]) -> Self;
    fn to_array(self) -> [f32; N];
    fn abs(self) -> Self;
    /// Per lane the larger; `self` where `value` is not a number. As [`larger`](crate::slab::larger).
    fn larger(self, value: Self) -> Self;
    /// Per lane the smaller; `self` where `value` is not a number.
    fn smaller(self, value: Self) -> Self;
    fn below(self, other: Self) -> Self::Mask;
    fn at_most(self, other: Self) -> Self::Mask;
    fn equals(self, other: Self) -> Self::Mask;
    /// The lanes of the lowest `N` bits.
    fn mask(bits: u32) -> Self::Mask;
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// A bit for each lane with a minus sign, whatever the number.
    fn signs(self) -> u32;

    /// The least of all lanes, none of which may be missing a number.
    #[inline(always)]
    fn least(self) -> f32 {
        self.to_array()
            .into_iter()
            .fold(f32::INFINITY, |least, value| if value < least { value } else { least })
    }

    /// The greatest of all lanes, none of which may be missing a number.
    #[inline(always)]
    fn most(self) -> f32 {
        self.to_array()
            .into_iter()
            .fold(f32::NEG_INFINITY, |most, value| if value > most { value } else { most })
    }
}

/// A level as kernels see it.
pub(crate) trait Isa: Copy {
    type Four: Lanes<4>;
    type Eight: Lanes<8>;
    type Sixteen: Lanes<16>;

    /// Writes the children whose bits are set, the farthest first, and as many `near` beside them, rounded down by up to
    /// seven units in the last place. Writes eight entries in any case. Of more than four the order may be less than right.
    ///
    /// # Safety
    ///
    /// Eight entries must be writable at both places. `near` must not be negative where the bit is set.
    unsafe fn push_sorted(
        near: Self::Eight,
        mask: <Self::Eight as Lanes<8>>::Mask,
        children: &[u32; 8],
        distances: *mut f32,
        references: *mut u32,
    );

    /// Writes the children whose bits are set, in any order. Writes eight entries in any case.
    ///
    /// # Safety
    ///
    /// Eight entries must be writable.
    unsafe fn push(mask: <Self::Eight as Lanes<8>>::Mask, children: &[u32; 8], references: *mut u32);

    /// How many of the last entries of the window exceed the bound: 8 if all do.
    #[inline(always)]
    fn stale(window: &[f32; 8], bound: f32) -> u32 {
        let fresh = Self::Eight::load(window).at_most(Self::Eight::splat(bound)).bits();
        (fresh << 24 | 0x0080_0000).leading_zeros()
    }

    /// A bit for each number that is not `value`.
    fn differing(numbers: &[u32; 4], value: u32) -> u32;

    /// Runs a task in a function of its own that is compiled for this level. What is merely not inlined would be compiled for
    /// all processors, each vector operation a call.
    fn call<T: Task>(task: T) -> T::Output;

    /// Asks for a cache line that will soon be read. Any address will do.
    fn prefetch<T>(address: *const T);
}
