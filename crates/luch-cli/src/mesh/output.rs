//! Where meshes go: files, standard output, or a summary in a terminal.

use super::info;
use crate::args::MeshOutputArgs;
use crate::failure::{Failure, Outcome};
use luch::formats::{self, MeshFile};
use luch::mesh::codec::{self, EncodeOptions, Format};
use std::io::{ErrorKind, IsTerminal, Write};
use std::path::Path;

pub(super) fn write(file: &MeshFile, args: &MeshOutputArgs) -> Result<Outcome, Failure> {
    let options = EncodeOptions {
        materials: file.materials.clone(),
        library: file.libraries.first().cloned(),
        ..EncodeOptions::default()
    };
    for path in &args.output {
        if path == Path::new("-") {
            to_standard_output(file, &options, args)?;
        } else {
            formats::write_mesh(path, &file.mesh, &options)?;
        }
    }
    if args.output.is_empty() {
        if std::io::stdout().is_terminal() && args.format.is_none() {
            info::summarise(&file.mesh);
        } else {
            to_standard_output(file, &options, args)?;
        }
    }
    Ok(Outcome::Done)
}

fn to_standard_output(
    file: &MeshFile,
    options: &EncodeOptions,
    args: &MeshOutputArgs,
) -> Result<(), Failure> {
    let format = match args.format.as_deref() {
        None => Format::Obj,
        Some(name) => Format::from_extension(name).ok_or_else(|| {
            let known: Vec<_> = Format::ALL.iter().map(|format| format.extension()).collect();
            Failure::usage(format!("`{name}` is no mesh format; accepted are {}", known.join(", ")))
        })?,
    };
    let bytes = codec::encode_polygons(&file.mesh, format, options)?;
    let mut out = std::io::stdout().lock();
    match out.write_all(&bytes).and_then(|()| out.flush()) {
        // Whoever stops reading has seen enough.
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::new(format!("standard output cannot be written: {error}")))
        }
        _ => Ok(()),
    }
}
