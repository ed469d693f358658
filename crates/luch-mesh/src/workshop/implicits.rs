//! Surfaces of formulas, of solids combined, of grids.

mod formula;
mod remesh;
mod voxels;

pub use formula::FormulaSurface;

use super::{Arguments, Kind, Parameter, Verb, WorkshopError};
use crate::PolygonMesh;
use crate::implicit::{Field, ImplicitError, Method, Region, Sampling, surface};
use crate::normals;

/// The verbs of this group.
pub(super) const VERBS: &[Verb] = &[
    formula::IMPLICIT,
    formula::GYROID,
    formula::METABALLS,
    voxels::VOXELS,
    remesh::VOXEL_REMESH,
    remesh::OFFSET,
    remesh::SHELL,
    remesh::BLEND,
];

/// The surface of a step of `implicit`.
pub(super) fn formula_surface(verb: &Verb, arguments: &Arguments) -> Result<FormulaSurface, WorkshopError> {
    match verb.name {
        "implicit" => formula::formula_surface(arguments),
        other => Err(WorkshopError::new(format!("`{other}` has no formula"))),
    }
}

/// Normals of dual contouring are smooth over edges bent by less than this, in radians.
const CREASE: f32 = 0.6;

const METHOD: Parameter = Parameter::new(
    "method",
    Kind::Choice(&["marching-cubes", "dual-contouring"]),
    "marching-cubes",
    "marching-cubes for smooth bodies, dual-contouring for sharp edges",
);
const SHARP_METHOD: Parameter = Parameter::new(
    "method",
    Kind::Choice(&["dual-contouring", "marching-cubes"]),
    "dual-contouring",
    "dual-contouring for sharp edges, marching-cubes for smooth bodies",
);
const RESOLUTION: Parameter = Parameter::new(
    "resolution",
    Kind::Count { least: 1, most: 4096 },
    "64",
    "cells along the longest side of the box",
);

/// The surface of a field as a mesh with normals; an empty one is refused.
fn mesh_of(
    field: &dyn Field,
    region: Region,
    closed: bool,
    arguments: &Arguments,
) -> Result<PolygonMesh, WorkshopError> {
    let method = match arguments.choice("method") {
        "dual-contouring" => Method::DualContouring,
        _ => Method::MarchingCubes,
    };
    let sampling = Sampling { region, resolution: arguments.count("resolution"), closed };
    let mut mesh = surface(field, &sampling, method).map_err(told)?;
    if mesh.triangles.is_empty() {
        return Err(WorkshopError::new(
            "there is no surface in the box: it is missed by the samples, or the box is all inside or all outside",
        ));
    }
    if method == Method::DualContouring {
        mesh.normals = normals::creased(&mesh, CREASE, normals::Weight::Angle);
    }
    Ok(PolygonMesh::from(&mesh))
}

fn told(error: ImplicitError) -> WorkshopError {
    WorkshopError::new(error.to_string())
}
