//! Integer hashes the sequences are built from.
//!
//! Every hash here is a pure function of its arguments: no state runs from one number to the next, which is what lets a
//! sample be computed anywhere, in any order.

/// Odd increment of the golden-ratio Weyl sequence, 2⁶⁴ divided by the golden ratio.
pub const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// A bijection of 64 bits in which every input bit moves every output bit with probability one half.
///
/// This is variant 13 of Stafford's "Better bit mixing" (2011), the finaliser of SplitMix64. Zero maps to zero, so add
/// something to a counter before mixing it.
#[inline]
pub const fn mix64(value: u64) -> u64 {
    let v = (value ^ (value >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let v = (v ^ (v >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    v ^ (v >> 31)
}

/// Hashes two words into one. The order of the arguments counts.
#[inline]
pub const fn combine(first: u64, second: u64) -> u64 {
    mix64(mix64(first.wrapping_add(GOLDEN)).wrapping_add(second).wrapping_add(GOLDEN))
}

/// Number `position` of the stream of 64-bit words that belongs to `key`: SplitMix64 with random access.
#[inline]
pub const fn word(key: u64, position: u64) -> u64 {
    mix64(key.wrapping_add(GOLDEN.wrapping_mul(position.wrapping_add(1))))
}

/// The Laine–Karras style hash behind Owen scrambling: bit k of the result depends on bits 0..=k of `value` only.
///
/// Between two bit reversals it is a nested uniform scramble, since then each bit is flipped by a hash of the bits above
/// it. Constants from Vegdahl, "Building a better LK hash" (2021); the idea from Burley, "Practical hash-based Owen
/// scrambling" (2020).
#[inline]
pub const fn laine_karras(value: u32, seed: u32) -> u32 {
    let mut v = value;
    v ^= v.wrapping_mul(0x3d20_adea);
    v = v.wrapping_add(seed);
    v = v.wrapping_mul((seed >> 16) | 1);
    v ^= v.wrapping_mul(0x0552_6c56);
    v ^ v.wrapping_mul(0x53a2_2864)
}

/// Nested uniform (Owen) scramble in base 2 by hashing: each bit is flipped by a hash of the bits above it.
///
/// Applied to a coordinate it randomises the point and keeps its net; applied to an index it shuffles the order and maps
/// every aligned block of 2^m indices onto another aligned block of 2^m.
#[inline]
pub const fn nested_scramble(value: u32, seed: u32) -> u32 {
    laine_karras(value.reverse_bits(), seed).reverse_bits()
}

/// The 24 highest bits as a number in [0, 1): a multiple of 2⁻²⁴, exact in `f32`.
#[inline]
pub const fn unit_f32(bits: u32) -> f32 {
    (bits >> 8) as f32 * (1.0 / 16_777_216.0)
}

/// All 32 bits as a number in [0, 1): a multiple of 2⁻³².
#[inline]
pub const fn unit_f64(bits: u32) -> f64 {
    bits as f64 * (1.0 / 4_294_967_296.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mix64_moves_half_of_the_bits() {
        let mut flipped = 0u64;
        for i in 0..1000u64 {
            for bit in 0..64 {
                let v = i.wrapping_mul(GOLDEN);
                flipped += u64::from((mix64(v) ^ mix64(v ^ (1 << bit))).count_ones());
            }
        }
        // 64 000 pairs of 64 fair bits: mean 32, standard error 4/√64000.
        let mean = flipped as f64 / 64_000.0;
        assert!((mean - 32.0).abs() < 4.0 * 4.0 / 64_000f64.sqrt(), "mean {mean}");
    }

    #[test]
    fn laine_karras_bits_depend_only_on_lower_bits() {
        for i in 0..2000u32 {
            let value = i.wrapping_mul(0x9e37_79b9);
            let seed = i.wrapping_mul(0x85eb_ca6b);
            for bit in 0..32 {
                let changed = laine_karras(value, seed) ^ laine_karras(value ^ (1 << bit), seed);
                assert!(changed.trailing_zeros() == bit, "bit {bit} of {value:#x} under {seed:#x}");
            }
        }
    }

    #[test]
    fn unit_numbers_stay_below_one() {
        assert_eq!(unit_f32(0), 0.0);
        assert!(unit_f32(u32::MAX) < 1.0);
        assert!(unit_f64(u32::MAX) < 1.0);
        assert_eq!(unit_f32(1 << 31), 0.5);
    }
}
