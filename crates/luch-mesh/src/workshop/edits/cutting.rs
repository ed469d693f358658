//! Planes through meshes.

use glam::DVec3;

use super::{SELECT, UVS, faces, refused};
use crate::PolygonMesh;
use crate::edit::{self, Cut, Plane, Side, Symmetry};
use crate::workshop::{Action, Arguments, Kind, Parameter, Verb, WorkshopError};

const CAP_SLOT: Parameter = Parameter::optional(
    "cap-slot",
    Kind::Count { least: 0, most: 65535 },
    "the material slot of the caps; that of the faces around if it is not given",
);

fn plane(arguments: &Arguments) -> Result<Plane, WorkshopError> {
    Plane::through(arguments.vector("point"), arguments.vector("normal"))
        .ok_or_else(|| WorkshopError::of("normal", "must have a direction"))
}

fn cap_slot(arguments: &Arguments) -> Option<u16> {
    arguments.count_if_given("cap-slot").map(|slot| slot as u16)
}

pub(super) const CUT: Verb = Verb {
    name: "cut",
    summary: "Cut by a plane; keep both parts or one, closed by caps or open",
    parameters: &[
        Parameter::new("normal", Kind::Vector, "0,1,0", "the direction across the plane, to its upper side"),
        Parameter::new("point", Kind::Vector, "0,0,0", "a point of the plane, in metres"),
        Parameter::new("keep", Kind::Choice(&["both", "above", "below"]), "both", "what stays"),
        Parameter::new(
            "cap",
            Kind::Flag,
            "false",
            "close what the plane opens; both parts are then bodies of their own",
        ),
        CAP_SLOT,
        SELECT,
    ],
    example: "--normal 1,2,3 --point 0.01,0.02,0.03 --keep above --cap",
    action: Action::Change { keeps: UVS, run: cut },
};

fn cut(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let keep = match arguments.choice("keep") {
        "above" => Side::Above,
        "below" => Side::Below,
        _ => Side::Both,
    };
    let cut =
        Cut { plane: plane(arguments)?, keep, cap: arguments.flag("cap"), cap_slot: cap_slot(arguments) };
    edit::cut(&mesh, &faces(&mesh, arguments)?, &cut).map_err(refused)
}

pub(super) const SLICE: Verb = Verb {
    name: "slice",
    summary: "Cut into layers of equal height, each closed by caps",
    parameters: &[
        Parameter::new("layers", Kind::Count { least: 1, most: 1024 }, "4", "how many"),
        Parameter::new("axis", Kind::Vector, "y", "the direction across the layers"),
        CAP_SLOT,
    ],
    example: "--layers 3 --axis 0.1,1,0.2",
    action: Action::Change { keeps: UVS, run: slice },
};

fn slice(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    edit::slice(&mesh, arguments.vector("axis"), arguments.count("layers"), cap_slot(arguments))
        .map_err(refused)
}

pub(super) const SYMMETRIZE: Verb = Verb {
    name: "symmetrize",
    summary: "Keep what lies above a plane and add its mirror image, joined at the plane",
    parameters: &[
        Parameter::new("normal", Kind::Vector, "1,0,0", "the direction across the mirror, to what is kept"),
        Parameter::new("point", Kind::Vector, "0,0,0", "a point of the mirror, in metres"),
        Parameter::new(
            "tolerance",
            Kind::NOT_NEGATIVE,
            "0",
            "how near to the mirror vertices are joined, in metres",
        ),
    ],
    example: "--normal 1,0.3,0.2 --point 0.01,0.02,0.03",
    action: Action::Change { keeps: UVS, run: symmetrize },
};

fn symmetrize(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let symmetry = Symmetry { plane: plane(arguments)?, tolerance: arguments.number("tolerance") };
    edit::symmetrize(&mesh, &symmetry).map_err(refused)
}

/// The middle of everything, for verbs whose centre is not given.
pub(super) fn center_or_middle(mesh: &PolygonMesh, vertices: &[bool], arguments: &Arguments) -> DVec3 {
    arguments.vector_if_given("center").unwrap_or_else(|| {
        let [low, high] = edit::vertex_bounds(mesh, vertices);
        low.midpoint(high)
    })
}
