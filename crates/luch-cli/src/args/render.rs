//! What was typed after `luch render`.

use super::{DisplayArgs, ParameterArgs};
use crate::layers::LayerChoice;
use crate::parse::{self, IntegratorChoice, Size};
use clap::{Args, ValueEnum};
use luch::sampling::Sequence;
use luch::scene::{Filter, Minification, Normals};
use std::ops::Range;
use std::path::PathBuf;
use std::time::Duration;

/// Render a scene; stop, resume and refine it at any time
///
/// The picture is on the disk after the first pass and is replaced as it gets better. Rendering ends when the first of the goals --spp,
/// --samples, --time, --error is reached. If none is given, the number of samples in the scene file counts; if there is none
/// either, rendering goes on until Ctrl-C, whether anybody watches or not.
///
/// Ctrl-C (or a request to terminate) at any moment writes the pictures and a film beside them; the same command with --resume continues
/// to the same bits as if nothing had happened. A second Ctrl-C ends at once; no file is ever half written. The exit status is then 130.
///
/// The film (OUT.luch) is kept after the end as well: with --resume and more samples the picture is refined. Saving takes at most about
/// a twentieth of the time.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub(crate) struct RenderArgs {
    /// A scene: .kdl, .gltf, .glb, .obj, .ply, .stl, .xml (Mitsuba 3); may be left out with --resume FILM
    pub(crate) file: Option<PathBuf>,
    /// What to write: .png, .jpg, .exr, .hdr, .pfm, .npy, .luch (may be given several times) [default: the scene's name with .png, in this folder]
    #[arg(short, long, value_name = "OUT")]
    pub(crate) output: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) parameters: ParameterArgs,
    #[command(flatten)]
    pub(crate) goal: GoalArgs,
    #[command(flatten)]
    pub(crate) picture: PictureArgs,
    #[command(flatten)]
    pub(crate) display: DisplayArgs,
    /// Layers of an EXR besides the picture, separated by commas: stderr, samples, albedo, normal, depth, uv, geometric-normal, instance,
    /// material, primitive, barycentric, or none [default: albedo,normal,depth,stderr,samples]
    #[arg(long, value_name = "LAYERS", value_delimiter = ',')]
    pub(crate) layers: Option<Vec<LayerChoice>>,
    #[command(flatten)]
    pub(crate) work: WorkArgs,
}

/// When it is done.
#[derive(Args, Debug)]
#[command(next_help_heading = "Goals (the first that is reached ends the work)")]
pub(crate) struct GoalArgs {
    /// Samples of each pixel
    #[arg(long, value_name = "N", value_parser = parse::sample_count, conflicts_with = "samples")]
    pub(crate) spp: Option<u64>,
    /// Time, such as 30s, 2m or 1h
    #[arg(long, value_name = "TIME", value_parser = parse::duration)]
    pub(crate) time: Option<Duration>,
    /// Relative error of the picture, such as 1% or 0.01
    #[arg(long, value_name = "SHARE", value_parser = parse::fraction)]
    pub(crate) error: Option<f64>,
    /// Exactly the samples from A up to, not including, B: for work shared among machines
    #[arg(long, value_name = "A..B", value_parser = parse::samples)]
    pub(crate) samples: Option<Range<u64>>,
}

/// What shapes the samples; what is not given is as the scene file says.
#[derive(Args, Clone, Debug, Default)]
#[command(next_help_heading = "Picture (what is not given is as the scene says)")]
pub(crate) struct PictureArgs {
    /// Pixels, such as 960x540
    #[arg(long, value_name = "WxH", value_parser = parse::size)]
    pub(crate) size: Option<Size>,
    /// Chooses the random numbers; pictures of different seeds are independent
    #[arg(long, value_name = "N")]
    pub(crate) seed: Option<u64>,
    /// A camera of the scene by name
    #[arg(long, value_name = "NAME")]
    pub(crate) camera: Option<String>,
    /// path, plain-path, direct, occlusion[:METRES], or a property: normal, geometric-normal, uv, depth, albedo, instance, material,
    /// primitive, barycentric
    #[arg(long, value_name = "NAME")]
    pub(crate) integrator: Option<IntegratorChoice>,
    /// Most scatterings of a path
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=1 << 20))]
    pub(crate) max_depth: Option<u32>,
    /// sobol, halton, stratified, independent
    #[arg(long, value_name = "NAME", value_parser = parse::sequence)]
    pub(crate) sequence: Option<Sequence>,
    /// box, tent, gaussian or blackman-harris, with a radius in pixels after a colon if wanted
    #[arg(long, value_name = "NAME[:RADIUS]", value_parser = parse::filter)]
    pub(crate) filter: Option<Filter>,
    /// flat or smooth
    #[arg(long, value_name = "KIND", value_parser = parse::normals)]
    pub(crate) normals: Option<Normals>,
    /// Textures finer than the pixels: footprint (averaged) or none (read as they are)
    #[arg(long, value_name = "KIND", value_parser = parse::texture_filter)]
    pub(crate) texture_filter: Option<Minification>,
    /// Skip back faces of closed, opaque meshes
    #[arg(long)]
    pub(crate) cull_back_faces: bool,
}

/// How the work goes on.
#[derive(Args, Debug)]
#[command(next_help_heading = "Work")]
pub(crate) struct WorkArgs {
    /// Go on with a film [default: the one beside the first output]
    #[arg(long, value_name = "FILM", num_args = 0..=1)]
    pub(crate) resume: Option<Option<PathBuf>>,
    /// Where the film is kept [default: the first output with .luch]
    #[arg(long, value_name = "FILM", conflicts_with = "no_checkpoint")]
    pub(crate) checkpoint: Option<PathBuf>,
    /// Keep no film: the work cannot be resumed
    #[arg(long)]
    pub(crate) no_checkpoint: bool,
    /// Time between two savings of pictures and film, 1s or more
    #[arg(long, value_name = "TIME", default_value = "5s", value_parser = parse::interval)]
    pub(crate) every: Duration,
    /// Worker threads [default: one on each processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// How progress is told
    #[arg(long, value_enum, default_value_t = ProgressStyle::Auto)]
    pub(crate) progress: ProgressStyle,
    /// Say nothing but errors
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

/// How progress is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ProgressStyle {
    /// A bar on a terminal, plain otherwise
    Auto,
    /// One line on standard error that is written again and again
    Bar,
    /// Only a summary at the end
    Plain,
    /// One JSON object a line on standard output: events start, progress, end
    Json,
    /// Not at all
    None,
}

const EXAMPLES: &str = "\
Examples:
  luch render scenes/lecture.kdl
      lecture.png in this folder, with the samples the scene asks for
  luch render model.glb --time 1m --size 1280x720 -o model.png -o model.exr
      one minute; the EXR has layers albedo, normal, depth, stderr, samples
  luch render scenes/cornell.kdl --error 1%
      until the estimated error is one percent
  luch render scenes/cornell.kdl --spp 1024 --resume
      goes on where an earlier run ended
  luch render --resume cornell.luch --spp 4096
      the film knows its scene and options
  luch render scenes/cornell.kdl --samples 0..64 -o a.luch
      one machine's part of the work; see `luch help merge`
  luch render model.glb --integrator normal --spp 16";
