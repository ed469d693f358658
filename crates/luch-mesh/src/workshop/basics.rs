//! What is done to any mesh: placing, normals, winding.

use super::{Action, Arguments, Keeps, Kind, Parameter, Verb, WorkshopError};
use crate::PolygonMesh;

/// The verbs of this group.
pub(super) const VERBS: &[Verb] = &[
    Verb {
        name: "flip",
        summary: "Turn all faces round, so that inside and outside change places",
        parameters: &[],
        example: "",
        action: Action::Change { keeps: Keeps::ALL, run: flip },
    },
    Verb {
        name: "translate",
        summary: "Move by a vector",
        parameters: &[Parameter::required("by", Kind::Vector, "how far along x, y and z, in metres")],
        example: "--by 1,2,3",
        action: Action::Change { keeps: Keeps::ALL, run: translate },
    },
];

fn flip(mut mesh: PolygonMesh, _: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    mesh.flip();
    Ok(mesh)
}

fn translate(mut mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let by = arguments.vector("by").as_vec3();
    for position in &mut mesh.positions {
        *position += by;
    }
    Ok(mesh)
}
