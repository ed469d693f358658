//! The document: buffers, views, accessors, primitives.

use std::fmt::Write;

/// What a stretch of the buffer is for (glTF's `target`).
#[derive(Clone, Copy)]
pub(super) enum Target {
    Vertices = 34962,
    Indices = 34963,
}

/// One buffer with all data, and the accessors to it.
#[derive(Default)]
pub(super) struct Buffer {
    pub(super) bytes: Vec<u8>,
    views: Vec<String>,
    accessors: Vec<String>,
}

/// Numbers as glTF knows them.
#[derive(Clone, Copy)]
pub(super) enum Component {
    U16 = 5123,
    U32 = 5125,
    F32 = 5126,
}

impl Buffer {
    /// Adds an accessor over data of its own and returns its number. `range` is the text of `min` and `max`, if any.
    pub(super) fn add(
        &mut self,
        data: impl Iterator<Item = u8>,
        target: Target,
        component: Component,
        kind: &str,
        count: usize,
        range: Option<String>,
    ) -> usize {
        // Accessors begin at multiples of their component's size.
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let start = self.bytes.len();
        self.bytes.extend(data);
        let length = self.bytes.len() - start;
        let view = self.views.len();
        let target = target as u32;
        self.views
            .push(format!(r#"{{"buffer":0,"byteOffset":{start},"byteLength":{length},"target":{target}}}"#));
        let component = component as u32;
        let range = range.map_or(String::new(), |range| format!(",{range}"));
        self.accessors.push(format!(
            r#"{{"bufferView":{view},"componentType":{component},"count":{count},"type":"{kind}"{range}}}"#
        ));
        self.accessors.len() - 1
    }

    /// The whole document; `uri` is where the bytes are, if not in the same file.
    pub(super) fn document(&self, primitives: &[String], materials: &[String], uri: Option<&str>) -> String {
        let mut text = String::from(r#"{"asset":{"version":"2.0","generator":"luch"},"scene":0,"#);
        if primitives.is_empty() {
            text.push_str(r#""scenes":[{}]}"#);
            return text;
        }
        let uri = uri.map_or(String::new(), |uri| format!(r#","uri":"{uri}""#));
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            r#""scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{}]}}],"materials":[{}],"accessors":[{}],"bufferViews":[{}],"buffers":[{{"byteLength":{}{uri}}}]}}"#,
            primitives.join(","),
            materials.join(","),
            self.accessors.join(","),
            self.views.join(","),
            self.bytes.len()
        );
        text
    }
}

/// A string with its quotes.
pub(super) fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for character in text.chars() {
        match character {
            '"' | '\\' => quoted.extend(['\\', character]),
            '\u{0}'..='\u{1f}' => {
                let _ = write!(quoted, "\\u{:04x}", u32::from(character));
            }
            _ => quoted.push(character),
        }
    }
    quoted.push('"');
    quoted
}

/// Bytes as text of 64 signs (RFC 4648).
pub(super) fn base64(bytes: &[u8]) -> String {
    const SIGNS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let word = group.iter().chain([&0, &0]).take(3).fold(0u32, |word, byte| word << 8 | u32::from(*byte));
        for place in 0..4 {
            let sign = SIGNS[(word >> (18 - 6 * place)) as usize & 63];
            text.push(if place <= group.len() { char::from(sign) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_as_the_standard_has_it() {
        // The test vectors of RFC 4648, section 10.
        let vectors = [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("foobar", "Zm9vYmFy"),
        ];
        for (bytes, text) in vectors {
            assert_eq!(base64(bytes.as_bytes()), text);
        }
    }

    #[test]
    fn strings_are_escaped() {
        assert_eq!(quoted("a\"b\\c\nd"), r#""a\"b\\c\u000ad""#);
    }
}
