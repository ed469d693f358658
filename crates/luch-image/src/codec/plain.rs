//! BMP and TGA through the `image` crate: old formats that textures still come in, read only.

use super::guard::{Tracked, check_size, guarded};
use super::png::spread;
use super::{DecodeError, Format};
use crate::{Bitmap, Encoding, Pixels};
use image::codecs::{bmp::BmpDecoder, tga::TgaDecoder};
use image::error::{ImageError, ImageResult};
use image::{ColorType, ImageDecoder};
use std::cell::Cell;

/// Run lengths code at most 255 pixels in two bytes (BMP) or 128 in two (TGA); margin for skipped BMP rows.
const PIXELS_PER_BYTE: u64 = 1024;

/// A Windows bitmap.
pub(super) fn decode_bmp(bytes: &[u8]) -> Result<Bitmap, DecodeError> {
    decode_with(bytes, Format::Bmp, BmpDecoder::new)
}

/// A Truevision TGA.
pub(super) fn decode_tga(bytes: &[u8]) -> Result<Bitmap, DecodeError> {
    decode_with(bytes, Format::Tga, TgaDecoder::new)
}

fn decode_with<'a, D: ImageDecoder>(
    bytes: &'a [u8],
    format: Format,
    open: impl FnOnce(Tracked<'a>) -> ImageResult<D>,
) -> Result<Bitmap, DecodeError> {
    // The decoder borrows the position for as long as the bytes, so it is given away once for each file.
    guarded(format, || {
        let position: &Cell<u64> = &Cell::new(0);
        decode_tracked(bytes, position, format, open)
    })
}
