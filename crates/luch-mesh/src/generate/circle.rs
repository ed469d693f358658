//! Points of circles, exact where it matters.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

/// The point of the unit circle `part / whole` of a turn around: (cos, sin), exact at the quarters.
pub(crate) fn on_circle(part: u32, whole: u32) -> DVec2 {
    // Count quarters in integers: the point at a quarter must not depend on how π is rounded.
    let quarters = 4 * u64::from(part % whole);
    let rest = (quarters % u64::from(whole)) as f64 / f64::from(whole) * (PI / 2.0);
    let (sin, cos) = (libm::sin(rest), libm::cos(rest));
    match quarters / u64::from(whole) {
        0 => DVec2::new(cos, sin),
        1 => DVec2::new(-sin, cos),
        2 => DVec2::new(-cos, -sin),
        _ => DVec2::new(sin, -cos),
    }
}

/// The point of the unit sphere at a column from +x over −z, of `columns`, and a row from the south pole to the north
/// pole, of `rows`.
pub(super) fn on_sphere(column: u32, columns: u32, row: u32, rows: u32) -> DVec3 {
    let latitude = on_circle(row, 2 * rows);
    around(on_circle(column, columns), latitude.y, -latitude.x)
}

/// The point at `radius` from the y axis in the direction `turn`, at height `y`. Turns run from +x over −z.
pub(crate) fn around(turn: DVec2, radius: f64, y: f64) -> DVec3 {
    DVec3::new(turn.x * radius, y, -turn.y * radius)
}
