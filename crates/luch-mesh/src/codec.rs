//! Mesh files to values and back. Bytes only: the disk belongs to the caller.
//!
//! Every file is taken as hostile: memory stays in proportion to the bytes given, whatever a header claims, and the
//! answer to nonsense is a [`DecodeError`] that says where. What can be survived is a [`Warning`] beside the value.

mod cursor;
mod error;
pub mod mtl;
pub mod obj;
pub mod ply;
pub mod stl;
mod token;

use crate::TriangleMesh;
pub use error::{DecodeError, ErrorKind, Place, Warning};

/// A mesh file format this crate reads and writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Wavefront OBJ.
    Obj,
    /// Stanford PLY, text or binary.
    Ply,
    /// Stereolithography, text or binary.
    Stl,
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 3] = [Self::Obj, Self::Ply, Self::Stl];

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
        }
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

/// Reads a mesh. For the names of groups and materials of an OBJ file use [`obj::decode`].
pub fn decode(bytes: &[u8], format: Format) -> Result<Decoded, DecodeError> {
    let (polygons, mut warnings) = match format {
        Format::Obj => {
            let file = obj::decode(bytes)?;
            (file.mesh, file.warnings)
        }
        Format::Ply => {
            let file = ply::decode(bytes)?;
            (file.mesh, file.warnings)
        }
        Format::Stl => {
            let file = stl::decode(bytes)?;
            return Ok(Decoded { mesh: file.mesh, warnings: file.warnings });
        }
    };
    let triangulation = polygons.triangulation();
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
