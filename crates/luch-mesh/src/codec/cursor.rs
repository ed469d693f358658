//! Lines of a text, joined where a line ends in a backslash.

use std::borrow::Cow;

use super::error::Place;

/// Walks the lines of a text. Lines end with LF, CR LF or CR.
pub(crate) struct Lines<'a> {
    rest: &'a [u8],
    /// Lines read so far.
    count: u64,
}

/// One line, without its end.
pub(crate) struct Line<'a> {
    pub(crate) text: Cow<'a, [u8]>,
    /// Number of its (first) line, from 1.
    pub(crate) number: u64,
}

impl<'a> Lines<'a> {
    pub(crate) fn new(text: &'a [u8]) -> Self {
        let without_mark = text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(text);
        Self { rest: without_mark, count: 0 }
    }

    /// Number of the last line read.
    pub(crate) fn number(&self) -> u64 {
        self.count
    }

    fn next_raw(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        self.count += 1;
        let end = self.rest.iter().position(|&b| b == b'\n' || b == b'\r').unwrap_or(self.rest.len());
        let (line, rest) = self.rest.split_at(end);
        self.rest = match rest {
            [b'\r', b'\n', rest @ ..] | [_, rest @ ..] => rest,
            [] => rest,
        };
        Some(line)
    }

    /// The next line; a line whose last character is a backslash goes on in the next one, unless it is a comment.
    pub(crate) fn next_joined(&mut self) -> Option<Line<'a>> {
        let first = self.next_raw()?;
        let number = self.count;
        let [before @ .., b'\\'] = first else { return Some(Line { text: Cow::Borrowed(first), number }) };
        if first.trim_ascii_start().starts_with(b"#") {
            return Some(Line { text: Cow::Borrowed(first), number });
        }
        let mut text = before.to_vec();
        while let Some(more) = self.next_raw() {
            text.push(b' ');
            let [before @ .., b'\\'] = more else {
                text.extend_from_slice(more);
                break;
            };
            text.extend_from_slice(before);
        }
        Some(Line { text: Cow::Owned(text), number })
    }
}

impl Line<'_> {
    /// Where `part`, a piece of this line's text, stands. Words of another text count as the line's start.
    pub(crate) fn place_of(&self, part: &[u8]) -> Place {
        let distance = (part.as_ptr() as usize).checked_sub(self.text.as_ptr() as usize);
        let column = distance.filter(|&d| d <= self.text.len()).unwrap_or(0) as u64 + 1;
        Place::Text { line: self.number, column }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_line_ends_and_continuations() {
        let mut lines = Lines::new(b"\xEF\xBB\xBFa\r\nb \\\nc\rd\n\n# x\\\nlast\\");
        let mut read = Vec::new();
        while let Some(line) = lines.next_joined() {
            read.push((line.number, String::from_utf8(line.text.into_owned()).unwrap()));
        }
        let expected = [(1, "a"), (2, "b  c"), (4, "d"), (5, ""), (6, "# x\\"), (7, "last")];
        assert_eq!(read, expected.map(|(n, s)| (n, s.to_owned())));
    }
}
