//! All formats by one pair of functions, for polygon meshes.

use super::error::{DecodeError, EncodeError, ErrorKind, Place, Warning};
use super::three_mf::LengthUnit;
use super::{Format, gltf, obj, off, ply, stl, three_mf};
use crate::polygon_mesh::{CornerAttribute, Triangulation};
use crate::{Attribute, PolygonMesh, TriangleMesh};

/// A polygon mesh from a file, and what the file says besides.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DecodedPolygons {
    /// The mesh.
    pub mesh: PolygonMesh,
    /// The name of each material slot; empty if the format has none.
    pub materials: Vec<String>,
    /// The names of the material files of an OBJ file.
    pub libraries: Vec<String>,
    /// What was left out or put right.
    pub warnings: Vec<Warning>,
}

/// Whether a format that has both is written as binary data or as text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Form {
    /// Small and fast.
    #[default]
    Binary,
    /// For people.
    Text,
}

/// What a file says besides the mesh. Formats that have no place for something leave it out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EncodeOptions {
    /// For PLY and STL.
    pub form: Form,
    /// The name of each material slot; slots beyond are called `slot` and their number.
    pub materials: Vec<String>,
    /// The name of the material file of an OBJ file; none means no `mtllib` line.
    pub library: Option<String>,
    /// What the numbers of a 3MF file are.
    pub unit: LengthUnit,
}

/// Reads a mesh as the file has it: OBJ, PLY and OFF have faces of any size.
///
/// # Errors
/// If the bytes are not what the format wants, or the format is one that is only written ([`Format::can_be_read`]).
pub fn decode_polygons(bytes: &[u8], format: Format) -> Result<DecodedPolygons, DecodeError> {
    Ok(match format {
        Format::Obj => {
            let obj::ObjFile { mesh, materials, libraries, warnings, .. } = obj::decode(bytes)?;
            DecodedPolygons { mesh, materials, libraries, warnings }
        }
        Format::Ply => {
            let ply::PlyFile { mesh, warnings } = ply::decode(bytes)?;
            DecodedPolygons { mesh, warnings, ..Default::default() }
        }
        Format::Stl => {
            let stl::StlFile { mesh, warnings, .. } = stl::decode(bytes)?;
            DecodedPolygons { mesh: into_polygons(mesh), warnings, ..Default::default() }
        }
        Format::Off => {
            let off::OffFile { mesh, warnings } = off::decode(bytes)?;
            DecodedPolygons { mesh, warnings, ..Default::default() }
        }
        Format::ThreeMf => {
            let three_mf::ThreeMfFile { mesh, materials, warnings } = three_mf::decode(bytes)?;
            DecodedPolygons { mesh, materials, warnings, ..Default::default() }
        }
        Format::Glb | Format::Gltf => {
            let place = Place::Byte { offset: 0 };
            let expected = "a mesh as OBJ, PLY, STL, OFF or 3MF: glTF files are read as scenes";
            return Err(DecodeError::new(ErrorKind::Unsupported, place, "a glTF scene", expected));
        }
    })
}

/// Writes a mesh. OBJ keeps everything, see [`obj::encode_polygons`]; PLY and OFF keep faces of any size; STL, 3MF and glTF
/// have triangles. What each format loses is told by its own function.
///
/// # Errors
/// If the mesh is broken (an index leads nowhere, lists differ in length) or too large for the format.
pub fn encode_polygons(
    mesh: &PolygonMesh,
    format: Format,
    options: &EncodeOptions,
) -> Result<Vec<u8>, EncodeError> {
    let materials = || options.materials.clone();
    match format {
        Format::Obj => obj::encode_polygons(
            mesh,
            &obj::EncodeOptions { library: options.library.clone(), materials: materials() },
        ),
        Format::Ply => ply::encode_polygons(
            mesh,
            match options.form {
                Form::Binary => ply::Encoding::LittleEndian,
                Form::Text => ply::Encoding::Ascii,
            },
        ),
        Format::Off => off::encode_polygons(mesh),
        Format::Stl | Format::ThreeMf | Format::Glb | Format::Gltf => {
            super::soundness::check(mesh)?;
            let triangles = mesh.triangulate();
            match format {
                Format::Stl => match options.form {
                    Form::Binary => Ok(stl::encode_binary(&triangles)),
                    Form::Text => Ok(stl::encode_ascii(&triangles).into_bytes()),
                },
                Format::ThreeMf => three_mf::encode(
                    &triangles,
                    &three_mf::EncodeOptions { materials: materials(), unit: options.unit },
                ),
                Format::Gltf => {
                    let options = gltf::EncodeOptions { materials: materials() };
                    Ok(gltf::encode_text(&triangles, &options)?.into_bytes())
                }
                _ => gltf::encode_binary(&triangles, &gltf::EncodeOptions { materials: materials() }),
            }
        }
    }
}

/// Every triangle a face, without copies.
fn into_polygons(mesh: TriangleMesh) -> PolygonMesh {
    let attribute = |indices: Vec<[u32; 3]>| indices.into_flattened();
    PolygonMesh {
        face_ends: (1..=mesh.triangles.len() as u32).map(|t| t.saturating_mul(3)).collect(),
        positions: mesh.positions,
        corners: mesh.triangles.into_flattened(),
        normals: CornerAttribute { values: mesh.normals.values, corners: attribute(mesh.normals.triangles) },
        slots: mesh.slots,
        ..PolygonMesh::default()
    }
}

/// The triangles of a mesh, without copies if all its faces are triangles that may stay as they are.
pub(super) fn triangulation(mesh: PolygonMesh) -> Triangulation {
    fn attribute<T: Copy>(values: CornerAttribute<T>) -> Attribute<T> {
        let triangles = values.corners.as_chunks::<3>().0.to_vec();
        Attribute { values: values.values, triangles }
    }
    let count = mesh.face_count();
    let are_triangles = mesh.holes.is_empty()
        && mesh.corners.len() == 3 * count
        && mesh.face_ends.iter().enumerate().all(|(face, end)| *end as usize == 3 * face + 3);
    let are_whole = || {
        let known = mesh.positions.len();
        mesh.corners
            .as_chunks::<3>()
            .0
            .iter()
            .all(|&[a, b, c]| a != b && b != c && c != a && (a.max(b).max(c) as usize) < known)
    };
    // Readers leave no value and no position that is not finite, and no index that leads nowhere.
    if !are_triangles || !are_whole() {
        return mesh.triangulation();
    }
    Triangulation {
        faces: (0..count as u32).collect(),
        mesh: TriangleMesh {
            positions: mesh.positions,
            triangles: mesh.corners.as_chunks::<3>().0.to_vec(),
            normals: attribute(mesh.normals),
            uv_sets: mesh.uv_sets.into_iter().map(attribute).collect(),
            tangents: Attribute::default(),
            colors: attribute(mesh.colors),
            slots: mesh.slots,
        },
        dropped_faces: 0,
        fanned_faces: 0,
    }
}
