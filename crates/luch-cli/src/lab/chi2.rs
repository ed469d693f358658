//! `luch lab chi2`: every sampling routine against its density.

use super::output::{check, give, report};
use super::ticker::Ticker;
use crate::args::Chi2Args;
use crate::failure::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::parse::unknown;
use luch::sampling::check::FitSettings;
use luch_lab::chi_squared::{Family, Routine, Verdict, evenness, is_named, level, run_all, suite};
use luch_lab::report::Table;
use std::collections::BTreeSet;

pub(super) fn run(args: &Chi2Args) -> Result<Outcome, Failure> {
    check(&args.output)?;
    if args.samples < 1000 {
        return Err(Failure::usage("--samples: fewer than 1000 tell nothing"));
    }
    let _interrupt = Interrupt::install()?;
    let routines = chosen(&args.names)?;
    let settings = FitSettings { samples: args.samples, bins: args.bins as usize, seed: args.seed };
    let ticker = Ticker::new("tested", args.output.json);
    let verdicts = run_all(&routines, settings, &|done| ticker.tell(done, routines.len()));
    drop(ticker);
    let each = level(args.alpha, routines.len());
    let rejected: Vec<&Verdict> = verdicts.iter().filter(|verdict| !verdict.agrees(each)).collect();

    let mut page = report("Samples against their stated densities")
        .text("χ² compares how many samples fell into bins with the stated density integrated over each. ∫ pdf is that integral over everything, and share the part of tries that gave a sample (the rest are delta lobes, and directions that carry no light): the two must agree within 0.2 % and chance.")
        .table(table(&verdicts, each));
    let conclusion = match rejected.as_slice() {
        [] => format!(
            "All {} routines agree with their densities at the level {} for all together: each p is above {each:.2e}.",
            verdicts.len(),
            args.alpha
        ),
        some => format!(
            "{} of {} REJECTED at the level {} for all together (each p must be above {each:.2e}): {}.",
            some.len(),
            verdicts.len(),
            args.alpha,
            some.iter().map(|verdict| verdict.id.as_str()).collect::<Vec<_>>().join(", ")
        ),
    };
    page = page.text(conclusion);
    if let Some(p) = evenness(&verdicts) {
        page = page.text(format!(
            "Right densities give p-values spread evenly from 0 to 1; these do with p = {p:.3}."
        ));
    }
    let worst =
        verdicts.iter().enumerate().min_by(|(_, a), (_, b)| order(a, each).total_cmp(&order(b, each)));
    let looked = FitSettings { samples: args.samples.max(1 << 20), ..settings };
    if let Some(sheet) = worst.and_then(|(place, _)| routines[place].sheet(looked)) {
        page = page.sheet(sheet);
    }
    let outcome = give(&page, &args.output)?;
    Ok(if rejected.is_empty() { outcome } else { Outcome::Unmet })
}

/// Rejected ones first, then by p.
fn order(verdict: &Verdict, level: f64) -> f64 {
    if verdict.agrees(level) { verdict.p_value } else { verdict.p_value - 1.0 }
}

fn chosen(names: &[String]) -> Result<Vec<Routine>, Failure> {
    let suite = suite();
    for name in names {
        if name != "all" && !suite.iter().any(|routine| is_named(routine, name)) {
            let known: BTreeSet<String> =
                suite.iter().flat_map(|routine| [routine.name.clone(), routine.id()]).collect();
            let is_numbered = name.contains(':');
            let known = known.iter().map(String::as_str).filter(|known| known.contains(':') == is_numbered);
            let families = ["all"].into_iter().chain(Family::ALL.map(Family::name));
            return Err(Failure::usage(match is_numbered {
                true => unknown("routine", name, known),
                false => unknown("routine", name, families.chain(known)),
            }));
        }
    }
    let is_wanted = |routine: &Routine| names.iter().any(|name| is_named(routine, name));
    Ok(suite.into_iter().filter(is_wanted).collect())
}

fn table(verdicts: &[Verdict], level: f64) -> Table {
    let head = ["family", "routine", "parameters", "bins", "χ²", "degrees", "p", "∫ pdf", "share", "verdict"];
    let mut table = Table::new(head);
    for verdict in verdicts {
        table = table.row([
            verdict.family.name().to_owned(),
            verdict.id.clone(),
            verdict.parameters.clone(),
            verdict.bins.to_string(),
            format!("{:.1}", verdict.statistic),
            verdict.degrees.to_string(),
            if verdict.p_value < 1e-4 {
                format!("{:.1e}", verdict.p_value)
            } else {
                format!("{:.4}", verdict.p_value)
            },
            format!("{:.5}", verdict.integral),
            format!("{:.5}", verdict.share),
            if verdict.agrees(level) { "agrees" } else { "REJECTED" }.to_owned(),
        ]);
    }
    table
}
