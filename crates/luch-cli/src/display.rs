//! From light to what PNG and JPEG show.

use luch::image::tone::Tone;
use luch::image::{Image, Rgb};
use luch::scene::{Integrator, Property};

/// Exposure and curve, and what a property looks like as a colour.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Display {
    pub(crate) tone: Tone,
    pub(crate) integrator: Integrator,
}

impl Display {
    /// The picture brought between 0 and 1 where it holds something else than light: normals from −1…1, depths divided by the largest.
    fn colors(&self, image: &Image<Rgb>) -> Option<Image<Rgb>> {
        match self.integrator {
            Integrator::Inspect(Property::Normal | Property::GeometricNormal) => {
                Some(image.map(|normal| normal.map(|v| 0.5 + 0.5 * v)))
            }
            Integrator::Inspect(Property::Depth) => {
                let farthest = image.pixels().iter().fold(0.0f32, |most, pixel| most.max(pixel.r));
                let scale = if farthest > 0.0 { 1.0 / farthest } else { 1.0 };
                Some(image.map(|depth| depth.map(|v| v * scale)))
            }
            _ => None,
        }
    }

    /// As 8 bits a channel.
    pub(crate) fn to_u8(self, image: &Image<Rgb>) -> Image<[u8; 3]> {
        self.tone.to_u8(self.colors(image).as_ref().unwrap_or(image))
    }

    /// As 16 bits a channel.
    pub(crate) fn to_u16(self, image: &Image<Rgb>) -> Image<[u16; 3]> {
        self.tone.to_u16(self.colors(image).as_ref().unwrap_or(image))
    }
}
