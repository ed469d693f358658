//! PNG: shapes filled and stroked by `tiny-skia`, letters from strokes, the file by the project's own codec.

use super::drawing::{Drawing, Shape, Text};
use super::font::{self, Piece};
use super::svg::marker_lines;
use super::theme::{Paint, Theme};
use super::{Anchor, Dash, Marker};
use luch_image::Image;
use luch_image::codec::{Metadata, encode_png8};
use tiny_skia::{
    Color, FillRule, FilterQuality, LineCap, LineJoin, Path, PathBuilder, Pixmap, PixmapPaint, Stroke,
    StrokeDash, Transform,
};

/// How a figure becomes pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PngOptions {
    /// Light or dark ground.
    pub theme: Theme,
    /// Pixels for each unit of the figure's 720 (0.25 to 8).
    pub scale: f64,
}

impl Default for PngOptions {
    /// Light, two pixels for each unit.
    fn default() -> Self {
        Self { theme: Theme::Light, scale: 2.0 }
    }
}

/// The most pixels a side may have.
const MOST: f64 = 12_000.0;

/// The picture as a file; empty if there is no memory for it.
pub(super) fn encode(drawing: &Drawing, options: PngOptions) -> Vec<u8> {
    let wished = if options.scale.is_finite() { options.scale.clamp(0.25, 8.0) } else { 2.0 };
    let scale = wished.min(MOST / drawing.width.max(drawing.height).max(1.0));
    let size = |units: f64| (units * scale).ceil().clamp(1.0, MOST) as u32;
    let Some(mut pixmap) = Pixmap::new(size(drawing.width), size(drawing.height)) else {
        return Vec::new();
    };
    let mut canvas = Canvas {
        pixmap: &mut pixmap,
        theme: options.theme,
        transform: Transform::from_scale(scale as f32, scale as f32),
    };
    canvas.pixmap.fill(color(Paint::Ground, options.theme, 1.0));
    for shape in &drawing.shapes {
        canvas.draw(shape);
    }
    let (width, height) = (pixmap.width(), pixmap.height());
    // The ground is opaque, so colours are not premultiplied by anything but one.
    let pixels: Vec<[u8; 3]> = pixmap.pixels().iter().map(|p| [p.red(), p.green(), p.blue()]).collect();
    encode_pixels(width as usize, height as usize, &pixels).unwrap_or_default()
}

/// Pixels as a file.
pub(super) fn encode_pixels(width: usize, height: usize, pixels: &[[u8; 3]]) -> Option<Vec<u8>> {
    let (width, height) = (u32::try_from(width).ok()?, u32::try_from(height).ok()?);
    let image = Image::from_pixels(width, height, pixels.to_vec())?;
    encode_png8(&image, &Metadata::default()).ok()
}

fn color(paint: Paint, theme: Theme, opacity: f64) -> Color {
    let [r, g, b] = paint.color(theme);
    let alpha = (opacity.clamp(0.0, 1.0) * 255.0).round() as u8;
    Color::from_rgba8(r, g, b, alpha)
}

struct Canvas<'a> {
    pixmap: &'a mut Pixmap,
    theme: Theme,
    transform: Transform,
}

impl Canvas<'_> {
    fn brush(&self, paint: Paint, opacity: f64) -> tiny_skia::Paint<'static> {
        let mut brush = tiny_skia::Paint::default();
        brush.set_color(color(paint, self.theme, opacity));
        brush.anti_alias = true;
        brush
    }

    fn fill(&mut self, path: Option<Path>, paint: Paint, opacity: f64) {
        if let Some(path) = path {
            let brush = self.brush(paint, opacity);
            self.pixmap.fill_path(&path, &brush, FillRule::Winding, self.transform, None);
        }
    }

    fn stroke(&mut self, path: Option<Path>, paint: Paint, opacity: f64, width: f64, dash: Dash) {
        if let Some(path) = path {
            let brush = self.brush(paint, opacity);
            let dash = match dash {
                Dash::Solid => None,
                Dash::Dashed => StrokeDash::new(vec![6.0, 4.0], 0.0),
                Dash::Dotted => StrokeDash::new(vec![0.1, 4.0], 0.0),
            };
            let line_cap = if width <= 1.0 || dash.is_some() { LineCap::Butt } else { LineCap::Round };
            let line_cap = if dash.as_ref().is_some_and(|_| width > 1.9) { LineCap::Round } else { line_cap };
            let stroke = Stroke {
                width: width as f32,
                line_cap,
                line_join: LineJoin::Round,
                dash,
                ..Stroke::default()
            };
            self.pixmap.stroke_path(&path, &brush, &stroke, self.transform, None);
        }
    }

    fn draw(&mut self, shape: &Shape) {
        match shape {
            Shape::Lines { lines, stroke } => {
                self.stroke(path(lines, false), stroke.paint, stroke.opacity, stroke.width, stroke.dash);
            }
            Shape::Area { outlines, paint, opacity } => self.fill(path(outlines, true), *paint, *opacity),
            Shape::Dots { centers, radius, marker, paint, opacity } => match marker {
                Marker::Disc => {
                    let radii = vec![*radius; centers.len()];
                    self.fill(discs(centers, &radii), *paint, *opacity);
                }
                Marker::Ring | Marker::Cross => {
                    let lines = marker_lines(centers, *radius, *marker);
                    let outline = path(&lines, *marker == Marker::Ring);
                    self.stroke(outline, *paint, *opacity, 1.5, Dash::Solid);
                }
                _ => self.fill(path(&marker_lines(centers, *radius, *marker), true), *paint, *opacity),
            },
            Shape::Discs { centers, radii, paint, opacity } => {
                self.fill(discs(centers, radii), *paint, *opacity);
            }
            Shape::Text(text) => self.text(text),
            Shape::Picture { rect, width, pixels } => {
                let height = pixels.len().checked_div(*width).unwrap_or(0);
                let Some(mut picture) = Pixmap::new(*width as u32, height as u32) else { return };
                for (to, &[r, g, b]) in picture.pixels_mut().iter_mut().zip(pixels) {
                    *to = tiny_skia::ColorU8::from_rgba(r, g, b, 255).premultiply();
                }
                let (sx, sy) = (rect.width / *width as f64, rect.height / height as f64);
                let place = Transform::from_row(sx as f32, 0.0, 0.0, sy as f32, rect.x as f32, rect.y as f32);
                let paint = PixmapPaint { quality: FilterQuality::Nearest, ..PixmapPaint::default() };
                let place = place.post_concat(self.transform);
                self.pixmap.draw_pixmap(0, 0, picture.as_ref(), &paint, place, None);
            }
        }
    }

    fn text(&mut self, text: &Text) {
        let width = font::width(&text.text, text.size, text.is_bold);
        let left = match text.anchor {
            Anchor::Left => text.at[0],
            Anchor::Middle => text.at[0] - width / 2.0,
            Anchor::Right => text.at[0] - width,
        };
        let mut builder = PathBuilder::new();
        for piece in font::strokes(&text.text, [left, text.at[1]], text.size, text.is_bold) {
            match piece {
                Piece::Move([x, y]) => builder.move_to(x as f32, y as f32),
                Piece::Line([x, y]) => builder.line_to(x as f32, y as f32),
                Piece::Cubic([a, b, c]) => builder.cubic_to(
                    a[0] as f32,
                    a[1] as f32,
                    b[0] as f32,
                    b[1] as f32,
                    c[0] as f32,
                    c[1] as f32,
                ),
            }
        }
        let Some(outline) = builder.finish() else { return };
        let pen = |width: f64| Stroke {
            width: width as f32,
            line_cap: LineCap::Round,
            line_join: LineJoin::Round,
            ..Stroke::default()
        };
        let width = font::pen(text.size, text.is_bold);
        if text.has_halo {
            let ground = self.brush(Paint::Panel, 1.0);
            self.pixmap.stroke_path(&outline, &ground, &pen(width + 4.0), self.transform, None);
        }
        let ink = self.brush(text.paint, 1.0);
        self.pixmap.stroke_path(&outline, &ink, &pen(width), self.transform, None);
    }
}

fn path(lines: &[Vec<[f64; 2]>], is_closed: bool) -> Option<Path> {
    let mut builder = PathBuilder::new();
    for line in lines {
        for (at, [x, y]) in line.iter().enumerate() {
            let (x, y) = (*x as f32, *y as f32);
            if at == 0 { builder.move_to(x, y) } else { builder.line_to(x, y) }
        }
        if is_closed && !line.is_empty() {
            builder.close();
        }
    }
    builder.finish()
}

fn discs(centers: &[[f64; 2]], radii: &[f64]) -> Option<Path> {
    let mut builder = PathBuilder::new();
    for ([x, y], radius) in centers.iter().zip(radii) {
        builder.push_circle(*x as f32, *y as f32, (*radius).max(0.05) as f32);
    }
    builder.finish()
}
