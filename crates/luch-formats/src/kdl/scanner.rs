//! Characters, white space and comments.

use super::SyntaxError;
use std::ops::Range;

/// Most mistakes that are collected.
const MOST_ERRORS: usize = 50;

/// A place in the text that moves forward, and the mistakes so far.
pub(super) struct Scanner<'a> {
    pub(super) text: &'a str,
    pub(super) at: usize,
    pub(super) errors: Vec<SyntaxError>,
}

/// A mistake was noted; the rest of the line is of no use.
#[derive(Debug)]
pub(super) struct Broken;

pub(super) fn is_newline(c: char) -> bool {
    matches!(c, '\n' | '\r' | '\u{85}' | '\u{b}' | '\u{c}' | '\u{2028}' | '\u{2029}')
}

pub(super) fn is_space(c: char) -> bool {
    matches!(
        c,
        '\t' | ' ' | '\u{a0}' | '\u{1680}' | '\u{2000}'..='\u{200a}' | '\u{202f}' | '\u{205f}' | '\u{3000}'
    )
}

/// Code points that may stand nowhere.
pub(super) fn is_disallowed(c: char) -> bool {
    matches!(c, '\0'..='\u{8}' | '\u{e}'..='\u{1f}' | '\u{7f}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}'
        | '\u{2066}'..='\u{2069}' | '\u{feff}')
}

pub(super) fn is_identifier_char(c: char) -> bool {
    !matches!(c, '\\' | '/' | '(' | ')' | '{' | '}' | '[' | ']' | ';' | '"' | '#' | '=')
        && !is_newline(c)
        && !is_space(c)
        && !is_disallowed(c)
}

impl<'a> Scanner<'a> {
    pub(super) fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    pub(super) fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    pub(super) fn looks_at(&self, mark: &str) -> bool {
        self.rest().starts_with(mark)
    }

    /// Steps over `mark` if it is next.
    pub(super) fn take(&mut self, mark: &str) -> bool {
        let found = self.looks_at(mark);
        if found {
            self.at += mark.len();
        }
        found
    }

    /// Steps over all characters that `wanted` accepts.
    pub(super) fn take_while(&mut self, wanted: impl Fn(char) -> bool) -> &'a str {
        let rest = self.rest();
        let length = rest.find(|c| !wanted(c)).unwrap_or(rest.len());
        self.at += length;
        &rest[..length]
    }

    /// Notes a mistake.
    pub(super) fn fail(
        &mut self,
        span: Range<usize>,
        message: impl Into<String>,
        help: Option<&'static str>,
    ) -> Broken {
        if self.errors.len() < MOST_ERRORS {
            self.errors.push(SyntaxError { span, message: message.into(), help });
        }
        Broken
    }

    /// The span of the next character.
    pub(super) fn here(&self) -> Range<usize> {
        self.at..self.at + self.peek().map_or(0, char::len_utf8)
    }

    /// Steps over one newline; CR LF counts as one.
    pub(super) fn newline(&mut self) -> bool {
        if self.take("\r\n") {
            return true;
        }
        let Some(c) = self.peek().filter(|&c| is_newline(c)) else { return false };
        self.at += c.len_utf8();
        true
    }

    /// Steps over `//` and the rest of the line, but not its end.
    fn line_comment(&mut self) -> bool {
        let found = self.take("//");
        if found {
            self.take_while(|c| !is_newline(c));
        }
        found
    }

    /// Steps over a `/* */` comment, which may hold others.
    fn block_comment(&mut self) -> Result<bool, Broken> {
        let start = self.at;
        if !self.take("/*") {
            return Ok(false);
        }
        let mut open = 1usize;
        while open > 0 {
            self.take_while(|c| c != '*' && c != '/');
            if self.take("*/") {
                open -= 1;
            } else if self.take("/*") {
                open += 1;
            } else if let Some(c) = self.peek() {
                self.at += c.len_utf8();
            } else {
                return Err(self.fail(
                    start..start + 2,
                    "this comment is never closed",
                    Some("end it with `*/`"),
                ));
            }
        }
        Ok(true)
    }

    /// Steps over spaces, comments and continued lines within a node; says whether there were any.
    pub(super) fn node_space(&mut self) -> Result<bool, Broken> {
        let start = self.at;
        loop {
            self.take_while(is_space);
            if self.block_comment()? {
                continue;
            }
            if !self.looks_at("\\") {
                return Ok(self.at > start);
            }
            let backslash = self.here();
            self.at += 1;
            self.take_while(is_space);
            while self.block_comment()? {
                self.take_while(is_space);
            }
            self.line_comment();
            if !self.newline() && self.peek().is_some() {
                let help = Some("a `\\` outside of a string continues the node on the next line");
                return Err(self.fail(backslash, "`\\` is not at the end of a line", help));
            }
        }
    }

    /// Steps over everything between nodes: spaces, newlines and comments.
    pub(super) fn line_space(&mut self) -> Result<(), Broken> {
        while self.node_space()? || self.newline() || self.line_comment() {}
        Ok(())
    }

    /// Steps over a newline, a `;`, or a comment to the end of the line; also true at the end of the text.
    pub(super) fn terminator(&mut self) -> bool {
        self.line_comment() || self.take(";") || self.newline() || self.peek().is_none()
    }
}
