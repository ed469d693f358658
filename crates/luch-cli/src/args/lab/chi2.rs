//! What was typed after `luch lab chi2`.

use super::{LabOutputArgs, count};
use crate::parse;
use clap::Args;

/// Put every sampling routine of the renderer to the χ² test against its stated density
///
/// Surfaces from four angles, lamps of all shapes, sky and suns, lens and pixel filters, warps and tables. Samples are counted in bins of
/// about equal probability, over each of which the stated density is integrated. The level holds for all tests together (Šidák). The
/// figure shows the routine with the least p. Exit status 1 if one is rejected.
#[derive(Args, Debug)]
#[command(
    after_long_help = "Examples:\n  luch lab chi2\n  luch lab chi2 bsdf sun\n  luch lab chi2 conductor:2 -o conductor.png\n  luch lab chi2 planted      (densities that are wrong on purpose: what a failure looks like)"
)]
pub(crate) struct Chi2Args {
    /// all, bsdf, emitter, environment, camera, warp, table, planted, or names as in the table, with or without number
    #[arg(value_name = "NAME", default_value = "all")]
    pub(crate) names: Vec<String>,
    /// Samples of each routine
    #[arg(long, value_name = "N", default_value = "2^17", value_parser = count)]
    pub(crate) samples: u64,
    /// Bins of each routine
    #[arg(long, value_name = "N", default_value_t = 256, value_parser = clap::value_parser!(u32).range(8..=4096))]
    pub(crate) bins: u32,
    /// The chance that any right density is rejected
    #[arg(long, value_name = "LEVEL", default_value = "0.01", value_parser = parse::part)]
    pub(crate) alpha: f64,
    /// Another seed gives other samples
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    #[command(flatten)]
    pub(crate) output: LabOutputArgs,
}
