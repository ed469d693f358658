//! What stands between a hostile file and a decoder.

use super::{DecodeError, Format, MAX_PIXELS};
use std::cell::Cell;
use std::io::{self, BufRead, Cursor, Read, Seek, SeekFrom};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Passes a size that is not empty, at most [`MAX_PIXELS`] (fewer with more than four channels), and not larger than
/// `file_size` bytes can hold when one byte codes at most `pixels_per_byte` pixels. Called before pixels are allocated.
pub(super) fn check_size(
    format: Format,
    width: u64,
    height: u64,
    channels: u64,
    file_size: usize,
    pixels_per_byte: u64,
) -> Result<(), DecodeError> {
    if width == 0 || height == 0 {
        let reason = format!("the picture is empty ({width}×{height})");
        return Err(DecodeError::Damaged { format, offset: None, reason });
    }
    let pixels = width.saturating_mul(height);
    if width > u64::from(u32::MAX)
        || height > u64::from(u32::MAX)
        || pixels.saturating_mul(channels.max(4)) > MAX_PIXELS * 4
    {
        return Err(DecodeError::TooLarge { format, width, height, channels });
    }
    if pixels > (file_size as u64).saturating_mul(pixels_per_byte) {
        let reason = format!("{width}×{height} pixels cannot be coded in a file of {file_size} bytes");
        return Err(DecodeError::Damaged { format, offset: None, reason });
    }
    Ok(())
}

/// Runs a third-party decoder; a panic inside it becomes an error.
///
/// The decoders return errors for what they foresee, yet they hold assertions and plain indexing too, and a broken
/// texture must not end a render. They work on borrowed bytes and own what they build, so nothing half-made
/// outlives the panic.
pub(super) fn guarded<T>(
    format: Format,
    decoder: impl FnOnce() -> Result<T, DecodeError>,
) -> Result<T, DecodeError> {
    catch_unwind(AssertUnwindSafe(decoder)).unwrap_or_else(|_| {
        let reason = "the contents contradict one another (the decoder gave up)".to_owned();
        Err(DecodeError::Damaged { format, offset: None, reason })
    })
}

/// Bytes that remember how far they were read, for the offsets in errors.
pub(super) struct Tracked<'a> {
    cursor: Cursor<&'a [u8]>,
    position: &'a Cell<u64>,
}

impl<'a> Tracked<'a> {
    /// All of `bytes`; `position` is kept up to date.
    pub(super) fn new(bytes: &'a [u8], position: &'a Cell<u64>) -> Self {
        Self { cursor: Cursor::new(bytes), position }
    }
}

impl Read for Tracked<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.cursor.read(buffer)?;
        self.position.set(self.cursor.position());
        Ok(count)
    }
}

impl BufRead for Tracked<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        self.cursor.fill_buf()
    }

    fn consume(&mut self, count: usize) {
        self.cursor.consume(count);
        self.position.set(self.cursor.position());
    }
}

impl Seek for Tracked<'_> {
    fn seek(&mut self, place: SeekFrom) -> io::Result<u64> {
        let at = self.cursor.seek(place)?;
        self.position.set(at);
        Ok(at)
    }
}
