//! `luch lab truth`: scenes whose radiance is known.

use super::output::{check, give, report};
use crate::args::TruthArgs;
use crate::failure::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::progress::bar;
use crate::terminal::{clock, complain, rewrite_line, say};
use luch::render::Stop;
use luch::sampling::Sequence;
use luch_lab::report::{Report, Table};
use luch_lab::truth::{
    self, Case, Choice, Effort, Family, Judgement, Row, Technique, TruthError, histogram, table, z_scores,
};
use std::io::IsTerminal;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Time between two looks at the work.
const LOOK: Duration = Duration::from_millis(100);

pub(super) fn run(args: &TruthArgs) -> Result<Outcome, Failure> {
    if args.list {
        for family in Family::ALL {
            say(&format!("  {:8} {}", family.name(), family.shows()));
        }
        return Ok(Outcome::Done);
    }
    check(&args.output)?;
    let is_wanted = |family: &Family| args.families.iter().any(|some| some.0.contains(family));
    let families: Vec<Family> = Family::ALL.into_iter().filter(is_wanted).collect();
    let choice = Choice {
        sequences: Sequence::ALL
            .into_iter()
            .filter(|one| args.sampler.iter().any(|some| some.0.contains(one)))
            .collect(),
        techniques: Technique::ALL
            .into_iter()
            .filter(|one| args.integrator.iter().any(|some| some.0.contains(one)))
            .collect(),
    };
    let cases: Vec<Case> = families.iter().flat_map(|family| family.cases()).collect();
    let wanted = choice.count(&cases);
    if wanted == 0 {
        return Err(Failure::usage("no case of these families is for these integrators"));
    }
    let effort = Effort { seed: args.seed, relative_error: args.error };
    let interrupt = Interrupt::install()?;
    let rows = watch(&interrupt, &cases, &choice, effort, !args.output.json)?;
    let is_interrupted = rows.len() < wanted;
    if is_interrupted {
        complain(&format!("interrupted: {} of {wanted} rows were judged", rows.len()));
    }
    if rows.is_empty() {
        return Ok(Outcome::Interrupted);
    }
    let judgement = Judgement::of(&rows, effort, args.alpha);
    give(&page(&families, &rows, &judgement), &args.output)?;
    Ok(match judgement.is_accepted() {
        _ if is_interrupted => Outcome::Interrupted,
        true => Outcome::Done,
        false => Outcome::Unmet,
    })
}

/// Judges all, telling how far it is, until it is done or somebody has seen enough.
fn watch(
    interrupt: &Interrupt,
    cases: &[Case],
    choice: &Choice,
    effort: Effort,
    may_tell: bool,
) -> Result<Vec<Row>, TruthError> {
    let (stop, done, begun) = (Stop::new(), AtomicUsize::new(0), Instant::now());
    let is_shown = may_tell && std::io::stderr().is_terminal();
    let wanted = choice.count(cases);
    interrupt.work_begins();
    let rows = std::thread::scope(|scope| {
        let work = scope.spawn(|| truth::run(cases, choice, effort, &stop, &done));
        while !work.is_finished() {
            if interrupt.wait(LOOK) {
                stop.request();
            }
            if is_shown {
                let done = done.load(Ordering::Relaxed);
                let share = done as f64 / wanted as f64;
                let (percent, elapsed) = ((100.0 * share).floor(), clock(begun.elapsed()));
                rewrite_line(&format!("{percent:3.0}% {}  {done}/{wanted}  {elapsed} elapsed", bar(share)));
            }
        }
        work.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    });
    if is_shown {
        rewrite_line("");
    }
    rows
}

fn page(families: &[Family], rows: &[Row], judgement: &Judgement) -> Report {
    let shown = families.iter().fold(Table::new(["family", "what it shows"]), |table, family| {
        table.row([family.name(), family.shows()])
    });
    let page = report("Scenes whose radiance is known")
        .table(shown)
        .table(table(rows, judgement))
        .figure(z_scores(rows))
        .figure(histogram(rows, judgement));
    said(rows, judgement).into_iter().fold(page, Report::text)
}

/// What all rows together say, in sentences.
fn said(rows: &[Row], judgement: &Judgement) -> Vec<String> {
    let mut lines = Vec::new();
    let percent = 100.0 * judgement.alpha;
    let exact = rows.len() - judgement.tests;
    let mut all = format!(
        "{} rows, {exact} of them without variance. Rejected is p < {:.1e}, so that a right renderer is rejected in {percent} % of all runs (Šidák).",
        rows.len(),
        judgement.limit
    );
    if let Some(row) = judgement.worst.and_then(|worst| rows.get(worst)) {
        let Row { case, way, sequence, verdict, .. } = row;
        let (family, sequence) = (row.family.name(), sequence.name());
        all +=
            &format!(" The smallest is {:.1e}: {family}, {case}, by {way} with {sequence}.", verdict.p_value);
    }
    lines.push(all);
    let even = judgement.uniformity;
    let suspicious = if even.p_value < 1e-3 || even.p_value > 0.999 { ", which is suspicious" } else { "" };
    lines.push(format!(
        "All p against an even spread (Kolmogorov and Smirnov; for information): distance {:.3}, p = {:.3}{suspicious}.",
        even.statistic, even.p_value
    ));
    if judgement.untold > 0 {
        lines.push(format!("{} rows are noisier than was asked for.", judgement.untold));
    }
    lines.push(match judgement.rejected {
        0 => "ACCEPTED: nothing is farther from the truth than chance allows.".to_owned(),
        rejected => format!("REJECTED: {rejected} rows are farther from the truth than chance allows."),
    });
    lines
}
