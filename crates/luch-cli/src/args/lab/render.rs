//! `luch lab render` and `luch lab coverage`: what was typed.

use super::{LabOutputArgs, Sizes, count, sizes};
use crate::args::ParameterArgs;
use crate::parse::{self, IntegratorChoice, Size};
use clap::Args;
use luch::sampling::Sequence;
use std::path::PathBuf;

/// What samplers and integrators do to a picture: errors against samples and time, beside a reference
///
/// Every sampler renders the scene with every integrator, several times with seeds of their own. The table has root mean squared errors with the
/// reference's own noise taken off, slopes with intervals, the bias in standard errors, FLIP, and how many times more samples or time the first
/// row takes. Times are of this run; all else is the same everywhere. A reference that is rendered shares what is wrong in all renderings: a
/// file of another program or a closed form (--truth) does not.
#[derive(Args, Debug)]
#[command(
    after_long_help = "Examples:\n  luch lab render scenes/cornell.kdl\n  luch lab render scenes/furnace.kdl --truth 2 --sampler sobol,independent\n  luch lab render scene.kdl --integrator path,plain,direct --spp 2^0..2^8 -o study.html\n  luch lab render scene.kdl --reference other.exr --sampler sobol -o errors.svg"
)]
pub(crate) struct RenderStudyArgs {
    #[command(flatten)]
    pub(crate) scene: LabSceneArgs,
    /// Samplers (independent, stratified, halton, sobol), or all
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', default_value = "all", value_parser = samplers)]
    pub(crate) sampler: Vec<Samplers>,
    /// Integrators: path[:DEPTH], plain[:DEPTH], direct, occlusion[:METRES] [default: the scene's]
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = integrator)]
    pub(crate) integrator: Vec<IntegratorChoice>,
    /// Samples of each pixel
    #[arg(long, value_name = "FROM..TO", default_value = "2^0..2^6", value_parser = sizes)]
    pub(crate) spp: Sizes,
    /// Independent repetitions; intervals need 3
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..=65536))]
    pub(crate) replicates: u32,
    #[command(flatten)]
    pub(crate) truth: ReferenceArgs,
    /// Every pixel has this value: for furnaces
    #[arg(long = "truth", value_name = "VALUE", conflicts_with_all = ["reference", "reference_spp"], allow_hyphen_values = true, value_parser = value)]
    pub(crate) truth_value: Option<f64>,
    #[command(flatten)]
    pub(crate) output: LabOutputArgs,
}

/// Whether pictures state their error rightly: how often the interval held the truth
///
/// The scene is rendered again and again with a few samples and other seeds. A pixel's stated error is half the difference of two independent
/// streams. It is read as an interval by Student's t of one degree, and as if it were known; counted is how often these held the
/// reference, for kinds of pixels and for the picture's mean.
#[derive(Args, Debug)]
#[command(
    after_long_help = "Examples:\n  luch lab coverage scenes/cornell.kdl\n  luch lab coverage scene.kdl --renders 1000 --spp 64 --sampler independent -o coverage.html"
)]
pub(crate) struct CoverageArgs {
    #[command(flatten)]
    pub(crate) scene: LabSceneArgs,
    /// How many renders are judged
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u32).range(2..=1 << 20))]
    pub(crate) renders: u32,
    /// Samples of each pixel in each
    #[arg(long, value_name = "N", default_value = "16", value_parser = streams)]
    pub(crate) spp: u64,
    /// The sampler: independent, stratified, halton, sobol
    #[arg(long, value_name = "NAME", default_value = "sobol", value_parser = sampler)]
    pub(crate) sampler: Sequence,
    /// The integrator: path[:DEPTH], plain[:DEPTH], direct, occlusion[:METRES] [default: the scene's]
    #[arg(long, value_name = "NAME", value_parser = integrator)]
    pub(crate) integrator: Option<IntegratorChoice>,
    /// Levels in percent
    #[arg(long, value_name = "PERCENT,…", value_delimiter = ',', default_value = "50,68,90,95,99", value_parser = level)]
    pub(crate) levels: Vec<f64>,
    #[command(flatten)]
    pub(crate) truth: ReferenceArgs,
    #[command(flatten)]
    pub(crate) output: LabOutputArgs,
}

/// What is rendered.
#[derive(Args, Debug)]
pub(crate) struct LabSceneArgs {
    /// A scene: .kdl, .gltf, .glb, .obj, .ply, .stl, .xml (Mitsuba 3)
    #[arg(value_name = "SCENE")]
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) parameters: ParameterArgs,
    /// Pixels [default: those of the reference, or 128x96; 64x48 for coverage]
    #[arg(long, value_name = "WxH", value_parser = parse::size)]
    pub(crate) size: Option<Size>,
    /// A camera of the scene by name
    #[arg(long, value_name = "NAME")]
    pub(crate) camera: Option<String>,
    /// Another seed gives other renders
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
}

/// What pictures are held against.
#[derive(Args, Debug)]
pub(crate) struct ReferenceArgs {
    /// Light: .luch, .exr, .hdr, .pfm, .npy; the error of a film, or of the layer stderr, is taken into account
    #[arg(long, value_name = "FILE")]
    pub(crate) reference: Option<PathBuf>,
    /// Samples of a pixel of a reference that is rendered now [default: 16 times the most samples; 64 times for coverage]
    #[arg(long, value_name = "N", conflicts_with = "reference", value_parser = streams)]
    pub(crate) reference_spp: Option<u64>,
}

/// One sampler or all.
#[derive(Clone, Debug)]
pub(crate) struct Samplers(pub(crate) Vec<Sequence>);

fn sampler(text: &str) -> Result<Sequence, String> {
    Sequence::from_name(text)
        .ok_or_else(|| parse::unknown("sampler", text, Sequence::ALL.iter().map(|sequence| sequence.name())))
}

fn samplers(text: &str) -> Result<Samplers, String> {
    if text == "all" {
        Ok(Samplers(Sequence::ALL.to_vec()))
    } else {
        sampler(text).map(|one| Samplers(vec![one]))
    }
}

fn integrator(text: &str) -> Result<IntegratorChoice, String> {
    const NAMES: [&str; 5] = ["path", "plain", "plain-path", "direct", "occlusion"];
    let name = text.split(':').next().unwrap_or(text);
    if !NAMES.contains(&name) {
        return Err(parse::unknown("integrator", name, NAMES.into_iter()));
    }
    let whole = if name == "plain" { text.replacen("plain", "plain-path", 1) } else { text.to_owned() };
    whole.parse()
}

/// Samples of both streams.
fn streams(text: &str) -> Result<u64, String> {
    match count(text)? {
        1 => Err("1 sample is of one stream and states no error; accepted are 2 and more".to_owned()),
        count => Ok(count),
    }
}

fn level(text: &str) -> Result<f64, String> {
    let percent = text.trim().trim_end_matches('%').trim_end().parse().ok();
    let percent = percent.filter(|percent: &f64| *percent > 0.0 && *percent < 100.0);
    percent
        .map(|percent| percent / 100.0)
        .ok_or_else(|| format!("`{text}` is no level; write a percentage between 0 and 100, such as 95"))
}

fn value(text: &str) -> Result<f64, String> {
    let value = text.parse().ok().filter(|value: &f64| value.is_finite());
    value.ok_or_else(|| format!("`{text}` is no finite number"))
}
