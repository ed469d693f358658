//! How evenly points lie: discrepancies, empty balls and boxes, spectra, elementary intervals.

mod discrepancy;
mod dispersion;
mod net;
mod spectrum;
mod star;
#[cfg(test)]
mod tests;

pub use discrepancy::{centred_squared, l2_star, l2_star_squared, wrap_around_squared};
pub use dispersion::{EmptyBall, EmptyBox, largest_empty_ball, largest_empty_box_2d, least_distance};
pub use net::{PairQuality, pair_qualities, quality};
pub use spectrum::{Ring, Spectrum, power, spectrum};
pub use star::star_discrepancy_2d;
