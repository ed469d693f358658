//! Monte Carlo without a picture: points → warps → densities → estimates.
//!
//! An integral is a mean: draw points, divide each value by the density of its point, average. This crate holds what that
//! takes, each with the known answers it is tested against.
//!
//! | Step | Here |
//! |---|---|
//! | points of the unit cube | [`Sampler`] deals groups of four numbers; [`Sequence`] says where they come from |
//! | onto discs, spheres, triangles | [`warp`], turned about a normal by [`Frame`] |
//! | by a table | [`Alias`], [`Piecewise1d`], [`Piecewise2d`] |
//! | several techniques at once | [`mis`] |
//! | the mean and its error bar | [`Estimate`], which merges exactly |
//! | is it right? | [`check`]: χ², uniformity, nets, discrepancy, slopes |
//!
//! π from the points that fall into a disc, with an honest error bar:
//!
//! ```
//! use luch_sampling::{Domain, Estimate, Sampler, Sequence};
//!
//! // One mean for each of 16 independent randomisations of a thousand Sobol' points.
//! let estimate: Estimate = (0..16)
//!     .map(|pixel| {
//!         let points = (0..1024).map(|i| Sampler::at(Sequence::Sobol, 1, [pixel, 0], 2 * i).group(Domain::new(0, 0)));
//!         let inside = points.filter(|u| (u[0] - 0.5) * (u[0] - 0.5) + (u[1] - 0.5) * (u[1] - 0.5) <= 0.25).count();
//!         4.0 * inside as f64 / 1024.0
//!     })
//!     .collect();
//! assert!(estimate.z_score(std::f64::consts::PI).unwrap().abs() < 4.0);
//! assert!(estimate.standard_error().unwrap() < 0.01);
//! ```
//!
//! Everything is a pure function of its arguments and gives the same bits on every machine: no generator has a state, and
//! no mathematics of the platform is used.

pub mod check;
pub mod distribution;
pub mod estimate;
pub mod frame;
pub mod hash;
pub mod lanes;
pub mod mis;
pub mod sampler;
pub mod sequence;
pub mod trig;
pub mod warp;

pub use distribution::DistributionError;
pub use distribution::alias::{Alias, Picked};
pub use distribution::piecewise1d::{Piecewise1d, Sampled1d};
pub use distribution::piecewise2d::{Piecewise2d, Sampled2d};
pub use estimate::{Estimate, Interval};
pub use frame::Frame;
pub use sampler::{Domain, Sampler};
pub use sequence::Sequence;
