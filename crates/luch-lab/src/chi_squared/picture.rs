//! Samples, density and difference side by side.

use super::{Draw, Pdf};
use crate::figure::{Axis, ColorMap, Figure, Ink, Raster, Sheet};
use luch_sampling::check::{Area, FitSettings, density_grid};

/// Cells a side.
const SIDE: usize = 48;

/// Fewer expected samples than this tell nothing of a cell by itself.
const TOO_FEW: f64 = 20.0;

pub(super) fn places(
    title: String,
    area: Area,
    axes: [&str; 2],
    settings: FitSettings,
    draw: &Draw,
    pdf: &Pdf,
) -> Option<Sheet> {
    let grid = density_grid(area, SIDE, settings, draw, pdf)?;
    let cell = grid.area.size() / (SIDE * SIDE) as f64;
    let scale = 1.0 / (settings.samples as f64 * cell);
    let observed: Vec<f64> = grid.observed.iter().map(|&count| count as f64 * scale).collect();
    let expected: Vec<f64> = grid.expected.iter().map(|count| count * scale).collect();
    let difference = grid.observed.iter().zip(&grid.expected).map(|(&count, &expected)| {
        if expected >= TOO_FEW { count as f64 / expected - 1.0 } else { f64::NAN }
    });
    let difference: Vec<f64> = difference.collect();
    let greatest = observed.iter().chain(&expected).copied().fold(0.0, f64::max);
    let widest = difference.iter().filter(|x| x.is_finite()).fold(0.02f64, |most, x| most.max(x.abs()));
    let told: Vec<f64> = grid.expected.iter().copied().filter(|count| *count >= TOO_FEW).collect();
    let noise = (told.iter().map(|count| 1.0 / count).sum::<f64>() / told.len().max(1) as f64).sqrt();
    // A lobe with long tails is seen by its logarithm only.
    let middle = expected.iter().sum::<f64>() / expected.len() as f64;
    let is_peaked = greatest > 20.0 * middle;
    let ends = if is_peaked { [1e-4 * greatest, greatest] } else { [0.0, greatest] };
    let panel = |title: &str, values: Vec<f64>, range: [f64; 2], map: ColorMap| {
        let raster = Raster {
            is_logarithmic: is_peaked && map == ColorMap::Night,
            low: grid.area.low,
            high: grid.area.high,
            range: Some(range),
            map,
            ..Raster::unit_square(SIDE, values)
        };
        Figure::new(title)
            .with_x(Axis::linear(axes[0]).with_range(grid.area.low[0], grid.area.high[0]))
            .with_y(Axis::linear(axes[1]).with_range(grid.area.low[1], grid.area.high[1]))
            .heat("", raster)
    };
    let figures = vec![
        panel("Samples", observed, ends, ColorMap::Night),
        panel("Stated density, integrated", expected, ends, ColorMap::Night),
        panel("Samples over density − 1", difference, [-widest, widest], ColorMap::Signed),
    ];
    Some(Sheet::new(title, 3, figures).with_caption(format!(
        "{} samples in {SIDE} × {SIDE} cells. To the right only chance should be seen: about ±{:.1} % of a cell, without any shape. Cells of fewer than {TOO_FEW} expected samples are left out there.",
        settings.samples,
        100.0 * noise
    )))
}

/// Shares of things picked.
pub(super) fn choice(title: String, probabilities: &[f64], counts: &[u64], samples: u64) -> Sheet {
    let n = samples.max(1) as f64;
    let edges: Vec<f64> = (0..=probabilities.len()).map(|at| at as f64).collect();
    let shares = counts[..probabilities.len()].iter().map(|&count| count as f64 / n).collect();
    let picked = Figure::new("Shares")
        .with_x(Axis::linear("which"))
        .with_y(Axis::linear("share"))
        .bars("picked", Ink::Sky, edges.clone(), shares)
        .step("stated", Ink::Text, edges, probabilities.to_vec());
    let ratios = counts.iter().zip(probabilities).enumerate();
    let ratios = ratios.filter(|(_, (_, probability))| **probability * n >= TOO_FEW).map(
        |(place, (&count, probability))| {
            let sigma = (probability * n * (1.0 - probability)).sqrt().max(1e-300);
            [place as f64 + 0.5, (count as f64 - probability * n) / sigma]
        },
    );
    let difference = Figure::new("Difference in standard errors")
        .with_x(Axis::linear("which"))
        .with_y(Axis::linear("standard errors"))
        .points("", Ink::Vermilion, ratios.collect(), 4.0)
        .level("", 0.0);
    Sheet::new(title, 2, vec![picked, difference])
}
