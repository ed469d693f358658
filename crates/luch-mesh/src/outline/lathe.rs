//! Profiles turned around the y axis.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

use super::extrude::turn_by;
use super::skin::{PlaneMap, Skin, Wall, shares};
use super::{MAX_POINTS, Outline, OutlineError, check, check_faces, check_positive, is_usable, signed_area};
use crate::PolygonMesh;
use crate::generate::MAX_DIVISIONS;
use crate::generate::circle::{around, on_circle};

/// How a profile is turned: its x is the distance from the axis, its y the height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lathe {
    /// How far, from +x over −z, in radians; a full turn or more closes the body.
    pub angle: f64,
    /// Pieces of the turn.
    pub segments: u32,
    /// With both ends, where the turn is not full.
    pub capped: bool,
    /// Edges bent by more than this are hard, in radians.
    pub crease_angle: f64,
}

impl Default for Lathe {
    fn default() -> Self {
        Self { angle: TAU, segments: 64, capped: true, crease_angle: PI / 6.0 }
    }
}

impl Lathe {
    /// The bodies that outlines sweep out. Points on the axis are one position for the whole turn, and edges on it make
    /// no surface.
    pub fn of(&self, outlines: &[Outline]) -> Result<PolygonMesh, OutlineError> {
        check(outlines)?;
        let mut skin = Skin::default();
        let map = PlaneMap::of(outlines);
        let points: usize = outlines.iter().map(Outline::point_count).sum();
        self.check(points)?;
        for outline in outlines {
            let mut rings = Vec::new();
            for border in outline.loops() {
                rings.push(self.turned(&mut skin, border, true)?);
            }
            if self.capped && !self.is_full() {
                let end = |column: usize| -> Vec<Vec<u32>> {
                    rings.iter().map(|rows| rows.iter().map(|row| row[column]).collect()).collect()
                };
                skin.cap(&end(0), outline, &map, false);
                skin.cap(&end(self.segments() as usize), outline, &map, true);
            }
        }
        Ok(skin.finish(self.crease_angle))
    }

    /// The surface that a line sweeps out. It is closed if the turn is full and both ends lie on the axis, or the last
    /// point is the first. It faces outward.
    pub fn of_line(&self, line: &[DVec2]) -> Result<PolygonMesh, OutlineError> {
        if line.len() > MAX_POINTS {
            return Err(OutlineError::TooManyPoints { count: line.len(), most: MAX_POINTS });
        }
        if let Some(&point) = line.iter().find(|p| !is_usable(**p)) {
            return Err(OutlineError::NotFinite { point });
        }
        let mut points: Vec<DVec2> = line.iter().map(|p| p.as_vec2().as_dvec2()).collect();
        points.dedup();
        let is_ring = points.len() > 3 && points.first() == points.last();
        if is_ring {
            points.pop();
        }
        if points.len() < 2 {
            return Err(OutlineError::ShortPath { count: points.len(), least: 2 });
        }
        self.check(points.len())?;
        // Outward is where the enclosed volume is positive: ∫ r² dy.
        let volume: f64 =
            points.windows(2).map(|p| (p[1].y - p[0].y) * (p[0] * p[0] + p[0] * p[1] + p[1] * p[1]).x).sum();
        let outward = if is_ring { signed_area(&points) } else { volume };
        if outward < 0.0 {
            points.reverse();
        }
        let mut skin = Skin::default();
        self.turned(&mut skin, &points, is_ring)?;
        Ok(skin.finish(self.crease_angle))
    }

    fn is_full(&self) -> bool {
        self.angle >= TAU - 1e-9
    }

    fn segments(&self) -> u32 {
        self.segments.clamp(if self.is_full() { 3 } else { 1 }, MAX_DIVISIONS)
    }

    fn check(&self, points: usize) -> Result<(), OutlineError> {
        check_positive("the angle", self.angle)?;
        check_faces(points as u64 * u64::from(self.segments()))
    }

    /// Adds the surface of a line and returns its rows of positions, one for each point.
    fn turned(&self, skin: &mut Skin, line: &[DVec2], is_ring: bool) -> Result<Vec<Vec<u32>>, OutlineError> {
        if let Some(&point) = line.iter().find(|p| p.x < 0.0) {
            return Err(OutlineError::BehindAxis { point });
        }
        let segments = self.segments();
        let is_full = self.is_full();
        let columns = segments + u32::from(!is_full);
        let turns: Vec<DVec2> = (0..columns)
            .map(|k| match is_full {
                true => on_circle(k, segments),
                false => turn_by(self.angle * f64::from(k) / f64::from(segments)),
            })
            .collect();
        let mut rows: Vec<Vec<u32>> = Vec::with_capacity(line.len());
        for point in line {
            let row = if point.x == 0.0 {
                vec![skin.position(around(DVec2::X, 0.0, point.y)); columns as usize]
            } else {
                turns.iter().map(|&turn| skin.position(around(turn, point.x, point.y))).collect()
            };
            rows.push(row);
        }
        let along = shares(line, is_ring, |a: DVec2, b: DVec2| a.distance(b));
        let across: Vec<f64> = (0..=segments).map(|k| f64::from(k) / f64::from(segments)).collect();
        let mut walls = rows.clone();
        if is_ring {
            walls.push(rows[0].clone());
        }
        skin.wall(&Wall { rows: &walls, is_ring: is_full, across: &across, along: &along });
        Ok(rows)
    }
}
