//! The two containers: JSON text (.gltf) and binary chunks (.glb, glTF 2.0 specification, section 4).

use super::notices::Notices;
use crate::{Place, Problem};
use serde_json::Value;
use std::ops::Range;
use std::path::Path;

/// Most brackets and commas of a document; each may cost about 100 bytes of memory.
const MOST_JSON_VALUES: usize = 1 << 25;

const JSON_CHUNK: u32 = 0x4E4F_534A;
const BINARY_CHUNK: u32 = 0x004E_4942;

/// A file taken apart.
#[derive(Debug)]
pub(super) struct Container {
    /// The document.
    pub(super) json: Value,
    /// The binary chunk of a .glb file; padding may follow what the document uses.
    pub(super) binary: Option<Vec<u8>>,
}

impl Container {
    /// Reads either container, told apart by the first four bytes.
    pub(super) fn parse(file: &Path, mut bytes: Vec<u8>, notices: &mut Notices) -> Result<Self, Problem> {
        if !bytes.starts_with(b"glTF") {
            return Ok(Self { json: parse_text(file, &bytes)?, binary: None });
        }
        let chunks = find_chunks(file, &bytes, notices)?;
        let json = parse_json(&bytes[chunks.json.clone()])
            .map_err(|fault| fault.in_binary(file, chunks.json.start))?;
        let binary = chunks.binary.map(|range| {
            bytes.truncate(range.end);
            bytes.drain(..range.start);
            bytes
        });
        Ok(Self { json, binary })
    }
}

struct Chunks {
    json: Range<usize>,
    binary: Option<Range<usize>>,
}

fn find_chunks(file: &Path, bytes: &[u8], notices: &mut Notices) -> Result<Chunks, Problem> {
    let problem = |offset: usize, message: String| Problem::new(file, message).at(Place::Byte(offset as u64));
    let number = |offset: usize| -> Result<u32, Problem> {
        let four = bytes.get(offset..offset + 4).and_then(|four| four.try_into().ok());
        four.map(u32::from_le_bytes).ok_or_else(|| {
            problem(
                bytes.len(),
                "the file ends within a header; a .glb header has 12 bytes, a chunk's 8".into(),
            )
        })
    };
    let version = number(4)?;
    if version != 2 {
        return Err(problem(4, format!("binary glTF version {version}; version 2 is read")));
    }
    let end = number(8)? as usize;
    if end > bytes.len() || end < 12 {
        return Err(problem(8, format!("the header says {end} bytes, but the file has {}", bytes.len())));
    }
    if end < bytes.len() {
        notices
            .add("/", format!("{} bytes after the end of the .glb container are ignored", bytes.len() - end));
    }
    let (mut json, mut binary) = (None, None);
    let mut offset = 12;
    while offset < end {
        let length = number(offset)? as usize;
        let kind = number(offset + 4)?;
        let start = offset + 8;
        if length > end.saturating_sub(start) {
            let left = end.saturating_sub(start);
            return Err(problem(offset, format!("a chunk says {length} bytes, but only {left} follow")));
        }
        let range = start..start + length;
        match kind {
            JSON_CHUNK if json.is_none() => json = Some(range),
            _ if json.is_none() => {
                return Err(problem(
                    offset + 4,
                    format!("the first chunk has type {kind:#010x}, expected JSON"),
                ));
            }
            BINARY_CHUNK if binary.is_none() => binary = Some(range),
            JSON_CHUNK | BINARY_CHUNK => {
                return Err(problem(offset, "a second chunk of the same type".into()));
            }
            _ => notices.add("/", format!("a chunk of unknown type {kind:#010x} is ignored")),
        }
        offset = start + length;
    }
    let json = json.ok_or_else(|| problem(end, "the file has no JSON chunk".into()))?;
    Ok(Chunks { json, binary })
}

/// What is wrong with JSON text, and at which byte.
struct Fault {
    offset: usize,
    message: String,
}

impl Fault {
    fn in_binary(self, file: &Path, start: usize) -> Problem {
        Problem::new(file, self.message).at(Place::Byte((start + self.offset) as u64))
    }
}

fn parse_text(file: &Path, bytes: &[u8]) -> Result<Value, Problem> {
    parse_json(bytes).map_err(|fault| {
        /// Lines beyond this are no text for people; the byte is said instead.
        const LONGEST_LINE: usize = 10_000;
        let at = fault.offset.min(bytes.len());
        let start = bytes[..at].iter().rposition(|&byte| byte == b'\n').map_or(0, |newline| newline + 1);
        let end = bytes[start..]
            .iter()
            .position(|&byte| byte == b'\n')
            .map_or(bytes.len(), |length| start + length);
        if end - start > LONGEST_LINE {
            return fault.in_binary(file, 0);
        }
        let line = bytes[..start].iter().filter(|&&byte| byte == b'\n').count() + 1;
        let column = String::from_utf8_lossy(&bytes[start..at]).chars().count() + 1;
        let source = String::from_utf8_lossy(&bytes[start..end]).trim_end_matches('\r').to_owned();
        Problem::new(file, fault.message).at(Place::Text { line, column, source, length: 1 })
    })
}

fn parse_json(bytes: &[u8]) -> Result<Value, Fault> {
    // The specification forbids a byte order mark and allows readers to skip it.
    let skipped = if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
    let bytes = &bytes[skipped..];
    let values = bytes.iter().filter(|byte| matches!(byte, b',' | b'[' | b'{')).count();
    if values > MOST_JSON_VALUES {
        let message = format!("the document has over {values} values, at most {MOST_JSON_VALUES} are read");
        return Err(Fault { offset: 0, message });
    }
    serde_json::from_slice(bytes).map_err(|error| {
        let line_start = match error.line() {
            0 | 1 => 0,
            line => {
                let newlines = bytes.iter().enumerate().filter(|(_, byte)| **byte == b'\n');
                newlines.map(|(at, _)| at + 1).nth(line - 2).unwrap_or(bytes.len())
            }
        };
        let offset = skipped + (line_start + error.column().saturating_sub(1)).min(bytes.len());
        let said = error.to_string();
        let reason = said.rsplit_once(" at line ").map_or(said.as_str(), |(reason, _)| reason);
        Fault { offset, message: format!("no valid JSON: {reason}") }
    })
}
