//! What stands between a figure and its picture: a list of shapes in pixels, y downward.

use super::theme::Paint;
use super::{Anchor, Dash, Marker};

/// A whole picture.
#[derive(Clone, Debug, Default)]
pub(super) struct Drawing {
    pub(super) width: f64,
    pub(super) height: f64,
    /// For those who cannot see it.
    pub(super) title: String,
    pub(super) description: String,
    pub(super) shapes: Vec<Shape>,
}

/// A rectangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rect {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

impl Rect {
    pub(super) fn right(&self) -> f64 {
        self.x + self.width
    }

    pub(super) fn bottom(&self) -> f64 {
        self.y + self.height
    }

    pub(super) fn contains(&self, [x, y]: [f64; 2]) -> bool {
        x >= self.x - 0.5 && x <= self.right() + 0.5 && y >= self.y - 0.5 && y <= self.bottom() + 0.5
    }
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Stroke {
    pub(super) paint: Paint,
    pub(super) width: f64,
    pub(super) dash: Dash,
    pub(super) opacity: f64,
}

#[derive(Clone, Debug)]
pub(super) enum Shape {
    /// Lines that stand in one path.
    Lines {
        lines: Vec<Vec<[f64; 2]>>,
        stroke: Stroke,
    },
    /// A filled outline.
    Area {
        outlines: Vec<Vec<[f64; 2]>>,
        paint: Paint,
        opacity: f64,
    },
    /// Markers of one kind.
    Dots {
        centers: Vec<[f64; 2]>,
        radius: f64,
        marker: Marker,
        paint: Paint,
        opacity: f64,
    },
    /// Discs of many sizes.
    Discs {
        centers: Vec<[f64; 2]>,
        radii: Vec<f64>,
        paint: Paint,
        opacity: f64,
    },
    Text(Text),
    /// A picture of colours, top row first.
    Picture {
        rect: Rect,
        width: usize,
        pixels: Vec<[u8; 3]>,
    },
}

#[derive(Clone, Debug)]
pub(super) struct Text {
    pub(super) at: [f64; 2],
    pub(super) text: String,
    pub(super) size: f64,
    pub(super) anchor: Anchor,
    pub(super) is_bold: bool,
    pub(super) paint: Paint,
    /// Whether what is behind is pushed away a little.
    pub(super) has_halo: bool,
}

impl Shape {
    /// The same elsewhere.
    pub(super) fn moved(mut self, dx: f64, dy: f64) -> Self {
        let shift = |points: &mut Vec<[f64; 2]>| {
            for point in points {
                *point = [point[0] + dx, point[1] + dy];
            }
        };
        match &mut self {
            Self::Lines { lines, .. } => lines.iter_mut().for_each(shift),
            Self::Area { outlines, .. } => outlines.iter_mut().for_each(shift),
            Self::Dots { centers, .. } | Self::Discs { centers, .. } => shift(centers),
            Self::Text(text) => text.at = [text.at[0] + dx, text.at[1] + dy],
            Self::Picture { rect, .. } => {
                rect.x += dx;
                rect.y += dy;
            }
        }
        self
    }
}

/// The part of a segment inside a rectangle (Liang and Barsky, 1984).
pub(super) fn clipped(a: [f64; 2], b: [f64; 2], rect: &Rect) -> Option<[[f64; 2]; 2]> {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let (mut from, mut to) = (0.0f64, 1.0f64);
    for (step, room) in
        [(-dx, a[0] - rect.x), (dx, rect.right() - a[0]), (-dy, a[1] - rect.y), (dy, rect.bottom() - a[1])]
    {
        if step == 0.0 {
            if room < 0.0 {
                return None;
            }
        } else if step < 0.0 {
            from = from.max(room / step);
        } else {
            to = to.min(room / step);
        }
    }
    (from <= to).then(|| [from, to].map(|t| [a[0] + t * dx, a[1] + t * dy]))
}

/// A line cut to a rectangle: the pieces inside.
pub(super) fn clipped_line(points: &[[f64; 2]], rect: &Rect) -> Vec<Vec<[f64; 2]>> {
    let mut pieces: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut is_open = false;
    for pair in points.windows(2) {
        let Some([a, b]) = clipped(pair[0], pair[1], rect) else {
            is_open = false;
            continue;
        };
        match pieces.last_mut() {
            Some(piece) if is_open && piece.last() == Some(&a) => piece.push(b),
            _ => pieces.push(vec![a, b]),
        }
        is_open = b == pair[1];
    }
    pieces
}
