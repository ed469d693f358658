//! Wavefront OBJ (Alias|Wavefront, "Advanced Visualizer Manual", appendix B1), its polygons.
//!
//! Read: `v` (with weight or colour), `vt`, `vn`, `f`, `o`, `g`, `s`, `usemtl`, `mtllib`. Points, lines and free-form
//! curves and surfaces are skipped with a warning. Materials are in files of their own: see [`super::mtl`].
//!
//! Creases and sharp vertices are the tags of OpenSubdiv's shapes, with vertices from 0: `t crease 2/1/0 5 9 2.5` and
//! `t corner 1/1/0 7 inf`.
//!
//! What OBJ has no word for stands in comments, which other programs pass over; numbers of corners count from 1:
//!
//! | Line | Meaning |
//! |---|---|
//! | `#luch slot 2 brass` | material slot 2 has this name; without, slots are numbered as names appear |
//! | `#luch uv 1 0.5 0.25` | a value of uv set 1 |
//! | `#luch uvs 1 4 5 6` | the numbers of the last face's corners in uv set 1; without, values run parallel to `v` |
//! | `#luch color 1 0 0 1` | a colour, if they are not one for each `v` |
//! | `#luch colors 4 4 2` | the numbers of the last face's corners in that list |
//! | `#luch polygon 8 1 2 3 4 \| 5 6 7 8` | a face with holes; the next 8 `f` are its triangles, for other programs |
//! | `#luch plain` | smoothing groups are kept, but no normals are made of them |

mod extra;
mod finish;
mod read;
mod write;

use std::ops::Range;

use super::error::Warning;
use crate::PolygonMesh;
pub use read::decode;
pub use write::{EncodeOptions, encode, encode_polygons};

/// What an OBJ file holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ObjFile {
    /// All faces. Vertex colours are taken as linear light.
    ///
    /// If the file gives normals for some faces, or smoothing groups, all corners have normals: faces without are flat,
    /// or smooth within their group.
    pub mesh: PolygonMesh,
    /// The objects (`o`) that have faces, in order.
    pub objects: Vec<NamedFaces>,
    /// The groups (`g`) that have faces, in order. A face in several groups has all their names in one.
    pub groups: Vec<NamedFaces>,
    /// The material name of each slot; the empty name for faces before the first `usemtl`.
    pub materials: Vec<String>,
    /// Names of the material files, as they stand in the file.
    pub libraries: Vec<String>,
    /// What was left out or put right.
    pub warnings: Vec<Warning>,
}

/// A name and the faces it is for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedFaces {
    /// The name.
    pub name: String,
    /// The faces.
    pub faces: Range<u32>,
}
