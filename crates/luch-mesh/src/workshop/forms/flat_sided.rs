//! Bodies with flat sides.

use super::{LENGTH, LENGTH_OR_ZERO, counts, made, pieces, size};
use crate::PolygonMesh;
use crate::generate::{Generator, MAX_ROUNDING, Solid};
use crate::workshop::{Action, Arguments, Kind, Parameter, Verb, WorkshopError};
use glam::Vec3;

/// The verbs.
pub(super) const VERBS: &[Verb] = &[
    Verb {
        name: "cuboid",
        summary: "A box with hard edges",
        parameters: &[
            Parameter::new("size", Kind::Size, "1", "lengths of the sides along x, y and z, in metres"),
            Parameter::new("divisions", Kind::Numbers, "1", "pieces of the sides: one number, or three"),
        ],
        example: "--size 1,2,3",
        action: Action::Make { closed: true, run: cuboid },
    },
    Verb {
        name: "cube",
        summary: "A cube with hard edges: six squares",
        parameters: &[
            Parameter::new("size", LENGTH, "1", "length of the sides, in metres"),
            Parameter::new("divisions", pieces(1), "1", "pieces of each side"),
        ],
        example: "--size 2",
        action: Action::Make { closed: true, run: cube },
    },
    Verb {
        name: "rounded-cuboid",
        summary: "A box with rounded edges and corners",
        parameters: &[
            Parameter::new(
                "size",
                Kind::Size,
                "1",
                "lengths of the sides along x, y and z, roundings included, in metres",
            ),
            Parameter::new(
                "radius",
                LENGTH_OR_ZERO,
                "0.1",
                "radius of the rounding; half the shortest side is the most, in metres",
            ),
            Parameter::new(
                "segments",
                Kind::Count { least: 1, most: MAX_ROUNDING as u64 },
                "4",
                "pieces of half a rounded edge",
            ),
        ],
        example: "--size 1,2,3 --radius 0.25 --segments 2",
        action: Action::Make { closed: true, run: rounded_cuboid },
    },
    Verb {
        name: "prism",
        summary: "A body with flat sides over a regular polygon",
        parameters: &[
            Parameter::new("sides", pieces(3), "6", "how many sides"),
            Parameter::new("radius", LENGTH, "1", "from the axis to the corners, in metres"),
            Parameter::new("height", LENGTH, "2", "length along y, in metres"),
        ],
        example: "--sides 5",
        action: Action::Make { closed: true, run: prism },
    },
    Verb {
        name: "pyramid",
        summary: "A pyramid over a regular polygon, with or without its tip",
        parameters: &[
            Parameter::new("sides", pieces(3), "4", "how many sides"),
            Parameter::new("radius", LENGTH, "1", "from the axis to the corners of the base, in metres"),
            Parameter::new(
                "top-radius",
                LENGTH_OR_ZERO,
                "0",
                "the same of the upper end; 0 for a tip, in metres",
            ),
            Parameter::new("height", LENGTH, "1.5", "length along y, in metres"),
        ],
        example: "--sides 4",
        action: Action::Make { closed: true, run: pyramid },
    },
    Verb {
        name: "polyhedron",
        summary: "A regular polyhedron, or one with its corners cut off",
        parameters: &[
            Parameter::new("kind", Kind::Choice(SOLIDS), "cuboctahedron", "which one"),
            Parameter::new("radius", LENGTH, "1", "from the centre to the corners, in metres"),
        ],
        example: "--kind truncated-cube",
        action: Action::Make { closed: true, run: polyhedron },
    },
    Verb {
        name: "tetrahedron",
        summary: "The regular body of 4 triangles",
        parameters: &[Parameter::new("radius", LENGTH, "1", "from the centre to the corners, in metres")],
        example: "--radius 2",
        action: Action::Make { closed: true, run: tetrahedron },
    },
    Verb {
        name: "octahedron",
        summary: "The regular body of 8 triangles",
        parameters: &[Parameter::new("radius", LENGTH, "1", "from the centre to the corners, in metres")],
        example: "--radius 2",
        action: Action::Make { closed: true, run: octahedron },
    },
    Verb {
        name: "dodecahedron",
        summary: "The regular body of 12 pentagons",
        parameters: &[Parameter::new("radius", LENGTH, "1", "from the centre to the corners, in metres")],
        example: "--radius 2",
        action: Action::Make { closed: true, run: dodecahedron },
    },
    Verb {
        name: "icosahedron",
        summary: "The regular body of 20 triangles",
        parameters: &[Parameter::new("radius", LENGTH, "1", "from the centre to the corners, in metres")],
        example: "--radius 2",
        action: Action::Make { closed: true, run: icosahedron },
    },
    Verb {
        name: "truncated-icosahedron",
        summary: "The football: 12 pentagons and 20 hexagons",
        parameters: &[Parameter::new("radius", LENGTH, "1", "from the centre to the corners, in metres")],
        example: "--radius 2",
        action: Action::Make { closed: true, run: truncated_icosahedron },
    },
];

fn cuboid(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Cuboid { size: size(a, "size")?, divisions: divisions(a)? })
}

fn cube(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Cuboid { size: Vec3::splat(a.length("size")), divisions: [a.count("divisions"); 3] })
}

fn rounded_cuboid(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::RoundedCuboid {
        size: size(a, "size")?,
        radius: a.length("radius"),
        segments: a.count("segments"),
    })
}

fn prism(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Prism { sides: a.count("sides"), radius: a.length("radius"), height: a.length("height") })
}

fn pyramid(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Pyramid {
        sides: a.count("sides"),
        radius: a.length("radius"),
        top_radius: a.length("top-radius"),
        height: a.length("height"),
    })
}

fn polyhedron(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Polyhedron { solid: solid(a.choice("kind")), radius: a.length("radius") })
}

fn tetrahedron(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Polyhedron { solid: Solid::Tetrahedron, radius: a.length("radius") })
}

fn octahedron(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Polyhedron { solid: Solid::Octahedron, radius: a.length("radius") })
}

fn dodecahedron(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Polyhedron { solid: Solid::Dodecahedron, radius: a.length("radius") })
}

fn icosahedron(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Polyhedron { solid: Solid::Icosahedron, radius: a.length("radius") })
}

fn truncated_icosahedron(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Polyhedron { solid: Solid::TruncatedIcosahedron, radius: a.length("radius") })
}

/// Their names, in the order of [`Solid::ALL`].
const SOLIDS: &[&str] = &[
    "tetrahedron",
    "cube",
    "octahedron",
    "dodecahedron",
    "icosahedron",
    "truncated-tetrahedron",
    "truncated-cube",
    "truncated-octahedron",
    "truncated-dodecahedron",
    "truncated-icosahedron",
    "cuboctahedron",
    "icosidodecahedron",
];

fn solid(name: &str) -> Solid {
    SOLIDS.iter().zip(Solid::ALL).find(|(known, _)| **known == name).map_or(Solid::Cube, |(_, solid)| solid)
}

/// One count for all sides, or one for each.
fn divisions(a: &Arguments) -> Result<[u32; 3], WorkshopError> {
    let counts = counts(a, "divisions")?;
    match *counts.as_slice() {
        [all] => Ok([all; 3]),
        [x, y, z] => Ok([x, y, z]),
        _ => Err(WorkshopError::of(
            "divisions",
            format!("has {} numbers, expected one or three", counts.len()),
        )),
    }
}
