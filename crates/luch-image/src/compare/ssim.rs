//! Structural similarity.

use super::{SizeMismatch, check_sizes};
use crate::sum::Sum;
use crate::{Image, Rgb, srgb};

/// Side of the window; its Gaussian has a standard deviation of 1.5 pixels, as in the paper.
const WINDOW: usize = 11;
const DEVIATION: f64 = 1.5;

/// (0.01)² and (0.03)² for values up to 1: what keeps the ratios of small numbers quiet.
const C1: f64 = 1e-4;
const C2: f64 = 9e-4;

/// Mean structural similarity of the luminance as shown (clipped and sRGB-encoded), over all windows of 11×11 that lie
/// wholly in the picture: 1 for equal pictures, near 0 for unrelated ones. `None` if no window fits.
///
/// # Errors
/// [`SizeMismatch`] if the sizes differ.
pub fn ssim(a: &Image<Rgb>, b: &Image<Rgb>) -> Result<Option<f64>, SizeMismatch> {
    check_sizes(a, b)?;
    let (width, height) = (a.width() as usize, a.height() as usize);
    if width < WINDOW || height < WINDOW {
        return Ok(None);
    }
    let weights = gaussian();
    let plane = |image: &Image<Rgb>| -> Vec<f64> {
        image.pixels().iter().map(|light| f64::from(srgb::encode(light.luminance()))).collect()
    };
    let (a, b) = (plane(a), plane(b));
    let product = |x: &[f64], y: &[f64]| -> Vec<f64> { x.iter().zip(y).map(|(x, y)| x * y).collect() };
    let blur = |plane: &[f64]| blur(plane, width, &weights);
    let (mean_a, mean_b) = (blur(&a), blur(&b));
    let (square_a, square_b, cross) =
        (blur(&product(&a, &a)), blur(&product(&b, &b)), blur(&product(&a, &b)));
    let mut sum = Sum::default();
    for i in 0..mean_a.len() {
        let (mu_a, mu_b) = (mean_a[i], mean_b[i]);
        let (variance_a, variance_b) = (square_a[i] - mu_a * mu_a, square_b[i] - mu_b * mu_b);
        let covariance = cross[i] - mu_a * mu_b;
        sum.add(
            (2.0 * mu_a * mu_b + C1) * (2.0 * covariance + C2)
                / ((mu_a * mu_a + mu_b * mu_b + C1) * (variance_a + variance_b + C2)),
        );
    }
    Ok(Some(sum.value() / mean_a.len() as f64))
}

fn gaussian() -> [f64; WINDOW] {
    let weights: [f64; WINDOW] = std::array::from_fn(|i| {
        let x = (i as f64 - (WINDOW / 2) as f64) / DEVIATION;
        libm::exp(-0.5 * x * x)
    });
    let total: f64 = weights.iter().sum();
    weights.map(|weight| weight / total)
}

/// Weighted means over all whole windows: along rows, then along columns.
fn blur(plane: &[f64], width: usize, weights: &[f64; WINDOW]) -> Vec<f64> {
    let inner = width - WINDOW + 1;
    let rows: Vec<f64> = plane
        .chunks_exact(width)
        .flat_map(|row| {
            row.windows(WINDOW).map(|window| window.iter().zip(weights).map(|(v, w)| v * w).sum::<f64>())
        })
        .collect();
    (0..rows.len() / inner - (WINDOW - 1))
        .flat_map(|y| (0..inner).map(move |x| (x, y)))
        .map(|(x, y)| weights.iter().enumerate().map(|(i, w)| rows[(y + i) * inner + x] * w).sum::<f64>())
        .collect()
}
