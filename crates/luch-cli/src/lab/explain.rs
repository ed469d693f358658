//! `luch lab explain`: why a pixel is as it is.

use super::output::{check, give, report};
use crate::args::ExplainArgs;
use crate::failure::{Failure, Outcome};
use crate::recipe::Recipe;
use crate::terminal::complain;
use luch::render::{FollowedPath, PathEnd, PathTracer, PathVertex, Stop, View, World};
use luch::scene::{Integrator, Scene};
use luch_lab::explain::{
    Explanation, Part, Technique, depth_figure, explain, light_name, material_name, object_name,
    running_figure,
};
use luch_lab::report::{Report, Table};

pub(super) fn run(args: &ExplainArgs) -> Result<Outcome, Failure> {
    check(&args.output)?;
    let loaded = args.parameters.load(&args.file, &luch::formats::Files::disk())?;
    if !args.output.json {
        loaded.notes.iter().for_each(|note| complain(&format!("note: {note}")));
    }
    let mut scene = loaded.scene;
    let mut recipe = Recipe::of_scene(&scene.settings, &loaded.wishes.tone);
    recipe.change(&args.picture)?;
    let camera = recipe.apply(&mut scene)?;
    let tracer = match scene.settings.integrator {
        Integrator::Path { max_depth } => PathTracer { max_depth, reuse: true },
        Integrator::Direct => PathTracer { max_depth: 1, reuse: false },
        _ => {
            return Err(Failure::usage(
                "paths are explained of the integrators `path` and `direct`; choose one by --integrator",
            ));
        }
    };
    let view = View::new(&camera, &scene.settings);
    let world = World::build(scene)?;
    let (pixel, stop) = (args.pixel.0, Stop::new());
    let explanation = explain(&world, &view, tracer, pixel, 0..args.spp, &stop)?;
    let mut page = report(format!("Pixel {},{} of {}", pixel[0], pixel[1], args.file.display()))
        .text(summary(&explanation))
        .heading("Paths")
        .preformatted(explanation.tree.to_text(&world.scene, args.depth.into(), args.least / 100.0))
        .text(ends(&explanation))
        .heading("By scatterings and technique")
        .table(parts("scatterings", &explanation.by_technique, |&(depth, technique)| {
            format!("{depth} {}", technique.name())
        }))
        .text(techniques(&explanation))
        .heading("By lamp")
        .table(parts("lamp", &explanation.by_source, |source| light_name(&world.scene, *source)))
        .heading("Brightest samples")
        .table(brightest(&explanation, &world.scene));
    if args.sample.is_empty() {
        page = page.figure(running_figure(&explanation)).figure(depth_figure(&explanation));
    }
    for &index in &args.sample {
        let path = tracer.follow(&world, &view.start(pixel, index), &stop)?;
        page = told(page, &world.scene, index, &path);
    }
    give(&page, &args.output)
}

fn summary(explanation: &Explanation) -> String {
    let color = |light: [f64; 3]| light.map(|v| format!("{v:.5}")).join(" ");
    let picture_error = explanation
        .picture_error
        .map_or(String::new(), |error| format!(" (± {error:.5} by its twin streams)"));
    format!(
        "{} samples. Own paths: {} (luminance ± {:.5}). In the picture, neighbours helping: {}{picture_error}.",
        explanation.samples.end - explanation.samples.start,
        color(explanation.own_mean),
        explanation.own_error,
        color(explanation.picture_mean),
    )
}

fn ends(explanation: &Explanation) -> String {
    let told = explanation.ends.iter().map(|(end, count)| format!("{count} {}", end_name(*end)));
    format!("Paths: {}.", told.collect::<Vec<_>>().join(", "))
}

fn end_name(end: PathEnd) -> &'static str {
    match end {
        PathEnd::Escaped => "left the scene",
        PathEnd::Depth => "had scattered as often as they may",
        PathEnd::Absorbed => "were swallowed",
        PathEnd::Roulette => "ended by roulette",
    }
}

fn techniques(explanation: &Explanation) -> String {
    let sum = |technique: Technique| -> f64 {
        let own = explanation.by_technique.iter().filter(|part| part.kind.1 == technique);
        own.fold(0.0, |sum, part| sum + part.share)
    };
    let told =
        Technique::ALL.map(|technique| format!("{} {:.1} %", technique.name(), 100.0 * sum(technique)));
    format!("Together: {}.", told.join(", "))
}

fn parts<K>(head: &str, parts: &[Part<K>], name: impl Fn(&K) -> String) -> Table {
    let head = [head, "light (R G B)", "part", "samples", "deviation of one sample"];
    parts.iter().fold(Table::new(head), |table, part| {
        table.row([
            name(&part.kind),
            part.light.map(|v| format!("{v:.5}")).join(" "),
            format!("{:.2} %", 100.0 * part.share),
            part.samples.to_string(),
            format!("{:.4}", part.variance.sqrt()),
        ])
    })
}

fn brightest(explanation: &Explanation, scene: &Scene) -> Table {
    explanation.brightest.iter().fold(Table::new(["sample", "part of the pixel", "path"]), |table, bright| {
        table.row([
            bright.index.to_string(),
            format!("{:.2} %", 100.0 * bright.share),
            route(&bright.path, scene),
        ])
    })
}

/// Objects of a path, the first few by name.
fn route(path: &FollowedPath, scene: &Scene) -> String {
    const NAMED: usize = 5;
    let name = |vertex: &PathVertex| match vertex.surface {
        Some(surface) => object_name(scene, surface.instance),
        None => "beyond".into(),
    };
    let mut names: Vec<String> = path.vertices.iter().take(NAMED).map(name).collect();
    if path.vertices.len() > NAMED {
        names.push(format!("{} more", path.vertices.len() - NAMED));
    }
    names.join(" → ")
}

/// The steps of one path.
fn told(page: Report, scene: &Scene, index: u64, path: &FollowedPath) -> Report {
    let mut table =
        Table::new(["step", "event", "where", "p by BSDF", "p by lamps", "weight", "light (R G B)"]);
    let color = |light: luch::image::Rgb| light.to_array().map(|v| format!("{v:.5}")).join(" ");
    let density = |pdf: f32| format!("{pdf:.4}");
    for (step, vertex) in path.vertices.iter().enumerate() {
        let (what, place) = match vertex.surface {
            Some(surface) => {
                let side = if surface.is_front { "" } else { ", from behind" };
                (
                    format!(
                        "meets {} ({}{side})",
                        object_name(scene, surface.instance),
                        material_name(scene, surface.material)
                    ),
                    surface.position.to_array().map(|v| format!("{v:.4}")).join(" "),
                )
            }
            None => ("leaves the scene".into(), String::new()),
        };
        table = table.row([
            step.to_string(),
            what,
            place,
            String::new(),
            String::new(),
            String::new(),
            format!("× {}", color(vertex.throughput)),
        ]);
        if let Some(found) = vertex.found {
            table = table.row([
                String::new(),
                format!("comes upon {}", light_name(scene, found.source)),
                String::new(),
                found.pdf_bsdf.map_or_else(|| "–".into(), density),
                density(found.pdf_light),
                format!("{:.4}", found.weight),
                format!("+ {}", color(found.contribution)),
            ]);
        }
        if let Some(asked) = vertex.asked {
            let is_blocked = asked.contribution.is_black() && !asked.unblocked.is_black();
            table = table.row([
                String::new(),
                format!(
                    "asks {}{}",
                    light_name(scene, Some(asked.source)),
                    if is_blocked { ": something stands in the way" } else { "" }
                ),
                asked
                    .target
                    .map_or_else(String::new, |to| to.to_array().map(|v| format!("{v:.4}")).join(" ")),
                density(asked.pdf_bsdf),
                density(asked.pdf_light),
                format!("{:.4}", asked.weight),
                if is_blocked {
                    format!("({})", color(asked.unblocked))
                } else {
                    format!("+ {}", color(asked.contribution))
                },
            ]);
        }
        if let Some(departure) = vertex.departure {
            table = table.row([
                String::new(),
                if departure.is_specular { "goes on as by a mirror".into() } else { "goes on".to_owned() },
                format!("toward {}", departure.direction.to_array().map(|v| format!("{v:.4}")).join(" ")),
                density(departure.pdf),
                String::new(),
                String::new(),
                String::new(),
            ]);
        }
    }
    let end = match path.end {
        PathEnd::Escaped => "It left the scene",
        PathEnd::Depth => "It had scattered as often as it may",
        PathEnd::Absorbed => "It was swallowed",
        PathEnd::Roulette => "Roulette ended it",
    };
    page.heading(format!("Sample {index}"))
        .table(table)
        .text(format!("{end}. It carries {} home.", color(path.radiance)))
}
