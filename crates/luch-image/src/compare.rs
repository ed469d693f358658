//! How far two pictures are apart.
//!
//! Measures follow Celarek, Jakob, Wimmer, Lehtinen, "Quantifying the error of light transport algorithms" (2019); SSIM
//! is Wang, Bovik, Sheikh, Simoncelli, "Image quality assessment: from error visibility to structural similarity" (2004).

mod difference;
mod ssim;

pub use difference::{absolute_difference, difference, false_color, false_difference};
pub use ssim::ssim;

use crate::sum::Sum;
use crate::{Image, Rgb, srgb};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// What is added to the squared reference in the relative error, so that black counts.
pub const RELATIVE_EPSILON: f64 = 1e-2;

/// Of this many pixels the worst one is left out of the trimmed relative error.
pub const TRIM_ONE_OF: usize = 1000;

/// Two pictures of different sizes cannot be compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("pictures of {}×{} and {}×{} pixels cannot be compared: the sizes must be equal", .a[0], .a[1], .b[0], .b[1])]
pub struct SizeMismatch {
    /// Width and height of the first picture.
    pub a: [u32; 2],
    /// Width and height of the second picture.
    pub b: [u32; 2],
}

/// A place where two pictures differ.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Place {
    /// Column.
    pub x: u32,
    /// Row from the top.
    pub y: u32,
    /// The largest absolute difference of a channel.
    pub difference: f64,
}

/// The distance of a picture `a` from a reference `b`, over all channels of the pixels that are finite in both; all
/// means are 0 if there are none.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// Mean squared difference of linear light.
    pub mse: f64,
    /// Its root.
    pub rmse: f64,
    /// Mean absolute difference of linear light.
    pub mae: f64,
    /// Mean of (a − b)² / (b² + [`RELATIVE_EPSILON`]).
    pub relative_mse: f64,
    /// The same without the worst 0.1 % of the pixels (a count rounded down).
    pub relative_mse_trimmed: f64,
    /// Peak signal to noise in decibel of sRGB-encoded values clipped to 0 to 1, as they would be shown; infinite for
    /// equal pictures.
    pub psnr: f64,
    /// Structural similarity of shown luminance, 1 for equal pictures; `None` below 11×11 pixels or if a pixel is not
    /// finite.
    pub ssim: Option<f64>,
    /// Mean of each channel of `a`.
    pub mean_a: [f64; 3],
    /// Mean of each channel of `b`.
    pub mean_b: [f64; 3],
    /// The first of the places of largest difference; `None` if no pixel is finite.
    pub largest: Option<Place>,
    /// Pixels with an infinite or NaN channel in either picture.
    pub non_finite: u64,
}

/// Compares a picture with a reference.
///
/// # Errors
/// [`SizeMismatch`] if their sizes differ.
pub fn compare(a: &Image<Rgb>, b: &Image<Rgb>) -> Result<Comparison, SizeMismatch> {
    check_sizes(a, b)?;
    let mut squared = Sum::default();
    let mut absolute = Sum::default();
    let mut shown = Sum::default();
    let (mut mean_a, mut mean_b) = ([Sum::default(); 3], [Sum::default(); 3]);
    let mut relative = Vec::with_capacity(a.pixels().len());
    let mut largest: Option<Place> = None;
    for (index, (a_pixel, b_pixel)) in a.pixels().iter().zip(b.pixels()).enumerate() {
        if !(a_pixel.is_finite() && b_pixel.is_finite()) {
            continue;
        }
        let (mut pixel_relative, mut pixel_largest) = (0.0, 0.0f64);
        let (a_channels, b_channels) = (a_pixel.to_array(), b_pixel.to_array());
        for (channel, (sum_a, sum_b)) in mean_a.iter_mut().zip(&mut mean_b).enumerate() {
            let (value, reference) = (a_channels[channel], b_channels[channel]);
            let on_screen = f64::from(srgb::encode(value)) - f64::from(srgb::encode(reference));
            let (value, reference) = (f64::from(value), f64::from(reference));
            let error = value - reference;
            squared.add(error * error);
            absolute.add(error.abs());
            shown.add(on_screen * on_screen);
            sum_a.add(value);
            sum_b.add(reference);
            pixel_relative += error * error / (reference * reference + RELATIVE_EPSILON) / 3.0;
            pixel_largest = pixel_largest.max(error.abs());
        }
        relative.push(pixel_relative);
        if largest.is_none_or(|place| pixel_largest > place.difference) {
            let index = index as u32;
            largest = Some(Place { x: index % a.width(), y: index / a.width(), difference: pixel_largest });
        }
    }

    // Sums into means.
    let pixels = relative.len();
    let channels = (3 * pixels).max(1) as f64;
    let mse = squared.value() / channels;
    relative.sort_unstable_by(f64::total_cmp);
    let kept = pixels - pixels / TRIM_ONE_OF;
    let non_finite = (a.pixels().len() - pixels) as u64;
    Ok(Comparison {
        mse,
        rmse: mse.sqrt(),
        mae: absolute.value() / channels,
        relative_mse: mean(&relative),
        relative_mse_trimmed: mean(&relative[..kept]),
        psnr: -10.0 * libm::log10(shown.value() / channels),
        ssim: if non_finite == 0 { ssim(a, b)? } else { None },
        mean_a: mean_a.map(|sum| sum.value() / pixels.max(1) as f64),
        mean_b: mean_b.map(|sum| sum.value() / pixels.max(1) as f64),
        largest,
        non_finite,
    })
}

fn mean(values: &[f64]) -> f64 {
    let mut sum = Sum::default();
    values.iter().for_each(|&value| sum.add(value));
    sum.value() / values.len().max(1) as f64
}

fn check_sizes(a: &Image<Rgb>, b: &Image<Rgb>) -> Result<(), SizeMismatch> {
    let (a, b) = ([a.width(), a.height()], [b.width(), b.height()]);
    if a == b { Ok(()) } else { Err(SizeMismatch { a, b }) }
}

#[cfg(test)]
mod tests;
