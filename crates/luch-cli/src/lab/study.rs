//! `luch lab slopes`, `density`, `dimensions`.

use super::live::Live;
use super::output::{give, report};
use crate::args::{DensityArgs, DimensionsArgs, SlopesArgs};
use crate::failure::{Failure, Outcome};
use luch::sampling::check::FitSettings;
use luch_lab::density;
use luch_lab::figure::{Axis, Figure, Ink, Marker, Sheet};
use luch_lab::integral::RulePoints;
use luch_lab::points::Rule;
use luch_lab::report::Table;
use luch_lab::slopes::{Integrand, SlopeRow, SlopeSettings, measure};

pub(super) fn slopes(args: &SlopesArgs) -> Result<Outcome, Failure> {
    let dimensions = args.dimensions as usize;
    let rules: Vec<Rule> = args.rules.iter().flat_map(|rules| rules.0.iter().copied()).collect();
    let is_all = rules.len() >= Rule::ALL.len();
    let settings = SlopeSettings { replicates: args.replicates, ..SlopeSettings::default() };
    let mut rows: Vec<Vec<SlopeRow>> = Vec::new();
    let mut live = Live::new(args.output.json);
    for rule in rules {
        match measure(rule, dimensions, &settings) {
            Ok(found) => rows.push(found),
            // Of all samplers those that have such points.
            Err(_) if is_all => {}
            Err(error) => return Err(error.into()),
        }
        live.show(|| figure(Integrand::ALL[0], &rows));
    }
    live.end();
    let mut table = Table::new(std::iter::once("sampler").chain(Integrand::ALL.iter().map(|one| one.name())));
    for found in &rows {
        let Some(first) = found.first() else { continue };
        let slope = |integrand: &Integrand| match found.iter().find(|row| row.integrand == *integrand) {
            Some(row) if row.is_exact() => "exact".to_owned(),
            Some(row) => row.fit.map_or(String::new(), |fit| format!("{:.2}", fit.slope)),
            None => String::new(),
        };
        table =
            table.row(std::iter::once(first.rule.name().to_owned()).chain(Integrand::ALL.iter().map(slope)));
    }
    let figures: Vec<Figure> = Integrand::ALL.iter().map(|&integrand| figure(integrand, &rows)).collect();
    let title = format!("Slopes of the error in {dimensions} dimensions");
    let page = report(title.clone())
        .text("The exponent of the number of points in the root mean square error; −0.5 is that of independent points.")
        .table(table)
        .sheet(Sheet::new(title, 2, figures));
    give(&page, &args.output)
}

fn figure(integrand: Integrand, rows: &[Vec<SlopeRow>]) -> Figure {
    let start = Figure::new(integrand.name()).with_x(Axis::log2("points N")).with_y(Axis::log10("error"));
    let found = rows.iter().flatten().filter(|row| row.integrand == integrand && !row.is_exact());
    found.enumerate().fold(start, |figure, (place, row)| {
        let points = row.errors.iter().map(|error| [error.count as f64, error.rmse]).collect();
        figure.marked(row.rule.name(), Ink::of(place), Marker::of(place), points)
    })
}

pub(super) fn density(args: &DensityArgs) -> Result<Outcome, Failure> {
    let count = args.sampler.nearest_count(args.samples, 2);
    args.sampler.accepts(count, 2)?;
    let points = RulePoints { rule: args.sampler, seed: args.seed };
    let sheet = density::square_sheet(&args.density, &points, count as usize)?;
    let settings = FitSettings { samples: 1 << 18, seed: args.seed, ..FitSettings::default() };
    let fit = density::square_fit(&args.density, settings)?;
    let page = report(format!("The density {}", args.density))
        .text(format!("Samples against the density, χ²: p = {:.3}", fit.chi_square.p_value))
        .text(sheet.caption.clone())
        .sheet(sheet);
    give(&page, &args.output)
}

pub(super) fn dimensions(args: &DimensionsArgs) -> Result<Outcome, Failure> {
    let independent =
        RulePoints { rule: Rule::from_name("independent").unwrap_or(Rule::SobolHashed), seed: 1 };
    let study = density::dimensions(
        &[1, 2, 5, 10, 20],
        &args.n.0,
        32,
        &independent,
        &RulePoints { rule: Rule::SobolHashed, seed: 1 },
    )?;
    let mut table = Table::new(["dimensions", "rule", "slope"]);
    for row in &study.rows {
        let slope = row.slope.map_or(String::new(), |slope| format!("{slope:.2}"));
        table = table.row([row.dimensions.to_string(), row.rule.name().to_owned(), slope]);
    }
    let page = report("Error and dimension").table(table).sheet(density::dimensions_figure(&study));
    give(&page, &args.output)
}
