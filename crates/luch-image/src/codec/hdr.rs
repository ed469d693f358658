//! Radiance pictures: eight bits for each of red, green and blue, and one exponent for all three.
//!
//! Greg Ward, "Real pixels", Graphics Gems II (1991), and the Radiance file format notes. Read and written here, since
//! the header's comments and EXPOSURE lines and the limits on run lengths are ours to handle.

mod read;
mod rgbe;
mod write;

pub(super) use read::{decode, read_metadata};
pub use write::encode_hdr;

/// Scan lines of these widths have run lengths for each channel; others are flat.
const RUN_WIDTHS: std::ops::RangeInclusive<usize> = 8..=0x7fff;
