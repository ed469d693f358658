//! A subject, a camera, a size and a style become a picture.

use crate::error::{LARGEST_SIDE, MOST_SAMPLES};
use crate::lines::layers;
use crate::shade::Shader;
use crate::style::Style;
use crate::subject::Subject;
use crate::view::View;
use crate::visibility::Visibility;
use crate::{PreviewError, Size};
use luch_image::{Image, Rgb};
use luch_scene::Camera;
use rayon::prelude::*;

/// A preview and what was seen where.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Linear light.
    pub color: Image<Rgb>,
    /// Depth along the viewing axis at the middle of each pixel, in metres; infinite where there is nothing.
    pub depth: Image<f32>,
    /// Number of the scene's instance at the middle of each pixel, 0 for a bare mesh; [`NOTHING`] where there is nothing.
    pub instances: Image<u32>,
    /// Number of the face there: of the triangle, of the polygon if the subject has polygons, 0 on exact shapes; [`NOTHING`]
    /// where there is nothing.
    pub faces: Image<u32>,
}

/// The number of no instance and no face.
pub const NOTHING: u32 = u32::MAX;

/// Draws a subject as a camera sees it: through a pinhole, each pixel where the renderer has it.
///
/// The picture is the same, bit for bit, for any number of threads.
///
/// # Errors
/// If the picture is empty or too large, the camera sees nothing at all, or there are more triangles than numbers.
pub fn draw(subject: &Subject, camera: &Camera, size: Size, style: &Style) -> Result<Picture, PreviewError> {
    let factor = style.antialiasing.factor();
    check(size, factor)?;
    let seen = Visibility::new(subject, View::new(camera, size, 1)?, style.hides_back_faces)?;
    let depth = filled(size, |x, y| match seen.is_empty(x, y) {
        false => seen.view.depth(seen.linear(x, y)) as f32,
        true => f32::INFINITY,
    });
    let found = filled(size, |x, y| {
        seen.seen(x, y).map_or([NOTHING; 2], |found| [subject.parts[found.part].number, seen.face(found)])
    });
    let color = if factor == 1 {
        paint(&seen, style, 1)
    } else {
        drop(seen);
        let finer = Visibility::new(subject, View::new(camera, size, factor)?, style.hides_back_faces)?;
        paint(&finer, style, factor)
    };
    Ok(Picture { color, depth, instances: found.map(|pair| pair[0]), faces: found.map(|pair| pair[1]) })
}

/// Refuses pictures that are empty or would not fit.
pub(crate) fn check(size: Size, factor: u32) -> Result<(), PreviewError> {
    let Size { width, height } = size;
    let samples = factor * factor;
    let is_side = |side| (1..=LARGEST_SIDE).contains(&side);
    let count = || u64::from(width) * u64::from(height) * u64::from(samples);
    if is_side(width) && is_side(height) && count() <= MOST_SAMPLES {
        return Ok(());
    }
    Err(PreviewError::Size { width, height, samples })
}

/// An image by its pixels' values, rows side by side.
fn filled<T: Copy + Default + Send>(size: Size, value: impl Fn(u32, u32) -> T + Sync) -> Image<T> {
    let mut image = Image::filled(size.width, size.height, T::default());
    let rows = image.pixels_mut().par_chunks_mut(size.width as usize).enumerate();
    rows.for_each(|(y, row)| {
        (0..).zip(row).for_each(|(x, pixel)| *pixel = value(x, y as u32));
    });
    image
}

/// The colours, each the mean of `factor` × `factor` samples.
fn paint(seen: &Visibility, style: &Style, factor: u32) -> Image<Rgb> {
    let shader = Shader::new(seen, style);
    let layers = layers(seen, style, factor);
    let samples = seen.view.size;
    let sample = |x: u32, y: u32| {
        let place = y as usize * samples.width as usize + x as usize;
        layers.iter().fold(shader.color(x, y), |below, layer| layer.over(place, below))
    };
    let size = Size { width: samples.width / factor, height: samples.height / factor };
    filled(size, |x, y| {
        let mut sum = Rgb::BLACK;
        for row in 0..factor {
            for column in 0..factor {
                sum += sample(x * factor + column, y * factor + row);
            }
        }
        sum / (factor * factor) as f32
    })
}
