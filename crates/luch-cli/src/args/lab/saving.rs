//! What was typed after `luch lab mis`, `control`, `roulette`, `width`, `strata`: ways to save samples.

use super::{LabOutputArgs, count, rule};
use clap::Args;
use luch_lab::points::Rule;

/// Two densities at once: balance, power and optimal weights (multiple importance sampling)
///
/// Two techniques that each find a part of the integrand are joined by weights that add to one. The variance is that of one sample of each
/// technique, by quadrature; of one technique alone, that of two of its samples.
#[derive(Args, Debug)]
#[command(
    after_long_help = "Example:\n  luch lab mis 'cos(x)^77' --over x=-pi/2..pi/2 --first 'normal(0, 0.05)' --second uniform"
)]
pub(crate) struct MisArgs {
    /// The integrand, in one dimension
    #[arg(default_value = "8*exp(-((x-0.2)/0.02)^2) + 1 + x")]
    pub(crate) formula: String,
    /// The range
    #[arg(long, value_name = "DOMAIN", default_value = "x=0..1")]
    pub(crate) over: String,
    /// The first density
    #[arg(long, value_name = "DENSITY", default_value = "truncated(0.2, 0.02)")]
    pub(crate) first: String,
    /// The second density
    #[arg(long, value_name = "DENSITY", default_value = "uniform")]
    pub(crate) second: String,
    /// Pairs of samples
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

/// Take away something similar whose integral is known (control variates)
///
/// What is left of the integrand has the same integral and, if the control is similar, less variance. How much of the control is taken
/// away comes from a tenth of the samples, which are not used again.
#[derive(Args, Debug)]
#[command(
    after_long_help = "Example:\n  luch lab control 'exp(x*y)' --over x=0..1,y=0..1 --control 'x*y' --known 1/4"
)]
pub(crate) struct ControlArgs {
    /// The integrand
    #[arg(default_value = "exp(x)")]
    pub(crate) formula: String,
    /// The box
    #[arg(long, value_name = "DOMAIN", default_value = "x=0..1")]
    pub(crate) over: String,
    /// Something similar
    #[arg(long, value_name = "FORMULA", default_value = "x")]
    pub(crate) control: String,
    /// Its integral
    #[arg(long, value_name = "VALUE", default_value = "1/2")]
    pub(crate) known: String,
    /// How points are drawn
    #[arg(long, value_name = "DENSITY")]
    pub(crate) density: Option<String>,
    /// How many samples, at least 100
    #[arg(long, value_name = "N", default_value = "65536", value_parser = count)]
    pub(crate) samples: u64,
    /// Another seed gives other points
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    #[command(flatten)]
    pub(crate) output: LabOutputArgs,
}

/// Russian roulette and splitting, judged by variance × time
///
/// Going on less often saves time and adds variance, going on several times does the opposite; the best rate has the least product. Three
/// kinds of paths are shown, or one's own.
#[derive(Args, Debug)]
#[command(
    after_long_help = "Example:\n  luch lab roulette --direct 1,4 --weight 0.2,0.01 --amount 1,0.01 --cost 1,50"
)]
pub(crate) struct RouletteArgs {
    /// Mean and variance of what the first stage gives at once
    #[arg(long, value_name = "MEAN,VARIANCE", value_parser = moments, allow_hyphen_values = true)]
    pub(crate) direct: Option<[f64; 2]>,
    /// Mean and variance of the weight with which the second stage counts
    #[arg(long, value_name = "MEAN,VARIANCE", value_parser = moments, allow_hyphen_values = true)]
    pub(crate) weight: Option<[f64; 2]>,
    /// Mean and variance of what the second stage gives
    #[arg(long, value_name = "MEAN,VARIANCE", value_parser = moments, allow_hyphen_values = true)]
    pub(crate) amount: Option<[f64; 2]>,
    /// Time of the first and of the second stage
    #[arg(long, value_name = "FIRST,SECOND", value_parser = costs)]
    pub(crate) cost: Option<[f64; 2]>,
    /// Rounds that are played at each rate
    #[arg(long, value_name = "N", default_value = "2^16", value_parser = count)]
    pub(crate) rounds: u64,
    /// Another seed gives another play
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    #[command(flatten)]
    pub(crate) output: LabOutputArgs,
}

/// The best width of a normal density: too narrow is worse than too wide
///
/// A density that is too wide wastes samples; one that is too narrow rarely sees the flanks, and what it sees there weighs enormously.
/// Variances are by quadrature.
#[derive(Args, Debug)]
#[command(
    after_long_help = "Examples:\n  luch lab width\n  luch lab width '1/(1+x^2)' --over x=-5..5 --from 0.5 --to 10 --widths 1,2,3"
)]
pub(crate) struct WidthArgs {
    /// The integrand, in one dimension
    #[arg(default_value = "cos(x)^77")]
    pub(crate) formula: String,
    /// The range
    #[arg(long, value_name = "DOMAIN", default_value = "x=-pi/2..pi/2")]
    pub(crate) over: String,
    /// Where the density has its middle
    #[arg(long, value_name = "MEAN", default_value = "0", value_parser = number, allow_hyphen_values = true)]
    pub(crate) mean: f64,
    /// The least width
    #[arg(long, value_name = "WIDTH", default_value = "0.05", value_parser = positive)]
    pub(crate) from: f64,
    /// The greatest width
    #[arg(long, value_name = "WIDTH", default_value = "0.6", value_parser = positive)]
    pub(crate) to: f64,
    /// Widths in the table
    #[arg(long, value_name = "WIDTH,…", value_delimiter = ',', default_value = "0.08,0.1,0.12,0.13,0.15,0.3", value_parser = positive)]
    pub(crate) widths: Vec<f64>,
    #[command(flatten)]
    pub(crate) output: LabOutputArgs,
}

/// What one random point in each cell leaves of the variance: exactly, and as measured
///
/// π by a disc over n × n cells: only cells that the edge crosses have any variance left. ∫cos⁷⁷ over N strata: within a narrow stratum
/// hardly anything varies.
#[derive(Args, Debug)]
#[command(after_long_help = "Example:\n  luch lab strata --repetitions 2^14 -o strata.svg")]
pub(crate) struct StrataArgs {
    /// Estimates at each number of cells
    #[arg(long, value_name = "N", default_value = "4096", value_parser = count)]
    pub(crate) repetitions: u64,
    /// Another seed gives other points
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    #[command(flatten)]
    pub(crate) output: LabOutputArgs,
}

fn number(text: &str) -> Result<f64, String> {
    let number = text.trim().parse().ok().filter(|number: &f64| number.is_finite());
    number.ok_or_else(|| format!("`{text}` is no number"))
}

fn positive(text: &str) -> Result<f64, String> {
    number(text).ok().filter(|x| *x > 0.0).ok_or_else(|| format!("`{text}` is no number above 0"))
}

fn pair(text: &str) -> Option<[f64; 2]> {
    let (a, b) = text.split_once(',')?;
    Some([number(a).ok()?, number(b).ok()?])
}

fn moments(text: &str) -> Result<[f64; 2], String> {
    let found = pair(text).filter(|[_, variance]| *variance >= 0.0);
    found.ok_or_else(|| format!("`{text}` is no mean and variance; write two numbers, such as 1,0.25"))
}

fn costs(text: &str) -> Result<[f64; 2], String> {
    let found = pair(text).filter(|costs| costs.iter().all(|cost| *cost > 0.0));
    found.ok_or_else(|| format!("`{text}` are no two times; write two numbers above 0, such as 1,50"))
}
