//! What was typed after `luch lab lamp`, if it is about a scene.

use super::{LabOutputArgs, count, rule};
use crate::args::ParameterArgs;
use crate::parse;
use glam::Vec3;
use luch_lab::points::Rule;
use std::path::PathBuf;

/// Which lamps of a scene a point sees, and how much light comes from each
///
/// The visible fraction of a surface is the share of its area with a free line to the point; of a sun that of its disc; of the sky that of
/// the hemisphere, weighed by the cosine. Irradiance is of direct light only: what passes glass or mirrors does not count.
#[derive(clap::Parser, Debug)]
#[command(
    no_binary_name = true,
    bin_name = "luch lab lamp",
    after_long_help = "Example:\n  luch lab lamp --scene room.kdl --at 0.5,0,1.2 --normal 0,1,0"
)]
pub(crate) struct LampArgs {
    /// A scene: .kdl, .gltf, .glb, .obj, .ply, .stl, .xml (Mitsuba 3)
    #[arg(long, value_name = "FILE")]
    pub(crate) scene: PathBuf,
    #[command(flatten)]
    pub(crate) parameters: ParameterArgs,
    /// The point, metres
    #[arg(long, value_name = "X,Y,Z", value_parser = parse::point, allow_hyphen_values = true)]
    pub(crate) at: Vec3,
    /// Which way the surface at the point faces
    #[arg(long, value_name = "X,Y,Z", default_value = "0,1,0", value_parser = direction, allow_hyphen_values = true)]
    pub(crate) normal: Vec3,
    /// Only lamps of this name (may be given several times) [default: all]
    #[arg(long, value_name = "NAME")]
    pub(crate) light: Vec<String>,
    /// Samples of each lamp
    #[arg(long, value_name = "N", default_value = "65536", value_parser = count)]
    pub(crate) samples: u64,
    /// Where samples come from
    #[arg(long, value_name = "RULE", default_value = "sobol-hashed", value_parser = rule)]
    pub(crate) sampler: Rule,
    /// Another seed gives other samples
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    #[command(flatten)]
    pub(crate) output: LabOutputArgs,
}

fn direction(text: &str) -> Result<Vec3, String> {
    let direction = parse::point(text).ok().and_then(Vec3::try_normalize);
    direction.ok_or_else(|| format!("`{text}` is no direction; write three numbers, such as 0,1,0"))
}
