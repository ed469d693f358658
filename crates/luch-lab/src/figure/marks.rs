//! From layers to shapes.

use super::axis::Span;
use super::drawing::{Rect, Shape, Stroke, Text, clipped, clipped_line};
use super::theme::Paint;
use super::{Anchor, Arrow, Dash, Figure, Layer, Mark, Marker, Raster, thin};

/// The plot: its place and what its axes measure.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    pub(super) plot: Rect,
    pub(super) x: Span,
    pub(super) y: Span,
}

impl Frame {
    pub(super) fn x_of_measured(&self, measured: f64) -> f64 {
        self.plot.x + self.x.fraction_of_measured(measured) * self.plot.width
    }

    pub(super) fn y_of_measured(&self, measured: f64) -> f64 {
        self.plot.bottom() - self.y.fraction_of_measured(measured) * self.plot.height
    }

    /// The pixel of a point; `None` if it has no place. Far away is brought to where numbers are still exact.
    fn place(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        let x = self.x_of_measured(self.x.scale.measure(x)?);
        let y = self.y_of_measured(self.y.scale.measure(y)?);
        Some([x.clamp(-1e6, 1e6), y.clamp(-1e6, 1e6)])
    }

    /// The pixel of a height, the bottom if it has no place there: bars stand on it.
    fn y_or_bottom(&self, y: f64) -> f64 {
        let place = self.y.scale.measure(y).map(|measured| self.y_of_measured(measured));
        place.unwrap_or(self.plot.bottom()).clamp(self.plot.y, self.plot.bottom())
    }

    fn x_inside(&self, x: f64) -> Option<f64> {
        let measured = self.x.scale.measure(x)?;
        Some(self.x_of_measured(measured).clamp(self.plot.x, self.plot.right()))
    }
}

/// The ends of both axes.
pub(super) fn spans(figure: &Figure) -> [Span; 2] {
    let mut xs = Vec::new();
    let mut ys = Vec::new();
    let mut bounds = Bounds { xs: &mut xs, ys: &mut ys };
    for layer in &figure.layers {
        bounds.add(&layer.mark);
    }
    let has_heat = figure.layers.iter().any(|layer| matches!(layer.mark, Mark::Heat(_)));
    let is_stacked =
        figure.layers.iter().any(|layer| matches!(layer.mark, Mark::Bars { .. } | Mark::Step { .. }));
    let padding = if has_heat { 0.0 } else { 0.05 };
    let x_padding = if is_stacked || has_heat { 0.0 } else { 0.03 };
    [Span::new(&figure.x, xs.into_iter(), x_padding), Span::new(&figure.y, ys.into_iter(), padding)]
}

struct Bounds<'a> {
    xs: &'a mut Vec<f64>,
    ys: &'a mut Vec<f64>,
}

impl Bounds<'_> {
    fn add(&mut self, mark: &Mark) {
        match mark {
            Mark::Line { points, .. }
            | Mark::Points { points, .. }
            | Mark::Weighted { points, .. }
            | Mark::Polygon { points, .. } => {
                // A point without one number has no place at all.
                for [x, y] in points.iter().filter(|point| point.iter().all(|value| value.is_finite())) {
                    self.xs.push(*x);
                    self.ys.push(*y);
                }
            }
            Mark::Arrows(arrows) => {
                for Arrow { from, to } in arrows {
                    self.xs.extend([from[0], to[0]]);
                    self.ys.extend([from[1], to[1]]);
                }
            }
            Mark::Errors(bars) => {
                for bar in bars {
                    self.xs.push(bar.x);
                    self.ys.extend([bar.low, bar.y, bar.high]);
                }
            }
            Mark::Band(between) => {
                for pair in between {
                    self.xs.push(pair.x);
                    self.ys.extend([pair.low, pair.high]);
                }
            }
            Mark::Bars { edges, heights } | Mark::Step { edges, heights } => {
                self.xs.extend(edges);
                self.ys.extend(heights);
                if matches!(mark, Mark::Bars { .. }) {
                    self.ys.push(0.0);
                }
            }
            Mark::Heat(raster) => {
                self.xs.extend([raster.low[0], raster.high[0]]);
                self.ys.extend([raster.low[1], raster.high[1]]);
            }
            Mark::Level(y) => self.ys.push(*y),
            Mark::Place(x) => self.xs.push(*x),
            Mark::Slope { .. } | Mark::Note { .. } => {}
        }
    }
}

/// Adds the shapes of a layer.
pub(super) fn draw(layer: &Layer, frame: &Frame, shapes: &mut Vec<Shape>) {
    let paint = Paint::Ink(layer.ink);
    let solid = |width: f64| Stroke { paint, width, dash: Dash::Solid, opacity: 1.0 };
    match &layer.mark {
        Mark::Line { points, dash, width } => {
            let stroke = Stroke { dash: *dash, ..solid(pixels(*width, 0.2, 20.0)) };
            lines(points, frame, stroke, shapes);
        }
        Mark::Points { points, marker, size } => {
            let centers = inside(points, frame).into_iter().map(|(_, center)| center).collect();
            dots(centers, pixels(*size, 0.5, 60.0) / 2.0, *marker, paint, shapes);
        }
        Mark::Weighted { points, weights, size } => {
            let (centers, radii) = inside(points, frame)
                .into_iter()
                .filter_map(|(at, center)| {
                    let weight = weights.get(at)?.abs();
                    let radius = pixels(*size, 0.1, 60.0) / 2.0 * weight.sqrt();
                    weight.is_finite().then_some((center, radius.clamp(0.3, 60.0)))
                })
                .unzip();
            shapes.push(Shape::Discs { centers, radii, paint, opacity: 0.55 });
        }
        Mark::Arrows(arrows) => arrows_of(arrows, frame, solid(1.3), shapes),
        Mark::Errors(bars) => {
            let mut strokes = Vec::new();
            let mut centers = Vec::new();
            for bar in bars.iter().take(thin::MOST) {
                let (Some([x, y]), true) =
                    (frame.place([bar.x, bar.y]), bar.low.is_finite() && bar.high.is_finite())
                else {
                    continue;
                };
                let (low, high) = (frame.y_or_bottom(bar.low), frame.y_or_bottom(bar.high));
                if frame.plot.contains([x, frame.plot.y]) {
                    strokes.push(vec![[x, low], [x, high]]);
                    strokes.push(vec![[x - 3.5, low], [x + 3.5, low]]);
                    strokes.push(vec![[x - 3.5, high], [x + 3.5, high]]);
                }
                if frame.plot.contains([x, y]) {
                    centers.push([x, y]);
                }
            }
            shapes.push(Shape::Lines { lines: strokes, stroke: solid(1.4) });
            dots(centers, 2.8, Marker::Disc, paint, shapes);
        }
        Mark::Band(between) => {
            let sides = between.iter().filter_map(|pair| {
                let x = frame.x_inside(pair.x)?;
                let is_known = pair.low.is_finite() && pair.high.is_finite();
                is_known.then(|| [[x, frame.y_or_bottom(pair.low)], [x, frame.y_or_bottom(pair.high)]])
            });
            let sides: Vec<[[f64; 2]; 2]> = sides.collect();
            let low = thin::line(&sides.iter().map(|side| side[0]).collect::<Vec<_>>());
            let mut outline = thin::line(&sides.iter().map(|side| side[1]).collect::<Vec<_>>());
            outline.extend(low.into_iter().rev());
            shapes.push(Shape::Area { outlines: vec![outline], paint, opacity: 0.22 });
        }
        Mark::Bars { edges, heights } => {
            let bars = edges.windows(2).zip(heights).take(thin::MOST).filter_map(|(pair, &height)| {
                let (left, right) = (frame.x_inside(pair[0])?, frame.x_inside(pair[1])?);
                let (top, foot) = (frame.y_or_bottom(height), frame.y_or_bottom(0.0));
                // A hair of ground between wide bars.
                let gap = if right - left > 5.0 { 0.5 } else { 0.0 };
                let (left, right) = (left + gap, right - gap);
                let has_room = height.is_finite() && right > left;
                has_room.then(|| vec![[left, top], [right, top], [right, foot], [left, foot]])
            });
            shapes.push(Shape::Area { outlines: bars.collect(), paint, opacity: 0.75 });
        }
        Mark::Step { edges, heights } => {
            let stair = edges.windows(2).zip(heights);
            let points: Vec<[f64; 2]> =
                stair.flat_map(|(pair, &height)| [[pair[0], height], [pair[1], height]]).collect();
            lines(&points, frame, solid(1.8), shapes);
        }
        Mark::Polygon { points, opacity } => {
            let outline: Vec<[f64; 2]> = points.iter().filter_map(|&point| frame.place(point)).collect();
            let inside = outline
                .iter()
                .map(|[x, y]| {
                    [x.clamp(frame.plot.x, frame.plot.right()), y.clamp(frame.plot.y, frame.plot.bottom())]
                })
                .collect();
            shapes.push(Shape::Area { outlines: vec![inside], paint, opacity: pixels(*opacity, 0.0, 1.0) });
            let mut closed = outline.clone();
            closed.extend(outline.first());
            shapes.push(Shape::Lines { lines: clipped_line(&closed, &frame.plot), stroke: solid(1.4) });
        }
        Mark::Heat(raster) => heat(raster, frame, shapes),
        Mark::Slope { through, slope } => slope_line(layer, *through, *slope, frame, shapes),
        Mark::Level(y) => {
            if let Some(fraction) = frame.y.fraction(*y)
                && (0.0..=1.0).contains(&fraction)
            {
                let y = frame.plot.bottom() - fraction * frame.plot.height;
                let line = vec![vec![[frame.plot.x, y], [frame.plot.right(), y]]];
                shapes
                    .push(Shape::Lines { lines: line, stroke: Stroke { dash: Dash::Dashed, ..solid(1.3) } });
                let below = y < frame.plot.y + 18.0;
                let at = [frame.plot.right() - 6.0, if below { y + 14.0 } else { y - 5.0 }];
                label(&layer.name, at, Anchor::Right, paint, shapes);
            }
        }
        Mark::Place(x) => {
            if let Some(fraction) = frame.x.fraction(*x)
                && (0.0..=1.0).contains(&fraction)
            {
                let x = frame.plot.x + fraction * frame.plot.width;
                let line = vec![vec![[x, frame.plot.y], [x, frame.plot.bottom()]]];
                shapes
                    .push(Shape::Lines { lines: line, stroke: Stroke { dash: Dash::Dashed, ..solid(1.3) } });
                let (dx, anchor) = if fraction > 0.7 { (-6.0, Anchor::Right) } else { (6.0, Anchor::Left) };
                label(&layer.name, [x + dx, frame.plot.y + 15.0], anchor, paint, shapes);
            }
        }
        Mark::Note { at, text, anchor } => {
            if let Some(at) = frame.place(*at)
                && frame.plot.contains(at)
            {
                label(text, [at[0], at[1] + 4.0], *anchor, paint, shapes);
            }
        }
    }
}

fn pixels(size: f64, least: f64, most: f64) -> f64 {
    if size.is_nan() { least } else { size.clamp(least, most) }
}

fn label(text: &str, at: [f64; 2], anchor: Anchor, paint: Paint, shapes: &mut Vec<Shape>) {
    if !text.is_empty() {
        let text = super::layout::fitted(text, 420.0, 12.0);
        shapes.push(Shape::Text(Text {
            at,
            text,
            size: 12.0,
            anchor,
            is_bold: false,
            paint,
            has_halo: true,
        }));
    }
}

/// Points inside the plot with their numbers, not too many.
fn inside(points: &[[f64; 2]], frame: &Frame) -> Vec<(usize, [f64; 2])> {
    let placed: Vec<(usize, [f64; 2])> = points
        .iter()
        .enumerate()
        .filter_map(|(at, &point)| Some((at, frame.place(point)?)))
        .filter(|(_, place)| frame.plot.contains(*place))
        .collect();
    let places: Vec<[f64; 2]> = placed.iter().map(|(_, place)| *place).collect();
    thin::points(&places, 0.7).into_iter().map(|at| placed[at]).collect()
}

fn dots(centers: Vec<[f64; 2]>, radius: f64, marker: Marker, paint: Paint, shapes: &mut Vec<Shape>) {
    shapes.push(Shape::Dots { centers, radius, marker, paint, opacity: 1.0 });
}

fn lines(points: &[[f64; 2]], frame: &Frame, stroke: Stroke, shapes: &mut Vec<Shape>) {
    let places: Vec<Option<[f64; 2]>> = points.iter().map(|&point| frame.place(point)).collect();
    let mut pieces = Vec::new();
    for run in places.split(Option::is_none) {
        let run: Vec<[f64; 2]> = run.iter().flatten().copied().collect();
        pieces.extend(clipped_line(&thin::line(&run), &frame.plot));
    }
    shapes.push(Shape::Lines { lines: pieces, stroke });
}

fn arrows_of(arrows: &[Arrow], frame: &Frame, stroke: Stroke, shapes: &mut Vec<Shape>) {
    let mut strokes = Vec::new();
    for Arrow { from, to } in arrows.iter().take(thin::MOST) {
        let (Some(a), Some(b)) = (frame.place(*from), frame.place(*to)) else { continue };
        let Some([a, b]) = clipped(a, b, &frame.plot) else { continue };
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let length = (dx * dx + dy * dy).sqrt();
        strokes.push(vec![a, b]);
        if length > 0.5 {
            let head = length.min(7.0) * 0.8 / length;
            let side =
                |turn: f64| [b[0] - head * (dx - turn * 0.5 * dy), b[1] - head * (dy + turn * 0.5 * dx)];
            strokes.push(vec![side(1.0), b, side(-1.0)]);
        }
    }
    shapes.push(Shape::Lines { lines: strokes, stroke });
}

fn heat(raster: &Raster, frame: &Frame, shapes: &mut Vec<Shape>) {
    let height = raster.height();
    let (Some(low), Some(high)) = (frame.place(raster.low), frame.place(raster.high)) else { return };
    let rect = Rect { x: low[0], y: high[1], width: high[0] - low[0], height: low[1] - high[1] };
    if height == 0 || !(rect.width > 0.0 && rect.height > 0.0) {
        return;
    }
    // Not more cells than a screen has pixels: means of neighbours.
    let (columns, rows) = (raster.width.min(1024), height.min(1024));
    let ends = raster.ends();
    let range = |i: usize, parts: usize, count: usize| i * count / parts..((i + 1) * count / parts);
    let pixels = (0..rows).rev().flat_map(|row| (0..columns).map(move |column| (row, column)));
    let pixels = pixels.map(|(row, column)| {
        let (ys, xs) = (range(row, rows, height), range(column, columns, raster.width));
        let covered = ys.flat_map(|y| xs.clone().map(move |x| raster.values[y * raster.width + x]));
        let (sum, count) = covered
            .filter(|value| value.is_finite())
            .fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
        match raster.fraction(sum / count, ends) {
            Some(fraction) => raster.map.color(fraction),
            None => [128; 3],
        }
    });
    let pixels: Vec<[u8; 3]> = pixels.collect();
    // Cut to the plot where a fixed range shows only a part.
    if rect.x >= frame.plot.x - 0.6
        && rect.right() <= frame.plot.right() + 0.6
        && rect.y >= frame.plot.y - 0.6
        && rect.bottom() <= frame.plot.bottom() + 0.6
    {
        shapes.push(Shape::Picture { rect, width: columns, pixels });
        return;
    }
    let first = |from: f64, least: f64, cell: f64| ((least - from) / cell - 1e-6).ceil().max(0.0) as usize;
    let last = |from: f64, most: f64, cell: f64, count: usize| {
        (((most - from) / cell + 1e-6).floor().max(0.0) as usize).min(count)
    };
    let (cell_x, cell_y) = (rect.width / columns as f64, rect.height / rows as f64);
    let xs = first(rect.x, frame.plot.x, cell_x)..last(rect.x, frame.plot.right(), cell_x, columns);
    let ys = first(rect.y, frame.plot.y, cell_y)..last(rect.y, frame.plot.bottom(), cell_y, rows);
    if xs.is_empty() || ys.is_empty() {
        return;
    }
    let part = Rect {
        x: rect.x + xs.start as f64 * cell_x,
        y: rect.y + ys.start as f64 * cell_y,
        width: xs.len() as f64 * cell_x,
        height: ys.len() as f64 * cell_y,
    };
    let pixels = ys.flat_map(|y| pixels[y * columns + xs.start..y * columns + xs.end].to_vec()).collect();
    shapes.push(Shape::Picture { rect: part, width: xs.len(), pixels });
}

fn slope_line(layer: &Layer, through: [f64; 2], slope: f64, frame: &Frame, shapes: &mut Vec<Shape>) {
    let (Some(x), Some(y)) = (frame.x.scale.measure(through[0]), frame.y.scale.measure(through[1])) else {
        return;
    };
    if !slope.is_finite() {
        return;
    }
    // An exponent joins logarithms of one base.
    let unit = |scale: super::Scale| if scale == super::Scale::Log2 { std::f64::consts::LN_2 } else { 1.0 };
    let natural = |scale: super::Scale| {
        if scale == super::Scale::Log10 { std::f64::consts::LN_10 } else { unit(scale) }
    };
    let factor = if frame.x.scale.is_logarithmic() && frame.y.scale.is_logarithmic() {
        natural(frame.x.scale) / natural(frame.y.scale)
    } else {
        1.0
    };
    let at = |measured: f64| {
        let height = y + slope * factor * (measured - x);
        [frame.x_of_measured(measured), frame.y_of_measured(height).clamp(-1e6, 1e6)]
    };
    let Some([a, b]) = clipped(at(frame.x.low), at(frame.x.high), &frame.plot) else { return };
    let stroke = Stroke { paint: Paint::Ink(layer.ink), width: 1.3, dash: Dash::Dashed, opacity: 0.9 };
    shapes.push(Shape::Lines { lines: vec![vec![a, b]], stroke });
    // Beside the line, near its right end, on the side where there is room.
    let t = 0.9;
    let place = [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
    let steep = b[1] > a[1];
    let at = [place[0] + if steep { 8.0 } else { -8.0 }, place[1] - 7.0];
    let anchor = if at[0] > frame.plot.right() - 70.0 { Anchor::Right } else { Anchor::Left };
    let at = if anchor == Anchor::Right { [at[0].min(frame.plot.right() - 6.0), at[1]] } else { at };
    label(&layer.name, [at[0], at[1].max(frame.plot.y + 12.0)], anchor, Paint::Ink(layer.ink), shapes);
}
