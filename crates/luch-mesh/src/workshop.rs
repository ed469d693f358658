//! The workshop: every way to make or change a mesh, by name, as text.
//!
//! A [`Verb`] is a description of a function of this crate: its name, its parameters with their ranges, what it keeps, how to call
//! it. The command line, scene files, the documentation and the contract suite are all made from the one list [`verbs`].
//!
//! ```
//! use luch_mesh::workshop::{NoFiles, Pipeline};
//!
//! let pipeline = Pipeline::parse("cuboid --size 2 | flip")?;
//! let mesh = pipeline.run(&mut NoFiles)?;
//! assert_eq!(mesh.face_count(), 6);
//! # Ok::<(), luch_mesh::workshop::WorkshopError>(())
//! ```

mod arguments;
mod basics;
mod edits;
mod error;
mod forms;
mod heights;
mod implicits;
mod patches;
mod pipeline;
mod reference;
mod repairs;
mod subdivisions;
mod value;
mod verb;

pub use arguments::Arguments;
pub use error::WorkshopError;
pub use implicits::FormulaSurface;
pub use pipeline::{Pipeline, Step};
pub use reference::reference;
pub use value::{Kind, Value};
pub use verb::{Action, Fallback, Keeps, Parameter, Verb};

use crate::PolygonMesh;
use crate::screen::ScreenView;

/// Where steps get what lies outside the pipeline; libraries do not touch the disk.
pub trait Files {
    /// The bytes of a file.
    fn bytes(&mut self, name: &str) -> Result<Vec<u8>, String>;
    /// A mesh: from a file in any format that the caller can read.
    fn mesh(&mut self, name: &str) -> Result<PolygonMesh, String>;
    /// The cameras that see the mesh, in its own coordinates; none if it is not seen.
    fn views(&mut self) -> Result<Vec<ScreenView>, String> {
        Err("there is no camera here: pixels are for meshes of scenes".into())
    }
}

/// There are no files.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoFiles;

impl Files for NoFiles {
    fn bytes(&mut self, _: &str) -> Result<Vec<u8>, String> {
        Err("there are no files here".into())
    }

    fn mesh(&mut self, _: &str) -> Result<PolygonMesh, String> {
        Err("there are no files here".into())
    }
}

/// Every file is empty: for checking arguments before files are read.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unread;

impl Files for Unread {
    fn bytes(&mut self, _: &str) -> Result<Vec<u8>, String> {
        Ok(Vec::new())
    }

    fn mesh(&mut self, _: &str) -> Result<PolygonMesh, String> {
        Ok(PolygonMesh::default())
    }

    fn views(&mut self) -> Result<Vec<ScreenView>, String> {
        Ok(Vec::new())
    }
}

/// All verbs, by group in the order of a table of contents.
pub fn verbs() -> impl Iterator<Item = &'static Verb> {
    [
        forms::VERBS,
        patches::VERBS,
        implicits::VERBS,
        heights::VERBS,
        basics::VERBS,
        edits::VERBS,
        repairs::VERBS,
        subdivisions::VERBS,
    ]
    .into_iter()
    .flatten()
}

/// The verb of this name, or the closest names to one that does not exist.
pub fn find(name: &str) -> Result<&'static Verb, WorkshopError> {
    verbs().find(|verb| verb.name == name).ok_or_else(|| {
        let close = error::closest(name, verbs().map(|verb| verb.name));
        let advice = close.map_or(String::new(), |close| format!("; did you mean `{close}`?"));
        WorkshopError::new(format!("there is no verb `{name}`{advice}"))
    })
}

#[cfg(test)]
mod tests;
