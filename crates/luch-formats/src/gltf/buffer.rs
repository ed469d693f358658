//! Buffers and the views into them, all checked before anything is read.

use super::json::Json;
use super::uri::{self, Target};
use crate::{Files, Problem};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// The bytes of the file.
#[derive(Debug)]
pub(super) struct Buffers {
    buffers: Vec<Buffer>,
    views: Vec<View>,
    /// Bytes in memory, each file counted once.
    pub(super) total: u64,
}

#[derive(Debug)]
struct Buffer {
    /// At least `length` bytes, or none if the buffer is a placeholder.
    bytes: Option<Rc<Vec<u8>>>,
    length: usize,
}

/// A stretch of a buffer.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    buffer: usize,
    offset: usize,
    /// In bytes.
    pub(super) length: usize,
    /// Bytes from one element to the next, if the view says so.
    pub(super) stride: Option<usize>,
}

impl Buffers {
    /// Reads all buffers of the document and checks all views.
    pub(super) fn load(
        root: &Json,
        binary: Option<Vec<u8>>,
        file: &Path,
        files: &Files,
    ) -> Result<Self, Problem> {
        let list = root.list("buffers")?;
        let mut loader = Loader { file, files, known: BTreeMap::new(), total: 0 };
        let mut binary = binary.map(Rc::new);
        let mut buffers = Vec::with_capacity(list.len());
        for (place, json) in list.iter().enumerate() {
            // Only the first buffer can be the binary chunk.
            let chunk = if place == 0 { binary.take() } else { None };
            buffers.push(loader.buffer(&json, chunk)?);
        }
        let views =
            root.list("bufferViews")?.iter().map(|json| view(&json, &buffers)).collect::<Result<_, _>>()?;
        Ok(Self { buffers, views, total: loader.total })
    }

    /// All views.
    pub(super) fn views(&self) -> &[View] {
        &self.views
    }

    /// False if the view lies in a buffer without bytes.
    pub(super) fn has_bytes(&self, view: usize) -> bool {
        self.buffers[self.views[view].buffer].bytes.is_some()
    }

    /// The bytes of a view that was checked to exist, on behalf of `owner`.
    pub(super) fn bytes(&self, view: usize, owner: &Json) -> Result<&[u8], Problem> {
        let View { buffer, offset, length, .. } = self.views[view];
        let bytes = self.buffers[buffer].bytes.as_ref().ok_or_else(|| {
            owner.problem(format!(
                "needs /bufferViews/{view}, but its buffer {buffer} has no bytes (no \"uri\")"
            ))
        })?;
        Ok(&bytes[offset..offset + length])
    }
}

struct Loader<'a> {
    file: &'a Path,
    files: &'a Files,
    /// Files that were read, for buffers that share one.
    known: BTreeMap<PathBuf, Rc<Vec<u8>>>,
    total: u64,
}

impl Loader<'_> {
    fn buffer(&mut self, json: &Json, chunk: Option<Rc<Vec<u8>>>) -> Result<Buffer, Problem> {
        let length_json = json.need("byteLength")?;
        let length = length_json.size()?;
        let bytes = match json.get("uri")? {
            Some(uri) => Some(self.resolve(&uri)?),
            None => {
                self.total += chunk.as_ref().map_or(0, |bytes| bytes.len() as u64);
                chunk
            }
        };
        match &bytes {
            Some(bytes) if bytes.len() < length => {
                Err(length_json.problem(format!("is {length}, but the buffer has {} bytes", bytes.len())))
            }
            _ => Ok(Buffer { bytes, length }),
        }
    }

    fn resolve(&mut self, uri: &Json) -> Result<Rc<Vec<u8>>, Problem> {
        let names = match uri::resolve(uri, self.file)? {
            Target::Data(bytes) => {
                self.total += bytes.len() as u64;
                return Ok(Rc::new(bytes));
            }
            Target::File(names) => names,
        };
        if let Some(bytes) = self.known.get(&names[0]) {
            return Ok(Rc::clone(bytes));
        }
        let bytes = self
            .files
            .read(uri::existing(&names, self.files))
            .map_err(|problem| uri.problem(format!("{}: {}", names[0].display(), problem.message)))?;
        self.total += bytes.len() as u64;
        let bytes = Rc::new(bytes);
        self.known.insert(names[0].clone(), Rc::clone(&bytes));
        Ok(bytes)
    }
}

fn view(json: &Json, buffers: &[Buffer]) -> Result<View, Problem> {
    let buffer = json.need("buffer")?.reference_within(buffers.len(), "/buffers")?;
    let offset = json.get("byteOffset")?.map_or(Ok(0), |offset| offset.size())?;
    let length = json.need("byteLength")?.size()?;
    let stride = json.get("byteStride")?.map(|stride| stride.size()).transpose()?;
    let most = buffers[buffer].length;
    if offset.checked_add(length).is_none_or(|end| end > most) {
        return Err(json.problem(format!(
            "reaches from byte {offset} over {length} bytes, but /buffers/{buffer} has {most}"
        )));
    }
    Ok(View { buffer, offset, length, stride })
}
