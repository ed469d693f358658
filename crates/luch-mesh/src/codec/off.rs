//! OFF (Geomview's object file format), text: positions and polygons, with normals, colours and uvs as the first word says.
//!
//! Read: `OFF` with any of the prefixes `ST` (uvs), `C` (colours), `N` (normals), or without a first word at all. Colours of
//! whole numbers are sRGB-coded from 0 to 255 and become linear light, others are taken as linear light. Colours of faces,
//! the binary form and positions of four components are not read.

mod read;
mod write;

use super::error::Warning;
use crate::PolygonMesh;
pub use read::decode;
pub(crate) use read::looks_like;
pub use write::encode_polygons;

/// What an OFF file holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OffFile {
    /// All faces.
    pub mesh: PolygonMesh,
    /// What was left out or put right.
    pub warnings: Vec<Warning>,
}

/// What a vertex has besides its position.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Parts {
    uvs: bool,
    colors: bool,
    normals: bool,
}
