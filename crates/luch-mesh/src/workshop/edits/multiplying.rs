//! Meshes joined, and many from one.

use super::{SOUND_WITH_CREASES, refused};
use crate::PolygonMesh;
use crate::edit;
use crate::workshop::{Action, Arguments, Kind, Parameter, Verb, WorkshopError};

const COUNT: Parameter = Parameter::new(
    "count",
    Kind::Count { least: 1, most: u32::MAX as u64 },
    "3",
    "how many there are in the end",
);

pub(super) const APPEND: Verb = Verb {
    name: "append",
    summary: "Add all faces of another mesh",
    parameters: &[
        Parameter::required("mesh", Kind::Mesh, "the other mesh"),
        Parameter::new(
            "slots",
            Kind::Count { least: 0, most: 65535 },
            "0",
            "how far its material slots are shifted up",
        ),
    ],
    example: "--mesh other.ply",
    action: Action::Change { keeps: SOUND_WITH_CREASES, run: append },
};

fn append(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let other = arguments.mesh("mesh").ok_or_else(|| WorkshopError::of("mesh", "must be given"))?;
    edit::append(&mesh, other, arguments.count("slots") as u16).map_err(refused)
}

pub(super) const ARRAY: Verb = Verb {
    name: "array",
    summary: "Copies in a row; `weld` after it joins copies that touch",
    parameters: &[COUNT, Parameter::required("by", Kind::Vector, "from each to the next, in metres")],
    example: "--count 2 --by 3,0,0",
    action: Action::Change { keeps: SOUND_WITH_CREASES, run: array },
};

fn array(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    edit::array(&mesh, arguments.count("count"), arguments.vector("by")).map_err(refused)
}

pub(super) const RADIAL_ARRAY: Verb = Verb {
    name: "radial-array",
    summary: "Copies around an axis, spread evenly; `weld` after it joins copies that touch",
    parameters: &[
        COUNT,
        Parameter::new("angle", Kind::Angle, "360deg", "over which they are spread"),
        Parameter::new("axis", Kind::Vector, "y", "the direction of the axis"),
        Parameter::new("center", Kind::Vector, "0,0,0", "a point of the axis, in metres"),
    ],
    example: "--count 3 --center 5,0,0",
    action: Action::Change { keeps: SOUND_WITH_CREASES, run: radial_array },
};

fn radial_array(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let (axis, center) = (arguments.vector("axis"), arguments.vector("center"));
    edit::radial_array(&mesh, arguments.count("count"), axis, center, arguments.number("angle"))
        .map_err(refused)
}
