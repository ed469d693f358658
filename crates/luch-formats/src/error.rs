//! What went wrong in a file, and where.

use std::fmt;
use std::path::{Path, PathBuf};

/// A place inside a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// A stretch of text.
    Text {
        /// Line, counted from 1.
        line: usize,
        /// Column in characters, counted from 1.
        column: usize,
        /// The whole line, without its end.
        source: String,
        /// Characters from the column on that are meant, at least 1.
        length: usize,
    },
    /// A byte, counted from 0.
    Byte(u64),
    /// A thing inside a structured file, such as `/nodes/3/mesh`.
    Path(String),
}

/// One thing that is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// The file it is in, as the user named it or as another file referred to it.
    pub file: PathBuf,
    /// Where in the file; `None` if the whole file is meant.
    pub place: Option<Place>,
    /// What is wrong, quoting the offending text.
    pub message: String,
    /// What to write instead.
    pub help: Option<String>,
}

impl Problem {
    /// A problem with the whole of a file.
    pub fn new(file: &Path, message: impl Into<String>) -> Self {
        Self { file: file.to_owned(), place: None, message: message.into(), help: None }
    }

    /// The same problem at a place.
    pub fn at(mut self, place: Place) -> Self {
        self.place = Some(place);
        self
    }

    /// The same problem with advice.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

impl fmt::Display for Problem {
    /// `file:line:column: message`, then the line with a mark under the place, then the advice.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let file = self.file.display();
        match &self.place {
            None => write!(f, "{file}: {}", self.message)?,
            Some(Place::Byte(offset)) => write!(f, "{file}: byte {offset}: {}", self.message)?,
            Some(Place::Path(path)) => write!(f, "{file}: {path}: {}", self.message)?,
            Some(Place::Text { line, column, source, length }) => {
                write!(f, "{file}:{line}:{column}: {}", self.message)?;
                let number = line.to_string();
                let (shown, column) = window(source, *column);
                let margin = " ".repeat(number.len());
                let mark =
                    "^".repeat((*length).clamp(1, (shown.chars().count() + 2).saturating_sub(column).max(1)));
                write!(f, "\n {number} | {shown}\n {margin} | {}{mark}", " ".repeat(column - 1))?;
            }
        }
        if let Some(help) = &self.help {
            write!(f, "\n  help: {help}")?;
        }
        Ok(())
    }
}

/// The part of a long line about `column`, tabs as blanks, and the column within it.
fn window(source: &str, column: usize) -> (String, usize) {
    let skipped = if column > 100 { column - 60 } else { 0 };
    let clean = |c: char| if c.is_control() { ' ' } else { c };
    (source.chars().skip(skipped).take(120).map(clean).collect(), column.max(1) - skipped)
}

/// Why a file could not be read: one problem or more.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", .problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))]
pub struct LoadError {
    /// At least one.
    pub problems: Vec<Problem>,
}

impl From<Problem> for LoadError {
    fn from(problem: Problem) -> Self {
        Self { problems: vec![problem] }
    }
}

/// Something in a file that was not honoured, or guessed.
pub type Warning = Problem;
