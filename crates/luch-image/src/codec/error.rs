//! What can be wrong with an image file or with what is to be written to one.

use super::Format;
use thiserror::Error;

/// Why bytes are not a picture.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum DecodeError {
    /// The first bytes are those of no known format.
    #[error(
        "byte 0: the file starts with {start}, which is no image format known here ({})",
        Format::names()
    )]
    UnknownFormat {
        /// The first bytes, printable.
        start: String,
    },
    /// The file is of a kind that this library does not read.
    #[error("{format}: {what} is not supported")]
    Unsupported {
        /// The format.
        format: Format,
        /// What the file holds.
        what: String,
    },
    /// The file claims more than may be decoded.
    #[error(
        "{format}: the file claims {width}×{height} pixels in {channels} channels; at most {} pixels in 4 channels (or fewer in more) are decoded",
        super::MAX_PIXELS
    )]
    TooLarge {
        /// The format.
        format: Format,
        /// Claimed pixels in a row.
        width: u64,
        /// Claimed rows.
        height: u64,
        /// Claimed numbers a pixel.
        channels: u64,
    },
    /// The file contradicts its format or ends too early.
    #[error("{format}: {}{reason}", at(offset))]
    Damaged {
        /// The format.
        format: Format,
        /// The byte at which the trouble was noticed, where the decoder tells.
        offset: Option<u64>,
        /// What is wrong.
        reason: String,
    },
}

fn at(offset: &Option<u64>) -> String {
    offset.map(|offset| format!("byte {offset}: ")).unwrap_or_default()
}

impl DecodeError {
    /// A [`DecodeError::Damaged`] at a known byte.
    pub(super) fn damaged_at(format: Format, offset: usize, reason: impl Into<String>) -> Self {
        DecodeError::Damaged { format, offset: Some(offset as u64), reason: reason.into() }
    }

    /// A [`DecodeError::Unsupported`].
    pub(super) fn unsupported(format: Format, what: impl Into<String>) -> Self {
        DecodeError::Unsupported { format, what: what.into() }
    }
}

/// Why a picture cannot be written.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum EncodeError {
    /// The picture has no pixel or more than the format can say.
    #[error("{format}: a picture of {width}×{height} cannot be written; each side must be 1 to {limit}")]
    Size {
        /// The format.
        format: Format,
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
        /// The longest side the format holds.
        limit: u32,
    },
    /// A text cannot be stored.
    #[error("{format}: metadata {key:?} cannot be written: {reason}")]
    Metadata {
        /// The format.
        format: Format,
        /// Its key.
        key: String,
        /// What is wrong and what is accepted.
        reason: String,
    },
    /// A layer or channel cannot be stored.
    #[error("EXR: channel {channel:?} cannot be written: {reason}")]
    Channel {
        /// Full name of the channel.
        channel: String,
        /// What is wrong and what is accepted.
        reason: String,
    },
    /// The library that writes the format refused.
    #[error("{format}: {reason}")]
    Refused {
        /// The format.
        format: Format,
        /// In its words.
        reason: String,
    },
}

impl EncodeError {
    /// The library's refusal.
    pub(super) fn refused(format: Format, reason: impl ToString) -> Self {
        EncodeError::Refused { format, reason: reason.to_string() }
    }

    /// Passes pictures whose sides are 1 to `limit`.
    pub(super) fn check_size(format: Format, width: u32, height: u32, limit: u32) -> Result<(), Self> {
        let fits = |side: u32| (1..=limit).contains(&side);
        if fits(width) && fits(height) {
            Ok(())
        } else {
            Err(EncodeError::Size { format, width, height, limit })
        }
    }
}

/// The first bytes as text, unprintable ones escaped.
pub(super) fn quote_bytes(bytes: &[u8]) -> String {
    if bytes.is_empty() {
        return "nothing (it is empty)".to_owned();
    }
    format!("\"{}\"", bytes[..bytes.len().min(12)].escape_ascii())
}
