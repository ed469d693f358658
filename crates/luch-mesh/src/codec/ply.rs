//! PLY (Turk, "The PLY Polygon File Format", 1994), text and binary of both byte orders.
//!
//! Read: of `vertex` x y z, nx ny nz, one of (s t), (u v), (texture_u texture_v), (texture_s texture_t) and red green
//! blue alpha; of `face` the list vertex_indices or vertex_index, a list texcoord of two numbers per corner, and
//! material_index; `tristrips`. Anything else is skipped with a warning.
//!
//! Colours of whole numbers are sRGB-coded with the type's largest value as 1 (alpha without the coding) and become
//! linear light; colours of real numbers are taken as linear light. The writer writes those.
//!
//! A file without faces, such as a point cloud, is no error: the mesh has positions but no faces, and a warning.

mod header;
mod read;
mod source;
mod write;

use super::error::Warning;
use crate::PolygonMesh;
pub use read::decode;
pub use write::{encode, encode_polygons};

/// How the data after the header is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// Text.
    Ascii,
    /// Binary, lowest byte first.
    LittleEndian,
    /// Binary, highest byte first.
    BigEndian,
}

impl Encoding {
    /// All encodings.
    pub const ALL: [Self; 3] = [Self::Ascii, Self::LittleEndian, Self::BigEndian];

    /// The name in the header.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ascii => "ascii",
            Self::LittleEndian => "binary_little_endian",
            Self::BigEndian => "binary_big_endian",
        }
    }
}

/// What a PLY file holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlyFile {
    /// All faces and triangle strips.
    pub mesh: PolygonMesh,
    /// What was left out or put right.
    pub warnings: Vec<Warning>,
}
