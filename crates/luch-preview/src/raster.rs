//! One triangle onto the grid of samples: exact edge functions on fixed-point corners, top-left rule, a depth that is linear
//! over the picture (Pineda, "A parallel algorithm for polygon rasterization", 1988).
//!
//! Corners are rounded to 1/1024 of a sample. All that decides which samples are covered is integer arithmetic on these, so
//! neighbours neither overlap nor leave holes. Places are below 2¹⁹ samples, so corners are below 2²⁹, differences below 2³⁰
//! and edge functions below 2⁶¹.

use crate::view::{Rays, View};
use glam::{DVec2, DVec3};
use std::sync::atomic::{AtomicU64, Ordering};

/// Steps of the fixed-point grid in a sample, as a power of two.
const FINE_BITS: u32 = 10;
const FINE: i64 = 1 << FINE_BITS;
/// The middle of a sample.
const HALF: i64 = FINE / 2;

/// Farthest place from the middle of the picture that fits: 2¹⁹ less half of the largest picture.
pub(crate) const REACH: f64 = ((1 << 19) - (1 << 16)) as f64;

/// A place of the picture on the fixed-point grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Fine {
    pub(crate) x: i32,
    pub(crate) y: i32,
}

impl Fine {
    /// Of places within [`REACH`] of the middle.
    #[inline]
    pub(crate) fn new(place: DVec2) -> Self {
        // Cutting off a positive number is rounding down, in one instruction on every machine.
        const LIFT: f64 = (1u64 << 31) as f64;
        let fixed = |v: f64| ((v * FINE as f64 + (LIFT + 0.5)) as i64 - (1 << 31)) as i32;
        Self { x: fixed(place.x), y: fixed(place.y) }
    }
}

/// The depth of a plane over the picture, in the view's linear measure.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slope {
    at_middle: f64,
    per_column: f64,
    per_row: f64,
    least: f64,
    most: f64,
}

impl Slope {
    /// Of the plane through three points of view space, kept between the depths of `corners`, which are all in front.
    ///
    /// The plane is that of the triangle as it was before it was cut and rounded. One that is seen edge-on has no slope;
    /// then the bounds decide.
    pub(crate) fn new(view: &View, [a, b, c]: [DVec3; 3], corners: &[DVec3]) -> Self {
        let normal = (b - a).cross(c - a);
        let height = normal.dot(a);
        let [at_middle, per_column, per_row] = match view.rays {
            Rays::Central => [normal.z / height, normal.x / height, normal.y / height],
            Rays::Parallel => [height / normal.z, -normal.x / normal.z, -normal.y / normal.z],
        };
        let (mut least, mut most) = (f64::INFINITY, 0.0f64);
        for corner in corners {
            let linear = view.linear(corner.z);
            least = least.min(linear);
            most = most.max(linear);
        }
        let storable = |v: f64| v.clamp(f64::from(f32::MIN_POSITIVE), f64::from(f32::MAX));
        Self { at_middle, per_column, per_row, least: storable(least), most: storable(most) }
    }

    /// The value at a place, from the middle of the picture.
    #[inline]
    pub(crate) fn at(&self, column: f64, row: f64) -> f64 {
        self.bounded(self.at_middle + self.per_row * row + self.per_column * column)
    }

    /// Comparisons in this form turn what is no number into the lower bound.
    #[inline]
    fn bounded(&self, value: f64) -> f64 {
        let value = if value > self.least { value } else { self.least };
        if value < self.most { value } else { self.most }
    }
}

/// What each sample shows: nearness above, number below, so that the greater word is nearer, or equally near with the lower
/// number. The greatest wins whatever the order, so threads need not agree on one.
#[derive(Debug)]
pub(crate) struct Grid<'a> {
    view: &'a View,
    cells: &'a [AtomicU64],
}

/// The word of a sample that shows nothing.
pub(crate) const EMPTY: u64 = 0;

/// The number in a word.
#[inline]
pub(crate) fn number_of(word: u64) -> Option<u32> {
    (word != EMPTY).then_some(!(word as u32))
}

/// The linear depth in a word.
pub(crate) fn linear_of(view: &View, word: u64) -> f64 {
    let bits = (word >> 32) as u32;
    let bits = if view.rays == Rays::Central { bits } else { !bits };
    f64::from(f32::from_bits(bits))
}

impl<'a> Grid<'a> {
    /// One cell for each sample of the view.
    pub(crate) fn new(view: &'a View, cells: &'a [AtomicU64]) -> Self {
        Self { view, cells }
    }

    /// Shows `number` in a sample unless something nearer is there.
    #[inline]
    pub(crate) fn show(&self, cell: usize, linear: f64, number: u32) {
        let bits = (linear as f32).to_bits();
        let nearness = match self.view.rays {
            Rays::Central => bits,
            Rays::Parallel => !bits,
        };
        let word = u64::from(nearness) << 32 | u64::from(!number);
        let cell = &self.cells[cell];
        if cell.load(Ordering::Relaxed) < word {
            cell.fetch_max(word, Ordering::Relaxed);
        }
    }

    /// Fills the samples whose middles lie in a triangle, with corners in any order, where `is_there(x, y)` holds.
    pub(crate) fn fill(
        &self,
        [a, b, c]: [Fine; 3],
        number: u32,
        slope: impl Fn() -> Slope,
        is_there: impl Fn(u32, u32) -> bool,
    ) {
        let columns = covered([a.x, b.x, c.x], self.view.size.width);
        let rows = covered([a.y, b.y, c.y], self.view.size.height);
        let (Some([left, right]), Some([top, bottom])) = (columns, rows) else { return };
        let area = doubled_area([a, b, c]);
        if area == 0 {
            return;
        }
        let [b, c] = if area > 0 { [b, c] } else { [c, b] };
        let mut edges = [[a, b], [b, c], [c, a]].map(|ends| EdgeFunction::new(ends, left, top));
        let mut known = None;
        for row in top..=bottom {
            if let Some([first, last]) = span(&edges, right - left) {
                let slope = known.get_or_insert_with(&slope);
                let from_middle = row as f64 + 0.5 - self.view.middle.y;
                let start = row as usize * self.view.size.width as usize;
                for x in left + first..=left + last {
                    if is_there(x as u32, row as u32) {
                        let linear = slope.at(x as f64 + 0.5 - self.view.middle.x, from_middle);
                        self.show(start + x as usize, linear, number);
                    }
                }
            }
            edges.iter_mut().for_each(|edge| edge.value += edge.per_row);
        }
    }
}

/// Twice the area on the grid; positive if the corners run clockwise as seen in the picture.
#[inline]
pub(crate) fn doubled_area([a, b, c]: [Fine; 3]) -> i64 {
    let difference = |to: i32, from: i32| i64::from(to) - i64::from(from);
    difference(b.x, a.x) * difference(c.y, a.y) - difference(b.y, a.y) * difference(c.x, a.x)
}

/// First and last of `count` samples whose middles lie between the least and the greatest of three places.
#[inline]
fn covered([a, b, c]: [i32; 3], count: u32) -> Option<[i64; 2]> {
    let first = (i64::from(a.min(b).min(c)) - HALF + FINE - 1) >> FINE_BITS;
    let last = (i64::from(a.max(b).max(c)) - HALF) >> FINE_BITS;
    let (first, last) = (first.max(0), last.min(i64::from(count) - 1));
    (first <= last).then_some([first, last])
}

/// Not negative inside of a directed edge, evaluated at the middle of a sample.
#[derive(Clone, Copy)]
struct EdgeFunction {
    /// At the first sample of the current row.
    value: i64,
    per_column: i64,
    per_row: i64,
}

impl EdgeFunction {
    #[inline]
    fn new([from, to]: [Fine; 2], column: i64, row: i64) -> Self {
        let (dx, dy) = (i64::from(to.x) - i64::from(from.x), i64::from(to.y) - i64::from(from.y));
        let (x, y) = (column * FINE + HALF - i64::from(from.x), row * FINE + HALF - i64::from(from.y));
        // Samples exactly on an edge belong to the triangle to the right of it or below it.
        let is_top_left = dy < 0 || (dy == 0 && dx > 0);
        Self { value: dx * y - dy * x - i64::from(!is_top_left), per_column: -dy * FINE, per_row: dx * FINE }
    }
}

/// Up to this many samples beyond the first they are tried one by one; dividing takes longer.
const FEW: i64 = 8;

/// First and last column, up to `width`, that is inside all edges.
#[inline]
fn span(edges: &[EdgeFunction; 3], width: i64) -> Option<[i64; 2]> {
    if width <= FEW {
        let is_inside = |x: i64| edges.iter().all(|edge| edge.value + edge.per_column * x >= 0);
        let first = (0..=width).find(|&x| is_inside(x))?;
        let beyond = (first + 1..=width).find(|&x| !is_inside(x)).unwrap_or(width + 1);
        return Some([first, beyond - 1]);
    }
    let (mut first, mut last) = (0, width);
    for edge in edges {
        if edge.per_column > 0 {
            first = first.max(-edge.value.div_euclid(edge.per_column));
        } else if edge.per_column < 0 {
            last = last.min(edge.value.div_euclid(-edge.per_column));
        } else if edge.value < 0 {
            return None;
        }
    }
    (first <= last).then_some([first, last])
}

#[cfg(test)]
mod tests;
