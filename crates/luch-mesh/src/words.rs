//! Words of a text with their places: for formats in which lines mean nothing.

use crate::codec::{DecodeError, ErrorKind, Place};

/// Walks the words of a text; what follows a `#` on a line is a comment.
pub(crate) struct Words<'a> {
    text: &'a [u8],
    position: usize,
    line: u64,
    line_start: usize,
}

/// One word.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Word<'a> {
    pub(crate) text: &'a [u8],
    pub(crate) place: Place,
}

impl<'a> Words<'a> {
    pub(crate) fn new(text: &'a [u8]) -> Self {
        let text = text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(text);
        Self { text, position: 0, line: 1, line_start: 0 }
    }

    /// How many bytes are left.
    pub(crate) fn rest(&self) -> usize {
        self.text.len() - self.position
    }

    fn place(&self) -> Place {
        Place::Text { line: self.line, column: (self.position - self.line_start) as u64 + 1 }
    }

    fn skip(&mut self) {
        let mut comment = false;
        while let Some(&byte) = self.text.get(self.position) {
            let pair = &self.text[self.position..self.text.len().min(self.position + 2)];
            match byte {
                // CR LF ends one line.
                b'\n' | b'\r' if pair != b"\r\n" => {
                    comment = false;
                    self.line += 1;
                    self.line_start = self.position + 1;
                }
                b'#' => comment = true,
                _ if comment || byte.is_ascii_whitespace() => {}
                _ => return,
            }
            self.position += 1;
        }
    }

    /// The next word, without taking it.
    pub(crate) fn peek(&mut self) -> Option<Word<'a>> {
        self.skip();
        let rest = &self.text[self.position..];
        let end = rest.iter().position(|b| b.is_ascii_whitespace() || *b == b'#').unwrap_or(rest.len());
        (end > 0).then(|| Word { text: &rest[..end], place: self.place() })
    }

    /// The next word; `expected` says what should be there.
    pub(crate) fn next(&mut self, expected: &str) -> Result<Word<'a>, DecodeError> {
        let word = self.peek().ok_or_else(|| DecodeError {
            kind: ErrorKind::Truncated,
            place: self.place(),
            found: "the end of the file".into(),
            expected: expected.into(),
        })?;
        self.position += word.text.len();
        Ok(word)
    }

    /// A finite number.
    pub(crate) fn number(&mut self, expected: &str) -> Result<f64, DecodeError> {
        let word = self.next(expected)?;
        let text = std::str::from_utf8(word.text).ok();
        let number = text.and_then(|text| text.parse().ok()).filter(|n: &f64| n.is_finite());
        number.ok_or_else(|| word.wrong(expected))
    }

    /// A whole number from `least` to `most`.
    pub(crate) fn count(&mut self, least: u64, most: u64, what: &str) -> Result<u64, DecodeError> {
        let expected = format!("{what}, a whole number from {least} to {most}");
        let word = self.next(&expected)?;
        let text = std::str::from_utf8(word.text).ok();
        let count = text.and_then(|text| text.parse().ok()).filter(|n| (least..=most).contains(n));
        count.ok_or_else(|| word.wrong(&expected))
    }
}

impl Word<'_> {
    /// An error about this word.
    pub(crate) fn wrong(&self, expected: impl Into<String>) -> DecodeError {
        const LONGEST: usize = 40;
        let text = String::from_utf8_lossy(&self.text[..self.text.len().min(LONGEST)]);
        let dots = if self.text.len() > LONGEST { "…" } else { "" };
        DecodeError {
            kind: ErrorKind::Syntax,
            place: self.place,
            found: format!("“{}{dots}”", text.escape_debug()),
            expected: expected.into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_count_lines_of_every_kind() {
        let mut words = Words::new(b"\xEF\xBB\xBFa  b # no\r\n c\rd#x y\n\ne");
        let mut read = Vec::new();
        while let Some(word) = words.peek() {
            let Place::Text { line, column } = words.next("a word").unwrap().place else { panic!() };
            read.push((String::from_utf8(word.text.to_vec()).unwrap(), line, column));
        }
        let expected = [("a", 1, 1), ("b", 1, 4), ("c", 2, 2), ("d", 3, 1), ("e", 5, 1)];
        assert_eq!(read, expected.map(|(text, line, column)| (text.to_owned(), line, column)));
        let error = words.number("a number").unwrap_err();
        assert_eq!(error.to_string(), "line 5, column 2: found the end of the file, expected a number");
    }

    #[test]
    fn numbers_that_are_none_are_quoted() {
        for (text, message) in [
            ("\n nan", "line 2, column 2: found “nan”, expected a number"),
            ("1e999", "line 1, column 1: found “1e999”, expected a number"),
        ] {
            assert_eq!(Words::new(text.as_bytes()).number("a number").unwrap_err().to_string(), message);
        }
        let error = Words::new(b"-1").count(1, 5, "a degree").unwrap_err();
        assert_eq!(
            error.to_string(),
            "line 1, column 1: found “-1”, expected a degree, a whole number from 1 to 5"
        );
    }
}
