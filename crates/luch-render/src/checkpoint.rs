//! A film as a file: to resume, to merge with films of other machines, to develop later.
//!
//! | bytes | what |
//! |---|---|
//! | 8 | `LUCHFILM` |
//! | 4 | format version, little-endian |
//! | 8 | length of the header |
//! | … | header: postcard (fingerprint, size, step, samples of each tile, provenance) |
//! | 8 | length of the sums |
//! | … | sums of all tiles, 72 bytes a pixel, little-endian, as an LZ4 frame |
//! | 32 | BLAKE3 of all the above |

use crate::exact::Step;
use crate::film::{Film, Losses, PixelSums};
use crate::fingerprint::Fingerprint;
use crate::merge::MergeError;
use crate::ranges::Ranges;
use serde::{Deserialize, Serialize};
use std::io::{Read, Write};

const MAGIC: &[u8; 8] = b"LUCHFILM";
const VERSION: u32 = 1;
/// Magic, version and length of the header.
const PREFIX: usize = 8 + 4 + 8;
const CHECKSUM: usize = 32;
/// Sums have room for no more samples of a pixel.
const MOST_SAMPLES: u64 = 1 << 33;
/// LZ4 never makes more of a byte than this.
const LARGEST_EXPANSION: u64 = 255;

/// Where a film comes from, for people and for `reproduce`.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Provenance {
    /// The file that was rendered, as it was named.
    pub source: String,
    /// The command that was given.
    pub command: String,
    /// Version of the program.
    pub version: String,
    /// The options that shape the samples, as one JSON object.
    pub options: String,
}

/// A film and what it is a film of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Checkpoint {
    /// What it is a film of.
    pub fingerprint: Fingerprint,
    /// Where it comes from.
    pub provenance: Provenance,
    /// The sums.
    pub film: Film,
}

#[derive(Serialize, Deserialize)]
struct Header {
    fingerprint: Fingerprint,
    width: u32,
    height: u32,
    exponent: i8,
    tiles: Vec<(Ranges, Losses)>,
    provenance: Provenance,
}

/// Why bytes are no checkpoint, or checkpoints cannot be joined.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CheckpointError {
    /// The bytes are something else.
    #[error("this is no luch film: it does not begin with LUCHFILM")]
    Foreign,
    /// A version this program does not know.
    #[error("this film has format version {0}; this program reads version {VERSION}")]
    Version(u32),
    /// The file ends too early, or has been changed.
    #[error("this film is damaged at byte {offset}: {reason}")]
    Damaged {
        /// Where it was noticed.
        offset: u64,
        /// What was noticed.
        reason: String,
    },
    /// Films of different scenes, cameras or settings.
    #[error("the films are of different scenes or settings: fingerprints {0} and {1}")]
    OtherScene(Fingerprint, Fingerprint),
    /// The films cannot be added.
    #[error(transparent)]
    Merge(#[from] MergeError),
}

fn damaged(offset: usize, reason: impl Into<String>) -> CheckpointError {
    CheckpointError::Damaged { offset: offset as u64, reason: reason.into() }
}

impl Checkpoint {
    /// The film as bytes.
    pub fn encode(&self) -> Vec<u8> {
        let film = &self.film;
        let header = Header {
            fingerprint: self.fingerprint,
            width: film.width,
            height: film.height,
            exponent: film.step.exponent(),
            tiles: film.tiles.iter().map(|tile| (tile.done.clone(), tile.losses)).collect(),
            provenance: self.provenance.clone(),
        };
        let header = postcard::to_stdvec(&header).expect("plain data is always written to memory");
        let mut sums = lz4_flex::frame::FrameEncoder::new(Vec::new());
        for tile in &film.tiles {
            sums.write_all(&little_endian(&tile.sums)).expect("memory takes everything");
        }
        let sums = sums.finish().expect("memory takes everything");

        let mut bytes = Vec::with_capacity(PREFIX + header.len() + 8 + sums.len() + CHECKSUM);
        bytes.extend_from_slice(MAGIC);
        bytes.extend_from_slice(&VERSION.to_le_bytes());
        bytes.extend_from_slice(&(header.len() as u64).to_le_bytes());
        bytes.extend_from_slice(&header);
        bytes.extend_from_slice(&(sums.len() as u64).to_le_bytes());
        bytes.extend_from_slice(&sums);
        let checksum = blake3::hash(&bytes);
        bytes.extend_from_slice(checksum.as_bytes());
        bytes
    }

    /// The film that bytes hold. What is allocated is bounded by 255 times the number of bytes.
    ///
    /// # Errors
    /// If the bytes are no film, of another version, cut short or changed.
    pub fn decode(bytes: &[u8]) -> Result<Self, CheckpointError> {
        if !bytes.starts_with(MAGIC) {
            return Err(CheckpointError::Foreign);
        }
        let cut = || damaged(bytes.len(), "the file ends too early");
        let version = u32::from_le_bytes(bytes.get(8..12).ok_or_else(cut)?.try_into().map_err(|_| cut())?);
        if version != VERSION {
            return Err(CheckpointError::Version(version));
        }
        let header_end = section(bytes, 12)?;
        let sums_end = section(bytes, header_end)?;
        let sealed = sums_end + CHECKSUM;
        if bytes.len() != sealed {
            let reason = if bytes.len() < sealed {
                "the file ends too early"
            } else {
                "more bytes than there should be"
            };
            return Err(damaged(bytes.len().min(sealed), reason));
        }
        if blake3::hash(&bytes[..sums_end]).as_bytes() != &bytes[sums_end..] {
            return Err(damaged(sums_end, "the checksum does not match: bytes have been changed"));
        }
        let header: Header = postcard::from_bytes(&bytes[PREFIX..header_end])
            .map_err(|error| damaged(PREFIX, format!("the header cannot be read: {error}")))?;
        let film = film_of(&header, &bytes[header_end + 8..sums_end], header_end)?;
        Ok(Self { fingerprint: header.fingerprint, provenance: header.provenance, film })
    }

    /// Adds the samples of another film of the same picture.
    ///
    /// # Errors
    /// If it is of another scene or settings, or holds a sample that is here already; nothing is then changed.
    pub fn merge(&mut self, other: &Checkpoint) -> Result<(), CheckpointError> {
        if self.fingerprint != other.fingerprint {
            return Err(CheckpointError::OtherScene(self.fingerprint, other.fingerprint));
        }
        Ok(self.film.merge(&other.film)?)
    }
}

/// End of the section whose length stands at `at`.
fn section(bytes: &[u8], at: usize) -> Result<usize, CheckpointError> {
    let cut = || damaged(bytes.len(), "the file ends too early");
    let length = bytes.get(at..at + 8).ok_or_else(cut)?;
    let length = u64::from_le_bytes(length.try_into().map_err(|_| cut())?);
    let end = usize::try_from(length).ok().and_then(|length| (at + 8).checked_add(length));
    end.filter(|end| *end <= bytes.len()).ok_or_else(cut)
}

fn film_of(header: &Header, sums: &[u8], at: usize) -> Result<Film, CheckpointError> {
    let sides = 1..=65536;
    if !sides.contains(&header.width) || !sides.contains(&header.height) {
        return Err(damaged(PREFIX, format!("a picture of {}×{} pixels", header.width, header.height)));
    }
    let step = Step::new(header.exponent)
        .ok_or_else(|| damaged(PREFIX, format!("a step of 2^{}", header.exponent)))?;
    let expected = u64::from(header.width) * u64::from(header.height) * size_of::<PixelSums>() as u64;
    if expected / LARGEST_EXPANSION > sums.len() as u64 {
        return Err(damaged(at, format!("{} bytes cannot hold {expected} bytes of sums", sums.len())));
    }
    let mut film = Film::with_step(header.width, header.height, step);
    if film.tiles.len() != header.tiles.len() {
        return Err(damaged(PREFIX, format!("{} tiles, expected {}", header.tiles.len(), film.tiles.len())));
    }
    let mut decoder = lz4_flex::frame::FrameDecoder::new(sums);
    let mut buffer = Vec::new();
    for (tile, (done, losses)) in film.tiles.iter_mut().zip(&header.tiles) {
        if !done.is_sound() {
            return Err(damaged(PREFIX, format!("samples {done} of a tile are no set of ranges")));
        }
        if done.count() > MOST_SAMPLES {
            return Err(damaged(
                PREFIX,
                format!("samples {done} of a tile, expected at most {MOST_SAMPLES} of them"),
            ));
        }
        let channels = done.count() * 3 * tile.sums.len() as u64;
        if losses.saturated.checked_add(losses.invalid).is_none_or(|lost| lost > channels) {
            return Err(damaged(PREFIX, format!("a tile lost {losses:?} of {channels} numbers")));
        }
        buffer.resize(tile.sums.len() * size_of::<PixelSums>(), 0);
        decoder
            .read_exact(&mut buffer)
            .map_err(|error| damaged(at, format!("the sums cannot be read: {error}")))?;
        from_little_endian(&buffer, &mut tile.sums);
        tile.done = done.clone();
        tile.losses = *losses;
    }
    match decoder.read(&mut [0]) {
        Ok(0) => Ok(film),
        _ => Err(damaged(at, "more sums than pixels")),
    }
}

/// The sums as words of four bytes each.
fn little_endian(sums: &[PixelSums]) -> Vec<u8> {
    bytemuck::cast_slice::<PixelSums, u32>(sums).iter().flat_map(|word| word.to_le_bytes()).collect()
}

fn from_little_endian(bytes: &[u8], sums: &mut [PixelSums]) {
    let words = bytemuck::cast_slice_mut::<PixelSums, u32>(sums);
    for (word, bytes) in words.iter_mut().zip(bytes.chunks_exact(4)) {
        *word = u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
    }
}
