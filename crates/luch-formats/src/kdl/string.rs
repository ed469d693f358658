//! Strings: quoted, raw, and both over several lines.

use super::scanner::{Broken, Scanner, is_disallowed, is_newline, is_space};

/// What a string is closed with.
const NEVER_CLOSED: &str = "this string is never closed";

impl<'a> Scanner<'a> {
    /// `"…"`, or `"""` and lines.
    pub(super) fn quoted_string(&mut self) -> Result<String, Broken> {
        let start = self.at;
        if self.take("\"\"\"") {
            let body = self.body(start, "\"\"\"", true)?;
            let lines = self.dedented(start, body)?;
            return self.unescaped(start, &lines);
        }
        self.at += 1;
        let body = self.body(start, "\"", true)?;
        self.unescaped(start, body)
    }

    /// `#"…"#` with any number of `#`, or the same with `"""` and lines.
    pub(super) fn raw_string(&mut self) -> Result<String, Broken> {
        let start = self.at;
        let hashes = self.take_while(|c| c == '#');
        if self.take("\"\"\"") {
            let body = self.body(start, &format!("\"\"\"{hashes}"), false)?;
            return self.dedented(start, body);
        }
        self.at += 1;
        Ok(self.body(start, &format!("\"{hashes}"), false)?.to_owned())
    }

    /// Everything up to `close`, which is stepped over. A string closed by one quote ends with its line at the latest.
    fn body(&mut self, start: usize, close: &str, has_escapes: bool) -> Result<&'a str, Broken> {
        let from = self.at;
        let is_multiline = close.starts_with("\"\"\"");
        let text = self.text;
        loop {
            if self.take(close) {
                return Ok(&text[from..self.at - close.len()]);
            }
            match self.peek() {
                None => {
                    let end = text[start..].find(is_newline).map_or(text.len(), |length| start + length);
                    return Err(self.fail(start..end, NEVER_CLOSED, None));
                }
                Some(c) if is_newline(c) && !is_multiline => {
                    let help =
                        Some("end it with a quote; text of several lines stands between \"\"\" and \"\"\"");
                    return Err(self.fail(start..self.at, NEVER_CLOSED, help));
                }
                Some(c) if is_disallowed(c) => {
                    let message = format!("the character `{}` is not allowed", c.escape_unicode());
                    return Err(self.fail(self.here(), message, None));
                }
                Some('\\') if has_escapes => {
                    self.at += 1;
                    // A backslash takes all white space after it, lines and all.
                    if self.take_while(|c| is_space(c) || is_newline(c)).is_empty() {
                        self.at += self.peek().map_or(0, char::len_utf8);
                    }
                }
                Some(c) => self.at += c.len_utf8(),
            }
        }
    }

    /// The lines of a multi-line string without what the closing line begins with.
    fn dedented(&mut self, start: usize, body: &str) -> Result<String, Broken> {
        let normal = body.replace("\r\n", "\n").replace(is_newline, "\n");
        let Some(rest) = normal.strip_prefix('\n') else {
            let help = Some("the text begins on the next line");
            return Err(self.fail(start..start + 3, "`\"\"\"` is not at the end of its line", help));
        };
        let (lines, prefix) = rest.rsplit_once('\n').unwrap_or(("", rest));
        if !prefix.chars().all(is_space) {
            let help = Some("the closing quotes stand on a line of their own");
            return Err(self.fail(self.at - 3..self.at, "text before the closing quotes", help));
        }
        let mut text = String::with_capacity(lines.len());
        for (number, line) in lines.split('\n').enumerate() {
            if number > 0 {
                text.push('\n');
            }
            match line.strip_prefix(prefix) {
                Some(line) if !line.chars().all(is_space) => text.push_str(line),
                _ if line.chars().all(is_space) => {}
                _ => {
                    let help =
                        Some("every line begins with the white space that stands before the closing quotes");
                    let message =
                        format!("line {} of this text begins otherwise than its last line", number + 1);
                    return Err(self.fail(start..start + 3, message, help));
                }
            }
        }
        Ok(text)
    }

    /// The text that escapes stand for.
    fn unescaped(&mut self, start: usize, body: &str) -> Result<String, Broken> {
        let mut text = String::with_capacity(body.len());
        let mut rest = body;
        while let Some(place) = rest.find('\\') {
            text.push_str(&rest[..place]);
            let after = &rest[place + 1..];
            let mut chars = after.chars();
            let escaped = match chars.next() {
                Some('n') => Some('\n'),
                Some('r') => Some('\r'),
                Some('t') => Some('\t'),
                Some('b') => Some('\u{8}'),
                Some('f') => Some('\u{c}'),
                Some('s') => Some(' '),
                Some(c @ ('\\' | '"')) => Some(c),
                Some(c) if is_space(c) || is_newline(c) => {
                    rest = after.trim_start_matches(|c| is_space(c) || is_newline(c));
                    continue;
                }
                Some('u') => code_point(chars.as_str()).map(|(c, left)| {
                    chars = left.chars();
                    c
                }),
                _ => None,
            };
            let Some(c) = escaped else {
                let shown: String = after.chars().take(8).collect();
                let message = format!("`\\{}` in this string is no escape", shown.escape_debug());
                let help = "escapes are \\n \\r \\t \\b \\f \\s \\\\ \\\" and \\u{1f600}; or write #\"…\"# for a text without escapes";
                return Err(self.fail(start..self.at, message, Some(help)));
            };
            text.push(c);
            rest = chars.as_str();
        }
        text.push_str(rest);
        Ok(text)
    }
}

/// The character of `{1f600}` and what follows it.
fn code_point(text: &str) -> Option<(char, &str)> {
    let (digits, rest) = text.strip_prefix('{')?.split_once('}')?;
    if digits.is_empty() || digits.len() > 6 || !digits.chars().all(|c| c.is_ascii_hexdigit()) {
        return None;
    }
    Some((char::from_u32(u32::from_str_radix(digits, 16).ok()?)?, rest))
}
