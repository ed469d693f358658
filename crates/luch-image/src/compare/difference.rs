//! The difference of two pictures as a picture.

use super::{SizeMismatch, check_sizes};
use crate::{Image, Rgb, srgb};

/// `a − b`, channel by channel, with its sign.
///
/// # Errors
/// [`SizeMismatch`] if the sizes differ.
pub fn difference(a: &Image<Rgb>, b: &Image<Rgb>) -> Result<Image<Rgb>, SizeMismatch> {
    check_sizes(a, b)?;
    let mut reference = b.pixels().iter();
    Ok(a.map(|&pixel| pixel - reference.next().copied().unwrap_or_default()))
}

/// `|a − b|`, channel by channel.
///
/// # Errors
/// [`SizeMismatch`] if the sizes differ.
pub fn absolute_difference(a: &Image<Rgb>, b: &Image<Rgb>) -> Result<Image<Rgb>, SizeMismatch> {
    difference(a, b).map(|signed| signed.map(|pixel| pixel.map(f32::abs)))
}

/// The mean absolute difference of the channels in false colour, `full` being white; see [`false_color`].
///
/// # Errors
/// [`SizeMismatch`] if the sizes differ.
pub fn false_difference(a: &Image<Rgb>, b: &Image<Rgb>, full: f32) -> Result<Image<Rgb>, SizeMismatch> {
    absolute_difference(a, b).map(|absolute| absolute.map(|pixel| false_color(pixel.mean() / full)))
}

/// Stored sRGB bytes at equal steps from 0 to 1: black, blue, violet, red, orange, yellow, white.
const RAMP: [[u8; 3]; 7] = [
    [0, 0, 0],
    [25, 30, 130],
    [120, 30, 150],
    [215, 50, 60],
    [250, 140, 20],
    [255, 220, 80],
    [255, 255, 255],
];

/// Linear light of a colour that stands for a number from 0 (black) to 1 (white) over blue, violet, red, orange and
/// yellow; luminance grows all the way, so the order survives a gray print. Numbers outside take the nearer end; NaN is
/// green, which is nowhere on the ramp.
pub fn false_color(value: f32) -> Rgb {
    if value.is_nan() {
        return Rgb::new(0.0, 1.0, 0.0);
    }
    let place = value.clamp(0.0, 1.0) * (RAMP.len() - 1) as f32;
    let below = (place as usize).min(RAMP.len() - 2);
    let weight = place - below as f32;
    let stored = |i: usize, channel: usize| f32::from(RAMP[i][channel]) / 255.0;
    let mixed: [f32; 3] = std::array::from_fn(|channel| {
        srgb::decode(stored(below, channel) * (1.0 - weight) + stored(below + 1, channel) * weight)
    });
    Rgb::from(mixed)
}
