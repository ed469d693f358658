//! Topology and deformations: what changes a mesh by hand.

mod cutting;
mod deforming;
mod mapping;
mod multiplying;
mod raising;
mod refining;
mod taking;

use super::{Arguments, Keeps, Kind, Parameter, Verb, WorkshopError};
use crate::PolygonMesh;
use crate::edit::{EditError, Selection};

/// The verbs of this group.
pub(super) const VERBS: &[Verb] = &[
    raising::EXTRUDE,
    raising::EXTRUDE_EDGES,
    raising::INSET,
    raising::BEVEL,
    raising::SOLIDIFY,
    raising::BRIDGE,
    raising::INFLATE,
    cutting::CUT,
    cutting::SLICE,
    cutting::SYMMETRIZE,
    refining::SPLIT,
    refining::POKE,
    refining::QUADS,
    refining::TRIANGULATE,
    refining::QUADRANGULATE,
    refining::DISSOLVE,
    refining::COLLAPSE,
    taking::DELETE,
    taking::KEEP,
    taking::DETACH,
    taking::DUPLICATE,
    taking::RIP,
    taking::COMPONENT,
    multiplying::APPEND,
    multiplying::ARRAY,
    multiplying::RADIAL_ARRAY,
    deforming::TWIST,
    deforming::BEND,
    deforming::TAPER,
    deforming::SHEAR,
    deforming::STRETCH,
    deforming::SPHERIFY,
    deforming::WAVE,
    deforming::LATTICE,
    deforming::DISPLACE,
    mapping::UNWRAP,
];

/// What stays under changes of topology that leave no hole.
const SOUND: Keeps = Keeps { closed: true, uvs: true, creases: false, faces: false, positions: false };
/// The same, with creases.
const SOUND_WITH_CREASES: Keeps = Keeps { creases: true, ..SOUND };
/// Only attributes stay.
const UVS: Keeps = Keeps { uvs: true, ..Keeps::NOTHING };

const SELECT: Parameter = Parameter::new(
    "select",
    Kind::Text,
    "all",
    "what it is done to, such as `normal(0,1,0, 30deg) and not faces(0-5)`",
);

/// The rule of a parameter.
pub(super) fn rule(arguments: &Arguments, name: &str) -> Result<Selection, WorkshopError> {
    let text = arguments.text(name).unwrap_or("all");
    Selection::parse(text).map_err(|error| WorkshopError::of(name, error.to_string()))
}

/// The faces that the rule `select` selects.
pub(super) fn faces(mesh: &PolygonMesh, arguments: &Arguments) -> Result<Vec<bool>, WorkshopError> {
    Ok(rule(arguments, "select")?.faces(mesh))
}

/// The vertices that the rule `select` selects.
pub(super) fn vertices(mesh: &PolygonMesh, arguments: &Arguments) -> Result<Vec<bool>, WorkshopError> {
    Ok(rule(arguments, "select")?.vertices(mesh))
}

fn edges(mesh: &PolygonMesh, arguments: &Arguments) -> Result<Vec<[u32; 2]>, WorkshopError> {
    Ok(rule(arguments, "select")?.edges(mesh))
}

fn refused(error: EditError) -> WorkshopError {
    WorkshopError::new(error.to_string())
}
