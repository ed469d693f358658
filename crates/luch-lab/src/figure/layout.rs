//! Where everything stands.

use super::axis::{Span, Tick};
use super::drawing::{Drawing, Rect, Shape, Stroke, Text};
use super::marks::{self, Frame};
use super::theme::Paint;
use super::{Anchor, Dash, Figure, Ink, Mark, Marker, Raster, font};

/// The width of a figure.
pub(super) const WIDTH: f64 = 720.0;

/// Room at the sides of everything.
const MARGIN: f64 = 22.0;

const TITLE: f64 = 17.0;
const LABEL: f64 = 12.5;
const SMALL: f64 = 12.0;

/// The longest text that is drawn, in characters, and the most lines of a caption.
const LONGEST: usize = 2000;
const MOST_LINES: usize = 12;

/// The shapes of a figure.
pub(super) fn figure(figure: &Figure) -> Drawing {
    sized(figure, WIDTH)
}

/// The same at another width.
pub(super) fn sized(figure: &Figure, width: f64) -> Drawing {
    let mut drawing = Drawing {
        width,
        title: figure.title.clone(),
        description: figure.caption.clone(),
        ..Drawing::default()
    };
    let inner = width - 2.0 * MARGIN;
    let mut y = 16.0;
    for line in wrapped(&figure.title, inner, TITLE, true, 3) {
        y += TITLE + 4.0;
        drawing.shapes.push(text([MARGIN, y], line, TITLE, Anchor::Left, true, Ink::Text));
    }
    y = legend(figure, &mut drawing.shapes, y + 6.0, inner);

    let spans = marks::spans(figure);
    let bar = figure.layers.iter().find_map(|layer| match &layer.mark {
        Mark::Heat(raster) if raster.has_bar && raster.height() > 0 => Some(raster),
        _ => None,
    });
    let bar_room = if bar.is_some() { 76.0 } else { 0.0 };
    if !figure.y.label.is_empty() {
        y += LABEL + 6.0;
        let label = fitted(&figure.y.label, inner, LABEL);
        drawing.shapes.push(text([MARGIN, y], label, LABEL, Anchor::Left, false, Ink::Muted));
    }
    let top = y + 14.0;

    // The room of the numbers at the left follows from the longest of them.
    let y_ticks = spans[1].ticks(6);
    let widest =
        y_ticks.iter().map(|tick| font::width(&tick.label, SMALL, false)).fold(18.0, f64::max).min(110.0);
    let left = MARGIN + widest + 9.0;
    let most = width - MARGIN - left - bar_room;
    let plot = if figure.is_square {
        let ratio = ((spans[1].high - spans[1].low) / (spans[0].high - spans[0].low)).clamp(0.05, 20.0);
        let (mut w, mut h) = (most, most * ratio);
        if h > 0.86 * width {
            (w, h) = (0.86 * width / ratio, 0.86 * width);
        }
        // What is narrow stands in the middle.
        Rect { x: left + (most - w) / 2.0, y: top, width: w, height: h }
    } else {
        Rect { x: left, y: top, width: most, height: 0.46 * width }
    };
    let wanted = if figure.is_square { 6 } else { 9 };
    let x_ticks = spans[0].ticks(((plot.width / 56.0) as usize).clamp(2, wanted));
    let frame = Frame { plot, x: spans[0].clone(), y: spans[1].clone() };

    drawing.shapes.push(Shape::Area { outlines: vec![corners(&plot)], paint: Paint::Panel, opacity: 1.0 });
    grid(&frame, &x_ticks, &y_ticks, &mut drawing.shapes);
    for layer in &figure.layers {
        marks::draw(layer, &frame, &mut drawing.shapes);
    }
    ticks(&frame, &x_ticks, &y_ticks, &mut drawing.shapes);
    if let Some(raster) = bar {
        color_bar(raster, &plot, &mut drawing.shapes);
    }

    let mut y = plot.bottom() + 10.0 + SMALL;
    if !figure.x.label.is_empty() {
        y += LABEL + 7.0;
        let label = fitted(&figure.x.label, inner, LABEL);
        let middle = plot.x + plot.width / 2.0;
        drawing.shapes.push(text([middle, y], label, LABEL, Anchor::Middle, false, Ink::Muted));
    }
    let caption = wrapped(&figure.caption, inner, LABEL, false, MOST_LINES);
    if !caption.is_empty() {
        y += 12.0;
    }
    for line in caption {
        y += LABEL + 5.5;
        drawing.shapes.push(text([MARGIN, y], line, LABEL, Anchor::Left, false, Ink::Text));
    }
    drawing.height = (y + 20.0).ceil();
    drawing
}

fn corners(rect: &Rect) -> Vec<[f64; 2]> {
    vec![[rect.x, rect.y], [rect.right(), rect.y], [rect.right(), rect.bottom()], [rect.x, rect.bottom()]]
}

pub(super) fn text(
    at: [f64; 2],
    text: impl Into<String>,
    size: f64,
    anchor: Anchor,
    is_bold: bool,
    ink: Ink,
) -> Shape {
    Shape::Text(Text {
        at,
        text: text.into(),
        size,
        anchor,
        is_bold,
        paint: Paint::Ink(ink),
        has_halo: false,
    })
}

fn thin_lines(lines: Vec<Vec<[f64; 2]>>, paint: Paint, width: f64) -> Shape {
    Shape::Lines { lines, stroke: Stroke { paint, width, dash: Dash::Solid, opacity: 1.0 } }
}

fn grid(frame: &Frame, x_ticks: &[Tick], y_ticks: &[Tick], shapes: &mut Vec<Shape>) {
    let plot = &frame.plot;
    let xs = x_ticks.iter().filter(|tick| !tick.label.is_empty()).map(|tick| frame.x_of_measured(tick.at));
    let ys = y_ticks.iter().filter(|tick| !tick.label.is_empty()).map(|tick| frame.y_of_measured(tick.at));
    let lines = xs
        .map(|x| vec![[x, plot.y], [x, plot.bottom()]])
        .chain(ys.map(|y| vec![[plot.x, y], [plot.right(), y]]))
        .filter(|line| line.iter().all(|&point| plot.contains(point)));
    shapes.push(thin_lines(lines.collect(), Paint::Grid, 1.0));
}

fn ticks(frame: &Frame, x_ticks: &[Tick], y_ticks: &[Tick], shapes: &mut Vec<Shape>) {
    let plot = &frame.plot;
    let mut lines = vec![vec![[plot.x, plot.y], [plot.x, plot.bottom()], [plot.right(), plot.bottom()]]];
    let mut free_from = f64::NEG_INFINITY;
    for tick in x_ticks {
        let x = frame.x_of_measured(tick.at);
        if !plot.contains([x, plot.y]) {
            continue;
        }
        let length = if tick.label.is_empty() { 3.0 } else { 5.0 };
        lines.push(vec![[x, plot.bottom()], [x, plot.bottom() + length]]);
        // A label that would touch its neighbour is left out.
        let half = font::width(&tick.label, SMALL, false) / 2.0;
        if !tick.label.is_empty() && x - half > free_from {
            free_from = x + half + 4.0;
            let at = [x, plot.bottom() + 9.0 + SMALL * 0.8];
            shapes.push(text(at, &*tick.label, SMALL, Anchor::Middle, false, Ink::Muted));
        }
    }
    let mut free_below = f64::INFINITY;
    for tick in y_ticks {
        let y = frame.y_of_measured(tick.at);
        if !plot.contains([plot.x, y]) {
            continue;
        }
        let length = if tick.label.is_empty() { 3.0 } else { 5.0 };
        lines.push(vec![[plot.x - length, y], [plot.x, y]]);
        if !tick.label.is_empty() && y + SMALL / 2.0 < free_below {
            free_below = y - SMALL / 2.0;
            let at = [plot.x - 8.0, y + SMALL * 0.35];
            shapes.push(text(at, &*tick.label, SMALL, Anchor::Right, false, Ink::Muted));
        }
    }
    shapes.push(thin_lines(lines, Paint::Frame, 1.0));
}

fn color_bar(raster: &Raster, plot: &Rect, shapes: &mut Vec<Shape>) {
    const STEPS: usize = 128;
    let rect = Rect { x: plot.right() + 16.0, y: plot.y, width: 12.0, height: plot.height };
    let pixels = (0..STEPS).map(|i| raster.map.color(1.0 - (i as f64 + 0.5) / STEPS as f64)).collect();
    shapes.push(Shape::Picture { rect, width: 1, pixels });
    let mut outline = corners(&rect);
    outline.push(outline[0]);
    let mut lines = vec![outline];
    let axis = super::Axis {
        label: String::new(),
        scale: if raster.is_logarithmic { super::Scale::Log10 } else { super::Scale::Linear },
        range: Some(raster.ends()),
    };
    let span = Span::new(&axis, raster.ends().into_iter(), 0.0);
    for tick in span.ticks(5).iter().filter(|tick| !tick.label.is_empty()) {
        let y = rect.bottom() - span.fraction_of_measured(tick.at) * rect.height;
        if !(rect.y - 0.5..=rect.bottom() + 0.5).contains(&y) {
            continue;
        }
        lines.push(vec![[rect.right(), y], [rect.right() + 4.0, y]]);
        let at = [rect.right() + 7.0, y + SMALL * 0.35];
        shapes.push(text(at, &*tick.label, SMALL, Anchor::Left, false, Ink::Muted));
    }
    shapes.push(thin_lines(lines, Paint::Frame, 1.0));
}

/// Names of the layers in rows under the title; returns where the room below begins.
fn legend(figure: &Figure, shapes: &mut Vec<Shape>, top: f64, inner: f64) -> f64 {
    let (mut x, mut y, mut is_first) = (MARGIN, top, true);
    for layer in figure.layers.iter().filter(|layer| !layer.name.is_empty()).take(40) {
        if matches!(layer.mark, Mark::Slope { .. } | Mark::Level(_) | Mark::Place(_) | Mark::Note { .. }) {
            continue;
        }
        let key = if matches!(layer.mark, Mark::Heat(_)) { 0.0 } else { 26.0 };
        let name = fitted(&layer.name, inner - key, SMALL);
        let width = key + font::width(&name, SMALL, false) + 20.0;
        if is_first {
            y += 16.0;
            is_first = false;
        } else if x + width > MARGIN + inner + 20.0 {
            (x, y) = (MARGIN, y + 18.0);
        }
        sample(layer.ink, &layer.mark, [x, y - 4.0], shapes);
        shapes.push(text([x + key, y], name, SMALL, Anchor::Left, false, Ink::Text));
        x += width;
    }
    if is_first { top } else { y + 4.0 }
}

/// A piece of a layer beside its name.
fn sample(ink: Ink, mark: &Mark, [x, y]: [f64; 2], shapes: &mut Vec<Shape>) {
    let paint = Paint::Ink(ink);
    let line = |width: f64, dash: Dash| Shape::Lines {
        lines: vec![vec![[x, y], [x + 19.0, y]]],
        stroke: Stroke { paint, width, dash, opacity: 1.0 },
    };
    let block = |opacity: f64| Shape::Area {
        outlines: vec![corners(&Rect { x: x + 2.0, y: y - 5.0, width: 15.0, height: 10.0 })],
        paint,
        opacity,
    };
    let dot = |marker: Marker, radius: f64| Shape::Dots {
        centers: vec![[x + 9.5, y]],
        radius,
        marker,
        paint,
        opacity: 1.0,
    };
    match mark {
        Mark::Line { dash, width, .. } => shapes.push(line(width.clamp(1.0, 3.0), *dash)),
        Mark::Step { .. } => shapes.push(line(1.8, Dash::Solid)),
        Mark::Points { marker, size, .. } => {
            if *size >= 5.0 {
                shapes.push(line(1.8, Dash::Solid));
            }
            shapes.push(dot(*marker, 3.2));
        }
        Mark::Weighted { .. } => shapes.push(dot(Marker::Disc, 4.0)),
        Mark::Errors(_) => {
            shapes.push(line(1.4, Dash::Solid));
            shapes.push(dot(Marker::Disc, 2.6));
        }
        Mark::Arrows(_) => shapes.push(line(1.4, Dash::Solid)),
        Mark::Band(_) => shapes.push(block(0.3)),
        Mark::Bars { .. } => shapes.push(block(0.75)),
        Mark::Polygon { opacity, .. } => {
            shapes.push(block(if *opacity > 0.15 { opacity.min(1.0) } else { 0.15 }))
        }
        Mark::Heat(_) | Mark::Slope { .. } | Mark::Level(_) | Mark::Place(_) | Mark::Note { .. } => {}
    }
}

/// The beginning of a text that has room, with an ellipsis if it is cut.
pub(super) fn fitted(text: &str, room: f64, size: f64) -> String {
    let text: String = text.chars().take(LONGEST).map(|c| if c.is_control() { ' ' } else { c }).collect();
    if font::width(&text, size, false) <= room {
        return text;
    }
    let mut cut = String::new();
    let mut width = font::width("…", size, false);
    for character in text.chars() {
        width += font::width(character.encode_utf8(&mut [0; 4]), size, false);
        if width > room {
            break;
        }
        cut.push(character);
    }
    cut.push('…');
    cut
}

/// A text in lines that have room.
pub(super) fn wrapped(text: &str, room: f64, size: f64, is_bold: bool, most: usize) -> Vec<String> {
    let text: String = text.chars().take(LONGEST).collect();
    let mut lines: Vec<String> = Vec::new();
    let mut line = String::new();
    for word in text.split_whitespace() {
        let word = fitted(word, room, size);
        let longer = if line.is_empty() { word.clone() } else { format!("{line} {word}") };
        if font::width(&longer, size, is_bold) <= room {
            line = longer;
        } else {
            lines.push(std::mem::replace(&mut line, word));
        }
    }
    if !line.is_empty() {
        lines.push(line);
    }
    if lines.len() > most {
        lines.truncate(most);
        if let Some(last) = lines.last_mut() {
            last.push('…');
        }
    }
    lines
}
