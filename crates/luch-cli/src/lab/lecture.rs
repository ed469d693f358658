//! `luch lab lecture`: the figures of the lecture's first half.

use super::output::report;
use super::points::square;
use super::prng::{planes, tests};
use crate::args::LectureArgs;
use crate::failure::{Failure, Outcome};
use crate::terminal::say;
use luch::formats::write_atomically;
use luch_lab::density::{CENTERED, dimensions, dimensions_figure, normal_scan, square_sheet};
use luch_lab::figure::{Figure, PngOptions, Sheet};
use luch_lab::generator::Generator;
use luch_lab::integral::{HashedPoints, Integral, RulePoints, convergence, convergence_figure};
use luch_lab::points::Rule;
use luch_lab::problem::Problem;
use luch_lab::report::{Report, Section};

/// Sizes of tables and curves.
fn sizes(first: u32, last: u32) -> Vec<u64> {
    (first..=last).map(|exponent| 1 << exponent).collect()
}

fn source(rule: Rule) -> RulePoints {
    RulePoints { rule, seed: 1 }
}

pub(super) fn run(args: &LectureArgs) -> Result<Outcome, Failure> {
    std::fs::create_dir_all(&args.output)
        .map_err(|error| Failure::new(format!("{}: {error}", args.output.display())))?;
    let mut page = report("Monte Carlo: the figures of the lecture");
    for (name, make) in CHAPTERS {
        let chapter = make()?;
        let mut number = 0;
        for section in &chapter.sections {
            let (svg, png) = match section {
                Section::Figure(figure) => (figure.to_svg(), figure.to_png(PngOptions::default())),
                Section::Sheet(sheet) => (sheet.to_svg(), sheet.to_png(PngOptions::default())),
                _ => continue,
            };
            number += 1;
            let stem = if number == 1 { (*name).to_owned() } else { format!("{name}-{number}") };
            write_atomically(&args.output.join(format!("{stem}.svg")), svg.as_bytes())?;
            write_atomically(&args.output.join(format!("{stem}.png")), &png)?;
        }
        say(&format!("{name}: {}", chapter.title));
        page = page.heading(chapter.title);
        page.sections.extend(chapter.sections);
    }
    let index = args.output.join("index.html");
    write_atomically(&index, page.to_html().as_bytes())?;
    say(&format!("wrote {}", index.display()));
    Ok(Outcome::Done)
}

type Chapter = fn() -> Result<Report, Failure>;

/// File names and what makes them.
const CHAPTERS: &[(&str, Chapter)] = &[
    ("06-pi", pi),
    ("13-density", centered),
    ("14-cos77", cos77),
    ("16-generators", generators),
    ("18-dimensions", many_dimensions),
    ("19-strata", strata),
    ("22-sequence", sequence),
    ("23-beside-random", beside_random),
];

fn named(name: &str, samples: u64) -> Result<Report, Failure> {
    let problem = Problem::named(name).ok_or_else(|| Failure::new(format!("no problem {name}")))?;
    let found = problem.run(samples, &HashedPoints { seed: 1 });
    let text = format!(
        "{:.6} ± {:.1e} after {} samples; the truth is {:.6}.",
        found.estimate, found.standard_error, found.samples, found.truth
    );
    let page = Report::new(problem.description.clone()).text(text).text(found.explanation);
    Ok(page.figure(found.figure).figure(found.progress))
}

fn pi() -> Result<Report, Failure> {
    named("pi", 1 << 18)
}

fn centered() -> Result<Report, Failure> {
    let sheet = square_sheet(CENTERED, &HashedPoints { seed: 1 }, 400)?;
    Ok(Report::new("Importance sampling: denser in the middle; what falls in a sparse place weighs more")
        .sheet(sheet))
}

fn cos77() -> Result<Report, Failure> {
    let mut measured = Vec::new();
    for density in ["uniform", "normal(0, 0.15)", "normal(0, 0.1132)", "normal(0, 0.08)"] {
        let integral = Integral::new("cos(x)^77", "x=-pi/2..pi/2")?
            .with_density(density)?
            .with_truth("sqrt(pi)*gamma(39)/gamma(39.5)")?;
        measured.push(convergence(density, &integral, &HashedPoints { seed: 1 }, &sizes(6, 16), 48));
    }
    let title = "The integral of cos⁷⁷ by four densities";
    let integral = Integral::new("cos(x)^77", "x=-pi/2..pi/2")?;
    let page = Report::new(title).figure(convergence_figure(title, &measured));
    Ok(match normal_scan(&integral, 0.0, 0.05, 0.6, 120) {
        Some(scan) => page
            .text(format!(
                "The best normal density has σ = {:.4}; too narrow is far worse than too wide.",
                scan.best.deviation
            ))
            .figure(scan.figure),
        None => page,
    })
}

fn generators() -> Result<Report, Failure> {
    let some = [Generator::Randu, Generator::Minstd16807, Generator::Mt19937, Generator::DEFAULT];
    let page = Report::new("A poor generator: RANDU's triples lie on fifteen planes").table(tests(&some, 1));
    Ok(planes(Generator::Randu, 1).into_iter().fold(page, Report::figure))
}

fn many_dimensions() -> Result<Report, Failure> {
    let study = dimensions(
        &[1, 2, 5, 10, 20],
        &sizes(6, 14),
        32,
        &HashedPoints { seed: 1 },
        &source(Rule::SobolHashed),
    )?;
    Ok(Report::new("The error depends on N, not on the dimension; a grid's does")
        .sheet(dimensions_figure(&study)))
}

fn errors(title: &str, rules: &[Rule], formula: &str, truth: &str) -> Result<Figure, Failure> {
    let integral = Integral::new(formula, "x=0..1, y=0..1")?.with_truth(truth)?;
    let found: Vec<_> = rules
        .iter()
        .map(|&rule| {
            let sizes: Vec<u64> = sizes(4, 14).iter().map(|&size| rule.nearest_count(size, 2)).collect();
            convergence(rule.name(), &integral, &source(rule), &sizes, 48)
        })
        .collect();
    Ok(convergence_figure(title, &found))
}

fn strata() -> Result<Report, Failure> {
    let rules = [Rule::Independent(Generator::DEFAULT), Rule::Jittered, Rule::LatinHypercube];
    let disc = errors("A disc: an edge", &rules, "if((x-0.5)^2+(y-0.5)^2 <= 0.25, 1, 0)", "pi/4")?;
    let smooth = errors("Something smooth", &rules, "exp(x+y)/(exp(1)-1)^2", "1")?;
    let sheet = Sheet::new("Strata against independent points", 2, vec![disc, smooth]);
    Ok(Report::new("Stratified sampling: less error for as many samples").sheet(sheet))
}

fn square_of(rule: Rule, count: u64) -> Result<Figure, Failure> {
    let points = rule.points(count as usize, 2, 1, 0)?;
    Ok(square(format!("{}, {count} points", rule.name()), points.pair(0, 1).unwrap_or_default()))
}

fn sequence() -> Result<Report, Failure> {
    let figures = vec![square_of(Rule::Sobol, 1000)?, square_of(Rule::Sobol, 10_000)?];
    let sheet = Sheet::new("A low-discrepancy sequence: 1000 and 10000 points", 2, figures);
    Ok(Report::new("A low-discrepancy sequence").sheet(sheet))
}

fn beside_random() -> Result<Report, Failure> {
    let random = Rule::Independent(Generator::DEFAULT);
    let figures = vec![square_of(Rule::SobolOwen, 1000)?, square_of(random, 1000)?];
    let rules = [random, Rule::HaltonShifted, Rule::SobolShifted, Rule::SobolOwen];
    let slopes = errors("Quasi-Monte Carlo on something smooth", &rules, "exp(x+y)/(exp(1)-1)^2", "1")?;
    let sheet = Sheet::new("A low-discrepancy sequence beside random points", 2, figures)
        .with_caption("Random points clump and leave holes.");
    Ok(Report::new("A low-discrepancy sequence beside random points").sheet(sheet).figure(slopes))
}
