//! What was typed.

mod bench;
mod lab;
mod mesh;
mod parameters;
mod preview;
mod render;

pub(crate) use bench::{BenchArgs, BenchVerb, CameraArgs, Choice, RaysArgs};
pub(crate) use lab::{
    Chi2Args, ControlArgs, CoverageArgs, DensityArgs, DimensionsArgs, ExplainArgs, IntegrateArgs, LabArgs,
    LabOutputArgs, LabSceneArgs, LabVerb, LampArgs, LectureArgs, MeasureArgs, MisArgs, PointsArgs, PrngArgs,
    ProblemArgs, ReferenceArgs, RenderStudyArgs, RouletteArgs, Rules, SlopesArgs, StrataArgs, TruthArgs,
    WidthArgs,
};
pub(crate) use mesh::{
    CompareMeshesArgs, ConvertArgs, InfoArgs, MeshArgs, MeshOutputArgs, QueryArgs, RunArgs, SampleArgs,
    StepArgs, VerbsArgs,
};
pub(crate) use parameters::ParameterArgs;
pub(crate) use preview::{HiddenLines, PreviewArgs, TerminalColors};
pub(crate) use render::{PictureArgs, ProgressStyle, RenderArgs};

use crate::parse;
use clap::{Args, Parser, Subcommand};
use luch::image::tone::Curve;
use std::path::PathBuf;
use std::sync::LazyLock;

/// A progressive, deterministic path tracer.
#[derive(Debug, Parser)]
#[command(name = "luch", version, long_version = long_version(), arg_required_else_help = true, propagate_version = false)]
#[command(after_help = "Start with `luch render scene.kdl`; `luch help VERB` tells more, with examples.")]
pub(crate) struct Command {
    #[command(subcommand)]
    pub(crate) verb: Verb,
}

/// What to do; each verb is explained at its arguments.
#[derive(Debug, Subcommand)]
pub(crate) enum Verb {
    Render(Box<RenderArgs>),
    Reproduce(ReproduceArgs),
    Merge(MergeArgs),
    Develop(DevelopArgs),
    Compare(CompareArgs),
    Check(CheckArgs),
    Mesh(Box<MeshArgs>),
    Preview(Box<PreviewArgs>),
    Lab(Box<LabArgs>),
    Bench(Box<BenchArgs>),
    Completions(CompletionsArgs),
}

/// How light becomes numbers on a screen.
#[derive(Args, Clone, Debug, Default)]
#[command(next_help_heading = "Display")]
pub(crate) struct DisplayArgs {
    /// Brighter or darker by this many stops (powers of two) in PNG and JPEG [default: 0]
    #[arg(long, value_name = "STOPS", value_parser = parse::stops, allow_hyphen_values = true)]
    pub(crate) exposure: Option<f32>,
    /// Display curve of PNG and JPEG: linear, reinhard, hable, aces, agx, pbr-neutral [default: linear]
    #[arg(long, value_name = "CURVE", value_parser = parse::curve)]
    pub(crate) tone: Option<Curve>,
    /// Bits of a channel in PNG
    #[arg(long, value_name = "BITS", default_value_t = 8, value_parser = clap::value_parser!(u8))]
    pub(crate) depth: u8,
}

/// Render the scene of a picture again and say whether the picture comes out the same
///
/// Reads what `luch render` wrote into the PNG, JPEG, HDR, EXR or film: scene, options, ranges of samples, and a digest of the light
/// itself. Renders exactly these samples again and compares. The scene is looked for where it was, then beside the picture.
/// Exit status 0 if equal, 1 if different.
#[derive(Args, Debug)]
#[command(
    after_long_help = "Examples:\n  luch reproduce lecture.png\n  luch reproduce lecture.exr --scene moved/lecture.kdl"
)]
pub(crate) struct ReproduceArgs {
    /// A picture or film made by luch
    pub(crate) file: PathBuf,
    /// The scene, if it is somewhere else now
    #[arg(long, value_name = "FILE")]
    pub(crate) scene: Option<PathBuf>,
    /// Worker threads [default: one on each processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
}

/// Join films of disjoint sample ranges into one
///
/// The films must be of the same scene, camera and settings, and no sample may be in two of them. The sum does not depend on the
/// order: it has the same bits as a film rendered in one go.
#[derive(Args, Debug)]
#[command(
    after_long_help = "Examples:\n  luch render scene.kdl --samples 0..64 -o a.luch      (on one machine)\n  luch render scene.kdl --samples 64..128 -o b.luch    (on another)\n  luch merge a.luch b.luch -o ab.luch\n  luch develop ab.luch -o scene.png"
)]
pub(crate) struct MergeArgs {
    /// Films to join
    #[arg(required = true, value_name = "FILM")]
    pub(crate) films: Vec<PathBuf>,
    /// The film they become
    #[arg(short, long, value_name = "FILM")]
    pub(crate) output: PathBuf,
    /// Accept that samples between the ranges are missing
    #[arg(long)]
    pub(crate) allow_gaps: bool,
}

/// Turn a film into pictures
///
/// Exposure and curve are those of the rendering unless others are given. An EXR gets the layers `stderr` and `samples`.
#[derive(Args, Debug)]
#[command(
    after_long_help = "Examples:\n  luch develop scene.luch -o scene.png --exposure 1 --tone agx\n  luch develop scene.luch -o scene.exr -o scene.png --depth 16"
)]
pub(crate) struct DevelopArgs {
    /// A film (.luch)
    pub(crate) film: PathBuf,
    /// Pictures to write: .png, .jpg, .exr, .hdr, .pfm, .npy
    #[arg(short, long, required = true, value_name = "FILE")]
    pub(crate) output: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) display: DisplayArgs,
}

/// Say how far two pictures are apart
///
/// Measures are of linear light; PSNR and SSIM are of what a screen would show. Films (.luch) may be compared as well. Exit status 1 if a
/// limit is exceeded.
#[derive(Args, Debug)]
#[command(
    after_long_help = "Examples:\n  luch compare noisy.exr reference.exr\n  luch compare a.png b.png -o difference.png\n  luch compare new.exr golden.exr --max-rel-mse 0.001 --json"
)]
pub(crate) struct CompareArgs {
    /// The picture
    pub(crate) a: PathBuf,
    /// What it is held against
    pub(crate) b: PathBuf,
    /// Write the difference in false colour: black for none, white for the largest
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// Print one JSON object (an infinite PSNR is null)
    #[arg(long)]
    pub(crate) json: bool,
    /// Fail if the mean squared error is larger
    #[arg(long, value_name = "X", value_parser = parse::limit, allow_hyphen_values = true)]
    pub(crate) max_mse: Option<f64>,
    /// Fail if the mean relative squared error is larger
    #[arg(long, value_name = "X", value_parser = parse::limit, allow_hyphen_values = true)]
    pub(crate) max_rel_mse: Option<f64>,
    /// Fail if any channel of any pixel differs by more
    #[arg(long, value_name = "X", value_parser = parse::limit, allow_hyphen_values = true)]
    pub(crate) max_difference: Option<f64>,
}

/// Say what is in a scene file and what is wrong with it
///
/// Counts, sizes and memory, whether meshes are closed, what is missing or unused. Nothing is rendered. Exit status 1 only if the scene cannot
/// be rendered at all.
#[derive(Args, Debug)]
#[command(after_long_help = "Examples:\n  luch check scene.kdl\n  luch check model.glb --json")]
pub(crate) struct CheckArgs {
    /// A scene: .kdl, .gltf, .glb, .obj, .ply, .stl, .xml (Mitsuba 3)
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) parameters: ParameterArgs,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

/// Write completions for a shell
#[derive(Args, Debug)]
#[command(
    after_long_help = "Example:\n  luch completions bash > ~/.local/share/bash-completion/completions/luch"
)]
pub(crate) struct CompletionsArgs {
    /// The shell
    pub(crate) shell: clap_complete::Shell,
}

/// The version and what this build can do.
fn long_version() -> &'static str {
    static TEXT: LazyLock<String> = LazyLock::new(describe_build);
    &TEXT
}

fn describe_build() -> String {
    let formats = luch::image::codec::Format::ALL;
    let written = formats.iter().filter(|format| format.can_write()).map(|format| format.name());
    let sequences = luch::sampling::Sequence::ALL.map(luch::sampling::Sequence::name).join(", ");
    let scenes: Vec<&str> =
        luch::formats::SceneFormat::ALL.iter().flat_map(|format| format.extensions()).copied().collect();
    format!(
        "{}\nscenes:    {}\npictures:  {}, film (.luch)\nsequences: {sequences}\ncurves:    {}\nsystem:    {} {}",
        env!("CARGO_PKG_VERSION"),
        scenes.join(", "),
        written.collect::<Vec<_>>().join(", "),
        Curve::names(),
        std::env::consts::OS,
        std::env::consts::ARCH,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_is_consistent() {
        Command::command().debug_assert();
    }
}
