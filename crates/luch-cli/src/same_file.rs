//! Whether two names mean one file, so that nothing that is read is replaced.

use crate::failure::Failure;
use std::path::{Path, PathBuf};

/// The folder a file is in.
pub(crate) fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Where a file is or would be: links are followed, `.` and `..` are gone.
pub(crate) fn place(path: &Path) -> PathBuf {
    if let Ok(place) = path.canonicalize() {
        return place;
    }
    match (folder_of(path).canonicalize(), path.file_name()) {
        (Ok(folder), Some(name)) => folder.join(name),
        _ => path.to_owned(),
    }
}

/// Refuses to write any of `targets` if that is one of the files that are read.
pub(crate) fn refuse_replacing(targets: &[&Path], sources: &[impl AsRef<Path>]) -> Result<(), Failure> {
    for target in targets {
        if let Some(source) = sources.iter().find(|source| is_same(target, source.as_ref())) {
            return Err(Failure::usage(format!(
                "{}: would replace {}, which is read; name another file to write",
                target.display(),
                source.as_ref().display()
            )));
        }
    }
    Ok(())
}

/// Two names of one file, hard links among them.
fn is_same(a: &Path, b: &Path) -> bool {
    place(a) == place(b) || is_hard_link(a, b)
}

#[cfg(unix)]
fn is_hard_link(a: &Path, b: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let identity = |path: &Path| std::fs::metadata(path).ok().map(|about| (about.dev(), about.ino()));
    identity(a).is_some_and(|own| identity(b) == Some(own))
}

#[cfg(not(unix))]
fn is_hard_link(_: &Path, _: &Path) -> bool {
    false
}
