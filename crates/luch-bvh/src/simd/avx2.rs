//! AVX2: eight lanes, masks as numbers.
//!
//! The types are made only inside functions compiled for this level, which are entered only where the processor has it:
//! that is what makes every intrinsic below sound to call.

use super::lanes::{Isa, Lanes, Mask};
use super::level::{Task, run_avx2};
use std::arch::x86_64::*;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

/// The level.
#[derive(Clone, Copy)]
pub(crate) struct Avx2;

macro_rules! lanes {
    ($name:ident, $flags:ident, $count:literal, $vector:ty, $splat:ident, $load:ident, $store:ident, $add:ident, $sub:ident,
     $mul:ident, $div:ident, $max:ident, $min:ident, $and:ident, $or:ident, $and_not:ident, $bits:ident, $compare:ident,
     $blend:ident) => {
        #[derive(Clone, Copy)]
        pub(crate) struct $name($vector);

        /// All bits of a lane for yes, none for no.
        #[derive(Clone, Copy)]
        pub(crate) struct $flags($vector);

        lanes!(@operator $name Add add $add);
        lanes!(@operator $name Sub sub $sub);
        lanes!(@operator $name Mul mul $mul);
        lanes!(@operator $name Div div $div);
        lanes!(@operator $flags BitAnd bitand $and);
        lanes!(@operator $flags BitOr bitor $or);

        impl Not for $flags {
            type Output = Self;
            #[inline(always)]
            fn not(self) -> Self {
                // SAFETY: see the head of this file.
                Self(unsafe { $and_not(self.0, $splat(f32::from_bits(u32::MAX))) })
            }
        }

        impl Mask for $flags {
            #[inline(always)]
            fn bits(self) -> u32 {
                // SAFETY: as above.
                unsafe { $bits(self.0) as u32 }
            }
        }

        impl Lanes<$count> for $name {
            type Mask = $flags;

            #[inline(always)]
            fn splat(value: f32) -> Self {
                // SAFETY: as above.
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
                Self(unsafe { $and_not($splat(-0.0), self.0) })
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
                let lanes: [f32; $count] =
                    std::array::from_fn(|lane| f32::from_bits(0_u32.wrapping_sub(bits >> lane & 1)));
                // SAFETY: as above.
                $flags(unsafe { $load(lanes.as_ptr()) })
            }

            #[inline(always)]
            fn select(mask: $flags, yes: Self, no: Self) -> Self {
                // SAFETY: as above.
                Self(unsafe { $blend(no.0, yes.0, mask.0) })
            }

            #[inline(always)]
            fn signs(self) -> u32 {
                // SAFETY: as above.
                unsafe { $bits(self.0) as u32 }
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
    _mm_set1_ps,
    _mm_loadu_ps,
    _mm_storeu_ps,
    _mm_add_ps,
    _mm_sub_ps,
    _mm_mul_ps,
    _mm_div_ps,
    _mm_max_ps,
    _mm_min_ps,
    _mm_and_ps,
    _mm_or_ps,
    _mm_andnot_ps,
    _mm_movemask_ps,
    _mm_cmp_ps,
    _mm_blendv_ps
);
lanes!(
    Eight,
    EightFlags,
    8,
    __m256,
    _mm256_set1_ps,
    _mm256_loadu_ps,
    _mm256_storeu_ps,
    _mm256_add_ps,
    _mm256_sub_ps,
    _mm256_mul_ps,
    _mm256_div_ps,
    _mm256_max_ps,
    _mm256_min_ps,
    _mm256_and_ps,
    _mm256_or_ps,
    _mm256_andnot_ps,
    _mm256_movemask_ps,
    _mm256_cmp_ps,
    _mm256_blendv_ps
);

/// Sixteen lanes as two times eight.
#[derive(Clone, Copy)]
pub(crate) struct Pair<T>(T, T);

macro_rules! paired {
    ($($bound:ident $operator:ident $method:ident,)*) => {$(
        impl<T: $operator<Output = T>> $operator for Pair<T> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0), self.1.$method(other.1))
            }
        }
    )*};
}
paired!(T Add add, T Sub sub, T Mul mul, T Div div, T BitAnd bitand, T BitOr bitor,);

impl<T: Not<Output = T>> Not for Pair<T> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self(!self.0, !self.1)
    }
}

impl Mask for Pair<EightFlags> {
    #[inline(always)]
    fn bits(self) -> u32 {
        self.0.bits() | self.1.bits() << 8
    }
}

impl Lanes<16> for Pair<Eight> {
    type Mask = Pair<EightFlags>;

    #[inline(always)]
    fn splat(value: f32) -> Self {
        Self(Eight::splat(value), Eight::splat(value))
    }

    #[inline(always)]
    fn load(values: &[f32; 16]) -> Self {
        let halves = values.as_chunks::<8>().0;
        Self(Eight::load(&halves[0]), Eight::load(&halves[1]))
    }

    #[inline(always)]
    fn to_array(self) -> [f32; 16] {
        let mut values = [0.0; 16];
        values[..8].copy_from_slice(&self.0.to_array());
        values[8..].copy_from_slice(&self.1.to_array());
        values
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs(), self.1.abs())
    }

    #[inline(always)]
    fn larger(self, value: Self) -> Self {
        Self(self.0.larger(value.0), self.1.larger(value.1))
    }

    #[inline(always)]
    fn smaller(self, value: Self) -> Self {
        Self(self.0.smaller(value.0), self.1.smaller(value.1))
    }

    #[inline(always)]
    fn below(self, other: Self) -> Self::Mask {
        Pair(self.0.below(other.0), self.1.below(other.1))
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> Self::Mask {
        Pair(self.0.at_most(other.0), self.1.at_most(other.1))
    }

    #[inline(always)]
    fn equals(self, other: Self) -> Self::Mask {
        Pair(self.0.equals(other.0), self.1.equals(other.1))
    }

    #[inline(always)]
    fn mask(bits: u32) -> Self::Mask {
        Pair(Eight::mask(bits), Eight::mask(bits >> 8))
    }

    #[inline(always)]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
        Self(Eight::select(mask.0, yes.0, no.0), Eight::select(mask.1, yes.1, no.1))
    }

    #[inline(always)]
    fn signs(self) -> u32 {
        self.0.signs() | self.1.signs() << 8
    }

    #[inline(always)]
    fn least(self) -> f32 {
        self.0.smaller(self.1).least()
    }

    #[inline(always)]
    fn most(self) -> f32 {
        self.0.larger(self.1).most()
    }
}

impl Isa for Avx2 {
    type Four = Four;
    type Eight = Eight;
    type Sixteen = Pair<Eight>;

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
            // Numbers that are not negative sort as their bits do; the lowest three give way to the lane.
            let keys = _mm256_or_si256(_mm256_and_si256(_mm256_castps_si256(near.0), whole), lanes);
            let keys = sorted(_mm256_and_si256(keys, _mm256_castps_si256(mask.0)));
            let sorted = _mm256_permutevar8x32_epi32(_mm256_loadu_si256(children.as_ptr().cast()), keys);
            _mm256_storeu_si256(distances.cast(), _mm256_and_si256(keys, whole));
            _mm256_storeu_si256(references.cast(), sorted);
        }
    }

    #[inline(always)]
    unsafe fn push(mask: EightFlags, children: &[u32; 8], references: *mut u32) {
        // SAFETY: as above.
        unsafe {
            // The numbers of the lanes that are set, one byte each, moved together.
            let bytes = _pdep_u64(u64::from(mask.bits()), 0x0101_0101_0101_0101) * 0xff;
            let lanes = _pext_u64(0x0706_0504_0302_0100, bytes);
            let lanes = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(lanes as i64));
            let children = _mm256_loadu_si256(children.as_ptr().cast());
            _mm256_storeu_si256(references.cast(), _mm256_permutevar8x32_epi32(children, lanes));
        }
    }

    #[inline(always)]
    fn differing(numbers: &[u32; 4], value: u32) -> u32 {
        // SAFETY: as above.
        unsafe {
            let same =
                _mm_cmpeq_epi32(_mm_loadu_si128(numbers.as_ptr().cast()), _mm_set1_epi32(value as i32));
            _mm_movemask_ps(_mm_castsi128_ps(same)) as u32 ^ 15
        }
    }

    #[inline(always)]
    fn call<T: Task>(task: T) -> T::Output {
        // SAFETY: the level is there.
        unsafe { run_avx2(task) }
    }

    #[inline(always)]
    fn prefetch<T>(address: *const T) {
        // SAFETY: a hint reads nothing the program could see.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(address.cast()) };
    }
}

/// Sorts eight keys, the greatest first: the bitonic network of Batcher (1968), in which each lane meets the one whose
/// number differs in the given bits, and the lane with the lower number keeps the greater key.
#[inline(always)]
unsafe fn sorted(keys: __m256i) -> __m256i {
    // SAFETY: the level is there.
    unsafe {
        macro_rules! meet {
            ($keys:ident, $partners:expr, $lower:literal) => {{
                let partners = $partners;
                let (least, greatest) =
                    (_mm256_min_epu32($keys, partners), _mm256_max_epu32($keys, partners));
                _mm256_blend_epi32::<$lower>(least, greatest)
            }};
        }
        let by_1 = |keys: __m256i| meet!(keys, _mm256_shuffle_epi32::<0b10_11_00_01>(keys), 0b0101_0101);
        let by_2 = |keys: __m256i| meet!(keys, _mm256_shuffle_epi32::<0b01_00_11_10>(keys), 0b0011_0011);
        let by_3 = |keys: __m256i| meet!(keys, _mm256_shuffle_epi32::<0b00_01_10_11>(keys), 0b0011_0011);
        let backward = _mm256_setr_epi32(7, 6, 5, 4, 3, 2, 1, 0);
        let by_7 = |keys: __m256i| meet!(keys, _mm256_permutevar8x32_epi32(keys, backward), 0b0000_1111);
        by_1(by_2(by_7(by_1(by_3(by_1(keys))))))
    }
}
