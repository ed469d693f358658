//! Which format a file is of, and who reads it.

use crate::resolve::{self, Imports};
use crate::scene_file::clip;
use crate::{Files, LoadError, Loaded, Problem};
use crate::{bare_mesh, gltf, mitsuba, obj_scene};
use luch_mesh::codec::Format as MeshFormat;
use std::path::Path;

/// A format that holds a scene or a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SceneFormat {
    /// Luch's own scenes (`docs/scene-format.md`).
    Kdl,
    /// glTF 2.0, text or binary.
    Gltf,
    /// A scene of Mitsuba (XML).
    Mitsuba,
    /// Wavefront OBJ with its MTL files.
    Obj,
    /// A Stanford PLY mesh.
    Ply,
    /// A stereolithography mesh.
    Stl,
    /// A mesh in Geomview's object file format.
    Off,
    /// A mesh in the 3D Manufacturing Format.
    ThreeMf,
}

impl SceneFormat {
    /// All formats.
    pub const ALL: [Self; 8] =
        [Self::Kdl, Self::Gltf, Self::Mitsuba, Self::Obj, Self::Ply, Self::Stl, Self::Off, Self::ThreeMf];

    /// File extensions in lower case, without the dot.
    pub const fn extensions(self) -> &'static [&'static str] {
        match self {
            Self::Kdl => &["kdl"],
            Self::Gltf => &["gltf", "glb"],
            Self::Mitsuba => &["xml"],
            Self::Obj => &["obj"],
            Self::Ply => &["ply"],
            Self::Stl => &["stl"],
            Self::Off => &["off"],
            Self::ThreeMf => &["3mf"],
        }
    }

    /// The format of a file name's extension, in either case.
    pub fn from_path(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?.to_ascii_lowercase();
        Self::ALL.into_iter().find(|format| format.extensions().contains(&extension.as_str()))
    }

    /// The format as far as the content tells.
    pub fn from_content(bytes: &[u8]) -> Option<Self> {
        if bytes.starts_with(b"glTF") {
            return Some(Self::Gltf);
        }
        let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
        if start.starts_with(b"{") {
            return Some(Self::Gltf);
        }
        if start.starts_with(b"<?xml") || start.starts_with(b"<scene") {
            return Some(Self::Mitsuba);
        }
        match MeshFormat::from_magic(bytes) {
            Some(MeshFormat::Ply) => Some(Self::Ply),
            Some(MeshFormat::Stl) => Some(Self::Stl),
            Some(MeshFormat::Obj) => Some(Self::Obj),
            Some(MeshFormat::Off) => Some(Self::Off),
            Some(MeshFormat::ThreeMf) => Some(Self::ThreeMf),
            Some(MeshFormat::Glb | MeshFormat::Gltf) => Some(Self::Gltf),
            None => has_version_line(start).then_some(Self::Kdl),
        }
    }

    /// All extensions with their dots, for messages.
    pub fn accepted() -> String {
        let all: Vec<String> =
            Self::ALL.iter().flat_map(|f| f.extensions()).map(|e| format!(".{e}")).collect();
        all.join(", ")
    }
}

/// True if one of the first lines is `luch` and a number.
fn has_version_line(bytes: &[u8]) -> bool {
    let mut lines = bytes.split(|&b| b == b'\n').take(100).map(<[u8]>::trim_ascii);
    lines.any(|line| {
        line.strip_prefix(b"luch").is_some_and(|rest| rest.first().is_some_and(u8::is_ascii_whitespace))
    })
}

/// Reads a file as it is: no camera or light is added, and problems of the scene are not looked for. `imports` are the
/// scenes that ask for this one, and those read by now.
pub(crate) fn read(path: &Path, files: &Files, imports: &mut Imports) -> Result<Loaded, LoadError> {
    let format = match SceneFormat::from_path(path) {
        Some(format) => format,
        None => {
            let bytes = files.read(path)?;
            let accepted = SceneFormat::accepted();
            let unknown = Problem::new(path, "is of no format that is known here");
            SceneFormat::from_content(&bytes)
                .ok_or_else(|| unknown.help(format!("accepted are {accepted}")))?
        }
    };
    if format != SceneFormat::Mitsuba
        && let Some(name) = imports.parameters().keys().next()
    {
        let message = format!("has no parameter \"{}\"", clip(name));
        return Err(Problem::new(path, message).help("only scenes of Mitsuba (.xml) have parameters").into());
    }
    match format {
        SceneFormat::Kdl => resolve::load(path, files, imports),
        SceneFormat::Gltf => gltf::load(path, files, imports.pictures()),
        SceneFormat::Mitsuba => mitsuba::load(path, files, imports.pictures(), &imports.parameters()),
        SceneFormat::Obj => obj_scene::load(path, files, imports.pictures()),
        SceneFormat::Ply => bare_mesh::load(path, files, MeshFormat::Ply),
        SceneFormat::Stl => bare_mesh::load(path, files, MeshFormat::Stl),
        SceneFormat::Off => bare_mesh::load(path, files, MeshFormat::Off),
        SceneFormat::ThreeMf => bare_mesh::load(path, files, MeshFormat::ThreeMf),
    }
}
