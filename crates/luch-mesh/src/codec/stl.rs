//! STL (3D Systems, "Stereolithography Interface Specification", 1989): bare triangles, as text or binary.
//!
//! A file repeats every corner: equal ones become one position on reading.

mod read;
mod write;

use super::error::Warning;
use crate::TriangleMesh;
pub use read::decode;
pub(crate) use read::looks_like;
pub use write::{encode_ascii, encode_binary};

/// What an STL file holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StlFile {
    /// All triangles of all solids. The stored normals are only compared, never taken: they are those of the corners.
    pub mesh: TriangleMesh,
    /// Names of the solids; empty for binary files.
    pub solids: Vec<String>,
    /// What was left out or put right.
    pub warnings: Vec<Warning>,
}
