//! `luch lab`: what was typed.

mod explain;

pub(crate) use explain::ExplainArgs;
mod chi2;
mod lamp;
mod saving;

pub(crate) use chi2::Chi2Args;
pub(crate) use lamp::LampArgs;
pub(crate) use saving::{ControlArgs, MisArgs, RouletteArgs, StrataArgs, WidthArgs};
mod truth;

pub(crate) use truth::TruthArgs;
mod render;

pub(crate) use render::{CoverageArgs, LabSceneArgs, ReferenceArgs, RenderStudyArgs};

use crate::parse;
use clap::{Args, Subcommand};
use luch_lab::figure::Theme;
use luch_lab::generator::Generator;
use luch_lab::integral::Target;
use luch_lab::points::Rule;
use std::ffi::OsString;
use std::path::PathBuf;

/// Monte Carlo made visible: problems with known answers, integrals, samplers, generators, densities
///
/// Every verb prints numbers and a figure in the terminal; -o writes the figure (.svg, .png), its numbers (.csv, .json) or a page with
/// everything (.html). The same command gives the same numbers everywhere.
#[derive(Args, Debug)]
#[command(
    arg_required_else_help = true,
    after_long_help = "Examples:\n  luch lab pi\n  luch lab integrate 'cos(x)^77' --over x=-pi/2..pi/2 --density 'normal(0, 0.15)' --truth 'sqrt(pi)*gamma(39)/gamma(39.5)'\n  luch lab points sobol-hashed independent --count 1000 -o points.svg\n  luch lab prng randu\n  luch lab lecture -o lecture-figures"
)]
pub(crate) struct LabArgs {
    #[command(subcommand)]
    pub(crate) verb: LabVerb,
}

/// What to look at.
#[derive(Debug, Subcommand)]
pub(crate) enum LabVerb {
    Problems(ProblemsArgs),
    Integrate(IntegrateArgs),
    Points(PointsArgs),
    Measure(MeasureArgs),
    Slopes(SlopesArgs),
    Prng(PrngArgs),
    Density(DensityArgs),
    Dimensions(DimensionsArgs),
    Explain(ExplainArgs),
    Chi2(Chi2Args),
    Mis(MisArgs),
    Control(ControlArgs),
    Roulette(RouletteArgs),
    Width(WidthArgs),
    Strata(StrataArgs),
    Truth(TruthArgs),
    Lecture(LectureArgs),
    Render(Box<RenderStudyArgs>),
    Coverage(Box<CoverageArgs>),
    /// A problem by its name.
    #[command(external_subcommand)]
    Problem(Vec<OsString>),
}

/// Where figures and numbers go.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct LabOutputArgs {
    /// .svg, .png, .csv, .json or .html; several are possible
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Vec<PathBuf>,
    /// Print one JSON object instead of tables and figures
    #[arg(long)]
    pub(crate) json: bool,
    /// Ground of PNG: light, dark
    #[arg(long, value_name = "THEME", default_value = "light", value_parser = theme)]
    pub(crate) theme: Theme,
}

/// List the problems with known answers
#[derive(Args, Debug)]
pub(crate) struct ProblemsArgs {}

/// A problem with a known answer: estimate, error, truth
///
/// `luch lab lamp --scene FILE --at X,Y,Z` asks which lamps a point of any scene sees.
#[derive(clap::Parser, Debug)]
#[command(no_binary_name = true, bin_name = "luch lab")]
pub(crate) struct ProblemArgs {
    /// The problem; `luch lab problems` lists them
    pub(crate) name: String,
    /// How many samples
    #[arg(long, value_name = "N", default_value = "65536", value_parser = count)]
    pub(crate) samples: u64,
    /// Where points come from
    #[arg(long, value_name = "RULE", default_value = "independent", value_parser = rule)]
    pub(crate) sampler: Rule,
    /// Another seed gives other points
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    #[command(flatten)]
    pub(crate) output: LabOutputArgs,
}

/// Any integral of a formula, by many samplers at once, or until an error is reached
#[derive(Args, Debug)]
#[command(
    after_long_help = "Examples:\n  luch lab integrate 'exp(x+y)' --over x=0..1,y=0..1 --sampler independent,sobol-owen --n 2^6..2^14\n  luch lab integrate 'cos(x)^77' --over x=-pi/2..pi/2 --density 'normal(0, 0.15)' --until 'rel 1e-4 @ 95%'"
)]
pub(crate) struct IntegrateArgs {
    /// The formula
    pub(crate) formula: String,
    /// The box: x=0..1,y=-pi..pi
    #[arg(long, value_name = "DOMAIN")]
    pub(crate) over: String,
    /// How points are drawn: uniform, normal(mean, deviation), 0.1*uniform + 0.9*normal(0,0.15), one for each axis by name …; mixtures are mixed axis by axis
    #[arg(long, value_name = "DENSITY")]
    pub(crate) density: Option<String>,
    /// The known value, a formula too
    #[arg(long, value_name = "VALUE")]
    pub(crate) truth: Option<String>,
    /// Samplers, or all
    #[arg(long, value_name = "RULE,…", value_delimiter = ',', default_value = "independent,halton-shifted,sobol-owen", value_parser = rules)]
    pub(crate) sampler: Vec<Rules>,
    /// Numbers of points: 2^6..2^14
    #[arg(long, value_name = "FROM..TO", default_value = "2^6..2^14", value_parser = sizes)]
    pub(crate) n: Sizes,
    /// Independent repetitions
    #[arg(long, value_name = "N", default_value_t = 32, value_parser = clap::value_parser!(u64).range(2..=65536))]
    pub(crate) replicates: u64,
    /// Go on until an error is reached, such as `rel 1e-4 @ 95%` or `abs 0.001 @ 99%`; by scrambled Sobol' points
    #[arg(long, value_name = "TARGET", value_parser = target)]
    pub(crate) until: Option<Target>,
    /// Most points of --until
    #[arg(long, value_name = "N", default_value = "2^28", value_parser = count)]
    pub(crate) limit: u64,
    /// Another seed gives other points
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    #[command(flatten)]
    pub(crate) output: LabOutputArgs,
}

/// Points of samplers, side by side
#[derive(Args, Debug)]
#[command(after_long_help = "Example:\n  luch lab points sobol-owen independent --count 1000 -o points.png")]
pub(crate) struct PointsArgs {
    /// Samplers, or all
    #[arg(value_name = "RULE", default_value = "all", value_parser = rules)]
    pub(crate) rules: Vec<Rules>,
    /// How many points; the nearest number that the sampler has
    #[arg(long, value_name = "N", default_value = "1000", value_parser = count)]
    pub(crate) count: u64,
    /// Which two dimensions are shown, counted from 1
    #[arg(long, value_name = "A,B", default_value = "1,2", value_delimiter = ',', num_args = 1, value_parser = clap::value_parser!(u64).range(1..=64))]
    pub(crate) axes: Vec<u64>,
    /// Another seed gives other points
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    #[command(flatten)]
    pub(crate) output: LabOutputArgs,
}

/// How evenly points lie: discrepancies, empty room, power spectrum, quality of nets
#[derive(Args, Debug)]
#[command(after_long_help = "Example:\n  luch lab measure all --count 1024")]
pub(crate) struct MeasureArgs {
    /// Samplers, or all
    #[arg(value_name = "RULE", default_value = "all", value_parser = rules)]
    pub(crate) rules: Vec<Rules>,
    /// How many points; the nearest number that the sampler has
    #[arg(long, value_name = "N", default_value = "1024", value_parser = count)]
    pub(crate) count: u64,
    /// Another seed gives other points
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    #[command(flatten)]
    pub(crate) output: LabOutputArgs,
}

/// How fast the error of samplers falls, for smooth, kinked and broken integrands
#[derive(Args, Debug)]
#[command(after_long_help = "Example:\n  luch lab slopes independent sobol-owen --dimensions 2")]
pub(crate) struct SlopesArgs {
    /// Samplers, or all
    #[arg(value_name = "RULE", default_value = "all", value_parser = rules)]
    pub(crate) rules: Vec<Rules>,
    /// Of the unit cube
    #[arg(long, value_name = "D", default_value_t = 2, value_parser = clap::value_parser!(u64).range(1..=4))]
    pub(crate) dimensions: u64,
    /// Independent repetitions
    #[arg(long, value_name = "N", default_value_t = 48, value_parser = clap::value_parser!(u32).range(2..=4096))]
    pub(crate) replicates: u32,
    #[command(flatten)]
    pub(crate) output: LabOutputArgs,
}

/// Put generators of random numbers to the test
#[derive(Args, Debug)]
#[command(
    after_long_help = "Examples:\n  luch lab prng randu mt19937\n  luch lab prng pcg32 --raw | RNG_test stdin32"
)]
pub(crate) struct PrngArgs {
    /// Generators; all if none is named
    #[arg(value_name = "GENERATOR", value_parser = generator)]
    pub(crate) generators: Vec<Generator>,
    /// Write the outputs of one generator to standard output, without end, for other test programs
    #[arg(long)]
    pub(crate) raw: bool,
    /// Where the generator starts
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    #[command(flatten)]
    pub(crate) output: LabOutputArgs,
}

/// A density over the unit square: its values, samples and their weights
#[derive(Args, Debug)]
#[command(after_long_help = "Example:\n  luch lab density 'truncated(0.5, 0.18)' -o density.svg")]
pub(crate) struct DensityArgs {
    /// The density
    #[arg(default_value = luch_lab::density::CENTERED)]
    pub(crate) density: String,
    /// How many samples
    #[arg(long, value_name = "N", default_value = "400", value_parser = count)]
    pub(crate) samples: u64,
    /// Where points come from
    #[arg(long, value_name = "RULE", default_value = "independent", value_parser = rule)]
    pub(crate) sampler: Rule,
    /// Another seed gives other points
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    #[command(flatten)]
    pub(crate) output: LabOutputArgs,
}

/// Error against the number of points in 1, 2, 5, 10 and 20 dimensions: Monte Carlo, quasi-Monte Carlo, product grid
#[derive(Args, Debug)]
pub(crate) struct DimensionsArgs {
    /// Numbers of points
    #[arg(long, value_name = "FROM..TO", default_value = "2^6..2^14", value_parser = sizes)]
    pub(crate) n: Sizes,
    #[command(flatten)]
    pub(crate) output: LabOutputArgs,
}

/// Make all figures of the lecture's first half: one page, and every figure by itself
#[derive(Args, Debug)]
pub(crate) struct LectureArgs {
    /// The folder
    #[arg(short, long, value_name = "FOLDER", default_value = "lecture-figures")]
    pub(crate) output: PathBuf,
}

/// One sampler or all.
#[derive(Clone, Debug)]
pub(crate) struct Rules(pub(crate) Vec<Rule>);

/// Numbers of points.
#[derive(Clone, Debug)]
pub(crate) struct Sizes(pub(crate) Vec<u64>);

fn count(text: &str) -> Result<u64, String> {
    let number = match text.split_once('^') {
        Some(("2", exponent)) => exponent.trim().parse::<u32>().ok().filter(|e| *e <= 32).map(|e| 1u64 << e),
        _ => text.trim().parse().ok().filter(|n: &u64| (1..=1 << 32).contains(n)),
    };
    number.ok_or_else(|| format!("`{text}` is no number from 1 to 2^32; write 1000 or 2^10"))
}

fn sizes(text: &str) -> Result<Sizes, String> {
    let (from, to) = text.split_once("..").unwrap_or((text, text));
    let (from, to) = (count(from)?, count(to)?);
    if from > to {
        return Err(format!("`{text}` runs backwards"));
    }
    let sizes = std::iter::successors(Some(from), |size| size.checked_mul(2)).take_while(|size| *size <= to);
    Ok(Sizes(sizes.collect()))
}

fn rule(text: &str) -> Result<Rule, String> {
    Rule::from_name(text)
        .ok_or_else(|| parse::unknown("sampler", text, Rule::ALL.iter().map(|rule| rule.name())))
}

fn rules(text: &str) -> Result<Rules, String> {
    if text == "all" { Ok(Rules(Rule::ALL.to_vec())) } else { rule(text).map(|rule| Rules(vec![rule])) }
}

fn generator(text: &str) -> Result<Generator, String> {
    Generator::from_name(text).ok_or_else(|| {
        parse::unknown("generator", text, Generator::ALL.iter().map(|generator| generator.name()))
    })
}

fn target(text: &str) -> Result<Target, String> {
    Target::parse(text).map_err(|error| error.to_string())
}

fn theme(text: &str) -> Result<Theme, String> {
    match text {
        "light" => Ok(Theme::Light),
        "dark" => Ok(Theme::Dark),
        _ => Err(format!("`{text}` is neither light nor dark")),
    }
}
