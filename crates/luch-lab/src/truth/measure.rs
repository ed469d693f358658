//! Small films and what they show: pixels, and radiance with a standard error from independent replicates.

use super::Reads;
use luch_render::{BUNDLE, Film, Losses, PixelEstimate, Stop, Stopped, UnsoundScene, View, World};
use luch_render::{from_settings, render_pass};
use luch_sampling::{Estimate, Sequence, hash};
use luch_scene::{Camera, Filter, Integrator, Settings};

/// Bundles of pixels are independent randomisations of the samples: where all see the same, each is a replicate.
const COLUMNS: u32 = 32;
const ROWS: u32 = 16;
/// Replicates of a picture that counts as a whole.
const PICTURES: u64 = 32;
/// Samples of a pixel in the pilot, which chooses the size of the run and is thrown away.
const PILOT: u64 = 32;
/// Relative standard error that runs are planned for, and the one that ends them, as parts of the one that is demanded: that is one
/// of the truth, these are of the mean.
const PLANNED: f64 = 0.84;
const ENOUGH: f64 = 0.95;
/// Most samples of a pixel where half a percent is demanded.
const MOST: u64 = 1 << 14;

/// Why there is no answer.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TruthError {
    /// The scene cannot be rendered.
    #[error(transparent)]
    Unsound(#[from] UnsoundScene),
    /// Ended on request.
    #[error(transparent)]
    Stopped(#[from] Stopped),
    /// The film could not hold what was rendered.
    #[error("samples were lost: {} numbers too bright, {} not finite", .0.saturated, .0.invalid)]
    Lost(Losses),
}

/// Settings of a small film whose pixels have borders: a box filter of one pixel.
pub fn settings(width: u32, height: u32, sequence: Sequence, seed: u64) -> Settings {
    Settings { width, height, sequence, seed, filter: Filter::Box { radius: 0.5 }, ..Settings::default() }
}

/// Renders a film; its pixels, row by row.
///
/// # Errors
///
/// `stop` came due, or the film lost samples.
pub fn render(
    world: &World,
    camera: &Camera,
    settings: &Settings,
    way: Integrator,
    samples: u64,
    stop: &Stop,
) -> Result<Vec<PixelEstimate>, TruthError> {
    let view = View::new(camera, settings);
    let integrator = from_settings(way, &view);
    let mut film = Film::new(view.width(), view.height());
    render_pass(world, &view, integrator.as_ref(), &mut film, 0..samples, stop, &Default::default())?;
    match film.losses() {
        losses if losses.is_none() => Ok(film.read(|pixel, _| pixel).pixels().to_vec()),
        losses => Err(TruthError::Lost(losses)),
    }
}

/// The mean of every pixel over independent films with these seeds.
///
/// # Errors
///
/// Those of [`render`].
pub fn pixels_over_seeds(
    world: &World,
    camera: &Camera,
    like: &Settings,
    way: Integrator,
    samples: u64,
    seeds: u64,
) -> Result<Vec<Estimate>, TruthError> {
    let mut estimates = vec![Estimate::new(); (like.width * like.height) as usize];
    for seed in 0..seeds {
        let film = render(world, camera, &Settings { seed, ..*like }, way, samples, &Stop::new())?;
        for (estimate, pixel) in estimates.iter_mut().zip(film) {
            estimate.add(pixel.mean[0]);
        }
    }
    Ok(estimates)
}

/// Somebody who looks at a world.
#[derive(Clone, Copy, Debug)]
pub struct Look<'a> {
    /// What is looked at.
    pub world: &'a World,
    /// The eye.
    pub camera: &'a Camera,
    /// Which pixels have what is wanted.
    pub reads: Reads,
    /// The integrator.
    pub way: Integrator,
    /// Where sample points come from.
    pub sequence: Sequence,
    /// Another seed gives other samples.
    pub seed: u64,
}

/// What somebody saw.
#[derive(Clone, Debug)]
pub struct Seen {
    /// One sample for each replicate; all independent.
    pub replicates: Estimate,
    /// Camera samples, without those of the pilot and of runs that were thrown away.
    pub samples: u64,
}

impl Look<'_> {
    /// The radiance in the first channel, until its standard error is `relative_error` of it or less, or as near as there is patience for.
    ///
    /// A run that ends above that is thrown away and made again with twice the samples and another seed; the choice looks at the
    /// spread alone, so it leans to no side.
    ///
    /// # Errors
    ///
    /// Those of [`render`].
    pub fn measure(&self, relative_error: f64, stop: &Stop) -> Result<Seen, TruthError> {
        let demanded = relative_error.clamp(1e-5, 1.0);
        let patience = (0.005 / demanded).max(1.0);
        let most = (MOST as f64 * patience * patience) as u64;
        let pilot = self.replicates(0, PILOT, stop)?;
        let ratio = relative_error_of(&pilot) / (PLANNED * demanded);
        let wanted = PILOT as f64 * ratio * ratio;
        let mut samples = (wanted.min(most as f64) as u64).clamp(PILOT, most).next_power_of_two();
        let mut attempt = 1;
        loop {
            let replicates = self.replicates(attempt, samples, stop)?;
            if relative_error_of(&replicates) <= ENOUGH * demanded || samples >= most {
                return Ok(Seen { replicates, samples: samples * self.pixels() });
            }
            samples *= 2;
            attempt += 1;
        }
    }

    /// Pixels of all its films together.
    fn pixels(&self) -> u64 {
        match self.reads {
            Reads::EveryPixel => u64::from(COLUMNS * ROWS),
            Reads::WholePicture => PICTURES * u64::from(BUNDLE * BUNDLE),
        }
    }

    fn replicates(&self, attempt: u64, samples: u64, stop: &Stop) -> Result<Estimate, TruthError> {
        let seed = hash::combine(self.seed, attempt);
        let film = |width, height, seed| {
            let settings = settings(width, height, self.sequence, seed);
            render(self.world, self.camera, &settings, self.way, samples, stop)
        };
        let mean = |pixels: &mut dyn Iterator<Item = &PixelEstimate>| {
            pixels.map(|pixel| pixel.mean[0]).sum::<f64>() / f64::from(BUNDLE * BUNDLE)
        };
        match self.reads {
            Reads::EveryPixel => {
                let pixels = film(COLUMNS, ROWS, seed)?;
                let bundles = (0..ROWS / BUNDLE).flat_map(|y| (0..COLUMNS / BUNDLE).map(move |x| (x, y)));
                let place =
                    |x, y, i| ((y * BUNDLE + i / BUNDLE) * COLUMNS + x * BUNDLE + i % BUNDLE) as usize;
                let bundle = |(x, y)| mean(&mut (0..BUNDLE * BUNDLE).map(|i| &pixels[place(x, y, i)]));
                Ok(bundles.map(bundle).collect())
            }
            Reads::WholePicture => (0..PICTURES)
                .map(|picture| Ok(mean(&mut film(BUNDLE, BUNDLE, hash::combine(seed, picture))?.iter())))
                .collect(),
        }
    }
}

/// The standard error of an estimate over its mean.
fn relative_error_of(estimate: &Estimate) -> f64 {
    estimate.standard_error().unwrap_or(0.0) / estimate.mean().unwrap_or(0.0).abs().max(f64::MIN_POSITIVE)
}
