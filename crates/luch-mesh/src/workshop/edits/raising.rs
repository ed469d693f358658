//! Faces and edges raised, shrunken, cut off, thickened, joined.

use super::{SELECT, SOUND, SOUND_WITH_CREASES, UVS, edges, faces, refused, rule, vertices};
use crate::PolygonMesh;
use crate::edit::{self, Extrusion, Grouping, Inset};
use crate::workshop::{Action, Arguments, Keeps, Kind, Parameter, Verb, WorkshopError};

const GROUPING: Parameter = Parameter::new(
    "mode",
    Kind::Choice(&["region", "individual"]),
    "region",
    "whether faces side by side move together or each alone",
);

fn grouping(arguments: &Arguments) -> Grouping {
    if arguments.choice("mode") == "region" { Grouping::Region } else { Grouping::Individual }
}

pub(super) const EXTRUDE: Verb = Verb {
    name: "extrude",
    summary: "Raise faces and join them to where they were by walls",
    parameters: &[
        Parameter::new("distance", Kind::NUMBER, "1", "how far along the normals, in metres"),
        Parameter::optional("by", Kind::Vector, "the way to go instead of the normals, in metres"),
        GROUPING,
        Parameter::new(
            "base",
            Kind::Flag,
            "false",
            "leave the faces behind too, turned round: a sheet becomes a body",
        ),
        SELECT,
    ],
    example: "--distance 0.3 --select 'normal(0,1,0, 30deg)'",
    action: Action::Change { keeps: Keeps { creases: true, ..UVS }, run: extrude },
};

fn extrude(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let extrusion = Extrusion {
        distance: arguments.number("distance"),
        way: arguments.vector_if_given("by"),
        grouping: grouping(arguments),
        base: arguments.flag("base"),
    };
    edit::extrude(&mesh, &faces(&mesh, arguments)?, &extrusion).map_err(refused)
}

pub(super) const EXTRUDE_EDGES: Verb = Verb {
    name: "extrude-edges",
    summary: "Raise walls from border edges of an open mesh",
    parameters: &[
        Parameter::required("by", Kind::Vector, "the way to go, in metres"),
        Parameter::new(
            "select",
            Kind::Text,
            "border",
            "which edges; those that are no border are left alone",
        ),
    ],
    example: "--by 0,0.5,0",
    action: Action::Change { keeps: SOUND_WITH_CREASES, run: extrude_edges },
};

fn extrude_edges(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    edit::extrude_borders(&mesh, &edges(&mesh, arguments)?, arguments.vector("by")).map_err(refused)
}

pub(super) const INSET: Verb = Verb {
    name: "inset",
    summary: "Shrink faces and close the gap with a ring of faces",
    parameters: &[
        Parameter::new(
            "width",
            Kind::NOT_NEGATIVE,
            "0.1",
            "how far the border moves inward, in metres; held below that at which an edge turns round",
        ),
        Parameter::new("depth", Kind::NUMBER, "0", "how far the faces rise, in metres"),
        GROUPING,
        SELECT,
    ],
    example: "--width 0.05 --depth -0.02 --mode individual",
    action: Action::Change { keeps: SOUND_WITH_CREASES, run: inset },
};

fn inset(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let inset = Inset {
        width: arguments.number("width"),
        depth: arguments.number("depth"),
        grouping: grouping(arguments),
    };
    edit::inset(&mesh, &faces(&mesh, arguments)?, &inset).map_err(refused)
}

pub(super) const BEVEL: Verb = Verb {
    name: "bevel",
    summary: "Cut edges off at an even width, or vertices",
    parameters: &[
        Parameter::new(
            "width",
            Kind::NOT_NEGATIVE,
            "0.1",
            "metres from the edge to the new faces; held below that at which an edge turns round",
        ),
        Parameter::new(
            "mode",
            Kind::Choice(&["edges", "vertices"]),
            "edges",
            "what is cut off; beside it there must be no edge of three faces",
        ),
        Parameter::new("select", Kind::Text, "sharp(30deg)", "which edges or vertices"),
    ],
    example: "--width 0.05",
    action: Action::Change { keeps: SOUND, run: bevel },
};

fn bevel(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let width = arguments.number("width");
    let beveled = if arguments.choice("mode") == "edges" {
        edit::bevel_edges(&mesh, &edges(&mesh, arguments)?, width)
    } else {
        edit::bevel_vertices(&mesh, &vertices(&mesh, arguments)?, width)
    };
    beveled.map(|beveled| beveled.mesh).map_err(refused)
}

pub(super) const SOLIDIFY: Verb = Verb {
    name: "solidify",
    summary: "Give a surface a thickness; an open one becomes a body, a closed one hollow",
    parameters: &[
        Parameter::new("thickness", Kind::NUMBER, "0.1", "in metres"),
        Parameter::new(
            "offset",
            Kind::FRACTION,
            "0",
            "0 with the surface outside, 1 inside, 0.5 in the middle",
        ),
    ],
    example: "--thickness 0.05",
    action: Action::Change { keeps: SOUND_WITH_CREASES, run: solidify },
};

fn solidify(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    edit::solidify(&mesh, arguments.number("thickness"), arguments.number("offset")).map_err(refused)
}

pub(super) const BRIDGE: Verb = Verb {
    name: "bridge",
    summary: "Join two regions of faces, or two border loops, by a tube",
    parameters: &[
        Parameter::required(
            "from",
            Kind::Text,
            "the faces that give way to the tube, or the border edges at its start",
        ),
        Parameter::required("to", Kind::Text, "the faces or border edges at its end"),
        Parameter::new("mode", Kind::Choice(&["faces", "borders"]), "faces", "what is named"),
    ],
    example: "--from 'normal(0,1,0, 10deg)' --to 'normal(0,-1,0, 10deg)'",
    action: Action::Change { keeps: UVS, run: bridge },
};

fn bridge(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let (from, to) = (rule(arguments, "from")?, rule(arguments, "to")?);
    let bridged = if arguments.choice("mode") == "faces" {
        edit::bridge(&mesh, [&from.faces(&mesh), &to.faces(&mesh)], [&[]; 2])
    } else {
        edit::bridge(&mesh, [&[]; 2], [&from.edges(&mesh), &to.edges(&mesh)])
    };
    bridged.map_err(refused)
}

pub(super) const INFLATE: Verb = Verb {
    name: "inflate",
    summary: "Move vertices along their normals",
    parameters: &[
        Parameter::new("by", Kind::NUMBER, "0.1", "how far, in metres; flat faces end up at this distance"),
        SELECT,
    ],
    example: "--by 0.05",
    action: Action::Change { keeps: Keeps::ALL, run: inflate },
};

fn inflate(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    Ok(edit::inflate(&mesh, &vertices(&mesh, arguments)?, arguments.number("by")))
}
