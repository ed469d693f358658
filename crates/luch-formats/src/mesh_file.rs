//! Meshes from files of any kind and back: what the mesh workshop works on.

mod join;

use crate::resolve::Imports;
use crate::scene_file::clip;
use crate::write::{SaveError, write_atomically};
use crate::{Files, LoadError, Problem, SceneFormat, Warning, bare_mesh, format};
use luch_mesh::PolygonMesh;
use luch_mesh::codec::{self, EncodeOptions, Format};
use std::collections::BTreeMap;
use std::path::Path;

/// A mesh, and what its file says besides.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshFile {
    /// The mesh, as the file has it: nothing is welded, and normals are there only if the file has them.
    pub mesh: PolygonMesh,
    /// The name of each material slot; empty if the file names none.
    pub materials: Vec<String>,
    /// The names of the material files of an OBJ file.
    pub libraries: Vec<String>,
    /// What was left out or put right.
    pub warnings: Vec<Warning>,
}

/// Reads the mesh in a file of any format: OBJ, PLY, STL, OFF and 3MF as they are; of a scene (glTF, luch's own, Mitsuba) all
/// meshes that stand in it, each in its place, joined, with a slot for each material.
///
/// The format is told by the extension, or else by the content.
///
/// # Errors
/// If the file or one it needs cannot be read or understood.
pub fn read_mesh(path: &Path, files: &Files) -> Result<MeshFile, LoadError> {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("");
    let by_name = Format::from_extension(extension).filter(|format| format.can_be_read());
    if by_name.is_none() && SceneFormat::from_path(path).is_some() {
        let loaded = format::read(path, files, &mut Imports::new(&BTreeMap::new()))?;
        return join::join(path, loaded);
    }
    let bytes = files.read(path)?;
    decode_mesh(path, &bytes).map_err(|mut error| {
        if by_name.is_none() && error.problems.iter().all(|problem| problem.place.is_none()) {
            let help = format!("accepted are {}", SceneFormat::accepted());
            error.problems = vec![unknown(path).help(help)];
        }
        error
    })
}

/// Reads the mesh in some bytes, such as those of a pipe; `name` tells the format by its extension, or else the bytes do.
///
/// # Errors
/// If the bytes cannot be understood, or are a scene, which may need other files.
pub fn decode_mesh(name: &Path, bytes: &[u8]) -> Result<MeshFile, LoadError> {
    let extension = name.extension().and_then(|e| e.to_str()).unwrap_or("");
    let format = Format::from_extension(extension).or_else(|| Format::from_magic(bytes));
    let format = format.ok_or_else(|| unknown(name).help("accepted are .obj, .ply, .stl, .off, .3mf"))?;
    let decoded =
        codec::decode_polygons(bytes, format).map_err(|error| bare_mesh::problem(name, bytes, &error))?;
    Ok(MeshFile {
        mesh: decoded.mesh,
        materials: decoded.materials,
        libraries: decoded.libraries,
        warnings: decoded.warnings.iter().map(|warning| bare_mesh::told(name, bytes, warning)).collect(),
    })
}

/// Writes a mesh in the format of the extension, whole or not at all: `.obj`, `.ply`, `.stl`, `.off`, `.3mf`, `.glb` or `.gltf`.
///
/// What each format keeps is written at [`codec::encode_polygons`].
///
/// # Errors
/// If the extension is another, the mesh is broken, or the disk refuses.
pub fn write_mesh(path: &Path, mesh: &PolygonMesh, options: &EncodeOptions) -> Result<(), SaveError> {
    let format = format_to_write(path)?;
    let broken = |source| SaveError::Mesh { path: path.to_owned(), source };
    write_atomically(path, &codec::encode_polygons(mesh, format, options).map_err(broken)?)
}

/// The format of the extension of a file that is to be written.
pub(crate) fn format_to_write(path: &Path) -> Result<Format, SaveError> {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("");
    Format::from_extension(extension).ok_or_else(|| {
        let known = Format::ALL.map(Format::extension);
        SaveError::MeshExtension {
            path: path.to_owned(),
            advice: near(extension, &known).map_or(String::new(), |near| format!("; did you mean .{near}?")),
            accepted: known.map(|extension| format!(".{extension}")).join(", "),
        }
    })
}

/// The extension that one of at most eight letters may be a slip for: one letter wrong, or two swapped.
fn near<'a>(extension: &str, known: &[&'a str]) -> Option<&'a str> {
    let extension = extension.to_ascii_lowercase();
    let is_near = |known: &&&str| strsim::damerau_levenshtein(&extension, known) <= 1;
    known.iter().filter(|_| extension.len() <= 8).find(is_near).copied()
}

fn unknown(path: &Path) -> Problem {
    let extension = path.extension().map(|extension| clip(&extension.to_string_lossy()));
    let what = extension.map_or(String::new(), |extension| format!(" (.{extension})"));
    Problem::new(path, format!("is of no mesh format that is known here{what}"))
}
