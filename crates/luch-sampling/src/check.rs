//! Checks for anyone who writes a warp or a sequence.
//!
//! Each returns the statistic and a probability, never a verdict: the caller chooses the level. With T tests at an overall
//! level α compare each with [`sidak`]`(α, T)`.

mod bins;
mod chi_square;
mod cubature;
mod density_fit;
mod discrepancy;
mod net;
mod slope;
mod special;
mod uniformity;

pub use chi_square::{ChiSquare, chi_square};
pub use density_fit::{
    Area, DensityFit, DensityGrid, FitSettings, SphereMap, density_fit, density_grid, directions_match_pdf,
    square_matches_pdf,
};
pub use discrepancy::l2_star_discrepancy;
pub use net::{CrowdedBox, crowded_box};
pub use slope::{Slope, fit_slope};
pub use special::{
    chi_square_tail, regularized_beta, regularized_gamma_p, regularized_gamma_q, student_cumulative,
    student_quantile,
};
pub use uniformity::{KolmogorovSmirnov, kolmogorov_smirnov, uniformity};

/// The level for each of `tests` independent tests that together wrongly reject with probability `level` (Šidák 1967).
pub fn sidak(level: f64, tests: u32) -> f64 {
    -libm::expm1(libm::log1p(-level) / f64::from(tests.max(1)))
}
