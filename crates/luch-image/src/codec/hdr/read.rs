//! Reads Radiance pictures.

use super::{RUN_WIDTHS, rgbe};
use crate::codec::guard::check_size;
use crate::codec::metadata::Reading;
use crate::codec::{DecodeError, Format, Metadata};
use crate::{Bitmap, Encoding, Pixels};

/// A run codes at most 127 pixels of one channel in two bytes; old files may repeat more, up to this.
const PIXELS_PER_BYTE: u64 = 1024;

fn damaged(at: usize, reason: impl Into<String>) -> DecodeError {
    DecodeError::damaged_at(Format::Hdr, at, reason)
}

/// What the text before the pixels says.
struct Header {
    metadata: Metadata,
    /// Product of all EXPOSURE lines: what the stored numbers were multiplied with.
    exposure: f32,
    width: u32,
    height: u32,
    is_bottom_first: bool,
    is_right_first: bool,
    /// Where the pixels begin.
    end: usize,
}

/// The picture in watts per steradian and square metre: stored numbers divided by the EXPOSURE lines.
pub(in crate::codec) fn decode(bytes: &[u8]) -> Result<Bitmap, DecodeError> {
    let header = read_header(bytes)?;
    let (width, height) = (header.width, header.height);
    check_size(Format::Hdr, width.into(), height.into(), 4, bytes.len(), PIXELS_PER_BYTE)?;
    let mut lines = Lines { bytes, at: header.end, row: Vec::new() };
    let mut pixels: Vec<[f32; 4]> = Vec::new();
    for _ in 0..height {
        lines.read(width as usize)?;
        let light = lines.row.iter().map(|&pixel| {
            let light = rgbe::decode(pixel) / header.exposure;
            [light.r, light.g, light.b, 1.0]
        });
        if header.is_right_first { pixels.extend(light.rev()) } else { pixels.extend(light) }
    }
    if header.is_bottom_first {
        pixels = pixels.chunks_exact(width as usize).rev().flatten().copied().collect();
    }
    Ok(Bitmap { width, height, pixels: Pixels::F32(pixels), encoding: Encoding::Linear, has_alpha: false })
}

/// Comment lines `# key=text` and header lines `KEY=text` other than FORMAT.
pub(in crate::codec) fn read_metadata(bytes: &[u8]) -> Result<Metadata, DecodeError> {
    read_header(bytes).map(|header| header.metadata)
}

fn read_header(bytes: &[u8]) -> Result<Header, DecodeError> {
    let mut at = 0;
    let mut next_line = || {
        let start = at;
        let length = bytes[at..].iter().position(|&b| b == b'\n');
        let length = length.ok_or_else(|| damaged(bytes.len(), "the file ends in its header"))?;
        at += length + 1;
        let text = String::from_utf8_lossy(&bytes[start..start + length]);
        Ok((start, at, text.trim_end_matches('\r').to_owned()))
    };
    let (_, _, first) = next_line()?;
    if !first.starts_with("#?") {
        return Err(damaged(
            0,
            format!("the first line is {:?}; it must start with #?RADIANCE or #?RGBE", start_of(&first)),
        ));
    }
    let (mut texts, mut exposure) = (Reading::new(Format::Hdr), 1.0f32);
    loop {
        let (start, _, line) = next_line()?;
        if line.is_empty() {
            break;
        }
        let Some((key, value)) = line.trim_start_matches(['#', ' ']).split_once('=') else { continue };
        match (line.starts_with('#'), key) {
            (false, "FORMAT") if value.trim() != "32-bit_rle_rgbe" => {
                let what = format!("pixel format {:?} (32-bit_rle_rgbe is read)", start_of(value));
                return Err(DecodeError::unsupported(Format::Hdr, what));
            }
            (false, "FORMAT") => {}
            (false, "EXPOSURE") => {
                exposure *= value.trim().parse::<f32>().unwrap_or(f32::NAN);
                if !exposure.is_normal() || exposure < 0.0 {
                    return Err(damaged(
                        start,
                        format!("EXPOSURE is {:?}; it must be a positive number", start_of(value)),
                    ));
                }
                texts.add(key, value)?;
            }
            _ => texts.add(key, unescape(value))?,
        }
    }
    let (start, end, line) = next_line()?;
    let words: Vec<&str> = line.split_ascii_whitespace().collect();
    let (is_bottom_first, is_right_first) = match words[..] {
        ["-Y", _, "+X", _] => (false, false),
        ["-Y", _, "-X", _] => (false, true),
        ["+Y", _, "+X", _] => (true, false),
        ["+Y", _, "-X", _] => (true, true),
        [x, _, y, _] if x.ends_with('X') && y.ends_with('Y') => {
            return Err(DecodeError::unsupported(
                Format::Hdr,
                format!("pixels stored in columns ({:?})", start_of(&line)),
            ));
        }
        _ => {
            return Err(damaged(
                start,
                format!("the size is {:?}; it must read like \"-Y 480 +X 640\"", start_of(&line)),
            ));
        }
    };
    let side = |word: &str| {
        word.parse().map_err(|_| {
            damaged(start, format!("the size holds {:?}; it must be a whole number", start_of(word)))
        })
    };
    let (height, width) = (side(words[1])?, side(words[3])?);
    Ok(Header { metadata: texts.finish(), exposure, width, height, is_bottom_first, is_right_first, end })
}

/// As much of a line as a message needs.
fn start_of(text: &str) -> &str {
    &text[..text.floor_char_boundary(60)]
}

fn unescape(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut letters = text.chars();
    while let Some(letter) = letters.next() {
        match letter {
            '\\' => match letters.next() {
                Some('n') => plain.push('\n'),
                Some('r') => plain.push('\r'),
                Some('\\') => plain.push('\\'),
                other => plain.extend(['\\'].into_iter().chain(other)),
            },
            _ => plain.push(letter),
        }
    }
    plain
}

/// The scan lines, one after another.
struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
    row: Vec<[u8; 4]>,
}

impl Lines<'_> {
    /// Reads one line into `row`.
    fn read(&mut self, width: usize) -> Result<(), DecodeError> {
        self.row.clear();
        match self.bytes.get(self.at..self.at + 4) {
            Some(&[2, 2, high, low]) if high < 128 && RUN_WIDTHS.contains(&width) => {
                let stored = usize::from(high) << 8 | usize::from(low);
                if stored != width {
                    return Err(damaged(
                        self.at,
                        format!("a line of {stored} pixels in a picture of width {width}"),
                    ));
                }
                self.at += 4;
                self.read_channels(width)
            }
            _ => self.read_flat(width),
        }
    }

    fn read_channels(&mut self, width: usize) -> Result<(), DecodeError> {
        self.row.resize(width, [0; 4]);
        for channel in 0..4 {
            let mut x = 0;
            while x < width {
                let start = self.at;
                let [code] = self.take()?;
                let count = usize::from(if code > 128 { code - 128 } else { code });
                if count == 0 || x + count > width {
                    return Err(damaged(
                        start,
                        format!("a run of {count} at pixel {x} of a line of {width}"),
                    ));
                }
                let repeated = if code > 128 { Some(self.take::<1>()?[0]) } else { None };
                for pixel in &mut self.row[x..x + count] {
                    pixel[channel] = match repeated {
                        Some(byte) => byte,
                        None => {
                            let byte =
                                self.bytes.get(self.at).ok_or_else(|| damaged(self.bytes.len(), END))?;
                            self.at += 1;
                            *byte
                        }
                    };
                }
                x += count;
            }
        }
        Ok(())
    }

    /// Whole pixels; in old files 1, 1, 1, n repeats the one before n times, further such codes in a row count
    /// n·256, n·65536 and so on.
    fn read_flat(&mut self, width: usize) -> Result<(), DecodeError> {
        let mut shift = 0;
        while self.row.len() < width {
            let start = self.at;
            let pixel = self.take()?;
            match (pixel, self.row.last().copied()) {
                ([1, 1, 1, count], Some(last)) => {
                    let count = if shift < 32 { usize::from(count) << shift } else { usize::MAX };
                    if count > width - self.row.len() {
                        return Err(damaged(start, format!("a run of {count} in a line of {width}")));
                    }
                    self.row.resize(self.row.len() + count, last);
                    shift += 8;
                }
                _ => {
                    self.row.push(pixel);
                    shift = 0;
                }
            }
        }
        Ok(())
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N], DecodeError> {
        let found = self.bytes.get(self.at..).and_then(|rest| rest.first_chunk());
        let found = found.ok_or_else(|| damaged(self.bytes.len(), END))?;
        self.at += N;
        Ok(*found)
    }
}

const END: &str = "the file ends within the pixels";

#[cfg(test)]
mod tests {
    use super::*;

    fn file(head: &str, pixels: &[u8]) -> Vec<u8> {
        [head.as_bytes(), pixels].concat()
    }

    #[test]
    fn old_runs_exposure_and_flips() {
        // One pixel of light 1, repeated three times, seen through exposure 2 · 2.
        let head = "#?RGBE\nEXPOSURE=2\nEXPOSURE= 2.0\n\n";
        let pixels = [128, 128, 128, 129, 1, 1, 1, 3, 128, 0, 0, 129];
        for (size, place) in [("-Y 1 +X 5\n", 4), ("-Y 1 -X 5\n", 0), ("+Y 5 +X 1\n", 0)] {
            // In the last case each line is one pixel, where nothing can be repeated: written out instead.
            let pixels: Vec<u8> = if size.starts_with('+') {
                [[128, 128, 128, 129].repeat(4), vec![128, 0, 0, 129]].concat()
            } else {
                pixels.to_vec()
            };
            let bitmap = decode(&file(&format!("{head}{size}"), &pixels)).unwrap();
            let Pixels::F32(got) = bitmap.pixels else { panic!("floats") };
            for (i, pixel) in got.iter().enumerate() {
                let expected = if i == place { [0.25, 0.0, 0.0, 1.0] } else { [0.25, 0.25, 0.25, 1.0] };
                assert_eq!(*pixel, expected, "{size} {i}");
            }
        }
    }

    #[test]
    fn runs_beyond_the_line_are_errors() {
        let head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n";
        for pixels in [
            &[2, 2, 0, 8, 128 + 9, 7][..],
            &[2, 2, 0, 8, 0],
            &[2, 2, 0, 9, 128 + 8, 7],
            &[9, 9, 9, 9, 1, 1, 1, 8],
        ] {
            assert!(matches!(decode(&file(head, pixels)), Err(DecodeError::Damaged { offset: Some(_), .. })));
        }
    }

    #[test]
    fn escapes_come_back() {
        assert_eq!(unescape(r"a\\nb\nc\x\"), "a\\nb\nc\\x\\");
    }
}
