//! Distributions from tables: what a distribution promises.
//!
//! `sample(u)` returns a value together with its density (or probability), and the density of the same value asked for by
//! `pdf(value)` is the same. What has no weight is never drawn, whatever the rounding; what has weight always has a
//! positive density. The densities integrate to one.

pub mod alias;
pub mod piecewise1d;
pub mod piecewise2d;

use thiserror::Error;

/// Why a table of weights is no distribution.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum DistributionError {
    /// There are no weights.
    #[error("the table of weights is empty; at least one weight is needed")]
    Empty,
    /// All weights are zero.
    #[error("all weights are zero; at least one must be positive")]
    AllZero,
    /// A weight is negative, infinite or not a number.
    #[error("weight {index} is {value}; weights must be finite and not negative")]
    BadWeight {
        /// Position of the weight in the table.
        index: usize,
        /// The weight.
        value: f32,
    },
    /// A two-dimensional table has another number of weights than its sides promise.
    #[error("a table of {width} × {height} cells was given {weights} weights")]
    WrongSize {
        /// Cells in a row.
        width: usize,
        /// Rows.
        height: usize,
        /// Weights given.
        weights: usize,
    },
    /// More cells than a position in single precision tells apart.
    #[error("the table has {cells} cells in one direction; at most 16777216 are supported")]
    TooManyCells {
        /// Cells in that direction.
        cells: usize,
    },
}

/// Checks one weight.
fn check_weight(index: usize, value: f32) -> Result<f64, DistributionError> {
    if value >= 0.0 && value.is_finite() {
        Ok(f64::from(value))
    } else {
        Err(DistributionError::BadWeight { index, value })
    }
}

/// Appends the running sum of the weights, starting after `first`, to `cumulative`; a positive weight always moves it.
fn accumulate(
    weights: &[f32],
    first_index: usize,
    cumulative: &mut Vec<f64>,
) -> Result<f64, DistributionError> {
    let mut sum = 0.0f64;
    for (offset, &weight) in weights.iter().enumerate() {
        let weight = check_weight(first_index + offset, weight)?;
        if weight > 0.0 {
            sum = (sum + weight).max(sum.next_up());
        }
        cumulative.push(sum);
    }
    Ok(sum)
}

/// A cell of a running sum, and the place within it.
#[derive(Clone, Copy, Debug)]
struct Found {
    cell: usize,
    fraction: f64,
}

/// Mass of a cell of a running sum.
fn mass(cumulative: &[f64], cell: usize) -> f64 {
    if cell == 0 { cumulative[0] } else { cumulative[cell] - cumulative[cell - 1] }
}

/// The cell that holds the share `u` in [0, 1) of the total; never one without mass. The total must be positive.
fn find(cumulative: &[f64], u: f64) -> Found {
    let total = cumulative[cumulative.len() - 1];
    // Below the total even after rounding, so some cell ends above the target; the first such cell has mass.
    let target = (u * total).max(0.0).min(total.next_down());
    let cell = cumulative.partition_point(|&end| end <= target);
    let start = if cell == 0 { 0.0 } else { cumulative[cell - 1] };
    Found { cell, fraction: (target - start) / (cumulative[cell] - start) }
}

/// The cell of [0, 1] divided into `cells` that holds `position`; the ends belong to the first and last cell.
fn cell_of(position: f32, cells: usize) -> usize {
    ((f64::from(position) * cells as f64) as usize).min(cells - 1)
}

/// The place `fraction` of the way through a cell, as a number that [`cell_of`] leads back to the same cell.
fn position_in(cell: usize, fraction: f64, cells: usize) -> f32 {
    let position = ((cell as f64 + fraction) / cells as f64) as f32;
    match cell_of(position, cells).cmp(&cell) {
        // Rounding to single precision moves by less than a cell, so one step leads back.
        std::cmp::Ordering::Greater => position.next_down(),
        std::cmp::Ordering::Less => position.next_up(),
        std::cmp::Ordering::Equal => position.min(1f32.next_down()),
    }
}

/// The most cells in one direction.
const MOST_CELLS: usize = 1 << 24;
