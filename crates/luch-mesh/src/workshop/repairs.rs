//! Putting right, smoothing, reducing, booleans.

mod bodies;
mod reductions;

use super::{Action, Arguments, Keeps, Kind, Parameter, Verb, WorkshopError};
use crate::PolygonMesh;
use crate::repair::{self, Filling};

const UVS: Keeps = Keeps { uvs: true, ..Keeps::NOTHING };
const DISTANCE: Parameter = Parameter::new(
    "distance",
    Kind::NOT_NEGATIVE,
    "0",
    "how far apart positions may be that count as one, in metres",
);

/// The verbs of this group.
pub(super) const VERBS: &[Verb] = &[
    bodies::UNION,
    bodies::INTERSECTION,
    bodies::DIFFERENCE,
    bodies::HULL,
    reductions::DECIMATE,
    reductions::DROP_SLIVERS,
    reductions::CLUSTER,
    reductions::SMOOTH,
    reductions::REMESH,
    Verb {
        name: "repair",
        summary: "Make a closed, outward facing manifold: merge, drop what is double, turn, part, fill",
        parameters: &[DISTANCE],
        example: "--distance 0.000001",
        action: Action::Change { keeps: Keeps { closed: true, ..UVS }, run: repair },
    },
    Verb {
        name: "merge",
        summary: "Make one position of those that coincide or are close; faces that collapse go",
        parameters: &[DISTANCE],
        example: "--distance 0.001",
        action: Action::Change { keeps: UVS, run: merge },
    },
    Verb {
        name: "remove-duplicates",
        summary: "Leave out faces that are there twice, turned round or not",
        parameters: &[],
        example: "",
        action: Action::Change {
            keeps: Keeps { closed: true, uvs: true, creases: true, faces: false, positions: true },
            run: |mesh, _| Ok(repair::remove_duplicate_faces(&mesh).mesh),
        },
    },
    Verb {
        name: "remove-unused",
        summary: "Leave out positions that no face uses",
        parameters: &[],
        example: "",
        action: Action::Change {
            keeps: Keeps { closed: true, ..UVS },
            run: |mesh, _| Ok(repair::remove_unused(&mesh).mesh),
        },
    },
    Verb {
        name: "keep-largest",
        summary: "Keep the piece with the largest area",
        parameters: &[],
        example: "",
        action: Action::Change {
            keeps: Keeps { closed: true, ..UVS },
            run: |mesh, _| Ok(repair::remove_unused(&repair::keep_largest(&mesh).mesh).mesh),
        },
    },
    Verb {
        name: "fill-holes",
        summary: "Close borders with new faces",
        parameters: &[
            Parameter::new(
                "method",
                Kind::Choice(&["area", "polygon", "fan"]),
                "area",
                "triangles of least area, one polygon, or a fan about a new vertex",
            ),
            Parameter::new(
                "edges",
                Kind::Count { least: 3, most: u64::MAX },
                "1000000",
                "the longest border to be filled",
            ),
        ],
        example: "",
        action: Action::Change { keeps: Keeps { closed: true, creases: true, ..UVS }, run: fill_holes },
    },
    Verb {
        name: "orient",
        summary: "Turn faces so that neighbours agree and bodies face outward",
        parameters: &[],
        example: "",
        action: Action::Change {
            keeps: Keeps { closed: true, uvs: true, creases: true, faces: false, positions: true },
            run: |mesh, _| Ok(repair::orient(&mesh).mesh),
        },
    },
    Verb {
        name: "manifold",
        summary: "Part faces where more than two meet at an edge or fans touch in a point",
        parameters: &[],
        example: "",
        action: Action::Change {
            keeps: Keeps { closed: true, uvs: true, creases: true, faces: false, positions: false },
            run: |mesh, _| Ok(repair::make_manifold(&mesh).mesh),
        },
    },
];

fn repair(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    Ok(repair::repair(&mesh, arguments.length("distance")).mesh)
}

fn merge(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    Ok(repair::merge(&mesh, arguments.length("distance")).mesh)
}

fn fill_holes(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let filling = match arguments.choice("method") {
        "polygon" => Filling::Polygon,
        "fan" => Filling::Fan,
        _ => Filling::LeastArea,
    };
    Ok(repair::fill_holes(&mesh, filling, arguments.count("edges") as usize).mesh)
}
