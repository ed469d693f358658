//! Progressive, deterministic light transport

pub mod bsdf;
pub use bsdf::{Bsdf, BsdfSample};
