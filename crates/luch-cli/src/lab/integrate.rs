//! `luch lab integrate`: any integral.

use super::live::Live;
use super::output::{check, give, report};
use crate::args::IntegrateArgs;
use crate::failure::{Failure, Outcome};
use crate::interrupt::Interrupt;
use luch_lab::figure::{Axis, Between, Figure, Ink};
use luch_lab::integral::{
    Convergence, Integral, Look, Outcome as Found, RulePoints, Target, Verdict, convergence,
    convergence_figure, until_watched,
};
use luch_lab::points::Rule;
use luch_lab::report::{Report, Table};
use std::ops::ControlFlow;

pub(super) fn run(args: &IntegrateArgs) -> Result<Outcome, Failure> {
    check(&args.output)?;
    let mut integral = Integral::new(&args.formula, &args.over)?;
    if let Some(density) = &args.density {
        integral = integral.with_density(density)?;
    }
    if let Some(truth) = &args.truth {
        integral = integral.with_truth(truth)?;
    }
    let title = format!("∫ {} over {}", args.formula, args.over);
    match args.until {
        Some(target) => go_on(args, &integral, title, target),
        None => compare(args, &integral, title),
    }
}

/// Every sampler at every number of points.
fn compare(args: &IntegrateArgs, integral: &Integral, title: String) -> Result<Outcome, Failure> {
    let dimensions = integral.dimensions();
    let mut found = Vec::new();
    let rules: Vec<Rule> = args.sampler.iter().flat_map(|rules| rules.0.iter().copied()).collect();
    let is_all = rules.len() >= Rule::ALL.len();
    let mut live = Live::new(args.output.json);
    for rule in rules {
        let sizes: Vec<u64> = args.n.0.iter().map(|&size| rule.nearest_count(size, dimensions)).collect();
        match sizes.iter().try_for_each(|&size| rule.accepts(size, dimensions)) {
            // Of all samplers those that have such points.
            Err(_) if is_all => continue,
            Err(error) => return Err(error.into()),
            Ok(()) => {}
        }
        // Without chance all replicates are one.
        let points = RulePoints { rule, seed: args.seed };
        found.push(convergence(rule.name(), integral, &points, &sizes, args.replicates));
        live.show(|| convergence_figure(&title, &found));
    }
    live.end();
    let mut page = report(title.clone());
    if let Some(place) = integral.blind_spot() {
        page = page.text(format!("WARNING: the density is zero where the integrand is not, as at {place:?}: the result is too small."));
    }
    let page = page.table(table(integral, &found)).figure(convergence_figure(&title, &found));
    give(&page, &args.output)
}

fn table(integral: &Integral, found: &[Convergence]) -> Table {
    let head = ["sampler", "N", "mean", "rms error", "slope", "95 %", "equal error", "ns a sample"];
    let mut table = Table::new(head);
    for one in found {
        let Some(last) = one.rows.last() else { continue };
        let (slope, interval) = match one.slope {
            _ if !one.has_errors => ("not known".to_owned(), String::new()),
            _ if one.is_exact => ("exact".to_owned(), String::new()),
            Some(fit) => (format!("{:.2}", fit.slope), format!("{:.2} to {:.2}", fit.low, fit.high)),
            None => (String::new(), String::new()),
        };
        table = table.row([
            one.name.clone(),
            last.samples.to_string(),
            format!("{:.9}", last.mean),
            if one.has_errors { format!("{:.2e}", last.rmse) } else { String::new() },
            slope,
            interval,
            one.equal_error_factor.map_or(String::new(), |factor| format!("{factor:.3}")),
            format!("{:.1}", one.nanoseconds_per_sample),
        ]);
    }
    match integral.truth {
        Some(truth) => table.row(["truth".to_owned(), String::new(), format!("{truth:.9}")]),
        None => table,
    }
}

/// Until the error is reached.
fn go_on(
    args: &IntegrateArgs,
    integral: &Integral,
    title: String,
    target: Target,
) -> Result<Outcome, Failure> {
    let points = RulePoints { rule: Rule::SobolHashed, seed: args.seed };
    Rule::SobolHashed.accepts(1, integral.dimensions())?;
    let interrupt = Interrupt::install()?;
    interrupt.work_begins();
    let mut live = Live::new(args.output.json);
    let found = until_watched(integral, &points, target, args.limit, &mut |looks| {
        live.show(|| looks_figure(looks, integral));
        if interrupt.pen().is_interrupted() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    live.end();
    let result = match (found.verdict, found.half_width) {
        (Verdict::Reached, Some(half)) => {
            format!("{:.12} ± {half:.2e} after {} samples", found.estimate, found.samples)
        }
        (Verdict::LimitReached, Some(half)) => {
            format!(
                "{:.12} ± {half:.2e} after {} samples: the limit; the target is not reached",
                found.estimate, found.samples
            )
        }
        (Verdict::Interrupted, Some(half)) => {
            format!("{:.12} ± {half:.2e} after {} samples: interrupted", found.estimate, found.samples)
        }
        (Verdict::HeavyTail, _) => {
            format!("{:.6}, without an interval: the variance may be infinite", found.estimate)
        }
        (Verdict::BlindSpot, _) => "no result: the density is zero where the integrand is not".to_owned(),
        (Verdict::NotFinite, _) => {
            "no result: the integrand is infinite or undefined somewhere in the box".to_owned()
        }
        (_, None) => format!("{:.6}, without an interval", found.estimate),
    };
    let mut page = report(title).text(result);
    if let Some(truth) = integral.truth {
        page = page.text(format!("truth {truth:.12}, off by {:+.2e}", found.estimate - truth));
    }
    page = found.warnings.iter().fold(page, |page, warning| page.text(format!("WARNING: {warning}")));
    let outcome = give(&looks(page, &found, integral), &args.output)?;
    Ok(match found.verdict {
        Verdict::Reached => outcome,
        Verdict::Interrupted => Outcome::Interrupted,
        _ => Outcome::Unmet,
    })
}

fn looks(page: Report, found: &Found, integral: &Integral) -> Report {
    if found.looks.is_empty() {
        return page;
    }
    let mut table = Table::new(["samples", "estimate", "half width"]);
    for look in &found.looks {
        table = table.row([
            look.samples.to_string(),
            format!("{:.12}", look.estimate),
            format!("{:.2e}", look.half_width),
        ]);
    }
    page.table(table).figure(looks_figure(&found.looks, integral))
}

fn looks_figure(looks: &[Look], integral: &Integral) -> Figure {
    let between = |look: &Look| Between {
        x: look.samples as f64,
        low: look.estimate - look.half_width,
        high: look.estimate + look.half_width,
    };
    let line = looks.iter().map(|look| [look.samples as f64, look.estimate]).collect();
    let figure = Figure::new("The estimate and its interval")
        .with_x(Axis::log2("samples"))
        .with_y(Axis::linear("estimate"))
        .band("interval", Ink::of(0), looks.iter().map(between).collect())
        .line("estimate", Ink::of(0), line);
    match integral.truth {
        Some(truth) => figure.level("truth", truth),
        None => figure,
    }
}
