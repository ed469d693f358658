//! The writer: every list with its own index set, just as the mesh has them.

use std::collections::HashSet;

use super::extra;
use crate::codec::error::EncodeError;
use crate::codec::soundness;
use crate::codec::text::{put_all, put_f32, put_integer, write_rows};
use crate::polygon_mesh::CornerAttribute;
use crate::{PolygonMesh, TriangleMesh};

/// What an OBJ file says besides the mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EncodeOptions {
    /// The name of the material file; none means no `mtllib` line.
    pub library: Option<String>,
    /// The name of each material slot. Slots beyond are called `slot` and their number.
    pub materials: Vec<String>,
}

/// Writes a mesh. Numbers are the shortest that read back as the same `f32`.
///
/// Lost: tangents. Uv sets but the first, and colours that are not one per position, stand in comments of our own (see
/// [`super`]). A mesh with problems ([`TriangleMesh::validate`]) gives the empty text.
pub fn encode(mesh: &TriangleMesh, options: &EncodeOptions) -> String {
    let text = encode_polygons(&PolygonMesh::from(mesh), options).unwrap_or_default();
    String::from_utf8_lossy(&text).into_owned()
}

/// Writes a polygon mesh so that [`super::decode`] gives it back: faces of any size, holes, all uv sets, colours, slots,
/// smoothing groups, creases, sharp vertices. What OBJ has no word for stands in comments of our own (see [`super`]).
///
/// Numbers are the shortest that read back as the same `f32`. An index set that says for every corner what the positions
/// say comes back as values that run parallel to the positions, which is the same. Not kept, because readers leave it out:
/// faces with fewer than three corners or with a position that is not finite.
///
/// # Errors
/// If the mesh is broken: an index leads nowhere, lists differ in length.
pub fn encode_polygons(mesh: &PolygonMesh, options: &EncodeOptions) -> Result<Vec<u8>, EncodeError> {
    soundness::check(mesh)?;
    let mut text = Vec::new();
    if let Some(library) = &options.library {
        text.extend(format!("mtllib {}\n", one_line(library)).bytes());
    }
    write_values(&mut text, mesh);
    let names = slot_names(mesh, &options.materials);
    extra::write_header(&mut text, mesh, &names);
    write_faces(&mut text, mesh, &names);
    extra::write_sharpness(&mut text, mesh);
    Ok(text)
}

/// A name as it can stand in a line.
fn one_line(name: &str) -> String {
    name.replace(['\n', '\r'], " ").trim().to_owned()
}

/// The names of all slots in use or named, by number, no two alike; none if there is nothing to say.
fn slot_names(mesh: &PolygonMesh, materials: &[String]) -> Vec<String> {
    if mesh.slots.is_empty() && materials.is_empty() {
        return Vec::new();
    }
    let count = materials.len().max(mesh.slots.iter().max().map_or(1, |most| usize::from(*most) + 1));
    let mut known = HashSet::new();
    let names = (0..count).map(|slot| {
        let given = materials.get(slot).map_or_else(|| format!("slot{slot}"), |name| one_line(name));
        let name = if known.contains(&given) { format!("{given}.slot{slot}") } else { given };
        known.insert(name.clone());
        name
    });
    names.collect()
}

fn write_values(text: &mut Vec<u8>, mesh: &PolygonMesh) {
    let is_per_position = mesh.colors.corners.is_empty() && !mesh.colors.is_empty();
    let is_opaque = mesh.colors.values.iter().all(|color| color.w == 1.0);
    let channels = if is_opaque { 3 } else { 4 };
    write_rows(text, mesh.positions.len(), |i, text| {
        text.push(b'v');
        put_all(text, &mesh.positions[i].to_array());
        if is_per_position {
            put_all(text, &mesh.colors.values[i].to_array()[..channels]);
        }
        text.push(b'\n');
    });
    if let Some(uvs) = mesh.uv_sets.first() {
        write_rows(text, uvs.values.len(), |i, text| {
            text.extend(b"vt");
            put_all(text, &uvs.values[i].to_array());
            text.push(b'\n');
        });
    }
    write_rows(text, mesh.normals.values.len(), |i, text| {
        text.extend(b"vn");
        put_all(text, &mesh.normals.values[i].to_array());
        text.push(b'\n');
    });
}

fn write_faces(text: &mut Vec<u8>, mesh: &PolygonMesh, names: &[String]) {
    let uvs = mesh.uv_sets.first().filter(|uvs| !uvs.is_empty());
    let normals = Some(&mesh.normals).filter(|normals| !normals.is_empty());
    let slot_of = |face: usize| mesh.slots.get(face).copied().unwrap_or(0);
    let group_of = |face: usize| mesh.smoothing_groups.get(face).copied().unwrap_or(0);
    let holed = extra::HoledFaces::new(mesh);
    let extras = extra::extra_attributes(mesh);
    write_rows(text, mesh.face_count(), |face, text| {
        let previous = face.checked_sub(1);
        if !names.is_empty() && previous.is_none_or(|previous| slot_of(previous) != slot_of(face)) {
            text.extend(b"usemtl ");
            text.extend(names[usize::from(slot_of(face))].bytes());
            text.push(b'\n');
        }
        if !mesh.smoothing_groups.is_empty()
            && previous.is_none_or(|previous| group_of(previous) != group_of(face))
        {
            text.extend(b"s ");
            put_integer(text, u64::from(group_of(face)));
            text.push(b'\n');
        }
        let corners = mesh.face(face);
        if holed.has(face) {
            holed
                .write_polygon(text, mesh, face, |text, corner| put_corner(text, mesh, uvs, normals, corner));
        } else {
            text.push(b'f');
            corners.clone().for_each(|corner| put_corner(text, mesh, uvs, normals, corner));
            text.push(b'\n');
        }
        extras.iter().for_each(|extra| extra.write_corners(text, corners.clone()));
        if holed.has(face) {
            holed.write_triangles(text, face);
        }
    });
}

fn put_corner(
    text: &mut Vec<u8>,
    mesh: &PolygonMesh,
    uvs: Option<&CornerAttribute<glam::Vec2>>,
    normals: Option<&CornerAttribute<glam::Vec3>>,
    corner: usize,
) {
    let position = mesh.corners[corner];
    text.push(b' ');
    put_integer(text, u64::from(position) + 1);
    let number = |indices: &[u32]| u64::from(indices.get(corner).copied().unwrap_or(position)) + 1;
    match (uvs.map(|uvs| number(&uvs.corners)), normals.map(|normals| number(&normals.corners))) {
        (None, None) => {}
        (uv, None) => {
            text.push(b'/');
            put_integer(text, uv.unwrap_or(1));
        }
        (uv, Some(normal)) => {
            text.push(b'/');
            if let Some(uv) = uv {
                put_integer(text, uv);
            }
            text.push(b'/');
            put_integer(text, normal);
        }
    }
}

/// Appends a word, a number of a slot or set, and numbers.
pub(super) fn put_tagged(text: &mut Vec<u8>, tag: &str, numbers: &[f32]) {
    text.extend(tag.bytes());
    for &number in numbers {
        text.push(b' ');
        put_f32(text, number);
    }
    text.push(b'\n');
}
