//! A Monte Carlo laboratory: generators and samplers measured, integrals with known truth, densities, and figures of all of it.

pub mod generator;
pub mod measure;
pub mod points;
pub mod slopes;
