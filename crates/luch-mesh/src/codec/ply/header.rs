//! The header: which elements there are, how many of each, and of what properties.

use super::Encoding;
use crate::codec::error::{DecodeError, ErrorKind, Place, quote};
use crate::codec::token::{parse_i64, words};

/// The header and where the data begins.
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// First byte after the header.
    pub(super) data_start: usize,
    /// Lines of the header.
    pub(super) lines: u64,
}

pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
    /// The line that declares it.
    pub(super) line: u64,
}

pub(super) struct Property {
    pub(super) name: String,
    pub(super) scalar: Scalar,
    /// For lists the type of their length.
    pub(super) list_length: Option<Scalar>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    const NAMES: [(&'static str, Self); 16] = [
        ("char", Self::I8),
        ("int8", Self::I8),
        ("uchar", Self::U8),
        ("uint8", Self::U8),
        ("short", Self::I16),
        ("int16", Self::I16),
        ("ushort", Self::U16),
        ("uint16", Self::U16),
        ("int", Self::I32),
        ("int32", Self::I32),
        ("uint", Self::U32),
        ("uint32", Self::U32),
        ("float", Self::F32),
        ("float32", Self::F32),
        ("double", Self::F64),
        ("float64", Self::F64),
    ];

    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// The value that stands for 1 in a colour of this type; `None` for real numbers.
    pub(super) fn full_color(self) -> Option<f32> {
        match self {
            Self::I8 | Self::U8 | Self::I32 | Self::U32 => Some(255.0),
            Self::I16 | Self::U16 => Some(65535.0),
            Self::F32 | Self::F64 => None,
        }
    }
}

/// A file may have so many elements and properties together.
const MOST_DECLARATIONS: usize = 4096;

impl Header {
    pub(super) fn parse(bytes: &[u8]) -> Result<Self, DecodeError> {
        let mut reader = LineReader { bytes, at: 0, number: 0 };
        // Leading blank lines are a known fault of some writers.
        let mut line = reader.next()?;
        while line.is_empty() && reader.at < bytes.len() {
            line = reader.next()?;
        }
        if line != b"ply" {
            return Err(reader.error(line, line, "“ply” in the first line"));
        }
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        let mut declarations = 0;
        loop {
            let line = reader.next()?;
            let mut parts = words(line);
            let keyword = parts.next().unwrap_or(b"");
            let mut part = || parts.next().unwrap_or(&line[line.len()..]);
            declarations += 1;
            if declarations > MOST_DECLARATIONS && matches!(keyword, b"element" | b"property") {
                return Err(reader.error(line, keyword, "at most 4096 lines of header"));
            }
            match keyword {
                b"format" => {
                    let (name, version) = (part(), part());
                    let known = Encoding::ALL.into_iter().find(|encoding| encoding.name().as_bytes() == name);
                    encoding = Some(known.ok_or_else(|| reader.error(line, name, FORMATS))?);
                    if version != b"1.0" {
                        return Err(reader.error(line, version, "version 1.0"));
                    }
                }
                b"element" => {
                    let (name, count) = (part(), part());
                    let count = parse_i64(count)
                        .and_then(|count| u64::try_from(count).ok())
                        .ok_or_else(|| reader.error(line, count, "the number of elements"))?;
                    let name = String::from_utf8_lossy(name).into_owned();
                    elements.push(Element { name, count, properties: Vec::new(), line: reader.number });
                }
                b"property" => {
                    let Some(element) = elements.last_mut() else {
                        return Err(reader.error(line, keyword, "an element before its properties"));
                    };
                    let scalar = |word: &[u8]| {
                        let known = Scalar::NAMES.iter().find(|(name, _)| name.as_bytes() == word);
                        known.map(|(_, scalar)| *scalar).ok_or_else(|| reader.error(line, word, TYPES))
                    };
                    let first = part();
                    let (list_length, type_name) =
                        if first == b"list" { (Some(scalar(part())?), part()) } else { (None, first) };
                    if matches!(list_length, Some(Scalar::F32 | Scalar::F64)) {
                        return Err(reader.error(line, first, "a list whose length is a whole number"));
                    }
                    let scalar = scalar(type_name)?;
                    let name = part();
                    if name.is_empty() {
                        return Err(reader.error(line, name, "the property's name"));
                    }
                    let name = String::from_utf8_lossy(name).into_owned();
                    element.properties.push(Property { name, scalar, list_length });
                }
                b"comment" | b"obj_info" | b"" => {}
                b"end_header" => break,
                _ => return Err(reader.error(line, keyword, KEYWORDS)),
            }
        }
        let encoding =
            encoding.ok_or_else(|| reader.error(b"", b"", "a line “format ascii 1.0” in the header"))?;
        Ok(Self { encoding, elements, data_start: reader.at, lines: reader.number })
    }
}

const FORMATS: &str = "ascii, binary_little_endian or binary_big_endian";
const TYPES: &str = "a type: char, uchar, short, ushort, int, uint, float, double or int8 … float64";
const KEYWORDS: &str = "format, element, property, comment, obj_info or end_header";

struct LineReader<'a> {
    bytes: &'a [u8],
    at: usize,
    number: u64,
}

impl<'a> LineReader<'a> {
    /// The next line without white space around it. Ends are LF, CR LF and CR.
    fn next(&mut self) -> Result<&'a [u8], DecodeError> {
        let rest = &self.bytes[self.at..];
        self.number += 1;
        let Some(length) = rest.iter().position(|&b| b == b'\n' || b == b'\r') else {
            // A header may end with the file if nothing follows.
            let last = rest.trim_ascii();
            if last == b"end_header" {
                self.at = self.bytes.len();
                return Ok(last);
            }
            let place = Place::Text { line: self.number, column: 1 };
            let found = if last.is_empty() { "the end of the file".to_owned() } else { quote(last) };
            return Err(DecodeError::new(
                ErrorKind::Truncated,
                place,
                found,
                "a header that ends with “end_header”",
            ));
        };
        self.at += length + if rest[length..].starts_with(b"\r\n") { 2 } else { 1 };
        Ok(rest[..length].trim_ascii())
    }

    fn error(&self, line: &[u8], part: &[u8], expected: &str) -> DecodeError {
        let column =
            (part.as_ptr() as usize).saturating_sub(line.as_ptr() as usize).min(line.len()) as u64 + 1;
        let place = Place::Text { line: self.number, column };
        let found = if part.is_empty() { "nothing".to_owned() } else { quote(part) };
        DecodeError::new(ErrorKind::Syntax, place, found, expected)
    }
}
