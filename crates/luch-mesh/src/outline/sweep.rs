//! Outlines carried along a path.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use super::extrude::turn_by;
use super::frames::{Frame, Station, carried};
use super::skin::{PlaneMap, Skin, Wall, shares};
use super::{MAX_COORDINATE, MAX_POINTS, Outline, OutlineError, check, check_faces, check_positive};
use crate::PolygonMesh;

/// How an outline is carried along a path: its origin on the path, square to it, up as long as the path allows, and then
/// turning no more than it must.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sweep {
    /// The path goes on from its last point to its first.
    pub is_closed: bool,
    /// How far the outline turns about the path on its way, counter-clockwise seen against the path, in radians. On a
    /// closed path whole turns only.
    pub twist: f64,
    /// The size of the outline at the end over that at the start; 1 on a closed path.
    pub end_scale: f64,
    /// Straight pieces keep their section up to the bends, as picture frames do; else the outline stands square to the
    /// middle direction at bends, and pieces between sharp ones grow thin.
    pub is_mitred: bool,
    /// With both ends, where the path is open.
    pub capped: bool,
    /// Edges bent by more than this are hard, in radians.
    pub crease_angle: f64,
}

impl Default for Sweep {
    fn default() -> Self {
        Self {
            is_closed: false,
            twist: 0.0,
            end_scale: 1.0,
            is_mitred: true,
            capped: true,
            crease_angle: PI / 6.0,
        }
    }
}

/// The plane of a section: where, how the outline lies in it, and along which direction it is slanted.
struct Section {
    station: Station,
    frame: Frame,
    /// The straight piece that is cut here, if it is cut at a slant.
    straight: Option<DVec3>,
}

impl Section {
    fn place(&self, point: DVec2) -> DVec3 {
        let aside = self.frame.right * point.x + self.frame.up * point.y;
        let Station { place, forward } = self.station;
        let Some(straight) = self.straight else { return place + aside };
        // Along the straight piece until the plane of the bend.
        place + aside - straight * (aside.dot(forward) / straight.dot(forward))
    }
}

impl Sweep {
    /// The bodies that outlines leave along a path.
    pub fn of(&self, outlines: &[Outline], path: &[DVec3]) -> Result<PolygonMesh, OutlineError> {
        check(outlines)?;
        let path = self.cleaned(path)?;
        self.check_measures()?;
        let count: usize = outlines.iter().map(Outline::point_count).sum();
        check_faces(count as u64 * (path.len() as u64 + 1))?;
        let sections = self.sections(&path)?;
        let along = shares(&path, self.is_closed, |a: DVec3, b: DVec3| a.distance(b));
        let scales: Vec<f64> = along.iter().map(|part| 1.0 + (self.end_scale - 1.0) * part).collect();
        let mut skin = Skin::default();
        let map = PlaneMap::of(outlines);
        for outline in outlines {
            let mut ends = [Vec::new(), Vec::new()];
            for border in outline.loops() {
                let mut rows: Vec<Vec<u32>> = Vec::with_capacity(sections.len() + 1);
                for (section, scale) in sections.iter().zip(&scales) {
                    rows.push(border.iter().map(|p| skin.position(section.place(*p * *scale))).collect());
                }
                ends[0].push(rows[0].clone());
                ends[1].push(rows[rows.len() - 1].clone());
                if self.is_closed {
                    rows.push(rows[0].clone());
                }
                let across = shares(border, true, |a: DVec2, b: DVec2| a.distance(b));
                skin.wall(&Wall { rows: &rows, is_ring: true, across: &across, along: &along });
            }
            if self.capped && !self.is_closed {
                skin.cap(&ends[0], outline, &map, true);
                skin.cap(&ends[1], outline, &map, false);
            }
        }
        Ok(skin.finish(self.crease_angle))
    }

    /// The path without points that repeat the one before.
    fn cleaned(&self, path: &[DVec3]) -> Result<Vec<DVec3>, OutlineError> {
        if path.len() > MAX_POINTS {
            return Err(OutlineError::TooManyPoints { count: path.len(), most: MAX_POINTS });
        }
        if let Some(point) = path.iter().find(|p| p.is_nan() || p.abs().max_element() > MAX_COORDINATE) {
            return Err(OutlineError::NotFinite { point: point.truncate() });
        }
        let mut points: Vec<DVec3> = path.iter().map(|p| p.as_vec3().as_dvec3()).collect();
        points.dedup();
        while self.is_closed && points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        let least = if self.is_closed { 3 } else { 2 };
        if points.len() < least {
            return Err(OutlineError::ShortPath { count: points.len(), least });
        }
        Ok(points)
    }

    fn check_measures(&self) -> Result<(), OutlineError> {
        let out_of_range = |name, found, expected| Err(OutlineError::OutOfRange { name, found, expected });
        check_positive("the scale at the end", self.end_scale)?;
        if !self.twist.is_finite() {
            return out_of_range("the twist", self.twist, "a number");
        }
        if self.is_closed && self.end_scale != 1.0 {
            return out_of_range("the scale at the end", self.end_scale, "1 on a closed path");
        }
        let turns = self.twist / TAU;
        if self.is_closed && (turns - turns.round()).abs() > 1e-6 {
            return out_of_range("the twist", self.twist, "whole turns (multiples of 2π) on a closed path");
        }
        Ok(())
    }

    fn sections(&self, path: &[DVec3]) -> Result<Vec<Section>, OutlineError> {
        let count = path.len();
        let pieces = if self.is_closed { count } else { count - 1 };
        let straights: Vec<DVec3> =
            (0..pieces).map(|k| (path[(k + 1) % count] - path[k]).normalize()).collect();
        let mut stations = Vec::with_capacity(count);
        for (k, &place) in path.iter().enumerate() {
            let before =
                if k > 0 { straights[k - 1] } else { straights[if self.is_closed { pieces - 1 } else { 0 }] };
            let after = straights[k.min(pieces - 1)];
            let middle = before + after;
            // |before + after| = 2 cos ½ bend: a mitre would be longer than twenty times the outline.
            let least = if self.is_mitred { 0.1 } else { 1e-6 };
            if middle.length() < least {
                return Err(OutlineError::TurnsBack { place });
            }
            stations.push(Station { place, forward: middle.normalize() });
        }
        // Mitred pieces carry their frame along themselves, and hand it over at the bends.
        let carriers: Vec<Station> = if self.is_mitred {
            let middle = |k: usize| (path[k] + path[(k + 1) % count]) / 2.0;
            (0..pieces).map(|k| Station { place: middle(k), forward: straights[k] }).collect()
        } else {
            stations.clone()
        };
        let mut frames = vec![Frame::at_start(carriers[0].forward)];
        for pair in carriers.windows(2) {
            let bent = if self.is_mitred { bend(pair[0], pair[1]) } else { pair[1] };
            frames.push(carried(frames[frames.len() - 1], pair[0], bent));
        }
        let lengths = shares(path, self.is_closed, |a: DVec3, b: DVec3| a.distance(b));
        let mut twist = self.twist;
        if self.is_closed {
            let last = carriers[carriers.len() - 1];
            let home = if self.is_mitred { bend(last, carriers[0]) } else { carriers[0] };
            let returned = carried(frames[frames.len() - 1], last, home);
            // What the frame has turned on the way round is given back evenly.
            twist += returned.angle_to(frames[0]);
        }
        let section = |k: usize| {
            let carrier = k.min(frames.len() - 1);
            Section {
                station: stations[k],
                frame: frames[carrier].turned(turn_by(twist * lengths[k])),
                straight: self.is_mitred.then(|| straights[carrier]),
            }
        };
        Ok((0..count).map(section).collect())
    }
}

/// The next straight piece as if it were a step ahead: carrying a frame there is the plain turn about the bend.
fn bend(from: Station, to: Station) -> Station {
    Station { place: from.place + from.forward, forward: to.forward }
}
