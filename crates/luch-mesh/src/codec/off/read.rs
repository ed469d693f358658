//! The reader.

use glam::{Vec2, Vec3, Vec4};

use super::{OffFile, Parts};
use crate::codec::color::srgb_to_linear;
use crate::codec::error::{DecodeError, ErrorKind, Place, Warnings, quote};
use crate::codec::token::{parse_f32, parse_i64};
use crate::polygon_mesh::CornerAttribute;

/// Reads an OFF file.
///
/// Errors: a first word of another kind, data that ends early or is no number, a face with a vertex that does not exist.
/// Warnings: colours of faces, faces with fewer than three corners or with a vertex that is not finite (left out).
pub fn decode(bytes: &[u8]) -> Result<OffFile, DecodeError> {
    let mut text = Text { bytes, at: 0, word_start: 0 };
    let mut warnings = Warnings::default();
    let mut file = OffFile::default();
    let parts = text.parts()?;
    let vertices = text.count("vertices")?;
    let faces = text.count("faces")?;
    // The number of edges is told by most files and used by none.
    text.rest_of_line();
    text.vertices(vertices, parts, &mut file)?;
    let mut short = 0usize;
    let mut has_colors = false;
    for _ in 0..faces {
        let first = file.mesh.corners.len();
        let count = text.integer("the number of a face's corners")?;
        let left = text.at_most();
        let count = u64::try_from(count).ok().filter(|count| *count <= left);
        let count = count.ok_or_else(|| {
            text.error(ErrorKind::Truncated, "a number of corners that fits in the rest of the file")
        })?;
        for _ in 0..count {
            let index = text.integer("the number of a vertex")?;
            let index =
                u32::try_from(index).ok().filter(|&index| (index as usize) < file.mesh.positions.len());
            file.mesh.corners.push(index.ok_or_else(|| {
                let expected = format!("the number of one of {vertices} vertices, from 0");
                text.error(ErrorKind::IndexOutOfRange, &expected)
            })?);
        }
        has_colors |= text.rest_of_line();
        if count < 3 {
            file.mesh.corners.truncate(first);
            short += 1;
        } else {
            file.mesh.face_ends.push(file.mesh.corners.len() as u32);
        }
    }
    if short > 0 {
        warnings.add(None, &format!("{short} faces with fewer than three corners are left out"));
    }
    if has_colors {
        warnings.add(None, "colours of faces are skipped");
    }
    let lost = file.mesh.drop_not_finite().map_or(0, |kept| kept.iter().filter(|kept| !**kept).count());
    if lost > 0 {
        warnings.add(None, &format!("{lost} faces with a vertex that is not finite are left out"));
    }
    file.mesh.normalize_normals();
    if file.mesh.face_ends.is_empty() {
        warnings.add(None, "the file has no faces");
    }
    file.warnings = warnings.into_list();
    Ok(file)
}

/// True if bytes of unknown kind are probably OFF.
pub(crate) fn looks_like(bytes: &[u8]) -> bool {
    let start = bytes.trim_ascii_start();
    let word = &start[..start.iter().position(u8::is_ascii_whitespace).unwrap_or(start.len())];
    word.ends_with(b"OFF") && Parts::of_keyword(word).is_some()
}

impl Parts {
    /// The parts that a first word such as `STCNOFF` names.
    fn of_keyword(word: &[u8]) -> Option<Self> {
        let prefix = word.strip_suffix(b"OFF")?;
        let (uvs, prefix) = prefix.strip_prefix(b"ST").map_or((false, prefix), |rest| (true, rest));
        let (colors, prefix) = prefix.strip_prefix(b"C").map_or((false, prefix), |rest| (true, rest));
        let (normals, prefix) = prefix.strip_prefix(b"N").map_or((false, prefix), |rest| (true, rest));
        prefix.is_empty().then_some(Self { uvs, colors, normals })
    }
}

/// Words between white space; what follows a `#` is passed over.
struct Text<'a> {
    bytes: &'a [u8],
    at: usize,
    word_start: usize,
}

impl<'a> Text<'a> {
    fn skip_space(&mut self) {
        while let Some(&byte) = self.bytes.get(self.at) {
            if byte == b'#' {
                let rest = &self.bytes[self.at..];
                self.at += rest.iter().position(|&b| b == b'\n' || b == b'\r').unwrap_or(rest.len());
            } else if byte.is_ascii_whitespace() {
                self.at += 1;
            } else {
                return;
            }
        }
    }

    fn word(&mut self) -> &'a [u8] {
        self.skip_space();
        self.word_start = self.at;
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(|b| b.is_ascii_whitespace() || *b == b'#').unwrap_or(rest.len());
        self.at += length;
        &rest[..length]
    }

    fn parts(&mut self) -> Result<Parts, DecodeError> {
        let word = self.word();
        if word.first().is_some_and(u8::is_ascii_digit) {
            // Without a first word the counts come at once.
            self.at = self.word_start;
            return Ok(Parts::default());
        }
        let parts = Parts::of_keyword(word).ok_or_else(|| {
            self.error(ErrorKind::Syntax, "OFF, perhaps with ST (uvs), C (colours) and N (normals) before it")
        })?;
        let after = self.at;
        if self.word() == b"BINARY" {
            return Err(self.error(ErrorKind::Unsupported, "the text form: binary OFF is not read"));
        }
        self.at = after;
        Ok(parts)
    }

    fn float(&mut self, expected: &str) -> Result<f32, DecodeError> {
        let word = self.word();
        parse_f32(word).ok_or_else(|| self.wrong(expected))
    }

    fn integer(&mut self, expected: &str) -> Result<i64, DecodeError> {
        let word = self.word();
        parse_i64(word).ok_or_else(|| self.wrong(expected))
    }

    /// A count that the rest of the file could hold.
    fn count(&mut self, what: &str) -> Result<usize, DecodeError> {
        let count = self.integer(&format!("the number of {what}"))?;
        let left = self.at_most();
        u64::try_from(count).ok().filter(|&count| count <= left).map(|count| count as usize).ok_or_else(
            || {
                self.error(
                    ErrorKind::Truncated,
                    &format!("no more {what} than the rest of the file can hold"),
                )
            },
        )
    }

    /// The most numbers that can still come.
    fn at_most(&self) -> u64 {
        (self.bytes.len() - self.at).div_ceil(2) as u64
    }

    fn vertices(&mut self, count: usize, parts: Parts, file: &mut OffFile) -> Result<(), DecodeError> {
        let mesh = &mut file.mesh;
        let (mut normals, mut colors, mut uvs) = (Vec::new(), Vec::new(), Vec::new());
        mesh.positions.reserve(count);
        for _ in 0..count {
            mesh.positions.push(Vec3::from(self.floats("a coordinate")?));
            if parts.normals {
                normals.push(Vec3::from(self.floats("a component of a normal")?));
            }
            if parts.colors {
                colors.push(self.color(parts.uvs)?);
            }
            if parts.uvs {
                uvs.push(Vec2::from(self.floats("a texture coordinate")?));
            }
        }
        mesh.normals = CornerAttribute::per_position(normals);
        mesh.colors = CornerAttribute::per_position(colors);
        if parts.uvs {
            mesh.uv_sets.push(CornerAttribute::per_position(uvs));
        }
        Ok(())
    }

    fn floats<const N: usize>(&mut self, expected: &str) -> Result<[f32; N], DecodeError> {
        let mut numbers = [0.0; N];
        for number in &mut numbers {
            *number = self.float(expected)?;
        }
        Ok(numbers)
    }

    /// Three or four numbers; the fourth is missing in many files, and then the line ends. With uvs behind there must be four.
    fn color(&mut self, more_follows: bool) -> Result<Vec4, DecodeError> {
        let mut color = [1.0f32; 4];
        let mut is_coded = true;
        for (channel, value) in color.iter_mut().enumerate() {
            if channel == 3 && !more_follows && self.is_line_done() {
                break;
            }
            let word = self.word();
            let number = parse_f32(word).ok_or_else(|| self.wrong("a colour of three or four numbers"))?;
            let is_whole = parse_i64(word).is_some();
            is_coded &= is_whole;
            *value = number;
            if channel == 3 && is_coded {
                *value = number / 255.0;
            }
        }
        if is_coded {
            color[..3].iter_mut().for_each(|value| *value = srgb_to_linear(*value / 255.0));
        }
        Ok(Vec4::from_array(color))
    }

    /// True if nothing but blanks or a comment stands before the end of the line.
    fn is_line_done(&self) -> bool {
        let rest = &self.bytes[self.at..];
        let blank = rest.iter().position(|b| *b == b'\n' || *b == b'\r' || !b.is_ascii_whitespace());
        blank.is_none_or(|at| matches!(rest[at], b'\n' | b'\r' | b'#'))
    }

    /// Passes over what is left of the line; true if something stands there.
    fn rest_of_line(&mut self) -> bool {
        let is_done = self.is_line_done();
        let rest = &self.bytes[self.at..];
        self.at += rest.iter().position(|&b| b == b'\n' || b == b'\r').unwrap_or(rest.len());
        !is_done
    }

    fn wrong(&self, expected: &str) -> DecodeError {
        let kind = if self.word_start == self.bytes.len() { ErrorKind::Truncated } else { ErrorKind::Syntax };
        self.error(kind, expected)
    }

    fn error(&self, kind: ErrorKind, expected: &str) -> DecodeError {
        let before = &self.bytes[..self.word_start];
        let line = before.iter().filter(|&&b| b == b'\n').count() as u64 + 1;
        let line_start = before.iter().rposition(|&b| b == b'\n').map_or(0, |at| at + 1);
        let column = (self.word_start - line_start) as u64 + 1;
        let found = match &self.bytes[self.word_start..self.at.max(self.word_start)] {
            [] => "the end of the file".to_owned(),
            word => quote(word),
        };
        DecodeError::new(kind, Place::Text { line, column }, found, expected)
    }
}
