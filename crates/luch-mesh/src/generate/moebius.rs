//! Twisted bands.

use super::MAX_DIVISIONS;
use super::circle::{around, on_circle};
use super::grid::{Grid, Join, Sample};
use crate::PolygonMesh;

/// The most half turns of a band.
pub const MAX_HALF_TWISTS: u32 = 256;

/// See [`super::Generator::Moebius`].
pub(super) fn moebius(radius: f32, width: f32, half_twists: u32, segments: u32, stacks: u32) -> PolygonMesh {
    let (segments, stacks) = (segments.clamp(3, MAX_DIVISIONS), stacks.clamp(1, MAX_DIVISIONS));
    let half_twists = half_twists.min(MAX_HALF_TWISTS);
    let join = if half_twists % 2 == 1 { Join::Reversed } else { Join::Straight };
    let grid = Grid { columns: segments, rows: stacks, join, rows_joined: false, poles: [false; 2] };
    grid.mesh(|column, row| {
        let turn = on_circle(column, segments);
        // Around the middle line the band turns by half_twists · π.
        let tilt = on_circle(half_twists * column, 2 * segments);
        let aside = (0.5 - f64::from(row) / f64::from(stacks)) * f64::from(width);
        let distance = f64::from(radius) + aside * tilt.x;
        let across = around(turn, tilt.x, tilt.y);
        // The derivative around the axis has a part along the circle and one by the tilt; both are square to `across`.
        let rate = f64::from(half_twists) / 2.0;
        let along = glam::DVec3::new(-turn.y, 0.0, -turn.x) * distance
            + around(turn, -tilt.y, tilt.x) * (aside * rate);
        let position = around(turn, distance, aside * tilt.y);
        Sample { position, normal: across.cross(along).normalize_or(glam::DVec3::Y) }
    })
}
