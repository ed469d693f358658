//! Loops that cut a surface in its parameter plane, as chains of short segments.

use glam::DVec2;

use super::bezier::curve_point;
use super::{Curve, PatchError};

/// Which part of a surface is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keeps {
    /// What an odd number of loops encloses.
    Inside,
    /// What an even number of loops encloses: the loops are holes.
    Outside,
}

/// A closed chain of curves in the parameter plane: x is u, y is v, z counts nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct TrimLoop {
    /// The curves, each beginning where the one before ends; the last ends where the first begins.
    pub curves: Vec<Curve>,
}

/// What of a surface is there. Loops may lie in one another but not cross.
#[derive(Clone, Debug, PartialEq)]
pub struct Trimming {
    /// The loops, in either direction.
    pub loops: Vec<TrimLoop>,
    /// Which side of them counts.
    pub keeps: Keeps,
}

impl From<Curve> for TrimLoop {
    fn from(curve: Curve) -> Self {
        Self { curves: vec![curve] }
    }
}

/// What segments of a loop must not exceed, in parameters.
pub(super) struct Steps {
    /// The longest along u and v.
    pub(super) longest: DVec2,
    /// Bounds of the surface's derivatives along u and v.
    pub(super) speed: DVec2,
    /// How far the surface over a segment may be from that over the curve, in metres; infinite if it does not count.
    pub(super) tolerance: f64,
    /// At most so many segments in all.
    pub(super) most: u64,
}

impl TrimLoop {
    /// Corner after corner; the last is joined to the first. `None` if the loop is open; too many corners are an error.
    pub(super) fn polyline(
        &self,
        steps: &Steps,
        domain: [DVec2; 2],
    ) -> Result<Option<Vec<DVec2>>, PatchError> {
        let mut corners: Vec<DVec2> = Vec::new();
        let [low, high] = domain;
        // Ends that should meet may differ by rounding.
        let gap = (high - low).max_element() * 1e-9;
        let mut start = None;
        let mut end: Option<DVec2> = None;
        for curve in &self.curves {
            for points in curve.pieces() {
                let places: Vec<DVec2> = points.iter().map(|p| p.truncate().truncate() / p.w).collect();
                if end.is_some_and(|end| end.distance(places[0]) > gap) {
                    return Ok(None);
                }
                start.get_or_insert(places[0]);
                end = places.last().copied();
                let count = segments(&points, &places, steps);
                if corners.len() as u64 + count > steps.most {
                    return Err(PatchError::TooFine { count: corners.len() as u64 + count });
                }
                corners.extend((0..count).map(|k| {
                    let place = curve_point(&points, k as f64 / count as f64);
                    place.truncate().clamp(low, high)
                }));
            }
        }
        let closed = matches!((start, end), (Some(start), Some(end)) if start.distance(end) <= gap);
        corners.dedup();
        while corners.len() > 1 && corners.first() == corners.last() {
            corners.pop();
        }
        Ok(closed.then_some(corners))
    }
}

/// How many segments a Bezier piece needs.
fn segments(points: &[glam::DVec4], places: &[DVec2], steps: &Steps) -> u64 {
    let degree = (points.len() - 1) as f64;
    // Weights slow a curve down at one end and hurry it at the other, by no more than their ratio.
    let [least, most] = [f64::min as fn(f64, f64) -> f64, f64::max]
        .map(|pick| points.iter().map(|p| p.w).reduce(pick).unwrap_or(1.0));
    let ratio = most / least;
    let largest = |list: &mut dyn Iterator<Item = DVec2>| {
        list.fold(DVec2::ZERO, |most, difference| most.max(difference.abs()))
    };
    let first = largest(&mut places.windows(2).map(|pair| pair[1] - pair[0])) * (degree * ratio * ratio);
    let centre = places.iter().sum::<DVec2>() / places.len() as f64;
    let shifted: Vec<_> = points.iter().map(|p| ((p.truncate().truncate() - centre * p.w), p.w)).collect();
    let second = if points.len() < 3 && ratio == 1.0 {
        DVec2::ZERO
    } else {
        // The quotient rule, as for surfaces.
        let radius = largest(&mut places.iter().map(|place| *place - centre));
        let speed_of_weight = degree * points.windows(2).map(|p| (p[1].w - p[0].w).abs()).fold(0.0, f64::max);
        let factor = degree * (degree - 1.0);
        let bend = largest(&mut shifted.windows(3).map(|p| p[2].0 - p[1].0 * 2.0 + p[0].0)) * factor;
        let bend_of_weight =
            factor * points.windows(3).map(|p| (p[2].w - 2.0 * p[1].w + p[0].w).abs()).fold(0.0, f64::max);
        (bend + first * (2.0 * speed_of_weight) + radius * bend_of_weight) / least
    };
    let by_length = (first / steps.longest).max_element();
    let by_bend = (steps.speed.dot(second) / (8.0 * steps.tolerance)).sqrt();
    by_length.max(by_bend).ceil().max(1.0) as u64
}
