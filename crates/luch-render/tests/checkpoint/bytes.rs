//! Film files taken apart and sealed again: a second writer of the format, that may lie.

use luch_render::Fingerprint;
use serde::{Deserialize, Serialize};
use std::io::{Read, Write};
use std::ops::Range;

/// A film file in its parts.
pub(crate) struct File {
    pub(crate) header: Header,
    /// As in the file: compressed.
    pub(crate) sums: Vec<u8>,
}

/// The header, field by field as the format has them.
#[derive(Clone, Serialize, Deserialize)]
pub(crate) struct Header {
    pub(crate) fingerprint: Fingerprint,
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) exponent: i8,
    pub(crate) tiles: Vec<Tile>,
    pub(crate) provenance: luch_render::Provenance,
}

#[derive(Clone, Serialize, Deserialize)]
pub(crate) struct Tile {
    pub(crate) samples: Vec<Range<u64>>,
    pub(crate) losses: [u64; 2],
}

impl Header {
    pub(crate) fn to_bytes(&self) -> Vec<u8> {
        postcard::to_stdvec(self).unwrap()
    }
}

/// The parts of a sound file.
pub(crate) fn split(bytes: &[u8]) -> File {
    let length = |at: usize| u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap()) as usize;
    let header_end = 20 + length(12);
    let sums_end = header_end + 8 + length(header_end);
    assert_eq!(sums_end + 32, bytes.len());
    let header = postcard::from_bytes(&bytes[20..header_end]).unwrap();
    File { header, sums: bytes[header_end + 8..sums_end].to_vec() }
}

/// A file with a checksum that fits, whatever the header says.
pub(crate) fn seal(header: &Header, sums: &[u8]) -> Vec<u8> {
    seal_bytes(&header.to_bytes(), sums)
}

/// The same for a header that may be no header.
pub(crate) fn seal_bytes(header: &[u8], sums: &[u8]) -> Vec<u8> {
    let mut bytes = b"LUCHFILM\x01\0\0\0".to_vec();
    for part in [header, sums] {
        bytes.extend_from_slice(&(part.len() as u64).to_le_bytes());
        bytes.extend_from_slice(part);
    }
    let checksum = blake3::hash(&bytes);
    bytes.extend_from_slice(checksum.as_bytes());
    bytes
}

/// The sums as they are in memory.
pub(crate) fn unpack(sums: &[u8]) -> Vec<u8> {
    let mut plain = Vec::new();
    lz4_flex::frame::FrameDecoder::new(sums).read_to_end(&mut plain).unwrap();
    plain
}

/// And back.
pub(crate) fn pack(plain: &[u8]) -> Vec<u8> {
    let mut encoder = lz4_flex::frame::FrameEncoder::new(Vec::new());
    encoder.write_all(plain).unwrap();
    encoder.finish().unwrap()
}
