//! Pictures of an explanation.

use super::{Explanation, Technique, luminance};
use crate::figure::{Axis, Between, Figure, Ink};

/// The mean as samples come in, with its interval.
pub fn running_figure(explanation: &Explanation) -> Figure {
    let means = explanation.running.iter().map(|row| [row.samples as f64, row.mean]).collect();
    let between = |row: &super::Running| {
        row.interval.map(|interval| Between { x: row.samples as f64, low: interval.low, high: interval.high })
    };
    let band: Vec<Between> = explanation.running.iter().filter_map(between).collect();
    let [x, y] = explanation.pixel;
    Figure::new(format!("Pixel {x},{y}: mean of the first N samples"))
        .with_caption("Own paths; 95 % interval as if samples were independent")
        .with_x(Axis::log2("samples N"))
        .with_y(Axis::linear("luminance"))
        .band("95 %", Ink::of(0), band)
        .line("mean", Ink::of(0), means)
        .level("picture, neighbours helping", luminance(explanation.picture_mean))
}

/// Light by depth and technique.
pub fn depth_figure(explanation: &Explanation) -> Figure {
    let deepest = explanation.by_technique.iter().map(|part| part.kind.0).max().unwrap_or(0);
    let start = Figure::new("Light by the number of scatterings")
        .with_x(Axis::linear("scatterings between lamp and camera"))
        .with_y(Axis::linear("part of the pixel"));
    Technique::ALL.iter().enumerate().fold(start, |figure, (place, &technique)| {
        let share = |depth: u32| {
            let part = explanation.by_technique.iter().find(|part| part.kind == (depth, technique));
            part.map_or(0.0, |part| part.share)
        };
        let heights: Vec<f64> = (0..=deepest).map(share).collect();
        if heights.iter().all(|height| *height == 0.0) {
            return figure;
        }
        // Three narrow bars side by side.
        let width = 0.27;
        let edges = |depth: u32| f64::from(depth) - 0.405 + width * place as f64;
        let (mut places, mut bars) = (vec![edges(0)], Vec::new());
        for (depth, height) in (0..).zip(heights) {
            places.push(edges(depth) + width);
            bars.push(height);
            if depth < deepest {
                places.push(edges(depth + 1));
                bars.push(0.0);
            }
        }
        figure.bars(technique.name(), Ink::of(place), places, bars)
    })
}
