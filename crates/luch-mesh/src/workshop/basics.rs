//! What is done to any mesh: placing, normals, winding, materials.

use glam::{DAffine3, DMat3, DVec3};

use super::edits::{faces, rule, vertices};
use super::{Action, Arguments, Keeps, Kind, Parameter, Verb, WorkshopError};
use crate::PolygonMesh;
use crate::edit;

const SELECT: Parameter =
    Parameter::new("select", Kind::Text, "all", "what it is done to, such as `box(0,0,0, 1,1,1)`");
const CENTER: Parameter =
    Parameter::new("center", Kind::Vector, "0,0,0", "the point that stays where it is, in metres");

/// The verbs of this group.
pub(super) const VERBS: &[Verb] = &[
    Verb {
        name: "flip",
        summary: "Turn faces round, so that inside and outside change places",
        parameters: &[SELECT],
        example: "",
        action: Action::Change { keeps: Keeps { closed: false, ..Keeps::ALL }, run: flip },
    },
    Verb {
        name: "translate",
        summary: "Move by a vector",
        parameters: &[Parameter::required("by", Kind::Vector, "how far along x, y and z, in metres"), SELECT],
        example: "--by 1,2,3",
        action: Action::Change { keeps: Keeps::ALL, run: translate },
    },
    Verb {
        name: "rotate",
        summary: "Turn about an axis, counter-clockwise seen from its tip",
        parameters: &[
            Parameter::required("angle", Kind::Angle, "how far"),
            Parameter::new("axis", Kind::Vector, "y", "the direction of the axis"),
            CENTER,
            SELECT,
        ],
        example: "--angle 30deg --axis 1,1,0",
        action: Action::Change { keeps: Keeps::ALL, run: rotate },
    },
    Verb {
        name: "scale",
        summary: "Make larger or smaller, along x, y and z or all alike",
        parameters: &[
            Parameter::required("by", Kind::Size, "the factor, or three along x, y and z"),
            CENTER,
            SELECT,
        ],
        example: "--by 2,1,0.5",
        action: Action::Change { keeps: Keeps::ALL, run: scale },
    },
    Verb {
        name: "mirror",
        summary: "Reflect at a plane; what was outside stays outside",
        parameters: &[
            Parameter::new("normal", Kind::Vector, "x", "the direction across the plane"),
            Parameter::new("point", Kind::Vector, "0,0,0", "a point of the plane, in metres"),
        ],
        example: "--normal 1,1,0",
        action: Action::Change { keeps: Keeps::ALL, run: mirror },
    },
    Verb {
        name: "center",
        summary: "Move so that the middle of the bounds, or of their bottom, is at a point",
        parameters: &[
            Parameter::new("at", Kind::Vector, "0,0,0", "the point, in metres"),
            Parameter::new("mode", Kind::Choice(&["middle", "bottom"]), "middle", "what comes to the point"),
        ],
        example: "--mode bottom",
        action: Action::Change { keeps: Keeps::ALL, run: center },
    },
    Verb {
        name: "fit",
        summary: "Scale all alike so that the longest side of the bounds has a length",
        parameters: &[Parameter::new("size", Kind::POSITIVE, "1", "the length, in metres")],
        example: "--size 2",
        action: Action::Change { keeps: Keeps::ALL, run: fit },
    },
    Verb {
        name: "normals",
        summary: "Make normals anew: sharp at edges above an angle, all smooth, all flat, or none",
        parameters: &[
            Parameter::new("mode", Kind::Choice(&["crease", "smooth", "flat", "none"]), "crease", "how"),
            Parameter::new("angle", Kind::Angle, "30deg", "edges of a wider angle are sharp (mode crease)"),
        ],
        example: "--angle 40deg",
        action: Action::Change { keeps: Keeps::ALL, run: normals },
    },
    Verb {
        name: "material",
        summary: "Give faces a material slot",
        parameters: &[
            Parameter::required("slot", Kind::Count { least: 0, most: 65535 }, "the number of the slot"),
            SELECT,
        ],
        example: "--slot 1 --select 'normal(0,1,0, 30deg)'",
        action: Action::Change { keeps: Keeps::ALL, run: material },
    },
];

fn flip(mut mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    if rule(arguments, "select")? == edit::Selection::All {
        mesh.flip();
        return Ok(mesh);
    }
    Ok(edit::flip_faces(&mesh, &faces(&mesh, arguments)?))
}

fn place(mesh: &PolygonMesh, arguments: &Arguments, map: &DAffine3) -> Result<PolygonMesh, WorkshopError> {
    Ok(edit::transform(mesh, &vertices(mesh, arguments)?, map))
}

fn translate(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    place(&mesh, arguments, &DAffine3::from_translation(arguments.vector("by")))
}

fn rotate(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let axis = arguments.vector("axis").try_normalize();
    let axis = axis.ok_or_else(|| WorkshopError::of("axis", "must have a direction"))?;
    place(
        &mesh,
        arguments,
        &edit::rotation_about(arguments.vector("center"), axis, arguments.number("angle")),
    )
}

fn scale(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let linear = DMat3::from_diagonal(arguments.vector("by"));
    place(&mesh, arguments, &edit::about_center(arguments.vector("center"), linear))
}

fn mirror(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let plane = edit::Plane::through(arguments.vector("point"), arguments.vector("normal"));
    let plane = plane.ok_or_else(|| WorkshopError::of("normal", "must have a direction"))?;
    let all = vec![true; mesh.positions.len()];
    Ok(edit::transform(&mesh, &all, &plane.reflection()))
}

fn center(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let all = vec![true; mesh.positions.len()];
    let [low, high] = edit::vertex_bounds(&mesh, &all);
    let mut from = low.midpoint(high);
    if arguments.choice("mode") == "bottom" {
        from.y = low.y;
    }
    Ok(edit::transform(&mesh, &all, &DAffine3::from_translation(arguments.vector("at") - from)))
}

fn fit(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let all = vec![true; mesh.positions.len()];
    let [low, high] = edit::vertex_bounds(&mesh, &all);
    let longest = (high - low).max_element();
    if longest <= 0.0 {
        return Err(WorkshopError::new("the mesh has no extent"));
    }
    let linear = DMat3::from_diagonal(DVec3::splat(arguments.number("size") / longest));
    Ok(edit::transform(&mesh, &all, &edit::about_center(low.midpoint(high), linear)))
}

fn normals(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let mut mesh = edit::prepared(&mesh).into_owned();
    mesh.normals = match arguments.choice("mode") {
        "smooth" => edit::smooth_normals(&mesh),
        "flat" => edit::flat_normals(&mesh),
        "none" => Default::default(),
        _ => edit::creased_normals(&mesh, arguments.number("angle")),
    };
    Ok(mesh)
}

fn material(mut mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let marked = faces(&mesh, arguments)?;
    edit::set_slot(&mut mesh, &marked, arguments.count("slot") as u16);
    Ok(mesh)
}
