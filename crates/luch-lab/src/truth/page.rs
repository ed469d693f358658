//! Rows as tables and figures.

use super::{DISTANCE, Family, Judgement, Row, Technique};
use crate::figure::{Anchor, Axis, Figure, Ink, Mark, Marker};
use crate::report::Table;

/// Every row: what was found beside what is true; what is rejected is marked.
pub fn table(rows: &[Row], judgement: &Judgement) -> Table {
    let head = ["family", "case", "integrator", "sampler", "truth", "estimate", "standard error", "z", "p"];
    let mut table = Table::new(head);
    for row in rows {
        let verdict = &row.verdict;
        let (error, z) = match verdict.z {
            Some(z) => (format!("{:.2e}", verdict.standard_error), format!("{z:+.2}")),
            None => ("exact".to_owned(), String::new()),
        };
        let p_value = match verdict.p_value {
            p if p < judgement.limit => format!("{p:.1e} FAILS"),
            p if p == 0.0 || p >= 1e-3 => format!("{p:.3}"),
            p => format!("{p:.1e}"),
        };
        table = table.row([
            row.family.name().to_owned(),
            row.case.clone(),
            row.way.clone(),
            row.sequence.name().to_owned(),
            format!("{:.6}", verdict.truth),
            format!("{:.6}", verdict.mean),
            error,
            z,
            p_value,
        ]);
    }
    table
}

/// How far off every row is, in standard errors, family by family.
pub fn z_scores(rows: &[Row]) -> Figure {
    let families: Vec<Family> =
        Family::ALL.into_iter().filter(|family| rows.iter().any(|row| row.family == *family)).collect();
    let far = rows.iter().filter_map(|row| row.verdict.z).map(f64::abs).fold(DISTANCE, f64::max);
    let reach = (far.min(20.0) * 1.25).max(DISTANCE + 1.5);
    // Each family takes a unit of x.
    let place = |row: &Row, at: usize, of: usize| {
        let family = families.iter().position(|family| *family == row.family).unwrap_or(0);
        family as f64 + (at as f64 + 0.5) / of as f64
    };
    let mut points = [const { Vec::new() }; Technique::ALL.len()];
    for &family in &families {
        let mine: Vec<&Row> =
            rows.iter().filter(|row| row.family == family && row.verdict.z.is_some()).collect();
        for (at, row) in mine.iter().enumerate() {
            let series = Technique::ALL.iter().position(|one| Some(*one) == row.technique).unwrap_or(0);
            let z = row.verdict.z.unwrap_or(0.0).clamp(-0.98 * reach, 0.98 * reach);
            points[series].push([place(row, at, mine.len()), z]);
        }
    }
    let count = families.len().max(1) as f64;
    let start = Figure::new("How far off, in standard errors")
        .with_caption("Every point is a case by one integrator with one sequence. If all are right, about one in 3000 lies outside the lines.")
        .with_x(Axis::linear("families, one after the other").with_range(0.0, count))
        .with_y(Axis::linear("z").with_range(-reach, reach))
        .level("4", DISTANCE)
        .level("", 0.0)
        .level("−4", -DISTANCE);
    let named = families.iter().enumerate().fold(start, |figure, (at, family)| {
        // Two rows of names: they are wider than what they stand over.
        let y = reach * if at % 2 == 0 { 0.93 } else { 0.85 };
        figure.note(family.name(), [at as f64 + 0.5, y], Anchor::Middle)
    });
    Technique::ALL.into_iter().zip(points).enumerate().filter(|(_, (_, points))| !points.is_empty()).fold(
        named,
        |figure, (at, (technique, points))| {
            let mark = Mark::Points { points, marker: Marker::of(at), size: 4.0 };
            figure.with(technique.name(), Ink::of(at), mark)
        },
    )
}

/// How often each probability was found; even if all is right.
pub fn histogram(rows: &[Row], judgement: &Judgement) -> Figure {
    const BARS: usize = 20;
    let mut heights = vec![0.0; BARS];
    for row in rows.iter().filter(|row| !row.verdict.is_rounding()) {
        heights[((row.verdict.p_value * BARS as f64) as usize).min(BARS - 1)] += 1.0;
    }
    let edges = (0..=BARS).map(|at| at as f64 / BARS as f64).collect();
    let top = heights.iter().copied().fold(1.0, f64::max);
    Figure::new("Probabilities")
        .with_caption("If every row is right and honest about its error, all bars are as high as the line, up to chance.")
        .with_x(Axis::linear("p").with_range(0.0, 1.0))
        .with_y(Axis::linear("rows").with_range(0.0, 1.1 * top))
        .bars("", Ink::Blue, edges, heights)
        .level("expected", judgement.tests as f64 / BARS as f64)
}
