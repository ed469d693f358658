//! Surfaces of mathematics and the teapot.

use super::{LENGTH, LENGTHS, made, pieces};
use crate::PolygonMesh;
use crate::generate::knot::greatest_common_divisor;
use crate::generate::{
    Generator, KleinForm, MAX_HALF_TWISTS, MAX_KNOT_TURNS, MAX_SPRING_TURNS, MAX_TEAPOT_DIVISIONS,
};
use crate::workshop::{Action, Arguments, Kind, Parameter, Verb, WorkshopError};

/// The verbs.
pub(super) const VERBS: &[Verb] = &[
    Verb {
        name: "moebius",
        summary: "A band around the y axis that turns over on its way",
        parameters: &[
            Parameter::new("radius", LENGTH, "1", "from the axis to the middle of the band, in metres"),
            Parameter::new("width", LENGTH, "0.5", "width of the band, in metres"),
            Parameter::new(
                "half-twists",
                Kind::Count { least: 0, most: MAX_HALF_TWISTS as u64 },
                "1",
                "how often it turns over; odd numbers give one side only",
            ),
            Parameter::new("segments", pieces(3), "128", "pieces around the axis"),
            Parameter::new("stacks", pieces(1), "8", "pieces across"),
        ],
        example: "--segments 24 --stacks 2",
        action: Action::Make { closed: false, run: moebius },
    },
    Verb {
        name: "klein-bottle",
        summary: "A surface without border that has one side only",
        parameters: &[
            Parameter::new("form", Kind::Choice(KLEIN_FORMS), "bottle", "how it lies in space"),
            Parameter::new(
                "size",
                LENGTH,
                "2",
                "height, or diameter of the line that a figure eight goes along, in metres",
            ),
            Parameter::new("segments", pieces(3), "128", "pieces along"),
            Parameter::new("sides", pieces(3), "48", "pieces around"),
        ],
        example: "--segments 32 --sides 12",
        action: Action::Make { closed: false, run: klein_bottle },
    },
    Verb {
        name: "torus-knot",
        summary: "A tube along a knot on a torus",
        parameters: &[
            Parameter::new("p", KNOT_TURNS, "2", "how often it goes around the y axis"),
            Parameter::new("q", KNOT_TURNS, "3", "how often it goes around the tube of the torus"),
            Parameter::new(
                "radius",
                LENGTH,
                "1",
                "from the centre to the middle of the torus' tube, in metres",
            ),
            Parameter::new("torus-tube", LENGTH, "0.4", "radius of the torus' tube, in metres"),
            Parameter::new("tube", LENGTH, "0.12", "radius of the tube along the knot, in metres"),
            Parameter::new("segments", pieces(3), "256", "pieces along the knot"),
            Parameter::new("sides", pieces(3), "24", "pieces around the tube"),
        ],
        example: "--segments 48 --sides 6",
        action: Action::Make { closed: true, run: torus_knot },
    },
    Verb {
        name: "spring",
        summary: "A wire wound around the y axis, with flat ends",
        parameters: &[
            Parameter::new("radius", LENGTH, "1", "from the axis to the middle of the wire, in metres"),
            Parameter::new("tube", LENGTH, "0.1", "radius of the wire, in metres"),
            Parameter::new(
                "pitch",
                LENGTH_OF_ANY_SIGN,
                "0.5",
                "how far one turn rises, in metres; negative for a left-handed one",
            ),
            Parameter::new(
                "turns",
                Kind::Number { least: 0.01, most: MAX_SPRING_TURNS as f64 },
                "4",
                "how many turns",
            ),
            Parameter::new("segments", pieces(3), "64", "pieces of one turn"),
            Parameter::new("sides", pieces(3), "16", "pieces around the wire"),
        ],
        example: "--turns 1.5 --segments 16 --sides 6",
        action: Action::Make { closed: true, run: spring },
    },
    Verb {
        name: "teapot",
        summary: "The Utah teapot from its 32 Bezier patches; it is open",
        parameters: &[
            Parameter::new("size", LENGTH, "1", "times the original numbers, which make it 3.15 high"),
            Parameter::new(
                "divisions",
                Kind::Count { least: 2, most: MAX_TEAPOT_DIVISIONS as u64 },
                "10",
                "pieces of each patch along each side",
            ),
        ],
        example: "--divisions 2",
        action: Action::Make { closed: false, run: teapot },
    },
];

fn moebius(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Moebius {
        radius: a.length("radius"),
        width: a.length("width"),
        half_twists: a.count("half-twists"),
        segments: a.count("segments"),
        stacks: a.count("stacks"),
    })
}

fn klein_bottle(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::KleinBottle {
        form: klein_form(a.choice("form")),
        size: a.length("size"),
        segments: a.count("segments"),
        sides: a.count("sides"),
    })
}

fn torus_knot(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(knot_of(a)?)
}

fn spring(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Spring {
        radius: a.length("radius"),
        tube_radius: a.length("tube"),
        pitch: a.length("pitch"),
        turns: a.length("turns"),
        segments: a.count("segments"),
        sides: a.count("sides"),
    })
}

fn teapot(a: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    made(Generator::Teapot { size: a.length("size"), divisions: a.count("divisions") })
}

const KNOT_TURNS: Kind = Kind::Count { least: 0, most: MAX_KNOT_TURNS as u64 };
const LENGTH_OF_ANY_SIGN: Kind = Kind::Number { least: -*LENGTHS.end(), most: *LENGTHS.end() };

/// Their names.
const KLEIN_FORMS: &[&str] = &["bottle", "figure-eight"];

fn klein_form(name: &str) -> KleinForm {
    if name == "bottle" { KleinForm::Bottle } else { KleinForm::FigureEight }
}

fn knot_of(a: &Arguments) -> Result<Generator, WorkshopError> {
    let [around_axis, around_tube] = ["p", "q"].map(|name| a.count(name));
    if greatest_common_divisor(around_axis, around_tube) != 1 {
        let message =
            format!("has a common factor with p = {around_axis}: that would be several rings, not a knot");
        return Err(WorkshopError::of("q", message));
    }
    Ok(Generator::TorusKnot {
        around_axis,
        around_tube,
        major_radius: a.length("radius"),
        minor_radius: a.length("torus-tube"),
        tube_radius: a.length("tube"),
        segments: a.count("segments"),
        sides: a.count("sides"),
    })
}
