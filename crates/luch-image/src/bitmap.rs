//! An image as it came from a file, kept in the form it had there.

use crate::sum::Sum;
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
    /// A bitmap of linear light without alpha, every bit kept.
    pub fn from_rgb(image: &Image<Rgb>) -> Self {
        let pixels = image.pixels().iter().map(|light| [light.r, light.g, light.b, 1.0]).collect();
        Self {
            width: image.width(),
            height: image.height(),
            pixels: Pixels::F32(pixels),
            encoding: Encoding::Linear,
            has_alpha: false,
        }
    }

    /// Memory the pixels take, in bytes.
    pub fn memory_bytes(&self) -> usize {
        match &self.pixels {
            Pixels::U8(p) => size_of_val(p.as_slice()),
            Pixels::U16(p) => size_of_val(p.as_slice()),
            Pixels::F32(p) => size_of_val(p.as_slice()),
        }
    }

    /// The mean of linear light and alpha over all pixels, read by the file's own encoding; colour is not weighed by
    /// alpha. NaN if there is no pixel.
    pub fn average(&self) -> [f32; 4] {
        let mut sums = [Sum::default(); 4];
        for y in 0..self.height {
            for x in 0..self.width {
                let pixel = self.linear(x, y, self.encoding);
                sums.iter_mut().zip(pixel).for_each(|(sum, value)| sum.add(value.into()));
            }
        }
        let count = f64::from(self.width) * f64::from(self.height);
        sums.map(|sum| (sum.value() / count) as f32)
    }

    /// The stored numbers of one pixel as fractions of one, not decoded.
    ///
    /// # Panics
    /// If the place is outside the bitmap.
    #[inline]
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
    #[inline]
    pub fn linear(&self, x: u32, y: u32, encoding: Encoding) -> [f32; 4] {
        let at = y as usize * self.width as usize + x as usize;
        match (&self.pixels, encoding) {
            (Pixels::U8(p), Encoding::Srgb) => {
                let [r, g, b, a] = p[at];
                [srgb::decode_u8(r), srgb::decode_u8(g), srgb::decode_u8(b), f32::from(a) / 255.0]
            }
            (Pixels::U16(p), Encoding::Srgb) => {
                let [r, g, b, a] = p[at];
                [srgb::decode_u16(r), srgb::decode_u16(g), srgb::decode_u16(b), f32::from(a) / 65535.0]
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_in_light_out() {
        let image =
            Image::from_pixels(2, 1, vec![Rgb::new(1.0, 2.0, -3.0), Rgb::new(0.0, 1.0, 7.0)]).unwrap();
        let bitmap = Bitmap::from_rgb(&image);
        assert_eq!(bitmap.to_rgb(), image);
        assert_eq!(bitmap.average(), [0.5, 1.5, 2.0, 1.0]);
        assert_eq!(bitmap.memory_bytes(), 32);
    }

    #[test]
    fn the_average_is_that_of_light() {
        let pixels = Pixels::U8(vec![[0, 0, 0, 255], [255, 255, 255, 0]]);
        let bitmap = Bitmap { width: 1, height: 2, pixels, encoding: Encoding::Srgb, has_alpha: true };
        assert_eq!(bitmap.average(), [0.5; 4]);
        let wide = Pixels::U16(vec![[0x8080; 4]; 2]);
        let wide = Bitmap { pixels: wide, ..bitmap };
        // 0x8080 of 65535 is 128 of 255.
        assert!((wide.average()[0] - srgb::decode_u8(128)).abs() < 1e-7);
    }
}
