//! Faces that cross one another, by exact predicates (Shewchuk, "Adaptive precision floating-point arithmetic and fast robust
//! geometric predicates", 1997).

use glam::{DVec2, Vec3};
use rayon::prelude::*;
use robust::{Coord, Coord3D, orient2d, orient3d};
use serde::Serialize;

use crate::query::tree::{BoxTree, bounds_of};

/// Triangles that cross, touch or overlap others in more than the corners and edges they share.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct SelfIntersections {
    /// How many triangles do.
    pub triangles: usize,
    /// The first pairs, by the lower number.
    pub first: Vec<[u32; 2]>,
    /// True if some triangles had so many neighbours that not all were tried: then there may be more.
    pub is_lower_bound: bool,
}

/// Pairs that are listed.
const LISTED: usize = 16;
/// Pairs of boxes tried for one triangle: a heap of overlapping faces must not take for ever.
const MOST_TRIED: usize = 4096;

/// What became of one triangle.
struct Found {
    triangle: u32,
    /// The lowest triangle that it meets.
    other: u32,
    gave_up: bool,
}

/// Looks at triangles without repeated corners; positions are shared by index.
pub(super) fn find(positions: &[Vec3], triangles: &[[u32; 3]]) -> SelfIntersections {
    let corners = |t: u32| triangles[t as usize].map(|i| positions[i as usize]);
    let tree = BoxTree::new(triangles.len(), |t| bounds_of(corners(t as u32)));
    let look = |&triangle: &u32| {
        let own = triangles[triangle as usize];
        let mut found = Found { triangle, other: u32::MAX, gave_up: false };
        let mut tried = 0;
        tree.overlapping(&bounds_of(corners(triangle)), |other| {
            if other != triangle && other < found.other {
                tried += 1;
                if meet(positions, own, triangles[other as usize]) {
                    found.other = other;
                }
            }
            found.gave_up = tried == MOST_TRIED;
            !found.gave_up
        });
        (found.other != u32::MAX || found.gave_up).then_some(found)
    };
    let mut found: Vec<Found> = tree.order().par_iter().filter_map(look).collect();
    found.par_sort_unstable_by_key(|found| found.triangle);
    let met = || found.iter().filter(|found| found.other != u32::MAX);
    let mut first: Vec<[u32; 2]> =
        met().map(|f| [f.triangle.min(f.other), f.triangle.max(f.other)]).take(2 * LISTED).collect();
    first.sort_unstable();
    first.dedup();
    first.truncate(LISTED);
    SelfIntersections {
        triangles: met().count(),
        first,
        is_lower_bound: found.iter().any(|found| found.gave_up),
    }
}

/// True if two triangles have more in common than the corners and edges that they share by index.
fn meet(positions: &[Vec3], one: [u32; 3], other: [u32; 3]) -> bool {
    let shared = one.iter().filter(|corner| other.contains(corner)).count();
    let at = |corner: u32| positions[corner as usize];
    match shared {
        0 => {
            let (a, b) = (one.map(at), other.map(at));
            edges(a).into_iter().any(|edge| segment_meets(edge, b))
                || edges(b).into_iter().any(|edge| segment_meets(edge, a))
        }
        1 => {
            // Whatever they share besides the corner reaches the edge across from it in one of the two.
            let across = |triangle: [u32; 3], from: [u32; 3]| {
                let k = (0..3).find(|&k| from.contains(&triangle[k])).unwrap_or(0);
                [at(triangle[(k + 1) % 3]), at(triangle[(k + 2) % 3])]
            };
            segment_meets(across(one, other), other.map(at)) || segment_meets(across(other, one), one.map(at))
        }
        2 => {
            let free = |triangle: [u32; 3], from: [u32; 3]| {
                triangle.into_iter().find(|corner| !from.contains(corner))
            };
            let mut ends = one.into_iter().filter(|corner| other.contains(corner)).map(at);
            let (Some(p), Some(q), Some(a), Some(b)) =
                (ends.next(), ends.next(), free(one, other), free(other, one))
            else {
                return false;
            };
            // Folded back onto each other: flat, and both on one side of the edge.
            let (a, b) = (at(a), at(b));
            if side(p, q, a, b) != 0.0 {
                return false;
            }
            let Some(flat) = Flat::of([p, q, a]).or_else(|| Flat::of([p, q, b])) else { return false };
            let [p, q, a, b] = [p, q, a, b].map(|point| flat.project(point));
            let (of_a, of_b) = (turn(p, q, a), turn(p, q, b));
            (of_a > 0.0 && of_b > 0.0) || (of_a < 0.0 && of_b < 0.0)
        }
        // Duplicates are counted elsewhere.
        _ => false,
    }
}

fn edges([a, b, c]: [Vec3; 3]) -> [[Vec3; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// The sign tells on which side of the plane through a, b, c the point d lies: exactly.
fn side(a: Vec3, b: Vec3, c: Vec3, d: Vec3) -> f64 {
    let [a, b, c, d] =
        [a, b, c, d].map(|p| Coord3D { x: f64::from(p.x), y: f64::from(p.y), z: f64::from(p.z) });
    orient3d(a, b, c, d)
}

/// The sign tells on which side of the line through a and b the point c lies: exactly.
fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    let [a, b, c] = [a, b, c].map(|p| Coord { x: p.x, y: p.y });
    orient2d(a, b, c)
}

/// True if a segment has a point of a triangle, its border included.
fn segment_meets([p, q]: [Vec3; 2], triangle: [Vec3; 3]) -> bool {
    let [a, b, c] = triangle;
    let (of_p, of_q) = (side(a, b, c, p), side(a, b, c, q));
    if (of_p > 0.0 && of_q > 0.0) || (of_p < 0.0 && of_q < 0.0) {
        return false;
    }
    if of_p == 0.0 && of_q == 0.0 {
        return meets_in_plane([p, q], triangle);
    }
    let around = [side(p, q, a, b), side(p, q, b, c), side(p, q, c, a)];
    around.iter().all(|side| *side >= 0.0) || around.iter().all(|side| *side <= 0.0)
}

/// The same for a segment in the triangle's plane.
fn meets_in_plane([p, q]: [Vec3; 2], triangle: [Vec3; 3]) -> bool {
    // Triangles without area are lines: their plane is none, and their neighbours are tried instead.
    let Some(flat) = Flat::of(triangle) else { return false };
    let [p, q] = [p, q].map(|point| flat.project(point));
    let corners = triangle.map(|point| flat.project(point));
    let is_inside = |point: DVec2| {
        let turns = [0, 1, 2].map(|k| turn(corners[k], corners[(k + 1) % 3], point));
        turns.iter().all(|turn| *turn >= 0.0) || turns.iter().all(|turn| *turn <= 0.0)
    };
    is_inside(p) || is_inside(q) || (0..3).any(|k| segments_cross([p, q], [corners[k], corners[(k + 1) % 3]]))
}

fn segments_cross([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    let opposed = |one: f64, other: f64| (one >= 0.0 && other <= 0.0) || (one <= 0.0 && other >= 0.0);
    let (of_c, of_d, of_a, of_b) = (turn(a, b, c), turn(a, b, d), turn(c, d, a), turn(c, d, b));
    // Segments of one line are told apart by the triangle's corners, which are tried as well.
    let is_one_line = of_c == 0.0 && of_d == 0.0;
    !is_one_line && opposed(of_c, of_d) && opposed(of_a, of_b)
}

/// A plane of coordinates in which a triangle has an area: dropping a coordinate keeps the others exact.
#[derive(Clone, Copy)]
struct Flat {
    dropped: usize,
}

impl Flat {
    fn of(triangle: [Vec3; 3]) -> Option<Self> {
        let [a, b, c] = triangle;
        let normal = (b.as_dvec3() - a.as_dvec3()).cross(c.as_dvec3() - a.as_dvec3()).abs();
        let order = if normal.x >= normal.y && normal.x >= normal.z {
            [0, 1, 2]
        } else if normal.y >= normal.z {
            [1, 2, 0]
        } else {
            [2, 0, 1]
        };
        order.into_iter().map(|dropped| Self { dropped }).find(|flat| {
            let [a, b, c] = triangle.map(|point| flat.project(point));
            turn(a, b, c) != 0.0
        })
    }

    fn project(self, point: Vec3) -> DVec2 {
        let coordinates = point.as_dvec3().to_array();
        DVec2::new(coordinates[(self.dropped + 1) % 3], coordinates[(self.dropped + 2) % 3])
    }
}
