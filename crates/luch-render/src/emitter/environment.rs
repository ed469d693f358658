//! What surrounds the scene.

use super::EmitterSample;
use glam::{Mat3, Vec3};
use luch_image::{Bitmap, Rgb};
use luch_sampling::Piecewise2d;
use luch_sampling::warp::{sphere, sphere_pdf};
use luch_scene::{Environment, Id, Scene};
use std::f32::consts::PI;

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
    /// Over the unit square, rows from the top; by luminance times the sine of the polar angle.
    table: Piecewise2d,
    /// Mean luminance over all directions.
    mean: f32,
}

impl EnvironmentEmitter {
    /// The emitter of an environment; `None` if it is all black.
    pub(crate) fn new(scene: &Scene, environment: &Environment) -> Option<Self> {
        match *environment {
            Environment::Constant { radiance } => (!radiance.is_black()).then_some(Self::Constant(radiance)),
            Environment::LatLong { image, scale, rotation } => {
                let bitmap = &scene.images[image.index()];
                let weights = weights(bitmap, scale);
                let table = Piecewise2d::new(bitmap.width as usize, bitmap.height as usize, &weights).ok()?;
                // ∫ L sin θ dθ dφ / 4π over the unit square is 2π² / 4π times the table's integral.
                let mean = table.integral() as f32 * PI / 2.0;
                Some(Self::LatLong(LatLong { image, scale, rotation, table, mean }))
            }
        }
    }

    pub(crate) fn sample(&self, scene: &Scene, u: [f32; 2]) -> Option<EmitterSample> {
        match self {
            Self::Constant(radiance) => {
                EmitterSample::checked(sphere(u), None, *radiance, sphere_pdf(), false)
            }
            Self::LatLong(map) => {
                let drawn = map.table.sample(u);
                let [x, y] = drawn.position;
                let (sin_polar, cos_polar) = libm::sincosf(y * PI);
                let (sin_azimuth, cos_azimuth) = libm::sincosf((x - 0.5) * 2.0 * PI);
                let local = Vec3::new(sin_polar * sin_azimuth, cos_polar, -sin_polar * cos_azimuth);
                let pdf = drawn.pdf / (2.0 * PI * PI * sin_polar);
                EmitterSample::checked(map.rotation * local, None, map.at(scene, x, y), pdf, false)
            }
        }
    }

    /// Radiance from a direction.
    pub(crate) fn radiance(&self, scene: &Scene, direction: Vec3) -> Rgb {
        match self {
            Self::Constant(radiance) => *radiance,
            Self::LatLong(map) => {
                let [x, y] = map.place(direction);
                map.at(scene, x, y)
            }
        }
    }

    /// Density with which `sample` draws a direction.
    pub(crate) fn pdf(&self, direction: Vec3) -> f32 {
        match self {
            Self::Constant(_) => sphere_pdf(),
            Self::LatLong(map) => {
                let [x, y] = map.place(direction);
                let (sin_polar, _) = libm::sincosf(y * PI);
                let pdf = map.table.pdf([x, y]) / (2.0 * PI * PI * sin_polar);
                if pdf.is_finite() { pdf } else { 0.0 }
            }
        }
    }

    pub(crate) fn power(&self, scene_radius: f32) -> f32 {
        let mean = match self {
            Self::Constant(radiance) => radiance.luminance(),
            Self::LatLong(map) => map.mean,
        };
        // Irradiance π L on a great circle of the ball around the scene, as for a sun.
        PI * mean * PI * scene_radius * scene_radius
    }
}

impl LatLong {
    /// Place in the unit square, from the upper left.
    fn place(&self, direction: Vec3) -> [f32; 2] {
        let local = self.rotation.transpose() * direction;
        let x = 0.5 + libm::atan2f(local.x, -local.z) / (2.0 * PI);
        // Near the poles the arc cosine has no digits left.
        let y = libm::atan2f(libm::hypotf(local.x, local.z), local.y) / PI;
        [x.clamp(0.0, 1.0), y.clamp(0.0, 1.0)]
    }

    /// The picture between pixel centres, round the world and held at the poles.
    fn at(&self, scene: &Scene, x: f32, y: f32) -> Rgb {
        let image = &scene.images[self.image.index()];
        let (width, height) = (image.width as f32, image.height as f32);
        let (x, y) = (x * width - 0.5, y * height - 0.5);
        let (left, top) = (x.floor(), y.floor());
        let (right_part, low_part) = (x - left, y - top);
        let mut sum = Rgb::BLACK;
        for (dx, dy, weight) in [
            (0, 0, (1.0 - right_part) * (1.0 - low_part)),
            (1, 0, right_part * (1.0 - low_part)),
            (0, 1, (1.0 - right_part) * low_part),
            (1, 1, right_part * low_part),
        ] {
            if weight > 0.0 {
                let column = (left as i64 + dx).rem_euclid(i64::from(image.width)) as u32;
                let row = (top as i64 + dy).clamp(0, i64::from(image.height) - 1) as u32;
                sum += pixel(image, column, row) * weight;
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

/// For each pixel the mean luminance of the interpolated picture over it, times the sine of its polar angle. Where a neighbour
/// shines into a dark pixel the weight is positive, so that no light is out of reach.
fn weights(image: &Bitmap, scale: Rgb) -> Vec<f32> {
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
            let mean = (at(y.saturating_sub(1)) + 6.0 * at(y) + at((y + 1).min(height - 1))) / 8.0;
            mean * libm::sinf((y as f32 + 0.5) / height as f32 * PI)
        })
        .collect()
}
