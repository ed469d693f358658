//! What was typed after `luch mesh`: one subcommand for each verb of the workshop, made from its description, and a few more.

mod step;

use crate::parse;
use clap::error::ErrorKind;
use clap::{ArgMatches, Args, Command, Error, FromArgMatches};
use luch::mesh::workshop::{Verb, verbs};
use std::path::PathBuf;

/// Make, edit, inspect and convert meshes
///
/// Each verb reads a mesh from a file or from standard input, and writes one with -o or to standard output, so that verbs can be joined by
/// pipes. A last verb without -o in a terminal says what it made.
#[derive(Debug)]
pub(crate) enum MeshArgs {
    /// `luch mesh info`
    Info(InfoArgs),
    /// `luch mesh convert`
    Convert(ConvertArgs),
    /// `luch mesh run`
    Run(RunArgs),
    /// `luch mesh compare`
    Compare(CompareMeshesArgs),
    /// `luch mesh sample`
    Sample(SampleArgs),
    /// `luch mesh query`
    Query(QueryArgs),
    /// `luch mesh verbs`
    Verbs(VerbsArgs),
    /// A verb of the workshop.
    Step(StepArgs),
}

/// A verb of the workshop with what was given.
#[derive(Debug)]
pub(crate) struct StepArgs {
    pub(crate) verb: &'static Verb,
    /// Names and texts of parameters.
    pub(crate) given: Vec<(String, String)>,
    /// The mesh that is changed.
    pub(crate) input: Option<PathBuf>,
    pub(crate) output: MeshOutputArgs,
}

/// Where a mesh goes.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct MeshOutputArgs {
    /// Where the mesh goes: .obj, .ply, .stl, .off, .glb, .3mf; several are possible; - is standard output
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Vec<PathBuf>,
    /// The format on standard output: obj, ply, stl, off, glb [default: obj, which keeps everything]
    #[arg(long, value_name = "FORMAT")]
    pub(crate) format: Option<String>,
}

/// Say everything about a mesh: counts, sizes, closedness, what is wrong with it
#[derive(Args, Debug)]
#[command(
    after_long_help = "Examples:\n  luch mesh info model.stl\n  luch mesh torus | luch mesh info --json"
)]
pub(crate) struct InfoArgs {
    /// A mesh: .obj, .ply, .stl, .off, .gltf, .glb, .3mf; standard input if there is none
    pub(crate) input: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
    /// Leave out the search for faces that cross one another
    #[arg(long)]
    pub(crate) no_self_intersections: bool,
    /// Take positions that are equal for different ones
    #[arg(long)]
    pub(crate) no_weld: bool,
}

/// Write a mesh in another format
#[derive(Args, Debug)]
#[command(after_long_help = "Example:\n  luch mesh convert model.obj -o model.glb")]
pub(crate) struct ConvertArgs {
    /// A mesh; standard input if there is none
    pub(crate) input: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) output: MeshOutputArgs,
}

/// Run a pipeline written in one text
#[derive(Args, Debug)]
#[command(
    after_long_help = "Example:\n  luch mesh run 'cuboid --size 2 | subdivide --levels 3 | twist --angle 90deg' -o out.glb"
)]
pub(crate) struct RunArgs {
    /// Steps with | between them; the first makes a mesh, or changes the one from --input
    pub(crate) pipeline: String,
    /// The mesh that the first step changes
    #[arg(long, value_name = "FILE")]
    pub(crate) input: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) output: MeshOutputArgs,
}

/// Say how far two surfaces are apart
///
/// Each may be a file or a pipeline such as 'sphere --segments 32'. Distances are from points of one surface to the nearest point of the
/// other, both ways.
#[derive(Args, Debug)]
#[command(
    after_long_help = "Examples:\n  luch mesh compare scan.ply reduced.ply\n  luch mesh compare 'icosphere --subdivisions 3' 'icosphere --subdivisions 6'\n  luch mesh compare cylinder --resolutions 8,16,32,64 -o cylinder.png"
)]
pub(crate) struct CompareMeshesArgs {
    /// A mesh file or a pipeline
    pub(crate) a: String,
    /// What it is held against; without it the form itself, traced without triangles: sphere, icosphere, cylinder, cone, frustum,
    /// disc or implicit
    pub(crate) b: Option<String>,
    /// Pieces of the meshes that are held against the form itself, one after another [default: 8,16,32,64; levels 1,2,3,4 for icosphere]
    #[arg(long, value_name = "N,…", value_delimiter = ',', conflicts_with = "b", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub(crate) resolutions: Vec<u32>,
    /// A picture of the form itself, its meshes, and below them eight times what differs
    #[arg(short, long, value_name = "FILE", conflicts_with = "b")]
    pub(crate) output: Option<PathBuf>,
    /// Points on each surface for the mean
    #[arg(long, value_name = "N", default_value_t = 10_000, value_parser = clap::value_parser!(u32).range(1..=50_000_000))]
    pub(crate) samples: u32,
    /// How exact the greatest distance is to be, as a part of the diagonal
    #[arg(long, value_name = "PART", default_value_t = 1e-4, value_parser = parse::part)]
    pub(crate) tolerance: f64,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
    /// Fail if the Hausdorff distance is larger, in metres
    #[arg(long, value_name = "X", value_parser = parse::limit)]
    pub(crate) max_distance: Option<f64>,
}

/// Scatter points over a surface
#[derive(Args, Debug)]
#[command(after_long_help = "Example:\n  luch mesh sample bunny.ply --count 5000 --blue-noise -o points.ply")]
pub(crate) struct SampleArgs {
    /// A mesh; standard input if there is none
    pub(crate) input: Option<PathBuf>,
    /// How many points
    #[arg(long, default_value_t = 10_000, value_parser = clap::value_parser!(u32).range(1..=50_000_000))]
    pub(crate) count: u32,
    /// Keep points apart (sample elimination)
    #[arg(long)]
    pub(crate) blue_noise: bool,
    /// Another seed gives other points
    #[arg(long, default_value_t = 0)]
    pub(crate) seed: u64,
    /// Where the points go: .ply, .csv; lines of x,y,z,nx,ny,nz on standard output without
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
}

/// Ask a mesh about points: nearest point, signed distance, inside or not
///
/// Points are lines of three numbers on standard input, or given with --point.
#[derive(Args, Debug)]
#[command(after_long_help = "Example:\n  luch mesh query part.stl --point 0,0,0 --point 1,2,3")]
pub(crate) struct QueryArgs {
    /// A mesh
    pub(crate) input: PathBuf,
    /// A point; may be given more than once
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub(crate) point: Vec<String>,
    /// Print a JSON object for each point
    #[arg(long)]
    pub(crate) json: bool,
}

/// List all verbs
#[derive(Args, Debug)]
pub(crate) struct VerbsArgs {
    /// Everything about each, as Markdown
    #[arg(long)]
    pub(crate) markdown: bool,
}

impl Args for MeshArgs {
    fn augment_args(command: Command) -> Command {
        let fixed = |command: Command, name: &'static str, arguments: fn(Command) -> Command| {
            command.subcommand(arguments(Command::new(name)))
        };
        let command = command
            .about("Make, edit, inspect and convert meshes")
            .long_about(
                "Make, edit, inspect and convert meshes\n\nEach verb reads a mesh from a file or from standard input, and writes one with -o or to \
                 standard output, so that verbs can be joined by pipes. In a terminal, a last verb without -o says what it made.",
            )
            .after_help("`luch mesh verbs` lists all with one line each; `luch mesh VERB --help` tells more.")
            .after_long_help(
                "Examples:\n  luch mesh cuboid --size 2 | luch mesh subdivide --levels 3 | luch mesh twist --angle 90deg -o out.glb\n  \
                 luch mesh info out.glb",
            )
            .subcommand_required(true)
            .arg_required_else_help(true);
        let command = fixed(command, "info", InfoArgs::augment_args);
        let command = fixed(command, "convert", ConvertArgs::augment_args);
        let command = fixed(command, "run", RunArgs::augment_args);
        let command = fixed(command, "compare", CompareMeshesArgs::augment_args);
        let command = fixed(command, "sample", SampleArgs::augment_args);
        let command = fixed(command, "query", QueryArgs::augment_args);
        let command = fixed(command, "verbs", VerbsArgs::augment_args);
        verbs().fold(command, |command, verb| command.subcommand(step::command(verb)))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for MeshArgs {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let Some((name, matches)) = matches.subcommand() else {
            return Err(Error::new(ErrorKind::MissingSubcommand));
        };
        Ok(match name {
            "info" => Self::Info(InfoArgs::from_arg_matches(matches)?),
            "convert" => Self::Convert(ConvertArgs::from_arg_matches(matches)?),
            "run" => Self::Run(RunArgs::from_arg_matches(matches)?),
            "compare" => Self::Compare(CompareMeshesArgs::from_arg_matches(matches)?),
            "sample" => Self::Sample(SampleArgs::from_arg_matches(matches)?),
            "query" => Self::Query(QueryArgs::from_arg_matches(matches)?),
            "verbs" => Self::Verbs(VerbsArgs::from_arg_matches(matches)?),
            name => Self::Step(step::read(name, matches)?),
        })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}
