//! The packet: a ZIP archive (PKWARE, APPNOTE 6.3.10), as far as 3MF needs it.

use std::collections::BTreeMap;
use std::io::{Read, Write};
use std::ops::Range;

use flate2::Compression;
use flate2::read::DeflateDecoder;
use flate2::write::DeflateEncoder;

use crate::codec::error::{DecodeError, EncodeError, ErrorKind, Place};

/// The largest part that is unpacked, in bytes.
const LARGEST_PART: u64 = 1 << 30;
/// Parts of one packet.
const MOST_PARTS: usize = 4096;

/// The parts of a packet by name.
pub(super) struct Packet<'a> {
    bytes: &'a [u8],
    parts: BTreeMap<String, Part>,
}

struct Part {
    data: Range<usize>,
    is_packed: bool,
    size: u64,
    checksum: u32,
}

impl<'a> Packet<'a> {
    /// Reads the list of parts at the end.
    pub(super) fn open(bytes: &'a [u8]) -> Result<Self, DecodeError> {
        let end = find_end(bytes)?;
        let count = usize::from(u16_at(bytes, end + 10)?);
        let mut at = u32_at(bytes, end + 16)? as usize;
        let mut parts = BTreeMap::new();
        for _ in 0..count.min(MOST_PARTS) {
            if u32_at(bytes, at)? != 0x0201_4b50 {
                return Err(wrong(ErrorKind::Syntax, at, "other bytes", "an entry of the list of parts"));
            }
            let (flags, method) = (u16_at(bytes, at + 8)?, u16_at(bytes, at + 10)?);
            let (checksum, packed) = (u32_at(bytes, at + 16)?, u32_at(bytes, at + 20)? as usize);
            let size = u64::from(u32_at(bytes, at + 24)?);
            let lengths = [28, 30, 32].map(|field| u16_at(bytes, at + field));
            let [name_length, extra, comment] = lengths;
            let (name_length, rest) =
                (usize::from(name_length?), usize::from(extra?) + usize::from(comment?));
            let local = u32_at(bytes, at + 42)? as usize;
            let name = slice(bytes, at + 46, name_length)?;
            let name = String::from_utf8_lossy(name).trim_start_matches('/').to_owned();
            if flags & 1 != 0 || !matches!(method, 0 | 8) {
                let found = format!("the part “{}” packed by method {method}", name.escape_debug());
                return Err(wrong(
                    ErrorKind::Unsupported,
                    at,
                    &found,
                    "parts that are stored or deflated, without a password",
                ));
            }
            // The head before the data repeats the name and may have other extra fields.
            let start = local
                + 30
                + usize::from(u16_at(bytes, local + 26)?)
                + usize::from(u16_at(bytes, local + 28)?);
            slice(bytes, start, packed)?;
            let part = Part { data: start..start + packed, is_packed: method == 8, size, checksum };
            parts.insert(name, part);
            at += 46 + name_length + rest;
        }
        Ok(Self { bytes, parts })
    }

    /// The names of all parts.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.parts.keys().map(String::as_str)
    }

    /// The content of a part; `None` if there is none of this name.
    pub(super) fn part(&self, name: &str) -> Result<Option<Vec<u8>>, DecodeError> {
        let Some(part) = self.parts.get(name) else { return Ok(None) };
        let data = &self.bytes[part.data.clone()];
        let place = part.data.start;
        if part.size > LARGEST_PART {
            let found = format!("a part of {} bytes", part.size);
            return Err(wrong(ErrorKind::TooLarge, place, &found, "at most 1 GiB"));
        }
        let mut content = Vec::new();
        if part.is_packed {
            // Memory follows what is really there, not what is claimed.
            let unpacked = DeflateDecoder::new(data).take(part.size + 1).read_to_end(&mut content);
            if unpacked.is_err() || content.len() as u64 != part.size {
                return Err(wrong(
                    ErrorKind::Syntax,
                    place,
                    "damaged data",
                    &format!("{} bytes, deflated", part.size),
                ));
            }
        } else {
            content.extend_from_slice(data);
        }
        if crc32fast::hash(&content) != part.checksum {
            return Err(wrong(ErrorKind::Syntax, place, "damaged data", "data that fits its checksum"));
        }
        Ok(Some(content))
    }
}

/// Where the record at the end begins; a comment may follow it.
fn find_end(bytes: &[u8]) -> Result<usize, DecodeError> {
    const RECORD: usize = 22;
    let first = bytes.len().saturating_sub(RECORD + usize::from(u16::MAX));
    let found = bytes[first..].windows(4).rposition(|window| window == b"PK\x05\x06");
    let missing = || {
        wrong(ErrorKind::Truncated, bytes.len(), "the end of the file", "a list of parts, as ZIP files end")
    };
    found.map(|at| first + at).filter(|at| at + RECORD <= bytes.len()).ok_or_else(missing)
}

fn slice(bytes: &[u8], at: usize, length: usize) -> Result<&[u8], DecodeError> {
    let missing = || {
        wrong(
            ErrorKind::Truncated,
            bytes.len(),
            "the end of the file",
            &format!("{length} bytes at byte {at}"),
        )
    };
    at.checked_add(length).and_then(|end| bytes.get(at..end)).ok_or_else(missing)
}

fn u16_at(bytes: &[u8], at: usize) -> Result<u16, DecodeError> {
    let field = slice(bytes, at, 2)?;
    Ok(u16::from_le_bytes([field[0], field[1]]))
}

fn u32_at(bytes: &[u8], at: usize) -> Result<u32, DecodeError> {
    let field = slice(bytes, at, 4)?;
    Ok(u32::from_le_bytes([field[0], field[1], field[2], field[3]]))
}

fn wrong(kind: ErrorKind, at: usize, found: &str, expected: &str) -> DecodeError {
    DecodeError::new(kind, Place::Byte { offset: at as u64 }, found, expected)
}

/// Packs parts, deflated, with the earliest date there is: equal content gives equal bytes.
pub(super) fn pack(parts: &[(&str, Vec<u8>)]) -> Result<Vec<u8>, EncodeError> {
    let too_large = |found: usize| EncodeError::TooLarge {
        format: "3MF",
        what: "bytes",
        most: u64::from(u32::MAX),
        found: found as u64,
    };
    let (mut bytes, mut list) = (Vec::new(), Vec::new());
    for (name, content) in parts {
        let mut encoder = DeflateEncoder::new(Vec::new(), Compression::default());
        // Writing to a vector cannot fail.
        let packed = encoder.write_all(content).and_then(|()| encoder.finish()).unwrap_or_default();
        let offset = u32::try_from(bytes.len()).map_err(|_| too_large(bytes.len()))?;
        let size = u32::try_from(content.len()).map_err(|_| too_large(content.len()))?;
        let mut shared = Vec::new();
        // Version 2.0, no flags, deflate, midnight of 1 January 1980.
        [20u16, 0, 8, 0, 33].iter().for_each(|field| shared.extend(field.to_le_bytes()));
        [crc32fast::hash(content), packed.len() as u32, size]
            .iter()
            .for_each(|field| shared.extend(field.to_le_bytes()));
        shared.extend((name.len() as u16).to_le_bytes());
        shared.extend([0; 2]);
        bytes.extend_from_slice(b"PK\x03\x04");
        bytes.extend_from_slice(&shared);
        bytes.extend_from_slice(name.as_bytes());
        bytes.extend_from_slice(&packed);
        list.extend_from_slice(b"PK\x01\x02\x14\x00");
        list.extend_from_slice(&shared);
        // No comment, disk 0, no attributes.
        list.extend([0; 10]);
        list.extend(offset.to_le_bytes());
        list.extend_from_slice(name.as_bytes());
    }
    let start = u32::try_from(bytes.len()).map_err(|_| too_large(bytes.len()))?;
    bytes.extend_from_slice(&list);
    bytes.extend_from_slice(b"PK\x05\x06\0\0\0\0");
    let count = parts.len() as u16;
    bytes.extend([count.to_le_bytes(), count.to_le_bytes()].as_flattened());
    bytes.extend((list.len() as u32).to_le_bytes());
    bytes.extend(start.to_le_bytes());
    bytes.extend([0; 2]);
    Ok(bytes)
}
