//! JPEG (ITU-T T.81): read through the `image` crate, written through `jpeg-encoder`; texts in comment segments.

use super::guard::{Tracked, guarded};
use super::metadata::Reading;
use super::{DecodeError, EncodeError, Format, Metadata, plain};
use crate::{Bitmap, Image};
use ::jpeg_encoder::{ColorType, Encoder};
use image::codecs::jpeg::JpegDecoder;
use std::cell::Cell;

/// Every block of 64 pixels takes at least one bit; twice that as a margin.
const PIXELS_PER_BYTE: u64 = 1024;

/// A segment's length has two bytes and counts itself (T.81, B.1.1.4).
const LONGEST_SEGMENT: usize = 0xffff - 2;

/// The picture. The library fills what a cut file lacks with gray, so the end mark is looked for first.
pub(super) fn decode(bytes: &[u8]) -> Result<Bitmap, DecodeError> {
    segments(bytes)?;
    guarded(Format::Jpeg, || {
        let position = Cell::new(0);
        let decoder = JpegDecoder::new(Tracked::new(bytes, &position));
        plain::read(Format::Jpeg, decoder, bytes.len(), PIXELS_PER_BYTE, &position)
    })
    .map_err(|error| match error {
        // The library reads everything before it decodes: its position says nothing.
        DecodeError::Damaged { format, reason, .. } => DecodeError::Damaged { format, offset: None, reason },
        other => other,
    })
}

/// One marker segment.
struct Segment<'a> {
    marker: u8,
    payload: &'a [u8],
}

const START_OF_IMAGE: u8 = 0xd8;
const END_OF_IMAGE: u8 = 0xd9;
const START_OF_SCAN: u8 = 0xda;
const COMMENT: u8 = 0xfe;

/// All segments with contents, up to the end mark.
fn segments(bytes: &[u8]) -> Result<Vec<Segment<'_>>, DecodeError> {
    let cut =
        || DecodeError::damaged_at(Format::Jpeg, bytes.len(), "the file ends before its end mark (FF D9)");
    if !bytes.starts_with(&[0xff, START_OF_IMAGE]) {
        return Err(DecodeError::damaged_at(Format::Jpeg, 0, "the start mark (FF D8) is missing"));
    }
    let mut found = Vec::new();
    let mut at = 2;
    let mut is_in_scan = false;
    loop {
        // Entropy-coded bytes of a scan run on to the next mark; elsewhere stray bytes are tolerated as fill.
        at += bytes.get(at..).and_then(|rest| rest.iter().position(|&b| b == 0xff)).ok_or_else(cut)?;
        let marker = *bytes.get(at + 1).ok_or_else(cut)?;
        match marker {
            0xff => at += 1,
            0x00 | 0x01 | 0xd0..=0xd8 => at += 2,
            END_OF_IMAGE if is_in_scan => return Ok(found),
            END_OF_IMAGE => {
                return Err(DecodeError::damaged_at(Format::Jpeg, at, "the end mark comes before any scan"));
            }
            _ => {
                let length = bytes.get(at + 2..at + 4).ok_or_else(cut)?;
                let length = usize::from(u16::from_be_bytes([length[0], length[1]]));
                if length < 2 {
                    let reason = format!("a segment of length {length}; it counts itself, so 2 is the least");
                    return Err(DecodeError::damaged_at(Format::Jpeg, at + 2, reason));
                }
                let payload = bytes.get(at + 4..at + 2 + length).ok_or_else(cut)?;
                found.push(Segment { marker, payload });
                is_in_scan |= marker == START_OF_SCAN;
                at += 2 + length;
            }
        }
    }
}

/// Comment segments of the form `key=text`; one without `=` becomes the text of `Comment`.
pub(super) fn read_metadata(bytes: &[u8]) -> Result<Metadata, DecodeError> {
    let mut texts = Reading::new(Format::Jpeg);
    for segment in segments(bytes)?.iter().filter(|segment| segment.marker == COMMENT) {
        let text = String::from_utf8_lossy(segment.payload);
        let (key, value) = text.split_once('=').unwrap_or(("Comment", text.trim_end_matches('\0')));
        texts.add(key, value)?;
    }
    Ok(texts.finish())
}

/// A JPEG of `quality` 1 (small) to 100 (good), other values taken to the nearer end; below 90 colour has half the
/// resolution. Each text becomes a comment segment `key=text` in UTF-8, at most 65532 bytes.
///
/// # Errors
/// [`EncodeError`] for a side of 0 or above 65535, or texts that cannot be stored.
pub fn encode_jpeg(image: &Image<[u8; 3]>, quality: u8, metadata: &Metadata) -> Result<Vec<u8>, EncodeError> {
    EncodeError::check_size(Format::Jpeg, image.width(), image.height(), u16::MAX.into())?;
    metadata.check(Format::Jpeg, LONGEST_SEGMENT - 1)?;
    let mut plain = Vec::new();
    Encoder::new(&mut plain, quality.clamp(1, 100))
        .encode(image.pixels().as_flattened(), image.width() as u16, image.height() as u16, ColorType::Rgb)
        .map_err(|error| EncodeError::refused(Format::Jpeg, error))?;

    // Comments follow the JFIF segment, which must come first.
    let first = 2 + 2 + usize::from(u16::from_be_bytes([plain[4], plain[5]]));
    let mut bytes = plain[..first].to_vec();
    for (key, value) in metadata.iter() {
        let text = format!("{key}={value}");
        bytes.extend([0xff, COMMENT]);
        bytes.extend((text.len() as u16 + 2).to_be_bytes());
        bytes.extend(text.as_bytes());
    }
    bytes.extend(&plain[first..]);
    Ok(bytes)
}
