//! The chance by which a number between two bytes is rounded up.

/// A number in [0, 1) that looks independent for each pixel and channel. Each coordinate goes through the finaliser of
/// MurmurHash3 (Austin Appleby, 2008).
pub(super) fn threshold(x: u32, y: u32, channel: u32) -> f32 {
    let hash = finish(finish(finish(x ^ 0x9e37_79b9).wrapping_add(y)).wrapping_add(channel));
    // 24 bits are exact in an `f32`; the largest stays below 1.
    (hash >> 8) as f32 / 16_777_216.0
}

fn finish(mut bits: u32) -> u32 {
    bits ^= bits >> 16;
    bits = bits.wrapping_mul(0x85eb_ca6b);
    bits ^= bits >> 13;
    bits = bits.wrapping_mul(0xc2b2_ae35);
    bits ^ (bits >> 16)
}
