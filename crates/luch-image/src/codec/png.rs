//! PNG through the `png` crate (W3C Portable Network Graphics, third edition).

use super::guard::{Tracked, check_size, guarded};
use super::metadata::Reading;
use super::{DecodeError, EncodeError, Format, Metadata};
use crate::{Bitmap, Encoding, Image, Pixels};
use ::png::{
    BitDepth, ColorType, Decoder, DecodingError, Encoder, Info, Limits, Reader, SrgbRenderingIntent,
    Transformations,
};
use std::cell::Cell;

/// Deflate codes at most 1032 bytes in one (zlib technical details), a byte holds at most eight pixels.
const PIXELS_PER_BYTE: u64 = 8 * 1032;

/// Memory for one row and for the texts, beside the pixels.
const WORK_BYTES: usize = 64 << 20;

fn describe(error: DecodingError, position: u64) -> DecodeError {
    let reason = match error {
        DecodingError::LimitsExceeded => {
            return DecodeError::unsupported(Format::Png, "a row or text of more than 64 MiB");
        }
        other => other.to_string(),
    };
    DecodeError::Damaged { format: Format::Png, offset: Some(position), reason }
}

fn open<'a>(
    bytes: &'a [u8],
    position: &'a Cell<u64>,
    with_texts: bool,
) -> Result<Reader<Tracked<'a>>, DecodeError> {
    let mut decoder = Decoder::new_with_limits(Tracked::new(bytes, position), Limits { bytes: WORK_BYTES });
    decoder.set_ignore_text_chunk(!with_texts);
    decoder.set_transformations(Transformations::EXPAND);
    decoder.read_info().map_err(|error| describe(error, position.get()))
}

/// The picture; gray is repeated, palettes and transparent colours are resolved, one to four bits become eight.
pub(super) fn decode(bytes: &[u8]) -> Result<Bitmap, DecodeError> {
    guarded(Format::Png, || {
        let position = Cell::new(0);
        let mut reader = open(bytes, &position, false)?;
        let (width, height) = reader.info().size();
        check_size(Format::Png, width.into(), height.into(), 4, bytes.len(), PIXELS_PER_BYTE)?;
        let size = reader.output_buffer_size().ok_or(DecodeError::TooLarge {
            format: Format::Png,
            width: width.into(),
            height: height.into(),
            channels: 4,
        })?;
        let mut stored = vec![0; size];
        reader.next_frame(&mut stored).map_err(|error| describe(error, position.get()))?;
        let (color, depth) = reader.output_color_type();
        let pixels = match depth {
            BitDepth::Sixteen => {
                let numbers: Vec<u16> =
                    stored.as_chunks().0.iter().map(|&pair| u16::from_be_bytes(pair)).collect();
                Pixels::U16(spread(&numbers, color.samples(), u16::MAX))
            }
            _ => Pixels::U8(spread(&stored, color.samples(), u8::MAX)),
        };
        let has_alpha = matches!(color, ColorType::GrayscaleAlpha | ColorType::Rgba);
        Ok(Bitmap { width, height, pixels, encoding: encoding(reader.info()), has_alpha })
    })
}

/// Pixels of one to four numbers (gray, gray and alpha, colour, colour and alpha) as red, green, blue, alpha.
pub(super) fn spread<T: Copy>(numbers: &[T], channels: usize, opaque: T) -> Vec<[T; 4]> {
    match channels {
        1 => numbers.iter().map(|&g| [g, g, g, opaque]).collect(),
        2 => numbers.as_chunks().0.iter().map(|&[g, a]| [g, g, g, a]).collect(),
        3 => numbers.as_chunks().0.iter().map(|&[r, g, b]| [r, g, b, opaque]).collect(),
        _ => numbers.as_chunks().0.to_vec(),
    }
}

fn encoding(info: &Info) -> Encoding {
    let is_gamma_one = info.gama_chunk.is_some_and(|gamma| (gamma.into_value() - 1.0).abs() < 0.01);
    if is_gamma_one && info.srgb.is_none() { Encoding::Linear } else { Encoding::Srgb }
}

/// The text chunks before and after the pixels: uncompressed Latin-1, compressed Latin-1, then international ones.
pub(super) fn read_metadata(bytes: &[u8]) -> Result<Metadata, DecodeError> {
    guarded(Format::Png, || {
        let position = Cell::new(0);
        let mut reader = open(bytes, &position, true)?;
        reader.finish().map_err(|error| describe(error, position.get()))?;
        let info = reader.info();
        let mut texts = Reading::new(Format::Png);
        for chunk in &info.uncompressed_latin1_text {
            texts.add(&chunk.keyword, &*chunk.text)?;
        }
        for chunk in &info.compressed_latin1_text {
            texts.add(&chunk.keyword, chunk.get_text().map_err(|error| describe(error, position.get()))?)?;
        }
        for chunk in &info.utf8_text {
            texts.add(&chunk.keyword, chunk.get_text().map_err(|error| describe(error, position.get()))?)?;
        }
        Ok(texts.finish())
    })
}

/// A PNG of 8 bits a channel, marked as sRGB; the texts become international text chunks.
///
/// # Errors
/// [`EncodeError`] for an empty picture or texts that cannot be stored.
pub fn encode_png8(image: &Image<[u8; 3]>, metadata: &Metadata) -> Result<Vec<u8>, EncodeError> {
    encode(image.width(), image.height(), BitDepth::Eight, image.pixels().as_flattened(), metadata)
}

/// A PNG of 16 bits a channel, marked as sRGB; the texts become international text chunks.
///
/// # Errors
/// [`EncodeError`] for an empty picture or texts that cannot be stored.
pub fn encode_png16(image: &Image<[u16; 3]>, metadata: &Metadata) -> Result<Vec<u8>, EncodeError> {
    let bytes: Vec<u8> = image.pixels().as_flattened().iter().flat_map(|v| v.to_be_bytes()).collect();
    encode(image.width(), image.height(), BitDepth::Sixteen, &bytes, metadata)
}

fn encode(
    width: u32,
    height: u32,
    depth: BitDepth,
    data: &[u8],
    metadata: &Metadata,
) -> Result<Vec<u8>, EncodeError> {
    EncodeError::check_size(Format::Png, width, height, i32::MAX as u32)?;
    // What is longer could not be read back in the reader's working memory.
    metadata.check(Format::Png, WORK_BYTES / 4)?;
    let refuse = |error: ::png::EncodingError| EncodeError::refused(Format::Png, error);
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(depth);
    encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    for (key, value) in metadata.iter() {
        encoder.add_itxt_chunk(key.to_owned(), value.to_owned()).map_err(refuse)?;
    }
    let mut writer = encoder.write_header().map_err(refuse)?;
    writer.write_image_data(data).map_err(refuse)?;
    writer.finish().map_err(refuse)?;
    Ok(bytes)
}
