//! The film: exact sums of samples, and what can be read from them.
//!
//! A pixel keeps, for each of its two streams and each channel, the sum of its samples in fixed point. Addition of integers is
//! associative, so a film depends only on which samples it holds: not on threads, tiles, interruptions or machines. The pixel's
//! value is the mean of the two streams' means; half their difference, squared, is an unbiased estimate of its variance, because
//! the streams are independent randomisations (Owen 1997; Cranley and Patterson 1976 for the idea of replicates).

use crate::exact::{Fate, Fixed96, Step};
use crate::ranges::Ranges;
use bytemuck::{Pod, Zeroable};
use luch_image::{Image, Rgb};
use std::ops::Range;

/// Pixels along a side of a tile.
pub const TILE: u32 = 32;

/// Pixels along a side of a bundle: the block of pixels whose samples of one index help each other.
pub const BUNDLE: u32 = 4;

/// The exponent of the step that films have unless told otherwise.
const USUAL_EXPONENT: i8 = -36;

/// The sums of one pixel: `[stream][channel]`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct PixelSums([[Fixed96; 3]; 2]);

/// A square of pixels that share the set of samples they hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tile {
    /// Column of the first pixel.
    pub(crate) x: u32,
    /// Row of the first pixel.
    pub(crate) y: u32,
    /// Pixels in a row.
    pub(crate) width: u32,
    /// Rows.
    pub(crate) height: u32,
    pub(crate) done: Ranges,
    pub(crate) sums: Vec<PixelSums>,
    pub(crate) losses: Losses,
}

/// Samples that could not be added as they were.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Losses {
    /// Channels of samples cut at the largest magnitude the film can hold.
    pub saturated: u64,
    /// Channels of samples that were infinite or not a number, counted as zero.
    pub invalid: u64,
}

impl Losses {
    /// True if nothing was lost.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }
}

impl Tile {
    /// Column and row of the pixels, in the order of their sums.
    pub(crate) fn pixels(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        (0..self.height).flat_map(move |y| (0..self.width).map(move |x| [self.x + x, self.y + y]))
    }

    /// Adds sample `index` of pixel `pixel`, counted within the tile; says nothing of `done`.
    pub(crate) fn add(&mut self, step: Step, pixel: usize, index: u64, sample: Rgb) {
        let stream = &mut self.sums[pixel].0[(index & 1) as usize];
        for (sum, value) in stream.iter_mut().zip(sample.to_array()) {
            let quantized = step.quantize(value);
            match quantized.fate {
                Fate::Kept => {}
                Fate::Saturated => self.losses.saturated += 1,
                Fate::Invalid => self.losses.invalid += 1,
            }
            sum.add(quantized.units);
        }
    }
}

/// Sums of samples for every pixel of a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Film {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) step: Step,
    pub(crate) tiles: Vec<Tile>,
}

/// One pixel, read from its sums.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PixelEstimate {
    /// The mean; black if there is no sample.
    pub mean: [f64; 3],
    /// Estimated variance of the mean from the two streams; `None` unless both have samples.
    pub variance: Option<[f64; 3]>,
}

impl Film {
    /// An empty film of `width` × `height` pixels.
    ///
    /// # Panics
    /// If a side is 0 or more than 65536.
    pub fn new(width: u32, height: u32) -> Self {
        Self::with_step(width, height, Step::new(USUAL_EXPONENT).expect("the usual exponent is in range"))
    }

    pub(crate) fn with_step(width: u32, height: u32, step: Step) -> Self {
        let sides = 1..=65536;
        assert!(sides.contains(&width) && sides.contains(&height), "a film of {width}×{height} pixels");
        let tile = |x: u32, y: u32| {
            let (w, h) = (TILE.min(width - x), TILE.min(height - y));
            let sums = vec![PixelSums::default(); (w * h) as usize];
            Tile { x, y, width: w, height: h, done: Ranges::default(), sums, losses: Losses::default() }
        };
        let step_by = TILE as usize;
        let tiles = (0..height)
            .step_by(step_by)
            .flat_map(|y| (0..width).step_by(step_by).map(move |x| tile(x, y)))
            .collect();
        Self { width, height, step, tiles }
    }

    /// Pixels in a row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The unit in which samples are summed, a power of two.
    pub fn step(&self) -> f64 {
        self.step.unit()
    }

    /// The sets of samples that tiles hold: every distinct one, with the number of its tiles.
    pub fn coverage(&self) -> Vec<Coverage> {
        let mut found: Vec<Coverage> = Vec::new();
        for tile in &self.tiles {
            match found.iter_mut().find(|c| c.samples == tile.done) {
                Some(coverage) => coverage.tiles += 1,
                None => found.push(Coverage { samples: tile.done.clone(), tiles: 1 }),
            }
        }
        found
    }

    /// Samples of the whole film.
    pub fn total_samples(&self) -> u64 {
        self.tiles.iter().map(|t| t.done.count() * t.sums.len() as u64).sum()
    }

    /// Samples of the whole film whose indices are in `range`.
    pub fn samples_within(&self, range: &Range<u64>) -> u64 {
        self.tiles.iter().map(|t| t.done.count_within(range) * t.sums.len() as u64).sum()
    }

    /// Mean number of samples of a pixel.
    pub fn mean_samples(&self) -> f64 {
        self.total_samples() as f64 / (f64::from(self.width) * f64::from(self.height))
    }

    /// Fewest samples that any pixel has.
    pub fn min_samples(&self) -> u64 {
        self.tiles.iter().map(|t| t.done.count()).min().unwrap_or(0)
    }

    /// Whether every pixel holds every sample of `range`.
    pub fn holds(&self, range: &Range<u64>) -> bool {
        self.tiles.iter().all(|t| t.done.first_missing(range, 1).is_none())
    }

    /// What could not be added as it was.
    pub fn losses(&self) -> Losses {
        self.tiles.iter().fold(Losses::default(), |sum, t| Losses {
            saturated: sum.saturated + t.losses.saturated,
            invalid: sum.invalid + t.losses.invalid,
        })
    }

    /// Bytes that the film takes.
    pub fn memory(&self) -> usize {
        let tile = |t: &Tile| size_of::<Tile>() + t.sums.len() * size_of::<PixelSums>();
        self.tiles.iter().map(tile).sum()
    }

    /// The picture: the mean of every pixel.
    pub fn to_image(&self) -> Image<Rgb> {
        self.read(|estimate, _| Rgb::from(estimate.mean.map(|v| v as f32)))
    }

    /// The estimated standard error of every pixel; zero where a stream has no samples.
    pub fn standard_error(&self) -> Image<Rgb> {
        self.read(|estimate, _| Rgb::from(estimate.variance.unwrap_or_default().map(|v| v.sqrt() as f32)))
    }

    /// The number of samples of every pixel.
    pub fn sample_counts(&self) -> Image<f32> {
        self.read(|_, count| count as f32)
    }

    /// Every pixel's estimate and number of samples, turned into something.
    pub fn read<P: Clone + Default>(&self, mut f: impl FnMut(PixelEstimate, u64) -> P) -> Image<P> {
        let mut image = Image::filled(self.width, self.height, P::default());
        for tile in &self.tiles {
            let counts = tile.done.stream_counts();
            for (sums, [x, y]) in tile.sums.iter().zip(tile.pixels()) {
                let pixel = f(sums.estimate(counts, self.step), counts[0] + counts[1]);
                image.pixels_mut()[y as usize * self.width as usize + x as usize] = pixel;
            }
        }
        image
    }

    /// The mean of all pixels, and its standard error by the twin streams; `None` unless all have samples of both.
    ///
    /// Pixels of one bundle share part of their noise, so the streams are compared bundle by bundle.
    pub fn mean(&self) -> Option<MeanEstimate> {
        let (mut mean, mut variance, mut pixels) = ([0.0; 3], [0.0; 3], 0u64);
        for tile in &self.tiles {
            let counts = tile.done.stream_counts();
            if counts.contains(&0) {
                return None;
            }
            let across = tile.width.div_ceil(BUNDLE);
            let mut differences = vec![[0.0; 3]; (across * tile.height.div_ceil(BUNDLE)) as usize];
            for (i, sums) in (0..).zip(&tile.sums) {
                let [a, b] = [0, 1].map(|stream| sums.stream_mean(stream, counts[stream], self.step));
                let bundle = i / tile.width / BUNDLE * across + i % tile.width / BUNDLE;
                for channel in 0..3 {
                    mean[channel] += (a[channel] + b[channel]) / 2.0;
                    differences[bundle as usize][channel] += (a[channel] - b[channel]) / 2.0;
                }
                pixels += 1;
            }
            for difference in differences {
                (0..3).for_each(|channel| variance[channel] += difference[channel] * difference[channel]);
            }
        }
        let pixels = pixels as f64;
        Some(MeanEstimate {
            mean: mean.map(|sum| sum / pixels),
            standard_error: variance.map(|sum: f64| sum.sqrt() / pixels),
        })
    }

    /// How far the picture is from its limit, by the twin streams.
    pub fn error(&self) -> Option<ErrorEstimate> {
        let (mut variance, mut mean, mut pixels) = (0.0, 0.0, 0u64);
        let luminance = |[r, g, b]: [f64; 3]| 0.212_639 * r + 0.715_169 * g + 0.072_192 * b;
        for tile in &self.tiles {
            let counts = tile.done.stream_counts();
            if counts.contains(&0) {
                return None;
            }
            // Tile by tile, in a fixed order: the same bits however the film came about.
            for sums in &tile.sums {
                let [a, b] =
                    [0, 1].map(|stream| luminance(sums.stream_mean(stream, counts[stream], self.step)));
                variance += (a - b) * (a - b) / 4.0;
                mean += (a + b) / 2.0;
                pixels += 1;
            }
        }
        let (variance, mean) = (variance / pixels as f64, mean / pixels as f64);
        let relative = if mean > 0.0 {
            variance.sqrt() / mean
        } else if variance == 0.0 {
            0.0
        } else {
            f64::INFINITY
        };
        Some(ErrorEstimate { rmse: variance.sqrt(), relative })
    }
}

/// The mean of a picture and how sure it is, by channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeanEstimate {
    /// Mean of all pixels.
    pub mean: [f64; 3],
    /// Its standard error.
    pub standard_error: [f64; 3],
}

/// The error of a picture, estimated from its two independent streams.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorEstimate {
    /// Root of the mean, over pixels, of the estimated variance of the luminance.
    pub rmse: f64,
    /// The same as a fraction of the picture's mean luminance.
    pub relative: f64,
}

/// A set of samples and how many tiles hold just that.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Coverage {
    /// The samples.
    pub samples: Ranges,
    /// The number of tiles.
    pub tiles: usize,
}

impl PixelSums {
    fn stream_mean(&self, stream: usize, count: u64, step: Step) -> [f64; 3] {
        self.0[stream]
            .map(|sum| if count == 0 { 0.0 } else { sum.to_i128() as f64 * step.unit() / count as f64 })
    }

    fn estimate(&self, counts: [u64; 2], step: Step) -> PixelEstimate {
        let [a, b] = [0, 1].map(|stream| self.stream_mean(stream, counts[stream], step));
        match counts {
            [_, 0] => PixelEstimate { mean: a, variance: None },
            [0, _] => PixelEstimate { mean: b, variance: None },
            _ => PixelEstimate {
                mean: [0, 1, 2].map(|c| (a[c] + b[c]) / 2.0),
                variance: Some([0, 1, 2].map(|c| (a[c] - b[c]) * (a[c] - b[c]) / 4.0)),
            },
        }
    }

    pub(crate) fn add(&mut self, other: &PixelSums) {
        for (mine, theirs) in self.0.iter_mut().flatten().zip(other.0.iter().flatten()) {
            mine.add(theirs.to_i128());
        }
    }
}
