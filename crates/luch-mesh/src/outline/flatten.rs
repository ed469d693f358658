//! Curves to points, by how far chords may lie off.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

/// The most pieces of one curve.
const MAX_PIECES: u32 = 4096;

/// How many pieces of an arc of `angle` stay within `tolerance`: the sagitta of a piece is r (1 − cos ½ a).
pub(super) fn arc_pieces(radius: f64, angle: f64, tolerance: f64) -> u32 {
    let cosine = 1.0 - tolerance / radius;
    let piece = if cosine > 0.0 { 2.0 * libm::acos(cosine.min(1.0)) } else { PI / 2.0 };
    whole(angle.abs() / piece.min(PI / 2.0))
}

/// Pieces enough for a Bezier curve whose largest second difference of control points is `bend`: its chords then lie
/// within `tolerance` (Wang 1984; with degree d, n² = d (d − 1) bend / 8 tolerance).
fn bezier_pieces(degree: f64, bend: f64, tolerance: f64) -> u32 {
    whole((degree * (degree - 1.0) * bend / (8.0 * tolerance)).sqrt())
}

fn whole(pieces: f64) -> u32 {
    // A cast takes what is too large, or no number, to the ends.
    (pieces.ceil() as u32).clamp(1, MAX_PIECES)
}

/// Adds the points of a quadratic Bezier curve after its first.
pub(super) fn quadratic([a, b, c]: [DVec2; 3], tolerance: f64, points: &mut Vec<DVec2>) {
    let pieces = bezier_pieces(2.0, (a - 2.0 * b + c).length(), tolerance);
    points.extend((1..pieces).map(|k| {
        let t = f64::from(k) / f64::from(pieces);
        a.lerp(b, t).lerp(b.lerp(c, t), t)
    }));
    points.push(c);
}

/// Adds the points of a cubic Bezier curve after its first.
pub(super) fn cubic([a, b, c, d]: [DVec2; 4], tolerance: f64, points: &mut Vec<DVec2>) {
    let bend = (a - 2.0 * b + c).length().max((b - 2.0 * c + d).length());
    let pieces = bezier_pieces(3.0, bend, tolerance);
    points.extend((1..pieces).map(|k| cubic_at([a, b, c, d].map(|p| p.extend(0.0)), k, pieces).truncate()));
    points.push(d);
}

fn cubic_at([a, b, c, d]: [DVec3; 4], piece: u32, pieces: u32) -> DVec3 {
    let t = f64::from(piece) / f64::from(pieces);
    let (ab, bc, cd) = (a.lerp(b, t), b.lerp(c, t), c.lerp(d, t));
    ab.lerp(bc, t).lerp(bc.lerp(cd, t), t)
}

/// The points of cubic Bezier curves in space, one after another: each takes three more control points, so there are
/// 3 n + 1 of them; those too many are left out. Chords stay within `tolerance`.
pub fn bezier_chain(controls: &[DVec3], tolerance: f64) -> Vec<DVec3> {
    let mut points: Vec<DVec3> = controls.first().copied().into_iter().collect();
    let mut start = 0;
    while let Some(&[a, b, c, d]) = controls.get(start..start + 4) {
        let bend = (a - 2.0 * b + c).length().max((b - 2.0 * c + d).length());
        let pieces = bezier_pieces(3.0, bend, tolerance);
        points.extend((1..pieces).map(|k| cubic_at([a, b, c, d], k, pieces)));
        points.push(d);
        start += 3;
    }
    points
}

/// An arc of an ellipse as SVG gives it: from a point, to a point, with radii, a tilt and two choices.
#[derive(Clone, Copy, Debug)]
pub(super) struct EndpointArc {
    pub from: DVec2,
    pub to: DVec2,
    pub radii: DVec2,
    /// Angle of the first radius to the x axis, in radians.
    pub tilt: f64,
    /// The longer way around.
    pub is_large: bool,
    /// In the direction in which angles grow.
    pub is_positive: bool,
}

impl EndpointArc {
    /// Adds its points after the first (SVG 2, appendix B.2.4 and B.2.5).
    pub(super) fn flatten(&self, tolerance: f64, points: &mut Vec<DVec2>) {
        let radii = self.radii.abs();
        if self.from == self.to {
            return;
        }
        if radii.min_element() == 0.0 {
            points.push(self.to);
            return;
        }
        let tilt = DVec2::new(libm::cos(self.tilt), libm::sin(self.tilt));
        let half = DVec2::new(tilt.x, -tilt.y).rotate((self.from - self.to) / 2.0);
        // Radii that do not reach are enlarged.
        let stretch = (half / radii).length().max(1.0);
        let radii = radii * stretch;
        let on_unit = half / radii;
        let off = (1.0 / on_unit.length_squared() - 1.0).max(0.0).sqrt();
        let sign = if self.is_large == self.is_positive { -1.0 } else { 1.0 };
        let centre = DVec2::new(on_unit.y, -on_unit.x) * (off * sign);
        let (start, end) = (on_unit - centre, -on_unit - centre);
        let angle = |v: DVec2| libm::atan2(v.y, v.x);
        let mut sweep = angle(end) - angle(start);
        if self.is_positive && sweep < 0.0 {
            sweep += 2.0 * PI;
        } else if !self.is_positive && sweep > 0.0 {
            sweep -= 2.0 * PI;
        }
        let middle = (self.from + self.to) / 2.0 + tilt.rotate(centre * radii);
        let pieces = arc_pieces(radii.max_element(), sweep, tolerance);
        points.extend((1..pieces).map(|k| {
            let turn = angle(start) + sweep * f64::from(k) / f64::from(pieces);
            middle + tilt.rotate(DVec2::new(libm::cos(turn), libm::sin(turn)) * radii)
        }));
        points.push(self.to);
    }
}
