//! Kinds of pixels.

use super::reference::Reference;
use serde::Serialize;

/// A kind of pixels; a pixel may be of several.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum PixelClass {
    /// Every pixel.
    All,
    /// The half where the reference changes least from pixel to pixel, as a part of its brightness.
    Flat,
    /// The tenth where it changes most.
    Edge,
    /// The darkest tenth.
    Dark,
    /// The brightest tenth.
    Bright,
    /// The half of least variance.
    Quiet,
    /// The tenth of greatest variance: caustics, light that few paths find.
    Noisy,
}

impl PixelClass {
    /// Every class.
    pub const ALL: [Self; 7] =
        [Self::All, Self::Flat, Self::Edge, Self::Dark, Self::Bright, Self::Quiet, Self::Noisy];

    /// Its name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::All => "all",
            Self::Flat => "flat",
            Self::Edge => "edge",
            Self::Dark => "dark",
            Self::Bright => "bright",
            Self::Quiet => "quiet",
            Self::Noisy => "noisy",
        }
    }

    /// The places of its pixels, in order. A class that ends amid equal pixels has none of these: a picture of one colour has no edges.
    pub(super) fn members(self, traits: &Traits) -> Vec<usize> {
        let half = |values: &[f64]| least(values, values.len() / 2);
        let tenth = |values: &[f64]| values.len().div_ceil(10);
        let negative = |values: &[f64]| values.iter().map(|v| -v).collect::<Vec<f64>>();
        match self {
            Self::All => (0..traits.gradient.len()).collect(),
            Self::Flat => half(&traits.gradient),
            Self::Edge => least(&negative(&traits.gradient), tenth(&traits.gradient)),
            Self::Dark => least(&traits.luminance, tenth(&traits.luminance)),
            Self::Bright => least(&negative(&traits.luminance), tenth(&traits.luminance)),
            Self::Quiet => half(&traits.variance),
            Self::Noisy => least(&negative(&traits.variance), tenth(&traits.variance)),
        }
    }
}

/// Places of the `count` least values, without those that are as great as the first one left out.
fn least(values: &[f64], count: usize) -> Vec<usize> {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let Some(&bound) = sorted.get(count) else { return (0..values.len()).collect() };
    (0..values.len()).filter(|&at| values[at] < bound).collect()
}

/// What pixels are told apart by.
pub(super) struct Traits {
    /// Largest change of the reference to a neighbour, as a part of its brightness.
    pub(super) gradient: Vec<f64>,
    /// Of the reference.
    pub(super) luminance: Vec<f64>,
    /// Variance of the estimate, by renders that are not judged.
    pub(super) variance: Vec<f64>,
}

impl Traits {
    pub(super) fn new(reference: &Reference, variance: Vec<f64>) -> Self {
        let (width, height) = (reference.picture.width() as usize, reference.picture.height() as usize);
        let luminance: Vec<f64> =
            reference.values.iter().map(|[r, g, b]| 0.212_639 * r + 0.715_169 * g + 0.072_192 * b).collect();
        // Below a hundredth of the mean all is black.
        let black = 0.01 * reference.mean.abs();
        let gradient = (0..width * height)
            .map(|at| {
                let (x, y) = (at % width, at / width);
                let near = [
                    (x > 0).then(|| at - 1),
                    (x + 1 < width).then_some(at + 1),
                    (y > 0).then(|| at - width),
                    (y + 1 < height).then_some(at + width),
                ];
                let change = |other: usize| {
                    let brightness = luminance[at].abs().max(luminance[other].abs()) + black;
                    (luminance[at] - luminance[other]).abs() / brightness.max(f64::MIN_POSITIVE)
                };
                near.into_iter().flatten().map(change).fold(0.0, f64::max)
            })
            .collect();
        Self { gradient, luminance, variance }
    }
}
