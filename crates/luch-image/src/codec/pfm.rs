//! Portable float map (Paul Debevec): a text header, then 32-bit floats, bottom row first.
//!
//! ```text
//! PF            colour (Pf: gray)
//! 640 480       width, height
//! -1.0          negative: little-endian; the magnitude is a unit of no agreed meaning and is not applied
//! ```

use super::guard::check_size;
use super::{DecodeError, EncodeError, Format};
use crate::{Bitmap, Encoding, Image, Pixels, Rgb};

/// The picture, every bit as stored.
pub(super) fn decode(bytes: &[u8]) -> Result<Bitmap, DecodeError> {
    let mut header = Header { bytes, at: 0 };
    let channels: usize = match header.word()? {
        "PF" => 3,
        "Pf" => 1,
        "PF4" => return Err(DecodeError::unsupported(Format::Pfm, "a map with alpha (PF4)")),
        other => {
            let reason = format!("the file starts with {other:?}; a float map starts with PF or Pf");
            return Err(DecodeError::damaged_at(Format::Pfm, 0, reason));
        }
    };
    let width: u32 = header.number("width", "a whole number")?;
    let height: u32 = header.number("height", "a whole number")?;
    let scale: f32 = header.number("scale", "a number, negative for little-endian")?;
    if scale == 0.0 || !scale.is_finite() {
        let reason =
            format!("the scale is {scale}; it must be negative (little-endian) or positive (big-endian)");
        return Err(DecodeError::damaged_at(Format::Pfm, header.at, reason));
    }

    // One white space byte ends the header; the rest are numbers.
    let start = (header.at + 1).min(bytes.len());
    check_size(Format::Pfm, width.into(), height.into(), channels as u64, bytes.len(), 1)?;
    let (width, height) = (width as usize, height as usize);
    let row_bytes = width * channels * 4;
    let data = &bytes[start..];
    if data.len() < row_bytes * height {
        let reason =
            format!("{} bytes of pixels follow the header; {} are needed", data.len(), row_bytes * height);
        return Err(DecodeError::damaged_at(Format::Pfm, bytes.len(), reason));
    }
    let read: fn([u8; 4]) -> f32 = if scale < 0.0 { f32::from_le_bytes } else { f32::from_be_bytes };
    let mut pixels = Vec::with_capacity(width * height);
    for row in data[..row_bytes * height].chunks_exact(row_bytes).rev() {
        let mut numbers = row.as_chunks().0.iter().map(|&four| read(four));
        for _ in 0..width {
            let mut next = || numbers.next().unwrap_or_default();
            let r = next();
            let (g, b) = if channels == 3 { (next(), next()) } else { (r, r) };
            pixels.push([r, g, b, 1.0]);
        }
    }
    Ok(Bitmap {
        width: width as u32,
        height: height as u32,
        pixels: Pixels::F32(pixels),
        encoding: Encoding::Linear,
        has_alpha: false,
    })
}

struct Header<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Header<'a> {
    /// The next word; comment lines (`#`) before it are skipped, as netpbm tools write them.
    fn word(&mut self) -> Result<&'a str, DecodeError> {
        loop {
            self.at += self.rest().iter().take_while(|b| b.is_ascii_whitespace()).count();
            if self.rest().first() != Some(&b'#') {
                break;
            }
            self.at += self.rest().iter().take_while(|&&b| b != b'\n').count();
        }
        let length = self.rest().iter().take(40).take_while(|b| b.is_ascii_graphic()).count();
        let word = str::from_utf8(&self.rest()[..length]).unwrap_or_default();
        if word.is_empty() {
            return Err(DecodeError::damaged_at(Format::Pfm, self.at, "the header ends too early"));
        }
        self.at += length;
        Ok(word)
    }

    fn number<T: std::str::FromStr>(&mut self, what: &str, accepted: &str) -> Result<T, DecodeError> {
        let word = self.word()?;
        word.parse().map_err(|_| {
            let reason = format!("the {what} is {word:?}; it must be {accepted}");
            DecodeError::damaged_at(Format::Pfm, self.at - word.len(), reason)
        })
    }

    fn rest(&self) -> &'a [u8] {
        &self.bytes[self.at..]
    }
}

/// A little-endian colour float map, every bit kept.
///
/// # Errors
/// [`EncodeError::Size`] for an empty picture.
pub fn encode_pfm(image: &Image<Rgb>) -> Result<Vec<u8>, EncodeError> {
    let (width, height) = (image.width(), image.height());
    EncodeError::check_size(Format::Pfm, width, height, i32::MAX as u32)?;
    let mut bytes = format!("PF\n{width} {height}\n-1.0\n").into_bytes();
    bytes.reserve(image.pixels().len() * 12);
    for row in image.pixels().chunks_exact(width as usize).rev() {
        for value in row.iter().flat_map(|pixel| pixel.to_array()) {
            bytes.extend(value.to_le_bytes());
        }
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_byte_orders_and_gray_read_alike() {
        let values = [0.5f32, f32::NAN, 3.0e-40, f32::NEG_INFINITY];
        for (scale, write) in [("-1", f32::to_le_bytes as fn(f32) -> [u8; 4]), ("2.5", f32::to_be_bytes)] {
            let mut bytes = format!("Pf\n# a comment\n2 2\n{scale}\n").into_bytes();
            bytes.extend(values.iter().flat_map(|&v| write(v)));
            let bitmap = decode(&bytes).unwrap();
            // The first row stored is the lowest.
            let expected = [values[2], values[3], values[0], values[1]].map(f32::to_bits);
            let got: Vec<u32> = (0..4).map(|i| bitmap.raw(i % 2, i / 2)[1].to_bits()).collect();
            assert_eq!(got, expected);
        }
    }

    #[test]
    fn errors_say_where_and_what() {
        for (text, part) in [
            ("PF\n2 x\n-1\n", "byte 5: the height is \"x\""),
            ("PF\n2 2\n0\n", "scale is 0"),
            ("PF\n2 2\n-1\nabc", "3 bytes of pixels"),
            ("PF\n2", "header ends"),
            ("PF\n0 2\n-1\n", "empty (0×2)"),
        ] {
            let message = decode(text.as_bytes()).unwrap_err().to_string();
            assert!(message.contains(part) || message.contains("cannot be coded"), "{text:?}: {message}");
        }
    }
}
