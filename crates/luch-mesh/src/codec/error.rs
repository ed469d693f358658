//! What readers say when a file is wrong, or merely odd.

use std::fmt;

/// Where in a file something stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// In a text: line and column, both from 1; columns count bytes.
    Text {
        /// Line.
        line: u64,
        /// Column.
        column: u64,
    },
    /// In binary data: distance from the first byte.
    Byte {
        /// Distance.
        offset: u64,
    },
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Text { line, column } => write!(f, "line {line}, column {column}"),
            Self::Byte { offset } => write!(f, "byte {offset}"),
        }
    }
}

/// What sort of mistake it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorKind {
    /// The text or data is not of the form it should be.
    Syntax,
    /// The file ends too early.
    Truncated,
    /// A reference to something that does not exist.
    IndexOutOfRange,
    /// More than can be represented.
    TooLarge,
    /// Sound, perhaps, but of a kind that is not read here.
    Unsupported,
}

/// Why a file could not be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{place}: found {found}, expected {expected}")]
pub struct DecodeError {
    /// The sort of mistake.
    pub kind: ErrorKind,
    /// Where it is.
    pub place: Place,
    /// What stands there: a short quotation or description.
    pub found: String,
    /// What would have been accepted.
    pub expected: String,
}

impl DecodeError {
    pub(crate) fn new(
        kind: ErrorKind,
        place: Place,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        Self { kind, place, found: found.into(), expected: expected.into() }
    }
}

/// Why a mesh could not be written.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EncodeError {
    /// The mesh breaks a promise of its type.
    #[error("the mesh is broken: {0}")]
    Broken(String),
    /// The format cannot hold so much.
    #[error("{format} files hold at most {most} {what}, the mesh has {found}")]
    TooLarge {
        /// The format's name.
        format: &'static str,
        /// What there is too much of.
        what: &'static str,
        /// How many the format holds.
        most: u64,
        /// How many there are.
        found: u64,
    },
}

/// Something odd that did not stop the reader.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// The line it is about, from 1; `None` for binary data and for the file as a whole.
    pub line: Option<u64>,
    /// What it is and what was done.
    pub message: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "line {line}: {}", self.message),
            None => f.write_str(&self.message),
        }
    }
}

/// Collects oddities: one entry for each kind, with its first line and how often it came.
#[derive(Default)]
pub(crate) struct Warnings {
    kinds: Vec<Kind>,
    /// Messages that found no room.
    unlisted: usize,
}

struct Kind {
    message: String,
    line: Option<u64>,
    count: usize,
}

impl Warnings {
    /// The most kinds that are listed: a hostile file must not fill the memory with its oddities.
    const MOST: usize = 100;

    pub(crate) fn add(&mut self, line: Option<u64>, message: &str) {
        if let Some(kind) = self.kinds.iter_mut().find(|kind| kind.message == message) {
            kind.count += 1;
        } else if self.kinds.len() < Self::MOST {
            self.kinds.push(Kind { message: message.to_owned(), line, count: 1 });
        } else {
            self.unlisted += 1;
        }
    }

    pub(crate) fn into_list(self) -> Vec<Warning> {
        let mut list: Vec<Warning> = self
            .kinds
            .into_iter()
            .map(|Kind { message, line, count }| Warning {
                line,
                message: if count > 1 { format!("{message} ({count} times)") } else { message },
            })
            .collect();
        if self.unlisted > 0 {
            list.push(Warning { line: None, message: format!("and {} more oddities", self.unlisted) });
        }
        list
    }
}

/// A short, printable quotation of bytes.
pub(crate) fn quote(bytes: &[u8]) -> String {
    const LONGEST: usize = 40;
    let text = String::from_utf8_lossy(&bytes[..bytes.len().min(LONGEST)]);
    let dots = if bytes.len() > LONGEST { "…" } else { "" };
    format!("“{}{dots}”", text.escape_debug())
}
