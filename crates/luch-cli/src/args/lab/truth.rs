//! `luch lab truth`: what was typed.

use super::LabOutputArgs;
use crate::parse;
use clap::Args;
use luch::sampling::Sequence;
use luch_lab::truth::{Family, MISSING, Technique};

/// Does the renderer find radiance that is known? Scenes with closed forms, rendered and judged
///
/// Every row is a case by one integrator with one sampler: truth, estimate, standard error, how many errors off (z) and how probable that
/// is by chance (p). All rows are judged together: exit status 1 if the smallest p is less than chance allows (Šidák).
#[derive(Args, Debug)]
#[command(
    after_long_help = "Examples:\n  luch lab truth --list\n  luch lab truth F14 F15 --sampler all\n  luch lab truth --integrator path --error 0.2% -o truth.html"
)]
pub(crate) struct TruthArgs {
    /// Families of cases, or all; --list tells them
    #[arg(value_name = "FAMILY", default_value = "all", value_parser = families)]
    pub(crate) families: Vec<Families>,
    /// List the families and what each shows
    #[arg(long)]
    pub(crate) list: bool,
    /// Samplers: independent, stratified, halton, sobol, or all
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', default_value = "sobol", value_parser = sequences)]
    pub(crate) sampler: Vec<Sequences>,
    /// Integrators: path, plain-path, direct, occlusion, or all; each where it applies
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', default_value = "all", value_parser = techniques)]
    pub(crate) integrator: Vec<Techniques>,
    /// Standard error of every estimate, relative to the truth; half of it takes four times the time
    #[arg(long, value_name = "X", default_value = "0.5%", value_parser = precision)]
    pub(crate) error: f64,
    /// How often a right renderer may be rejected by chance
    #[arg(long, value_name = "P", default_value = "0.01", value_parser = level)]
    pub(crate) alpha: f64,
    /// Another seed gives other samples
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    #[command(flatten)]
    pub(crate) output: LabOutputArgs,
}

/// One family or all.
#[derive(Clone, Debug)]
pub(crate) struct Families(pub(crate) Vec<Family>);

/// One sequence or all.
#[derive(Clone, Debug)]
pub(crate) struct Sequences(pub(crate) Vec<Sequence>);

/// One integrator or all.
#[derive(Clone, Debug)]
pub(crate) struct Techniques(pub(crate) Vec<Technique>);

fn families(text: &str) -> Result<Families, String> {
    if text == "all" {
        return Ok(Families(Family::ALL.to_vec()));
    }
    if let Some((name, reason)) = MISSING.iter().find(|(name, _)| name.eq_ignore_ascii_case(text)) {
        return Err(format!("{name} is not rendered: {reason}"));
    }
    let names = Family::ALL.iter().map(|family| family.name());
    Family::from_name(text)
        .map(|family| Families(vec![family]))
        .ok_or_else(|| parse::unknown("family", text, names))
}

fn sequences(text: &str) -> Result<Sequences, String> {
    let names = Sequence::ALL.iter().map(|sequence| sequence.name());
    match text {
        "all" => Ok(Sequences(Sequence::ALL.to_vec())),
        _ => Sequence::from_name(text)
            .map(|sequence| Sequences(vec![sequence]))
            .ok_or_else(|| parse::unknown("sampler", text, names)),
    }
}

fn techniques(text: &str) -> Result<Techniques, String> {
    let names = Technique::ALL.iter().map(|technique| technique.name());
    match text {
        "all" => Ok(Techniques(Technique::ALL.to_vec())),
        "plain" => Ok(Techniques(vec![Technique::PlainPath])),
        _ => Technique::from_name(text)
            .map(|technique| Techniques(vec![technique]))
            .ok_or_else(|| parse::unknown("integrator", text, names)),
    }
}

fn precision(text: &str) -> Result<f64, String> {
    let error = parse::fraction(text)?;
    let accepted = (0.0005..=0.1).contains(&error);
    accepted.then_some(error).ok_or_else(|| format!("`{text}`: accepted are errors from 0.05% to 10%"))
}

fn level(text: &str) -> Result<f64, String> {
    let level = text.parse().ok().filter(|level: &f64| (1e-12..=0.5).contains(level));
    level.ok_or_else(|| format!("`{text}` is no probability from 1e-12 to 0.5"))
}
