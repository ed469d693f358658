//! Where bytes come from: the disk, or memory in tests.

use crate::Problem;
use crate::scene_file::normal;
use std::collections::BTreeMap;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Largest file that is read, in bytes.
const LARGEST_FILE: u64 = 8 << 30;

/// The files a scene is made of.
#[derive(Debug, Default)]
pub struct Files {
    memory: Option<BTreeMap<PathBuf, Vec<u8>>>,
    /// What was read from the disk.
    taken: Mutex<Vec<PathBuf>>,
}

impl Files {
    /// Files on the disk.
    pub fn disk() -> Self {
        Self::default()
    }

    /// Files in memory, by their paths; the disk is never touched.
    pub fn memory(files: impl IntoIterator<Item = (PathBuf, Vec<u8>)>) -> Self {
        let files = files.into_iter().map(|(path, bytes)| (normal(&path), bytes)).collect();
        Self { memory: Some(files), ..Self::default() }
    }

    /// The bytes of a file.
    ///
    /// # Errors
    /// If it is absent, no plain file, unreadable or larger than 8 GiB.
    pub fn read(&self, path: &Path) -> Result<Vec<u8>, Problem> {
        if let Some(memory) = &self.memory {
            return memory.get(&normal(path)).cloned().ok_or_else(|| Problem::new(path, "no such file"));
        }
        let fail = |error: std::io::Error| match error.kind() {
            std::io::ErrorKind::NotFound => Problem::new(path, "no such file"),
            std::io::ErrorKind::PermissionDenied => Problem::new(path, "permission denied"),
            _ => Problem::new(path, format!("cannot be read: {error}")),
        };
        let about = std::fs::metadata(path).map_err(fail)?;
        if about.is_dir() {
            return Err(Problem::new(path, "is a folder, not a file"));
        }
        if !about.is_file() {
            return Err(Problem::new(path, "is not a plain file"));
        }
        if about.len() > LARGEST_FILE {
            return Err(Problem::new(
                path,
                format!("has {} bytes, at most {LARGEST_FILE} are read", about.len()),
            ));
        }
        let mut bytes = Vec::with_capacity(about.len() as usize);
        std::fs::File::open(path).map_err(fail)?.take(LARGEST_FILE).read_to_end(&mut bytes).map_err(fail)?;
        self.taken.lock().unwrap_or_else(PoisonError::into_inner).push(path.to_owned());
        Ok(bytes)
    }

    /// The files that were read from the disk, so that nobody writes over them.
    pub fn taken(&self) -> Vec<PathBuf> {
        self.taken.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// True if there is such a file.
    pub fn has(&self, path: &Path) -> bool {
        match &self.memory {
            Some(memory) => memory.contains_key(&normal(path)),
            None => path.is_file(),
        }
    }

    /// What is equal for all paths of one file: links followed, steps out of a folder taken back. Nothing is said of files that are absent.
    pub(crate) fn identity(&self, path: &Path) -> PathBuf {
        let true_name = if self.memory.is_none() { path.canonicalize().ok() } else { None };
        true_name.unwrap_or_else(|| normal(path))
    }

    /// The path that `reference`, written in `file`, means: relative to the folder of `file`, either slash accepted.
    pub fn beside(file: &Path, reference: &str) -> PathBuf {
        let reference = reference.replace('\\', "/");
        file.parent().unwrap_or(Path::new("")).join(reference)
    }
}
