//! One pixel: three mantissas with a shared exponent.

use crate::Rgb;

/// The light of a stored pixel. Mantissas count 256ths, without the half step that some readers add, so that a
/// decoded picture is written again with the same bytes.
pub(super) fn decode([r, g, b, exponent]: [u8; 4]) -> Rgb {
    if exponent == 0 {
        return Rgb::BLACK;
    }
    // Exact; subnormal for the least exponents.
    let step = libm::ldexpf(1.0, i32::from(exponent) - 136);
    Rgb::new(f32::from(r), f32::from(g), f32::from(b)) * step
}

/// The nearest stored pixel, ties upwards; negative and NaN channels are 0, light above 2^127·255/256 is that.
pub(super) fn encode(light: Rgb) -> [u8; 4] {
    let light = light.map(|v| if v > 0.0 { v.min(f32::MAX) } else { 0.0 });
    let largest = light.max_channel();
    // Below this, even the smallest exponent gives mantissa 0; its numbers are subnormal too, where the exponent cannot be read off.
    if largest < f32::MIN_POSITIVE {
        return [0; 4];
    }
    // largest = m · 2^exponent with m in [1/2, 1).
    let mut exponent = (largest.to_bits() >> 23) as i32 - 126;
    if libm::ldexpf(largest, 8 - exponent) + 0.5 >= 256.0 {
        exponent += 1;
    }
    if exponent > 127 {
        let clipped = light.map(|v| (libm::ldexpf(v, -119) + 0.5).min(255.0));
        return [clipped.r as u8, clipped.g as u8, clipped.b as u8, 255];
    }
    let mantissa = light.map(|v| libm::ldexpf(v, 8 - exponent) + 0.5);
    [mantissa.r as u8, mantissa.g as u8, mantissa.b as u8, (exponent + 128) as u8]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_pixels() {
        assert_eq!(encode(Rgb::WHITE), [128, 128, 128, 129]);
        assert_eq!(decode([128, 64, 0, 129]), Rgb::new(1.0, 0.5, 0.0));
        assert_eq!(encode(Rgb::new(f32::NAN, -1.0, 0.0)), [0; 4]);
        assert_eq!(encode(Rgb::new(f32::INFINITY, 1.0, 0.0)), [255, 0, 0, 255]);
        // 255.9/256 rounds up to the next exponent.
        assert_eq!(encode(Rgb::gray(255.9 / 256.0)), [128, 128, 128, 129]);
    }

    #[test]
    fn every_normal_pixel_is_kept() {
        for exponent in 3..=255u8 {
            for mantissa in 128..=255u8 {
                let pixel = [mantissa, mantissa / 2, 0, exponent];
                assert_eq!(encode(decode(pixel)), pixel);
            }
        }
    }
}
