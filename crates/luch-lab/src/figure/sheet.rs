//! Figures side by side.

use super::drawing::Drawing;
use super::layout::{sized, text, wrapped};
use super::{Anchor, Depth, Figure, Ink, PngOptions, Theme, png, svg, table};
use serde::{Deserialize, Serialize};

/// A grid of figures under one title.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sheet {
    /// One line above all.
    pub title: String,
    /// What is to be seen, below all.
    pub caption: String,
    /// How many stand side by side (1 to 12).
    pub columns: usize,
    /// The figures, row by row; at most 400 are drawn.
    pub figures: Vec<Figure>,
}

impl Sheet {
    /// A sheet of figures.
    pub fn new(title: impl Into<String>, columns: usize, figures: Vec<Figure>) -> Self {
        Self { title: title.into(), caption: String::new(), columns, figures }
    }

    /// The same with a caption.
    #[must_use]
    pub fn with_caption(mut self, caption: impl Into<String>) -> Self {
        self.caption = caption.into();
        self
    }

    fn drawing(&self) -> Drawing {
        const MARGIN: f64 = 22.0;
        let columns = self.columns.clamp(1, 12).min(self.figures.len().max(1));
        let cell = if columns == 1 { 720.0 } else { 430.0 };
        let width = cell * columns as f64;
        let mut whole = Drawing {
            width,
            title: self.title.clone(),
            description: self.caption.clone(),
            ..Drawing::default()
        };
        let mut y = 14.0;
        for line in wrapped(&self.title, width - 2.0 * MARGIN, 20.0, true, 3) {
            y += 25.0;
            whole.shapes.push(text([MARGIN, y], line, 20.0, Anchor::Left, true, Ink::Text));
        }
        for row in self.figures.chunks(columns).take(400usize.div_ceil(columns)) {
            let mut height = 0.0f64;
            for (column, figure) in row.iter().enumerate() {
                let part = sized(figure, cell);
                height = height.max(part.height);
                let dx = cell * column as f64;
                whole.shapes.extend(part.shapes.into_iter().map(|shape| shape.moved(dx, y)));
            }
            y += height;
        }
        for line in wrapped(&self.caption, width - 2.0 * MARGIN, 13.0, false, 12) {
            y += 18.5;
            whole.shapes.push(text([MARGIN, y], line, 13.0, Anchor::Left, false, Ink::Text));
        }
        whole.height = (y + 18.0).ceil();
        whole
    }

    /// The sheet as SVG; it follows `prefers-color-scheme`.
    pub fn to_svg(&self) -> String {
        svg::write(&self.drawing(), svg::Look::Both)
    }

    /// The sheet as SVG in one theme.
    pub fn to_svg_in(&self, theme: Theme) -> String {
        svg::write(&self.drawing(), svg::Look::One(theme))
    }

    /// The sheet as PNG.
    pub fn to_png(&self, options: PngOptions) -> Vec<u8> {
        png::encode(&self.drawing(), options)
    }

    /// The figures one below the other as lines of text, `columns` wide.
    pub fn to_terminal(&self, columns: usize, depth: Depth) -> String {
        let mut lines = format!("{}\n\n", self.title);
        for figure in &self.figures {
            lines.push_str(&figure.to_terminal(columns, depth));
            lines.push('\n');
        }
        lines
    }

    /// All numbers: the rows of each figure, with its title in front.
    pub fn to_csv(&self) -> String {
        table::csv_of_sheet(self)
    }

    /// The sheet as data.
    pub fn to_json(&self) -> String {
        table::json(self)
    }
}
