//! Marks, counts and records of equal size.

use crate::{Place, Problem};
use std::path::Path;

/// What a file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Mesh,
    Rays,
    Hits,
}

impl Kind {
    /// How the file starts.
    pub(super) fn mark(self) -> &'static [u8; 8] {
        match self {
            Self::Mesh => b"TRIS0001",
            Self::Rays => b"RAYS0001",
            Self::Hits => b"HITS0001",
        }
    }
}

/// Where the records start: after the mark and eight bytes of counts.
pub(super) fn start(path: &Path, bytes: &[u8], kind: Kind) -> Result<usize, Problem> {
    let mark = kind.mark();
    if !bytes.starts_with(mark) {
        let found = bytes[..bytes.len().min(8)].escape_ascii();
        let message = format!("starts with \"{found}\", expected \"{}\"", mark.escape_ascii());
        return Err(Problem::new(path, message).at(Place::Byte(0)));
    }
    if bytes.len() < 16 {
        return Err(Problem::new(path, "ends inside its header").at(Place::Byte(bytes.len() as u64)));
    }
    Ok(16)
}

/// Passes a file that is as long as its header says.
pub(super) fn check_size(path: &Path, bytes: &[u8], expected: u64) -> Result<(), Problem> {
    if bytes.len() as u64 == expected {
        return Ok(());
    }
    let message = format!("has {} bytes; with the counts of its header it must have {expected}", bytes.len());
    Err(Problem::new(path, message).at(Place::Byte(8)))
}

/// The records of a file with one count of 64 bits.
pub(super) fn counted<'a, const SIZE: usize>(
    path: &Path,
    bytes: &'a [u8],
    kind: Kind,
) -> Result<impl Iterator<Item = &'a [u8; SIZE]>, Problem> {
    let start = start(path, bytes, kind)?;
    let count = u64::from(u32_at(bytes, 8)) | u64::from(u32_at(bytes, 12)) << 32;
    check_size(path, bytes, count.saturating_mul(SIZE as u64).saturating_add(start as u64))?;
    Ok(records(&bytes[start..]))
}

/// Bytes as records of equal size.
pub(super) fn records<const SIZE: usize>(bytes: &[u8]) -> impl Iterator<Item = &[u8; SIZE]> {
    bytes.as_chunks().0.iter()
}

/// A file with one count of 64 bits.
pub(super) fn encode<T, const WORDS: usize>(
    kind: Kind,
    things: &[T],
    record: impl Fn(&T) -> [[u8; 4]; WORDS],
) -> Vec<u8> {
    let mut bytes = kind.mark().to_vec();
    bytes.reserve(8 + things.len() * WORDS * 4);
    bytes.extend((things.len() as u64).to_le_bytes());
    bytes.extend(things.iter().flat_map(|thing| record(thing).into_iter().flatten()));
    bytes
}

/// The number at a place within a record or header; 0 beyond its end.
pub(super) fn u32_at(bytes: &[u8], at: usize) -> u32 {
    let four = bytes.get(at..).and_then(|rest| rest.first_chunk());
    four.map_or(0, |four| u32::from_le_bytes(*four))
}

/// See [`u32_at`].
pub(super) fn f32_at(bytes: &[u8], at: usize) -> f32 {
    f32::from_bits(u32_at(bytes, at))
}
