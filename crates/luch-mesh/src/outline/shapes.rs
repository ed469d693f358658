//! Borders of plain forms, counter-clockwise around the origin.

use std::f64::consts::PI;

use glam::DVec2;

use super::OutlineError;
use super::flatten::arc_pieces;
use crate::generate::circle::on_circle;

/// The most points of one form.
const MAX_PIECES: u32 = 4096;

/// A regular polygon with its first corner on +x, `radius` from the centre.
pub fn polygon(sides: u32, radius: f64) -> Vec<DVec2> {
    let sides = sides.clamp(3, MAX_PIECES);
    (0..sides).map(|k| on_circle(k, sides) * radius).collect()
}

/// An ellipse in so many pieces; a circle if both radii are alike.
pub fn ellipse(radii: DVec2, pieces: u32) -> Vec<DVec2> {
    polygon(pieces, 1.0).into_iter().map(|p| p * radii).collect()
}

/// How many pieces keep a circle within `tolerance` of the true one.
pub fn circle_pieces(radius: f64, tolerance: f64) -> u32 {
    arc_pieces(radius, 2.0 * PI, tolerance).max(8)
}

/// A star: tips at `outer` from the centre, the first on +y, and corners between them at `inner`.
pub fn star(tips: u32, outer: f64, inner: f64) -> Vec<DVec2> {
    let tips = tips.clamp(2, MAX_PIECES / 2);
    let radius = |k: u32| if k.is_multiple_of(2) { outer } else { inner };
    (0..2 * tips).map(|k| on_circle(k, 2 * tips).perp() * radius(k)).collect()
}

/// A rectangle.
pub fn rectangle(size: DVec2) -> Vec<DVec2> {
    let corners = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)];
    corners.map(|corner| DVec2::from(corner) * size).into()
}

/// A rectangle whose corners are quarters of a circle in so many pieces each; half the shorter side is the largest
/// radius.
pub fn rounded_rectangle(size: DVec2, radius: f64, pieces: u32) -> Vec<DVec2> {
    let radius = radius.min(size.min_element() / 2.0);
    if radius <= 0.0 {
        return rectangle(size);
    }
    let pieces = pieces.clamp(1, MAX_PIECES / 4);
    let mut points = Vec::new();
    let signs = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
    for (quarter, sign) in (0..).zip(signs) {
        let centre = DVec2::from(sign) * (size / 2.0 - radius);
        let turns = (0..=pieces).map(|k| on_circle(quarter * pieces + k, 4 * pieces));
        points.extend(turns.map(|turn| centre + turn * radius));
    }
    points
}

/// A spur gear with involute teeth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gear {
    /// How many teeth, from 4.
    pub teeth: u32,
    /// The pitch diameter over the number of teeth.
    pub module: f64,
    /// Pressure angle, in radians; 20° is usual.
    pub pressure_angle: f64,
    /// Pieces of a flank.
    pub pieces: u32,
}

impl Gear {
    /// The border: tips one module above the pitch circle, roots 1¼ below it; teeth as wide as gaps on the pitch circle.
    /// The first tooth points along +x. Below the base circle flanks are radial: no undercut is made.
    pub fn border(&self) -> Result<Vec<DVec2>, OutlineError> {
        let out_of_range = |name, found, expected| Err(OutlineError::OutOfRange { name, found, expected });
        if !(4..=MAX_PIECES / 4).contains(&self.teeth) {
            return out_of_range("the number of teeth", f64::from(self.teeth), "4 to 1024");
        }
        if !(0.0..=0.7).contains(&self.pressure_angle) {
            return out_of_range("the pressure angle", self.pressure_angle, "0 to 0.7 (40°)");
        }
        let pieces = self.pieces.clamp(1, 64);
        let pitch = self.module * f64::from(self.teeth) / 2.0;
        let base = pitch * libm::cos(self.pressure_angle);
        let (tip, root) = (pitch + self.module, pitch - 1.25 * self.module);
        let involute = |angle: f64| libm::tan(angle) - angle;
        // Half the angle that a tooth takes at a radius.
        let half = |radius: f64| {
            let pressure = libm::acos((base / radius).min(1.0));
            PI / (2.0 * f64::from(self.teeth)) + involute(self.pressure_angle) - involute(pressure)
        };
        if half(tip) <= 0.0 {
            return out_of_range("the pressure angle", self.pressure_angle, "less: these teeth have no top");
        }
        let foot = base.max(root);
        let at = |radius: f64, angle: f64| DVec2::new(libm::cos(angle), libm::sin(angle)) * radius;
        let mut points = Vec::new();
        for tooth in 0..self.teeth {
            let middle = f64::from(tooth) / f64::from(self.teeth) * 2.0 * PI;
            let mut flank = Vec::new();
            if root < foot {
                flank.push([root, half(foot)]);
            }
            // Even steps along the line of action: finer where the flank bends more.
            let roll = |radius: f64| (radius * radius - base * base).max(0.0).sqrt();
            for k in 0..=pieces {
                let part = f64::from(k) / f64::from(pieces);
                let length = roll(foot) + (roll(tip) - roll(foot)) * part;
                let radius = (base * base + length * length).sqrt();
                flank.push([radius, half(radius)]);
            }
            points.extend(flank.iter().map(|&[radius, half]| at(radius, middle - half)));
            points.extend(flank.iter().rev().map(|&[radius, half]| at(radius, middle + half)));
        }
        Ok(points)
    }
}
