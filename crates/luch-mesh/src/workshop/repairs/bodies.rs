//! Bodies out of bodies.

use crate::PolygonMesh;
use crate::boolean::{BooleanError, Operand, Operation, boolean, convex_hull};
use crate::workshop::{Action, Arguments, Keeps, Kind, Parameter, Verb, WorkshopError};

const WITH: &[Parameter] = &[Parameter::required("with", Kind::Mesh, "the other body")];

/// The result has the uv sets of both bodies, which may be more than before; pieces that touch may share an edge.
const KEEPS: Keeps = Keeps::NOTHING;

pub(super) const UNION: Verb = Verb {
    name: "union",
    summary: "Join with another body",
    parameters: WITH,
    example: "--with other.ply",
    action: Action::Change {
        keeps: KEEPS,
        run: |mesh, arguments| combine(&mesh, arguments, Operation::Union),
    },
};

pub(super) const INTERSECTION: Verb = Verb {
    name: "intersection",
    summary: "Keep what is in another body too",
    parameters: WITH,
    example: "--with other.ply",
    action: Action::Change {
        keeps: KEEPS,
        run: |mesh, arguments| combine(&mesh, arguments, Operation::Intersection),
    },
};

pub(super) const DIFFERENCE: Verb = Verb {
    name: "difference",
    summary: "Cut another body out",
    parameters: WITH,
    example: "--with other.ply",
    action: Action::Change {
        keeps: KEEPS,
        run: |mesh, arguments| combine(&mesh, arguments, Operation::Difference),
    },
};

pub(super) const HULL: Verb = Verb {
    name: "hull",
    summary: "The smallest convex body around all positions",
    parameters: &[],
    example: "",
    action: Action::Change { keeps: Keeps { closed: true, ..Keeps::NOTHING }, run: hull },
};

fn combine(
    mesh: &PolygonMesh,
    arguments: &Arguments,
    operation: Operation,
) -> Result<PolygonMesh, WorkshopError> {
    let Some(other) = arguments.mesh("with") else {
        return Err(WorkshopError::of("with", "must be a mesh"));
    };
    let combined = boolean(&mesh.triangulate(), &other.triangulate(), operation);
    let combined = combined.map_err(|error| match error {
        BooleanError::NotClosed { operand: Operand::Second, .. }
        | BooleanError::Invalid { operand: Operand::Second, .. } => {
            WorkshopError::of("with", error.to_string())
        }
        _ => WorkshopError::new(error.to_string()),
    })?;
    Ok(PolygonMesh::from(&combined))
}

fn hull(mesh: PolygonMesh, _: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let hull = convex_hull(&mesh.positions).map_err(|error| WorkshopError::new(error.to_string()))?;
    Ok(PolygonMesh::from(&hull))
}
