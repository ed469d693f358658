//! Colour, pixels, image files and comparison.
//!
//! - [`Rgb`]: linear light in Rec. 709 primaries; [`Image`]: a rectangle of pixels of any kind, top row first.
//! - [`Bitmap`]: a picture as a file holds it (8 or 16 bits or floating point, four channels).
//! - [`codec`]: bytes to pictures and back. It reads PNG, JPEG, BMP, TGA, Radiance HDR, OpenEXR, PFM and NPY, and never
//!   touches the disk.
//! - [`tone`]: exposure and display curves, from scene light to numbers a screen shows.
//! - [`compare`](mod@compare): how far two pictures are apart, in numbers and as a picture.
//! - [`srgb`]: the transfer curve between light and stored numbers.
//!
//! ```
//! use luch_image::codec::{self, Metadata};
//! use luch_image::{Image, Rgb, compare::compare, tone::{Curve, Tone}};
//!
//! // A ramp of light, from black to four times white.
//! let light = Image::from_pixels(64, 1, (0..64).map(|i| Rgb::gray(i as f32 / 16.0)).collect()).unwrap();
//!
//! // Shown on a screen: one stop darker, highlights rolled off; the settings travel in the file.
//! let tone = Tone { exposure: -1.0, curve: Curve::PbrNeutral };
//! let metadata = Metadata::from([("Software", "luch"), ("Exposure", "-1")]);
//! let png = codec::encode_png8(&tone.to_u8(&light), &metadata)?;
//! assert_eq!(codec::read_metadata(&png)?.get("Exposure"), Some("-1"));
//!
//! // Kept as light: PFM and OpenEXR give back the same bits.
//! let pfm = codec::encode_pfm(&light)?;
//! let again = codec::decode(&pfm, None)?.to_rgb();
//! assert_eq!(compare(&light, &again)?.mse, 0.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod bitmap;
pub mod codec;
pub mod compare;
mod image;
mod pyramid;
mod rgb;
pub mod srgb;
mod sum;
pub mod tone;

pub use bitmap::{Bitmap, Encoding, Pixels};
pub use image::Image;
pub use pyramid::Pyramid;
pub use rgb::Rgb;

/// The README's example, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExample;
