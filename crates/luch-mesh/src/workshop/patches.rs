//! Patches of splines.

use glam::DVec3;

use super::{Action, Arguments, Kind, Parameter, Verb, WorkshopError};
use crate::PolygonMesh;
use crate::patch::{ControlPoint, Fineness, PatchError, PatchModel, Surface, bpt, car, shapes, text};
use crate::words::Words;

const TOLERANCE: Parameter = Parameter::optional(
    "tolerance",
    Kind::POSITIVE,
    "how far triangles may be from the surface, in metres; a thousandth of the size if neither this nor divisions is given",
);
const DIVISIONS: Parameter = Parameter::optional(
    "divisions",
    Kind::Count { least: 1, most: 4096 },
    "pieces along both directions of each Bezier patch, in place of a tolerance",
);
const PIXELS: Parameter = Parameter::optional(
    "pixels",
    Kind::Pixels,
    "by how many pixels triangles may be off on the screen, in place of a tolerance; in scenes",
);
const RADIUS: Parameter = Parameter::new("radius", Kind::POSITIVE, "1", "radius in metres");

/// The verbs of this group.
pub(super) const VERBS: &[Verb] = &[
    Verb {
        name: "patches",
        summary: "Patches from a file as triangles without cracks: Bezier (.bpt), or rational and trimmed (.patches)",
        parameters: &[
            Parameter::required("file", Kind::File, "the .bpt or .patches file"),
            TOLERANCE,
            DIVISIONS,
            PIXELS,
        ],
        example: "car-body.bpt --tolerance 0.01",
        action: Action::Make { closed: true, run: patches },
    },
    Verb {
        name: "bezier-patch",
        summary: "One Bezier patch from its points",
        parameters: &[
            Parameter::required("points", Kind::Numbers, "x,y,z of all points, row by row along u"),
            Parameter::new("columns", Kind::Count { least: 2, most: 26 }, "4", "points in a row"),
            TOLERANCE,
            DIVISIONS,
            PIXELS,
        ],
        example: "--points 0,0,0,1,1,0,2,0,0,0,0,-1,1,0,-1,2,1,-1 --columns 3 --tolerance 0.05",
        action: Action::Make { closed: false, run: bezier_patch },
    },
    Verb {
        name: "car-body",
        summary: "The body of a car with wheels, about four metres long, from smoothly joined patches",
        parameters: &[TOLERANCE, DIVISIONS, PIXELS],
        example: "--divisions 1",
        action: Action::Make { closed: true, run: car_body },
    },
    Verb {
        name: "nurbs-sphere",
        summary: "An exact sphere as a rational surface, in triangles by tolerance",
        parameters: &[RADIUS, TOLERANCE, DIVISIONS, PIXELS],
        example: "--radius 1 --tolerance 0.05",
        action: Action::Make { closed: true, run: sphere },
    },
    Verb {
        name: "nurbs-torus",
        summary: "An exact torus as a rational surface, in triangles by tolerance",
        parameters: &[
            Parameter::new(
                "major",
                Kind::POSITIVE,
                "1",
                "from the centre to the middle of the tube, in metres",
            ),
            Parameter::new("minor", Kind::POSITIVE, "0.25", "radius of the tube, in metres"),
            TOLERANCE,
            DIVISIONS,
            PIXELS,
        ],
        example: "--tolerance 0.05",
        action: Action::Make { closed: true, run: torus },
    },
    Verb {
        name: "nurbs-cylinder",
        summary: "An exact closed cylinder as three rational surfaces, in triangles by tolerance",
        parameters: &[
            RADIUS,
            Parameter::new("height", Kind::POSITIVE, "2", "length along y, in metres"),
            TOLERANCE,
            DIVISIONS,
            PIXELS,
        ],
        example: "--tolerance 0.05",
        action: Action::Make { closed: true, run: cylinder },
    },
];

fn patches(arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let bytes = arguments.file("file").unwrap_or_default();
    let is_text = Words::new(bytes).peek().is_some_and(|word| word.text == text::MARK.as_bytes());
    let model = if is_text { text::decode(bytes) } else { bpt::decode(bytes) };
    let model = model.map_err(|error| WorkshopError::of("file", error.to_string()))?;
    triangles(&model, arguments)
}

fn bezier_patch(arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let numbers = arguments.numbers("points");
    let columns = arguments.count("columns") as usize;
    if !numbers.len().is_multiple_of(3 * columns) || numbers.len() < 6 * columns {
        let message = format!(
            "there are {} numbers, expected three for each of at least two rows of {columns} points",
            numbers.len()
        );
        return Err(WorkshopError::of("points", message));
    }
    let points: Vec<_> = numbers.chunks(3).map(|p| ControlPoint::new(DVec3::new(p[0], p[1], p[2]))).collect();
    let degrees = [columns - 1, points.len() / columns - 1];
    let surface =
        Surface::bezier(degrees, &points).map_err(|error| WorkshopError::of("points", error.to_string()))?;
    triangles(&surface.into(), arguments)
}

fn car_body(arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    triangles(&car::car_body().map_err(refused)?, arguments)
}

fn sphere(arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    triangles(&shapes::sphere(arguments.number("radius")).map_err(refused)?.into(), arguments)
}

fn torus(arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let surface = shapes::torus(arguments.number("major"), arguments.number("minor")).map_err(refused)?;
    triangles(&surface.into(), arguments)
}

fn cylinder(arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let model = shapes::cylinder(arguments.number("radius"), arguments.number("height")).map_err(refused)?;
    triangles(&model, arguments)
}

fn refused(error: PatchError) -> WorkshopError {
    WorkshopError::new(error.to_string())
}

/// The model in triangles, as finely as is asked for.
fn triangles(model: &PatchModel, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let given = |name| arguments.get(name).is_some();
    let wishes = ["tolerance", "divisions", "pixels"].map(given);
    if let Some(second) = (0..3).filter(|&k| wishes[k]).nth(1) {
        let name = ["tolerance", "divisions", "pixels"][second];
        return Err(WorkshopError::of(
            name,
            "cannot be given beside the wish for fineness before it; give one",
        ));
    }
    // Points in one place ask for nothing.
    let usual = || Fineness::Tolerance((model.extent() / 1000.0).max(f64::MIN_POSITIVE));
    let tolerance = arguments.number_if_given("tolerance").map(Fineness::Tolerance);
    let divisions = arguments.count_if_given("divisions").map(|count| Fineness::Divisions(count as u32));
    // What nobody sees is left as it usually is.
    let pixels = arguments.on_screen("pixels").filter(|screen| !screen.views.is_empty());
    let pixels = pixels.map(|screen| Fineness::Screen(screen.clone()));
    let fineness = tolerance.or(divisions).or(pixels).unwrap_or_else(usual);
    model.tessellate(fineness).map(|mesh| PolygonMesh::from(&mesh)).map_err(refused)
}
