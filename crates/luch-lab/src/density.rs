//! Densities looked at: where samples fall, what they weigh, and how much a good density, or several, saves.
//!
//! | | |
//! |---|---|
//! | a density over the square, its samples and weights | [`square_sheet`], [`square_fit`] |
//! | the best width of a normal density | [`normal_scan`] |
//! | two densities at once | [`mis`] |
//! | something similar with a known integral | [`control_variate`] |
//! | how often to go on | [`TwoStages`] |
//! | many dimensions | [`dimensions`] |

mod control;
mod dimensions;
mod mis;
mod roulette;
mod scan;

pub use control::{ControlVariate, control_figure, control_variate};
pub use dimensions::{DimensionRow, DimensionStudy, Rule, dimension_integral, dimensions, dimensions_figure};
pub use mis::{Mis, MisRow, MisWeights, mis};
pub use roulette::{TwoStages, stages_figure};
pub use scan::{Scan, ScanRow, normal_scan};

use crate::figure::{Figure, Ink, Mark, Raster, Sheet};
use crate::integral::{Density, Domain, Points, TextError};
use luch_sampling::check::{Area, DensityFit, FitSettings, density_fit};

/// The density of lecture point 13: denser in the middle of the unit square.
pub const CENTERED: &str = "truncated(0.5, 0.18)";

/// Three pictures of a density over the unit square: the density itself, samples, and samples with their weights as areas. A
/// sample in a sparse place weighs more.
///
/// # Errors
///
/// The text is no density of the square's axes `x` and `y`.
pub fn square_sheet(density: &str, points: &dyn Points, count: usize) -> Result<Sheet, TextError> {
    let (domain, density_text) = (Domain::parse("x=0..1,y=0..1")?, density);
    let density = Density::parse(density_text, &domain)?;
    let count = count.min(100_000);
    let mut uniform = vec![0.0; 2 * count];
    points.fill(0, 0, 2, &mut uniform);
    let mut places = Vec::with_capacity(count);
    let mut weights = Vec::with_capacity(count);
    for u in uniform.chunks(2) {
        let mut place = [0.0; 2];
        let pdf = density.draw(u, &domain, &mut place);
        if domain.contains(&place) {
            places.push(place);
            weights.push(1.0 / pdf);
        }
    }
    let raster = Raster::of_function(128, |x, y| density.pdf(&[x, y], &domain));
    // As much ink for many points as for few.
    let size = (180.0 / (count.max(1) as f64).sqrt()).clamp(1.2, 7.0);
    let mean = weights.iter().sum::<f64>() / count.max(1) as f64;
    let figures = vec![
        Figure::unit_square("The density").heat("", raster),
        Figure::unit_square(format!("{} samples", places.len())).points(
            "",
            Ink::Blue,
            places.clone(),
            size.min(3.5),
        ),
        Figure::unit_square("Weight as area").with(
            "",
            Ink::Vermilion,
            Mark::Weighted { points: places, weights, size },
        ),
    ];
    Ok(Sheet::new(format!("Importance sampling of the square by {density_text}"), 3, figures).with_caption(format!(
        "Samples crowd where the density is great and weigh little there; the mean weight, which estimates the area 1 without bias, is {mean:.4}."
    )))
}

/// The χ² test of a density over the unit square against its own samples; what falls outside the square is a cell of its own.
///
/// # Errors
///
/// The text is no density of the square's axes `x` and `y`.
pub fn square_fit(density: &str, settings: FitSettings) -> Result<DensityFit, TextError> {
    let domain = Domain::parse("x=0..1,y=0..1")?;
    let density = Density::parse(density, &domain)?;
    let draw = |u: [f32; 4]| {
        let mut place = [0.0; 2];
        density.draw(&[f64::from(u[0]), f64::from(u[1])], &domain, &mut place);
        Some(place)
    };
    Ok(density_fit(Area::UNIT_SQUARE, settings, draw, |place| density.pdf(&place, &domain)))
}

/// The integral of a function over a range by Gauss and Legendre, five points in each of `cells` cells.
pub(crate) fn quadrature(low: f64, high: f64, cells: u32, function: impl Fn(f64) -> f64) -> f64 {
    // Abramowitz and Stegun, table 25.4.
    const NODES: [[f64; 2]; 5] = [
        [0.0, 0.568_888_888_888_888_9],
        [0.538_469_310_105_683_1, 0.478_628_670_499_366_47],
        [-0.538_469_310_105_683_1, 0.478_628_670_499_366_47],
        [0.906_179_845_938_664, 0.236_926_885_056_189_08],
        [-0.906_179_845_938_664, 0.236_926_885_056_189_08],
    ];
    let half = 0.5 * (high - low) / f64::from(cells);
    let cell = |i: u32| {
        let middle = low + half * f64::from(2 * i + 1);
        NODES.iter().map(|[x, weight]| weight * function(middle + half * x)).sum::<f64>()
    };
    (0..cells).map(cell).sum::<f64>() * half
}

#[cfg(test)]
mod tests;
