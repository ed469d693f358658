//! Texture coordinates.

use super::{SELECT, faces, refused};
use crate::PolygonMesh;
use crate::edit::{self, Projection};
use crate::workshop::{Action, Arguments, Keeps, Kind, Parameter, Verb, WorkshopError};

pub(super) const UNWRAP: Verb = Verb {
    name: "unwrap",
    summary: "Texture coordinates by projection, without smears across the seam",
    parameters: &[
        Parameter::new(
            "method",
            Kind::Choice(&["box", "planar", "cylinder", "sphere"]),
            "box",
            "onto the sides of a box, a plane, a cylinder or a sphere",
        ),
        Parameter::new("axis", Kind::Vector, "y", "across the plane, or along cylinder and sphere"),
        SELECT,
    ],
    example: "--method cylinder",
    action: Action::Change { keeps: Keeps { uvs: false, ..Keeps::ALL }, run: unwrap },
};

fn unwrap(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let projection = match arguments.choice("method") {
        "planar" => Projection::Planar,
        "cylinder" => Projection::Cylinder,
        "sphere" => Projection::Sphere,
        _ => Projection::Box,
    };
    edit::unwrap(&mesh, &faces(&mesh, arguments)?, projection, arguments.vector("axis")).map_err(refused)
}
