//! More faces of the same form, or fewer.

use super::{SELECT, SOUND_WITH_CREASES, UVS, edges, faces, refused, vertices};
use crate::PolygonMesh;
use crate::edit::{self, Quadrangulation};
use crate::workshop::{Action, Arguments, Keeps, Kind, Parameter, Verb, WorkshopError};

pub(super) const SPLIT: Verb = Verb {
    name: "split",
    summary: "Put vertices on edges, evenly spaced",
    parameters: &[
        Parameter::new("cuts", Kind::Count { least: 1, most: 1000 }, "1", "new vertices for each edge"),
        SELECT,
    ],
    example: "--cuts 2",
    action: Action::Change { keeps: Keeps { creases: true, faces: true, ..UVS }, run: split },
};

fn split(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    edit::split_edges(&mesh, &edges(&mesh, arguments)?, arguments.count("cuts")).map_err(refused)
}

pub(super) const POKE: Verb = Verb {
    name: "poke",
    summary: "Put a vertex in the middle of each face and make triangles around it",
    parameters: &[Parameter::new("height", Kind::NUMBER, "0", "how far the middle rises, in metres"), SELECT],
    example: "--height 0.02",
    action: Action::Change { keeps: SOUND_WITH_CREASES, run: poke },
};

fn poke(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    edit::poke(&mesh, &faces(&mesh, arguments)?, arguments.number("height")).map_err(refused)
}

pub(super) const QUADS: Verb = Verb {
    name: "split-quads",
    summary: "Cut each face into quads, from its middle to the middles of its edges",
    parameters: &[SELECT],
    example: "--select 'normal(0,1,0, 60deg)'",
    action: Action::Change { keeps: SOUND_WITH_CREASES, run: split_quads },
};

fn split_quads(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    edit::split_quads(&mesh, &faces(&mesh, arguments)?).map_err(refused)
}

pub(super) const TRIANGULATE: Verb = Verb {
    name: "triangulate",
    summary: "Cut faces into triangles",
    parameters: &[SELECT],
    example: "",
    action: Action::Change { keeps: SOUND_WITH_CREASES, run: triangulate },
};

fn triangulate(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    edit::triangulate_faces(&mesh, &faces(&mesh, arguments)?).map_err(refused)
}

pub(super) const QUADRANGULATE: Verb = Verb {
    name: "quadrangulate",
    summary: "Join triangles in pairs to quads, the squarest first",
    parameters: &[
        Parameter::new("bend", Kind::Angle, "40deg", "the widest angle between both triangles"),
        Parameter::new("skew", Kind::Angle, "40deg", "how far an angle of the quad may be from a right one"),
        SELECT,
    ],
    example: "",
    action: Action::Change { keeps: SOUND_WITH_CREASES, run: quadrangulate },
};

fn quadrangulate(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let limits = Quadrangulation { bend: arguments.number("bend"), skew: arguments.number("skew") };
    Ok(edit::quadrangulate(&mesh, &faces(&mesh, arguments)?, &limits))
}

pub(super) const DISSOLVE: Verb = Verb {
    name: "dissolve",
    summary: "Join faces: across edges, around vertices, or where they lie in one plane",
    parameters: &[
        Parameter::new(
            "mode",
            Kind::Choice(&["flat", "edges", "vertices"]),
            "flat",
            "what is dissolved: edges between faces in one plane, edges, or vertices",
        ),
        Parameter::new("angle", Kind::Angle, "1deg", "how far faces may be from one plane (mode flat)"),
        SELECT,
    ],
    example: "",
    action: Action::Change { keeps: UVS, run: dissolve },
};

fn dissolve(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    Ok(match arguments.choice("mode") {
        "edges" => edit::dissolve_edges(&mesh, &edges(&mesh, arguments)?),
        "vertices" => edit::dissolve_vertices(&mesh, &vertices(&mesh, arguments)?),
        _ => edit::dissolve_flat(&mesh, &faces(&mesh, arguments)?, arguments.number("angle")),
    })
}

pub(super) const COLLAPSE: Verb = Verb {
    name: "collapse",
    summary: "Draw edges together to their middles",
    parameters: &[Parameter::required("select", Kind::Text, "which edges, such as `edges(0-1)`")],
    example: "--select 'edges(0-1)'",
    action: Action::Change { keeps: UVS, run: collapse },
};

fn collapse(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    Ok(edit::collapse_edges(&mesh, &edges(&mesh, arguments)?))
}
