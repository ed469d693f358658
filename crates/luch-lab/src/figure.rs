//! Figures: plain data, drawn in several ways.
//!
//! A [`Figure`] is axes and layers of numbers. It knows nothing of pixels; the same value becomes an SVG that follows the reader's
//! light or dark theme ([`Figure::to_svg`]), a PNG ([`Figure::to_png`]), lines of text for a terminal
//! ([`Figure::to_terminal`]), and its own numbers as CSV and JSON ([`Figure::to_csv`], [`Figure::to_json`]). A [`Sheet`] is a
//! grid of figures.
//!
//! Numbers may be anything: what is not finite, or not positive on a logarithmic axis, is left out; a million points are thinned.
//!
//! ```
//! use luch_lab::figure::{Axis, Figure, Ink};
//!
//! let measured = (6..=14).map(|k| [f64::from(1 << k), 1.0 / f64::from(1 << k).sqrt()]).collect();
//! let figure = Figure::new("Error falls with the root of N")
//!     .with_x(Axis::log2("samples N"))
//!     .with_y(Axis::log10("error"))
//!     .line("independent", Ink::Blue, measured)
//!     .reference("N^−1/2", [64.0, 0.2], -0.5);
//! assert!(figure.to_svg().starts_with("<svg"));
//! assert!(figure.to_terminal(60, luch_lab::figure::Depth::Letters).lines().count() > 10);
//! ```

mod axis;
mod color_map;
mod drawing;
mod font;
mod layer;
mod layout;
mod marks;
mod png;
mod sheet;
mod svg;
mod table;
mod terminal;
mod theme;
mod thin;

pub use axis::{Axis, Scale};
pub use color_map::ColorMap;
pub use layer::{Anchor, Arrow, Between, Dash, ErrorBar, Layer, Mark, Marker, Raster};
pub use png::PngOptions;
pub use sheet::Sheet;
pub use terminal::Depth;
pub use theme::{Ink, Theme};

use serde::{Deserialize, Serialize};

/// A figure: a title, two axes and layers, drawn in their order.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Figure {
    /// One line above the figure.
    pub title: String,
    /// What is to be seen, below the figure; wrapped where it is long.
    pub caption: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// What is drawn, the first at the back.
    pub layers: Vec<Layer>,
    /// Whether a unit of x is as long as a unit of y: for pictures of the plane.
    pub is_square: bool,
}

impl Figure {
    /// A figure without layers.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), ..Self::default() }
    }

    /// The same with a caption.
    #[must_use]
    pub fn with_caption(mut self, caption: impl Into<String>) -> Self {
        self.caption = caption.into();
        self
    }

    /// The same with another horizontal axis.
    #[must_use]
    pub fn with_x(mut self, axis: Axis) -> Self {
        self.x = axis;
        self
    }

    /// The same with another vertical axis.
    #[must_use]
    pub fn with_y(mut self, axis: Axis) -> Self {
        self.y = axis;
        self
    }

    /// The same with units of the same length on both axes.
    #[must_use]
    pub fn squared(mut self) -> Self {
        self.is_square = true;
        self
    }

    /// A picture of the unit square: both axes from 0 to 1, with equal units.
    pub fn unit_square(title: impl Into<String>) -> Self {
        Self::new(title)
            .with_x(Axis::linear("").with_range(0.0, 1.0))
            .with_y(Axis::linear("").with_range(0.0, 1.0))
            .squared()
    }

    /// The same with one layer more.
    #[must_use]
    pub fn with(mut self, name: impl Into<String>, ink: Ink, mark: Mark) -> Self {
        self.layers.push(Layer { name: name.into(), ink, mark });
        self
    }

    /// The same with a line through points; a point that is not finite interrupts it.
    #[must_use]
    pub fn line(self, name: impl Into<String>, ink: Ink, points: Vec<[f64; 2]>) -> Self {
        self.with(name, ink, Mark::Line { points, dash: Dash::Solid, width: 1.8 })
    }

    /// The same with a dashed line.
    #[must_use]
    pub fn dashed(self, name: impl Into<String>, ink: Ink, points: Vec<[f64; 2]>) -> Self {
        self.with(name, ink, Mark::Line { points, dash: Dash::Dashed, width: 1.4 })
    }

    /// The same with points, `size` pixels across.
    #[must_use]
    pub fn points(self, name: impl Into<String>, ink: Ink, points: Vec<[f64; 2]>, size: f64) -> Self {
        self.with(name, ink, Mark::Points { points, marker: Marker::Disc, size })
    }

    /// The same with a line through points that are marked.
    #[must_use]
    pub fn marked(self, name: impl Into<String>, ink: Ink, marker: Marker, points: Vec<[f64; 2]>) -> Self {
        self.line("", ink, points.clone()).with(name, ink, Mark::Points { points, marker, size: 6.0 })
    }

    /// The same with error bars.
    #[must_use]
    pub fn errors(self, name: impl Into<String>, ink: Ink, bars: Vec<ErrorBar>) -> Self {
        self.with(name, ink, Mark::Errors(bars))
    }

    /// The same with a band between two curves.
    #[must_use]
    pub fn band(self, name: impl Into<String>, ink: Ink, between: Vec<Between>) -> Self {
        self.with(name, ink, Mark::Band(between))
    }

    /// The same with bars from zero, `heights[i]` between `edges[i]` and `edges[i + 1]`.
    #[must_use]
    pub fn bars(self, name: impl Into<String>, ink: Ink, edges: Vec<f64>, heights: Vec<f64>) -> Self {
        self.with(name, ink, Mark::Bars { edges, heights })
    }

    /// The same with a stair, `heights[i]` between `edges[i]` and `edges[i + 1]`.
    #[must_use]
    pub fn step(self, name: impl Into<String>, ink: Ink, edges: Vec<f64>, heights: Vec<f64>) -> Self {
        self.with(name, ink, Mark::Step { edges, heights })
    }

    /// The same with numbers as colours.
    #[must_use]
    pub fn heat(self, name: impl Into<String>, raster: Raster) -> Self {
        self.with(name, Ink::Text, Mark::Heat(raster))
    }

    /// The same with a line of known slope through a point: a power law where both axes are logarithmic.
    #[must_use]
    pub fn reference(self, label: impl Into<String>, through: [f64; 2], slope: f64) -> Self {
        self.with(label, Ink::Muted, Mark::Slope { through, slope })
    }

    /// The same with a horizontal line from side to side, labelled with its name.
    #[must_use]
    pub fn level(self, label: impl Into<String>, y: f64) -> Self {
        self.with(label, Ink::Muted, Mark::Level(y))
    }

    /// The same with a vertical line from bottom to top, labelled with its name.
    #[must_use]
    pub fn place(self, label: impl Into<String>, x: f64) -> Self {
        self.with(label, Ink::Muted, Mark::Place(x))
    }

    /// The same with a text at a point.
    #[must_use]
    pub fn note(self, text: impl Into<String>, at: [f64; 2], anchor: Anchor) -> Self {
        self.with("", Ink::Text, Mark::Note { at, text: text.into(), anchor })
    }

    /// The figure as SVG, `width` of 720 units; it follows `prefers-color-scheme`.
    pub fn to_svg(&self) -> String {
        svg::write(&layout::figure(self), svg::Look::Both)
    }

    /// The figure as SVG in one theme, for viewers that know no themes.
    pub fn to_svg_in(&self, theme: Theme) -> String {
        svg::write(&layout::figure(self), svg::Look::One(theme))
    }

    /// The figure as PNG.
    pub fn to_png(&self, options: PngOptions) -> Vec<u8> {
        png::encode(&layout::figure(self), options)
    }

    /// The figure as lines of text, `columns` wide (20 to 400).
    pub fn to_terminal(&self, columns: usize, depth: Depth) -> String {
        terminal::draw(self, columns, depth)
    }

    /// All its numbers: one row for each, with the layer's number, name and kind.
    pub fn to_csv(&self) -> String {
        table::csv(self)
    }

    /// The figure as data; [`from_json`](Self::from_json) leads back. Numbers that are not finite become `null`.
    pub fn to_json(&self) -> String {
        table::json(self)
    }

    /// A figure from what [`to_json`](Self::to_json) wrote.
    ///
    /// # Errors
    ///
    /// The text is no figure; the error tells line and column.
    pub fn from_json(text: &str) -> Result<Self, serde_json::Error> {
        serde_json::from_str(text)
    }
}

#[cfg(test)]
mod tests;
