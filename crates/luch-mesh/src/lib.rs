//! Mesh toolkit: free functions on one plain type.

mod triangle_mesh;

pub use triangle_mesh::{Attribute, TriangleMesh};
