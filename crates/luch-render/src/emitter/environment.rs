//! What surrounds the scene.
//!
//! Paths find it by themselves as well, and well where it is even. So light sampling is left what is brighter than the mean: the
//! density is that of max(0, L − mean L), which is best for a path tracer that weighs both by the balance heuristic and scatters
//! about evenly (Karlík et al., "MIS Compensation: Optimizing Sampling Techniques in Multiple Importance Sampling", 2019). An
//! environment that is the same everywhere is not sampled at all.

mod table;

use super::{EmitterSample, FarLight};
use glam::{Mat3, Vec3};
use luch_image::{Bitmap, Rgb};
use luch_sampling::trig;
use luch_scene::{Environment, Id, Scene};
use std::f32::consts::PI;
use table::Table;

/// The environment as an emitter.
#[derive(Debug)]
pub(crate) enum EnvironmentEmitter {
    Constant(Rgb),
    LatLong(LatLong),
}

/// A picture in latitude and longitude with a table of where it is bright.
#[derive(Debug)]
pub(crate) struct LatLong {
    image: Id<Bitmap>,
    scale: Rgb,
    rotation: Mat3,
    /// Over the unit square, rows from the top; `None` if nothing is brighter than the rest.
    bright: Option<Bright>,
}

/// What is brighter than the mean.
#[derive(Debug)]
struct Bright {
    table: Table,
    /// Irradiance of a surface if it came evenly from all directions, as luminance.
    irradiance: f32,
}

impl EnvironmentEmitter {
    /// The emitter of an environment; `None` if it is all black.
    pub(crate) fn new(scene: &Scene, environment: &Environment) -> Option<Self> {
        match *environment {
            Environment::Constant { radiance } => (!radiance.is_black()).then_some(Self::Constant(radiance)),
            Environment::LatLong { image, scale, rotation } => {
                let bitmap = &scene.images[image.index()];
                let luminance = luminances(bitmap, scale);
                luminance.iter().any(|&value| value > 0.0).then(|| {
                    let bright = Bright::new(bitmap.width as usize, luminance);
                    Self::LatLong(LatLong { image, scale, rotation, bright })
                })
            }
        }
    }

    pub(crate) fn sample(&self, scene: &Scene, u: [f32; 2]) -> Option<EmitterSample> {
        let Self::LatLong(map) = self else { return None };
        let drawn = map.bright.as_ref()?.table.draw(u)?;
        let [x, y] = drawn.position;
        let [sin_polar, cos_polar] = trig::sin_cos_turns(0.5 * y);
        // The middle column lies toward −z.
        let [sin_azimuth, cos_azimuth] = trig::sin_cos_turns(x);
        let local = Vec3::new(-sin_polar * sin_azimuth, cos_polar, sin_polar * cos_azimuth);
        let pdf = drawn.pdf / (2.0 * PI * PI * sin_polar);
        EmitterSample::checked(map.rotation * local, None, map.at(scene, x, y), pdf, false)
    }

    /// Radiance from a direction, and the density of sampling it.
    pub(crate) fn toward(&self, scene: &Scene, direction: Vec3) -> FarLight {
        match self {
            Self::Constant(radiance) => FarLight { radiance: *radiance, pdf: 0.0 },
            Self::LatLong(map) => {
                let local = map.rotation.transpose() * direction;
                let sin_polar = (local.x * local.x + local.z * local.z).sqrt();
                let x = (0.5 + trig::angle(local.x, -local.z) / (2.0 * PI)).clamp(0.0, 1.0);
                // Near the poles the arc cosine has no digits left.
                let y = (trig::angle(sin_polar, local.y) / PI).clamp(0.0, 1.0);
                let pdf = match &map.bright {
                    Some(bright) => bright.table.pdf([x, y]) / (2.0 * PI * PI * sin_polar),
                    None => 0.0,
                };
                let pdf = if pdf.is_finite() { pdf } else { 0.0 };
                FarLight { radiance: map.at(scene, x, y), pdf }
            }
        }
    }

    /// Irradiance of what is sampled, as luminance: the weight of the choice. Zero if nothing is.
    pub(crate) fn irradiance(&self) -> f32 {
        match self {
            Self::LatLong(LatLong { bright: Some(bright), .. }) => bright.irradiance,
            _ => 0.0,
        }
    }
}

impl Bright {
    /// The table of a picture of luminances; `None` if it is about even.
    fn new(width: usize, mut luminance: Vec<f32>) -> Option<Self> {
        /// Part of the light that must be brighter than the mean to be worth a ray.
        const LEAST: f64 = 0.02;
        let height = luminance.len() / width;
        let sine = |row: usize| libm::sinf((row as f32 + 0.5) / height as f32 * PI);
        let (mut sum, mut weight) = (0.0, 0.0);
        for (row, values) in luminance.chunks_exact(width).enumerate() {
            let sine = f64::from(sine(row));
            sum += values.iter().map(|&value| f64::from(value)).sum::<f64>() * sine;
            weight += width as f64 * sine;
        }
        let mean = sum / weight;
        let mut bright = 0.0;
        for (row, values) in luminance.chunks_exact_mut(width).enumerate() {
            let sine = sine(row);
            for value in values {
                *value = (*value - mean as f32).max(0.0) * sine;
                bright += f64::from(*value);
            }
        }
        if bright < LEAST * sum {
            return None;
        }
        Some(Self { table: Table::new(width, &luminance)?, irradiance: PI * (bright / weight) as f32 })
    }
}

impl LatLong {
    /// The picture between pixel centres, round the world and held at the poles; `x` and `y` in [0, 1] from the upper left.
    fn at(&self, scene: &Scene, x: f32, y: f32) -> Rgb {
        let image = &scene.images[self.image.index()];
        let (width, height) = (image.width, image.height);
        let (x, y) = (x * width as f32 - 0.5, y * height as f32 - 0.5);
        let (left, top) = (x.floor(), y.floor());
        let (right_part, low_part) = (x - left, y - top);
        let around = |column: i64| match column {
            -1 => width - 1,
            _ if column >= i64::from(width) => (column - i64::from(width)) as u32,
            _ => column as u32,
        };
        let held = |row: i64| row.clamp(0, i64::from(height) - 1) as u32;
        let (left, top) = (left as i64, top as i64);
        let (columns, rows) = ([around(left), around(left + 1)], [held(top), held(top + 1)]);
        let mut sum = Rgb::BLACK;
        for (column, row, weight) in [
            (0, 0, (1.0 - right_part) * (1.0 - low_part)),
            (1, 0, right_part * (1.0 - low_part)),
            (0, 1, (1.0 - right_part) * low_part),
            (1, 1, right_part * low_part),
        ] {
            if weight > 0.0 {
                sum += pixel(image, columns[column], rows[row]) * weight;
            }
        }
        sum * self.scale
    }
}

/// A pixel's light; what is negative or not finite is dark.
fn pixel(image: &Bitmap, x: u32, y: u32) -> Rgb {
    let [r, g, b, _] = image.linear(x, y, image.encoding);
    Rgb::new(r, g, b).map(|v| if v.is_finite() { v.max(0.0) } else { 0.0 })
}

/// For each pixel the mean luminance of the interpolated picture over it.
fn luminances(image: &Bitmap, scale: Rgb) -> Vec<f32> {
    let (width, height) = (image.width as usize, image.height as usize);
    let luminance: Vec<f32> = (0..height)
        .flat_map(|y| (0..width).map(move |x| (x, y)))
        .map(|(x, y)| (pixel(image, x as u32, y as u32) * scale).luminance().min(1e30))
        .collect();
    // Over half a pixel beside its centre, linear interpolation gives a neighbour the weights 1/8, 6/8, 1/8.
    let across: Vec<f32> = (0..height)
        .flat_map(|y| (0..width).map(move |x| (x, y)))
        .map(|(x, y)| {
            let row = &luminance[y * width..(y + 1) * width];
            (row[(x + width - 1) % width] + 6.0 * row[x] + row[(x + 1) % width]) / 8.0
        })
        .collect();
    (0..height)
        .flat_map(|y| (0..width).map(move |x| (x, y)))
        .map(|(x, y)| {
            let at = |row: usize| across[row * width + x];
            (at(y.saturating_sub(1)) + 6.0 * at(y) + at((y + 1).min(height - 1))) / 8.0
        })
        .collect()
}
