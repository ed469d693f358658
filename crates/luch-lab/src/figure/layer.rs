//! What a figure is made of.

use super::{ColorMap, Ink};
use serde::{Deserialize, Deserializer, Serialize};

/// A number of a list that may be written as `null`: JSON has no name for what is not finite.
fn number<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Ok(Option::<f64>::deserialize(from)?.unwrap_or(f64::NAN))
}

fn numbers<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    let list = Vec::<Option<f64>>::deserialize(from)?;
    Ok(list.into_iter().map(|value| value.unwrap_or(f64::NAN)).collect())
}

fn pair<'de, D: Deserializer<'de>>(from: D) -> Result<[f64; 2], D::Error> {
    Ok(<[Option<f64>; 2]>::deserialize(from)?.map(|value| value.unwrap_or(f64::NAN)))
}

fn pairs<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<[f64; 2]>, D::Error> {
    let list = Vec::<[Option<f64>; 2]>::deserialize(from)?;
    Ok(list.into_iter().map(|pair| pair.map(|value| value.unwrap_or(f64::NAN))).collect())
}

/// One layer of a figure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Layer {
    /// Its name in the legend, or the label of a reference line; nothing is said about a layer without name.
    pub name: String,
    /// Its colour.
    pub ink: Ink,
    /// What is drawn.
    pub mark: Mark,
}

/// What a layer draws.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Mark {
    /// A line through points.
    Line {
        /// The points [x, y] in order; one that is not finite interrupts the line.
        #[serde(deserialize_with = "pairs")]
        points: Vec<[f64; 2]>,
        /// Solid, dashed or dotted.
        dash: Dash,
        /// In pixels.
        #[serde(deserialize_with = "number")]
        width: f64,
    },
    /// Points.
    Points {
        /// The points [x, y].
        #[serde(deserialize_with = "pairs")]
        points: Vec<[f64; 2]>,
        /// Their form.
        marker: Marker,
        /// Pixels across.
        #[serde(deserialize_with = "number")]
        size: f64,
    },
    /// Discs whose area is their weight.
    Weighted {
        /// The centres [x, y].
        #[serde(deserialize_with = "pairs")]
        points: Vec<[f64; 2]>,
        /// One for each centre; negative ones count by their size.
        #[serde(deserialize_with = "numbers")]
        weights: Vec<f64>,
        /// Pixels across for weight 1.
        #[serde(deserialize_with = "number")]
        size: f64,
    },
    /// Arrows.
    Arrows(Vec<Arrow>),
    /// Error bars.
    Errors(Vec<ErrorBar>),
    /// The room between two curves.
    Band(Vec<Between>),
    /// Bars from zero: a histogram.
    Bars {
        /// Places between the bars, one more than bars.
        #[serde(deserialize_with = "numbers")]
        edges: Vec<f64>,
        /// Heights of the bars.
        #[serde(deserialize_with = "numbers")]
        heights: Vec<f64>,
    },
    /// A stair: constant between the edges.
    Step {
        /// Places between the steps, one more than steps.
        #[serde(deserialize_with = "numbers")]
        edges: Vec<f64>,
        /// Heights of the steps.
        #[serde(deserialize_with = "numbers")]
        heights: Vec<f64>,
    },
    /// A closed outline, filled lightly.
    Polygon {
        /// The corners [x, y].
        #[serde(deserialize_with = "pairs")]
        points: Vec<[f64; 2]>,
        /// How much it hides, 0 to 1.
        #[serde(deserialize_with = "number")]
        opacity: f64,
    },
    /// Numbers over a rectangle as colours.
    Heat(Raster),
    /// A line of known slope; where both axes are logarithmic, of known exponent.
    Slope {
        /// A point of the line.
        #[serde(deserialize_with = "pair")]
        through: [f64; 2],
        /// The slope or exponent.
        #[serde(deserialize_with = "number")]
        slope: f64,
    },
    /// A horizontal line from side to side at this y.
    Level(#[serde(deserialize_with = "number")] f64),
    /// A vertical line from bottom to top at this x.
    Place(#[serde(deserialize_with = "number")] f64),
    /// A text at a point.
    Note {
        /// The point.
        #[serde(deserialize_with = "pair")]
        at: [f64; 2],
        /// The text.
        text: String,
        /// Which side of the text is at the point.
        anchor: Anchor,
    },
}

/// How a line is interrupted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Dash {
    /// Not at all.
    #[default]
    Solid,
    /// Long strokes.
    Dashed,
    /// Dots.
    Dotted,
}

/// The form of a point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Marker {
    /// A filled disc.
    #[default]
    Disc,
    /// A ring.
    Ring,
    /// A filled square.
    Square,
    /// A filled triangle.
    Triangle,
    /// A filled square on its corner.
    Diamond,
    /// Two crossed strokes.
    Cross,
}

impl Marker {
    /// All forms, to tell series apart without colour.
    pub const ALL: [Self; 6] =
        [Self::Disc, Self::Square, Self::Triangle, Self::Diamond, Self::Ring, Self::Cross];

    /// A form for each number; they repeat after six.
    pub const fn of(index: usize) -> Self {
        Self::ALL[index % Self::ALL.len()]
    }
}

/// Which side of a text is at its point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Anchor {
    /// The left end.
    #[default]
    Left,
    /// The middle.
    Middle,
    /// The right end.
    Right,
}

/// An arrow, in the units of the axes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Arrow {
    /// Its beginning.
    #[serde(deserialize_with = "pair")]
    pub from: [f64; 2],
    /// Its point.
    #[serde(deserialize_with = "pair")]
    pub to: [f64; 2],
}

/// A value with its uncertainty.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorBar {
    /// Where.
    #[serde(deserialize_with = "number")]
    pub x: f64,
    /// The value.
    #[serde(deserialize_with = "number")]
    pub y: f64,
    /// Lower end of the bar.
    #[serde(deserialize_with = "number")]
    pub low: f64,
    /// Upper end of the bar.
    #[serde(deserialize_with = "number")]
    pub high: f64,
}

/// Two values at one place.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Between {
    /// Where.
    #[serde(deserialize_with = "number")]
    pub x: f64,
    /// The lower value.
    #[serde(deserialize_with = "number")]
    pub low: f64,
    /// The upper value.
    #[serde(deserialize_with = "number")]
    pub high: f64,
}

/// Numbers on a grid over a rectangle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Raster {
    /// Numbers in a row.
    pub width: usize,
    /// The numbers, lowest row first; a last row that is not full is left out.
    #[serde(deserialize_with = "numbers")]
    pub values: Vec<f64>,
    /// The corners of least and of greatest coordinates.
    #[serde(deserialize_with = "pair")]
    pub low: [f64; 2],
    /// See `low`.
    #[serde(deserialize_with = "pair")]
    pub high: [f64; 2],
    /// From numbers to colours.
    pub map: ColorMap,
    /// The numbers at the ends of the colours; the least and the greatest if not given.
    pub range: Option<[f64; 2]>,
    /// Whether colours go with logarithms.
    pub is_logarithmic: bool,
    /// Whether a bar beside the figure explains the colours.
    pub has_bar: bool,
}

impl Raster {
    /// The most numbers a raster draws; what goes beyond is left out.
    pub const MOST: usize = 1 << 24;

    /// Numbers over the unit square, with a bar.
    pub fn unit_square(width: usize, values: Vec<f64>) -> Self {
        Self {
            width,
            values,
            low: [0.0; 2],
            high: [1.0; 2],
            map: ColorMap::default(),
            range: None,
            is_logarithmic: false,
            has_bar: true,
        }
    }

    /// The values of a function at the middles of `size` × `size` cells of the unit square.
    pub fn of_function(size: usize, mut function: impl FnMut(f64, f64) -> f64) -> Self {
        let middle = |i: usize| (i as f64 + 0.5) / size as f64;
        let values = (0..size).flat_map(|y| (0..size).map(move |x| (x, y)));
        Self::unit_square(size, values.map(|(x, y)| function(middle(x), middle(y))).collect())
    }

    /// Full rows.
    pub fn height(&self) -> usize {
        self.values.len().min(Self::MOST).checked_div(self.width).unwrap_or(0)
    }

    /// The numbers at the ends of the colours.
    pub fn ends(&self) -> [f64; 2] {
        let usable = |value: &f64| value.is_finite() && (!self.is_logarithmic || *value > 0.0);
        if let Some([low, high]) = self.range
            && usable(&low)
            && usable(&high)
            && low < high
        {
            return [low, high];
        }
        let found = self.values.iter().copied().filter(usable);
        let [low, high] = found
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)]);
        if low < high {
            [low, high]
        } else if low == high {
            // One number alone gets the middle of the colours.
            if self.is_logarithmic { [low / 2.0, low * 2.0] } else { [low - 0.5, low + 0.5] }
        } else if self.is_logarithmic {
            [1.0, 10.0]
        } else {
            [0.0, 1.0]
        }
    }

    /// Where a number stands between the ends, 0 to 1; `None` if it has no colour.
    pub fn fraction(&self, value: f64, ends: [f64; 2]) -> Option<f64> {
        if !value.is_finite() || (self.is_logarithmic && value <= 0.0) {
            return None;
        }
        let of = |value: f64| if self.is_logarithmic { libm::log10(value) } else { value };
        let [low, high] = ends.map(of);
        let fraction = (of(value) / 2.0 - low / 2.0) / (high / 2.0 - low / 2.0);
        fraction.is_finite().then(|| fraction.clamp(0.0, 1.0))
    }
}
