//! Scene, mesh and image files to values and back. The only library of luch that touches the disk.
//!
//! [`load`] reads a scene (luch's own KDL format, glTF, Mitsuba's XML, OBJ with MTL) or a bare mesh (PLY, STL) and gives back a
//! [`Scene`] that is ready to be rendered: names are resolved, degrees are radians, a camera and light are there.
//!
//! ```
//! use luch_formats::{Files, load_with};
//! use std::path::Path;
//!
//! let text = r#"
//! luch 1
//! camera { from 0 1 4; to 0 1 0; fov 40 }
//! material "clay" { diffuse 0.8 0.5 0.3 }
//! object material="clay" { sphere radius=1; translate 0 1 0 }
//! environment 1
//! "#;
//! let files = Files::memory([("ball.kdl".into(), text.into())]);
//! let loaded = load_with(Path::new("ball.kdl"), &files)?;
//! assert_eq!(loaded.scene.instances.len(), 1);
//! assert!(loaded.scene.problems().is_empty());
//! # Ok::<(), luch_formats::LoadError>(())
//! ```
//!
//! A file that is wrong gives a [`LoadError`] with all that is wrong in it, each with its place:
//!
//! ```
//! # use luch_formats::{Files, load_with};
//! # use std::path::Path;
//! let text = "luch 1\nmaterial \"clay\" { difuse 0.8 }\ncamera { from 0 1 4; to 0 1 0 }";
//! let files = Files::memory([("ball.kdl".into(), text.into())]);
//! let error = load_with(Path::new("ball.kdl"), &files).unwrap_err();
//! assert!(error.to_string().starts_with("ball.kdl:2:19: unknown surface or option `difuse` in `material`"));
//! ```

mod bare_mesh;
mod error;
mod files;
mod finish;
mod format;
mod framing;
mod gltf;
mod images;
mod kdl;
mod material_values;
mod merge;
mod mesh_file;
mod mitsuba;
mod obj_scene;
pub mod ray_files;
mod resolve;
mod scene_file;
mod sky;
mod write;

pub use error::{LoadError, Place, Problem, Warning};
pub use files::Files;
pub use format::SceneFormat;
pub use framing::{bounding_sphere, framing_camera};
pub use mesh_file::{MeshFile, decode_mesh, read_mesh, write_mesh};
pub use sky::neutral_sky;
pub use write::{SaveError, replaced_file, save_image, save_mesh, write_atomically};

use luch_image::tone::Tone;
use luch_scene::Scene;
use std::collections::BTreeMap;
use std::path::Path;

/// A scene that was read, what in the file was not honoured, and what was chosen where the file says nothing.
#[derive(Clone, Debug, Default)]
pub struct Loaded {
    /// The scene; it has no [`problems`](Scene::problems).
    pub scene: Scene,
    /// What the file holds that luch does not do, or what is missing and was replaced.
    pub warnings: Vec<Warning>,
    /// What was chosen because the file is silent about it, such as a camera; one sentence each.
    pub notes: Vec<String>,
    /// What the file asks of whoever renders and shows it.
    pub wishes: Wishes,
}

/// What a scene file asks for and a command may decide otherwise: it changes no sample.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wishes {
    /// Samples of every pixel at which the picture is done.
    pub samples: Option<u64>,
    /// How the picture is to be shown.
    pub tone: Tone,
}

/// Reads the scene or mesh in a file; see [`load_with`].
///
/// # Errors
/// See [`load_with`].
pub fn load(path: &Path) -> Result<Loaded, LoadError> {
    load_with(path, &Files::disk())
}

/// Reads the scene or mesh at `path` among `files`.
///
/// The format is told by the extension, or else by the content; see [`SceneFormat`]. Other files are looked for beside
/// the file that names them. A file without a camera gets one that shows everything, a file without any light gets the
/// [`neutral_sky`]; both are told in [`Loaded::notes`].
///
/// # Errors
/// If the file or one it needs cannot be read or understood, or describes a scene that cannot be rendered. A missing
/// picture is no error but a warning: a neutral value takes its place.
pub fn load_with(path: &Path, files: &Files) -> Result<Loaded, LoadError> {
    load_with_parameters(path, files, &BTreeMap::new())
}

/// Reads the scene or mesh at `path` as [`load_with`] does, with values for the parameters that a Mitsuba scene declares with
/// `<default name="…">` or uses as `$name`. Other formats have no parameters: a value for one is an error.
///
/// # Errors
/// As [`load_with`], and if the scene has no parameter of a name.
pub fn load_with_parameters(
    path: &Path,
    files: &Files,
    parameters: &BTreeMap<String, String>,
) -> Result<Loaded, LoadError> {
    let loaded = format::read(path, files, &mut resolve::Imports::new(parameters))?;
    finish::finish(path, loaded)
}
