//! AVX-512: masks in registers of their own, sixteen lanes.
//!
//! The types are made only inside functions compiled for this level, which are entered only where the processor has it:
//! that is what makes every intrinsic below sound to call.

use super::lanes::{Isa, Lanes, Mask};
use super::level::{Task, run_avx512};
use std::arch::x86_64::*;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

/// The level.
#[derive(Clone, Copy)]
pub(crate) struct Avx512;

macro_rules! lanes {
    ($name:ident, $flags:ident, $count:literal, $vector:ty, $bits:ty, $splat:ident, $load:ident, $store:ident, $add:ident,
     $sub:ident, $mul:ident, $div:ident, $max:ident, $min:ident, $compare:ident, $blend:ident, $abs:expr, $least:expr, $most:expr,
     $signs:expr) => {
        #[derive(Clone, Copy)]
        pub(crate) struct $name($vector);

        #[derive(Clone, Copy)]
        pub(crate) struct $flags($bits);

        lanes!(@operator $name Add add $add);
        lanes!(@operator $name Sub sub $sub);
        lanes!(@operator $name Mul mul $mul);
        lanes!(@operator $name Div div $div);

        impl BitAnd for $flags {
            type Output = Self;
            #[inline(always)]
            fn bitand(self, other: Self) -> Self {
                Self(self.0 & other.0)
            }
        }

        impl BitOr for $flags {
            type Output = Self;
            #[inline(always)]
            fn bitor(self, other: Self) -> Self {
                Self(self.0 | other.0)
            }
        }

        impl Not for $flags {
            type Output = Self;
            #[inline(always)]
            fn not(self) -> Self {
                Self(!self.0 & (((1_u32 << $count) - 1) as $bits))
            }
        }

        impl Mask for $flags {
            #[inline(always)]
            fn bits(self) -> u32 {
                u32::from(self.0)
            }
        }

        impl Lanes<$count> for $name {
            type Mask = $flags;

            #[inline(always)]
            fn splat(value: f32) -> Self {
                // SAFETY: see the head of this file.
                Self(unsafe { $splat(value) })
            }

            #[inline(always)]
            fn load(values: &[f32; $count]) -> Self {
                // SAFETY: as above; the array is as long as the vector.
                Self(unsafe { $load(values.as_ptr()) })
            }

            #[inline(always)]
            fn to_array(self) -> [f32; $count] {
                let mut values = [0.0; $count];
                // SAFETY: as above.
                unsafe { $store(values.as_mut_ptr(), self.0) };
                values
            }

            #[inline(always)]
            fn abs(self) -> Self {
                // SAFETY: as above.
                Self(unsafe { $abs(self.0) })
            }

            #[inline(always)]
            fn larger(self, value: Self) -> Self {
                // SAFETY: as above. The instruction returns its second operand if either is not a number.
                Self(unsafe { $max(value.0, self.0) })
            }

            #[inline(always)]
            fn smaller(self, value: Self) -> Self {
                // SAFETY: as above.
                Self(unsafe { $min(value.0, self.0) })
            }

            #[inline(always)]
            fn below(self, other: Self) -> $flags {
                // SAFETY: as above.
                $flags(unsafe { $compare::<_CMP_LT_OQ>(self.0, other.0) })
            }

            #[inline(always)]
            fn at_most(self, other: Self) -> $flags {
                // SAFETY: as above.
                $flags(unsafe { $compare::<_CMP_LE_OQ>(self.0, other.0) })
            }

            #[inline(always)]
            fn equals(self, other: Self) -> $flags {
                // SAFETY: as above.
                $flags(unsafe { $compare::<_CMP_EQ_OQ>(self.0, other.0) })
            }

            #[inline(always)]
            fn mask(bits: u32) -> $flags {
                $flags(bits as $bits)
            }

            #[inline(always)]
            fn select(mask: $flags, yes: Self, no: Self) -> Self {
                // SAFETY: as above.
                Self(unsafe { $blend(mask.0, no.0, yes.0) })
            }

            #[inline(always)]
            fn signs(self) -> u32 {
                // SAFETY: as above.
                unsafe { u32::from($signs(self.0)) }
            }

            #[inline(always)]
            fn least(self) -> f32 {
                // SAFETY: as above.
                unsafe { $least(self.0) }
            }

            #[inline(always)]
            fn most(self) -> f32 {
                // SAFETY: as above.
                unsafe { $most(self.0) }
            }
        }
    };
    (@operator $name:ident $operator:ident $method:ident $instruction:ident) => {
        impl $operator for $name {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: see the head of this file.
                Self(unsafe { $instruction(self.0, other.0) })
            }
        }
    };
}

lanes!(
    Four,
    FourFlags,
    4,
    __m128,
    u8,
    _mm_set1_ps,
    _mm_loadu_ps,
    _mm_storeu_ps,
    _mm_add_ps,
    _mm_sub_ps,
    _mm_mul_ps,
    _mm_div_ps,
    _mm_max_ps,
    _mm_min_ps,
    _mm_cmp_ps_mask,
    _mm_mask_blend_ps,
    |v| _mm_andnot_ps(_mm_set1_ps(-0.0), v),
    |v| _mm512_reduce_min_ps(_mm512_broadcast_f32x4(v)),
    |v| _mm512_reduce_max_ps(_mm512_broadcast_f32x4(v)),
    |v| _mm_movepi32_mask(_mm_castps_si128(v))
);
lanes!(
    Eight,
    EightFlags,
    8,
    __m256,
    u8,
    _mm256_set1_ps,
    _mm256_loadu_ps,
    _mm256_storeu_ps,
    _mm256_add_ps,
    _mm256_sub_ps,
    _mm256_mul_ps,
    _mm256_div_ps,
    _mm256_max_ps,
    _mm256_min_ps,
    _mm256_cmp_ps_mask,
    _mm256_mask_blend_ps,
    |v| _mm256_andnot_ps(_mm256_set1_ps(-0.0), v),
    |v| _mm512_reduce_min_ps(_mm512_broadcast_f32x8(v)),
    |v| _mm512_reduce_max_ps(_mm512_broadcast_f32x8(v)),
    |v| _mm256_movepi32_mask(_mm256_castps_si256(v))
);
lanes!(
    Sixteen,
    SixteenFlags,
    16,
    __m512,
    u16,
    _mm512_set1_ps,
    _mm512_loadu_ps,
    _mm512_storeu_ps,
    _mm512_add_ps,
    _mm512_sub_ps,
    _mm512_mul_ps,
    _mm512_div_ps,
    _mm512_max_ps,
    _mm512_min_ps,
    _mm512_cmp_ps_mask,
    _mm512_mask_blend_ps,
    |v| _mm512_abs_ps(v),
    |v| _mm512_reduce_min_ps(v),
    |v| _mm512_reduce_max_ps(v),
    |v| _mm512_movepi32_mask(_mm512_castps_si512(v))
);

impl Isa for Avx512 {
    type Four = Four;
    type Eight = Eight;
    type Sixteen = Sixteen;

    #[inline(always)]
    unsafe fn push_sorted(
        near: Eight,
        mask: EightFlags,
        children: &[u32; 8],
        distances: *mut f32,
        references: *mut u32,
    ) {
        // SAFETY: the level is there; the caller vouches for the places.
        unsafe {
            let lanes = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
            let whole = _mm256_set1_epi32(!7);
            // Numbers that are not negative sort as their bits do; the lowest three give way to the lane. Hits move together.
            let keys = _mm256_or_si256(_mm256_and_si256(_mm256_castps_si256(near.0), whole), lanes);
            let keys = sorted(_mm256_maskz_compress_epi32(mask.0, keys));
            let sorted = _mm256_permutevar8x32_epi32(_mm256_loadu_si256(children.as_ptr().cast()), keys);
            _mm256_storeu_si256(distances.cast(), _mm256_and_si256(keys, whole));
            _mm256_storeu_si256(references.cast(), sorted);
        }
    }

    #[inline(always)]
    unsafe fn push(mask: EightFlags, children: &[u32; 8], references: *mut u32) {
        // SAFETY: as above.
        unsafe {
            let children = _mm256_loadu_si256(children.as_ptr().cast());
            _mm256_storeu_si256(references.cast(), _mm256_maskz_compress_epi32(mask.0, children));
        }
    }

    #[inline(always)]
    fn differing(numbers: &[u32; 4], value: u32) -> u32 {
        // SAFETY: as above.
        unsafe {
            let numbers = _mm_loadu_si128(numbers.as_ptr().cast());
            u32::from(_mm_cmpneq_epi32_mask(numbers, _mm_set1_epi32(value as i32)))
        }
    }

    #[inline(always)]
    fn call<T: Task>(task: T) -> T::Output {
        // SAFETY: the level is there.
        unsafe { run_avx512(task) }
    }

    #[inline(always)]
    fn prefetch<T>(address: *const T) {
        // SAFETY: a hint reads nothing the program could see.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(address.cast()) };
    }
}

/// Sorts the lower four keys and the upper four, the greatest first: the bitonic network of Batcher (1968), in which each lane
/// meets the one whose number differs in the given bits, and the lane with the lower number keeps the greater key.
#[inline(always)]
unsafe fn sorted(keys: __m256i) -> __m256i {
    // SAFETY: the level is there.
    unsafe {
        let meet = |keys: __m256i, partners: __m256i, lower: u8| {
            _mm256_mask_max_epu32(_mm256_min_epu32(keys, partners), lower, keys, partners)
        };
        let by_1 = |keys: __m256i| meet(keys, _mm256_shuffle_epi32::<0b10_11_00_01>(keys), 0b0101_0101);
        let by_3 = |keys: __m256i| meet(keys, _mm256_shuffle_epi32::<0b00_01_10_11>(keys), 0b0011_0011);
        by_1(by_3(by_1(keys)))
    }
}
