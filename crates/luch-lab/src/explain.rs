//! A pixel explained: the paths of its samples, what each found, where, by which technique and with which weight.
//!
//! The paths are those of the path tracer without sharing between pixels, so that each belongs to the pixel alone; the estimate of the
//! picture, in which neighbours help each other, stands beside it. Both have the same mean.

mod figures;
mod names;
mod tree;

pub use figures::{depth_figure, running_figure};
pub use names::{light_name, material_name, object_name};
pub use tree::Branch;

use luch::image::Rgb;
use luch::render::{
    BUNDLE, FollowedPath, Integrator, LightSource, PathEnd, PathTracer, Stop, Stopped, View, World,
};
use luch_sampling::{Estimate, Interval};
use rayon::prelude::*;
use std::ops::Range;

/// How light reached the camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Technique {
    /// Seen by the camera itself, or after a mirror or smooth glass: no other technique could have found it.
    Specular,
    /// A direction drawn by the BSDF met it.
    Bsdf,
    /// A lamp was chosen and asked.
    Light,
}

impl Technique {
    /// All, in order.
    pub const ALL: [Technique; 3] = [Technique::Specular, Technique::Bsdf, Technique::Light];

    /// For people.
    pub const fn name(self) -> &'static str {
        match self {
            Technique::Specular => "specular",
            Technique::Bsdf => "BSDF",
            Technique::Light => "light",
        }
    }
}

/// One portion of light on one path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Portion {
    /// Scatterings between lamp and camera.
    pub depth: u32,
    /// How it was found.
    pub technique: Technique,
    /// Where it is from; `None` if several things beyond the scene shine along the ray.
    pub source: Option<LightSource>,
    /// What it adds to the sample.
    pub light: Rgb,
}

/// The portions of a path, in order. A lamp that is asked is one scattering further away than one that is met.
pub fn portions(path: &FollowedPath) -> impl Iterator<Item = Portion> {
    (0..).zip(&path.vertices).flat_map(|(depth, vertex)| {
        let found = vertex.found.map(|found| Portion {
            depth,
            technique: if found.pdf_bsdf.is_some() { Technique::Bsdf } else { Technique::Specular },
            source: found.source,
            light: found.contribution,
        });
        let asked = vertex.asked.filter(|asked| !asked.contribution.is_black()).map(|asked| Portion {
            depth: depth + 1,
            technique: Technique::Light,
            source: Some(asked.source),
            light: asked.contribution,
        });
        found.into_iter().chain(asked)
    })
}

/// Portions of one kind, over all samples.
#[derive(Clone, Debug, PartialEq)]
pub struct Part<K> {
    /// The kind.
    pub kind: K,
    /// What it adds to the mean of the pixel.
    pub light: [f64; 3],
    /// Its part of the luminance of the pixel.
    pub share: f64,
    /// Variance of what it adds to the luminance of one sample.
    pub variance: f64,
    /// Samples with such a portion.
    pub samples: u64,
}

/// The mean of the first samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Running {
    /// How many samples.
    pub samples: u64,
    /// Mean luminance.
    pub mean: f64,
    /// Of the mean, as if samples were independent, at 95 %; `None` of fewer than two.
    pub interval: Option<Interval>,
}

/// Everything about a pixel.
#[derive(Clone, Debug)]
pub struct Explanation {
    /// Column and row from the upper left.
    pub pixel: [u32; 2],
    /// Which samples.
    pub samples: Range<u64>,
    /// Mean of the pixel's own paths.
    pub own_mean: [f64; 3],
    /// Standard error of its luminance, as if samples were independent.
    pub own_error: f64,
    /// What the picture shows after the same samples, neighbours helping.
    pub picture_mean: [f64; 3],
    /// Standard error of its luminance by the twin streams.
    pub picture_error: Option<f64>,
    /// Means as samples come in.
    pub running: Vec<Running>,
    /// By depth and technique.
    pub by_technique: Vec<Part<(u32, Technique)>>,
    /// By where light is from, brightest first.
    pub by_source: Vec<Part<Option<LightSource>>>,
    /// How paths ended, with numbers.
    pub ends: Vec<(PathEnd, u64)>,
    /// All paths as one tree.
    pub tree: Branch,
    /// The samples that add most, brightest first.
    pub brightest: Vec<BrightSample>,
}

/// A sample and its path.
#[derive(Clone, Debug)]
pub struct BrightSample {
    /// Its number.
    pub index: u64,
    /// Its part of the pixel's luminance.
    pub share: f64,
    /// Its path.
    pub path: FollowedPath,
}

/// Most samples of one explanation.
pub const MOST_SAMPLES: u64 = 1 << 20;

/// How many of the brightest samples are kept.
const BRIGHTEST: usize = 8;

/// Why a pixel cannot be explained.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ExplainError {
    /// Not in the picture.
    #[error("there is no pixel {},{}: the picture has {width}x{height}, counted from 0,0 in the upper left corner", pixel[0], pixel[1])]
    NoSuchPixel {
        /// The pixel asked for.
        pixel: [u32; 2],
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// None or too many.
    #[error("{0} samples: between 1 and {MOST_SAMPLES} can be explained")]
    Samples(u64),
    /// Somebody asked to stop.
    #[error("stopped")]
    Stopped,
}

impl From<Stopped> for ExplainError {
    fn from(_: Stopped) -> Self {
        ExplainError::Stopped
    }
}

/// Relative luminance of Rec. 709.
pub(crate) fn luminance(light: [f64; 3]) -> f64 {
    0.212_639 * light[0] + 0.715_169 * light[1] + 0.072_192 * light[2]
}

/// Explains a pixel by the paths of its samples.
///
/// # Errors
/// If the pixel is not in the picture, there are no samples or too many, or `stop` came due.
pub fn explain(
    world: &World,
    view: &View,
    tracer: PathTracer,
    pixel: [u32; 2],
    samples: Range<u64>,
    stop: &Stop,
) -> Result<Explanation, ExplainError> {
    let (width, height) = (view.width(), view.height());
    if pixel[0] >= width || pixel[1] >= height {
        return Err(ExplainError::NoSuchPixel { pixel, width, height });
    }
    let count = samples.end.saturating_sub(samples.start);
    if count == 0 || count > MOST_SAMPLES {
        return Err(ExplainError::Samples(count));
    }
    let follow = |index: u64| tracer.follow(world, &view.start(pixel, index), stop);
    let paths: Vec<FollowedPath> = samples.clone().into_par_iter().map(follow).collect::<Result<_, _>>()?;
    let shown = samples.clone().into_par_iter().map(|index| shown(world, view, tracer, pixel, index, stop));
    let shown: Vec<[f64; 3]> = shown.collect::<Result<_, _>>()?;

    let own: Vec<[f64; 3]> = paths.iter().map(|path| path.radiance.to_array().map(f64::from)).collect();
    let luminances: Estimate = own.iter().map(|light| luminance(*light)).collect();
    let own_mean = mean(&own);
    let whole = luminance(own_mean);
    let share_of = |part: f64| if whole > 0.0 { part / whole } else { 0.0 };
    let mut by_technique = parts(&paths, whole, |portion| (portion.depth, portion.technique));
    by_technique.sort_by_key(|part| part.kind);
    let mut by_source = parts(&paths, whole, |portion| portion.source);
    by_source.sort_by(|a, b| b.share.total_cmp(&a.share));
    let mut order: Vec<usize> = (0..paths.len()).collect();
    order.sort_by(|&a, &b| luminance(own[b]).total_cmp(&luminance(own[a])).then(a.cmp(&b)));
    let bright = |&place: &usize| BrightSample {
        index: samples.start + place as u64,
        share: share_of(luminance(own[place]) / count as f64),
        path: paths[place].clone(),
    };
    let mut ends: Vec<(PathEnd, u64)> = Vec::new();
    for path in &paths {
        match ends.iter_mut().find(|(end, _)| *end == path.end) {
            Some((_, count)) => *count += 1,
            None => ends.push((path.end, 1)),
        }
    }
    ends.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    Ok(Explanation {
        pixel,
        own_mean,
        own_error: luminances.standard_error().unwrap_or(0.0),
        picture_mean: mean(&shown),
        picture_error: twin_error(&shown, samples.start),
        running: running(&own),
        by_technique,
        by_source,
        ends,
        tree: Branch::of(&paths, whole),
        brightest: order.iter().take(BRIGHTEST).map(bright).collect(),
        samples,
    })
}

/// What the picture takes for one sample: the pixel's place in its bundle.
fn shown(
    world: &World,
    view: &View,
    tracer: PathTracer,
    pixel: [u32; 2],
    index: u64,
    stop: &Stop,
) -> Result<[f64; 3], Stopped> {
    let bundle = view.bundle(pixel, index);
    let mut radiance = vec![Rgb::BLACK; bundle.len()];
    tracer.radiance(world, &bundle, &mut radiance, stop)?;
    let within = pixel.map(|place| place % BUNDLE);
    let columns = BUNDLE.min(view.width() - (pixel[0] - within[0]));
    Ok(radiance[(within[1] * columns + within[0]) as usize].to_array().map(f64::from))
}

fn mean(samples: &[[f64; 3]]) -> [f64; 3] {
    [0, 1, 2].map(|channel| samples.iter().map(|light| light[channel]).sum::<f64>() / samples.len() as f64)
}

/// Half the distance of the means of even and odd samples.
fn twin_error(samples: &[[f64; 3]], start: u64) -> Option<f64> {
    let stream = |parity: u64| -> Option<f64> {
        let own = (start..).zip(samples).filter(|(index, _)| index % 2 == parity);
        let estimate: Estimate = own.map(|(_, light)| luminance(*light)).collect();
        estimate.mean()
    };
    Some((stream(0)? - stream(1)?).abs() / 2.0)
}

/// Means of the first 1, 2, 3, 4, 6, 8, 12, … samples, and of all.
fn running(samples: &[[f64; 3]]) -> Vec<Running> {
    let (mut estimate, mut rows) = (Estimate::new(), Vec::new());
    for (count, light) in (1..).zip(samples) {
        estimate.add(luminance(*light));
        let is_told = [count, count * 2]
            .iter()
            .any(|n: &u64| n.is_power_of_two() || (n.is_multiple_of(3) && (n / 3).is_power_of_two()));
        if (is_told || count as usize == samples.len())
            && let Some(mean) = estimate.mean()
        {
            rows.push(Running { samples: count, mean, interval: estimate.confidence_interval(0.95) });
        }
    }
    rows
}

/// Sums up the portions of each kind.
fn parts<K: Copy + PartialEq>(
    paths: &[FollowedPath],
    whole: f64,
    kind: impl Fn(&Portion) -> K,
) -> Vec<Part<K>> {
    struct Sums<K> {
        kind: K,
        light: [f64; 3],
        squares: f64,
        samples: u64,
        /// Of the sample that is summed up now.
        current: [f64; 3],
    }
    let mut kinds: Vec<Sums<K>> = Vec::new();
    for path in paths {
        for portion in portions(path) {
            let kind = kind(&portion);
            let light = portion.light.to_array().map(f64::from);
            let place = kinds.iter().position(|sums| sums.kind == kind).unwrap_or_else(|| {
                kinds.push(Sums { kind, light: [0.0; 3], squares: 0.0, samples: 0, current: [0.0; 3] });
                kinds.len() - 1
            });
            (0..3).for_each(|channel| kinds[place].current[channel] += light[channel]);
        }
        for sums in &mut kinds {
            let current = std::mem::take(&mut sums.current);
            if current != [0.0; 3] {
                (0..3).for_each(|channel| sums.light[channel] += current[channel]);
                sums.squares += luminance(current) * luminance(current);
                sums.samples += 1;
            }
        }
    }
    let count = paths.len() as f64;
    let part = |sums: Sums<K>| {
        let light = sums.light.map(|sum| sum / count);
        let mean = luminance(light);
        let share = if whole > 0.0 { mean / whole } else { 0.0 };
        let variance = (sums.squares / count - mean * mean).max(0.0);
        Part { kind: sums.kind, light, share, variance, samples: sums.samples }
    };
    kinds.into_iter().map(part).collect()
}
