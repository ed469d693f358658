//! Bodies between two outlines.

use std::f64::consts::PI;

use glam::DVec2;

use super::skin::{PlaneMap, Skin, Wall, shares};
use super::{Outline, OutlineError, Stand, check, check_faces, check_positive};
use crate::PolygonMesh;

/// How the outline at the bottom becomes the one at the top: point by point, along straight lines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loft {
    /// Length of the body, half of it on either side of the plane.
    pub height: f64,
    /// Pieces along the height.
    pub layers: u32,
    /// With both ends.
    pub capped: bool,
    /// Edges bent by more than this are hard, in radians.
    pub crease_angle: f64,
    /// How the outlines stand.
    pub stand: Stand,
}

impl Default for Loft {
    fn default() -> Self {
        Self { height: 1.0, layers: 1, capped: true, crease_angle: PI / 6.0, stand: Stand::Lying }
    }
}

impl Loft {
    /// The body between two outlines with as many holes and as many points on each border.
    pub fn between(&self, bottom: &Outline, top: &Outline) -> Result<PolygonMesh, OutlineError> {
        check(std::slice::from_ref(bottom))?;
        check(std::slice::from_ref(top))?;
        check_positive("the height", self.height)?;
        let lengths = |outline: &Outline| outline.loops().map(Vec::len).collect::<Vec<_>>();
        let (lower, upper) = (lengths(bottom), lengths(top));
        for border in 0..lower.len().max(upper.len()) {
            let [first, second] = [&lower, &upper].map(|lengths| lengths.get(border).copied().unwrap_or(0));
            if first != second {
                return Err(OutlineError::Unequal { border, first, second });
            }
        }
        let layers = self.layers.clamp(1, 1 << 16);
        check_faces(bottom.point_count() as u64 * u64::from(layers))?;
        let parts: Vec<f64> = (0..=layers).map(|k| f64::from(k) / f64::from(layers)).collect();
        let mut skin = Skin::default();
        let mut ends = [Vec::new(), Vec::new()];
        for (below, above) in bottom.loops().zip(top.loops()) {
            let mut rows: Vec<Vec<u32>> = Vec::with_capacity(parts.len());
            for part in &parts {
                let place = |(a, b): (&DVec2, &DVec2)| {
                    self.stand.place(a.lerp(*b, *part).extend((part - 0.5) * self.height))
                };
                rows.push(below.iter().zip(above).map(|pair| skin.position(place(pair))).collect());
            }
            let across = shares(below, true, |a: DVec2, b: DVec2| a.distance(b));
            skin.wall(&Wall { rows: &rows, is_ring: true, across: &across, along: &parts });
            ends[0].push(rows[0].clone());
            ends[1].push(rows[rows.len() - 1].clone());
        }
        if self.capped {
            let whole = [bottom.clone(), top.clone()];
            let map = PlaneMap::of(&whole);
            skin.cap(&ends[0], bottom, &map, true);
            skin.cap(&ends[1], top, &map, false);
        }
        Ok(skin.finish(self.crease_angle))
    }
}
