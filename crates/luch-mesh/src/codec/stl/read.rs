//! The readers.

use glam::Vec3;

use super::StlFile;
use crate::codec::cursor::{Line, Lines};
use crate::codec::error::{DecodeError, ErrorKind, Place, Warnings, quote};
use crate::codec::token::{parse_f32, split_word, words};
use crate::codec::welding::Welder;

/// Header, then the number of triangles.
const HEADER: usize = 84;
/// Normal, three corners, two bytes of attributes.
const RECORD: usize = 50;

/// Reads an STL file, text or binary.
///
/// A file is binary if its length is that of its triangle count, even if it begins with `solid`; otherwise it is text
/// if it begins so and holds no zero bytes. Triangles with equal corners, or corners that are not finite, are left out
/// with a warning. Colours in the attribute bytes are ignored.
pub fn decode(bytes: &[u8]) -> Result<StlFile, DecodeError> {
    let mut collector = Collector::default();
    if is_text(bytes) {
        read_text(bytes, &mut collector)?
    } else {
        read_binary(bytes, &mut collector)?
    }
    Ok(collector.finish())
}

/// True if bytes of unknown kind are probably STL.
pub(crate) fn looks_like(bytes: &[u8]) -> bool {
    let exact = stated_length(bytes) == Some(bytes.len() as u64);
    exact || (is_text(bytes) && bytes.len() >= 6 && bytes.trim_ascii_start()[5].is_ascii_whitespace())
}

fn stated_length(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(80..HEADER)?;
    let count = u32::from_le_bytes([count[0], count[1], count[2], count[3]]);
    Some(HEADER as u64 + u64::from(count) * RECORD as u64)
}

fn is_text(bytes: &[u8]) -> bool {
    let start = bytes.trim_ascii_start();
    let begins = start.len() > 5 && start[..5].eq_ignore_ascii_case(b"solid");
    begins && stated_length(bytes) != Some(bytes.len() as u64) && !bytes[..bytes.len().min(1024)].contains(&0)
}

fn read_binary(bytes: &[u8], collector: &mut Collector) -> Result<(), DecodeError> {
    let place = Place::Byte { offset: bytes.len() as u64 };
    let Some(length) = stated_length(bytes) else {
        let expected = "“solid”, or a binary header of 84 bytes";
        let found = if bytes.is_empty() { "an empty file".to_owned() } else { quote(bytes) };
        return Err(DecodeError::new(ErrorKind::Truncated, place, found, expected));
    };
    let stated = (length - HEADER as u64) / RECORD as u64;
    if length > bytes.len() as u64 {
        let expected = format!("{length} bytes for the {stated} triangles of the header");
        return Err(DecodeError::new(ErrorKind::Truncated, place, "the end of the file", expected));
    }
    let extra = bytes.len() as u64 - length;
    if extra > 0 {
        collector.warnings.add(None, &format!("{extra} bytes after the last triangle are ignored"));
    }
    let records = bytes[HEADER..length as usize].chunks_exact(RECORD);
    collector.reserve(records.len());
    for record in records {
        let vector = |k: usize| {
            let float = |i: usize| f32::from_le_bytes(std::array::from_fn(|b| record[12 * k + 4 * i + b]));
            Vec3::new(float(0), float(1), float(2))
        };
        collector.add(vector(0), [vector(1), vector(2), vector(3)], None);
    }
    Ok(())
}

/// Reads `solid`, then facets, line by line. Words may be in either case.
fn read_text(bytes: &[u8], collector: &mut Collector) -> Result<(), DecodeError> {
    let mut lines = Lines::new(bytes);
    let (mut normal, mut corners) = (Vec3::ZERO, Vec::with_capacity(3));
    let mut facet_line = None;
    while let Some(line) = lines.next_joined() {
        let (word, rest) = split_word(&line.text);
        let mut small = [0; 8];
        let keyword = lower_case(word, &mut small);
        match (keyword, facet_line) {
            (b"", _) => {}
            (b"vertex", Some(_)) => {
                if corners.len() == 3 {
                    return Err(wrong(&line, word, "“endloop”: a facet has three vertices"));
                }
                corners.push(three(&line, rest)?);
            }
            (b"outer", Some(_)) => {}
            (b"endloop", Some(_)) => {
                let [a, b, c] = *corners else {
                    return Err(wrong(&line, word, "three lines “vertex x y z” before"));
                };
                collector.add(normal, [a, b, c], facet_line);
                corners.clear();
            }
            (b"endfacet", Some(_)) if corners.is_empty() => facet_line = None,
            (b"facet", None) => {
                let (_, numbers) = split_word(rest);
                // Some writers leave the normal out or write nonsense: it is not needed.
                normal = three(&line, numbers).unwrap_or(Vec3::ZERO);
                facet_line = Some(line.number);
            }
            (b"solid", None) => {
                let name = String::from_utf8_lossy(rest.trim_ascii()).into_owned();
                collector.file.solids.push(name);
            }
            (b"endsolid", None) => {}
            (b"color", _) => collector.warnings.add(Some(line.number), "colours are ignored"),
            (_, Some(_)) => return Err(wrong(&line, word, "outer loop, vertex, endloop or endfacet")),
            (_, None) => return Err(wrong(&line, word, "facet normal, endsolid or solid")),
        }
    }
    if facet_line.is_some() {
        let place = Place::Text { line: lines.number() + 1, column: 1 };
        let expected = "“endfacet”, then “endsolid”";
        return Err(DecodeError::new(ErrorKind::Truncated, place, "the end of the file", expected));
    }
    Ok(())
}

fn lower_case<'a>(word: &[u8], buffer: &'a mut [u8; 8]) -> &'a [u8] {
    if word.len() > buffer.len() {
        return b"?";
    }
    let lower = &mut buffer[..word.len()];
    lower.copy_from_slice(word);
    lower.make_ascii_lowercase();
    lower
}

fn three(line: &Line, rest: &[u8]) -> Result<Vec3, DecodeError> {
    let mut numbers = [0.0; 3];
    let mut given = words(rest);
    for number in &mut numbers {
        let word = given.next().unwrap_or(&rest[rest.len()..]);
        *number = parse_f32(word).ok_or_else(|| wrong(line, word, "three numbers"))?;
    }
    Ok(Vec3::from(numbers))
}

fn wrong(line: &Line, part: &[u8], expected: &str) -> DecodeError {
    let found = if part.is_empty() { "the end of the line".to_owned() } else { quote(part) };
    DecodeError::new(ErrorKind::Syntax, line.place_of(part), found, expected)
}

/// Gathers triangles and gives equal corners one number.
#[derive(Default)]
struct Collector {
    file: StlFile,
    welder: Welder,
    warnings: Warnings,
}

impl Collector {
    fn reserve(&mut self, triangles: usize) {
        self.file.mesh.triangles.reserve(triangles);
        // A closed mesh has half as many positions as triangles.
        self.welder.reserve(triangles / 2);
    }

    fn add(&mut self, normal: Vec3, corners: [Vec3; 3], line: Option<u64>) {
        if !corners.iter().all(|corner| corner.is_finite()) {
            self.warnings.add(line, "a triangle with a corner that is not finite is left out");
            return;
        }
        let indices = corners.map(|corner| self.welder.number(corner));
        let [a, b, c] = indices;
        if a == b || b == c || c == a {
            self.warnings.add(line, "a triangle with two equal corners is left out");
            return;
        }
        let [p, q, r] = corners.map(|corner| corner.as_dvec3());
        if (q - p).cross(r - p).dot(normal.as_dvec3()) < 0.0 {
            self.warnings
                .add(line, "a stored normal points against the order of the corners: the order counts");
        }
        self.file.mesh.triangles.push(indices);
    }

    fn finish(mut self) -> StlFile {
        if self.file.mesh.triangles.is_empty() {
            self.warnings.add(None, "the file has no triangles");
        }
        self.file.mesh.positions = self.welder.positions;
        self.file.warnings = self.warnings.into_list();
        self.file
    }
}
