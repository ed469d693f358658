//! `luch lab pi` and the like: problems with known answers.

use super::output::{give, report};
use crate::args::ProblemArgs;
use crate::failure::{Failure, Outcome};
use crate::parse::unknown;
use crate::terminal::say;
use clap::Parser;
use luch_lab::integral::RulePoints;
use luch_lab::problem::Problem;
use luch_lab::report::Table;
use std::ffi::OsString;

pub(super) fn list() -> Result<Outcome, Failure> {
    for name in Problem::NAMES {
        if let Some(problem) = Problem::named(name) {
            say(&format!("  {name:17} {}", problem.description));
        }
    }
    Ok(Outcome::Done)
}

pub(super) fn run(words: &[OsString]) -> Result<Outcome, Failure> {
    let args = match ProblemArgs::try_parse_from(words) {
        Ok(args) => args,
        Err(error) => error.exit(),
    };
    let Some(problem) = Problem::named(&args.name) else {
        let verbs = [
            "problems",
            "integrate",
            "points",
            "measure",
            "slopes",
            "prng",
            "density",
            "dimensions",
            "explain",
            "chi2",
            "mis",
            "control",
            "roulette",
            "width",
            "strata",
            "truth",
            "lecture",
            "render",
            "coverage",
        ];
        let known = Problem::NAMES.iter().copied().chain(verbs);
        return Err(Failure::usage(unknown("problem or verb", &args.name, known)));
    };
    args.sampler
        .accepts(args.sampler.nearest_count(args.samples, problem.dimensions()), problem.dimensions())?;
    if !(args.sampler.is_sequence() || args.sampler.is_streamed()) && args.sampler.name() != "independent" {
        let message = format!(
            "`{}` makes sets of one size; `luch lab integrate` and `slopes` take them",
            args.sampler.name()
        );
        return Err(Failure::usage(message));
    }
    let found = problem.run(args.samples, &RulePoints { rule: args.sampler, seed: args.seed });
    let mut table = Table::new(["samples", "estimate", "standard error", "error"]);
    for row in &found.rows {
        table = table.row([
            row.samples.to_string(),
            format!("{:.8}", row.estimate),
            if found.has_error { format!("{:.2e}", row.standard_error) } else { String::new() },
            format!("{:+.2e}", row.estimate - found.truth),
        ]);
    }
    let used = match found.samples {
        used if used == args.samples => String::new(),
        used => format!("   {used} samples: 16 randomisations of {} each", used / 16),
    };
    let error = match found.has_error {
        true => format!("standard error {:.2e}", found.standard_error),
        false => "no standard error: these points have no chance in them".to_owned(),
    };
    let off = match found.has_error {
        true => format!("{:+.2} standard errors off", found.z_score),
        false => format!("{:+.2e} off", found.estimate - found.truth),
    };
    let result = format!("estimate {:.9}   {error}   truth {:.9}   {off}{used}", found.estimate, found.truth);
    let page = report(problem.description.clone())
        .text(result)
        .table(table)
        .text(found.explanation.clone())
        .figure(found.figure.clone())
        .figure(found.progress.clone());
    give(&page, &args.output)
}
