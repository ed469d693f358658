//! Flat forms, facing up.

use super::{LENGTH, LENGTHS, counts, inner_radius, made, pieces, too_long};
use crate::PolygonMesh;
use crate::generate::Generator;
use crate::workshop::{Action, Arguments, Kind, Parameter, Verb, WorkshopError};
use glam::Vec2;

/// The verbs.
pub(super) const VERBS: &[Verb] = &[
    Verb {
        name: "plane",
        summary: "A rectangle facing up",
        parameters: &[
            Parameter::new(
                "size",
                Kind::Numbers,
                "1",
                "lengths along x and z, in metres: one number, or two",
            ),
            Parameter::new("divisions", Kind::Numbers, "1", "pieces along x and z: one number, or two"),
        ],
        example: "--size 2,3",
        action: Action::Make { closed: false, run: plane },
    },
    Verb {
        name: "grid",
        summary: "A rectangle of many squares, facing up",
        parameters: &[
            Parameter::new(
                "size",
                Kind::Numbers,
                "1",
                "lengths along x and z, in metres: one number, or two",
            ),
            Parameter::new("divisions", Kind::Numbers, "10", "pieces along x and z: one number, or two"),
        ],
        example: "--divisions 4,3",
        action: Action::Make { closed: false, run: grid },
    },
    Verb {
        name: "polygon",
        summary: "A regular polygon as one face, facing up",
        parameters: &[
            Parameter::new("sides", pieces(3), "6", "how many corners"),
            Parameter::new("radius", LENGTH, "1", "from the centre to the corners, in metres"),
        ],
        example: "--sides 7",
        action: Action::Make { closed: false, run: polygon },
    },
    Verb {
        name: "disc",
        summary: "A disc facing up",
        parameters: &[
            Parameter::new("radius", LENGTH, "1", "radius, in metres"),
            Parameter::new("segments", pieces(3), "64", "pieces around the axis"),
            Parameter::new("rings", pieces(1), "1", "pieces from the rim to the centre"),
        ],
        example: "--segments 12 --rings 2",
        action: Action::Make { closed: false, run: disc },
    },
    Verb {
        name: "annulus",
        summary: "A disc with a round hole, facing up",
        parameters: &[
            Parameter::new("radius", LENGTH, "1", "radius, in metres"),
            Parameter::new("inner-radius", LENGTH, "0.5", "radius of the hole, in metres"),
            Parameter::new("segments", pieces(3), "64", "pieces around the axis"),
            Parameter::new("rings", pieces(1), "1", "pieces from rim to rim"),
        ],
        example: "--segments 12",
        action: Action::Make { closed: false, run: annulus },
    },
];

fn plane(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(plane_of(a)?)
}

fn grid(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(plane_of(a)?)
}

fn polygon(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Polygon { sides: a.count("sides"), radius: a.length("radius") })
}

fn disc(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Disc {
        radius: a.length("radius"),
        segments: a.count("segments"),
        rings: a.count("rings"),
    })
}

fn annulus(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Annulus {
        outer_radius: a.length("radius"),
        inner_radius: inner_radius(a)?,
        segments: a.count("segments"),
        rings: a.count("rings"),
    })
}

fn plane_of(a: &Arguments) -> Result<Generator, WorkshopError> {
    let wrong =
        |name, found: usize| WorkshopError::of(name, format!("has {found} numbers, expected one or two"));
    let size = match *a.numbers("size") {
        [side] => [side; 2],
        [x, z] => [x, z],
        ref others => return Err(wrong("size", others.len())),
    };
    if size.iter().any(|side| !LENGTHS.contains(side)) {
        return Err(WorkshopError::of("size", too_long()));
    }
    let divisions = match *counts(a, "divisions")?.as_slice() {
        [all] => [all; 2],
        [x, z] => [x, z],
        ref others => return Err(wrong("divisions", others.len())),
    };
    let [x, z] = size.map(|side| side as f32);
    Ok(Generator::Plane { size: Vec2::new(x, z), divisions })
}
