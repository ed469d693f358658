//! The writers.

use super::Encoding;
use crate::codec::error::EncodeError;
use crate::codec::soundness;
use crate::codec::text::{put_f32, put_integer, write_rows};
use crate::codec::vertices::Split;
use crate::{PolygonMesh, TriangleMesh};

/// Writes a mesh; see [`encode_polygons`]. A mesh with problems ([`TriangleMesh::validate`]) gives no bytes.
pub fn encode(mesh: &TriangleMesh, encoding: Encoding) -> Vec<u8> {
    encode_polygons(&PolygonMesh::from(mesh), encoding).unwrap_or_default()
}

/// Writes a polygon mesh.
///
/// PLY has one normal, uv and colour per vertex: where the mesh has more (hard edges, seams) its positions are split.
/// Faces with holes are cut into triangles. Lost: uv sets but the first, smoothing groups, creases. Everything else reads
/// back bit for bit.
///
/// # Errors
/// If the mesh is broken: an index leads nowhere, lists differ in length.
pub fn encode_polygons(mesh: &PolygonMesh, encoding: Encoding) -> Result<Vec<u8>, EncodeError> {
    soundness::check(mesh)?;
    let without_holes;
    let mesh = if mesh.holes.is_empty() {
        mesh
    } else {
        without_holes = PolygonMesh::from(&mesh.triangulate());
        &without_holes
    };
    let split = Split::new(mesh, 1);
    let longest = (0..mesh.face_count()).map(|face| mesh.face(face).len()).max().unwrap_or(0);
    let layout = Layout {
        mesh,
        split,
        encoding,
        has_normals: !mesh.normals.is_empty(),
        has_uvs: mesh.uv_sets.first().is_some_and(|uvs| !uvs.is_empty()),
        has_colors: !mesh.colors.is_empty(),
        has_long_faces: longest > usize::from(u8::MAX),
    };
    let mut bytes = layout.header().into_bytes();
    match encoding {
        Encoding::Ascii => {
            write_rows(&mut bytes, layout.split.len(), |vertex, text| {
                end_row(text, |text| {
                    layout.vertex(vertex, |number| {
                        put_f32(text, number);
                        text.push(b' ');
                    });
                });
            });
            write_rows(&mut bytes, mesh.face_count(), |face, text| {
                end_row(text, |text| {
                    layout.face(face, |number, _| {
                        put_integer(text, number.into());
                        text.push(b' ');
                    });
                });
            });
        }
        Encoding::LittleEndian | Encoding::BigEndian => {
            let is_little = encoding == Encoding::LittleEndian;
            let put = |bytes: &mut Vec<u8>, number: u32, size: usize| {
                if is_little {
                    bytes.extend_from_slice(&number.to_le_bytes()[..size]);
                } else {
                    bytes.extend_from_slice(&number.to_be_bytes()[4 - size..]);
                }
            };
            write_rows(&mut bytes, layout.split.len(), |vertex, bytes| {
                layout.vertex(vertex, |number| put(bytes, number.to_bits(), 4));
            });
            write_rows(&mut bytes, mesh.face_count(), |face, bytes| {
                layout.face(face, |number, size| put(bytes, number, size));
            });
        }
    }
    Ok(bytes)
}

/// Writes numbers with a space after each, then puts a line end in place of the last space.
fn end_row(text: &mut Vec<u8>, write: impl FnOnce(&mut Vec<u8>)) {
    let before = text.len();
    write(text);
    if text.len() > before {
        text.pop();
    }
    text.push(b'\n');
}

struct Layout<'a> {
    mesh: &'a PolygonMesh,
    split: Split,
    encoding: Encoding,
    has_normals: bool,
    has_uvs: bool,
    has_colors: bool,
    has_long_faces: bool,
}

impl Layout<'_> {
    fn header(&self) -> String {
        let mut header =
            format!("ply\nformat {} 1.0\nelement vertex {}\n", self.encoding.name(), self.split.len());
        let mut names = vec!["x", "y", "z"];
        names.extend(if self.has_normals { &["nx", "ny", "nz"][..] } else { &[] });
        names.extend(if self.has_uvs { &["s", "t"][..] } else { &[] });
        names.extend(if self.has_colors { &["red", "green", "blue", "alpha"][..] } else { &[] });
        header.extend(names.iter().map(|name| format!("property float {name}\n")));
        let length = if self.has_long_faces { "uint" } else { "uchar" };
        let faces = self.mesh.face_count();
        header.push_str(&format!("element face {faces}\nproperty list {length} uint vertex_indices\n"));
        if !self.mesh.slots.is_empty() {
            header.push_str("property ushort material_index\n");
        }
        header.push_str("end_header\n");
        header
    }

    fn vertex(&self, vertex: usize, mut put: impl FnMut(f32)) {
        let (mesh, split) = (self.mesh, &self.split);
        mesh.positions[split.positions[vertex] as usize].to_array().into_iter().for_each(&mut put);
        if self.has_normals {
            split.value(&mesh.normals, vertex, glam::Vec3::Z).to_array().into_iter().for_each(&mut put);
        }
        if self.has_uvs {
            split.value(&mesh.uv_sets[0], vertex, glam::Vec2::ZERO).to_array().into_iter().for_each(&mut put);
        }
        if self.has_colors {
            split.value(&mesh.colors, vertex, glam::Vec4::ONE).to_array().into_iter().for_each(&mut put);
        }
    }

    /// The numbers of a face and the bytes that each takes.
    fn face(&self, face: usize, mut put: impl FnMut(u32, usize)) {
        let corners = self.mesh.face(face);
        put(corners.len() as u32, if self.has_long_faces { 4 } else { 1 });
        self.split.corners[corners].iter().for_each(|&vertex| put(vertex, 4));
        if let Some(&slot) = self.mesh.slots.get(face) {
            put(slot.into(), 2);
        }
    }
}
