//! `luch lab points` and `measure`: where points lie, and how evenly.

use super::output::{give, report};
use crate::args::{MeasureArgs, PointsArgs, Rules};
use crate::failure::{Failure, Outcome};
use luch_lab::figure::{Axis, Figure, Ink, Raster, Sheet};
use luch_lab::measure;
use luch_lab::points::{PointSet, Rule};
use luch_lab::report::Table;

/// Most points of which everything is measured: the work grows with the square.
const MOST_MEASURED: u64 = 1 << 14;

/// The rules that were named; of `all` those that have points in so many dimensions.
fn named(rules: &[Rules], dimensions: usize) -> Vec<Rule> {
    let all: Vec<Rule> = rules.iter().flat_map(|rules| rules.0.iter().copied()).collect();
    let fits = |rule: &Rule| all.len() < Rule::ALL.len() || rule.dimensions().contains(&dimensions);
    all.iter().copied().filter(fits).collect()
}

fn made(rule: Rule, count: u64, dimensions: usize, seed: u64) -> Result<PointSet, Failure> {
    rule.accepts(rule.nearest_count(count, dimensions), dimensions)?;
    Ok(rule.points(rule.nearest_count(count, dimensions) as usize, dimensions, seed, 0)?)
}

/// A square of points.
pub(super) fn square(title: String, pairs: Vec<[f64; 2]>) -> Figure {
    let size = (120.0 / (pairs.len().max(1) as f64).sqrt()).clamp(0.7, 4.0);
    Figure::unit_square(title).points("", Ink::of(0), pairs, size)
}

pub(super) fn show(args: &PointsArgs) -> Result<Outcome, Failure> {
    let &[a, b] = args.axes.as_slice() else {
        return Err(Failure::usage("--axes takes two numbers, such as 1,2"));
    };
    let dimensions = a.max(b) as usize;
    let mut figures = Vec::new();
    for rule in named(&args.rules, dimensions) {
        let set = made(rule, args.count, dimensions, args.seed)?;
        let pairs = set.pair(a as usize - 1, b as usize - 1).unwrap_or_default();
        figures.push(square(format!("{}, {} points", rule.name(), pairs.len()), pairs));
    }
    let columns = figures.len().clamp(1, 4);
    let caption =
        if dimensions > 2 { format!("Dimensions {a} and {b} of {dimensions}.") } else { String::new() };
    let sheet = Sheet::new("Points of the unit square", columns, figures).with_caption(caption);
    give(&report("Points of the unit square").sheet(sheet), &args.output)
}

pub(super) fn measure(args: &MeasureArgs) -> Result<Outcome, Failure> {
    if args.count > MOST_MEASURED {
        return Err(Failure::usage(format!("--count: at most {MOST_MEASURED} points are measured")));
    }
    let head =
        ["sampler", "N", "L2*", "star", "centred²", "wrap-around²", "empty disc", "empty box", "net t"];
    let mut table = Table::new(head);
    let mut rings =
        Figure::new("Power by frequency").with_x(Axis::linear("frequency")).with_y(Axis::log10("power"));
    let mut spectra = Vec::new();
    for (place, rule) in named(&args.rules, 2).into_iter().enumerate() {
        let set = made(rule, args.count, 2, args.seed)?;
        let pairs = set.pair(0, 1).unwrap_or_default();
        let disc = measure::largest_empty_ball(&set, 1e-4).map_or(f64::NAN, |ball| ball.radius);
        let net = measure::quality(&set).map_or("–".to_owned(), |t| t.to_string());
        table = table.row([
            rule.name().to_owned(),
            set.len().to_string(),
            format!("{:.3e}", measure::l2_star(&set)),
            format!("{:.3e}", measure::star_discrepancy_2d(&pairs)),
            format!("{:.3e}", measure::centred_squared(&set)),
            format!("{:.3e}", measure::wrap_around_squared(&set)),
            format!("{disc:.4}"),
            format!("{:.5}", measure::largest_empty_box_2d(&pairs).area()),
            net,
        ]);
        let highest = (2.0 * (pairs.len() as f64).sqrt()).clamp(8.0, 96.0) as u32;
        let spectrum = measure::spectrum(&pairs, highest);
        let curve = spectrum.rings.iter().filter(|ring| ring.radius > 0.0 && ring.mean > 0.0);
        rings = rings.line(rule.name(), Ink::of(place), curve.map(|ring| [ring.radius, ring.mean]).collect());
        spectra.push(spectrum_figure(rule, &spectrum));
    }
    let columns = spectra.len().clamp(1, 4);
    let page = report("How evenly points lie")
        .text("Discrepancies and empty room: the smaller, the more even; net t: the smaller the better, – is none. Independent points have a power of 1 at every frequency.")
        .table(table)
        .figure(rings)
        .sheet(Sheet::new("Power spectra", columns, spectra));
    give(&page, &args.output)
}

fn spectrum_figure(rule: Rule, spectrum: &measure::Spectrum) -> Figure {
    let highest = spectrum.highest as i32;
    let width = (2 * highest + 1) as usize;
    let values = (0..width * width)
        .map(|place| {
            let frequency = [(place % width) as i32 - highest, (place / width) as i32 - highest];
            spectrum.at(frequency).unwrap_or(0.0).min(3.0)
        })
        .collect();
    let end = f64::from(highest) + 0.5;
    let raster = Raster { low: [-end; 2], high: [end; 2], ..Raster::unit_square(width, values) };
    let axis = || Axis::linear("waves").with_range(-end, end);
    Figure::new(rule.name()).with_x(axis()).with_y(axis()).squared().heat("", raster)
}
