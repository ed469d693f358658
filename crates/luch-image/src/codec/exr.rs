//! OpenEXR through the `exr` crate, on one thread.
//!
//! The crate decodes and codes the pixels. The header is also read here (`header`), since limits must be checked before
//! the crate sees the file, since the crate keeps attributes in no order, and since written files must be the same
//! each time.
//!
//! Not read: deep data, subsampled channels (as in luminance-chroma files) and HTJ2K compression; the crate has none
//! of them. Of mip and rip maps the largest level is read. Pictures fill the display window: what the data window
//! lacks is black and transparent, what sticks out is cut off.

mod header;
mod picture;
mod planes;
mod write;

pub use picture::decode_exr_layers;
pub(super) use picture::{decode, read_metadata};
pub use write::encode_exr;
