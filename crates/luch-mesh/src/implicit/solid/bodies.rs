//! Distances of simple bodies as expressions.

use glam::DVec3;
use luch_formula::Expression;

use super::Ball;

/// The variables.
pub(super) fn coordinates() -> [Expression; 3] {
    ["x", "y", "z"].map(Expression::variable)
}

/// Distance from the set where all parts are negative, if each is the distance from one of its sides and the sides meet at right
/// angles.
///
/// Outside, the length of the positive parts; inside, the greatest. The two are kept apart by a choice, so that the derivative
/// is defined on the surface, where the length is zero.
fn within_sides(parts: &[Expression]) -> Expression {
    let greatest = Expression::greatest(parts);
    let positive: Vec<Expression> = parts.iter().map(|part| part.max(0.0)).collect();
    let length = Expression::length(&positive.iter().collect::<Vec<_>>());
    greatest.max(0.0).select(&length, &greatest)
}

pub(super) fn sphere(radius: f64) -> Expression {
    let [x, y, z] = coordinates();
    Expression::length(&[&x, &y, &z]) - radius
}

pub(super) fn cuboid(size: DVec3, rounding: f64) -> Expression {
    let rounding = rounding.min(size.min_element() / 2.0);
    let half = size / 2.0 - rounding;
    let coordinates = coordinates();
    let sides: Vec<Expression> = (0..3).map(|axis| coordinates[axis].abs() - half[axis]).collect();
    within_sides(&sides) - rounding
}

pub(super) fn cylinder(radius: f64, height: f64) -> Expression {
    let [x, y, z] = coordinates();
    within_sides(&[Expression::length(&[&x, &z]) - radius, y.abs() - 0.5 * height])
}

pub(super) fn capsule(radius: f64, height: f64) -> Expression {
    let [x, y, z] = coordinates();
    let past = (y.abs() - 0.5 * height).max(0.0);
    Expression::length(&[&x, &past, &z]) - radius
}

pub(super) fn torus(major_radius: f64, minor_radius: f64) -> Expression {
    let [x, y, z] = coordinates();
    Expression::length(&[&(Expression::length(&[&x, &z]) - major_radius), &y]) - minor_radius
}

/// `normal` is a unit vector.
pub(super) fn half_space(normal: DVec3, distance: f64) -> Expression {
    along(normal) - distance
}

/// How far a point is along a direction.
pub(super) fn along(direction: DVec3) -> Expression {
    let [x, y, z] = coordinates();
    x * direction.x + y * direction.y + z * direction.z
}

/// The function over the length of its gradient: the distance to the first order.
pub(super) fn gyroid(period: f64, thickness: f64) -> Expression {
    let turns = std::f64::consts::TAU / period;
    let scaled = coordinates().map(|coordinate| coordinate * turns);
    let [sx, sy, sz] = [0, 1, 2].map(|axis| scaled[axis].sin());
    let [cx, cy, cz] = [0, 1, 2].map(|axis| scaled[axis].cos());
    let value = &sx * &cy + &sy * &cz + &sz * &cx;
    let by_x = &cx * &cy - &sz * &sx;
    let by_y = &cy * &cz - &sx * &sy;
    let by_z = &cz * &cx - &sy * &sz;
    let distance = value / (Expression::length(&[&by_x, &by_y, &by_z]) * turns);
    if thickness > 0.0 { distance.shell(thickness) } else { distance }
}

pub(super) fn metaballs(balls: &[Ball]) -> Expression {
    let parts: Vec<Expression> = balls
        .iter()
        .map(|ball| {
            let from: Vec<Expression> = (0..3)
                .map(|axis| {
                    (&coordinates()[axis] - ball.center[axis]).squared() / (ball.radius * ball.radius)
                })
                .collect();
            (1.0 - Expression::sum(&from)).max(0.0).pow(3.0)
        })
        .collect();
    0.5 - Expression::sum(&parts)
}
