//! An image as it came from a file, kept in the form it had there.

use crate::{Image, Rgb, srgb};
use serde::{Deserialize, Serialize};

/// How stored 8- and 16-bit numbers relate to light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Encoding {
    /// The sRGB transfer curve (IEC 61966-2-1).
    Srgb,
    /// Numbers proportional to light, or no light at all (normals, roughness).
    Linear,
}

/// The numbers of a [`Bitmap`]: red, green, blue, alpha for each pixel, top row first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Pixels {
    /// Eight bits a channel, 0 to 255 for 0 to 1.
    U8(Vec<[u8; 4]>),
    /// Sixteen bits a channel, 0 to 65535 for 0 to 1.
    U16(Vec<[u16; 4]>),
    /// Floating point, any value; always linear.
    F32(Vec<[f32; 4]>),
}

/// A decoded picture: four channels, alpha 1 where the file has none, gray repeated in all three colours.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bitmap {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// The numbers, `width · height` of them.
    pub pixels: Pixels,
    /// How the file says its numbers are meant; [`Pixels::F32`] is always linear.
    pub encoding: Encoding,
    /// False if the file has no alpha channel, so that every alpha is 1.
    pub has_alpha: bool,
}

impl Bitmap {
    /// The stored numbers of one pixel as fractions of one, not decoded.
    ///
    /// # Panics
    /// If the place is outside the bitmap.
    pub fn raw(&self, x: u32, y: u32) -> [f32; 4] {
        let at = y as usize * self.width as usize + x as usize;
        match &self.pixels {
            Pixels::U8(p) => p[at].map(|v| f32::from(v) / 255.0),
            Pixels::U16(p) => p[at].map(|v| f32::from(v) / 65535.0),
            Pixels::F32(p) => p[at],
        }
    }

    /// One pixel as linear light and alpha, read by `encoding`.
    ///
    /// # Panics
    /// If the place is outside the bitmap.
    pub fn linear(&self, x: u32, y: u32, encoding: Encoding) -> [f32; 4] {
        let at = y as usize * self.width as usize + x as usize;
        match (&self.pixels, encoding) {
            (Pixels::U8(p), Encoding::Srgb) => {
                let [r, g, b, a] = p[at];
                [srgb::decode_u8(r), srgb::decode_u8(g), srgb::decode_u8(b), f32::from(a) / 255.0]
            }
            (Pixels::U16(p), Encoding::Srgb) => {
                let [r, g, b, a] = p[at].map(|v| f32::from(v) / 65535.0);
                [srgb::decode(r), srgb::decode(g), srgb::decode(b), a]
            }
            _ => self.raw(x, y),
        }
    }

    /// The colours as linear light, alpha dropped.
    pub fn to_rgb(&self) -> Image<Rgb> {
        let pixels = (0..self.height)
            .flat_map(|y| (0..self.width).map(move |x| (x, y)))
            .map(|(x, y)| {
                let [r, g, b, _] = self.linear(x, y, self.encoding);
                Rgb::new(r, g, b)
            })
            .collect();
        Image::from_pixels(self.width, self.height, pixels).expect("one pixel for each place")
    }
}
