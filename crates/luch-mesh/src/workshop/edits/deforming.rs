//! Maps of space.

use glam::DVec3;

use super::cutting::center_or_middle;
use super::{SELECT, refused, vertices};
use crate::PolygonMesh;
use crate::edit::{self, Deformation, EditError, Field, Lattice, Span};
use crate::workshop::{Action, Arguments, Keeps, Kind, Parameter, Verb, WorkshopError};

const AXIS: Parameter = Parameter::new("axis", Kind::Vector, "y", "the direction of the axis");
const CENTER: Parameter = Parameter::optional(
    "center",
    Kind::Vector,
    "a point of the axis, in metres; the middle if it is not given",
);

fn unit(arguments: &Arguments, name: &'static str) -> Result<DVec3, WorkshopError> {
    arguments.vector(name).try_normalize().ok_or_else(|| WorkshopError::of(name, "must have a direction"))
}

fn span(mesh: &PolygonMesh, marked: &[bool], arguments: &Arguments) -> Result<Span, WorkshopError> {
    let center = center_or_middle(mesh, marked, arguments);
    Span::of(mesh, marked, arguments.vector("axis"), center).map_err(refused)
}

pub(super) const TWIST: Verb = Verb {
    name: "twist",
    summary: "Turn about an axis, the more the farther along it",
    parameters: &[
        Parameter::new("angle", Kind::Angle, "90deg", "the turn from end to end"),
        AXIS,
        CENTER,
        SELECT,
    ],
    example: "--angle 45deg",
    action: Action::Change { keeps: Keeps::ALL, run: twist },
};

fn twist(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let marked = vertices(&mesh, arguments)?;
    let span = span(&mesh, &marked, arguments)?;
    Ok(edit::deform(&mesh, &marked, &Deformation::Twist { span, angle: arguments.number("angle") }))
}

pub(super) const BEND: Verb = Verb {
    name: "bend",
    summary: "Bend an axis to an arc of the same length",
    parameters: &[
        Parameter::new("angle", Kind::Angle, "90deg", "the angle of the arc"),
        AXIS,
        Parameter::new("toward", Kind::Vector, "x", "the direction it bends to"),
        CENTER,
        SELECT,
    ],
    example: "--angle 60deg",
    action: Action::Change { keeps: Keeps::ALL, run: bend },
};

fn bend(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let marked = vertices(&mesh, arguments)?;
    let span = span(&mesh, &marked, arguments)?;
    let toward = arguments.vector("toward").reject_from_normalized(span.axis).try_normalize();
    let toward = toward.ok_or_else(|| WorkshopError::of("toward", "must lead away from the axis"))?;
    Ok(edit::deform(&mesh, &marked, &Deformation::Bend { span, angle: arguments.number("angle"), toward }))
}

pub(super) const TAPER: Verb = Verb {
    name: "taper",
    summary: "Scale away from an axis, up to a factor at its end",
    parameters: &[
        Parameter::new("factor", Kind::NUMBER, "0.5", "the scale at the end of the axis"),
        AXIS,
        CENTER,
        SELECT,
    ],
    example: "--factor 0.5",
    action: Action::Change { keeps: Keeps::ALL, run: taper },
};

fn taper(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let marked = vertices(&mesh, arguments)?;
    let span = span(&mesh, &marked, arguments)?;
    Ok(edit::deform(&mesh, &marked, &Deformation::Taper { span, factor: arguments.number("factor") }))
}

pub(super) const SHEAR: Verb = Verb {
    name: "shear",
    summary: "Slide along a direction, in proportion to the way along an axis",
    parameters: &[
        Parameter::required(
            "by",
            Kind::Vector,
            "how far for each metre along the axis; its part along the axis does not count",
        ),
        AXIS,
        CENTER,
        SELECT,
    ],
    example: "--by 0.5,0,0.2",
    action: Action::Change { keeps: Keeps::ALL, run: shear },
};

fn shear(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let marked = vertices(&mesh, arguments)?;
    let axis = unit(arguments, "axis")?;
    let (center, way) = (center_or_middle(&mesh, &marked, arguments), arguments.vector("by"));
    let way = way.reject_from_normalized(axis);
    Ok(edit::deform(&mesh, &marked, &Deformation::Shear { axis, center, way }))
}

pub(super) const STRETCH: Verb = Verb {
    name: "stretch",
    summary: "Scale along any axis, and across it so that the volume stays if asked to",
    parameters: &[
        Parameter::required("factor", Kind::POSITIVE, "the scale along the axis"),
        AXIS,
        Parameter::new("volume", Kind::Flag, "false", "keep the volume: shrink across as it stretches along"),
        CENTER,
        SELECT,
    ],
    example: "--factor 2 --axis 1,1,0 --volume",
    action: Action::Change { keeps: Keeps::ALL, run: stretch },
};

fn stretch(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let marked = vertices(&mesh, arguments)?;
    let along = arguments.number("factor");
    let across = if arguments.flag("volume") { 1.0 / along.sqrt() } else { 1.0 };
    let axis = unit(arguments, "axis")?;
    let center = center_or_middle(&mesh, &marked, arguments);
    Ok(edit::deform(&mesh, &marked, &Deformation::Stretch { axis, center, along, across }))
}

pub(super) const SPHERIFY: Verb = Verb {
    name: "spherify",
    summary: "Move toward a sphere",
    parameters: &[
        Parameter::new("share", Kind::FRACTION, "1", "0 leaves everything, 1 moves onto the sphere"),
        Parameter::optional(
            "radius",
            Kind::NOT_NEGATIVE,
            "of the sphere, in metres; the mean distance from the centre if it is not given",
        ),
        Parameter::optional(
            "center",
            Kind::Vector,
            "of the sphere, in metres; the middle if it is not given",
        ),
        SELECT,
    ],
    example: "--share 0.5",
    action: Action::Change { keeps: Keeps::ALL, run: spherify },
};

fn spherify(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let marked = vertices(&mesh, arguments)?;
    let center = center_or_middle(&mesh, &marked, arguments);
    let radius =
        arguments.number_if_given("radius").unwrap_or_else(|| edit::mean_distance(&mesh, &marked, center));
    let share = arguments.number("share");
    Ok(edit::deform(&mesh, &marked, &Deformation::Spherify { center, radius, share }))
}

pub(super) const WAVE: Verb = Verb {
    name: "wave",
    summary: "Move along a direction by a sine",
    parameters: &[
        Parameter::new("height", Kind::Vector, "0,0.1,0", "how far at most and which way, in metres"),
        Parameter::new("along", Kind::Vector, "x", "the direction in which the wave runs"),
        Parameter::new("length", Kind::POSITIVE, "1", "of the wave, in metres"),
        Parameter::new("phase", Kind::Angle, "0", "of the wave at the origin"),
        SELECT,
    ],
    example: "--height 0,0.05,0",
    action: Action::Change { keeps: Keeps::ALL, run: wave },
};

fn wave(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let wave = Deformation::Wave {
        height: arguments.vector("height"),
        along: unit(arguments, "along")?,
        length: arguments.number("length"),
        phase: arguments.number("phase"),
    };
    Ok(edit::deform(&mesh, &vertices(&mesh, arguments)?, &wave))
}

pub(super) const LATTICE: Verb = Verb {
    name: "lattice",
    summary: "Move with a box of control points around the selection",
    parameters: &[
        Parameter::required(
            "move",
            Kind::Numbers,
            "six numbers for each control point that moves: its place along x, y and z from 0, and how far in metres",
        ),
        Parameter::new(
            "points",
            Kind::Vector,
            "2,2,2",
            "how many control points along x, y and z, from 2 to 16",
        ),
        SELECT,
    ],
    example: "--move 1,1,1,0.2,0.3,0.1,0,1,0,0.1,0,0",
    action: Action::Change { keeps: Keeps::ALL, run: lattice },
};

fn lattice(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let marked = vertices(&mesh, arguments)?;
    let whole = |name: &str, number: f64| {
        let fits = (0.0..=65536.0).contains(&number) && number.fract() == 0.0;
        if fits {
            Ok(number as u32)
        } else {
            Err(WorkshopError::of(name, "has numbers of points that are not whole"))
        }
    };
    let of = |name: &str| {
        let name = name.to_owned();
        move |error: EditError| WorkshopError::of(&name, error.to_string())
    };
    let counts = arguments.vector("points");
    let counts = [whole("points", counts.x)?, whole("points", counts.y)?, whole("points", counts.z)?];
    let [low, high] = edit::vertex_bounds(&mesh, &marked);
    let mut lattice = Lattice::new(low, high, counts).map_err(of("points"))?;
    let moves = arguments.numbers("move");
    if moves.is_empty() || !moves.len().is_multiple_of(6) {
        return Err(WorkshopError::of("move", "needs six numbers for each point"));
    }
    for point in moves.chunks_exact(6) {
        let place = [whole("move", point[0])?, whole("move", point[1])?, whole("move", point[2])?];
        lattice.move_point(place, DVec3::new(point[3], point[4], point[5])).map_err(of("move"))?;
    }
    Ok(edit::deform(&mesh, &marked, &Deformation::Lattice(lattice)))
}

pub(super) const DISPLACE: Verb = Verb {
    name: "displace",
    summary: "Move vertices along their normals, or a direction, by a formula of x, y and z",
    parameters: &[
        Parameter::required("by", Kind::Text, "metres, such as `0.1*noise(3x, 3y, 3z)`"),
        Parameter::optional("along", Kind::Vector, "the direction; the normals if it is not given"),
        SELECT,
    ],
    example: "--by '0.05*noise(3x, 3y, 3z)'",
    action: Action::Change { keeps: Keeps::ALL, run: displace },
};

fn displace(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let field = Field::parse(arguments.text("by").unwrap_or_default());
    let field = field.map_err(|error| WorkshopError::of("by", error.to_string()))?;
    Ok(edit::displace(&mesh, &vertices(&mesh, arguments)?, &field, arguments.vector_if_given("along")))
}
