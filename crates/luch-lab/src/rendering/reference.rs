//! What estimates are held against, and how sure that is itself.

use super::{REFERENCE, RenderingError, Subject, Work, name_of, seed_of};
use luch_image::{Image, Rgb};
use luch_render::{BUNDLE, Film};
use luch_sampling::Sequence;
use luch_scene::Integrator as Name;
use serde::Serialize;

/// Where the truth comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum Truth {
    /// A rendering by Sobol' points of so many samples for each pixel, with a seed of its own. It shares whatever is wrong in all
    /// renderings of this program.
    Samples(u64),
    /// A film, whose two streams tell its own error.
    Film(Box<Film>),
    /// A picture, with the standard error of each pixel if it is known.
    Picture {
        /// Linear light.
        light: Image<Rgb>,
        /// Of each pixel.
        standard_error: Option<Image<Rgb>>,
    },
    /// Every pixel and channel has this value, exactly.
    Value(f64),
}

/// A truth, ready to be compared with.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reference {
    /// In words: where it comes from.
    pub origin: String,
    /// Mean over pixels and channels.
    pub mean: f64,
    /// Its standard error, if known. Channels count as if they erred together, which errs on the safe side.
    pub mean_standard_error: Option<f64>,
    /// Mean over pixels and channels of the variance of its pixels, if known; 0 for a closed form. This is subtracted from squared errors.
    pub noise: Option<f64>,
    #[serde(skip)]
    pub(super) values: Vec<[f64; 3]>,
    /// Of each pixel; `None` if unknown.
    #[serde(skip)]
    pub(super) variance: Option<Vec<[f64; 3]>>,
    #[serde(skip)]
    pub(super) mean_by_channel: [f64; 3],
    #[serde(skip)]
    pub(super) mean_error_by_channel: Option<[f64; 3]>,
    #[serde(skip)]
    pub(super) picture: Image<Rgb>,
}

impl Truth {
    /// Samples that are made to know it.
    pub(super) fn work(&self, pixels: u64) -> u64 {
        if let Self::Samples(count) = self { count.saturating_mul(pixels) } else { 0 }
    }

    /// The reference of an integrator. Only one that is rendered depends on it.
    pub(super) fn reference(
        &self,
        subject: &Subject,
        integrator: Name,
        seed: u64,
        work: &Work<'_>,
    ) -> Result<Reference, RenderingError> {
        match self {
            Self::Samples(count) if *count < 2 => {
                Err(RenderingError::Plan("a reference needs 2 samples at least: one of each stream"))
            }
            Self::Samples(count) => {
                let seed = seed_of(seed, REFERENCE, 0);
                let mut run = subject.start(Sequence::Sobol, integrator, seed);
                run.advance(*count, work)?;
                let origin =
                    format!("{} by sobol, {count} samples a pixel, seed {seed}", name_of(integrator));
                Reference::of_film(&run.film, origin)
            }
            Self::Film(film) => {
                let [width, height] = subject.size();
                fits([film.width(), film.height()], [width, height])?;
                Reference::of_film(film, format!("a film of {} samples a pixel", film.mean_samples()))
            }
            Self::Picture { light, standard_error } => {
                Reference::of_picture(light, standard_error.as_ref(), subject.size())
            }
            Self::Value(value) if !value.is_finite() => {
                Err(RenderingError::Plan("the truth must be a finite number"))
            }
            Self::Value(value) => Ok(Reference::of_value(*value, subject.size())),
        }
    }
}

fn fits(reference: [u32; 2], picture: [u32; 2]) -> Result<(), RenderingError> {
    if reference == picture { Ok(()) } else { Err(RenderingError::Size { reference, picture }) }
}

impl Reference {
    fn of_film(film: &Film, origin: String) -> Result<Self, RenderingError> {
        let mean = film.mean().ok_or(RenderingError::Unfinished)?;
        let estimates = film.read(|estimate, _| estimate);
        let values = estimates.pixels().iter().map(|pixel| pixel.mean).collect();
        let variance: Vec<[f64; 3]> =
            estimates.pixels().iter().map(|pixel| pixel.variance.unwrap_or_default()).collect();
        Ok(Self::new(origin, values, Some(variance), mean.mean, Some(mean.standard_error), film.to_image()))
    }

    fn of_picture(
        light: &Image<Rgb>,
        error: Option<&Image<Rgb>>,
        size: [u32; 2],
    ) -> Result<Self, RenderingError> {
        let own = |image: &Image<Rgb>| [image.width(), image.height()];
        fits(own(light), size)?;
        let bad = light.pixels().iter().filter(|pixel| !pixel.is_finite()).count();
        if bad > 0 {
            return Err(RenderingError::NotFinite(bad));
        }
        // Errors that do not fit or are no numbers are as good as none.
        let error =
            error.filter(|error| own(error) == size && error.pixels().iter().all(|pixel| pixel.is_finite()));
        let doubles = |pixel: &Rgb| pixel.to_array().map(f64::from);
        let values: Vec<[f64; 3]> = light.pixels().iter().map(doubles).collect();
        let variance = error.map(|error| {
            error.pixels().iter().map(|pixel| doubles(pixel).map(|e| e * e)).collect::<Vec<_>>()
        });
        let count = values.len().max(1) as f64;
        let mean = [0, 1, 2].map(|c| values.iter().map(|pixel| pixel[c]).sum::<f64>() / count);
        let origin = match error {
            Some(_) => "a picture with its standard errors",
            None => "a picture that says nothing of its own error: that is in all errors below",
        };
        let mean_error = error.map(mean_error_at_most);
        Ok(Self::new(origin.to_owned(), values, variance, mean, mean_error, light.clone()))
    }

    fn of_value(value: f64, [width, height]: [u32; 2]) -> Self {
        let count = width as usize * height as usize;
        let picture = Image::filled(width, height, Rgb::gray(value as f32));
        let origin = format!("{value} everywhere, exactly");
        Self::new(
            origin,
            vec![[value; 3]; count],
            Some(vec![[0.0; 3]; count]),
            [value; 3],
            Some([0.0; 3]),
            picture,
        )
    }

    fn new(
        origin: String,
        values: Vec<[f64; 3]>,
        variance: Option<Vec<[f64; 3]>>,
        mean_by_channel: [f64; 3],
        mean_error_by_channel: Option<[f64; 3]>,
        picture: Image<Rgb>,
    ) -> Self {
        let average = |values: [f64; 3]| values.iter().sum::<f64>() / 3.0;
        let noise = variance.as_ref().map(|pixels| {
            pixels.iter().map(|&pixel| average(pixel)).sum::<f64>() / pixels.len().max(1) as f64
        });
        Self {
            origin,
            mean: average(mean_by_channel),
            mean_standard_error: mean_error_by_channel.map(average),
            noise,
            values,
            variance,
            mean_by_channel,
            mean_error_by_channel,
            picture,
        }
    }

    /// Root of its noise as a part of the mean: errors smaller than that are not to be seen by it.
    pub fn relative_floor(&self) -> Option<f64> {
        self.noise.filter(|_| self.mean != 0.0).map(|noise| noise.sqrt() / self.mean.abs())
    }
}

/// The largest standard error that the mean can have if bundles are independent and pixels of a bundle err together.
fn mean_error_at_most(error: &Image<Rgb>) -> [f64; 3] {
    let across = error.width().div_ceil(BUNDLE).max(1);
    let mut sums = vec![[0.0; 3]; (across * error.height().div_ceil(BUNDLE)) as usize];
    for (at, pixel) in (0u32..).zip(error.pixels()) {
        let (x, y) = (at % error.width(), at / error.width());
        let sum = &mut sums[(y / BUNDLE * across + x / BUNDLE) as usize];
        (0..3).for_each(|c| sum[c] += f64::from(pixel.to_array()[c]).abs());
    }
    let count = error.pixels().len().max(1) as f64;
    [0, 1, 2].map(|c| sums.iter().map(|sum| sum[c] * sum[c]).sum::<f64>().sqrt() / count)
}
