//! Heights from images.

use glam::Vec2;
use luch_image::{Bitmap, Encoding};

use super::{HeightError, HeightField, MAX_POINTS};

/// What of a pixel is its height.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Channel {
    /// Rec. 709 luminance of the three colours; that of gray is the gray itself.
    #[default]
    Luminance,
    /// Red.
    Red,
    /// Green.
    Green,
    /// Blue.
    Blue,
    /// Alpha.
    Alpha,
}

/// A field with a point for each pixel; stored numbers of 8 and 16 bits become 0 to 1.
///
/// Heights are no light: the stored numbers are taken as they are, whatever curve the file names. Only `Encoding::Srgb`
/// asks for the sRGB curve to be undone. Values that are not finite become holes.
///
/// # Errors
/// If the image has less than 2 × 2 or too many pixels, or the size is not positive.
pub fn from_bitmap(
    bitmap: &Bitmap,
    channel: Channel,
    encoding: Encoding,
    size: Vec2,
) -> Result<HeightField, HeightError> {
    let (width, height) = (bitmap.width, bitmap.height);
    if u64::from(width) * u64::from(height) > MAX_POINTS {
        return Err(HeightError::Size { width, height });
    }
    let heights = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let heights = heights.map(|(x, y)| value_of(channel, bitmap.linear(x, y, encoding)));
    HeightField::new(width, height, heights.map(|h| if h.is_finite() { h } else { f32::NAN }).collect(), size)
}

pub(super) fn value_of(channel: Channel, [r, g, b, a]: [f32; 4]) -> f32 {
    match channel {
        Channel::Red => r,
        Channel::Green => g,
        Channel::Blue => b,
        Channel::Alpha => a,
        // Weights sum to one only up to rounding: gray must stay exact.
        Channel::Luminance if r == g && g == b => r,
        Channel::Luminance => {
            let [r, g, b] = [r, g, b].map(f64::from);
            (0.2126 * r + 0.7152 * g + 0.0722 * b) as f32
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use luch_image::Pixels;

    #[test]
    fn sixteen_bits_stay_apart() {
        let pixels: Vec<[u16; 4]> = (0..4u16).map(|k| [30000 + k; 4]).collect();
        let bitmap = Bitmap {
            width: 2,
            height: 2,
            pixels: Pixels::U16(pixels),
            encoding: Encoding::Srgb,
            has_alpha: false,
        };
        let field = from_bitmap(&bitmap, Channel::Luminance, Encoding::Linear, Vec2::ONE).unwrap();
        for (k, height) in field.heights.iter().enumerate() {
            assert_eq!(*height, (30000 + k) as f32 / 65535.0);
        }
        let curved = from_bitmap(&bitmap, Channel::Red, Encoding::Srgb, Vec2::ONE).unwrap();
        assert!((curved.heights[0] - luch_image::srgb::decode(30000.0 / 65535.0)).abs() < 1e-6);
    }

    #[test]
    fn channels_and_holes() {
        let pixels = vec![
            [1.0, 0.0, 0.0, 0.5],
            [0.0, 1.0, 0.0, 0.5],
            [0.0, 0.0, 1.0, 0.5],
            [f32::NAN, 3.0, f32::INFINITY, 0.5],
        ];
        let bitmap = Bitmap {
            width: 2,
            height: 2,
            pixels: Pixels::F32(pixels),
            encoding: Encoding::Linear,
            has_alpha: true,
        };
        let of = |channel| from_bitmap(&bitmap, channel, Encoding::Linear, Vec2::ONE).unwrap();
        assert_eq!(of(Channel::Luminance).heights[..3], [0.2126, 0.7152, 0.0722]);
        assert_eq!(of(Channel::Green).heights, [0.0, 1.0, 0.0, 3.0]);
        assert_eq!(of(Channel::Alpha).heights, [0.5; 4]);
        assert_eq!([Channel::Red, Channel::Blue, Channel::Luminance].map(|c| of(c).hole_count()), [1; 3]);
    }
}
