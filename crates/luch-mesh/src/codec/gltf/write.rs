//! The writers.

use glam::{Vec2, Vec3, Vec4};

use super::EncodeOptions;
use super::json::{Buffer, Component, Target, base64, quoted};
use crate::codec::error::EncodeError;
use crate::codec::soundness;
use crate::codec::vertices::Split;
use crate::{PolygonMesh, TriangleMesh, unify};

/// Writes one binary file (GLB). Lost: positions that no triangle uses.
///
/// # Errors
/// If the mesh is broken or the file would pass 4 GiB.
pub fn encode_binary(mesh: &TriangleMesh, options: &EncodeOptions) -> Result<Vec<u8>, EncodeError> {
    let parts = Parts::new(mesh, options)?;
    let mut json = parts.buffer.document(&parts.primitives, &parts.materials, None).into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut binary = parts.buffer.bytes;
    binary.resize(binary.len().next_multiple_of(4), 0);
    let binary_chunk = if binary.is_empty() { 0 } else { 8 + binary.len() };
    let length = 12 + 8 + json.len() + binary_chunk;
    let stated = u32::try_from(length).map_err(|_| EncodeError::TooLarge {
        format: "GLB",
        what: "bytes",
        most: u64::from(u32::MAX),
        found: length as u64,
    })?;
    let mut bytes = Vec::with_capacity(length);
    bytes.extend_from_slice(b"glTF");
    bytes.extend(2u32.to_le_bytes());
    bytes.extend(stated.to_le_bytes());
    bytes.extend((json.len() as u32).to_le_bytes());
    bytes.extend_from_slice(b"JSON");
    bytes.append(&mut json);
    if !binary.is_empty() {
        bytes.extend((binary.len() as u32).to_le_bytes());
        bytes.extend_from_slice(b"BIN\0");
        bytes.append(&mut binary);
    }
    Ok(bytes)
}

/// Writes JSON that holds the data as text. Lost: positions that no triangle uses.
///
/// # Errors
/// If the mesh is broken.
pub fn encode_text(mesh: &TriangleMesh, options: &EncodeOptions) -> Result<String, EncodeError> {
    let parts = Parts::new(mesh, options)?;
    let uri = format!("data:application/octet-stream;base64,{}", base64(&parts.buffer.bytes));
    Ok(parts.buffer.document(&parts.primitives, &parts.materials, Some(&uri)))
}

struct Parts {
    buffer: Buffer,
    primitives: Vec<String>,
    materials: Vec<String>,
}

impl Parts {
    fn new(mesh: &TriangleMesh, options: &EncodeOptions) -> Result<Self, EncodeError> {
        let polygons = PolygonMesh::from(mesh);
        soundness::check(&polygons)?;
        if let Some(problem) = mesh.validate().first() {
            return Err(EncodeError::Broken(problem.to_string()));
        }
        // Tangents are not among what polygons have: split by them first.
        let (polygons, tangents) = if mesh.tangents.is_empty() {
            (polygons, None)
        } else {
            let unified = unify::split_positions(mesh);
            (PolygonMesh::from(&unified), Some(unified.tangents.values))
        };
        let split = Split::new(&polygons, polygons.uv_sets.len());
        let used = Used::new(&split);
        let mut buffer = Buffer::default();
        if used.vertices.is_empty() {
            return Ok(Self { buffer, primitives: Vec::new(), materials: Vec::new() });
        }
        let attributes =
            write_attributes(&mut buffer, &polygons, tangents.as_deref(), &split, &used.vertices);
        let mut slots: Vec<u16> = polygons.slots.clone();
        slots.sort_unstable();
        slots.dedup();
        if slots.is_empty() {
            slots.push(0);
        }
        let (mut primitives, mut materials) = (Vec::new(), Vec::new());
        for slot in slots {
            let is_of_slot = |triangle: &usize| polygons.slots.get(*triangle).copied().unwrap_or(0) == slot;
            let triangles = (0..polygons.face_count()).filter(is_of_slot);
            let corners = triangles.flat_map(|t| [3 * t, 3 * t + 1, 3 * t + 2]);
            let indices: Vec<u32> = corners.map(|c| used.numbers[split.corners[c] as usize]).collect();
            let accessor = write_indices(&mut buffer, &indices, used.vertices.len());
            let material = materials.len();
            primitives.push(format!(
                r#"{{"attributes":{{{attributes}}},"indices":{accessor},"material":{material}}}"#
            ));
            let name = options.materials.get(usize::from(slot)).cloned();
            let name = quoted(&name.unwrap_or_else(|| format!("slot{slot}")));
            materials.push(format!(
                r#"{{"name":{name},"pbrMetallicRoughness":{{"metallicFactor":0,"roughnessFactor":1}},"doubleSided":true}}"#
            ));
        }
        Ok(Self { buffer, primitives, materials })
    }
}

/// The vertices that triangles use, in order.
struct Used {
    vertices: Vec<usize>,
    /// For each vertex its number among those used.
    numbers: Vec<u32>,
}

impl Used {
    fn new(split: &Split) -> Self {
        let mut is_used = vec![false; split.len()];
        split.corners.iter().for_each(|&vertex| is_used[vertex as usize] = true);
        let mut vertices = Vec::with_capacity(split.len());
        let numbers = is_used.iter().enumerate().map(|(vertex, is_used)| {
            if *is_used {
                vertices.push(vertex);
            }
            (vertices.len() as u32).saturating_sub(1)
        });
        let numbers = numbers.collect();
        Self { vertices, numbers }
    }
}

fn bytes<const N: usize>(values: impl Iterator<Item = [f32; N]>) -> impl Iterator<Item = u8> {
    values.flatten().flat_map(f32::to_le_bytes)
}

/// Writes all attributes and returns the text of their names and accessors.
fn write_attributes(
    buffer: &mut Buffer,
    mesh: &PolygonMesh,
    tangents: Option<&[Vec4]>,
    split: &Split,
    used: &[usize],
) -> String {
    let count = used.len();
    let mut text = Vec::new();
    let mut add = |name: String, accessor: usize| text.push(format!("\"{name}\":{accessor}"));
    let position = |vertex: &usize| mesh.positions[split.positions[*vertex] as usize];
    let (mut least, mut most) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for vertex in used {
        (least, most) = (least.min(position(vertex)), most.max(position(vertex)));
    }
    let list = |v: Vec3| format!("[{:e},{:e},{:e}]", v.x, v.y, v.z);
    let range = Some(format!(r#""min":{},"max":{}"#, list(least), list(most)));
    let (target, f32) = (Target::Vertices, Component::F32);
    let positions = bytes(used.iter().map(|vertex| position(vertex).to_array()));
    add("POSITION".into(), buffer.add(positions, target, f32, "VEC3", count, range));
    if !mesh.normals.is_empty() {
        let normal = |vertex: &usize| unit(split.value(&mesh.normals, *vertex, Vec3::Z), Vec3::Z);
        let normals = bytes(used.iter().map(|vertex| normal(vertex).to_array()));
        add("NORMAL".into(), buffer.add(normals, target, f32, "VEC3", count, None));
    }
    if let Some(tangents) = tangents {
        let tangent = |vertex: &usize| {
            let tangent = tangents[split.positions[*vertex] as usize];
            let sign = if tangent.w < 0.0 { -1.0 } else { 1.0 };
            unit(tangent.truncate(), Vec3::X).extend(sign)
        };
        let tangents = bytes(used.iter().map(|vertex| tangent(vertex).to_array()));
        add("TANGENT".into(), buffer.add(tangents, target, f32, "VEC4", count, None));
    }
    // Sets are numbered without gaps.
    for (set, uvs) in mesh.uv_sets.iter().filter(|uvs| !uvs.is_empty()).enumerate() {
        // glTF's v runs down from the upper edge, ours up from the lower one.
        let flipped = |uv: Vec2| [uv.x, 1.0 - uv.y];
        let uvs = bytes(used.iter().map(|vertex| flipped(split.value(uvs, *vertex, Vec2::ZERO))));
        add(format!("TEXCOORD_{set}"), buffer.add(uvs, target, f32, "VEC2", count, None));
    }
    if !mesh.colors.is_empty() {
        let colors =
            bytes(used.iter().map(|vertex| split.value(&mesh.colors, *vertex, Vec4::ONE).to_array()));
        add("COLOR_0".into(), buffer.add(colors, target, f32, "VEC4", count, None));
    }
    text.join(",")
}

/// Small meshes have small indices; the largest number of a type is not allowed as an index.
fn write_indices(buffer: &mut Buffer, indices: &[u32], vertices: usize) -> usize {
    let target = Target::Indices;
    if vertices <= usize::from(u16::MAX) {
        let data = indices.iter().flat_map(|index| (*index as u16).to_le_bytes());
        buffer.add(data, target, Component::U16, "SCALAR", indices.len(), None)
    } else {
        let data = indices.iter().flat_map(|index| index.to_le_bytes());
        buffer.add(data, target, Component::U32, "SCALAR", indices.len(), None)
    }
}

/// The vector with length one; as it is if it has that but for rounding.
fn unit(vector: Vec3, fallback: Vec3) -> Vec3 {
    if (vector.length_squared() - 1.0).abs() <= 8.0 * f32::EPSILON {
        return vector;
    }
    vector.try_normalize().unwrap_or(fallback)
}
