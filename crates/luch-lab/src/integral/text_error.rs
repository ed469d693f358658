//! What is wrong with a short text, and where.

use luch_formula::FormulaError;
use std::fmt;

/// A text that cannot be understood. Its `Display` shows the text with the place marked underneath.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextError {
    message: String,
    text: String,
    at: usize,
}

impl TextError {
    /// `at` is a byte of `text`.
    pub(crate) fn new(message: impl Into<String>, text: &str, at: usize) -> Self {
        let mut at = at.min(text.len());
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        Self { message: message.into(), text: text.chars().take(400).collect(), at }
    }

    /// The error of a formula that stands in the text from byte `start` on.
    pub(crate) fn of_formula(error: &FormulaError, text: &str, start: usize) -> Self {
        Self::new(error.message(), text, start + error.span().start)
    }

    /// The message alone.
    pub fn message(&self) -> &str {
        &self.message
    }

    /// The column in characters, from 1.
    pub fn column(&self) -> usize {
        1 + self.text.char_indices().take_while(|(byte, _)| *byte < self.at).count()
    }
}

impl fmt::Display for TextError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shown: String = self.text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        write!(out, "{}\n {shown}\n {}^", self.message, " ".repeat(self.column() - 1))
    }
}

impl std::error::Error for TextError {}

/// The parts of a text between commas that stand in no parentheses, with the byte at which each begins.
pub(super) fn parts(text: &str, separator: char) -> Vec<(usize, &str)> {
    let (mut depth, mut start, mut parts) = (0i64, 0, Vec::new());
    for (at, character) in text.char_indices() {
        match character {
            '(' => depth += 1,
            ')' => depth -= 1,
            c if c == separator && depth <= 0 => {
                parts.push((start, &text[start..at]));
                start = at + c.len_utf8();
            }
            _ => {}
        }
    }
    parts.push((start, &text[start..]));
    parts
}

/// The value of a formula without variables that stands in `whole` from byte `start` on.
pub(super) fn constant(whole: &str, start: usize, text: &str) -> Result<f64, TextError> {
    let blank = text.len() - text.trim_start().len();
    let expression = luch_formula::parse(text.trim(), &[])
        .map_err(|error| TextError::of_formula(&error, whole, start + blank))?;
    match expression.as_constant() {
        Some(value) if !value.is_nan() => Ok(value),
        _ => Err(TextError::new("this has no value", whole, start + blank)),
    }
}
