//! Figures as text: braille for lines and points, half blocks for areas of colour.

use super::axis::Span;
use super::drawing::Rect;
use super::drawing::clipped_line;
use super::marks;
use super::theme::Theme;
use super::{Dash, Figure, Ink, Layer, Mark, Raster};
use std::fmt::Write;

/// What a terminal can show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Depth {
    /// Any colour of 24 bits.
    #[default]
    TrueColor,
    /// The customary 256 colours.
    Palette,
    /// No colour at all.
    Letters,
}

/// A character cell: eight dots, a letter over them, and colours.
#[derive(Clone, Copy, Default)]
struct Cell {
    dots: u8,
    letter: Option<char>,
    ink: Option<[u8; 3]>,
    /// Upper and lower colour of a picture.
    picture: Option<[[u8; 3]; 2]>,
}

struct Canvas {
    columns: usize,
    rows: usize,
    cells: Vec<Cell>,
}

impl Canvas {
    /// Sets a dot; a cell has 2 × 4 of them.
    fn dot(&mut self, x: f64, y: f64, ink: [u8; 3]) {
        let inside =
            (0.0..2.0 * self.columns as f64).contains(&x) && (0.0..4.0 * self.rows as f64).contains(&y);
        if !inside {
            return;
        }
        let (x, y) = (x as usize, y as usize);
        // Braille counts its dots down the columns, with the last row added later (Unicode 2800).
        const BITS: [[u8; 4]; 2] = [[0x01, 0x02, 0x04, 0x40], [0x08, 0x10, 0x20, 0x80]];
        let cell = &mut self.cells[y / 4 * self.columns + x / 2];
        cell.dots |= BITS[x % 2][y % 4];
        cell.ink = Some(ink);
    }

    fn line(&mut self, a: [f64; 2], b: [f64; 2], dash: Dash, ink: [u8; 3]) {
        let steps = (b[0] - a[0]).abs().max((b[1] - a[1]).abs()).ceil().clamp(1.0, 4000.0);
        for step in 0..=steps as usize {
            let skip = match dash {
                Dash::Solid => false,
                Dash::Dashed => step % 6 > 3,
                Dash::Dotted => step % 3 > 0,
            };
            if !skip {
                let t = step as f64 / steps;
                self.dot(a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), ink);
            }
        }
    }

    fn write(&mut self, text: &str, column: usize, row: usize, ink: [u8; 3]) {
        for (at, character) in text.chars().enumerate() {
            if row < self.rows && column + at < self.columns {
                let cell = &mut self.cells[row * self.columns + column + at];
                (cell.letter, cell.ink) = (Some(character), Some(ink));
            }
        }
    }
}

/// The figure as lines of text.
pub(super) fn draw(figure: &Figure, columns: usize, depth: Depth) -> String {
    let columns = columns.clamp(20, 400);
    let spans = marks::spans(figure);
    let label_width = |label: &str| label.chars().count();
    let y_ticks = spans[1].ticks(5);
    let gutter = y_ticks.iter().map(|tick| label_width(&tick.label)).max().unwrap_or(1).clamp(1, 12) + 1;
    let width = columns.saturating_sub(gutter + 1).max(8);
    let height = if figure.is_square {
        let ratio = (spans[1].high - spans[1].low) / (spans[0].high - spans[0].low);
        ((width as f64 / 2.0 * ratio.clamp(0.05, 2.0)) as usize).clamp(4, 100)
    } else {
        (width / 4).clamp(8, 40)
    };
    let mut canvas = Canvas { columns: width, rows: height, cells: vec![Cell::default(); width * height] };
    for layer in &figure.layers {
        draw_layer(layer, &spans, &mut canvas);
    }

    let mut out = String::new();
    for line in rows_of(&figure.title, columns, 3) {
        let _ = writeln!(out, "{}", bold(&line, depth));
    }
    legend(figure, columns, depth, &mut out);
    if !figure.y.label.is_empty() {
        let _ = writeln!(out, "{}", cut(&figure.y.label, columns));
    }
    let row_of = |at: f64| ((1.0 - spans[1].fraction_of_measured(at)) * (height as f64 - 1.0)).round();
    for row in 0..height {
        let label = y_ticks
            .iter()
            .filter(|tick| !tick.label.is_empty() && row_of(tick.at) == row as f64)
            .map(|tick| tick.label.as_str())
            .next()
            .unwrap_or("");
        let mark = if label.is_empty() { '│' } else { '┤' };
        let label = cut(label, gutter - 1);
        let _ = write!(out, "{}{label}{mark}", " ".repeat(gutter - 1 - label.chars().count()));
        write_row(&canvas.cells[row * width..(row + 1) * width], depth, &mut out);
        out.push('\n');
    }
    x_axis(&spans[0], gutter, width, &mut out);
    if !figure.x.label.is_empty() {
        let label = cut(&figure.x.label, columns);
        let indent = (gutter + width / 2).saturating_sub(label.chars().count() / 2);
        let _ = writeln!(out, "{}{label}", " ".repeat(indent.min(columns)));
    }
    for line in rows_of(&figure.caption, columns, 12) {
        let _ = writeln!(out, "{line}");
    }
    out
}

fn cut(text: &str, columns: usize) -> String {
    let clean = text.chars().map(|c| if c.is_control() { ' ' } else { c });
    if text.chars().count() <= columns {
        return clean.collect();
    }
    clean.take(columns.saturating_sub(1)).chain(['…']).collect()
}

/// A text in rows of whole words, `most` of them.
fn rows_of(text: &str, columns: usize, most: usize) -> Vec<String> {
    let mut rows: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        let word = cut(word, columns);
        let fits = rows.last().is_some_and(|row| row.chars().count() + 1 + word.chars().count() <= columns);
        if fits {
            if let Some(row) = rows.last_mut() {
                row.push(' ');
                row.push_str(&word);
            }
        } else if rows.len() < most {
            rows.push(word);
        } else {
            break;
        }
    }
    rows
}

fn bold(text: &str, depth: Depth) -> String {
    if depth == Depth::Letters { text.to_owned() } else { format!("\x1b[1m{text}\x1b[0m") }
}

/// Inks of middling brightness, legible on light and dark ground alike.
fn ink(ink: Ink) -> [u8; 3] {
    match ink {
        Ink::Text => [0x88, 0x8c, 0x92],
        other => other.color(Theme::Dark),
    }
}

fn legend(figure: &Figure, columns: usize, depth: Depth, out: &mut String) {
    let mut used = 0;
    for layer in figure.layers.iter().filter(|layer| !layer.name.is_empty()).take(24) {
        if matches!(layer.mark, Mark::Note { .. }) {
            continue;
        }
        let name = cut(&layer.name, columns.saturating_sub(4).max(4));
        let length = name.chars().count() + 4;
        if used > 0 && used + length > columns {
            out.push('\n');
            used = 0;
        }
        let key = if matches!(layer.mark, Mark::Slope { .. } | Mark::Level(_) | Mark::Place(_)) {
            "╌╌"
        } else {
            "━━"
        };
        match depth {
            Depth::Letters => {
                let _ = write!(out, "{key}{name}  ");
            }
            _ => {
                let _ = write!(out, "{}{key}\x1b[0m{name}  ", foreground(ink(layer.ink), depth));
            }
        }
        used += length;
    }
    if used > 0 {
        out.push('\n');
    }
}

fn x_axis(span: &Span, gutter: usize, width: usize, out: &mut String) {
    let mut axis: Vec<char> = std::iter::repeat_n('─', width).collect();
    let mut labels: Vec<char> = vec![' '; width + gutter + 2];
    let mut free = 0;
    for tick in span.ticks((width / 12).clamp(2, 10)) {
        let fraction = span.fraction_of_measured(tick.at);
        if !(-1e-9..=1.0 + 1e-9).contains(&fraction) || tick.label.is_empty() {
            continue;
        }
        let column = (fraction * (width as f64 - 1.0)).round() as usize;
        axis[column.min(width - 1)] = '┬';
        let length = tick.label.chars().count();
        let start = (gutter + column + 1).saturating_sub(length / 2);
        if start >= free && start + length <= labels.len() {
            labels[start..start + length]
                .iter_mut()
                .zip(tick.label.chars())
                .for_each(|(to, from)| *to = from);
            free = start + length + 1;
        }
    }
    let _ = writeln!(out, "{}└{}", " ".repeat(gutter - 1), axis.into_iter().collect::<String>());
    let labels: String = labels.into_iter().skip(1).collect();
    let _ = writeln!(out, "{}", labels.trim_end());
}

fn foreground([r, g, b]: [u8; 3], depth: Depth) -> String {
    match depth {
        Depth::TrueColor => format!("\x1b[38;2;{r};{g};{b}m"),
        Depth::Palette => format!("\x1b[38;5;{}m", nearest([r, g, b])),
        Depth::Letters => String::new(),
    }
}

fn background([r, g, b]: [u8; 3], depth: Depth) -> String {
    match depth {
        Depth::TrueColor => format!("\x1b[48;2;{r};{g};{b}m"),
        Depth::Palette => format!("\x1b[48;5;{}m", nearest([r, g, b])),
        Depth::Letters => String::new(),
    }
}

/// The nearest colour of the 6 × 6 × 6 cube of the customary palette.
fn nearest(color: [u8; 3]) -> u8 {
    const LEVELS: [i32; 6] = [0, 95, 135, 175, 215, 255];
    let level = |value: u8| {
        let distance = |level: &i32| (level - i32::from(value)).abs();
        (0..6u8).min_by_key(|&i| distance(&LEVELS[usize::from(i)])).unwrap_or(0)
    };
    let [r, g, b] = color.map(level);
    16 + 36 * r + 6 * g + b
}

fn write_row(cells: &[Cell], depth: Depth, out: &mut String) {
    const SHADES: [char; 10] = [' ', '.', ':', '-', '=', '+', '*', '#', '%', '@'];
    let mut current = String::new();
    for cell in cells {
        let (style, character) = match cell {
            Cell { letter: Some(letter), ink, .. } => (foreground(ink.unwrap_or([128; 3]), depth), *letter),
            Cell { dots, ink, .. } if *dots != 0 => {
                let character = char::from_u32(0x2800 + u32::from(*dots)).unwrap_or('*');
                (foreground(ink.unwrap_or([128; 3]), depth), character)
            }
            Cell { picture: Some([upper, lower]), .. } if depth == Depth::Letters => {
                let light = |c: &[u8; 3]| c.iter().map(|&v| usize::from(v)).sum::<usize>();
                let shade = (light(upper) + light(lower)) * SHADES.len() / (2 * 766);
                (String::new(), SHADES[shade.min(SHADES.len() - 1)])
            }
            Cell { picture: Some([upper, lower]), .. } => {
                (foreground(*upper, depth) + &background(*lower, depth), '▀')
            }
            _ => (String::new(), ' '),
        };
        if style != current {
            out.push_str(if current.is_empty() { "" } else { "\x1b[0m" });
            out.push_str(&style);
            current = style;
        }
        out.push(character);
    }
    if !current.is_empty() {
        out.push_str("\x1b[0m");
    }
}

fn draw_layer(layer: &Layer, spans: &[Span; 2], canvas: &mut Canvas) {
    let color = ink(layer.ink);
    let (w, h) = (2.0 * canvas.columns as f64, 4.0 * canvas.rows as f64);
    let room = Rect { x: 0.0, y: 0.0, width: w - 0.01, height: h - 0.01 };
    let place = |[x, y]: [f64; 2]| {
        let x = spans[0].fraction(x)? * (w - 1.0);
        let y = (1.0 - spans[1].fraction(y)?) * (h - 1.0);
        Some([x.clamp(-1e6, 1e6), y.clamp(-1e6, 1e6)])
    };
    let floor =
        |y: f64| spans[1].fraction(y).map_or(h - 1.0, |f| ((1.0 - f) * (h - 1.0)).clamp(0.0, h - 1.0));
    let polyline = |points: &[[f64; 2]], dash: Dash, canvas: &mut Canvas| {
        let placed: Vec<Option<[f64; 2]>> = points.iter().map(|&point| place(point)).collect();
        for run in placed.split(Option::is_none) {
            let run: Vec<[f64; 2]> = run.iter().flatten().copied().collect();
            for piece in clipped_line(&super::thin::line(&run), &room) {
                piece.windows(2).for_each(|pair| canvas.line(pair[0], pair[1], dash, color));
            }
        }
    };
    match &layer.mark {
        Mark::Line { points, dash, .. } => polyline(points, *dash, canvas),
        Mark::Points { points, .. } | Mark::Weighted { points, .. } => {
            points.iter().filter_map(|&point| place(point)).for_each(|[x, y]| canvas.dot(x, y, color));
        }
        Mark::Arrows(arrows) => {
            arrows.iter().take(5000).for_each(|arrow| polyline(&[arrow.from, arrow.to], Dash::Solid, canvas));
        }
        Mark::Errors(bars) => {
            for bar in bars.iter().take(5000) {
                polyline(&[[bar.x, bar.low], [bar.x, bar.high]], Dash::Solid, canvas);
            }
        }
        Mark::Band(between) => {
            for side in [0, 1] {
                let points: Vec<[f64; 2]> =
                    between.iter().map(|pair| [pair.x, [pair.low, pair.high][side]]).collect();
                polyline(&points, Dash::Dotted, canvas);
            }
        }
        Mark::Bars { edges, heights } => {
            for (pair, &height) in edges.windows(2).zip(heights).take(20_000) {
                let (Some(left), Some(right)) = (spans[0].fraction(pair[0]), spans[0].fraction(pair[1]))
                else {
                    continue;
                };
                let (left, right) = ((left * (w - 1.0)).max(0.0), (right * (w - 1.0)).min(w));
                let (top, foot) = (floor(height), floor(0.0));
                if !height.is_finite() {
                    continue;
                }
                let mut x = left.ceil();
                while x < right.max(left.ceil() + 1.0) {
                    canvas.line([x, top], [x, foot], Dash::Solid, color);
                    x += 1.0;
                }
            }
        }
        Mark::Step { edges, heights } => {
            let stair = edges.windows(2).zip(heights);
            let points: Vec<[f64; 2]> =
                stair.flat_map(|(pair, &height)| [[pair[0], height], [pair[1], height]]).collect();
            polyline(&points, Dash::Solid, canvas);
        }
        Mark::Polygon { points, .. } => {
            let mut closed = points.clone();
            closed.extend(points.first());
            polyline(&closed, Dash::Solid, canvas);
        }
        Mark::Heat(raster) => heat(raster, spans, canvas),
        Mark::Slope { through, slope } => {
            // Two far points of the line, in the units of the axes.
            let along = |t: f64| {
                let [x, y] = *through;
                if spans[0].scale.is_logarithmic() && spans[1].scale.is_logarithmic() {
                    let factor = libm::pow(2.0, t);
                    [x * factor, y * libm::pow(factor, *slope)]
                } else {
                    [x + t * (spans[0].high - spans[0].low), y + slope * t * (spans[0].high - spans[0].low)]
                }
            };
            let points: Vec<[f64; 2]> = (-64..=64).map(|t| along(f64::from(t))).collect();
            polyline(&points, Dash::Dashed, canvas);
        }
        Mark::Level(y) => {
            if let Some(fraction) = spans[1].fraction(*y) {
                let y = (1.0 - fraction) * (h - 1.0);
                canvas.line([0.0, y], [w - 1.0, y], Dash::Dashed, color);
            }
        }
        Mark::Place(x) => {
            if let Some(fraction) = spans[0].fraction(*x) {
                let x = fraction * (w - 1.0);
                canvas.line([x, 0.0], [x, h - 1.0], Dash::Dashed, color);
            }
        }
        Mark::Note { at, text, .. } => {
            if let Some([x, y]) = place(*at).filter(|&at| room.contains(at)) {
                let text = cut(text, 40);
                canvas.write(&text, (x / 2.0) as usize, (y / 4.0) as usize, color);
            }
        }
    }
}

fn heat(raster: &Raster, spans: &[Span; 2], canvas: &mut Canvas) {
    let height = raster.height();
    let ends = raster.ends();
    let inverse = |span: &Span, fraction: f64| {
        let measured = span.low + fraction * (span.high - span.low);
        match span.scale {
            super::Scale::Linear => measured,
            super::Scale::Log10 => libm::pow(10.0, measured),
            super::Scale::Log2 => libm::pow(2.0, measured),
        }
    };
    for row in 0..2 * canvas.rows {
        for column in 0..canvas.columns {
            let x = inverse(&spans[0], (column as f64 + 0.5) / canvas.columns as f64);
            let y = inverse(&spans[1], 1.0 - (row as f64 + 0.5) / (2 * canvas.rows) as f64);
            let at = |axis: usize, value: f64, count: usize| {
                let cell = ((value - raster.low[axis]) / (raster.high[axis] - raster.low[axis])
                    * count as f64)
                    .floor();
                (cell >= 0.0 && cell < count as f64).then_some(cell as usize)
            };
            let (Some(i), Some(j)) = (at(0, x, raster.width), at(1, y, height)) else { continue };
            let color = match raster.fraction(raster.values[j * raster.width + i], ends) {
                Some(fraction) => raster.map.color(fraction),
                None => [128; 3],
            };
            let cell = &mut canvas.cells[row / 2 * canvas.columns + column];
            let mut pair = cell.picture.unwrap_or([color; 2]);
            pair[row % 2] = color;
            cell.picture = Some(pair);
        }
    }
}
