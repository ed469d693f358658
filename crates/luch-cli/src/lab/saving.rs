//! `luch lab mis`, `control`, `roulette`, `width`, `strata`: ways to save samples.

use super::output::{give, report};
use crate::args::{ControlArgs, MisArgs, RouletteArgs, StrataArgs, WidthArgs};
use crate::failure::{Failure, Outcome};
use luch_lab::density::{
    MisWeights, TwoStages, control_figure, control_variate, mis as two_techniques, normal_scan, stages_figure,
};
use luch_lab::figure::Sheet;
use luch_lab::generator::Generator;
use luch_lab::integral::{Integral, RulePoints};
use luch_lab::points::Rule;
use luch_lab::report::Table;
use luch_lab::strata::{StrataProblem, strata as measured_strata, strata_figure};

/// A number that may be without bound.
fn variance(value: f64) -> String {
    if value.is_finite() { format!("{value:.4e}") } else { "no bound".to_owned() }
}

pub(super) fn mis(args: &MisArgs) -> Result<Outcome, Failure> {
    let integral = Integral::new(&args.formula, &args.over)?.with_density(&args.first)?;
    args.sampler.accepts(args.sampler.nearest_count(args.samples, 2), 2)?;
    let points = RulePoints { rule: args.sampler, seed: args.seed };
    let Some(found) = two_techniques(&integral, &args.second, &points, args.samples as usize)? else {
        return Err(Failure::usage("mis takes one dimension with finite ends, such as --over x=0..1"));
    };
    let of = |kind| found.rows.iter().find(|row| row.weights == kind).map_or(f64::NAN, |row| row.variance);
    let alone = of(MisWeights::First).min(of(MisWeights::Second));
    let mut table =
        Table::new(["weights", "variance", "less by", "estimate", "standard error", "errors off"]);
    for row in &found.rows {
        let off = (row.estimate - found.integral) / row.standard_error;
        table = table.row([
            row.weights.name().to_owned(),
            variance(row.variance),
            if row.variance > 0.0 { format!("{:.2} ×", alone / row.variance) } else { "all".to_owned() },
            format!("{:.8}", row.estimate),
            format!("{:.1e}", row.standard_error),
            if off.is_finite() { format!("{off:+.2}") } else { String::new() },
        ]);
    }
    let page = report(format!("{} by {} and {}", args.formula, args.first, args.second))
        .text("Each technique finds what its own density favours; weights that add to one join them without bias, and where one is hopeless the other takes over. Balance weighs by the densities, power by their squares, optimal weights have the least variance of all, and may be negative.")
        .text(format!("integral {:.12}, by quadrature; `less by` is against the better technique alone", found.integral))
        .table(table)
        .figure(found.figure);
    give(&page, &args.output)
}

pub(super) fn control(args: &ControlArgs) -> Result<Outcome, Failure> {
    let drawn = |integral: Integral| match &args.density {
        Some(density) => integral.with_density(density),
        None => Ok(integral),
    };
    let f = drawn(Integral::new(&args.formula, &args.over)?)?;
    let g = drawn(Integral::new(&args.control, &args.over)?)?.with_truth(&args.known)?;
    let rule = Rule::Independent(Generator::DEFAULT);
    rule.accepts(args.samples, f.dimensions())?;
    let points = RulePoints { rule, seed: args.seed };
    let Some(found) = control_variate(&f, &g, &points, args.samples as usize) else {
        return Err(Failure::usage("--samples: at least 100"));
    };
    let plain_error = (found.plain_variance / (args.samples as f64 * 0.9)).sqrt();
    let table = Table::new(["", "variance", "standard error"])
        .row(["plain".to_owned(), variance(found.plain_variance), format!("{plain_error:.2e}")])
        .row(["with control".to_owned(), variance(found.variance), format!("{:.2e}", found.standard_error)]);
    let mut page = report(format!("{} with the control {}", args.formula, args.control))
        .text("The control's integral is known, so only what the two differ by has to be sampled. With the correlation ρ the variance falls to 1 − ρ² of what it was.")
        .text(format!(
            "estimate {:.10} ± {:.1e}   {:.4} of the control taken away   correlation {:.5}   {:.1} times less variance",
            found.estimate,
            found.standard_error,
            found.factor,
            found.correlation,
            found.plain_variance / found.variance
        ))
        .table(table);
    if let Some(figure) = control_figure(&f, &g, &found) {
        page = page.figure(figure);
    }
    give(&page, &args.output)
}

/// Paths whose second stage is dear and matters little, is like the first, and is cheap and uncertain.
fn kinds(args: &RouletteArgs) -> Vec<(String, TwoStages)> {
    let even = TwoStages {
        direct_mean: 1.0,
        direct_variance: 1.0,
        weight_mean: 0.5,
        weight_variance: 0.05,
        amount_mean: 1.0,
        amount_variance: 1.0,
        first_cost: 1.0,
        second_cost: 1.0,
    };
    if [args.direct, args.weight, args.amount, args.cost].iter().any(Option::is_some) {
        let [direct_mean, direct_variance] = args.direct.unwrap_or([even.direct_mean, even.direct_variance]);
        let [weight_mean, weight_variance] = args.weight.unwrap_or([even.weight_mean, even.weight_variance]);
        let [amount_mean, amount_variance] = args.amount.unwrap_or([even.amount_mean, even.amount_variance]);
        let [first_cost, second_cost] = args.cost.unwrap_or([even.first_cost, even.second_cost]);
        let own = TwoStages {
            direct_mean,
            direct_variance,
            weight_mean,
            weight_variance,
            amount_mean,
            amount_variance,
            first_cost,
            second_cost,
        };
        return vec![("as given".to_owned(), own)];
    }
    let dear = TwoStages {
        direct_variance: 4.0,
        weight_mean: 0.2,
        weight_variance: 0.01,
        amount_variance: 0.01,
        second_cost: 50.0,
        ..even
    };
    let uncertain =
        TwoStages { direct_variance: 0.1, weight_mean: 1.0, amount_variance: 9.0, first_cost: 20.0, ..even };
    vec![
        ("dear and small".to_owned(), dear),
        ("like the first".to_owned(), even),
        ("cheap and uncertain".to_owned(), uncertain),
    ]
}

pub(super) fn roulette(args: &RouletteArgs) -> Result<Outcome, Failure> {
    const RATES: [f64; 9] = [0.0625, 0.125, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0];
    let kinds = kinds(args);
    let mut table = Table::new([
        "second stage",
        "rate",
        "variance",
        "measured",
        "time",
        "variance × time",
        "against once",
    ]);
    let rounds = args.rounds.clamp(16, 1 << 22);
    for (name, stages) in &kinds {
        let mut rates = RATES.to_vec();
        let best = stages.best_rate();
        if !rates.contains(&best) {
            rates.push(best);
        }
        rates.sort_by(f64::total_cmp);
        for rate in rates {
            let played = stages.play(rate, rounds, args.seed).variance().unwrap_or(f64::NAN);
            table = table.row([
                if rate == best { format!("{name}: best") } else { name.clone() },
                format!("{rate:.4}"),
                variance(stages.variance(rate)),
                variance(played),
                format!("{:.2}", stages.cost(rate)),
                format!("{:.4}", stages.work(rate)),
                format!("{:.3}", stages.work(rate) / stages.work(1.0)),
            ]);
        }
    }
    let page = report("Russian roulette and splitting")
        .text("A rate below 1 goes on by chance and counts what is found for more (roulette), a rate above 1 goes on several times (splitting); both leave the mean as it is. What counts is variance × time: half of either is worth the same.")
        .table(table)
        .figure(stages_figure(&kinds));
    give(&page, &args.output)
}

pub(super) fn width(args: &WidthArgs) -> Result<Outcome, Failure> {
    if args.from >= args.to {
        return Err(Failure::usage(format!("--from {} is not below --to {}", args.from, args.to)));
    }
    let integral = Integral::new(&args.formula, &args.over)?;
    let Some(scan) = normal_scan(&integral, args.mean, args.from, args.to, 160) else {
        let message = "width takes one dimension with finite ends and an integral that is not zero, such as --over x=0..1";
        return Err(Failure::usage(message));
    };
    let mut rows = vec![scan.best];
    for &width in &args.widths {
        rows.extend(normal_scan(&integral, args.mean, width, 2.0 * width, 2).map(|scan| scan.rows[0]));
    }
    rows.sort_by(|a, b| a.deviation.total_cmp(&b.deviation));
    let mut table = Table::new([
        "σ of the density",
        "variance",
        "relative deviation",
        "samples for 1 %",
        "worse than the best by",
    ]);
    for row in &rows {
        let is_best = row.deviation == scan.best.deviation;
        let needed = row.relative_deviation * row.relative_deviation * 1e4;
        table = table.row([
            if is_best { format!("{:.6} (best)", row.deviation) } else { format!("{}", row.deviation) },
            variance(row.variance),
            variance(row.relative_deviation),
            if needed.is_finite() { format!("{:.0}", needed.ceil()) } else { String::new() },
            format!("{:.3e} ×", row.variance / scan.best.variance),
        ]);
    }
    let at_end = scan.best.deviation <= args.from * 1.000_1 || scan.best.deviation >= args.to * 0.999_9;
    let mut page = report(format!("{} by normal densities", args.formula))
        .text("Samples of the normal density count for the integrand over the density. Too narrow is worse than too wide: a wide density wastes samples, a narrow one gives those few in the flanks weights without bound.")
        .text(format!("integral {:.12}; the best width is σ* = {:.6}", scan.integral, scan.best.deviation));
    if at_end {
        page = page.text("The best width lies at an end of the range: there may be a better one beyond.");
    }
    give(&page.table(table).figure(scan.figure), &args.output)
}

pub(super) fn strata(args: &StrataArgs) -> Result<Outcome, Failure> {
    if !(100..=1 << 18).contains(&args.repetitions) {
        return Err(Failure::usage("--repetitions: from 100 to 2^18"));
    }
    let mut page = report("One random point in each cell").text(
        "The mean over cells is as right as that of points anywhere, but what varies between cells no longer counts: only the variance within each is left. An edge leaves it in the cells that it crosses (N^−3/2); what is smooth leaves hardly any (N^−3 in one dimension).",
    );
    let mut figures = Vec::new();
    for (problem, sides) in [
        (StrataProblem::Pi, [2, 4, 8, 16, 32, 64].as_slice()),
        (StrataProblem::Cos77, [16, 32, 64, 128, 256].as_slice()),
    ] {
        let rows = measured_strata(problem, sides, args.repetitions, args.seed);
        let mut table =
            Table::new([problem.name(), "independent", "one in each, exact", "measured", "±", "errors off"]);
        for row in &rows {
            table = table.row([
                format!("{} cells", row.cells),
                format!("{:.6e}", row.independent),
                format!("{:.6e}", row.exact),
                format!("{:.4e}", row.measured),
                format!("{:.1e}", row.standard_error),
                format!("{:+.2}", row.z_score()),
            ]);
        }
        page = page.table(table);
        figures.push(strata_figure(problem, &rows));
    }
    give(&page.sheet(Sheet::new("Variance against points", 2, figures)), &args.output)
}
