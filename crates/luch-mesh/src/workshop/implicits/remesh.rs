//! Meshes made anew from their signed distance.

use super::{RESOLUTION, SHARP_METHOD, mesh_of};
use crate::implicit::{Composite, MeshDistance, Operation, Region};
use crate::workshop::{Action, Arguments, Keeps, Kind, Parameter, Verb, WorkshopError};
use crate::{PolygonMesh, TriangleMesh, measure};

/// Attributes go, but the result is a closed manifold whatever the mesh was.
const CLOSED: Keeps = Keeps { closed: true, ..Keeps::NOTHING };

/// A new mesh of the same body.
pub(super) const VOXEL_REMESH: Verb = Verb {
    name: "voxel-remesh",
    summary: "A new closed mesh with even faces, from the signed distance; joins what overlaps and fills holes",
    parameters: &[RESOLUTION, SHARP_METHOD],
    example: "--resolution 10",
    action: Action::Change { keeps: CLOSED, run: voxel_remesh },
};

/// A grown body.
pub(super) const OFFSET: Verb = Verb {
    name: "offset",
    summary: "Grow a body by a distance, round at its edges, or shrink it by a negative one; a new mesh from the signed distance",
    parameters: &[
        Parameter::required("distance", Kind::NUMBER, "how far the surface moves outward, in metres"),
        RESOLUTION,
        SHARP_METHOD,
    ],
    example: "0.1 --resolution 10",
    action: Action::Change { keeps: CLOSED, run: offset },
};

/// A hollow body.
pub(super) const SHELL: Verb = Verb {
    name: "shell",
    summary: "A wall along the surface, half of it on either side; a new mesh from the distance",
    parameters: &[
        Parameter::required("thickness", Kind::POSITIVE, "of the wall, in metres"),
        RESOLUTION,
        SHARP_METHOD,
    ],
    example: "0.2 --resolution 12",
    action: Action::Change { keeps: CLOSED, run: shell },
};

/// Two bodies with a rounded seam.
pub(super) const BLEND: Verb = Verb {
    name: "blend",
    summary: "Join a body with another, cut it out or keep what is in both, the seam rounded; a new mesh from the signed distances",
    parameters: &[
        Parameter::required("with", Kind::Mesh, "the other body"),
        Parameter::new(
            "operation",
            Kind::Choice(&["union", "difference", "intersection"]),
            "union",
            "what is done",
        ),
        Parameter::new("width", Kind::NOT_NEGATIVE, "0.1", "of the rounding, in metres; 0 for a sharp seam"),
        RESOLUTION,
        SHARP_METHOD,
    ],
    example: "other.obj --width 0.2 --resolution 12",
    action: Action::Change { keeps: CLOSED, run: blend },
};

/// The box of a mesh, larger by a length on every side, and by two cells.
fn region_about(mesh: &TriangleMesh, more: f64, arguments: &Arguments) -> Region {
    let bounds = measure::bounds(mesh);
    let region = Region { min: bounds.min.as_dvec3() - more, max: bounds.max.as_dvec3() + more };
    let longest = region.size().max_element();
    let margin = 2.0 * longest / f64::from(arguments.count("resolution"));
    Region { min: region.min - margin, max: region.max + margin }
}

fn voxel_remesh(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let mesh = mesh.triangulate();
    mesh_of(&MeshDistance::new(&mesh), region_about(&mesh, 0.0, arguments), true, arguments)
}

fn offset(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let mesh = mesh.triangulate();
    let distance = arguments.number("distance");
    let field = MeshDistance::new(&mesh);
    let grown = Composite::Offset { field: &field, distance };
    mesh_of(&grown, region_about(&mesh, distance.max(0.0), arguments), true, arguments)
}

fn shell(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let mesh = mesh.triangulate();
    let thickness = arguments.number("thickness");
    let field = MeshDistance::new(&mesh);
    let wall = Composite::Shell { field: &field, thickness };
    mesh_of(&wall, region_about(&mesh, thickness / 2.0, arguments), true, arguments)
}

fn blend(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let mesh = mesh.triangulate();
    let other = arguments.mesh("with").map(PolygonMesh::triangulate).unwrap_or_default();
    let width = arguments.number("width");
    let (one, two) = (region_about(&mesh, width, arguments), region_about(&other, width, arguments));
    let operation = match arguments.choice("operation") {
        "union" => Operation::Union,
        "difference" => Operation::Difference,
        _ => Operation::Intersection,
    };
    let region = match operation {
        Operation::Union => Region { min: one.min.min(two.min), max: one.max.max(two.max) },
        _ => one,
    };
    let (first, second) = (MeshDistance::new(&mesh), MeshDistance::new(&other));
    let fields: [&dyn crate::implicit::Field; 2] = [&first, &second];
    mesh_of(&Composite::Pair { fields, operation, width }, region, true, arguments)
}
