//! What is wrong with a formula, and where.

use std::fmt;
use std::ops::Range;

/// A formula that cannot be understood. Its `Display` shows the line with the place marked underneath.
///
/// ```
/// let error = luch_formula::parse("x^2 + raduis", &["x", "radius"]).unwrap_err();
/// assert_eq!((error.span(), error.line(), error.column()), (6..12, 1, 7));
/// assert_eq!(
///     error.to_string(),
///     "unknown name `raduis`: did you mean `radius`?\n 1 | x^2 + raduis\n   |       ^^^^^^"
/// );
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct FormulaError {
    kind: FormulaErrorKind,
    span: Range<usize>,
    text: String,
}

/// What is wrong with a formula.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FormulaErrorKind {
    /// A character that stands for nothing.
    #[error("unknown character `{found}`{}", hinted(hint))]
    UnknownCharacter {
        /// The character, made printable.
        found: String,
        /// What to write instead, if that can be guessed.
        hint: String,
    },
    /// A number that does not read as one.
    #[error("`{text}` is not a number; write 12, 0.5 or 1.5e-3")]
    BadNumber {
        /// What was written.
        text: String,
    },
    /// A piece that does not fit where it stands.
    #[error("expected {expected}, found {found}{}", hinted(hint))]
    Unexpected {
        /// What may stand there.
        expected: String,
        /// What does.
        found: String,
        /// What to write instead, if that can be guessed.
        hint: String,
    },
    /// A name that nobody gave.
    #[error("unknown name `{name}`{}", guess(suggestion, known))]
    UnknownName {
        /// The name.
        name: String,
        /// The known name closest to it.
        suggestion: Option<String>,
        /// All names given by the caller and the formula.
        known: Vec<String>,
    },
    /// A function that does not exist.
    #[error("unknown function `{name}`{}", guess(suggestion, known))]
    UnknownFunction {
        /// The name.
        name: String,
        /// The known function closest to it.
        suggestion: Option<String>,
        /// All functions.
        known: Vec<String>,
    },
    /// A number of arguments that the function does not take.
    #[error("`{function}` takes {accepted}, not {given}: write {usage}")]
    ArgumentCount {
        /// The function.
        function: String,
        /// How many it takes, in words.
        accepted: String,
        /// How many were given.
        given: usize,
        /// How it is written.
        usage: String,
    },
    /// An argument that has to be a constant in some range.
    #[error("{what}")]
    BadArgument {
        /// What it has to be.
        what: String,
    },
    /// A name that cannot be given, or not again.
    #[error("`{name}` {reason}")]
    BadName {
        /// The name.
        name: String,
        /// Why not.
        reason: String,
    },
    /// More parentheses, signs or powers inside one another than are followed.
    #[error("nested more than {limit} levels deep; give parts a name: `a = …; …`")]
    TooDeep {
        /// The greatest depth.
        limit: usize,
    },
    /// A text too long to be a formula.
    #[error("{length} bytes long; at most {limit} are read")]
    TooLong {
        /// Its length.
        length: usize,
        /// The greatest length.
        limit: usize,
    },
}

fn hinted(hint: &str) -> String {
    if hint.is_empty() { String::new() } else { format!("; {hint}") }
}

fn guess(suggestion: &Option<String>, known: &[String]) -> String {
    match suggestion {
        Some(name) => format!(": did you mean `{name}`?"),
        None if known.is_empty() => ": no names are known here".into(),
        None => {
            // A dozen names help; a hundred do not.
            let shown: Vec<_> = known.iter().take(12).map(String::as_str).collect();
            let more = if known.len() > shown.len() { ", …" } else { "" };
            format!("; known are {}{more}", shown.join(", "))
        }
    }
}

impl FormulaError {
    pub(crate) fn new(kind: FormulaErrorKind, span: Range<usize>, text: &str) -> Self {
        Self { kind, span, text: text.to_owned() }
    }

    /// What is wrong.
    pub fn kind(&self) -> &FormulaErrorKind {
        &self.kind
    }

    /// The message alone, without the place.
    pub fn message(&self) -> String {
        self.kind.to_string()
    }

    /// The bytes of the text that are meant; empty at the end of a formula that stops too early.
    pub fn span(&self) -> Range<usize> {
        self.span.clone()
    }

    /// The line of the first byte, from 1.
    pub fn line(&self) -> usize {
        1 + self.text[..self.span.start].bytes().filter(|&byte| byte == b'\n').count()
    }

    /// The column of the first byte in characters, from 1.
    pub fn column(&self) -> usize {
        1 + self.text[self.line_start()..self.span.start].chars().count()
    }

    fn line_start(&self) -> usize {
        self.text[..self.span.start].rfind('\n').map_or(0, |newline| newline + 1)
    }
}

/// Characters of a long line that are shown before and after the place.
const BEFORE: usize = 60;
const AFTER: usize = 40;

impl fmt::Display for FormulaError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}", self.kind)?;
        let start = self.line_start();
        let line = self.text[start..].split('\n').next().unwrap_or_default();
        let column = self.column() - 1;
        let end = self.span.end.min(start + line.len()).max(self.span.start);
        let marked = self.text[self.span.start..end].chars().count().max(1);
        let skipped = column.saturating_sub(BEFORE);
        let shown: String = line
            .chars()
            .skip(skipped)
            .take(column - skipped + AFTER)
            .map(|character| if character.is_control() { ' ' } else { character })
            .collect();
        let cut_left = if skipped > 0 { "…" } else { "" };
        let cut_right = if skipped + shown.chars().count() < line.chars().count() { "…" } else { "" };
        let number = self.line().to_string();
        let margin = " ".repeat(number.len());
        let indent = " ".repeat(column - skipped + cut_left.chars().count());
        let carets = "^".repeat(marked.min(AFTER));
        write!(out, "\n {number} | {cut_left}{}{cut_right}", shown.trim_end())?;
        write!(out, "\n {margin} | {indent}{carets}")
    }
}

impl std::error::Error for FormulaError {}
