//! Mesh files to values and back. Bytes only: the disk belongs to the caller.
//!
//! Every file is taken as hostile: memory stays in proportion to the bytes given, whatever a header claims, and the
//! answer to nonsense is a [`DecodeError`] that says where. What can be survived is a [`Warning`] beside the value.

mod color;
mod cursor;
mod error;
pub mod gltf;
pub mod mtl;
pub mod obj;
pub mod off;
pub mod ply;
mod polygons;
mod soundness;
pub mod stl;
mod text;
pub mod three_mf;
mod token;
mod vertices;
pub(crate) mod welding;

use crate::TriangleMesh;
pub use error::{DecodeError, EncodeError, ErrorKind, Place, Warning};
pub use polygons::{DecodedPolygons, EncodeOptions, Form, decode_polygons, encode_polygons};

/// A mesh file format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Wavefront OBJ.
    Obj,
    /// Stanford PLY, text or binary.
    Ply,
    /// Stereolithography, text or binary.
    Stl,
    /// Geomview's object file format, text.
    Off,
    /// 3D Manufacturing Format.
    ThreeMf,
    /// glTF 2.0 in one binary file; written only.
    Glb,
    /// glTF 2.0 as JSON; written only.
    Gltf,
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 7] =
        [Self::Obj, Self::Ply, Self::Stl, Self::Off, Self::ThreeMf, Self::Glb, Self::Gltf];

    /// The format of a file name's extension, without the dot, in either case.
    pub fn from_extension(extension: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| extension.eq_ignore_ascii_case(format.extension()))
    }

    /// The format as far as the first bytes tell. OBJ has no mark of its own: it is guessed from its first keyword.
    pub fn from_magic(bytes: &[u8]) -> Option<Self> {
        let start = bytes.trim_ascii_start();
        if start.starts_with(b"ply") && start.get(3).is_some_and(u8::is_ascii_whitespace) {
            return Some(Self::Ply);
        }
        if stl::looks_like(bytes) {
            return Some(Self::Stl);
        }
        if three_mf::looks_like(bytes) {
            return Some(Self::ThreeMf);
        }
        if bytes.starts_with(b"glTF") {
            return Some(Self::Glb);
        }
        if off::looks_like(bytes) {
            return Some(Self::Off);
        }
        let lines = bytes.split(|&b| b == b'\n').map(<[u8]>::trim_ascii);
        let mut statements = lines.take(1000).filter(|line| !line.is_empty() && line[0] != b'#');
        let keyword = statements.next()?.split(u8::is_ascii_whitespace).next()?;
        let known: &[&[u8]] = &[b"v", b"vt", b"vn", b"f", b"o", b"g", b"s", b"l", b"p", b"usemtl", b"mtllib"];
        known.contains(&keyword).then_some(Self::Obj)
    }

    /// The usual extension.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Ply => "ply",
            Self::Stl => "stl",
            Self::Off => "off",
            Self::ThreeMf => "3mf",
            Self::Glb => "glb",
            Self::Gltf => "gltf",
        }
    }

    /// True if [`decode`] reads it. A glTF file is a scene: this crate writes it, `luch-formats` reads it.
    pub fn can_be_read(self) -> bool {
        !matches!(self, Self::Glb | Self::Gltf)
    }
}

/// A mesh from a file, and what was odd about the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Decoded {
    /// The mesh, triangulated.
    pub mesh: TriangleMesh,
    /// What was left out or put right.
    pub warnings: Vec<Warning>,
}

/// Reads a mesh. For faces of any size and the names of materials use [`decode_polygons`].
///
/// # Errors
/// If the bytes are not what the format wants, or the format is one that is only written.
pub fn decode(bytes: &[u8], format: Format) -> Result<Decoded, DecodeError> {
    if format == Format::Stl {
        let file = stl::decode(bytes)?;
        return Ok(Decoded { mesh: file.mesh, warnings: file.warnings });
    }
    let DecodedPolygons { mesh, mut warnings, .. } = decode_polygons(bytes, format)?;
    let triangulation = polygons::triangulation(mesh);
    if triangulation.dropped_faces > 0 {
        let message = format!("{} faces without area are left out", triangulation.dropped_faces);
        warnings.push(Warning { line: None, message });
    }
    if triangulation.fanned_faces > 0 {
        let message = format!("{} concave faces are too large to be cut well", triangulation.fanned_faces);
        warnings.push(Warning { line: None, message });
    }
    Ok(Decoded { mesh: triangulation.mesh, warnings })
}
