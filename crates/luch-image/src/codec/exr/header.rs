//! The header of an OpenEXR file ("OpenEXR file layout", Academy Software Foundation): attributes of each part.

use crate::codec::guard::check_size;
use crate::codec::{DecodeError, Format};

/// One attribute with its raw value.
pub(super) struct Attribute<'a> {
    pub(super) name: String,
    pub(super) kind: String,
    pub(super) value: &'a [u8],
    /// Where the value lies in the file.
    pub(super) offset: usize,
}

/// The attributes of one part, and what is needed of them here.
pub(super) struct Part<'a> {
    pub(super) attributes: Vec<Attribute<'a>>,
    pub(super) channels: Vec<String>,
    pub(super) data_window: Window,
    pub(super) display_window: Window,
    /// Where the attributes end.
    pub(super) end: usize,
}

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Window {
    pub(super) x: i64,
    pub(super) y: i64,
    pub(super) width: u64,
    pub(super) height: u64,
}

/// Bits of the version field.
const DEEP: u32 = 1 << 11;
const MULTI_PART: u32 = 1 << 12;

/// Most parts, channels in all parts and attributes of a part that are looked at: real files have tens.
const MOST_PARTS: usize = 256;
const MOST_CHANNELS: usize = 4096;
const MOST_ATTRIBUTES: usize = 65536;

pub(super) fn damaged(offset: usize, reason: impl Into<String>) -> DecodeError {
    DecodeError::damaged_at(Format::Exr, offset, reason)
}

/// All parts, checked against limits and against what can be read.
pub(super) fn read_parts(bytes: &[u8]) -> Result<Vec<Part<'_>>, DecodeError> {
    let mut cursor = Cursor { bytes, at: 0 };
    if cursor.take(4)? != b"\x76\x2f\x31\x01" {
        return Err(damaged(0, "the mark 76 2F 31 01 is missing"));
    }
    let version = cursor.number()?;
    if version & 0xff != 2 {
        return Err(DecodeError::unsupported(Format::Exr, format!("file version {}", version & 0xff)));
    }
    if version & DEEP != 0 {
        return Err(DecodeError::unsupported(Format::Exr, "deep data"));
    }
    let mut parts = Vec::new();
    loop {
        let attributes = read_attributes(&mut cursor)?;
        if version & MULTI_PART == 0 {
            parts.push(Part::new(attributes, cursor.at - 1, bytes.len())?);
            return Ok(parts);
        }
        // An empty header ends the list.
        if attributes.is_empty() {
            break;
        }
        if parts.len() == MOST_PARTS {
            return Err(DecodeError::unsupported(Format::Exr, format!("more than {MOST_PARTS} parts")));
        }
        parts.push(Part::new(attributes, cursor.at - 1, bytes.len())?);
    }
    if parts.is_empty() {
        return Err(damaged(cursor.at, "the file has no part"));
    }
    if parts.iter().map(|part| part.channels.len()).sum::<usize>() > MOST_CHANNELS {
        return Err(too_many_channels());
    }
    Ok(parts)
}

fn read_attributes<'a>(cursor: &mut Cursor<'a>) -> Result<Vec<Attribute<'a>>, DecodeError> {
    let mut attributes = Vec::new();
    loop {
        let name = cursor.text()?;
        if name.is_empty() {
            return Ok(attributes);
        }
        if attributes.len() == MOST_ATTRIBUTES {
            return Err(DecodeError::unsupported(
                Format::Exr,
                format!("more than {MOST_ATTRIBUTES} attributes"),
            ));
        }
        let kind = cursor.text()?;
        let size = cursor.number()? as usize;
        let offset = cursor.at;
        attributes.push(Attribute { name, kind, value: cursor.take(size)?, offset });
    }
}

impl<'a> Part<'a> {
    fn new(attributes: Vec<Attribute<'a>>, end: usize, file_size: usize) -> Result<Self, DecodeError> {
        let find = |name: &str| attributes.iter().find(|attribute| attribute.name == name);
        let need =
            |name: &str| find(name).ok_or_else(|| damaged(end, format!("attribute {name:?} is missing")));
        let byte = |attribute: &Attribute| {
            attribute
                .value
                .first()
                .copied()
                .ok_or_else(|| damaged(attribute.offset, "the attribute is empty"))
        };
        let kind = find("type").map(|attribute| String::from_utf8_lossy(attribute.value));
        if kind.is_some_and(|kind| kind.starts_with("deep")) {
            return Err(DecodeError::unsupported(Format::Exr, "deep data"));
        }
        let compression = byte(need("compression")?)?;
        let channels = read_channels(need("channels")?)?;
        let data_window = Window::read(need("dataWindow")?)?;
        let display_window = Window::read(need("displayWindow")?)?;
        let (width, height, count) = (data_window.width, data_window.height, channels.len() as u64);
        check_size(Format::Exr, width, height, count, file_size, pixels_per_byte(compression)?)?;
        check_display_window(data_window, display_window, count)?;
        check_chunks(compression, data_window, find("tiles"), file_size)?;
        Ok(Self { channels, data_window, display_window, end, attributes })
    }

    /// The text of a `string` attribute.
    pub(super) fn text(&self, name: &str) -> Option<String> {
        let attribute = self.attributes.iter().find(|a| a.name == name && a.kind == "string")?;
        Some(String::from_utf8_lossy(attribute.value).into_owned())
    }
}

/// How many pixels a byte may hold by the best each compression can do, with a margin.
fn pixels_per_byte(compression: u8) -> Result<u64, DecodeError> {
    match compression {
        // A number has at least two bytes.
        0 => Ok(1),
        // Deflate codes 1032 bytes in one; run lengths and Huffman codes less.
        1..=7 => Ok(2048),
        // One of 64 coefficients, run lengths of those, deflate of those.
        8 | 9 => Ok(1 << 17),
        other => Err(DecodeError::unsupported(Format::Exr, format!("compression {other}"))),
    }
}

/// A small part of a large picture may be stored, but a few pixels must not ask for memory without measure.
fn check_display_window(data: Window, display: Window, channels: u64) -> Result<(), DecodeError> {
    check_size(Format::Exr, display.width, display.height, channels, usize::MAX, 1)?;
    if display.pixels() > (64 * data.pixels()).max(1 << 22) {
        let what = format!(
            "a display window of {}×{} around a data window of {}×{}",
            display.width, display.height, data.width, data.height
        );
        return Err(DecodeError::unsupported(Format::Exr, what));
    }
    Ok(())
}

/// The table of chunks, eight bytes each, must fit into the file.
fn check_chunks(
    compression: u8,
    window: Window,
    tiles: Option<&Attribute>,
    file_size: usize,
) -> Result<(), DecodeError> {
    let chunks = match tiles {
        Some(tiles) => {
            let size = |at: usize| tiles.value.get(at..at + 4).and_then(|four| four.first_chunk().copied());
            let (Some(x), Some(y)) = (size(0), size(4)) else {
                return Err(damaged(tiles.offset, "the attribute \"tiles\" is too short"));
            };
            let (x, y) = (u64::from(u32::from_le_bytes(x)), u64::from(u32::from_le_bytes(y)));
            if x == 0 || y == 0 || x > i32::MAX as u64 || y > i32::MAX as u64 {
                return Err(damaged(tiles.offset, format!("tiles of {x}×{y} pixels")));
            }
            window.width.div_ceil(x).saturating_mul(window.height.div_ceil(y))
        }
        None => window.height.div_ceil(match compression {
            0..=2 => 1,
            3 | 5 => 16,
            4 | 6 | 7 | 8 => 32,
            _ => 256,
        }),
    };
    if chunks.saturating_mul(8) > file_size as u64 {
        return Err(damaged(file_size, format!("the file ends before the places of its {chunks} chunks")));
    }
    Ok(())
}

fn too_many_channels() -> DecodeError {
    DecodeError::unsupported(Format::Exr, format!("more than {MOST_CHANNELS} channels"))
}

fn read_channels(attribute: &Attribute) -> Result<Vec<String>, DecodeError> {
    let mut cursor = Cursor { bytes: attribute.value, at: 0 };
    let mut read = || {
        let mut names = Vec::new();
        loop {
            let name = cursor.text()?;
            if name.is_empty() {
                return Ok(names);
            }
            // Sample kind, perceptual flag and padding, then the sampling in x and y.
            cursor.take(8)?;
            let (x, y) = (cursor.number()?, cursor.number()?);
            if (x, y) != (1, 1) {
                let what = format!("channel {name:?}, sampled every {x}×{y} pixels,");
                return Err(DecodeError::unsupported(Format::Exr, what));
            }
            if names.len() == MOST_CHANNELS {
                return Err(too_many_channels());
            }
            names.push(name);
        }
    };
    let names: Vec<String> = read().map_err(|error| match error {
        DecodeError::Damaged { .. } => damaged(attribute.offset, "the list of channels ends too early"),
        other => other,
    })?;
    if names.is_empty() { Err(damaged(attribute.offset, "the list of channels is empty")) } else { Ok(names) }
}

impl Window {
    fn pixels(self) -> u64 {
        self.width * self.height
    }

    /// Smallest and largest x and y, all inclusive.
    fn read(attribute: &Attribute) -> Result<Self, DecodeError> {
        let numbers: Vec<i64> =
            attribute.value.as_chunks().0.iter().map(|&four| i64::from(i32::from_le_bytes(four))).collect();
        match numbers[..] {
            [left, top, right, bottom] if left <= right && top <= bottom => Ok(Self {
                x: left,
                y: top,
                width: (right - left + 1) as u64,
                height: (bottom - top + 1) as u64,
            }),
            _ => Err(damaged(
                attribute.offset,
                format!("{} is {numbers:?}; min x, y must not exceed max x, y", attribute.name),
            )),
        }
    }
}

struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Cursor<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8], DecodeError> {
        let taken = self.at.checked_add(count).and_then(|end| self.bytes.get(self.at..end));
        let taken = taken
            .ok_or_else(|| damaged(self.at, format!("the header ends before {count} bytes it announces")))?;
        self.at += count;
        Ok(taken)
    }

    fn number(&mut self) -> Result<u32, DecodeError> {
        Ok(u32::from_le_bytes(*self.take(4)?.first_chunk().unwrap_or(&[0; 4])))
    }

    /// A name up to its zero byte; names have at most 255 bytes.
    fn text(&mut self) -> Result<String, DecodeError> {
        let rest = &self.bytes[self.at..];
        let length = rest.iter().take(256).position(|&b| b == 0);
        let length = length.ok_or_else(|| damaged(self.at, "a name of more than 255 bytes, or cut short"))?;
        let text = String::from_utf8_lossy(&rest[..length]).into_owned();
        self.at += length + 1;
        Ok(text)
    }
}
