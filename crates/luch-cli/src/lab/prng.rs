//! `luch lab prng`: generators put to the test.

use super::output::{give, report};
use crate::args::PrngArgs;
use crate::failure::{Failure, Outcome};
use luch_lab::figure::{Axis, Figure, Ink};
use luch_lab::generator::Generator;
use luch_lab::generator::quality::{Planes, Test, Verdict, spectral};
use luch_lab::report::{Report, Table};
use std::io::{ErrorKind, Write};
use std::time::Instant;

pub(super) fn run(args: &PrngArgs) -> Result<Outcome, Failure> {
    let generators =
        if args.generators.is_empty() { Generator::ALL.to_vec() } else { args.generators.clone() };
    if args.raw {
        let [one] = generators.as_slice() else { return Err(Failure::usage("--raw takes one generator")) };
        return raw(*one, args.seed);
    }
    let page =
        lattices(report("Generators of random numbers").table(tests(&generators, args.seed)), &generators);
    let planes = generators.iter().filter_map(|&generator| planes(generator, args.seed));
    give(&planes.fold(page, Report::figure), &args.output)
}

/// Bytes for other programs, until they have enough.
fn raw(generator: Generator, seed: u64) -> Result<Outcome, Failure> {
    let mut stream = generator.start(seed);
    let mut bytes = vec![0; 1 << 16];
    let mut out = std::io::stdout().lock();
    loop {
        stream.fill_bytes(&mut bytes);
        match out.write_all(&bytes) {
            Ok(()) => {}
            Err(error) if error.kind() == ErrorKind::BrokenPipe => return Ok(Outcome::Done),
            Err(error) => return Err(error.into()),
        }
    }
}

/// Every test: its probability, and whether that fails.
pub(super) fn tests(generators: &[Generator], seed: u64) -> Table {
    let head = ["generator", "ns"].into_iter().chain(Test::ALL.iter().map(|test| test.name()));
    let mut table = Table::new(head);
    for &generator in generators {
        let mut row = vec![generator.name().to_owned(), format!("{:.1}", nanoseconds(generator))];
        row.extend(Test::ALL.iter().map(|test| {
            let found = test.run(generator, seed);
            match found.verdict() {
                Verdict::Passes => format!("{:.2}", found.p_value),
                Verdict::Suspicious => format!("{:.0e} ?", found.p_value),
                Verdict::Fails => "FAILS".to_owned(),
            }
        }));
        table = table.row(row);
    }
    table
}

/// Time for a number.
fn nanoseconds(generator: Generator) -> f64 {
    let mut stream = generator.start(1);
    let mut numbers = vec![0; 1 << 16];
    stream.fill_native(&mut numbers);
    let start = Instant::now();
    stream.fill_native(&mut numbers);
    start.elapsed().as_nanos() as f64 / numbers.len() as f64
}

/// The spectral test of those that are congruences.
fn lattices(page: Report, generators: &[Generator]) -> Report {
    let mut table =
        Table::new(["generator", "ν2", "ν3", "ν4", "ν5", "ν6", "ν7", "ν8", "planes in 3 dimensions"]);
    for generator in generators {
        let Some(lcg) = generator.lcg() else { continue };
        let mut row = vec![generator.name().to_owned()];
        row.extend(spectral(&lcg, 8).iter().map(|found| format!("{:.1}", found.nu())));
        row.push(Planes::of(&lcg, 3).map_or(String::new(), |planes| planes.count.to_string()));
        table = table.row(row);
    }
    if table.rows.is_empty() {
        return page;
    }
    page.text("Spectral test: 1/ν is the distance of the planes that hold all points.").table(table)
}

/// Triples seen along the planes they lie on, where these can be told apart.
pub(super) fn planes(generator: Generator, seed: u64) -> Option<Figure> {
    let planes = Planes::of(&generator.lcg()?, 3).filter(|planes| planes.count <= 200)?;
    let mut stream = generator.start(seed);
    // Across the planes, and square to that and the line of sight.
    let [n, v] = [&planes.normal, &planes.view].map(|vector| [vector[0], vector[1], vector[2]]);
    let side = [v[1] * n[2] - v[2] * n[1], v[2] * n[0] - v[0] * n[2], v[0] * n[1] - v[1] * n[0]];
    let along = |axis: [f64; 3], point: [f64; 3]| (0..3).map(|k| axis[k] * (point[k] - 0.5)).sum::<f64>();
    let points = (0..3000)
        .map(|_| std::array::from_fn(|_| stream.unit_f64()))
        .map(|point: [f64; 3]| [along(side, point), along(n, point)])
        .collect();
    let title = format!("Triples of {}, seen along their {} planes", generator.name(), planes.count);
    let figure = Figure::new(title).with_x(Axis::linear("along the planes")).with_y(Axis::linear("across"));
    Some(figure.squared().points("", Ink::of(0), points, 1.5))
}
