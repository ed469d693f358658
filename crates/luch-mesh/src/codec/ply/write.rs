//! The writers.

use std::io::Write;

use super::Encoding;
use crate::{TriangleMesh, unify};

/// Writes a mesh.
///
/// PLY has one normal, uv and colour per vertex: where the mesh has more (hard edges, seams) its positions are split,
/// see [`unify::split_positions`]. Lost: tangents, uv sets but the first. Everything else reads back bit for bit.
pub fn encode(mesh: &TriangleMesh, encoding: Encoding) -> Vec<u8> {
    let mut first_uvs_only = mesh.clone();
    first_uvs_only.uv_sets.truncate(1);
    first_uvs_only.tangents = Default::default();
    let mesh = unify::split_positions(&first_uvs_only);
    let has_normals = !mesh.normals.is_empty();
    let has_uvs = mesh.uv_sets.first().is_some_and(|uvs| !uvs.is_empty());
    let has_colors = !mesh.colors.is_empty();

    let mut header =
        format!("ply\nformat {} 1.0\nelement vertex {}\n", encoding.name(), mesh.positions.len());
    let mut names = vec!["x", "y", "z"];
    names.extend(if has_normals { &["nx", "ny", "nz"][..] } else { &[] });
    names.extend(if has_uvs { &["u", "v"][..] } else { &[] });
    names.extend(if has_colors { &["red", "green", "blue", "alpha"][..] } else { &[] });
    header.extend(names.iter().map(|name| format!("property float {name}\n")));
    header.push_str(&format!(
        "element face {}\nproperty list uchar uint vertex_indices\n",
        mesh.triangles.len()
    ));
    if !mesh.slots.is_empty() {
        header.push_str("property ushort material_index\n");
    }
    header.push_str("end_header\n");

    let mut sink = Sink { bytes: header.into_bytes(), encoding };
    for i in 0..mesh.positions.len() {
        sink.floats(&mesh.positions[i].to_array());
        if has_normals {
            sink.floats(&mesh.normals.values[i].to_array());
        }
        if has_uvs {
            sink.floats(&mesh.uv_sets[0].values[i].to_array());
        }
        if has_colors {
            sink.floats(&mesh.colors.values[i].to_array());
        }
        sink.end_row();
    }
    for (t, corners) in mesh.triangles.iter().enumerate() {
        sink.put("3", [3]);
        for &corner in corners {
            sink.put(corner, corner.to_le_bytes());
        }
        if !mesh.slots.is_empty() {
            let slot = mesh.slot(t);
            sink.put(slot, slot.to_le_bytes());
        }
        sink.end_row();
    }
    sink.bytes
}

struct Sink {
    bytes: Vec<u8>,
    encoding: Encoding,
}

impl Sink {
    /// A number as text, or as bytes given lowest first.
    fn put<const N: usize>(&mut self, text: impl std::fmt::Display, mut bytes: [u8; N]) {
        match self.encoding {
            Encoding::Ascii => {
                // Writing to a vector cannot fail.
                let _ = write!(self.bytes, "{text} ");
            }
            Encoding::LittleEndian => self.bytes.extend(bytes),
            Encoding::BigEndian => {
                bytes.reverse();
                self.bytes.extend(bytes);
            }
        }
    }

    fn floats(&mut self, numbers: &[f32]) {
        for number in numbers {
            self.put(number, number.to_le_bytes());
        }
    }

    fn end_row(&mut self) {
        if self.encoding == Encoding::Ascii {
            self.bytes.pop();
            self.bytes.push(b'\n');
        }
    }
}
