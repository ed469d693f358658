//! Taking apart.

use super::{SELECT, SOUND_WITH_CREASES, UVS, edges, faces, refused};
use crate::PolygonMesh;
use crate::edit;
use crate::workshop::{Action, Arguments, Keeps, Kind, Parameter, Verb, WorkshopError};

const WHICH: Parameter = Parameter::required("select", Kind::Text, "which faces, such as `faces(0-5)`");

pub(super) const DELETE: Verb = Verb {
    name: "delete",
    summary: "Take faces away",
    parameters: &[WHICH],
    example: "--select 'faces(0)'",
    action: Action::Change { keeps: UVS, run: delete },
};

fn delete(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    Ok(edit::delete_faces(&mesh, &faces(&mesh, arguments)?))
}

pub(super) const KEEP: Verb = Verb {
    name: "keep",
    summary: "Take all other faces away",
    parameters: &[WHICH],
    example: "--select 'grow(faces(0), 1)'",
    action: Action::Change { keeps: UVS, run: keep },
};

fn keep(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let others: Vec<bool> = faces(&mesh, arguments)?.into_iter().map(|flag| !flag).collect();
    Ok(edit::delete_faces(&mesh, &others))
}

pub(super) const DETACH: Verb = Verb {
    name: "detach",
    summary: "Make faces a piece of their own, at the same place",
    parameters: &[WHICH],
    example: "--select 'faces(0-1)'",
    action: Action::Change { keeps: Keeps { creases: true, faces: true, ..UVS }, run: detach },
};

fn detach(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    Ok(edit::detach(&mesh, &faces(&mesh, arguments)?))
}

pub(super) const DUPLICATE: Verb = Verb {
    name: "duplicate",
    summary: "Add a copy of faces, moved by a vector",
    parameters: &[Parameter::new("by", Kind::Vector, "0,0,0", "how far, in metres"), SELECT],
    example: "--by 3,0,0",
    action: Action::Change { keeps: SOUND_WITH_CREASES, run: duplicate },
};

fn duplicate(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    edit::duplicate(&mesh, &faces(&mesh, arguments)?, arguments.vector("by")).map_err(refused)
}

pub(super) const RIP: Verb = Verb {
    name: "rip",
    summary: "Tear the surface along edges",
    parameters: &[Parameter::new("select", Kind::Text, "sharp(30deg)", "which edges")],
    example: "",
    action: Action::Change { keeps: Keeps { creases: true, faces: true, ..UVS }, run: rip },
};

fn rip(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    Ok(edit::rip(&mesh, &edges(&mesh, arguments)?))
}

pub(super) const COMPONENT: Verb = Verb {
    name: "component",
    summary: "Keep one piece of those that hang together by edges",
    parameters: &[Parameter::new(
        "index",
        Kind::Count { least: 0, most: u64::MAX },
        "0",
        "which, in the order of their first faces",
    )],
    example: "--index 0",
    action: Action::Change { keeps: Keeps { closed: true, ..UVS }, run: component },
};

fn component(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    edit::component(&mesh, arguments.count("index") as usize).map_err(refused)
}
