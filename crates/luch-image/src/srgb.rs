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

/// Linear light of a stored number of 16 bits.
pub fn decode_u16(stored: u16) -> f32 {
    static TABLE: LazyLock<Vec<f32>> =
        LazyLock::new(|| (0..=u16::MAX).map(|i| decode(f32::from(i) / 65535.0)).collect());
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
    // Place i holds the least light whose byte is above i, found by halving the interval of bit patterns (they are
    // ordered like the positive numbers they stand for).
    static STEPS: LazyLock<[f32; 255]> = LazyLock::new(|| {
        std::array::from_fn(|byte| {
            let (mut low, mut high) = (0, 1.0f32.to_bits());
            while low < high {
                let middle = low.midpoint(high);
                if round_u8(f32::from_bits(middle)) > byte as u8 { high = middle } else { low = middle + 1 }
            }
            f32::from_bits(low)
        })
    });
    STEPS.partition_point(|&step| step <= linear) as u8
}

fn round_u8(linear: f32) -> u8 {
    (encode(linear) * 255.0 + 0.5) as u8
}

/// Stored number of 16 bits of linear light, rounded to nearest.
pub fn encode_u16(linear: f32) -> u16 {
    (encode(linear) * 65535.0 + 0.5) as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_stored_number_comes_back() {
        for byte in 0..=u8::MAX {
            assert_eq!(encode_u8(decode_u8(byte)), byte);
        }
        for number in 0..=u16::MAX {
            assert_eq!(encode_u16(decode_u16(number)), number);
        }
    }

    /// Values of the standard's formula in double precision.
    #[test]
    fn known_values() {
        assert!((decode_u8(128) - 0.215_860_5).abs() < 1e-6);
        assert!((encode(0.18) - 0.461_356_13).abs() < 1e-6);
        assert_eq!([encode(-1.0), encode(f32::NAN), encode(2.0)], [0.0, 0.0, 1.0]);
    }

    #[test]
    fn the_table_of_steps_rounds_like_the_formula() {
        let mut bits = 0;
        while f32::from_bits(bits) <= 1.1 {
            let linear = f32::from_bits(bits);
            assert_eq!(encode_u8(linear), round_u8(linear), "{linear}");
            bits += 10_007;
        }
        for linear in [-1.0, -0.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            assert_eq!(encode_u8(linear), round_u8(linear), "{linear}");
        }
    }
}
