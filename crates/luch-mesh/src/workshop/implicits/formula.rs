//! Surfaces of formulas and of solids that are formulas.

use glam::DVec3;
use luch_formula::Formula;

use super::{METHOD, RESOLUTION, mesh_of};
use crate::PolygonMesh;
use crate::implicit::{Ball, Region, Solid, SolidError};
use crate::workshop::{Action, Arguments, Kind, Parameter, Verb, WorkshopError};

const OPEN: Parameter =
    Parameter::new("open", Kind::Flag, "false", "leave the surface open where it meets the side of the box");

/// Any formula.
pub(super) const IMPLICIT: Verb = Verb {
    name: "implicit",
    summary: "The surface where a formula of x, y and z is zero, or both sides of an equation are equal; negative is inside",
    parameters: &[
        Parameter::required(
            "formula",
            Kind::Text,
            "such as x^2 + y^2 + z^2 - 1, or (r - hypot(x, z))^2 + y^2 = 0.1",
        ),
        Parameter::new(
            "bounds",
            Kind::Numbers,
            "-2,-2,-2,2,2,2",
            "two corners of the box that is looked at, in metres",
        ),
        RESOLUTION,
        METHOD,
        Parameter::new("parameters", Kind::Text, "", "values of other names in the formula, such as a=1,b=2"),
        OPEN,
    ],
    example: "'x^2 + y^2 + z^2 - r^2' --bounds -1.5,-1.5,-1.5,1.5,1.5,1.5 --resolution 12 --parameters r=1",
    action: Action::Make { closed: true, run: implicit },
};

/// A lattice often used for infills.
pub(super) const GYROID: Verb = Verb {
    name: "gyroid",
    summary: "A wall along a gyroid in a box, closed at its sides",
    parameters: &[
        Parameter::new("size", Kind::Size, "2", "lengths of the sides of the box, in metres"),
        Parameter::new("period", Kind::POSITIVE, "1", "after which length it repeats, in metres"),
        Parameter::new(
            "thickness",
            Kind::NOT_NEGATIVE,
            "0.15",
            "of the wall, in metres; 0 fills one of both rooms",
        ),
        RESOLUTION,
        METHOD,
    ],
    example: "--size 1 --resolution 12",
    action: Action::Make { closed: true, run: gyroid },
};

/// Soft objects.
pub(super) const METABALLS: Verb = Verb {
    name: "metaballs",
    summary: "Balls that flow together where they come near",
    parameters: &[
        Parameter::required("balls", Kind::Numbers, "x, y, z and radius of influence of each, in metres"),
        RESOLUTION,
        METHOD,
    ],
    example: "0,0,0,1,0.7,0,0,0.8 --resolution 12",
    action: Action::Make { closed: true, run: metaballs },
};

fn told(error: SolidError) -> WorkshopError {
    match error {
        SolidError::Formula(error) => WorkshopError::of("formula", error.to_string()),
        error => WorkshopError::new(error.to_string()),
    }
}

/// What `implicit` was asked for, before it becomes triangles.
#[derive(Clone, Debug)]
pub struct FormulaSurface {
    /// Zero on the surface, negative inside.
    pub formula: Formula,
    /// Where it is looked at.
    pub region: Region,
    /// Whether the sides of the box close the body.
    pub closed: bool,
}

fn implicit(arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let FormulaSurface { formula, region, closed } = formula_surface(arguments)?;
    let field = Solid::Formula(formula).field().map_err(told)?;
    mesh_of(&field, region, closed, arguments)
}

pub(in crate::workshop) fn formula_surface(arguments: &Arguments) -> Result<FormulaSurface, WorkshopError> {
    let &[ax, ay, az, bx, by, bz] = arguments.numbers("bounds") else {
        return Err(WorkshopError::of("bounds", "takes six numbers: x,y,z of one corner and of the other"));
    };
    let (one, other) = (DVec3::new(ax, ay, az), DVec3::new(bx, by, bz));
    let region = Region { min: one.min(other), max: one.max(other) };
    let mut formula = Formula::new(arguments.text("formula").unwrap_or_default());
    for pair in
        arguments.text("parameters").unwrap_or_default().split(',').filter(|pair| !pair.trim().is_empty())
    {
        let wrong = || WorkshopError::of("parameters", format!("found “{pair}”, expected name=number"));
        let (name, value) = pair.split_once('=').ok_or_else(wrong)?;
        formula = formula.with(name.trim(), value.trim().parse::<f64>().map_err(|_| wrong())?);
    }
    Ok(FormulaSurface { formula, region, closed: !arguments.flag("open") })
}

fn gyroid(arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let solid =
        Solid::Gyroid { period: arguments.number("period"), thickness: arguments.number("thickness") };
    let half = arguments.vector("size") / 2.0;
    mesh_of(&solid.field().map_err(told)?, Region { min: -half, max: half }, true, arguments)
}

fn metaballs(arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let numbers = arguments.numbers("balls");
    let (groups, rest) = numbers.as_chunks::<4>();
    if groups.is_empty() || !rest.is_empty() {
        return Err(WorkshopError::of("balls", "takes four numbers for each ball: x,y,z,radius"));
    }
    let balls: Vec<Ball> =
        groups.iter().map(|&[x, y, z, radius]| Ball { center: DVec3::new(x, y, z), radius }).collect();
    let mut region = Region { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };
    for ball in &balls {
        region.min = region.min.min(ball.center - ball.radius);
        region.max = region.max.max(ball.center + ball.radius);
    }
    let field = Solid::Metaballs { balls }.field().map_err(told)?;
    mesh_of(&field, region, true, arguments)
}
