//! Round bodies.

use super::{EXPONENT, LENGTH, LENGTH_OR_ZERO, inner_radius, made, pieces, size};
use crate::PolygonMesh;
use crate::generate::{Generator, MAX_SUBDIVISIONS};
use crate::workshop::{Action, Arguments, Kind, Parameter, Verb, WorkshopError};

/// The verbs.
pub(super) const VERBS: &[Verb] = &[
    Verb {
        name: "sphere",
        summary: "A ball by longitude and latitude; its poles are points",
        parameters: &[
            Parameter::new("radius", LENGTH, "1", "radius, in metres"),
            Parameter::new("segments", pieces(3), "64", "pieces around the axis"),
            Parameter::new("rings", pieces(2), "32", "pieces from pole to pole"),
        ],
        example: "--radius 2 --segments 12 --rings 6",
        action: Action::Make { closed: true, run: sphere },
    },
    Verb {
        name: "icosphere",
        summary: "A ball of nearly equal triangles",
        parameters: &[
            Parameter::new("radius", LENGTH, "1", "radius, in metres"),
            Parameter::new(
                "subdivisions",
                Kind::Count { least: 0, most: MAX_SUBDIVISIONS as u64 },
                "3",
                "how often each of 20 triangles is cut into four",
            ),
        ],
        example: "--subdivisions 1",
        action: Action::Make { closed: true, run: icosphere },
    },
    Verb {
        name: "ellipsoid",
        summary: "A ball stretched along the axes",
        parameters: &[
            Parameter::new("radii", Kind::Size, "1", "radii along x, y and z, in metres"),
            Parameter::new("segments", pieces(3), "64", "pieces around the axis"),
            Parameter::new("rings", pieces(2), "32", "pieces from pole to pole"),
        ],
        example: "--radii 1,2,1.5 --segments 12 --rings 8",
        action: Action::Make { closed: true, run: ellipsoid },
    },
    Verb {
        name: "superellipsoid",
        summary: "Something between ellipsoid, box, cylinder and octahedron",
        parameters: &[
            Parameter::new("radii", Kind::Size, "1", "radii along x, y and z, in metres"),
            Parameter::new(
                "around",
                EXPONENT,
                "0.5",
                "how sections across the axis are shaped: towards 0 square, 1 round, 2 a rhombus",
            ),
            Parameter::new("upright", EXPONENT, "0.5", "how sections along the axis are shaped"),
            Parameter::new("segments", pieces(3), "64", "pieces around the axis"),
            Parameter::new("rings", pieces(2), "32", "pieces from pole to pole"),
        ],
        example: "--around 0.5 --upright 0.8 --segments 16 --rings 8",
        action: Action::Make { closed: true, run: superellipsoid },
    },
    Verb {
        name: "cylinder",
        summary: "A cylinder: smooth side, sharp rims",
        parameters: &[
            Parameter::new("radius", LENGTH, "1", "radius, in metres"),
            Parameter::new("height", LENGTH, "2", "length along y, in metres"),
            Parameter::new("segments", pieces(3), "64", "pieces around the axis"),
            Parameter::new("stacks", pieces(1), "1", "pieces along the axis"),
            Parameter::new("capped", Kind::Flag, "true", "with a disc at both ends"),
        ],
        example: "--segments 12 --stacks 2",
        action: Action::Make { closed: true, run: cylinder },
    },
    Verb {
        name: "cone",
        summary: "A cone: smooth side, sharp rim",
        parameters: &[
            Parameter::new("radius", LENGTH, "1", "radius of the base, in metres"),
            Parameter::new("top-radius", LENGTH_OR_ZERO, "0", "radius of the upper end, in metres"),
            Parameter::new("height", LENGTH, "2", "length along y, in metres"),
            Parameter::new("segments", pieces(3), "64", "pieces around the axis"),
            Parameter::new("stacks", pieces(1), "1", "pieces along the axis"),
            Parameter::new("capped", Kind::Flag, "true", "with a disc at both ends"),
        ],
        example: "--segments 12",
        action: Action::Make { closed: true, run: cone },
    },
    Verb {
        name: "frustum",
        summary: "A cone without its tip",
        parameters: &[
            Parameter::new("radius", LENGTH, "1", "radius of the lower end, in metres"),
            Parameter::new("top-radius", LENGTH, "0.5", "radius of the upper end, in metres"),
            Parameter::new("height", LENGTH, "2", "length along y, in metres"),
            Parameter::new("segments", pieces(3), "64", "pieces around the axis"),
            Parameter::new("stacks", pieces(1), "1", "pieces along the axis"),
            Parameter::new("capped", Kind::Flag, "true", "with a disc at both ends"),
        ],
        example: "--segments 12",
        action: Action::Make { closed: true, run: frustum },
    },
    Verb {
        name: "capsule",
        summary: "A cylinder between two half balls",
        parameters: &[
            Parameter::new("radius", LENGTH, "0.5", "radius, in metres"),
            Parameter::new("height", LENGTH_OR_ZERO, "1", "length of the straight part, in metres"),
            Parameter::new("segments", pieces(3), "64", "pieces around the axis"),
            Parameter::new("rings", pieces(1), "16", "pieces from a pole to the straight part"),
            Parameter::new("stacks", pieces(1), "1", "pieces of the straight part"),
        ],
        example: "--segments 12 --rings 3",
        action: Action::Make { closed: true, run: capsule },
    },
    Verb {
        name: "tube",
        summary: "A pipe: a cylinder with a round hole from end to end",
        parameters: &[
            Parameter::new("radius", LENGTH, "1", "radius, in metres"),
            Parameter::new("inner-radius", LENGTH, "0.75", "radius of the hole, in metres"),
            Parameter::new("height", LENGTH, "2", "length along y, in metres"),
            Parameter::new("segments", pieces(3), "64", "pieces around the axis"),
            Parameter::new("stacks", pieces(1), "1", "pieces along the axis"),
        ],
        example: "--segments 12",
        action: Action::Make { closed: true, run: tube },
    },
    Verb {
        name: "torus",
        summary: "A ring around the y axis",
        parameters: &[
            Parameter::new("radius", LENGTH, "1", "from the centre to the middle of the tube, in metres"),
            Parameter::new("tube", LENGTH, "0.25", "radius of the tube, in metres"),
            Parameter::new("segments", pieces(3), "96", "pieces around the axis"),
            Parameter::new("sides", pieces(3), "48", "pieces around the tube"),
        ],
        example: "--segments 16 --sides 8",
        action: Action::Make { closed: true, run: torus },
    },
];

fn sphere(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Sphere {
        radius: a.length("radius"),
        segments: a.count("segments"),
        rings: a.count("rings"),
    })
}

fn icosphere(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Icosphere { radius: a.length("radius"), subdivisions: a.count("subdivisions") })
}

fn ellipsoid(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Ellipsoid {
        radii: size(a, "radii")?,
        segments: a.count("segments"),
        rings: a.count("rings"),
    })
}

fn superellipsoid(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Superellipsoid {
        radii: size(a, "radii")?,
        around: a.length("around"),
        upright: a.length("upright"),
        segments: a.count("segments"),
        rings: a.count("rings"),
    })
}

fn cylinder(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Cylinder {
        radius: a.length("radius"),
        height: a.length("height"),
        segments: a.count("segments"),
        stacks: a.count("stacks"),
        capped: a.flag("capped"),
    })
}

fn cone(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Cone {
        bottom_radius: a.length("radius"),
        top_radius: a.length("top-radius"),
        height: a.length("height"),
        segments: a.count("segments"),
        stacks: a.count("stacks"),
        capped: a.flag("capped"),
    })
}

fn frustum(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Cone {
        bottom_radius: a.length("radius"),
        top_radius: a.length("top-radius"),
        height: a.length("height"),
        segments: a.count("segments"),
        stacks: a.count("stacks"),
        capped: a.flag("capped"),
    })
}

fn capsule(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Capsule {
        radius: a.length("radius"),
        height: a.length("height"),
        segments: a.count("segments"),
        rings: a.count("rings"),
        stacks: a.count("stacks"),
    })
}

fn tube(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Tube {
        outer_radius: a.length("radius"),
        inner_radius: inner_radius(a)?,
        height: a.length("height"),
        segments: a.count("segments"),
        stacks: a.count("stacks"),
    })
}

fn torus(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Torus {
        major_radius: a.length("radius"),
        minor_radius: a.length("tube"),
        segments: a.count("segments"),
        sides: a.count("sides"),
    })
}
