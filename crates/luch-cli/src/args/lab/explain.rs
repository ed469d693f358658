//! `luch lab explain`: what was typed.

use super::LabOutputArgs;
use crate::args::{ParameterArgs, PictureArgs};
use clap::Args;
use std::path::PathBuf;

/// Why a pixel is as it is: its paths as a tree, with densities and weights, by depth, lamp and technique
///
/// The paths are those of the path tracer without sharing between pixels; what the picture shows, where neighbours help each other,
/// stands beside it.
#[derive(Args, Debug)]
#[command(
    after_long_help = "Examples:\n  luch lab explain scenes/cornell.kdl --pixel 120,200\n  luch lab explain scenes/cornell.kdl --pixel 120,200 --sample 17    # one path, step by step\n  luch lab explain scenes/glass.kdl --pixel 300,220 --spp 4096 -o pixel.html"
)]
pub(crate) struct ExplainArgs {
    /// The scene
    pub(crate) file: PathBuf,
    /// The pixel, column and row from 0,0 in the upper left corner
    #[arg(long, value_name = "X,Y", value_parser = pixel)]
    pub(crate) pixel: Pixel,
    /// How many samples
    #[arg(long, value_name = "N", default_value_t = 256)]
    pub(crate) spp: u64,
    /// Tell the path of one sample, step by step (may be given several times)
    #[arg(long, value_name = "INDEX")]
    pub(crate) sample: Vec<u64>,
    /// How many objects deep the tree is told
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u8).range(1..=32))]
    pub(crate) depth: u8,
    /// Least part of the light that a branch of the tree is told for, in per cent
    #[arg(long, value_name = "PERCENT", default_value_t = 1.0, value_parser = percentage)]
    pub(crate) least: f64,
    #[command(flatten)]
    pub(crate) picture: PictureArgs,
    #[command(flatten)]
    pub(crate) parameters: ParameterArgs,
    #[command(flatten)]
    pub(crate) output: LabOutputArgs,
}

/// Column and row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pixel(pub(crate) [u32; 2]);

fn pixel(text: &str) -> Result<Pixel, String> {
    let parts =
        text.split_once(',').and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]));
    parts.map(Pixel).ok_or_else(|| format!("`{text}` is no pixel; write column and row, such as 120,200"))
}

fn percentage(text: &str) -> Result<f64, String> {
    let number = text.strip_suffix('%').unwrap_or(text).trim().parse().ok();
    number
        .filter(|value: &f64| (0.0..=100.0).contains(value))
        .ok_or_else(|| format!("`{text}` is no percentage from 0 to 100"))
}
