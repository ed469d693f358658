//! Where meshes come from: files, standard input, pipelines in a text.

use crate::failure::Failure;
use crate::terminal;
use luch::formats::{self, MeshFile};
use luch::mesh::PolygonMesh;
use luch::mesh::workshop::{Files, Pipeline, find};
use std::io::{IsTerminal, Read};
use std::path::Path;

/// Files by their paths, for steps that want some.
pub(super) struct Disk;

impl Files for Disk {
    fn bytes(&mut self, name: &str) -> Result<Vec<u8>, String> {
        formats::Files::disk().read(Path::new(name)).map_err(|problem| problem.to_string())
    }

    fn mesh(&mut self, name: &str) -> Result<PolygonMesh, String> {
        of_file(Path::new(name)).map(|file| file.mesh).map_err(|failure| failure.to_string())
    }
}

/// A mesh from a file, or from standard input if there is none or it is `-`.
pub(super) fn read(path: Option<&Path>) -> Result<MeshFile, Failure> {
    match path {
        Some(path) if path != Path::new("-") => of_file(path),
        _ => of_standard_input(),
    }
}

/// A mesh from a file or from a pipeline such as `sphere --segments 32`: a text whose first word is a verb.
pub(crate) fn read_or_run(text: &str) -> Result<PolygonMesh, Failure> {
    let first = text.split([' ', '|']).next().unwrap_or_default();
    if !Path::new(text).exists() && find(first).is_ok() {
        return Ok(Pipeline::parse(text)?.run(&mut Disk)?);
    }
    Ok(of_file(Path::new(text))?.mesh)
}

fn of_file(path: &Path) -> Result<MeshFile, Failure> {
    let file = formats::read_mesh(path, &formats::Files::disk())?;
    warn(&file);
    Ok(file)
}

fn of_standard_input() -> Result<MeshFile, Failure> {
    let mut input = std::io::stdin().lock();
    if input.is_terminal() {
        let message = "no mesh: name a file, or pipe one in, as in `luch mesh cuboid | luch mesh info`";
        return Err(Failure::usage(message));
    }
    let mut bytes = Vec::new();
    input.read_to_end(&mut bytes).map_err(|error| Failure::new(format!("standard input: {error}")))?;
    if bytes.is_empty() {
        return Err(Failure::new("standard input is empty: what stands before the pipe gave no mesh"));
    }
    let file = formats::decode_mesh(Path::new("standard input"), &bytes)?;
    warn(&file);
    Ok(file)
}

fn warn(file: &MeshFile) {
    for warning in &file.warnings {
        terminal::complain(&format!("warning: {warning}"));
    }
}
