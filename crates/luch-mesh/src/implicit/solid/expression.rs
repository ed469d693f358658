//! From the tree to one expression.

use glam::{DAffine3, DMat3, DVec3};
use luch_formula::Expression;

use super::bodies::{self, coordinates};
use super::{Solid, SolidError};
use crate::implicit::quadric::eigen;

/// Solids within solids.
const DEEPEST: usize = 200;
/// Operations a point.
const LONGEST: usize = 100_000;

pub(super) fn expression(solid: &Solid, depth: usize) -> Result<Expression, SolidError> {
    if depth > DEEPEST {
        return Err(SolidError::TooDeep { most: DEEPEST });
    }
    let inner = |solid: &Solid| expression(solid, depth + 1);
    let result = match solid {
        Solid::Sphere { radius } => bodies::sphere(positive("radius", *radius)?),
        Solid::Cuboid { size, rounding } => {
            for side in size.to_array() {
                positive("side", side)?;
            }
            bodies::cuboid(*size, not_negative("rounding", *rounding)?)
        }
        Solid::Cylinder { radius, height } => {
            bodies::cylinder(positive("radius", *radius)?, positive("height", *height)?)
        }
        Solid::Capsule { radius, height } => {
            bodies::capsule(positive("radius", *radius)?, not_negative("height", *height)?)
        }
        Solid::Torus { major_radius, minor_radius } => {
            bodies::torus(positive("major radius", *major_radius)?, positive("minor radius", *minor_radius)?)
        }
        Solid::HalfSpace { normal, distance } => {
            bodies::half_space(direction(*normal)?, finite("distance", *distance)?)
        }
        Solid::Gyroid { period, thickness } => {
            bodies::gyroid(positive("period", *period)?, not_negative("thickness", *thickness)?)
        }
        Solid::Metaballs { balls } => {
            for ball in balls {
                positive("radius", ball.radius)?;
                ball.center.to_array().into_iter().try_for_each(|c| finite("center", c).map(drop))?;
            }
            short(balls.len())?;
            bodies::metaballs(balls)
        }
        Solid::Formula(formula) => formula.parse_equation(&["x", "y", "z"])?,
        Solid::Union { parts, blend } => {
            joined(parts.iter().map(inner), *blend, Expression::least, Expression::smooth_union)?
        }
        Solid::Intersection { parts, blend } => {
            joined(parts.iter().map(inner), *blend, Expression::greatest, Expression::smooth_intersection)?
        }
        Solid::Difference { from, parts, blend } => {
            let rest = parts.iter().map(|part| Ok(-inner(part)?));
            let all = std::iter::once(inner(from)).chain(rest);
            joined(all, *blend, Expression::greatest, Expression::smooth_intersection)?
        }
        Solid::Offset { solid, distance } => inner(solid)?.offset(finite("distance", *distance)?),
        Solid::Shell { solid, thickness } => inner(solid)?.shell(positive("thickness", *thickness)?),
        Solid::Place { solid, map } => placed(&inner(solid)?, map)?,
        Solid::Twist { solid, turn } => inner(solid)?.twisted(finite("turn", *turn)?),
        Solid::Bend { solid, curvature } => bent(&inner(solid)?, finite("curvature", *curvature)?),
        Solid::Repeat { solid, period } => {
            for length in period.to_array() {
                not_negative("period", length)?;
            }
            inner(solid)?.repeated(period.to_array())
        }
        Solid::Mirror { solid, normal } => mirrored(&inner(solid)?, direction(*normal)?),
    };
    short(result.operations())?;
    Ok(result)
}

fn short(operations: usize) -> Result<(), SolidError> {
    if operations > LONGEST { Err(SolidError::TooLong { most: LONGEST }) } else { Ok(()) }
}

fn joined(
    parts: impl Iterator<Item = Result<Expression, SolidError>>,
    blend: f64,
    sharp: fn(&[Expression]) -> Expression,
    smooth: fn(&Expression, &Expression, f64) -> Expression,
) -> Result<Expression, SolidError> {
    not_negative("blend", blend)?;
    let mut expressions = Vec::new();
    let mut operations = 0;
    for part in parts {
        let part = part?;
        operations += part.operations();
        short(operations)?;
        expressions.push(part);
    }
    if blend == 0.0 {
        return Ok(sharp(&expressions));
    }
    // In pairs, so that the calculation is as shallow as can be.
    while expressions.len() > 1 {
        expressions = expressions
            .chunks(2)
            .map(|pair| match pair {
                [one, other] => smooth(one, other, blend),
                rest => rest[0].clone(),
            })
            .collect();
    }
    Ok(expressions.pop().unwrap_or_else(|| sharp(&[])))
}

/// Asked at the point that comes to the place; times the least factor by which the map stretches, so that no distance is too long.
fn placed(solid: &Expression, map: &DAffine3) -> Result<Expression, SolidError> {
    let inverse = map.inverse();
    if !map.is_finite() || !inverse.is_finite() || map.matrix3.determinant() == 0.0 {
        return Err(SolidError::Flat("the map of a solid has no inverse"));
    }
    let rows = inverse.matrix3.transpose();
    let row = |axis: usize| {
        let of = rows.col(axis);
        [of.x, of.y, of.z, inverse.translation[axis]]
    };
    let moved = solid.transformed(&[row(0), row(1), row(2)]);
    let squared: DMat3 = map.matrix3.transpose() * map.matrix3;
    let least = eigen(squared).values[2].max(0.0).sqrt();
    // Turns leave one but for rounding, which would cost a product for nothing.
    Ok(if (least - 1.0).abs() < 1e-12 { moved } else { moved * least })
}

/// The point at angle a and distance r from the centre (0, 1/c) is asked at (a / c, 1/c − r).
fn bent(solid: &Expression, curvature: f64) -> Expression {
    if curvature == 0.0 {
        return solid.clone();
    }
    let [x, y, _] = coordinates();
    let radius = 1.0 / curvature;
    let down = radius - y;
    let side = curvature.signum();
    let angle = (&x * side).atan2(&down * side);
    let distance = Expression::length(&[&x, &down]) * side;
    solid.substitute(&[("x", angle * radius), ("y", radius - distance)])
}

/// A point behind the plane is asked at its mirror image.
fn mirrored(solid: &Expression, normal: DVec3) -> Expression {
    let back = bodies::along(normal).min(0.0) * 2.0;
    let [x, y, z] = coordinates();
    solid.substitute(&[("x", x - &back * normal.x), ("y", y - &back * normal.y), ("z", z - &back * normal.z)])
}

fn direction(vector: DVec3) -> Result<DVec3, SolidError> {
    vector.try_normalize().ok_or(SolidError::Flat("a normal must have a direction"))
}

fn finite(name: &'static str, value: f64) -> Result<f64, SolidError> {
    let accepted = "a finite number";
    if value.is_finite() { Ok(value) } else { Err(SolidError::Number { name, value, accepted }) }
}

fn positive(name: &'static str, value: f64) -> Result<f64, SolidError> {
    let accepted = "a finite number above 0";
    if value.is_finite() && value > 0.0 {
        Ok(value)
    } else {
        Err(SolidError::Number { name, value, accepted })
    }
}

fn not_negative(name: &'static str, value: f64) -> Result<f64, SolidError> {
    let accepted = "a finite number from 0";
    if value.is_finite() && value >= 0.0 {
        Ok(value)
    } else {
        Err(SolidError::Number { name, value, accepted })
    }
}
