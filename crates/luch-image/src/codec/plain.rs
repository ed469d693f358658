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
    guarded(Format::Bmp, || {
        let position = Cell::new(0);
        let decoder = BmpDecoder::new(Tracked::new(bytes, &position));
        read(Format::Bmp, decoder, bytes.len(), PIXELS_PER_BYTE, &position)
    })
}

/// A Truevision TGA.
pub(super) fn decode_tga(bytes: &[u8]) -> Result<Bitmap, DecodeError> {
    guarded(Format::Tga, || {
        let position = Cell::new(0);
        let decoder = TgaDecoder::new(Tracked::new(bytes, &position));
        read(Format::Tga, decoder, bytes.len(), PIXELS_PER_BYTE, &position)
    })
}

/// All pixels of an opened file of eight bits a channel.
pub(super) fn read(
    format: Format,
    decoder: ImageResult<impl ImageDecoder>,
    file_size: usize,
    pixels_per_byte: u64,
    position: &Cell<u64>,
) -> Result<Bitmap, DecodeError> {
    let describe = |error| describe(format, error, position.get());
    let decoder = decoder.map_err(describe)?;
    let (width, height) = decoder.dimensions();
    let color = decoder.color_type();
    let channels = color.channel_count();
    check_size(format, width.into(), height.into(), channels.into(), file_size, pixels_per_byte)?;
    if !matches!(color, ColorType::L8 | ColorType::La8 | ColorType::Rgb8 | ColorType::Rgba8) {
        return Err(DecodeError::unsupported(format, format!("a picture of kind {color:?}")));
    }
    let mut stored = vec![0; width as usize * height as usize * usize::from(channels)];
    decoder.read_image(&mut stored).map_err(describe)?;
    let pixels = Pixels::U8(spread(&stored, channels.into(), u8::MAX));
    Ok(Bitmap { width, height, pixels, encoding: Encoding::Srgb, has_alpha: color.has_alpha() })
}

fn describe(format: Format, error: ImageError, position: u64) -> DecodeError {
    match error {
        ImageError::Unsupported(what) => DecodeError::unsupported(format, what.to_string()),
        other => DecodeError::Damaged { format, offset: Some(position), reason: other.to_string() },
    }
}
