//! Bodies of outlines.

use super::{LENGTH, LENGTH_OR_ZERO, LENGTHS};
use crate::PolygonMesh;
use crate::generate::MAX_DIVISIONS;
use crate::outline::{
    Extrusion, Lathe, Loft, Outline, OutlineError, Stand, Sweep, bezier_chain, flat, notation,
};
use crate::workshop::{Action, Arguments, Kind, Parameter, Verb, WorkshopError};
use glam::DVec3;

const OUTLINE: &str = "forms with ; between them, such as: rectangle 2 1; circle 0.3 at 0.5 0 (also ellipse, polygon, \
                       star, rounded-rectangle, gear, points, SVG path data)";
/// How far chords may lie off curves.
pub(super) const TOLERANCE: Parameter =
    Parameter::new("tolerance", LENGTH, "0.002", "how far chords may lie off the curves, in metres");
/// Where normals break.
pub(super) const CREASE: Parameter =
    Parameter::new("crease", Kind::Angle, "30deg", "edges bent by more than this angle are hard");
const CAPPED: Parameter = Parameter::new("capped", Kind::Flag, "true", "with both ends");
const UPRIGHT: Parameter = Parameter::new(
    "upright",
    Kind::Flag,
    "false",
    "the outline stands, facing +z, instead of lying on the ground",
);
const LAYERS: Kind = Kind::Count { least: 1, most: 65_536 };
/// A ratio of sizes.
const RATIO: Kind = Kind::Number { least: 1e-6, most: 1e6 };

/// The verbs.
pub(super) const VERBS: &[Verb] = &[
    Verb {
        name: "outline",
        summary: "A flat face of any outline with holes, facing up",
        parameters: &[Parameter::required("outline", Kind::Text, OUTLINE), UPRIGHT, TOLERANCE],
        example: "--outline 'star 5 1 0.4; circle 0.2 12'",
        action: Action::Make { closed: false, run: flat_outline },
    },
    Verb {
        name: "extrude-outline",
        summary: "A body over an outline with holes, straight, twisted or narrowing, its edges cut off or not",
        parameters: &[
            Parameter::required("outline", Kind::Text, OUTLINE),
            Parameter::new("height", LENGTH, "1", "length of the body, in metres"),
            Parameter::new("twist", Kind::Angle, "0", "angle by which the upper end is turned"),
            Parameter::new("top-scale", RATIO, "1", "size of the upper end over that of the lower"),
            Parameter::optional(
                "layers",
                LAYERS,
                "pieces along the height; by default one for 5 degrees of twist",
            ),
            Parameter::new(
                "bevel",
                LENGTH_OR_ZERO,
                "0",
                "how far the edges of the ends are cut off, in metres",
            ),
            CAPPED,
            CREASE,
            UPRIGHT,
            TOLERANCE,
        ],
        example: "--outline 'rectangle 2 1; circle 0.3 12' --twist 45deg --layers 3 --bevel 0.05",
        action: Action::Make { closed: true, run: extrude },
    },
    Verb {
        name: "lathe",
        summary: "A body or surface swept out by a profile that turns around the y axis",
        parameters: &[
            Parameter::required(
                "profile",
                Kind::Text,
                "an outline or line: x is the distance from the axis, y the height",
            ),
            Parameter::new("line", Kind::Flag, "false", "the profile is a line, not the border of an area"),
            Parameter::new("angle", Kind::Angle, "360deg", "how far it turns"),
            Parameter::new(
                "segments",
                Kind::Count { least: 1, most: MAX_DIVISIONS as u64 },
                "64",
                "pieces of the turn",
            ),
            CAPPED,
            CREASE,
            TOLERANCE,
        ],
        example: "--profile 'points 0 0, 1 0, 0.5 1, 0 1' --segments 12 --angle 270deg",
        action: Action::Make { closed: true, run: lathe },
    },
    Verb {
        name: "sweep",
        summary: "A body left by an outline that is carried along a path",
        parameters: &[
            Parameter::required("outline", Kind::Text, OUTLINE),
            Parameter::required("path", Kind::Numbers, "x,y,z of each point of the path, in metres"),
            Parameter::new(
                "bezier",
                Kind::Flag,
                "false",
                "the points are control points of cubic Bezier curves, 3 n + 1 of them",
            ),
            Parameter::new("closed", Kind::Flag, "false", "the path goes back to its first point"),
            Parameter::new("twist", Kind::Angle, "0", "angle by which the outline turns on the way"),
            Parameter::new("end-scale", RATIO, "1", "size of the outline at the end over that at the start"),
            Parameter::new(
                "mitred",
                Kind::Flag,
                "true",
                "straight pieces keep their section up to the bends",
            ),
            CAPPED,
            CREASE,
            TOLERANCE,
        ],
        example: "--outline 'circle 0.1 8' --path '0,0,0, 1,0,0, 1,1,0, 1,1,1'",
        action: Action::Make { closed: true, run: sweep },
    },
    Verb {
        name: "loft",
        summary: "A body between two outlines with as many points each",
        parameters: &[
            Parameter::required(
                "bottom",
                Kind::Text,
                "the outline at the bottom, in the notation of `outline`",
            ),
            Parameter::required("top", Kind::Text, "the outline at the top"),
            Parameter::new("height", LENGTH, "1", "length of the body, in metres"),
            Parameter::new("layers", LAYERS, "1", "pieces along the height"),
            CAPPED,
            CREASE,
            UPRIGHT,
            TOLERANCE,
        ],
        example: "--bottom 'circle 1 16' --top 'star 8 1 0.5' --layers 2",
        action: Action::Make { closed: true, run: loft },
    },
];

/// A mistake in an outline as one of the verb.
pub(super) fn refused(error: OutlineError) -> WorkshopError {
    WorkshopError::new(error.to_string())
}

/// How the outline is to stand.
pub(super) fn stand(a: &Arguments) -> Stand {
    if a.flag("upright") { Stand::Upright } else { Stand::Lying }
}

fn outlines(a: &Arguments, name: &str) -> Result<Vec<Outline>, WorkshopError> {
    let text = a.text(name).unwrap_or_default();
    notation::outlines(text, a.number("tolerance"))
        .map_err(|error| WorkshopError::of(name, error.to_string()))
}

fn flat_outline(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    flat(&outlines(a, "outline")?, stand(a)).map_err(refused)
}

fn extrude(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let twist = a.number("twist");
    // A cast takes what is too large to the end.
    let by_twist = (twist.abs() / 5f64.to_radians()).ceil() as u64;
    let extrusion = Extrusion {
        height: a.number("height"),
        twist,
        top_scale: a.number("top-scale"),
        layers: a.count_if_given("layers").unwrap_or(by_twist).clamp(1, 65_536) as u32,
        capped: a.flag("capped"),
        bevel: a.number("bevel"),
        crease_angle: a.number("crease"),
        stand: stand(a),
    };
    extrusion.of(&outlines(a, "outline")?).map_err(refused)
}

fn lathe(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let lathe = Lathe {
        angle: a.number("angle"),
        segments: a.count("segments"),
        capped: a.flag("capped"),
        crease_angle: a.number("crease"),
    };
    if !a.flag("line") {
        return lathe.of(&outlines(a, "profile")?).map_err(refused);
    }
    let line = notation::line(a.text("profile").unwrap_or_default(), a.number("tolerance"));
    let line = line.map_err(|error| WorkshopError::of("profile", error.to_string()))?;
    lathe.of_line(&line).map_err(refused)
}

fn sweep(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let numbers = a.numbers("path");
    if !numbers.len().is_multiple_of(3) || numbers.iter().any(|n| n.abs() > *LENGTHS.end()) {
        let message = format!("has {} numbers, expected three for each point", numbers.len());
        return Err(WorkshopError::of("path", message));
    }
    let mut path: Vec<DVec3> = numbers.chunks_exact(3).map(DVec3::from_slice).collect();
    if a.flag("bezier") {
        if path.len() % 3 != 1 || path.len() < 4 {
            let message = format!("has {} control points, expected 4, 7, 10 and so on", path.len());
            return Err(WorkshopError::of("path", message));
        }
        path = bezier_chain(&path, a.number("tolerance"));
    }
    let sweep = Sweep {
        is_closed: a.flag("closed"),
        twist: a.number("twist"),
        end_scale: a.number("end-scale"),
        is_mitred: a.flag("mitred"),
        capped: a.flag("capped"),
        crease_angle: a.number("crease"),
    };
    sweep.of(&outlines(a, "outline")?, &path).map_err(refused)
}

fn loft(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let one = |name: &str| -> Result<Outline, WorkshopError> {
        let mut all = outlines(a, name)?;
        if all.len() > 1 {
            return Err(WorkshopError::of(name, format!("is {} outlines, expected one", all.len())));
        }
        Ok(all.swap_remove(0))
    };
    let loft = Loft {
        height: a.number("height"),
        layers: a.count("layers"),
        capped: a.flag("capped"),
        crease_angle: a.number("crease"),
        stand: stand(a),
    };
    loft.between(&one("bottom")?, &one("top")?).map_err(refused)
}
