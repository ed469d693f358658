//! What OBJ has no word for, in comments that other programs pass over, and the tags of creases.

use std::ops::Range;

use glam::{Vec2, Vec4};

use super::read::{NONE, Reader};
use super::write::put_tagged;
use crate::PolygonMesh;
use crate::codec::cursor::Line;
use crate::codec::error::DecodeError;
use crate::codec::text::{put_integer, write_rows};
use crate::codec::token::{parse_f32, parse_i64, split_word, words};
use crate::polygon_mesh::{CornerAttribute, Crease, Hole, SharpVertex};

/// The most uv sets that are read.
const MOST_UV_SETS: usize = 16;

/// Lists of values beyond what OBJ knows.
#[derive(Default)]
pub(super) struct Extras {
    /// Uv sets 1, 2, ….
    uvs: Vec<Extra<Vec2>>,
    /// Colours that are not one for each position.
    colors: Extra<Vec4>,
    /// Faces to come that are pieces of one that is known.
    faces_to_skip: u64,
    /// Smoothing groups are there, but no normals are wanted.
    pub(super) is_plain: bool,
}

struct Extra<T> {
    values: Vec<T>,
    corners: Vec<u32>,
}

impl<T> Default for Extra<T> {
    fn default() -> Self {
        Self { values: Vec::new(), corners: Vec::new() }
    }
}

impl<T: Copy + Default> Extra<T> {
    /// Corners without a value get the default one; values as many as positions and no corners run parallel to them.
    fn finish(mut self, positions: usize, corners: usize) -> CornerAttribute<T> {
        if self.corners.is_empty() {
            return if self.values.len() == positions {
                CornerAttribute::per_position(self.values)
            } else {
                CornerAttribute::default()
            };
        }
        self.corners.resize(corners, NONE);
        let count = self.values.len();
        if self.corners.iter().any(|&corner| corner as usize >= count) {
            self.corners
                .iter_mut()
                .filter(|corner| **corner as usize >= count)
                .for_each(|corner| *corner = count as u32);
            self.values.push(T::default());
        }
        CornerAttribute::indexed(self.values, self.corners)
    }
}

impl Extras {
    /// True if the next face is to be passed over.
    pub(super) fn skips_face(&mut self) -> bool {
        let skips = self.faces_to_skip > 0;
        self.faces_to_skip = self.faces_to_skip.saturating_sub(1);
        skips
    }

    /// Puts the lists into the mesh.
    pub(super) fn finish(self, mesh: &mut PolygonMesh) {
        let (positions, corners) = (mesh.positions.len(), mesh.corners.len());
        if !self.colors.values.is_empty() {
            mesh.colors = self.colors.finish(positions, corners);
        }
        let more: Vec<_> = self.uvs.into_iter().map(|uvs| uvs.finish(positions, corners)).collect();
        if more.iter().any(|uvs| !uvs.is_empty()) {
            mesh.uv_sets.resize(1, CornerAttribute::default());
            mesh.uv_sets.extend(more);
        }
    }
}

impl Reader {
    /// A comment that begins with `#luch`. What is not understood is a comment like any other.
    pub(super) fn extra(&mut self, line: &Line, rest: &[u8]) -> Result<(), DecodeError> {
        let (keyword, rest) = split_word(rest);
        match keyword {
            b"slot" => {
                let (number, name) = split_word(rest);
                if let Some(number) = parse_i64(number).and_then(|number| u16::try_from(number).ok()) {
                    self.declare_slot(number, name.trim_ascii());
                }
            }
            b"uv" => {
                let (set, numbers) = split_word(rest);
                if let (Some(uvs), Some([u, v])) = (self.uv_set(set), floats(numbers)) {
                    uvs.values.push(Vec2::new(u, v));
                }
            }
            b"color" => {
                if let Some(color) = floats(rest) {
                    self.extras.colors.values.push(Vec4::from_array(color));
                }
            }
            b"uvs" => {
                let (set, numbers) = split_word(rest);
                let face = self.last_face();
                if let Some(uvs) = self.uv_set(set) {
                    add_corners(&mut uvs.corners, face, numbers);
                }
            }
            b"colors" => {
                let face = self.last_face();
                add_corners(&mut self.extras.colors.corners, face, rest);
            }
            b"polygon" => {
                let (count, rest) = split_word(rest);
                if let Some(count) = parse_i64(count).and_then(|count| u64::try_from(count).ok()) {
                    self.polygon(line, rest)?;
                    self.extras.faces_to_skip = count;
                }
            }
            b"plain" => self.extras.is_plain = true,
            _ => {}
        }
        Ok(())
    }

    fn uv_set(&mut self, number: &[u8]) -> Option<&mut Extra<Vec2>> {
        let set = usize::try_from(parse_i64(number)?).ok().filter(|set| (1..MOST_UV_SETS).contains(set))?;
        let sets = &mut self.extras.uvs;
        if sets.len() < set {
            sets.resize_with(set, Extra::default);
        }
        sets.get_mut(set - 1)
    }

    fn last_face(&self) -> Range<usize> {
        let mesh = &self.file.mesh;
        mesh.face_count().checked_sub(1).map_or(0..0, |face| mesh.face(face))
    }

    /// A face with holes: the corners of its borders, with `|` between them.
    fn polygon(&mut self, line: &Line, rest: &[u8]) -> Result<(), DecodeError> {
        let face = self.file.mesh.face_count() as u32;
        let before = self.file.mesh.holes.len();
        for (number, border) in rest.split(|&byte| byte == b'|').enumerate() {
            if number > 0 {
                let start = self.file.mesh.corners.len() as u32;
                self.file.mesh.holes.push(Hole { face, start });
            }
            let first = self.file.mesh.corners.len();
            self.corners(line, border)?;
            if number > 0 && self.file.mesh.corners.len() - first < 3 {
                // No border has fewer than three corners.
                self.truncate_corners(first);
                self.file.mesh.holes.pop();
            }
        }
        if !self.end_face(line)? {
            self.file.mesh.holes.truncate(before);
        }
        Ok(())
    }

    /// `t crease 2/1/0 v w sharpness` and `t corner 1/1/0 v sharpness`, with vertices from 0 (OpenSubdiv's shapes).
    pub(super) fn tag(&mut self, line: &Line, rest: &[u8]) {
        let (kind, rest) = split_word(rest);
        let mut numbers = words(rest);
        let counts = numbers.next().unwrap_or(b"");
        let mut vertex = || numbers.next().and_then(parse_i64).and_then(|number| u32::try_from(number).ok());
        let read = match (kind, counts) {
            (b"crease", b"2/1/0") => vertex().zip(vertex()).map(|(from, to)| [from, to]),
            (b"corner", b"1/1/0") => vertex().map(|vertex| [vertex; 2]),
            _ => {
                let message = "a tag of a kind that is not known here (known are “crease 2/1/0” and “corner 1/1/0”) is skipped";
                self.warnings.add(Some(line.number), message);
                return;
            }
        };
        let sharpness = numbers.next().and_then(parse_f32).filter(|sharpness| !sharpness.is_nan());
        let (Some(vertices), Some(sharpness)) = (read, sharpness) else {
            self.warnings.add(Some(line.number), "a tag without its vertices and sharpness is skipped");
            return;
        };
        let mesh = &mut self.file.mesh;
        if kind == b"crease" {
            mesh.creases.push(Crease { vertices, sharpness });
        } else {
            mesh.sharp_vertices.push(SharpVertex { vertex: vertices[0], sharpness });
        }
    }

    /// Leaves out tags of vertices that do not exist.
    pub(super) fn check_tags(&mut self) {
        let mesh = &mut self.file.mesh;
        let before = mesh.creases.len() + mesh.sharp_vertices.len();
        let exists = |vertex: &u32| (*vertex as usize) < mesh.positions.len();
        mesh.creases.retain(|crease| crease.vertices.iter().all(exists));
        mesh.sharp_vertices.retain(|sharp| exists(&sharp.vertex));
        if mesh.creases.len() + mesh.sharp_vertices.len() < before {
            self.warnings.add(None, "tags of vertices that do not exist are skipped");
        }
    }
}

/// Exactly `N` finite numbers.
fn floats<const N: usize>(text: &[u8]) -> Option<[f32; N]> {
    let mut numbers = [0.0; N];
    let mut given = words(text);
    for number in &mut numbers {
        *number = given.next().and_then(parse_f32).filter(|number| number.is_finite())?;
    }
    Some(numbers)
}

/// Adds the numbers of a face's corners, if they are as many as its corners.
fn add_corners(list: &mut Vec<u32>, face: Range<usize>, numbers: &[u8]) {
    list.resize(face.start.max(list.len()), NONE);
    if list.len() == face.start {
        let indices = words(numbers)
            .map(|word| parse_i64(word).and_then(|i| u32::try_from(i - 1).ok()).unwrap_or(NONE));
        list.extend(indices.take(face.len()));
        list.resize(face.end, NONE);
    }
}

/// A list that OBJ has no word for.
pub(super) struct ExtraCorners<'a> {
    tag: String,
    corners: &'a [u32],
}

/// The further uv sets and colours that have index sets of their own.
pub(super) fn extra_attributes(mesh: &PolygonMesh) -> Vec<ExtraCorners<'_>> {
    let uvs = mesh.uv_sets.iter().enumerate().skip(1).take(MOST_UV_SETS - 1);
    let mut all: Vec<ExtraCorners<'_>> = uvs
        .map(|(set, uvs)| ExtraCorners { tag: format!("#luch uvs {set}"), corners: &uvs.corners })
        .collect();
    all.push(ExtraCorners { tag: "#luch colors".to_owned(), corners: &mesh.colors.corners });
    all.retain(|extra| !extra.corners.is_empty());
    all
}

impl ExtraCorners<'_> {
    pub(super) fn write_corners(&self, text: &mut Vec<u8>, face: Range<usize>) {
        text.extend(self.tag.bytes());
        for &index in &self.corners[face] {
            text.push(b' ');
            put_integer(text, u64::from(index) + 1);
        }
        text.push(b'\n');
    }
}

/// The lists and names that stand before the faces.
pub(super) fn write_header(text: &mut Vec<u8>, mesh: &PolygonMesh, slots: &[String]) {
    for (number, name) in slots.iter().enumerate() {
        text.extend(format!("#luch slot {number} {name}\n").bytes());
    }
    if mesh.smoothing_groups.iter().any(|group| *group > 0) && mesh.normals.is_empty() {
        text.extend(b"#luch plain\n");
    }
    for (set, uvs) in mesh.uv_sets.iter().enumerate().skip(1).take(MOST_UV_SETS - 1) {
        let tag = format!("#luch uv {set}");
        write_rows(text, uvs.values.len(), |i, text| put_tagged(text, &tag, &uvs.values[i].to_array()));
    }
    if !mesh.colors.corners.is_empty() {
        let colors = &mesh.colors.values;
        write_rows(text, colors.len(), |i, text| put_tagged(text, "#luch color", &colors[i].to_array()));
    }
}

/// Creases and sharp vertices.
pub(super) fn write_sharpness(text: &mut Vec<u8>, mesh: &PolygonMesh) {
    for Crease { vertices: [from, to], sharpness } in &mesh.creases {
        text.extend(format!("t crease 2/1/0 {from} {to} {sharpness}\n").bytes());
    }
    for SharpVertex { vertex, sharpness } in &mesh.sharp_vertices {
        text.extend(format!("t corner 1/1/0 {vertex} {sharpness}\n").bytes());
    }
}

/// Faces with holes, which OBJ does not have: they are written as triangles, with the face itself in a comment before.
pub(super) struct HoledFaces {
    /// For each face with holes its triangles in `text`.
    faces: Vec<HoledFace>,
}

struct HoledFace {
    face: usize,
    count: usize,
    triangles: Vec<u8>,
}

impl HoledFaces {
    pub(super) fn new(mesh: &PolygonMesh) -> Self {
        if mesh.holes.is_empty() {
            return Self { faces: Vec::new() };
        }
        let mut numbers: Vec<usize> = mesh.holes.iter().map(|hole| hole.face as usize).collect();
        numbers.dedup();
        let cut = mesh.triangulation();
        let uvs = cut.mesh.uv_sets.first().filter(|uvs| !uvs.is_empty());
        let normals = Some(&cut.mesh.normals).filter(|normals| !normals.is_empty());
        let faces = numbers.into_iter().map(|face| {
            let start = cut.faces.partition_point(|of| (*of as usize) < face);
            let end = cut.faces.partition_point(|of| (*of as usize) <= face);
            let mut triangles = Vec::new();
            for t in start..end {
                triangles.push(b'f');
                for k in 0..3 {
                    let position = cut.mesh.triangles[t][k];
                    let number =
                        |indices: &[[u32; 3]]| indices.get(t).map_or(position, |triangle| triangle[k]) + 1;
                    let uv = uvs.map_or(String::new(), |uvs| number(&uvs.triangles).to_string());
                    let normal =
                        normals.map_or(String::new(), |normals| number(&normals.triangles).to_string());
                    let corner = format!(" {}/{uv}/{normal}", position + 1);
                    triangles.extend(corner.trim_end_matches('/').bytes());
                }
                triangles.push(b'\n');
            }
            HoledFace { face, count: end - start, triangles }
        });
        Self { faces: faces.collect() }
    }

    fn find(&self, face: usize) -> Option<&HoledFace> {
        let place = self.faces.binary_search_by_key(&face, |holed| holed.face).ok()?;
        self.faces.get(place)
    }

    pub(super) fn has(&self, face: usize) -> bool {
        !self.faces.is_empty() && self.find(face).is_some()
    }

    pub(super) fn write_polygon(
        &self,
        text: &mut Vec<u8>,
        mesh: &PolygonMesh,
        face: usize,
        put_corner: impl Fn(&mut Vec<u8>, usize),
    ) {
        let count = self.find(face).map_or(0, |holed| holed.count);
        text.extend(format!("#luch polygon {count}").bytes());
        for (number, border) in mesh.borders(face).into_iter().enumerate() {
            if number > 0 {
                text.extend(b" |");
            }
            border.for_each(|corner| put_corner(text, corner));
        }
        text.push(b'\n');
    }

    pub(super) fn write_triangles(&self, text: &mut Vec<u8>, face: usize) {
        if let Some(holed) = self.find(face) {
            text.extend_from_slice(&holed.triangles);
        }
    }
}
