//! The point of a triangle nearest to a given point.

use super::Triangle;
use glam::Vec3;

/// A point of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrianglePoint {
    /// Where it is.
    pub point: Vec3,
    /// Weight of the second corner.
    pub u: f32,
    /// Weight of the third corner.
    pub v: f32,
}

/// The point of the triangle nearest to `point`. Degenerate triangles count as the segment or point they are.
///
/// Ericson, *Real-Time Collision Detection* (2005), section 5.1.5: find the corner, edge or face whose region holds the
/// point. Reckoned in double precision.
pub fn nearest_point(triangle: &Triangle, point: Vec3) -> TrianglePoint {
    let wide = |v: Vec3| v.to_array().map(f64::from);
    let [a, b, c, p] = [triangle.a, triangle.b, triangle.c, point].map(wide);
    let (ab, ac) = (minus(b, a), minus(c, a));
    let from_a = minus(p, a);
    let (d1, d2) = (dot(ab, from_a), dot(ac, from_a));
    if d1 <= 0.0 && d2 <= 0.0 {
        return weighted(triangle, 0.0, 0.0);
    }
    let from_b = minus(p, b);
    let (d3, d4) = (dot(ab, from_b), dot(ac, from_b));
    if d3 >= 0.0 && d4 <= d3 {
        return weighted(triangle, 1.0, 0.0);
    }
    let on_ab = d1 * d4 - d3 * d2;
    if on_ab <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return weighted(triangle, ratio(d1, d1 - d3), 0.0);
    }
    let from_c = minus(p, c);
    let (d5, d6) = (dot(ab, from_c), dot(ac, from_c));
    if d6 >= 0.0 && d5 <= d6 {
        return weighted(triangle, 0.0, 1.0);
    }
    let on_ac = d5 * d2 - d1 * d6;
    if on_ac <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return weighted(triangle, 0.0, ratio(d2, d2 - d6));
    }
    let on_bc = d3 * d6 - d5 * d4;
    if on_bc <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        let v = ratio(d4 - d3, (d4 - d3) + (d5 - d6));
        return weighted(triangle, 1.0 - v, v);
    }
    let sum = on_ab + on_ac + on_bc;
    weighted(triangle, ratio(on_ac, sum), ratio(on_ab, sum))
}

fn weighted(triangle: &Triangle, u: f64, v: f64) -> TrianglePoint {
    let at = |axis: usize| {
        let [a, b, c] = [triangle.a, triangle.b, triangle.c].map(|corner| f64::from(corner[axis]));
        (a * (1.0 - u - v) + b * u + c * v) as f32
    };
    TrianglePoint { point: Vec3::new(at(0), at(1), at(2)), u: u as f32, v: v as f32 }
}

/// The quotient, or 0 where a degenerate triangle leaves 0/0.
fn ratio(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    const TRIANGLE: Triangle =
        Triangle { a: vec3(0.0, 0.0, 0.0), b: vec3(4.0, 0.0, 0.0), c: vec3(0.0, 4.0, 0.0) };

    #[test]
    fn each_of_the_seven_regions() {
        let cases = [
            (vec3(1.0, 1.0, 3.0), vec3(1.0, 1.0, 0.0)),
            (vec3(-1.0, -1.0, 1.0), vec3(0.0, 0.0, 0.0)),
            (vec3(6.0, -1.0, 0.0), vec3(4.0, 0.0, 0.0)),
            (vec3(-1.0, 7.0, 0.0), vec3(0.0, 4.0, 0.0)),
            (vec3(1.0, -2.0, 5.0), vec3(1.0, 0.0, 0.0)),
            (vec3(-2.0, 3.0, 5.0), vec3(0.0, 3.0, 0.0)),
            (vec3(3.0, 3.0, 1.0), vec3(2.0, 2.0, 0.0)),
        ];
        for (from, expected) in cases {
            let found = nearest_point(&TRIANGLE, from);
            assert_eq!(found.point, expected, "from {from}");
            assert_eq!(TRIANGLE.at(found.u, found.v), expected);
        }
    }

    #[test]
    fn degenerate_triangles_are_segments_and_points() {
        let segment = Triangle { a: Vec3::ZERO, b: Vec3::X, c: Vec3::X * 2.0 };
        assert_eq!(nearest_point(&segment, vec3(1.5, 1.0, 0.0)).point, vec3(1.5, 0.0, 0.0));
        assert_eq!(nearest_point(&segment, vec3(3.0, 1.0, 0.0)).point, vec3(2.0, 0.0, 0.0));
        let dot = Triangle { a: Vec3::ONE, b: Vec3::ONE, c: Vec3::ONE };
        assert_eq!(nearest_point(&dot, vec3(9.0, 0.0, 0.0)).point, Vec3::ONE);
    }
}
