//! A cylinder between two half balls.

use super::MAX_DIVISIONS;
use super::circle::{around, on_circle};
use super::grid::{Grid, Sample};
use crate::PolygonMesh;

/// See [`super::Generator::Capsule`].
pub(super) fn capsule(radius: f32, height: f32, segments: u32, rings: u32, stacks: u32) -> PolygonMesh {
    let (segments, rings) = (segments.clamp(3, MAX_DIVISIONS), rings.clamp(1, MAX_DIVISIONS));
    let stacks = if height > 0.0 { stacks.clamp(1, MAX_DIVISIONS) } else { 0 };
    let (radius, height) = (f64::from(radius), f64::from(height.max(0.0)));
    Grid::ball(segments, 2 * rings + stacks).mesh(|column, row| {
        let turn = on_circle(column, segments);
        // How far up the straight part, and which row of the sphere that is left when it is taken out.
        let (part, ring) = match row {
            _ if row <= rings => (0.0, row),
            _ if row >= rings + stacks => (1.0, row - stacks),
            _ => (f64::from(row - rings) / f64::from(stacks), rings),
        };
        let latitude = on_circle(ring, 4 * rings);
        let normal = around(turn, latitude.y, -latitude.x);
        let lift = (part - 0.5) * height;
        Sample { position: around(turn, radius * latitude.y, lift - radius * latitude.x), normal }
    })
}
