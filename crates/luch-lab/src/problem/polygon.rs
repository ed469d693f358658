//! Convex polygons in the plane: cut, measured, seen from a point.

use std::f64::consts::{PI, TAU};

/// The part where n·p ≤ limit (Sutherland and Hodgman, "Reentrant polygon clipping", 1974).
pub fn clip(polygon: &[[f64; 2]], normal: [f64; 2], limit: f64) -> Vec<[f64; 2]> {
    let side = |p: [f64; 2]| normal[0] * p[0] + normal[1] * p[1] - limit;
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (at, &a) in polygon.iter().enumerate() {
        let b = polygon[(at + 1) % polygon.len()];
        let (sa, sb) = (side(a), side(b));
        if sa <= 0.0 {
            kept.push(a);
        }
        if (sa < 0.0 && sb > 0.0) || (sa > 0.0 && sb < 0.0) {
            let t = sa / (sa - sb);
            kept.push([a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]);
        }
    }
    kept
}

/// What two convex polygons share; the second counter-clockwise.
pub fn intersection(first: &[[f64; 2]], second: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut kept = first.to_vec();
    for (at, &a) in second.iter().enumerate() {
        let b = second[(at + 1) % second.len()];
        // To the right of the edge is outside.
        let normal = [b[1] - a[1], a[0] - b[0]];
        kept = clip(&kept, normal, normal[0] * a[0] + normal[1] * a[1]);
    }
    if second.len() < 3 { Vec::new() } else { kept }
}

/// The area; positive for counter-clockwise corners.
pub fn area(polygon: &[[f64; 2]]) -> f64 {
    let next = polygon.iter().cycle().skip(1);
    polygon.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>() / 2.0
}

/// The form factor of a horizontal polygon at a height above a point that faces up: Lambert's sum over the edges,
/// (1/2π) Σ θᵢ (n·γᵢ).
pub fn form_factor(polygon: &[[f64; 2]], height: f64, point: [f64; 2]) -> f64 {
    if polygon.len() < 3 {
        return 0.0;
    }
    let towards = |p: [f64; 2]| {
        let v = [p[0] - point[0], p[1] - point[1], height];
        let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
        v.map(|c| c / length)
    };
    let sum: f64 = polygon
        .iter()
        .enumerate()
        .map(|(at, &a)| {
            let (a, b) = (towards(a), towards(polygon[(at + 1) % polygon.len()]));
            let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
            let sine = (cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]).sqrt();
            let cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            if sine == 0.0 { 0.0 } else { libm::atan2(sine, cosine) * cross[2] / sine }
        })
        .sum();
    (sum / TAU).abs()
}

/// The area two discs share, with radii and the distance of their middles.
pub fn lens(first: f64, second: f64, distance: f64) -> f64 {
    let (great, small) = (first.max(second), first.min(second));
    if distance >= great + small || small <= 0.0 {
        return 0.0;
    }
    if distance <= great - small {
        return PI * small * small;
    }
    let (r, s, d) = (great, small, distance);
    let angle = |near: f64, far: f64| {
        libm::acos(((d * d + near * near - far * far) / (2.0 * d * near)).clamp(-1.0, 1.0))
    };
    let root = ((-d + s + r) * (d + s - r) * (d - s + r) * (d + s + r)).max(0.0).sqrt();
    s * s * angle(s, r) + r * r * angle(r, s) - 0.5 * root
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

    #[test]
    fn squares_are_cut() {
        assert_eq!(area(&SQUARE), 1.0);
        assert_eq!(area(&clip(&SQUARE, [1.0, 0.0], 0.25)), 0.25);
        assert_eq!(area(&clip(&SQUARE, [1.0, 1.0], 1.0)), 0.5);
        assert!(clip(&SQUARE, [1.0, 0.0], -1.0).is_empty() && clip(&[], [1.0, 0.0], 0.0).is_empty());
        let moved = SQUARE.map(|[x, y]| [x + 0.5, y + 0.5]);
        assert_eq!(area(&intersection(&SQUARE, &moved)), 0.25);
    }

    #[test]
    fn form_factors_of_rectangles() {
        let centered = SQUARE.map(|[x, y]| [x - 0.5, y - 0.5]);
        assert!((form_factor(&SQUARE, 1.0, [0.0; 2]) - 0.138_531_605_994_89).abs() < 1e-14);
        assert!((form_factor(&centered, 1.0, [0.0; 2]) - 0.239_456_470_460_773_5).abs() < 1e-15);
    }
}
