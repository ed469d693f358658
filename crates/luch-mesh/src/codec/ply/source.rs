//! Where numbers come from: words of a text, or bytes.

use super::Encoding;
use super::header::{Element, Header, Scalar};
use crate::codec::error::{DecodeError, ErrorKind, Place, quote};
use crate::codec::token::{parse_f32, parse_i64};

/// A stream of numbers of given types.
pub(super) trait Source {
    fn float(&mut self, scalar: Scalar) -> Result<f32, DecodeError>;
    fn integer(&mut self, scalar: Scalar) -> Result<i64, DecodeError>;
    fn skip(&mut self, scalar: Scalar, count: u64) -> Result<(), DecodeError>;
    /// The most numbers of a type that can still come: bounds what a header or a list may claim.
    fn at_most(&self, scalar: Scalar) -> u64;
    /// Where the last number was.
    fn place(&self) -> Place;
    /// The last number as it stands there.
    fn last(&self) -> String;
    /// Ends an element: whatever else stands in its line of a text is passed over. True if there was something.
    fn end_row(&mut self) -> bool;
    /// The next `length` bytes if numbers stand there lowest byte first; they are then taken.
    fn take_bytes(&mut self, length: usize) -> Option<&[u8]>;
    /// All bytes that are left, if numbers stand there lowest byte first.
    fn bytes_left(&self) -> Option<&[u8]>;
    /// True if nothing but white space (for text) is left.
    fn is_done(&mut self) -> bool;

    /// The length of a list, made sure to fit in the rest of the file.
    fn list_length(&mut self, length: Scalar, items: Scalar) -> Result<u64, DecodeError> {
        let count = self.integer(length)?;
        match u64::try_from(count) {
            Ok(count) if count <= self.at_most(items) => Ok(count),
            Ok(_) => Err(self.error(ErrorKind::Truncated, "a list that fits in the rest of the file")),
            Err(_) => Err(self.error(ErrorKind::Syntax, "the length of a list: 0 or more")),
        }
    }

    fn error(&self, kind: ErrorKind, expected: &str) -> DecodeError {
        DecodeError::new(kind, self.place(), self.last(), expected)
    }
}

/// An error if the rest of the file cannot hold an element as often as the header claims.
pub(super) fn check_count(source: &impl Source, element: &Element) -> Result<(), DecodeError> {
    let least = element.properties.iter().map(|p| p.list_length.unwrap_or(p.scalar));
    let size: u64 = match source.place() {
        Place::Byte { .. } => least.map(|scalar| scalar.size() as u64).sum(),
        Place::Text { .. } => least.count() as u64,
    };
    if size == 0 || element.count <= source.at_most(Scalar::U8) / size {
        return Ok(());
    }
    let place = Place::Text { line: element.line, column: 1 };
    let found = format!("{} elements “{}”", element.count, element.name.escape_debug());
    Err(DecodeError::new(ErrorKind::Truncated, place, found, "no more than the rest of the file can hold"))
}

/// Words between white space.
pub(super) struct Text<'a> {
    bytes: &'a [u8],
    at: usize,
    line: u64,
    line_start: usize,
    word_start: usize,
}

impl<'a> Text<'a> {
    pub(super) fn new(bytes: &'a [u8], header: &Header) -> Self {
        let start = header.data_start;
        Self { bytes, at: start, line: header.lines + 1, line_start: start, word_start: start }
    }

    fn skip_space(&mut self) {
        while let Some(byte) = self.bytes.get(self.at).filter(|byte| byte.is_ascii_whitespace()) {
            self.at += 1;
            if *byte == b'\n' {
                self.line += 1;
                self.line_start = self.at;
            }
        }
    }

    fn word(&mut self) -> Result<&'a [u8], DecodeError> {
        self.skip_space();
        self.word_start = self.at;
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        self.at += length;
        if length == 0 {
            return Err(self.error(ErrorKind::Truncated, "a number"));
        }
        Ok(&rest[..length])
    }
}

impl Source for Text<'_> {
    fn float(&mut self, _: Scalar) -> Result<f32, DecodeError> {
        let word = self.word()?;
        parse_f32(word).ok_or_else(|| self.error(ErrorKind::Syntax, "a number"))
    }

    fn integer(&mut self, _: Scalar) -> Result<i64, DecodeError> {
        let word = self.word()?;
        parse_i64(word).ok_or_else(|| self.error(ErrorKind::Syntax, "a whole number"))
    }

    fn skip(&mut self, _: Scalar, count: u64) -> Result<(), DecodeError> {
        for _ in 0..count {
            self.word()?;
        }
        Ok(())
    }

    fn at_most(&self, _: Scalar) -> u64 {
        // A digit and a space each; the last needs no space.
        (self.bytes.len() - self.at).div_ceil(2) as u64
    }

    fn place(&self) -> Place {
        Place::Text { line: self.line, column: self.word_start.saturating_sub(self.line_start) as u64 + 1 }
    }

    fn last(&self) -> String {
        match &self.bytes[self.word_start..self.at] {
            [] => "the end of the file".to_owned(),
            word => quote(word),
        }
    }

    fn end_row(&mut self) -> bool {
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(|&b| b == b'\n' || b == b'\r').unwrap_or(rest.len());
        self.at += length;
        !rest[..length].trim_ascii().is_empty()
    }

    fn take_bytes(&mut self, _: usize) -> Option<&[u8]> {
        None
    }

    fn bytes_left(&self) -> Option<&[u8]> {
        None
    }

    fn is_done(&mut self) -> bool {
        self.skip_space();
        self.at == self.bytes.len()
    }
}

/// Bytes in one of the two orders.
pub(super) struct Binary<'a> {
    bytes: &'a [u8],
    at: usize,
    is_little_endian: bool,
    /// Size of the last number.
    last_size: usize,
}

impl<'a> Binary<'a> {
    pub(super) fn new(bytes: &'a [u8], header: &Header) -> Self {
        let is_little_endian = header.encoding == Encoding::LittleEndian;
        Self { bytes, at: header.data_start, is_little_endian, last_size: 0 }
    }

    /// The next number's bytes, lowest first.
    fn take<const N: usize>(&mut self) -> Result<[u8; N], DecodeError> {
        self.last_size = N;
        let Some(found) = self.bytes[self.at..].first_chunk::<N>() else {
            let place = Place::Byte { offset: self.at as u64 };
            let expected = format!("a number of {N} bytes");
            return Err(DecodeError::new(ErrorKind::Truncated, place, "the end of the file", expected));
        };
        self.at += N;
        let mut bytes = *found;
        if !self.is_little_endian {
            bytes.reverse();
        }
        Ok(bytes)
    }
}

impl Source for Binary<'_> {
    fn float(&mut self, scalar: Scalar) -> Result<f32, DecodeError> {
        match scalar {
            Scalar::F32 => Ok(f32::from_le_bytes(self.take()?)),
            Scalar::F64 => Ok(f64::from_le_bytes(self.take()?) as f32),
            _ => Ok(self.integer(scalar)? as f32),
        }
    }

    fn integer(&mut self, scalar: Scalar) -> Result<i64, DecodeError> {
        let real = match scalar {
            Scalar::I8 => return Ok(i8::from_le_bytes(self.take()?).into()),
            Scalar::U8 => return Ok(u8::from_le_bytes(self.take()?).into()),
            Scalar::I16 => return Ok(i16::from_le_bytes(self.take()?).into()),
            Scalar::U16 => return Ok(u16::from_le_bytes(self.take()?).into()),
            Scalar::I32 => return Ok(i32::from_le_bytes(self.take()?).into()),
            Scalar::U32 => return Ok(u32::from_le_bytes(self.take()?).into()),
            Scalar::F32 => f64::from(f32::from_le_bytes(self.take()?)),
            Scalar::F64 => f64::from_le_bytes(self.take()?),
        };
        if real != real.trunc() || real.abs() > 1e15 {
            return Err(self.error(ErrorKind::Syntax, "a whole number"));
        }
        Ok(real as i64)
    }

    fn skip(&mut self, scalar: Scalar, count: u64) -> Result<(), DecodeError> {
        let size = count.saturating_mul(scalar.size() as u64);
        if size > (self.bytes.len() - self.at) as u64 {
            let place = Place::Byte { offset: self.at as u64 };
            let expected = format!("{size} bytes more");
            return Err(DecodeError::new(ErrorKind::Truncated, place, "the end of the file", expected));
        }
        self.at += size as usize;
        Ok(())
    }

    fn at_most(&self, scalar: Scalar) -> u64 {
        ((self.bytes.len() - self.at) / scalar.size()) as u64
    }

    fn place(&self) -> Place {
        Place::Byte { offset: self.at.saturating_sub(self.last_size) as u64 }
    }

    fn last(&self) -> String {
        let bytes = &self.bytes[self.at.saturating_sub(self.last_size)..self.at];
        let digits: Vec<String> = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
        format!("the bytes {}", digits.join(" "))
    }

    fn end_row(&mut self) -> bool {
        false
    }

    fn take_bytes(&mut self, length: usize) -> Option<&[u8]> {
        let taken = self.bytes_left()?.len().min(length);
        let start = self.at;
        self.at += taken;
        Some(&self.bytes[start..start + taken])
    }

    fn bytes_left(&self) -> Option<&[u8]> {
        self.is_little_endian.then(|| &self.bytes[self.at..])
    }

    fn is_done(&mut self) -> bool {
        self.at == self.bytes.len()
    }
}
