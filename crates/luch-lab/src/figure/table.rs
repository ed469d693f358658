//! The numbers of figures as text.

use super::{Figure, Mark, Sheet};
use serde::Serialize;
use std::fmt::Write;

/// All rows of a figure under one heading.
pub(super) fn csv(figure: &Figure) -> String {
    let mut out = String::from("layer,name,kind,x,y,low,high\n");
    rows(figure, "", &mut out);
    out
}

/// All rows of all figures.
pub(super) fn csv_of_sheet(sheet: &Sheet) -> String {
    let mut out = String::from("figure,layer,name,kind,x,y,low,high\n");
    for figure in &sheet.figures {
        rows(figure, &format!("{},", quoted(&figure.title)), &mut out);
    }
    out
}

/// As data. Every number is written so that it is read back exactly.
pub(super) fn json<T: Serialize>(value: &T) -> String {
    // Lists, names and numbers only: nothing that could fail.
    serde_json::to_string(value).unwrap_or_default()
}

fn rows(figure: &Figure, prefix: &str, out: &mut String) {
    for (at, layer) in figure.layers.iter().enumerate() {
        let start = |kind: &str| format!("{prefix}{at},{},{kind}", quoted(&layer.name));
        let mut row = |kind: &str, x: f64, y: f64, low: Option<f64>, high: Option<f64>| {
            let side = |value: Option<f64>| value.map(|value| value.to_string()).unwrap_or_default();
            let _ = writeln!(out, "{},{x},{y},{},{}", start(kind), side(low), side(high));
        };
        match &layer.mark {
            Mark::Line { points, .. } => points.iter().for_each(|&[x, y]| row("line", x, y, None, None)),
            Mark::Points { points, .. } => points.iter().for_each(|&[x, y]| row("point", x, y, None, None)),
            Mark::Polygon { points, .. } => {
                points.iter().for_each(|&[x, y]| row("corner", x, y, None, None));
            }
            Mark::Weighted { points, weights, .. } => {
                for (&[x, y], &weight) in points.iter().zip(weights) {
                    row("weight", x, y, Some(weight), None);
                }
            }
            Mark::Arrows(arrows) => {
                for arrow in arrows {
                    row("arrow", arrow.from[0], arrow.from[1], Some(arrow.to[0]), Some(arrow.to[1]));
                }
            }
            Mark::Errors(bars) => {
                bars.iter().for_each(|bar| row("error", bar.x, bar.y, Some(bar.low), Some(bar.high)));
            }
            Mark::Band(between) => {
                for pair in between {
                    row("band", pair.x, (pair.low + pair.high) / 2.0, Some(pair.low), Some(pair.high));
                }
            }
            Mark::Bars { edges, heights } | Mark::Step { edges, heights } => {
                let kind = if matches!(layer.mark, Mark::Bars { .. }) { "bar" } else { "step" };
                for (pair, &height) in edges.windows(2).zip(heights) {
                    row(kind, (pair[0] + pair[1]) / 2.0, height, Some(pair[0]), Some(pair[1]));
                }
            }
            Mark::Heat(raster) => {
                let height = raster.height();
                for (index, &value) in raster.values.iter().take(height * raster.width).enumerate() {
                    let middle = |axis: usize, at: usize, count: usize| {
                        let step = (raster.high[axis] - raster.low[axis]) / count as f64;
                        raster.low[axis] + (at as f64 + 0.5) * step
                    };
                    let (column, line) = (index % raster.width, index / raster.width);
                    let (x, y) = (middle(0, column, raster.width), middle(1, line, height));
                    row("cell", x, y, Some(value), None);
                }
            }
            Mark::Slope { through, slope } => row("slope", through[0], through[1], Some(*slope), None),
            Mark::Level(y) => row("level", f64::NAN, *y, None, None),
            Mark::Place(x) => row("place", *x, f64::NAN, None, None),
            Mark::Note { at, .. } => row("note", at[0], at[1], None, None),
        }
    }
}

/// A text as one field (RFC 4180).
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}
