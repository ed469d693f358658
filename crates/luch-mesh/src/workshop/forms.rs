//! Ready-made bodies, outlines that become bodies, text.

use super::{Action, Arguments, Kind, Parameter, Verb, WorkshopError};
use crate::{PolygonMesh, generate};

/// The verbs of this group.
pub(super) const VERBS: &[Verb] = &[Verb {
    name: "cuboid",
    summary: "A box with hard edges",
    parameters: &[Parameter::new(
        "size",
        Kind::Size,
        "1",
        "lengths of the sides along x, y and z, in metres",
    )],
    example: "--size 1,2,3",
    action: Action::Make { closed: true, run: cuboid },
}];

fn cuboid(arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    Ok(PolygonMesh::from(&generate::cuboid(arguments.vector("size").as_vec3(), [1; 3])))
}
