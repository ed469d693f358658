//! What was typed after `luch preview`.

use super::ParameterArgs;
use crate::parse;
use clap::{Args, ValueEnum};
use luch::preview::{Fill, StandardView};
use std::path::PathBuf;

/// Show a scene or a mesh at once, without light: z-buffer and wireframe
///
/// Uses the scene's own camera, if it has one; otherwise everything is brought into view. Without -o the picture is drawn in the terminal.
#[derive(Args, Debug)]
#[command(
    after_long_help = "Examples:\n  luch preview scene.kdl -o look.png\n  luch preview model.glb --sheet -o views.png\n  luch preview part.stl --wireframe hidden-removed --marks -o edges.png\n  luch preview 'torus --radius 2' --fill checker"
)]
pub(crate) struct PreviewArgs {
    /// A scene, a mesh file, or a pipeline such as 'cuboid | subdivide'
    pub(crate) input: String,
    #[command(flatten)]
    pub(crate) parameters: ParameterArgs,
    /// The picture; several are possible
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Vec<PathBuf>,
    /// Width and height in pixels [default: the scene's own, 1280x720 for meshes]
    #[arg(long, value_name = "WxH", value_parser = parse::size)]
    pub(crate) size: Option<parse::Size>,
    /// What surfaces show: nothing, shaded, normals, uv, checker, instances, faces, materials, depth, facing
    #[arg(long, value_name = "WHAT", default_value = "shaded", value_parser = fill)]
    pub(crate) fill: Fill,
    /// Draw edges; those behind something removed, faint or shown
    #[arg(long, value_name = "HIDDEN", num_args = 0..=1, require_equals = true, default_missing_value = "removed")]
    pub(crate) wireframe: Option<HiddenLines>,
    /// Draw only edges where faces meet at this angle or more, in degrees, and borders
    #[arg(long, value_name = "DEGREES", value_parser = parse::crease)]
    pub(crate) features: Option<f32>,
    /// Mark borders (orange) and edges of more than two or of turned faces (magenta)
    #[arg(long)]
    pub(crate) marks: bool,
    /// Draw vertices as dots
    #[arg(long)]
    pub(crate) vertices: bool,
    /// Shade every triangle flat
    #[arg(long)]
    pub(crate) flat: bool,
    /// Width of lines in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 1.0, value_parser = parse::line_width)]
    pub(crate) line_width: f32,
    /// Look from a side: front, back, left, right, top, bottom, three-quarter
    #[arg(long, value_name = "SIDE", value_parser = view)]
    pub(crate) view: Option<StandardView>,
    /// All sides in one picture
    #[arg(long, conflicts_with = "view")]
    pub(crate) sheet: bool,
    /// The camera of the scene by its name
    #[arg(long, value_name = "NAME", conflicts_with_all = ["view", "sheet"])]
    pub(crate) camera: Option<String>,
    /// Samples of a pixel: 1, 4 or 16
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u8))]
    pub(crate) antialias: u8,
    /// Columns of the picture in the terminal [default: 80]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub(crate) columns: Option<u32>,
    /// What the terminal can show
    #[arg(long, value_name = "HOW", value_enum, default_value_t)]
    pub(crate) terminal: TerminalColors,
}

/// What becomes of lines behind something.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum HiddenLines {
    /// Left out
    Removed,
    /// Drawn weakly
    Faint,
    /// Drawn like the others
    Shown,
}

/// How a picture is written in a terminal.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub(crate) enum TerminalColors {
    /// 24-bit colours
    #[default]
    TrueColor,
    /// The customary 256 colours
    Palette,
    /// Letters without colour
    Letters,
    /// The graphics protocol of kitty
    Kitty,
}

fn fill(text: &str) -> Result<Fill, String> {
    Fill::from_name(text).ok_or_else(|| accepted(text, &Fill::ALL.map(Fill::name)))
}

fn view(text: &str) -> Result<StandardView, String> {
    StandardView::from_name(text).ok_or_else(|| accepted(text, &StandardView::ALL.map(StandardView::name)))
}

fn accepted(text: &str, names: &[&str]) -> String {
    format!("`{text}` is none of {}", names.join(", "))
}
