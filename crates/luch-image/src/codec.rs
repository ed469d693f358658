//! Image files: bytes to pictures and back.
//!
//! Every function takes or returns bytes; files are the caller's. Each format lies in one file beside this one, thin
//! over the library that does the work. Input is never trusted: sizes are checked before memory is taken, a damaged
//! file is a [`DecodeError`], and all encoders give the same bytes every time.
//!
//! | format | reads | writes | metadata |
//! | --- | --- | --- | --- |
//! | PNG | all kinds, 8 and 16 bit | 8 and 16 bit RGB, exact | text chunks |
//! | JPEG | baseline and progressive | RGB, lossy | comment segments |
//! | BMP, TGA | 8 bit a channel | no | none |
//! | HDR | Radiance RGBE | 8-bit mantissa, shared exponent | comment lines |
//! | EXR | flat scan lines and tiles, largest level | 32-bit float layers, exact | string attributes |
//! | PFM | both byte orders, gray and colour | 32-bit float, exact | none |
//! | NPY | 32- and 64-bit float, gray, colour and alpha | 32-bit float, exact | none |

mod error;
mod exr;
mod format;
mod guard;
mod hdr;
mod jpeg;
mod layers;
mod metadata;
mod npy;
mod pfm;
mod plain;
mod png;

pub use error::{DecodeError, EncodeError};
pub use exr::{decode_exr_layers, encode_exr};
pub use format::Format;
pub use hdr::encode_hdr;
pub use jpeg::encode_jpeg;
pub use layers::{Layer, Layers};
pub use metadata::Metadata;
pub use npy::encode_npy;
pub use pfm::encode_pfm;
pub use png::{encode_png8, encode_png16};

use crate::Bitmap;

/// The most pixels a file may claim: 2²⁸, a square of 16384.
pub const MAX_PIXELS: u64 = 1 << 28;

/// The picture in `bytes`.
///
/// Without a `format` it is told from the first bytes ([`Format::from_magic`]). Orientation tags, colour profiles and
/// gamma (other than gamma 1 of PNG, which makes the numbers linear) are not applied. Infinite and NaN values of
/// OpenEXR, PFM and NPY stay as they are.
///
/// # Errors
/// [`DecodeError`] if the format is unknown, the file is damaged, cut short or too large, or holds what is not
/// supported. A file whose pixels are complete and whose trailing bytes alone are missing may decode.
pub fn decode(bytes: &[u8], format: Option<Format>) -> Result<Bitmap, DecodeError> {
    match find_format(bytes, format)? {
        Format::Png => png::decode(bytes),
        Format::Jpeg => jpeg::decode(bytes),
        Format::Bmp => plain::decode_bmp(bytes),
        Format::Tga => plain::decode_tga(bytes),
        Format::Hdr => hdr::decode(bytes),
        Format::Exr => exr::decode(bytes),
        Format::Pfm => pfm::decode(bytes),
        Format::Npy => npy::decode(bytes),
    }
}

/// The texts stored in a file, in the order they stand there; empty for formats that hold none.
///
/// # Errors
/// [`DecodeError`] if the format is unknown or the file is damaged where the texts are.
pub fn read_metadata(bytes: &[u8]) -> Result<Metadata, DecodeError> {
    match find_format(bytes, None)? {
        Format::Png => png::read_metadata(bytes),
        Format::Jpeg => jpeg::read_metadata(bytes),
        Format::Hdr => hdr::read_metadata(bytes),
        Format::Exr => exr::read_metadata(bytes),
        Format::Bmp | Format::Tga | Format::Pfm | Format::Npy => Ok(Metadata::default()),
    }
}

fn find_format(bytes: &[u8], format: Option<Format>) -> Result<Format, DecodeError> {
    format
        .or_else(|| Format::from_magic(bytes))
        .ok_or_else(|| DecodeError::UnknownFormat { start: error::quote_bytes(bytes) })
}
