//! What each problem looks like.

use super::{Kind, Problem, TriangleDomain, covered, glossy_place, glossy_radius, triangle};
use crate::figure::{Axis, Dash, Figure, Ink, Mark};
use crate::integral::{Integral, Points};
use std::f64::consts::TAU;

/// Points that are shown.
const SHOWN: usize = 1000;

/// Triangles of one kind that are shown.
const TRIANGLES: usize = 12;

/// The problem with its first points.
pub(super) fn of(problem: &Problem, points: &dyn Points) -> Figure {
    let dimensions = problem.dimensions();
    let mut numbers = vec![0.0; SHOWN * dimensions];
    points.fill(0, 0, dimensions, &mut numbers);
    let samples: Vec<&[f64]> = numbers.chunks(dimensions).collect();
    let figure = match &problem.kind {
        Kind::Pi => pi(problem, &samples),
        Kind::Triangle { domain, .. } => triangles(problem, *domain, &samples),
        Kind::Cos77(integral) => bell(integral, &samples),
        Kind::Lamp { lamp, .. } => {
            let places = samples.iter().map(|u| lamp.place([u[0], u[1]]));
            let (seen, hidden): (Vec<_>, Vec<_>) = places.partition(|&place| lamp.is_seen(place));
            let mut figure = plane("The lamp as the point sees it").with(
                "lamp",
                Ink::Yellow,
                Mark::Polygon { points: lamp.outline(), opacity: 0.25 },
            );
            for part in lamp.hidden() {
                figure = figure.with("shadow", Ink::Text, Mark::Polygon { points: part, opacity: 0.25 });
            }
            figure.points("seen", Ink::Orange, seen, 3.0).points("hidden", Ink::Muted, hidden, 3.0)
        }
        Kind::Edge { angle, offset } => {
            let (inside, outside) = split(problem, &samples);
            Figure::unit_square("A pixel and an edge")
                .with("covered", Ink::Sky, Mark::Polygon { points: covered(*angle, *offset), opacity: 0.25 })
                .points("inside", Ink::Blue, inside, 3.0)
                .points("outside", Ink::Muted, outside, 3.0)
        }
        Kind::Furnace { albedo } => furnace(problem, *albedo, &samples),
        Kind::Glossy { glossiness } => {
            let radius = glossy_radius(*glossiness);
            let places = samples.iter().map(|u| glossy_place(*glossiness, [u[0], u[1]])).collect();
            plane("Perturbations of a glossy reflection")
                .line("dx² + dy² = tan²((1−g)π/2)", Ink::Vermilion, circle([0.0; 2], radius))
                .points("perturbations", Ink::Blue, places, 3.0)
        }
    };
    let shown = match &problem.kind {
        Kind::Triangle { .. } => format!("Up to {TRIANGLES} of either kind, of the first randomisation."),
        _ => format!("The first {SHOWN} points of the first randomisation."),
    };
    figure.with_caption(shown)
}

fn plane(title: &str) -> Figure {
    Figure::new(title).with_x(Axis::linear("")).with_y(Axis::linear("")).squared()
}

fn circle(middle: [f64; 2], radius: f64) -> Vec<[f64; 2]> {
    (0..=180)
        .map(|i| TAU * f64::from(i) / 180.0)
        .map(|angle| [middle[0] + radius * libm::cos(angle), middle[1] + radius * libm::sin(angle)])
        .collect()
}

/// Points of the unit square whose sample is not zero, and the others.
fn split(problem: &Problem, samples: &[&[f64]]) -> (Vec<[f64; 2]>, Vec<[f64; 2]>) {
    samples.iter().map(|u| [u[0], u[1]]).partition(|u| problem.sample(u) > 0.0)
}

fn pi(problem: &Problem, samples: &[&[f64]]) -> Figure {
    let (inside, outside) = split(problem, samples);
    let share = inside.len() as f64 / samples.len() as f64;
    Figure::unit_square(format!("4 × {share:.3} = {:.3}", 4.0 * share))
        .points("inside the disc", Ink::Blue, inside, 3.2)
        .points("outside", Ink::Orange, outside, 3.2)
        .line("", Ink::Text, circle([0.5; 2], 0.5))
}

fn triangles(problem: &Problem, domain: TriangleDomain, samples: &[&[f64]]) -> Figure {
    let outline = match domain {
        TriangleDomain::Square => vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
        TriangleDomain::Rectangle => vec![[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]],
        TriangleDomain::Disc | TriangleDomain::Ball => circle([0.0; 2], 1.0),
    };
    let mut figure = plane("Triangles of three uniform points").with(
        "",
        Ink::Muted,
        Mark::Polygon { points: outline, opacity: 0.06 },
    );
    for (kind, ink, name) in [(true, Ink::Blue, "counted"), (false, Ink::Orange, "not counted")] {
        let some = samples.iter().filter(|u| (problem.sample(u) > 0.0) == kind).take(TRIANGLES);
        for (at, u) in some.enumerate() {
            let corners = triangle::corners(domain, u);
            let mut points: Vec<[f64; 2]> = corners.iter().map(|corner| [corner[0], corner[1]]).collect();
            points.push(points[0]);
            let name = if at == 0 { name } else { "" };
            figure = figure.with(name, ink, Mark::Line { points, dash: Dash::Solid, width: 1.3 });
        }
    }
    figure
}

/// How many paths scatter how often, beside the geometric law.
fn furnace(problem: &Problem, albedo: f64, samples: &[&[f64]]) -> Figure {
    const SHOWN_SCATTERINGS: usize = 12;
    let mut counts = [0.0; SHOWN_SCATTERINGS];
    for u in samples {
        if let Some(count) = counts.get_mut((problem.sample(u) - 1.0) as usize) {
            *count += 1.0 / samples.len() as f64;
        }
    }
    let edges = (0..=SHOWN_SCATTERINGS).map(|k| k as f64 - 0.5).collect();
    let law = (0..SHOWN_SCATTERINGS).map(|k| [k as f64, (1.0 - albedo) * libm::pow(albedo, k as f64)]);
    Figure::new("How often paths scatter")
        .with_x(Axis::linear("scatterings"))
        .with_y(Axis::linear("part of the paths"))
        .bars("paths", Ink::Sky, edges, counts.to_vec())
        .points("(1−a)aᵏ", Ink::Vermilion, law.collect(), 6.0)
}

fn bell(integral: &Integral, samples: &[&[f64]]) -> Figure {
    let side = &integral.domain.sides()[0];
    let places: Vec<f64> = (0..=600).map(|i| side.low + side.length() * f64::from(i) / 600.0).collect();
    let curve = |of: &dyn Fn(f64) -> f64| places.iter().map(|&x| [x, of(x)]).collect::<Vec<_>>();
    let density = curve(&|x| integral.density.pdf(&[x], &integral.domain));
    let drawn = samples.iter().take(200).map(|u| {
        let mut x = [0.0];
        integral.density.draw(u, &integral.domain, &mut x);
        [x[0], 0.0]
    });
    let drawn: Vec<[f64; 2]> = drawn.filter(|[x, _]| (side.low..=side.high).contains(x)).collect();
    Figure::new("cos⁷⁷ and the density of its samples")
        .with_x(Axis::linear("x").with_range(side.low, side.high))
        .with_y(Axis::linear(""))
        .line("cos⁷⁷x", Ink::Blue, curve(&|x| integral.value(&[x])))
        .line("density", Ink::Vermilion, density)
        .points("200 samples", Ink::Text, drawn, 3.0)
}
