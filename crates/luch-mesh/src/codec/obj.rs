//! Wavefront OBJ (Alias|Wavefront, "Advanced Visualizer Manual", appendix B1), its polygons.
//!
//! Read: `v` (with weight or colour), `vt`, `vn`, `f`, `o`, `g`, `s`, `usemtl`, `mtllib`. Points, lines and free-form
//! curves and surfaces are skipped with a warning. Materials are in files of their own: see [`super::mtl`].

mod finish;
mod read;
mod write;

use std::ops::Range;

use super::error::Warning;
use crate::PolygonMesh;
pub use read::decode;
pub use write::{EncodeOptions, encode};

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
