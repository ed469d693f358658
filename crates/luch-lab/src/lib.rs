//! A Monte Carlo laboratory: generators and samplers measured, integrals with known truth, densities, and figures of all of it.
//!
//! | Question | Here |
//! |---|---|
//! | Where do random numbers come from, and are they any good? | [`generator`], [`generator::quality`] |
//! | Where do points come from? | [`points`]: 22 rules in up to 64 dimensions |
//! | How evenly do they lie? | [`measure`]: discrepancies, dispersion, spectra, nets |
//! | How fast does the error fall? | [`slopes`] |
//! | What is the integral of a formula, and how sure is that? | [`integral`]: densities, convergence, a stopping rule |
//! | What is Monte Carlo first tried on? | [`problem`]: problems with known answers |
//! | What does a density do? | [`density`]: pictures, weights, widths, several at once |
//! | Why is this pixel as it is? | [`explain`]: its paths, by depth, lamp and technique |
//! | What does one point in each cell leave of the variance? | [`strata`] |
//! | Which lamps of a scene does a point see, and how much light comes from them? | [`direct_light`] |
//! | Does a routine draw what its density says? | [`chi_squared`]: all of the renderer's |
//! | Does the renderer find radiance that is known? | [`truth`]: scenes with closed forms, judged |
//! | What do samplers do to pictures, and do pictures state their error rightly? | [`rendering`] |
//! | How far are two pictures apart for those who look? | [`flip`] |
//! | How does it look? | [`figure`]: SVG, PNG, terminal, CSV, JSON; [`report`]: a page of HTML |
//!
//! The area of a disc by scrambled Sobol' points, and how even they are beside independent ones:
//!
//! ```
//! use luch_lab::measure::l2_star;
//! use luch_lab::points::Rule;
//!
//! let sobol = Rule::SobolOwen.points(1024, 2, 1, 0)?;
//! let inside = sobol.iter().filter(|p| (p[0] - 0.5).powi(2) + (p[1] - 0.5).powi(2) <= 0.25).count();
//! assert!((4.0 * inside as f64 / 1024.0 - std::f64::consts::PI).abs() < 0.05);
//!
//! let independent = Rule::from_name("independent").unwrap().points(1024, 2, 1, 0)?;
//! assert!(l2_star(&sobol) < l2_star(&independent) / 5.0);
//! # Ok::<(), luch_lab::points::PointsError>(())
//! ```
//!
//! Everything is a function of its arguments and the same on every machine and any number of threads.

pub mod chi_squared;
pub mod density;
pub mod direct_light;
pub mod explain;
pub mod figure;
pub mod flip;
pub mod generator;
pub mod integral;
pub mod measure;
pub mod points;
pub mod problem;
pub mod rendering;
pub mod report;
pub mod slopes;
pub mod strata;
pub mod truth;

/// The README's example, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExample;
