//! The reader: one pass over the lines, then a check of what may only be known at the end.

use std::collections::HashMap;

use glam::{Vec2, Vec3, Vec4};

use super::extra::Extras;
use super::{NamedFaces, ObjFile};
use crate::codec::cursor::{Line, Lines};
use crate::codec::error::{DecodeError, ErrorKind, Place, Warnings, quote};
use crate::codec::token::{parse_f32, parse_i64, split_word, words};

/// A corner without uv or normal.
pub(super) const NONE: u32 = u32::MAX;

/// The most material files a file may name.
const MOST_LIBRARIES: usize = 256;

/// Reads an OBJ file.
///
/// Errors: a `v`, `vt`, `vn` or `f` line that is not what it should be, a face with a vertex that does not exist, more
/// than 65 536 materials. Warnings: everything else that is not understood, faces with fewer than three corners or
/// with a vertex that is not finite (left out), uvs and normals that do not exist (treated as not given).
pub fn decode(bytes: &[u8]) -> Result<ObjFile, DecodeError> {
    let mut reader = Reader::default();
    let mut lines = Lines::new(bytes);
    while let Some(line) = lines.next_joined() {
        reader.read_line(&line)?;
    }
    reader.finish()
}

#[derive(Default)]
pub(super) struct Reader {
    pub(super) file: ObjFile,
    pub(super) colors: Vec<Vec4>,
    pub(super) uvs: Vec<Vec2>,
    pub(super) normals: Vec<Vec3>,
    pub(super) uv_corners: Vec<u32>,
    pub(super) normal_corners: Vec<u32>,
    pub(super) groups: Vec<u32>,
    pub(super) slot_of: HashMap<Vec<u8>, u16>,
    pub(super) slot: u16,
    pub(super) smoothing: u32,
    pub(super) any_smoothing: bool,
    /// The furthest reference to something not yet defined when it was used: positions, uvs, normals.
    pub(super) furthest: [Option<Reference>; 3],
    pub(super) extras: Extras,
    pub(super) warnings: Warnings,
}

pub(super) struct Reference {
    pub(super) index: u32,
    pub(super) place: Place,
    pub(super) text: String,
}

/// What the three numbers of a corner refer to.
pub(super) const LISTS: [&str; 3] = ["vertices", "texture coordinates", "normals"];

impl Reader {
    fn read_line(&mut self, line: &Line) -> Result<(), DecodeError> {
        let (keyword, rest) = split_word(&line.text);
        match keyword {
            b"v" => self.vertex(line, rest)?,
            b"vt" => {
                let [u, v, _] = Self::numbers(line, rest, 1, "one to three numbers after “vt”")?;
                self.uvs.push(Vec2::new(u, v));
            }
            b"vn" => {
                let components = Self::numbers(line, rest, 3, "three numbers after “vn”")?;
                self.normals.push(Vec3::from(components));
            }
            b"f" | b"fo" => self.face(line, rest)?,
            b"t" => self.tag(line, rest),
            b"#luch" => self.extra(line, rest)?,
            b"o" => self.name(rest, |file| &mut file.objects),
            b"g" => self.name(rest, |file| &mut file.groups),
            b"s" => self.smoothing_group(line, rest),
            b"usemtl" => self.material(line, rest)?,
            b"mtllib" => self.libraries(line, rest),
            _ if keyword.is_empty() || keyword[0] == b'#' => {}
            _ => self.unknown(line, keyword),
        }
        Ok(())
    }

    fn unknown(&mut self, line: &Line, keyword: &[u8]) {
        let what = match keyword {
            b"l" => "lines (“l”) are skipped".to_owned(),
            b"p" => "points (“p”) are skipped".to_owned(),
            b"cstype" | b"deg" | b"bmat" | b"step" | b"curv" | b"curv2" | b"surf" | b"parm" | b"trim"
            | b"hole" | b"scrv" | b"sp" | b"end" | b"con" | b"vp" | b"bzp" | b"bsp" | b"cdc" | b"cdp"
            | b"res" => {
                format!("free-form geometry (“{}”) is skipped", String::from_utf8_lossy(keyword))
            }
            _ => format!("unknown keyword {} is skipped", quote(keyword)),
        };
        self.warnings.add(Some(line.number), &what);
    }

    /// Up to three numbers, at least `least`; missing ones are zero.
    fn numbers(line: &Line, rest: &[u8], least: usize, expected: &str) -> Result<[f32; 3], DecodeError> {
        let mut numbers = [0.0; 3];
        let mut count = 0;
        for word in words(rest).take_while(|word| word[0] != b'#').take(3) {
            numbers[count] = number(line, word)?;
            count += 1;
        }
        if count < least {
            return Err(syntax(line, rest, expected));
        }
        Ok(numbers)
    }

    fn vertex(&mut self, line: &Line, rest: &[u8]) -> Result<(), DecodeError> {
        let mut numbers = [0.0f32; 7];
        let mut count = 0;
        for word in words(rest).take_while(|word| word[0] != b'#') {
            if count == 7 {
                self.warnings
                    .add(Some(line.number), "more than seven numbers after “v”: the others are ignored");
                break;
            }
            numbers[count] = number(line, word)?;
            count += 1;
        }
        let [x, y, z, a, b, c, d] = numbers;
        // The fourth of four or five numbers is the weight of rational curves: it means nothing for polygons.
        let color = match count {
            0..3 => return Err(syntax(line, rest, "three numbers after “v”, perhaps a weight or a colour")),
            6 => Some(Vec4::new(a, b, c, 1.0)),
            7 => Some(Vec4::new(a, b, c, d)),
            _ => None,
        };
        let positions = &mut self.file.mesh.positions;
        if let Some(mut color) = color {
            if !color.is_finite() {
                self.warnings.add(Some(line.number), "a colour that is not finite is taken as white");
                color = Vec4::ONE;
            }
            // Vertices before the first coloured one are white.
            self.colors.resize(positions.len(), Vec4::ONE);
            self.colors.push(color);
        }
        positions.push(Vec3::new(x, y, z));
        Ok(())
    }

    fn face(&mut self, line: &Line, rest: &[u8]) -> Result<(), DecodeError> {
        if self.extras.skips_face() {
            return Ok(());
        }
        self.corners(line, rest)?;
        self.end_face(line)?;
        Ok(())
    }

    /// Reads corners of the face that is being made.
    pub(super) fn corners(&mut self, line: &Line, rest: &[u8]) -> Result<(), DecodeError> {
        let mesh = &mut self.file.mesh;
        let counts = [mesh.positions.len(), self.uvs.len(), self.normals.len()];
        for word in words(rest).take_while(|word| word[0] != b'#') {
            let mut indices = [NONE; 3];
            let mut parts = word.split(|&b| b == b'/');
            for (list, index) in indices.iter_mut().enumerate() {
                let Some(part) = parts.next() else { break };
                if part.is_empty() && list > 0 {
                    continue;
                }
                *index = resolve(line, word, part, list, counts[list])?;
                let is_further = |r: &Reference| *index > r.index;
                if *index as usize >= counts[list] && self.furthest[list].as_ref().is_none_or(is_further) {
                    let (index, place, text) = (*index, line.place_of(word), quote(word));
                    self.furthest[list] = Some(Reference { index, place, text });
                }
            }
            if parts.next().is_some() {
                return Err(syntax(line, word, FACE_FORMS));
            }
            mesh.corners.push(indices[0]);
            self.uv_corners.push(indices[1]);
            self.normal_corners.push(indices[2]);
        }
        Ok(())
    }

    /// Ends the face whose corners have been read; false if it has too few of them and is left out.
    pub(super) fn end_face(&mut self, line: &Line) -> Result<bool, DecodeError> {
        let mesh = &mut self.file.mesh;
        let before = mesh.face_ends.last().map_or(0, |end| *end as usize);
        if mesh.corners.len() - before < 3 {
            self.truncate_corners(before);
            self.warnings.add(Some(line.number), "a face with fewer than three corners is left out");
            return Ok(false);
        }
        if mesh.corners.len() >= u32::MAX as usize / 2 {
            return Err(too_large(line, "more than two thousand million corners"));
        }
        if self.file.materials.is_empty() {
            self.file.materials.push(String::new());
            self.slot_of.insert(Vec::new(), 0);
        }
        mesh.face_ends.push(mesh.corners.len() as u32);
        mesh.slots.push(self.slot);
        self.groups.push(self.smoothing);
        Ok(true)
    }

    /// Takes back the corners from `count` on.
    pub(super) fn truncate_corners(&mut self, count: usize) {
        self.file.mesh.corners.truncate(count);
        self.uv_corners.truncate(count);
        self.normal_corners.truncate(count);
    }

    /// Gives a material name its slot before it is used. Slots between that have no name get the empty one.
    pub(super) fn declare_slot(&mut self, slot: u16, name: &[u8]) {
        let materials = &mut self.file.materials;
        // Names in order only: a number far ahead would cost memory for nothing.
        if usize::from(slot) == materials.len() && self.file.mesh.face_ends.is_empty() {
            materials.push(String::from_utf8_lossy(name).into_owned());
            self.slot_of.entry(name.to_vec()).or_insert(slot);
        }
    }

    fn name(&mut self, rest: &[u8], list: fn(&mut ObjFile) -> &mut Vec<NamedFaces>) {
        let faces = self.file.mesh.face_ends.len() as u32;
        let list = list(&mut self.file);
        close_last(list, faces);
        let name = String::from_utf8_lossy(rest.trim_ascii()).into_owned();
        list.push(NamedFaces { name, faces: faces..faces });
    }

    fn smoothing_group(&mut self, line: &Line, rest: &[u8]) {
        let word = words(rest).next().unwrap_or(b"");
        self.smoothing = match word {
            b"off" => 0,
            b"on" => 1,
            _ => parse_i64(word).and_then(|group| u32::try_from(group).ok()).unwrap_or_else(|| {
                let message = format!("smoothing group {} is taken as off", quote(word));
                self.warnings.add(Some(line.number), &message);
                0
            }),
        };
        self.any_smoothing |= self.smoothing > 0;
    }

    fn material(&mut self, line: &Line, rest: &[u8]) -> Result<(), DecodeError> {
        let name = rest.trim_ascii();
        if let Some(&slot) = self.slot_of.get(name) {
            self.slot = slot;
            return Ok(());
        }
        let slot = u16::try_from(self.file.materials.len())
            .map_err(|_| too_large(line, "more than 65536 materials"))?;
        self.slot_of.insert(name.to_vec(), slot);
        self.file.materials.push(String::from_utf8_lossy(name).into_owned());
        self.slot = slot;
        Ok(())
    }

    /// Names may hold spaces, escaped or not: a name goes on until a word ends in `.mtl`.
    fn libraries(&mut self, line: &Line, rest: &[u8]) {
        let text = String::from_utf8_lossy(rest.trim_ascii()).replace("\\ ", "\u{0}");
        let mut name = String::new();
        let mut words = text.split_inclusive(char::is_whitespace).peekable();
        while let Some(word) = words.next() {
            name.push_str(word);
            if word.trim_end().to_ascii_lowercase().ends_with(".mtl") || words.peek().is_none() {
                let clean = name.trim().trim_matches('"').replace('\u{0}', " ");
                let libraries = &mut self.file.libraries;
                if libraries.len() == MOST_LIBRARIES {
                    self.warnings.add(Some(line.number), "too many material files: the others are ignored");
                } else if !clean.is_empty() && !libraries.contains(&clean) {
                    libraries.push(clean);
                }
                name.clear();
            }
        }
    }
}

const FACE_FORMS: &str = "a corner as v, v/vt, v//vn or v/vt/vn";

/// The place in its list that a number of a corner means: from 1, or back from the end.
fn resolve(line: &Line, word: &[u8], part: &[u8], list: usize, count: usize) -> Result<u32, DecodeError> {
    let Some(number) = parse_i64(part) else { return Err(syntax(line, word, FACE_FORMS)) };
    let index = match number {
        1.. => number - 1,
        0 => -1,
        _ => count as i64 + number,
    };
    u32::try_from(index).ok().filter(|&index| index < NONE).ok_or_else(|| {
        let expected = match number {
            0 => format!("numbers from 1 or, counted from the end, from -1 ({FACE_FORMS})"),
            _ => format!("a reference to one of the {count} {} above", LISTS[list]),
        };
        DecodeError::new(ErrorKind::IndexOutOfRange, line.place_of(word), quote(word), expected)
    })
}

pub(super) fn close_last(list: &mut Vec<NamedFaces>, faces: u32) {
    if let Some(last) = list.last_mut() {
        last.faces.end = faces;
        if last.faces.is_empty() {
            list.pop();
        }
    }
}

fn number(line: &Line, word: &[u8]) -> Result<f32, DecodeError> {
    parse_f32(word).ok_or_else(|| syntax(line, word, "a number"))
}

fn syntax(line: &Line, part: &[u8], expected: &str) -> DecodeError {
    let found = if part.is_empty() { "the end of the line".to_owned() } else { quote(part) };
    DecodeError::new(ErrorKind::Syntax, line.place_of(part), found, expected)
}

fn too_large(line: &Line, found: &str) -> DecodeError {
    DecodeError::new(ErrorKind::TooLarge, line.place_of(&line.text), found, "fewer")
}
