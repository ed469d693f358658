//! The reader of elements.

use glam::{Vec2, Vec3, Vec4};

use super::header::{Element, Header, Property, Scalar};
use super::source::{Binary, Source, Text, check_count};
use super::{Encoding, PlyFile};
use crate::PolygonMesh;
use crate::codec::color::srgb_to_linear;
use crate::codec::error::{DecodeError, ErrorKind, Place, Warnings};
use crate::polygon_mesh::CornerAttribute;

/// Reads a PLY file.
///
/// Errors: a header that is not one, vertices without x, y and z, data that ends early or is no number, a face with a
/// vertex that does not exist. Warnings: everything skipped, faces with fewer than three corners or with a vertex that
/// is not finite (left out), no faces at all.
pub fn decode(bytes: &[u8]) -> Result<PlyFile, DecodeError> {
    let header = Header::parse(bytes)?;
    match header.encoding {
        Encoding::Ascii => read(&header, &mut Text::new(bytes, &header)),
        Encoding::LittleEndian | Encoding::BigEndian => read(&header, &mut Binary::new(bytes, &header)),
    }
}

fn read(header: &Header, source: &mut impl Source) -> Result<PlyFile, DecodeError> {
    let mut reader = Reader::default();
    for element in &header.elements {
        check_count(source, element)?;
        match element.name.as_str() {
            "vertex" if !reader.has_vertices => reader.vertices(element, source)?,
            "face" => reader.faces(element, source)?,
            "tristrips" => reader.strips(element, source)?,
            _ => {
                if element.count > 0 {
                    reader
                        .warn(element.line, &format!("element “{}” is skipped", element.name.escape_debug()));
                }
                skip_element(element, source)?;
            }
        }
    }
    if !source.is_done() {
        reader.warnings.add(None, "what follows the last element is ignored");
    }
    reader.finish()
}

/// The columns of a vertex that mean something.
const COLUMNS: usize = 12;

/// A vertex of which nothing is known.
const OPAQUE: [f32; COLUMNS] = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];

/// Names of properties and the column they fill.
const VERTEX_NAMES: [(&str, usize); 22] = [
    ("x", 0),
    ("y", 1),
    ("z", 2),
    ("nx", 3),
    ("ny", 4),
    ("nz", 5),
    ("u", 6),
    ("v", 7),
    ("s", 6),
    ("t", 7),
    ("texture_u", 6),
    ("texture_v", 7),
    ("texture_s", 6),
    ("texture_t", 7),
    ("red", 8),
    ("green", 9),
    ("blue", 10),
    ("alpha", 11),
    ("diffuse_red", 8),
    ("diffuse_green", 9),
    ("diffuse_blue", 10),
    ("diffuse_alpha", 11),
];

#[derive(Default)]
struct Reader {
    file: PlyFile,
    has_vertices: bool,
    /// Faces to check once the vertices are known: the furthest vertex and where it is named.
    furthest: Option<(u32, DecodeError)>,
    /// Texture coordinates by corner; shorter than the corners if the last faces have none.
    corner_uvs: Vec<Vec2>,
    any_slot: bool,
    short_faces: usize,
    /// Lines with more on them than the header says.
    surplus: u64,
    warnings: Warnings,
}

impl Reader {
    fn warn(&mut self, line: u64, message: &str) {
        self.warnings.add(Some(line), message);
    }

    fn vertices(&mut self, element: &Element, source: &mut impl Source) -> Result<(), DecodeError> {
        self.has_vertices = true;
        let mut is_present = [false; COLUMNS];
        let mut columns = Vec::with_capacity(element.properties.len());
        for property in &element.properties {
            let known = VERTEX_NAMES.iter().find(|(name, _)| *name == property.name);
            let column = known.map(|(_, column)| *column);
            let column = column.filter(|&c| property.list_length.is_none() && !is_present[c]);
            match column {
                Some(column) => is_present[column] = true,
                None => self.warn(element.line, &format!("property {} is skipped", quoted_name(property))),
            }
            columns.push(column);
        }
        if !is_present[..3].iter().all(|&present| present) {
            let place = Place::Text { line: element.line, column: 1 };
            let found = "an element “vertex” without all three";
            return Err(DecodeError::new(ErrorKind::Syntax, place, found, "the properties x, y and z"));
        }
        let has_normals = is_present[3..6] == [true; 3];
        let has_uvs = is_present[6..8] == [true; 2];
        let has_colors = is_present[8..11] == [true; 3];
        let count = element.count as usize;
        self.file.mesh.positions.reserve(count);
        let (mut normals, mut uvs, mut colors) = (Vec::new(), Vec::new(), Vec::new());
        let mut add = |row: [f32; COLUMNS], mesh: &mut PolygonMesh| {
            let [x, y, z, nx, ny, nz, u, v, red, green, blue, alpha] = row;
            mesh.positions.push(Vec3::new(x, y, z));
            if has_normals {
                normals.push(Vec3::new(nx, ny, nz));
            }
            if has_uvs {
                uvs.push(Vec2::new(u, v));
            }
            if has_colors {
                colors.push(Vec4::new(red, green, blue, alpha));
            }
        };
        let mut left = count;
        let is_plain = |p: &Property| p.list_length.is_none() && p.scalar == Scalar::F32;
        if element.properties.iter().all(is_plain) {
            // Rows of equal length: no question is asked for each number.
            let size = 4 * element.properties.len();
            if let Some(bytes) = source.take_bytes(size * count) {
                for record in bytes.chunks_exact(size) {
                    let mut row = OPAQUE;
                    for (number, column) in record.as_chunks::<4>().0.iter().zip(&columns) {
                        if let Some(column) = column {
                            row[*column] = f32::from_le_bytes(*number);
                        }
                    }
                    add(row, &mut self.file.mesh);
                    left -= 1;
                }
            }
        }
        for _ in 0..left {
            let mut row = OPAQUE;
            for (property, column) in element.properties.iter().zip(&columns) {
                match column {
                    Some(column @ 8..) => {
                        row[*column] = color(source.float(property.scalar)?, property, *column == 11)
                    }
                    Some(column) => row[*column] = source.float(property.scalar)?,
                    None => skip_property(property, source)?,
                }
            }
            self.surplus += u64::from(source.end_row());
            add(row, &mut self.file.mesh);
        }
        let mesh = &mut self.file.mesh;
        if has_uvs {
            mesh.uv_sets.push(CornerAttribute::per_position(uvs));
        }
        mesh.normals = CornerAttribute::per_position(normals);
        mesh.colors = CornerAttribute::per_position(colors);
        Ok(())
    }

    fn faces(&mut self, element: &Element, source: &mut impl Source) -> Result<(), DecodeError> {
        let is_list = |property: &Property, names: [&str; 2]| {
            property.list_length.filter(|_| names.contains(&property.name.as_str()))
        };
        for property in &element.properties {
            let is_known = is_list(property, ["vertex_indices", "vertex_index"]).is_some()
                || is_list(property, ["texcoord"; 2]).is_some()
                || (property.name == "material_index" && property.list_length.is_none());
            if !is_known && element.count > 0 {
                self.warn(element.line, &format!("property {} of faces is skipped", quoted_name(property)));
            }
        }
        let mut uvs: Vec<Vec2> = Vec::new();
        for _ in self.plain_faces(element, source)..element.count {
            if element.properties.is_empty() {
                break;
            }
            let first = self.file.mesh.corners.len();
            let mut slot = 0;
            uvs.clear();
            for property in &element.properties {
                if let Some(length) = is_list(property, ["vertex_indices", "vertex_index"]) {
                    for _ in 0..source.list_length(length, property.scalar)? {
                        let index = source.integer(property.scalar)?;
                        let index = self.vertex_index(index, source)?;
                        self.file.mesh.corners.push(index);
                    }
                } else if let Some(length) = is_list(property, ["texcoord"; 2]) {
                    let count = source.list_length(length, property.scalar)?;
                    for _ in 0..count / 2 {
                        let (u, v) = (source.float(property.scalar)?, source.float(property.scalar)?);
                        uvs.push(Vec2::new(u, v));
                    }
                    source.skip(property.scalar, count % 2)?;
                } else if property.name == "material_index" && property.list_length.is_none() {
                    let number = source.integer(property.scalar)?;
                    slot = u16::try_from(number).map_err(|_| {
                        source.error(ErrorKind::TooLarge, "a material number from 0 to 65535")
                    })?;
                    self.any_slot = true;
                } else {
                    skip_property(property, source)?;
                }
            }
            self.surplus += u64::from(source.end_row());
            self.end_face(first, &uvs, slot);
        }
        Ok(())
    }

    /// Reads faces as far as they are of the usual kind (a byte for the length, then indices of four bytes, nothing else)
    /// without asking for each number; returns how many. Whatever is odd is left to the long way.
    fn plain_faces(&mut self, element: &Element, source: &mut impl Source) -> u64 {
        let [property] = element.properties.as_slice() else { return 0 };
        let is_usual = property.list_length == Some(Scalar::U8)
            && matches!(property.scalar, Scalar::I32 | Scalar::U32)
            && matches!(property.name.as_str(), "vertex_indices" | "vertex_index");
        let Some(bytes) = source.bytes_left().filter(|_| is_usual && self.has_vertices) else { return 0 };
        let known = self.file.mesh.positions.len() as u64;
        let mesh = &mut self.file.mesh;
        mesh.face_ends.reserve(element.count as usize);
        mesh.slots.reserve(element.count as usize);
        let (mut faces, mut at) = (0, 0);
        while faces < element.count
            && let Some((&length, rest)) = bytes[at..].split_first()
            && length >= 3
            && let Some(indices) = rest.get(..4 * usize::from(length))
        {
            let indices = indices.as_chunks::<4>().0.iter().map(|index| u32::from_le_bytes(*index));
            if indices.clone().any(|index| u64::from(index) >= known) {
                break;
            }
            mesh.corners.extend(indices);
            mesh.face_ends.push(mesh.corners.len() as u32);
            mesh.slots.push(0);
            at += 1 + 4 * usize::from(length);
            faces += 1;
        }
        source.take_bytes(at);
        faces
    }

    fn vertex_index(&mut self, index: i64, source: &impl Source) -> Result<u32, DecodeError> {
        let count = self.file.mesh.positions.len();
        let valid = u32::try_from(index).ok().filter(|&index| index < u32::MAX);
        let error = || {
            let expected = format!("the number of one of {count} vertices, from 0");
            source.error(ErrorKind::IndexOutOfRange, &expected)
        };
        let Some(valid) = valid else { return Err(error()) };
        if valid as usize >= count {
            // The vertices may come after the faces.
            if self.has_vertices {
                return Err(error());
            }
            if self.furthest.as_ref().is_none_or(|(furthest, _)| valid > *furthest) {
                self.furthest = Some((valid, error()));
            }
        }
        Ok(valid)
    }

    fn end_face(&mut self, first: usize, uvs: &[Vec2], slot: u16) {
        let mesh = &mut self.file.mesh;
        if mesh.corners.len() - first < 3 {
            mesh.corners.truncate(first);
            self.short_faces += 1;
            return;
        }
        if uvs.len() == mesh.corners.len() - first {
            self.corner_uvs.resize(first, Vec2::ZERO);
            self.corner_uvs.extend_from_slice(uvs);
        }
        mesh.face_ends.push(mesh.corners.len() as u32);
        mesh.slots.push(slot);
    }

    /// Strips of triangles: every other one is turned around; −1 starts anew.
    fn strips(&mut self, element: &Element, source: &mut impl Source) -> Result<(), DecodeError> {
        for _ in 0..element.count {
            if element.properties.is_empty() {
                break;
            }
            for property in &element.properties {
                let is_indices = matches!(property.name.as_str(), "vertex_indices" | "vertex_index");
                let Some(length) = property.list_length.filter(|_| is_indices) else {
                    skip_property(property, source)?;
                    continue;
                };
                let mut recent: [u32; 2] = [0; 2];
                let mut run = 0u64;
                for _ in 0..source.list_length(length, property.scalar)? {
                    let index = source.integer(property.scalar)?;
                    if index == -1 {
                        run = 0;
                        continue;
                    }
                    let index = self.vertex_index(index, source)?;
                    let [a, b] = recent;
                    // Strips turn with triangles that are lines: those are no faces.
                    if run >= 2 && a != b && b != index && index != a {
                        let corners = if run.is_multiple_of(2) { [a, b, index] } else { [b, a, index] };
                        let first = self.file.mesh.corners.len();
                        self.file.mesh.corners.extend(corners);
                        self.end_face(first, &[], 0);
                    }
                    recent = [b, index];
                    run += 1;
                }
            }
            self.surplus += u64::from(source.end_row());
        }
        Ok(())
    }

    fn finish(mut self) -> Result<PlyFile, DecodeError> {
        let count = self.file.mesh.positions.len();
        if let Some((_, mut error)) = self.furthest.filter(|(furthest, _)| *furthest as usize >= count) {
            error.expected = format!("the number of one of {count} vertices, from 0");
            return Err(error);
        }
        let mesh = &mut self.file.mesh;
        if !self.any_slot {
            mesh.slots.clear();
        }
        if !self.corner_uvs.is_empty() {
            self.corner_uvs.resize(mesh.corners.len(), Vec2::ZERO);
            let corners = (0..mesh.corners.len() as u32).collect();
            mesh.uv_sets = vec![CornerAttribute::indexed(self.corner_uvs, corners)];
        }
        if self.surplus > 0 {
            let message =
                format!("{} lines hold more than the header says: the rest is ignored", self.surplus);
            self.warnings.add(None, &message);
        }
        if self.short_faces > 0 {
            let message = format!("{} faces with fewer than three corners are left out", self.short_faces);
            self.warnings.add(None, &message);
        }
        let lost = mesh.drop_not_finite().map_or(0, |kept| kept.iter().filter(|kept| !**kept).count());
        if lost > 0 {
            self.warnings.add(None, &format!("{lost} faces with a vertex that is not finite are left out"));
        }
        mesh.normalize_normals();
        if mesh.face_ends.is_empty() {
            let message = match count {
                0 => "the file has neither vertices nor faces".to_owned(),
                _ => format!("the file has no faces: it is a cloud of {count} points"),
            };
            self.warnings.add(None, &message);
        }
        self.file.warnings = self.warnings.into_list();
        Ok(self.file)
    }
}

fn color(stored: f32, property: &Property, is_alpha: bool) -> f32 {
    match property.scalar.full_color() {
        None => stored,
        Some(full) if is_alpha => stored / full,
        Some(full) => srgb_to_linear(stored / full),
    }
}

fn skip_element(element: &Element, source: &mut impl Source) -> Result<(), DecodeError> {
    if element.properties.is_empty() {
        return Ok(());
    }
    for _ in 0..element.count {
        for property in &element.properties {
            skip_property(property, source)?;
        }
        source.end_row();
    }
    Ok(())
}

fn skip_property(property: &Property, source: &mut impl Source) -> Result<(), DecodeError> {
    let count = match property.list_length {
        Some(length) => source.list_length(length, property.scalar)?,
        None => 1,
    };
    source.skip(property.scalar, count)
}

fn quoted_name(property: &Property) -> String {
    crate::codec::error::quote(property.name.as_bytes())
}
