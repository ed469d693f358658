//! glTF 2.0 (Khronos Group, ISO/IEC 12113:2022), written as one binary file (GLB) or as JSON with the data inside.
//!
//! One mesh, one primitive for each material slot, all over the same vertices. Positions split only where normals, uvs,
//! colours or tangents differ. Uvs have v upside down, as glTF wants. Reading is another matter: a glTF file is a scene.

mod json;
mod write;

pub use write::{encode_binary, encode_text};

/// What a glTF file says besides the mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EncodeOptions {
    /// The name of each material slot. Slots beyond are called `slot` and their number.
    pub materials: Vec<String>,
}
