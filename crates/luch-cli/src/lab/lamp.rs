//! `luch lab lamp --scene`: which lamps a point of a scene sees.

use super::output::{check, give, report};
use super::ticker::Ticker;
use crate::args::LampArgs;
use crate::failure::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::parse::unknown;
use crate::terminal::{complain, short};
use clap::Parser;
use luch::formats::Files;
use luch::render::World;
use luch_lab::direct_light::{DIMENSIONS, DirectLight, LampSeen, Measured, Query, direct_light, names};
use luch_lab::figure::{Axis, Figure, Ink};
use luch_lab::integral::RulePoints;
use luch_lab::report::Table;
use std::ffi::OsString;

/// Rows of the table; the rest is summed up.
const MOST_ROWS: usize = 40;

/// Whether `luch lab lamp …` is about a scene and not about the problem of that name.
pub(super) fn is_meant(words: &[OsString]) -> bool {
    let begins = |word: &OsString, with: &str| word.to_str().is_some_and(|word| word.starts_with(with));
    words.first().is_some_and(|word| word == "lamp")
        && words.iter().any(|word| begins(word, "--scene") || begins(word, "--at"))
}

pub(super) fn run(words: &[OsString]) -> Result<Outcome, Failure> {
    let args = match LampArgs::try_parse_from(words.iter().skip(1)) {
        Ok(args) => args,
        Err(error) => error.exit(),
    };
    args.sampler.accepts(args.sampler.nearest_count(args.samples, DIMENSIONS), DIMENSIONS)?;
    if !(args.sampler.is_sequence() || args.sampler.is_streamed()) && args.sampler.name() != "independent" {
        let message = format!("--sampler: `{}` makes sets of one size only", args.sampler.name());
        return Err(Failure::usage(message));
    }
    check(&args.output)?;
    let _interrupt = Interrupt::install()?;
    let loaded = args.parameters.load(&args.scene, &Files::disk())?;
    for warning in &loaded.warnings {
        complain(&format!("warning: {warning}"));
    }
    let known = names(&loaded.scene);
    if known.is_empty() {
        return Err(Failure::new(format!("{}: there is no lamp in the scene", args.scene.display())));
    }
    for name in &args.light {
        if !known.contains(name) {
            return Err(Failure::usage(unknown("lamp", name, known.iter().map(String::as_str))));
        }
    }
    let world = World::build(loaded.scene)?;
    let points = RulePoints { rule: args.sampler, seed: args.seed };
    let query = Query { at: args.at, normal: args.normal, samples: args.samples, points: &points };
    let wanted = |name: &str| args.light.is_empty() || args.light.iter().any(|light| light == name);
    let ticker = Ticker::new("lamps", args.output.json);
    let found = direct_light(&world, &query, &wanted, &|done, all| ticker.tell(done, all));
    drop(ticker);

    let mut page = report(format!("Lamps of {} from {}", args.scene.display(), args.at))
        .text("Visible is the share of a lamp's area with a free line to the point (of a sun that of its disc, of the sky that of the hemisphere by the cosine); a closed lamp hides its own far side. E is the irradiance of direct light on a surface there, W/m². The share of the light is not the share of the area: parts of a lamp count by cosines and distance.")
        .table(table(&found))
        .text(format!("total irradiance {}", with_error(&found.total)));
    if found.lamps.len() > 1 {
        page = page.figure(figure(&found));
    }
    give(&page, &args.output)
}

fn with_error(measured: &Measured) -> String {
    format!("{:.6e} ± {:.1e}", measured.mean, measured.standard_error)
}

/// Lamps by how much light they send, the strongest first.
fn strongest(found: &DirectLight) -> Vec<&LampSeen> {
    let mut lamps: Vec<&LampSeen> = found.lamps.iter().collect();
    lamps.sort_by(|a, b| b.irradiance.mean.total_cmp(&a.irradiance.mean));
    lamps
}

fn table(found: &DirectLight) -> Table {
    let head = ["lamp", "kind", "area m²", "visible", "±", "E", "±", "red, green, blue", "of total"];
    let mut table = Table::new(head);
    let lamps = strongest(found);
    let share = |part: f64| match found.total.mean > 0.0 {
        true => format!("{:.1} %", 100.0 * part / found.total.mean),
        false => String::new(),
    };
    for lamp in lamps.iter().take(MOST_ROWS) {
        table = table.row([
            lamp.name.clone(),
            lamp.kind.name().to_owned(),
            lamp.area.map_or(String::new(), short),
            lamp.visible.map_or(String::new(), |visible| format!("{:.6}", visible.mean)),
            lamp.visible.map_or(String::new(), |visible| format!("{:.1e}", visible.standard_error)),
            format!("{:.6e}", lamp.irradiance.mean),
            format!("{:.1e}", lamp.irradiance.standard_error),
            lamp.color.map(short).join(", "),
            share(lamp.irradiance.mean),
        ]);
    }
    if lamps.len() > MOST_ROWS {
        let rest = &lamps[MOST_ROWS..];
        let sum: f64 = rest.iter().map(|lamp| lamp.irradiance.mean).sum();
        let mut row = vec![String::new(); 9];
        row[0] = format!("{} more", rest.len());
        row[5] = format!("{sum:.6e}");
        row[8] = share(sum);
        table = table.row(row);
    }
    table
}

fn figure(found: &DirectLight) -> Figure {
    let lamps = strongest(found);
    let lamps = &lamps[..lamps.len().min(MOST_ROWS)];
    let edges = (0..=lamps.len()).map(|at| at as f64).collect();
    let heights = lamps.iter().map(|lamp| lamp.irradiance.mean).collect();
    let names: Vec<&str> = lamps.iter().take(8).map(|lamp| lamp.name.as_str()).collect();
    Figure::new("Irradiance by lamp")
        .with_caption(format!("From left to right: {}.", names.join(", ")))
        .with_x(Axis::linear("lamp"))
        .with_y(Axis::linear("irradiance, W/m²"))
        .bars("", Ink::Orange, edges, heights)
}
