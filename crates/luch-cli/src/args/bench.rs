//! What was typed after `luch bench`.

use super::ParameterArgs;
use crate::bench::{Kernel, SetKind};
use crate::parse;
use clap::{Args, Subcommand};
use glam::Vec3;
use luch::bvh::Quality;
use luch::bvh::simd::Level;
use std::path::PathBuf;

/// Measure how fast this machine does what rendering rests on
#[derive(Args, Debug)]
pub(crate) struct BenchArgs {
    #[command(subcommand)]
    pub(crate) what: BenchVerb,
}

/// What is measured.
#[derive(Debug, Subcommand)]
pub(crate) enum BenchVerb {
    Rays(RaysArgs),
}

/// Build trees over a mesh and trace rays through them
///
/// Four sets of rays are traced: primary (a camera's, in tiles), diffuse (one cosine-distributed ray from each place the camera sees),
/// shuffled (the same in random order) and shadow (short ones from the same places, asking only whether anything is in the way).
/// Speeds are rays by processor time of the threads that trace, and by elapsed time; each is the median of the repetitions with the
/// least and the most.
///
/// All answers must be the same bits for every kernel, level, quality and number of threads: exit status 1 if they are not. Hits from
/// another program are compared and told, and judged by nobody: rays that graze an edge may differ.
#[derive(Args, Debug)]
#[command(
    after_long_help = "Examples:\n  luch bench rays bunny.obj\n  luch bench rays bunny.tri --rays out/bunny --quality all --threads 1,2\n  luch bench rays dragon.ply --fov 24 --write out/dragon   (for other programs to trace)"
)]
pub(crate) struct RaysArgs {
    /// A mesh or scene: .tri, .kdl, .gltf, .glb, .obj, .ply, .stl, .xml (Mitsuba 3); of a scene all its meshes
    pub(crate) mesh: PathBuf,
    /// Trace the rays in PREFIX.primary.rays, .diffuse.rays, .shuffled.rays and .shadow.rays, and compare with PREFIX.SET.hits
    #[arg(long, value_name = "PREFIX", conflicts_with_all = ["eye", "at", "up", "fov", "size", "write"])]
    pub(crate) rays: Option<PathBuf>,
    /// Write the mesh, rays and hits to PREFIX.tri, PREFIX.SET.rays and PREFIX.SET.hits
    #[arg(long, value_name = "PREFIX")]
    pub(crate) write: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) parameters: ParameterArgs,
    #[command(flatten)]
    pub(crate) camera: CameraArgs,
    #[command(flatten)]
    pub(crate) choice: ChoiceArgs,
    /// Timed repetitions, after one that is not
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub(crate) repeat: u32,
    /// Print one JSON object a line instead of tables
    #[arg(long)]
    pub(crate) json: bool,
}

/// From where the primary rays of sets that are made here go out.
#[derive(Args, Debug)]
#[command(next_help_heading = "Camera of rays that are made here")]
pub(crate) struct CameraArgs {
    /// Where the eye is [default: so that the mesh is in the picture]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse::point, allow_hyphen_values = true)]
    pub(crate) eye: Option<Vec3>,
    /// Where it looks [default: the middle of the mesh]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse::point, allow_hyphen_values = true)]
    pub(crate) at: Option<Vec3>,
    /// What is up in the picture [default: 0,1,0]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse::point, allow_hyphen_values = true)]
    pub(crate) up: Option<Vec3>,
    /// Field of view in degrees [default: 40]
    #[arg(long, value_name = "DEGREES", value_parser = parse::field_of_view)]
    pub(crate) fov: Option<f32>,
    /// Pixels in a row and rows; rounded up to whole tiles of 16 [default: 1024]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(16..=4096))]
    pub(crate) size: Option<u16>,
}

/// What is measured, each with each.
#[derive(Args, Debug)]
#[command(next_help_heading = "What is measured, each with each (several separated by commas, or all)")]
pub(crate) struct ChoiceArgs {
    /// fast, balanced, best
    #[arg(long, value_name = "NAMES", default_value = "balanced", value_parser = parse::qualities)]
    pub(crate) quality: Choice<Quality>,
    /// batch (with the hint that suits the set), coherent, incoherent (with this hint), single
    #[arg(long, value_name = "NAMES", default_value = "batch,single", value_parser = parse::kernels)]
    pub(crate) kernel: Choice<Kernel>,
    /// portable, avx2, avx512 [default: the best this processor has]
    #[arg(long, value_name = "NAMES", value_parser = parse::levels)]
    pub(crate) level: Option<Choice<Level>>,
    /// primary, diffuse, shuffled, shadow
    #[arg(long, value_name = "NAMES", default_value = "all", value_parser = parse::sets)]
    pub(crate) sets: Choice<SetKind>,
    /// Threads that trace; trees are built on all processors
    #[arg(long, value_name = "N,…", default_value = "1", value_parser = parse::thread_counts)]
    pub(crate) threads: Choice<usize>,
}

/// One or several of a family.
#[derive(Clone, Debug)]
pub(crate) struct Choice<T>(pub(crate) Vec<T>);
