//! Form factors and visible parts of lamps in closed form.
//!
//! A form factor is the part of the cosine-weighted hemisphere that a surface fills: under a lamp of radiance L the irradiance is πL times
//! that, and a Lambertian surface of albedo ρ shows ρL times that.

use glam::DVec3;
use std::f64::consts::PI;

/// Form factor of a polygon from a point with a normal, clipped at the horizon (Lambert 1760).
pub fn polygon(point: DVec3, normal: DVec3, corners: &[DVec3]) -> f64 {
    let height = |corner: DVec3| (corner - point).dot(normal);
    let mut above = Vec::new();
    for (i, &corner) in corners.iter().enumerate() {
        let next = corners[(i + 1) % corners.len()];
        let (here, there) = (height(corner), height(next));
        if here >= 0.0 {
            above.push((corner - point).normalize());
        }
        if here * there < 0.0 {
            above.push((corner + (next - corner) * (here / (here - there)) - point).normalize());
        }
    }
    let edge = |i: usize| {
        let (a, b) = (above[i], above[(i + 1) % above.len()]);
        let angle = libm::atan2(a.cross(b).length(), a.dot(b));
        a.cross(b).try_normalize().map_or(0.0, |across| angle * normal.dot(across))
    };
    (0..above.len()).map(edge).sum::<f64>().abs() / (2.0 * PI)
}

/// Form factor of a rectangle with one corner above the point, parallel to the receiver: its sides over its height.
pub fn rectangle_above_corner(a: f64, b: f64) -> f64 {
    let (p, q) = ((1.0 + a * a).sqrt(), (1.0 + b * b).sqrt());
    (a / p * libm::atan(b / p) + b / q * libm::atan(a / q)) / (2.0 * PI)
}

/// Form factor of a rectangle of width `a` and height `b` that stands on the receiver's plane at distance `c`, beginning at the foot of the
/// point.
pub fn standing_rectangle(a: f64, b: f64, c: f64) -> f64 {
    let far = (b * b + c * c).sqrt();
    (libm::atan(a / c) - c / far * libm::atan(a / far)) / (2.0 * PI)
}

/// Form factor of a parallel disc at height `height`, its axis `off` away.
pub fn disc(radius: f64, height: f64, off: f64) -> f64 {
    let squared = height * height + off * off + radius * radius;
    let root = (squared * squared - 4.0 * radius * radius * off * off).sqrt();
    0.5 * (1.0 - (squared - 2.0 * radius * radius) / root)
}

/// Form factor of a sphere whose centre is `distance` away at angle `beta` from the normal, cut by the horizon.
pub fn sphere(radius: f64, distance: f64, beta: f64) -> f64 {
    let s = radius / distance;
    let (sin, cos) = libm::sincos(beta);
    if cos >= s {
        return s * s * cos;
    }
    if cos <= -s {
        return 0.0;
    }
    let x = (1.0 / (s * s) - 1.0).sqrt();
    let y = -x * cos / sin;
    let q = (1.0 - y * y).sqrt();
    s * s / PI * (cos * libm::acos(y) - x * sin * q) + libm::atan(sin * q / x) / PI
}

/// Open part of the cosine-weighted hemisphere beside an endless wall of `height` at `distance`.
pub fn beside_wall(distance: f64, height: f64) -> f64 {
    let slope = if height.is_infinite() { 0.0 } else { distance / libm::hypot(distance, height) };
    1.0 - 0.5 * (1.0 - slope)
}

/// Part of a unit disc that lies on the left of the line x = `at`.
pub fn disc_left_of(at: f64) -> f64 {
    let s = at.clamp(-1.0, 1.0);
    0.5 + (s * (1.0 - s * s).sqrt() + libm::asin(s)) / PI
}

/// Form factor of the part of a disc lamp that `sees` lets through, by a fine polar grid over the lamp (to about 10⁻⁶): the lamp lies at
/// `height` about the origin, the point at (`off`, 0) below.
pub fn part_of_disc(radius: f64, height: f64, off: f64, sees: impl Fn(f64, f64) -> bool) -> f64 {
    const RINGS: usize = 800;
    const SECTORS: usize = 3200;
    let mut sum = 0.0;
    for ring in 0..RINGS {
        let r = radius * ((ring as f64 + 0.5) / RINGS as f64).sqrt();
        for sector in 0..SECTORS {
            let (sin, cos) = libm::sincos(2.0 * PI * (sector as f64 + 0.5) / SECTORS as f64);
            let (x, y) = (r * cos, r * sin);
            if sees(x, y) {
                let squared = (x - off) * (x - off) + y * y + height * height;
                sum += height * height / (squared * squared);
            }
        }
    }
    sum * radius * radius / (RINGS * SECTORS) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::polygon::lens;

    #[test]
    fn formulas_agree_with_the_catalogue_and_with_one_another() {
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-8, "{a} {b}");
        let at_height = |x0: f64, x1: f64, y0: f64, y1: f64, h: f64| {
            [(x0, y0), (x1, y0), (x1, y1), (x0, y1)].map(|(x, y)| DVec3::new(x, h, y))
        };
        near(rectangle_above_corner(1.0, 1.0), 0.138_531_605_994_89);
        near(
            polygon(DVec3::ZERO, DVec3::Y, &at_height(0.0, 2.0, 0.0, 3.0, 1.5)),
            rectangle_above_corner(2.0 / 1.5, 2.0),
        );
        near(polygon(DVec3::ZERO, DVec3::Y, &at_height(-0.5, 0.5, -0.5, 0.5, 1.0)), 0.239_456_470_460_773_5);
        near(standing_rectangle(1.0, 1.0, 1.0), 0.055_734_197_002_55);
        // One that reaches below the horizon is cut there.
        let standing = [(0.0, -2.0), (1.0, -2.0), (1.0, 1.0), (0.0, 1.0)].map(|(z, y)| DVec3::new(1.0, y, z));
        near(polygon(DVec3::ZERO, DVec3::Y, &standing), standing_rectangle(1.0, 1.0, 1.0));
        near(disc(1.0, 1.5, 0.0), 4.0 / 13.0);
        near(disc(1.0, 1.5, 2.0), 0.065_878_429);
        assert!((part_of_disc(1.0, 1.5, 2.0, |_, _| true) - disc(1.0, 1.5, 2.0)).abs() < 1e-6);
        for (degrees, expected) in [
            (0.0, 1.0 / 9.0),
            (60.0, 0.055_555_556),
            (80.0, 0.020_760_757),
            (90.0, 0.008_138_302),
            (100.0, 0.001_466_515),
        ] {
            near(sphere(1.0, 3.0, f64::to_radians(degrees)), expected);
        }
        near(beside_wall(1.0, 1.0), 0.853_553_391);
        near(beside_wall(0.5, 2.0), 0.621_267_813);
        near(disc_left_of(-0.5), 0.195_501_109);
        near(disc_left_of(0.3), 0.688_081_168);
        for (p, expected) in [(0.0, 0.36), (0.3, 0.391_406_57), (0.7, 0.588_432_43), (1.2, 0.824_299_82)] {
            near(1.0 - lens(1.0, 0.8, p) / PI, expected);
        }
    }
}
