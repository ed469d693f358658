//! Exact round bodies as rational surfaces: circle, cylinder, cone, disc, sphere, torus.
//!
//! A quarter circle is a rational Bezier curve of degree 2 with weights 1, √½, 1; four of them with double knots make
//! the circle (Piegl and Tiller 1997, section 7.3). All bodies stand upright around +Y, as the generators do.

use glam::{DVec2, DVec3};

use super::{ControlPoint, Curve, Knots, PatchError, PatchModel, Surface};

/// The nine points of a full turn in the plane, with their weights.
struct Turn {
    places: [DVec2; 9],
    weights: [f64; 9],
    knots: Knots,
}

fn full_turn() -> Result<Turn, PatchError> {
    let corners = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)];
    let slant = 0.5f64.sqrt();
    let knots = vec![0.0, 0.0, 0.0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1.0, 1.0, 1.0];
    Ok(Turn {
        places: corners.map(|(x, y)| DVec2::new(f64::from(x), f64::from(y))),
        weights: std::array::from_fn(|i| if i % 2 == 0 { 1.0 } else { slant }),
        knots: Knots::new(2, knots)?,
    })
}

/// A circle of `radius` in the xz plane around the origin, from +x over −z: counter-clockwise seen from above.
///
/// # Errors
/// If the radius is out of range.
pub fn circle(radius: f64) -> Result<Curve, PatchError> {
    let turn = full_turn()?;
    let points: Vec<_> = turn
        .places
        .iter()
        .zip(turn.weights)
        .map(|(p, weight)| ControlPoint::weighted(DVec3::new(p.x, 0.0, -p.y) * radius, weight))
        .collect();
    Curve::new(turn.knots, &points)
}

/// A circle in the parameter plane, counter-clockwise: a loop to trim with.
///
/// # Errors
/// If a number is out of range.
pub fn circle_in_plane(centre: DVec2, radius: f64) -> Result<Curve, PatchError> {
    let turn = full_turn()?;
    let points: Vec<_> = turn
        .places
        .iter()
        .zip(turn.weights)
        .map(|(p, weight)| ControlPoint::weighted((centre + *p * radius).extend(0.0), weight))
        .collect();
    Curve::new(turn.knots, &points)
}

/// Turns a profile around the y axis: u runs around from +x over −z, v along the profile, whose points are (distance from
/// the axis, height). A profile that rises outside the axis gives a surface that faces outward.
///
/// # Errors
/// If a number is out of range.
pub fn revolved(profile_knots: Knots, profile: &[ControlPoint]) -> Result<Surface, PatchError> {
    let turn = full_turn()?;
    let mut points = Vec::with_capacity(profile.len().saturating_mul(9));
    for point in profile {
        for (place, weight) in turn.places.iter().zip(turn.weights) {
            let DVec3 { x: radius, y: height, .. } = point.position;
            let position = DVec3::new(place.x * radius, height, -place.y * radius);
            points.push(ControlPoint::weighted(position, weight * point.weight));
        }
    }
    Surface::new([turn.knots, profile_knots], &points)
}

/// A sphere around the origin: u around, v from the south pole to the north pole. Both poles are sides that are points.
///
/// # Errors
/// If the radius is out of range.
pub fn sphere(radius: f64) -> Result<Surface, PatchError> {
    let slant = 0.5f64.sqrt();
    let profile = [(0.0, -1.0, 1.0), (1.0, -1.0, slant), (1.0, 0.0, 1.0), (1.0, 1.0, slant), (0.0, 1.0, 1.0)];
    let points = profile.map(|(x, y, weight)| ControlPoint::weighted(DVec3::new(x, y, 0.0) * radius, weight));
    revolved(Knots::new(2, vec![0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.0])?, &points)
}

/// A torus around the y axis: `major` from the centre to the middle of the tube, `minor` the radius of the tube.
///
/// # Errors
/// If a radius is out of range.
pub fn torus(major: f64, minor: f64) -> Result<Surface, PatchError> {
    let turn = full_turn()?;
    let points: Vec<_> = turn
        .places
        .iter()
        .zip(turn.weights)
        .map(|(p, weight)| ControlPoint::weighted(DVec3::new(major + p.x * minor, p.y * minor, 0.0), weight))
        .collect();
    revolved(turn.knots, &points)
}

/// A cylinder with both ends closed, as three surfaces with common circles.
///
/// # Errors
/// If a measure is out of range.
pub fn cylinder(radius: f64, height: f64) -> Result<PatchModel, PatchError> {
    let place = |x: f64, y: f64| ControlPoint::new(DVec3::new(x * radius, y * height / 2.0, 0.0));
    let line = || Knots::bezier(1);
    let bottom = revolved(line()?, &[place(0.0, -1.0), place(1.0, -1.0)])?;
    let side = revolved(line()?, &[place(1.0, -1.0), place(1.0, 1.0)])?;
    let top = revolved(line()?, &[place(1.0, 1.0), place(0.0, 1.0)])?;
    Ok(PatchModel::from_iter([bottom, side, top]))
}
