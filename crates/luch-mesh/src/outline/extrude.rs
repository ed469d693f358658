//! Outlines pulled up.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use super::offset::inset;
use super::skin::{PlaneMap, Skin, Wall, shares};
use super::{Outline, OutlineError, check, check_faces, check_positive};
use crate::PolygonMesh;

/// How an outline stands in space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Stand {
    /// It lies on the ground, its y along −z; the body grows along +y.
    #[default]
    Lying,
    /// It stands, its y along +y; the body grows along +z. Text is read from there.
    Upright,
}

impl Stand {
    /// A point of the plane, with its height over it in z, in space. Both are rotations.
    pub(super) fn place(self, point: DVec3) -> DVec3 {
        match self {
            Self::Lying => DVec3::new(point.x, point.z, -point.y),
            Self::Upright => point,
        }
    }
}

/// How outlines become bodies between two parallel planes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extrusion {
    /// Length of the body, half of it on either side of the plane.
    pub height: f64,
    /// How far the upper end is turned, counter-clockwise seen from above, in radians.
    pub twist: f64,
    /// The size of the upper end over that of the lower; above 0.
    pub top_scale: f64,
    /// Pieces along the height, at least 1. A twist needs several.
    pub layers: u32,
    /// With both ends.
    pub capped: bool,
    /// How far the edges of the ends are cut off, at 45°; 0 for not at all.
    pub bevel: f64,
    /// Edges bent by more than this are hard, in radians.
    pub crease_angle: f64,
    /// How the outline stands.
    pub stand: Stand,
}

impl Default for Extrusion {
    fn default() -> Self {
        Self {
            height: 1.0,
            twist: 0.0,
            top_scale: 1.0,
            layers: 1,
            capped: true,
            bevel: 0.0,
            crease_angle: PI / 6.0,
            stand: Stand::Lying,
        }
    }
}

/// A cut through the body: which outline, and how high.
struct Layer {
    is_inset: bool,
    /// From 0 to 1.
    part: f64,
}

impl Extrusion {
    /// The bodies of outlines, one piece each.
    pub fn of(&self, outlines: &[Outline]) -> Result<PolygonMesh, OutlineError> {
        check(outlines)?;
        check_positive("the height", self.height)?;
        check_positive("the scale at the top", self.top_scale)?;
        if !self.twist.is_finite() {
            return Err(OutlineError::OutOfRange {
                name: "the twist",
                found: self.twist,
                expected: "a number",
            });
        }
        let layers = self.layers();
        let points: usize = outlines.iter().map(Outline::point_count).sum();
        check_faces(points as u64 * layers.len() as u64)?;
        if !(0.0..self.height / 2.0).contains(&self.bevel) {
            let expected = "from 0 to less than half the height";
            return Err(OutlineError::OutOfRange { name: "the bevel", found: self.bevel, expected });
        }
        let mut skin = Skin::default();
        let map = PlaneMap::of(outlines);
        for outline in outlines {
            let smaller = if self.bevel > 0.0 { inset(outline, self.bevel)? } else { outline.clone() };
            self.add(&mut skin, outline, &smaller, &layers, &map);
        }
        Ok(skin.finish(self.crease_angle))
    }

    fn layers(&self) -> Vec<Layer> {
        let count = self.layers.clamp(1, 1 << 16);
        let even = |k: u32| f64::from(k) / f64::from(count);
        if self.bevel <= 0.0 {
            return (0..=count).map(|k| Layer { is_inset: false, part: even(k) }).collect();
        }
        let share = self.bevel / self.height;
        let mut layers = vec![Layer { is_inset: true, part: 0.0 }];
        layers.extend(
            (0..=count).map(|k| Layer { is_inset: false, part: share + (1.0 - 2.0 * share) * even(k) }),
        );
        layers.push(Layer { is_inset: true, part: 1.0 });
        layers
    }

    fn add(&self, skin: &mut Skin, outline: &Outline, smaller: &Outline, layers: &[Layer], map: &PlaneMap) {
        let parts: Vec<f64> = layers.iter().map(|layer| layer.part).collect();
        let mut ends = [Vec::new(), Vec::new()];
        for (border, inset) in outline.loops().zip(smaller.loops()) {
            let rows: Vec<Vec<u32>> = layers
                .iter()
                .map(|layer| {
                    let points = if layer.is_inset { inset } else { border };
                    let turn = turn_by(self.twist * layer.part);
                    let scale = 1.0 + (self.top_scale - 1.0) * layer.part;
                    let height = (layer.part - 0.5) * self.height;
                    let place = |p: &DVec2| self.stand.place((turn.rotate(*p) * scale).extend(height));
                    points.iter().map(|p| skin.position(place(p))).collect()
                })
                .collect();
            let across = shares(border, true, |a: DVec2, b: DVec2| a.distance(b));
            skin.wall(&Wall { rows: &rows, is_ring: true, across: &across, along: &parts });
            ends[0].push(rows[0].clone());
            ends[1].push(rows[rows.len() - 1].clone());
        }
        if self.capped {
            skin.cap(&ends[0], smaller, map, true);
            skin.cap(&ends[1], smaller, map, false);
        }
    }
}

/// The unit vector at an angle to +x.
pub(super) fn turn_by(angle: f64) -> DVec2 {
    DVec2::new(libm::cos(angle), libm::sin(angle))
}
