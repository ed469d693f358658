//! The nearest point of a surface.

use glam::DVec3;
use luch_bvh::Aabb;

use super::tree::BoxTree;
use crate::TriangleMesh;

/// A point of a surface, the nearest to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Where it is.
    pub point: DVec3,
    /// How far from the point asked about.
    pub distance: f64,
    /// Its triangle.
    pub triangle: u32,
    /// The weights of the triangle's corners; not below zero, one in sum. Zeros are exact: they tell edges and corners.
    pub weights: [f64; 3],
}

/// The nearest point no farther than `farthest`; of equally near triangles the lowest.
pub(super) fn nearest(mesh: &TriangleMesh, tree: &BoxTree, point: DVec3, farthest: f64) -> Option<Nearest> {
    if tree.is_empty() || !point.is_finite() || farthest.is_nan() {
        return None;
    }
    let mut best: Option<Nearest> = None;
    let mut bound = farthest * farthest;
    let mut stack = [(0.0f64, 0usize); 64];
    stack[0] = (squared_distance(tree.bounds(1), point), 1);
    let mut height = 1;
    while height > 0 {
        height -= 1;
        let (squared, node) = stack[height];
        // Equally near triangles of a lower number may still come.
        if squared > bound {
            continue;
        }
        if let Some(triangles) = tree.leaf(node) {
            for &triangle in triangles {
                let corners =
                    mesh.triangles[triangle as usize].map(|i| mesh.positions[i as usize].as_dvec3());
                let weights = nearest_weights(corners, point);
                let found = corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
                let squared = found.distance_squared(point);
                let is_lower = best.is_none_or(|best| triangle < best.triangle);
                if squared < bound || (squared == bound && is_lower) {
                    bound = squared;
                    best = Some(Nearest { point: found, distance: squared.sqrt(), triangle, weights });
                }
            }
            continue;
        }
        let children =
            [2 * node, 2 * node + 1].map(|child| (squared_distance(tree.bounds(child), point), child));
        // The nearer one is asked first.
        let [near, far] = if children[0].0 <= children[1].0 { children } else { [children[1], children[0]] };
        stack[height] = far;
        stack[height + 1] = near;
        height += 2;
    }
    best
}

/// Not more than the squared distance to anything in a box, for rounding too; infinite for empty boxes.
fn squared_distance(bounds: &Aabb, point: DVec3) -> f64 {
    if bounds.is_empty() {
        return f64::INFINITY;
    }
    let (low, high) = (bounds.min.as_dvec3(), bounds.max.as_dvec3());
    let squared = (low - point).max(point - high).max(DVec3::ZERO).length_squared();
    squared * (1.0 - 1e-12)
}

/// The weights of the corners at the point of a triangle nearest to `point`.
///
/// Ericson, "Real-Time Collision Detection" (2005), 5.1.5. Triangles without area count as the segments they are.
pub(super) fn nearest_weights([a, b, c]: [DVec3; 3], point: DVec3) -> [f64; 3] {
    let (ab, ac, from_a) = (b - a, c - a, point - a);
    let (d1, d2) = (ab.dot(from_a), ac.dot(from_a));
    if d1 <= 0.0 && d2 <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let from_b = point - b;
    let (d3, d4) = (ab.dot(from_b), ac.dot(from_b));
    if d3 >= 0.0 && d4 <= d3 {
        return [0.0, 1.0, 0.0];
    }
    let from_c = point - c;
    let (d5, d6) = (ab.dot(from_c), ac.dot(from_c));
    if d6 >= 0.0 && d5 <= d6 {
        return [0.0, 0.0, 1.0];
    }
    let normal = ab.cross(ac);
    if normal == DVec3::ZERO {
        return nearest_on_border([a, b, c], point);
    }
    // Signed areas against each edge: exact enough in double precision for corners of single precision.
    let of_c = normal.dot(from_a.cross(from_b));
    if of_c <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let along = d1 / (d1 - d3);
        return [1.0 - along, along, 0.0];
    }
    let of_b = normal.dot(from_c.cross(from_a));
    if of_b <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let along = d2 / (d2 - d6);
        return [1.0 - along, 0.0, along];
    }
    let of_a = normal.dot(from_b.cross(from_c));
    if of_a <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        let along = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return [0.0, 1.0 - along, along];
    }
    let sum = of_a + of_b + of_c;
    if sum > 0.0 && of_a >= 0.0 && of_b >= 0.0 && of_c >= 0.0 {
        return [of_a / sum, of_b / sum, of_c / sum];
    }
    // Needles: rounding has left no region.
    nearest_on_border([a, b, c], point)
}

/// The nearest of the three edges.
fn nearest_on_border(corners: [DVec3; 3], point: DVec3) -> [f64; 3] {
    let mut best = ([1.0, 0.0, 0.0], f64::INFINITY);
    for k in 0..3 {
        let (from, to) = (corners[k], corners[(k + 1) % 3]);
        let along = (point - from).dot(to - from) / (to - from).length_squared();
        let along = if along.is_nan() { 0.0 } else { along.clamp(0.0, 1.0) };
        let squared = from.lerp(to, along).distance_squared(point);
        if squared < best.1 {
            let mut weights = [0.0; 3];
            (weights[k], weights[(k + 1) % 3]) = (1.0 - along, along);
            best = (weights, squared);
        }
    }
    best.0
}
