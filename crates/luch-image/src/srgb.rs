//! The sRGB transfer curve (IEC 61966-2-1).

use std::sync::LazyLock;

/// Linear light of a stored number in 0 to 1.
pub fn decode(stored: f32) -> f32 {
    if stored <= 0.04045 { stored / 12.92 } else { libm::powf((stored + 0.055) / 1.055, 2.4) }
}

/// Linear light of a stored byte.
pub fn decode_u8(stored: u8) -> f32 {
    static TABLE: LazyLock<[f32; 256]> = LazyLock::new(|| std::array::from_fn(|i| decode(i as f32 / 255.0)));
    TABLE[usize::from(stored)]
}

/// Stored number, 0 to 1, of linear light; light outside 0 to 1 is clipped, NaN is 0.
pub fn encode(linear: f32) -> f32 {
    if linear.is_nan() || linear <= 0.0 {
        0.0
    } else if linear >= 1.0 {
        1.0
    } else if linear <= 0.003_130_8 {
        linear * 12.92
    } else {
        1.055 * libm::powf(linear, 1.0 / 2.4) - 0.055
    }
}

/// Stored byte of linear light, rounded to nearest.
pub fn encode_u8(linear: f32) -> u8 {
    (encode(linear) * 255.0 + 0.5) as u8
}
