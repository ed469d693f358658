//! The letters and numbers of SVG path data.

use super::OutlineError;

/// Reads path data from left to right.
pub(super) struct Scanner<'a> {
    text: &'a str,
    place: usize,
}

impl<'a> Scanner<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self { text, place: 0 }
    }

    /// What is wrong here.
    pub(super) fn error(&self, expected: &str) -> OutlineError {
        let found = match self.rest().chars().next() {
            Some(letter) => format!("found “{letter}”"),
            None => "the path ends".into(),
        };
        let character = self.text[..self.place].chars().count() + 1;
        OutlineError::Syntax { character, message: format!("{found}, expected {expected}") }
    }

    fn rest(&self) -> &'a str {
        &self.text[self.place..]
    }

    /// Passes over blanks and commas.
    fn skip(&mut self) {
        let rest = self.rest();
        self.place += rest.len() - rest.trim_start_matches(|c: char| c.is_whitespace() || c == ',').len();
    }

    /// The next letter, if there is one.
    pub(super) fn command(&mut self) -> Option<char> {
        self.skip();
        let letter = self.rest().chars().next().filter(char::is_ascii_alphabetic)?;
        self.place += 1;
        Some(letter)
    }

    /// Goes back to the letter just read.
    pub(super) fn step_back(&mut self) {
        self.place -= 1;
    }

    /// Whether nothing is left.
    pub(super) fn is_done(&mut self) -> bool {
        self.skip();
        self.rest().is_empty()
    }

    /// Whether a number comes next.
    pub(super) fn has_number(&mut self) -> bool {
        self.skip();
        self.rest().starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.'))
    }

    /// A number; `.5.5` are two, and so are `1-2`.
    pub(super) fn number(&mut self) -> Result<f64, OutlineError> {
        self.skip();
        let bytes = self.rest().as_bytes();
        let digits = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
        let mut length = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
        length += digits(length);
        if bytes.get(length) == Some(&b'.') {
            length += 1 + digits(length + 1);
        }
        if matches!(bytes.get(length), Some(b'e' | b'E')) {
            let sign = usize::from(matches!(bytes.get(length + 1), Some(b'+' | b'-')));
            let exponent = digits(length + 1 + sign);
            length += if exponent > 0 { 1 + sign + exponent } else { 0 };
        }
        let number = self.rest()[..length].parse().ok().filter(|n: &f64| n.is_finite());
        let number = number.ok_or_else(|| self.error("a number"))?;
        self.place += length;
        Ok(number)
    }

    /// A flag of an arc: 0 or 1, which needs no blank after it.
    pub(super) fn flag(&mut self) -> Result<bool, OutlineError> {
        self.skip();
        let flag = match self.rest().as_bytes().first() {
            Some(b'0') => false,
            Some(b'1') => true,
            _ => return Err(self.error("0 or 1")),
        };
        self.place += 1;
        Ok(flag)
    }
}
