//! Films on the disk.

use crate::failure::Failure;
use luch::formats::Files;
use luch::render::Checkpoint;
use std::path::Path;

/// The extension of films.
pub(crate) const EXTENSION: &str = "luch";

/// Whether a file is called like a film.
pub(crate) fn is_film(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(EXTENSION))
}

/// Reads a film; errors name the file.
pub(crate) fn read(path: &Path) -> Result<Checkpoint, Failure> {
    let bytes = Files::disk().read(path).map_err(|problem| Failure::new(problem.to_string()))?;
    Checkpoint::decode(&bytes).map_err(|error| Failure::new(format!("{}: {error}", path.display())))
}
