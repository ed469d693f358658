//! Films on the disk.

use crate::failure::Failure;
use luch::formats::Files;
use luch::render::Checkpoint;
use std::io::Read;
use std::path::Path;

/// The extension of films.
pub(crate) const EXTENSION: &str = "luch";

/// What films begin with.
const START: &[u8] = b"LUCHFILM";

/// Whether a file is called like a film.
pub(crate) fn is_film(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(EXTENSION))
}

/// Refuses to put a film where something else is, which could never be restored.
pub(crate) fn refuse_replacing_others(path: &Path) -> Result<(), Failure> {
    if !path.exists() {
        return Ok(());
    }
    let mut start = Vec::new();
    let length = START.len() as u64;
    let read = std::fs::File::open(path).and_then(|file| file.take(length).read_to_end(&mut start));
    read.map_err(|error| Failure::new(format!("{}: cannot be read: {error}", path.display())))?;
    if start == START {
        return Ok(());
    }
    Err(Failure::new(format!(
        "{}: is no film, it does not begin with LUCHFILM, and is not replaced by one; name another file or remove this one",
        path.display()
    )))
}

/// Reads a film; errors name the file.
pub(crate) fn read(path: &Path) -> Result<Checkpoint, Failure> {
    let bytes = Files::disk().read(path).map_err(|problem| Failure::new(problem.to_string()))?;
    Checkpoint::decode(&bytes).map_err(|error| Failure::new(format!("{}: {error}", path.display())))
}
