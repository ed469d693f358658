//! The convex hull of points, by Quickhull (Barber, Dobkin and Huhdanpaa 1996) with exact decisions (Shewchuk 1997).
//!
//! Whether a point lies above a facet is decided exactly, so there are no tolerances: facets are exactly convex, points on
//! facets and edges are left out, and coplanar points cannot confuse the horizon.

use glam::{DVec3, Vec3};
use robust::{Coord3D, orient3d};

use crate::TriangleMesh;

/// Why points have no hull.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum HullError {
    /// All points lie in one plane, on one line, or coincide; or there are fewer than four.
    #[error("the finite points lie in one plane: they enclose no body")]
    Flat,
    /// Too many points.
    #[error("{count} points are more than {MOST_POINTS}")]
    TooMany {
        /// How many there are.
        count: usize,
    },
}

/// The most points of a hull.
pub const MOST_POINTS: usize = 1 << 26;

/// The smallest convex body around points, as triangles wound outward. Its positions are those of the points that are corners
/// of it, in their order; points that are not finite do not count.
pub fn convex_hull(points: &[Vec3]) -> Result<TriangleMesh, HullError> {
    if points.len() > MOST_POINTS {
        return Err(HullError::TooMany { count: points.len() });
    }
    let mut corners: Vec<Vec3> = points.iter().copied().filter(|p| p.is_finite()).collect();
    loop {
        let places: Vec<DVec3> = corners.iter().map(|p| p.as_dvec3()).collect();
        let mut hull = Hull::of_four(&places).ok_or(HullError::Flat)?;
        hull.grow();
        // Rounded distances may have picked a point in the middle of a facet or edge: a body again without those.
        let is_corner = hull.corners();
        let kept = is_corner.iter().filter(|kept| **kept).count();
        if kept == hull.used_count() {
            return Ok(hull.into_mesh(&corners, &is_corner));
        }
        let mut flags = is_corner.iter();
        corners.retain(|_| flags.next().copied().unwrap_or(false));
    }
}

struct Facet {
    vertices: [u32; 3],
    /// Across the edge from each vertex to the next.
    neighbours: [u32; 3],
    /// Points above it that are above no earlier facet.
    above: Vec<u32>,
    is_gone: bool,
}

struct Hull<'a> {
    points: &'a [DVec3],
    facets: Vec<Facet>,
    /// Facets that may have points above them.
    open: Vec<u32>,
}

impl<'a> Hull<'a> {
    /// The tetrahedron of four points that are far apart, all others above its facets; `None` if all are in one plane.
    fn of_four(points: &'a [DVec3]) -> Option<Self> {
        let farthest = |measure: &dyn Fn(DVec3) -> f64| {
            let mut best = (0.0, None);
            for (i, &point) in points.iter().enumerate() {
                let size = measure(point);
                if size > best.0 {
                    best = (size, Some(i));
                }
            }
            best.1
        };
        let first = (0..points.len()).min_by(|&i, &k| order(points[i], points[k]))?;
        let a = points[first];
        let second = farthest(&|p| p.distance_squared(a))?;
        let b = points[second];
        // The line and the plane are judged exactly: rounding may see a volume where there is none.
        let third =
            farthest(&|p| (b - a).cross(p - a).length_squared()).filter(|&c| !is_on_line(a, b, points[c]));
        let third = third.or_else(|| (0..points.len()).find(|&c| !is_on_line(a, b, points[c])))?;
        let c = points[third];
        let normal = (b - a).cross(c - a);
        let fourth = farthest(&|p| normal.dot(p - a).abs()).filter(|&d| height(a, b, c, points[d]) != 0.0);
        let fourth = fourth.or_else(|| (0..points.len()).find(|&d| height(a, b, c, points[d]) != 0.0))?;
        let [mut i, mut k] = [first, second];
        if height(a, b, c, points[fourth]) > 0.0 {
            std::mem::swap(&mut i, &mut k);
        }
        let [a, b, c, d] = [i, k, third, fourth].map(|i| i as u32);
        // Outward: the fourth lies below the first three.
        let facets =
            [([a, b, c], [1, 2, 3]), ([b, a, d], [0, 3, 2]), ([c, b, d], [0, 1, 3]), ([a, c, d], [0, 2, 1])];
        let facet =
            |(vertices, neighbours)| Facet { vertices, neighbours, above: Vec::new(), is_gone: false };
        let mut hull = Self { points, facets: facets.map(facet).into(), open: vec![3, 2, 1, 0] };
        hull.spread((0..points.len() as u32).collect(), 0);
        Some(hull)
    }

    fn place(&self, point: u32) -> DVec3 {
        self.points[point as usize]
    }

    fn is_above(&self, facet: u32, point: u32) -> bool {
        let [a, b, c] = self.facets[facet as usize].vertices.map(|v| self.place(v));
        height(a, b, c, self.place(point)) > 0.0
    }

    /// Gives points to the facets from number `first` on that they are above.
    fn spread(&mut self, points: Vec<u32>, first: usize) {
        for point in points {
            let facets = first as u32..self.facets.len() as u32;
            if let Some(facet) = facets.into_iter().find(|&facet| self.is_above(facet, point)) {
                self.facets[facet as usize].above.push(point);
            }
        }
    }

    fn grow(&mut self) {
        while let Some(facet) = self.open.pop() {
            if self.facets[facet as usize].is_gone {
                continue;
            }
            if let Some(point) = self.farthest(facet) {
                self.add(facet, point);
            }
        }
    }

    /// The point farthest above a facet; of those as far the last in the order of coordinates, which is a corner.
    fn farthest(&self, facet: u32) -> Option<u32> {
        let Facet { vertices, above, .. } = &self.facets[facet as usize];
        let [a, b, c] = vertices.map(|v| self.place(v));
        let normal = (b - a).cross(c - a);
        let far = |point: u32| normal.dot(self.place(point) - a);
        above.iter().copied().max_by(|&one, &other| {
            far(one).total_cmp(&far(other)).then(order(self.place(one), self.place(other)))
        })
    }

    /// Replaces all facets that a point is above by a cone from their border to it.
    fn add(&mut self, start: u32, point: u32) {
        let mut gone = vec![start];
        self.facets[start as usize].is_gone = true;
        // Border edges: start, end, the facet that stays, and its edge.
        let mut border: Vec<Border> = Vec::new();
        let mut next = 0;
        while let Some(&facet) = gone.get(next) {
            next += 1;
            for side in 0..3 {
                let Facet { vertices, neighbours, .. } = &self.facets[facet as usize];
                let (from, to, neighbour) = (vertices[side], vertices[(side + 1) % 3], neighbours[side]);
                if self.facets[neighbour as usize].is_gone {
                    continue;
                }
                if self.is_above(neighbour, point) {
                    self.facets[neighbour as usize].is_gone = true;
                    gone.push(neighbour);
                } else {
                    border.push(Border { from, to, outside: neighbour, facet });
                }
            }
        }
        border.sort_unstable_by_key(|edge| edge.from);
        let first = self.facets.len();
        let number_of = |vertex: u32| {
            let place = border.binary_search_by_key(&vertex, |edge| edge.from).unwrap_or(0);
            (first + place) as u32
        };
        let mut before = vec![0; border.len()];
        for (i, edge) in border.iter().enumerate() {
            before[number_of(edge.to) as usize - first] = (first + i) as u32;
        }
        let after: Vec<u32> = border.iter().map(|edge| number_of(edge.to)).collect();
        for (i, edge) in border.iter().enumerate() {
            let outside = &mut self.facets[edge.outside as usize];
            for side in 0..3 {
                if outside.neighbours[side] == edge.facet && outside.vertices[side] == edge.to {
                    outside.neighbours[side] = (first + i) as u32;
                }
            }
            self.facets.push(Facet {
                vertices: [edge.from, edge.to, point],
                neighbours: [edge.outside, after[i], before[i]],
                above: Vec::new(),
                is_gone: false,
            });
        }
        let mut orphans: Vec<u32> = Vec::new();
        for facet in gone {
            orphans.append(&mut self.facets[facet as usize].above);
        }
        orphans.retain(|&orphan| orphan != point);
        self.spread(orphans, first);
        self.open.extend((first as u32..self.facets.len() as u32).rev());
    }

    fn facets_left(&self) -> impl Iterator<Item = &Facet> {
        self.facets.iter().filter(|facet| !facet.is_gone)
    }

    fn used_count(&self) -> usize {
        // Euler: a closed triangle mesh without handles has half as many triangles as vertices, and two more.
        self.facets_left().count() / 2 + 2
    }

    /// For each point whether at least three edges that are not flat meet there.
    fn corners(&self) -> Vec<bool> {
        let mut edges = vec![0u8; self.points.len()];
        for facet in self.facets_left() {
            let [a, b, c] = facet.vertices.map(|v| self.place(v));
            for side in 0..3 {
                let neighbour = &self.facets[facet.neighbours[side] as usize];
                let tip = neighbour.vertices.into_iter().find(|v| !facet.vertices.contains(v));
                if tip.is_some_and(|tip| height(a, b, c, self.place(tip)) != 0.0) {
                    // Seen from both of its facets, the edge counts at one end each time.
                    let count = &mut edges[facet.vertices[side] as usize];
                    *count = count.saturating_add(1);
                }
            }
        }
        edges.into_iter().map(|count| count > 2).collect()
    }

    fn into_mesh(self, points: &[Vec3], is_corner: &[bool]) -> TriangleMesh {
        let mut numbers = vec![0; points.len()];
        let mut positions = Vec::new();
        for (i, &point) in points.iter().enumerate().filter(|(i, _)| is_corner[*i]) {
            numbers[i] = positions.len() as u32;
            positions.push(point);
        }
        let triangles = self.facets_left().map(|facet| facet.vertices.map(|v| numbers[v as usize])).collect();
        TriangleMesh::new(positions, triangles)
    }
}

struct Border {
    from: u32,
    to: u32,
    /// The facet that stays, and the one that goes.
    outside: u32,
    facet: u32,
}

/// By x, then y, then z.
fn order(one: DVec3, other: DVec3) -> std::cmp::Ordering {
    let [a, b] = [one, other].map(|p| p.to_array());
    a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(a[2].total_cmp(&b[2]))
}

/// Positive if a point lies on the side of a triangle from which it runs counter-clockwise, zero if in its plane: exactly.
fn height(a: DVec3, b: DVec3, c: DVec3, point: DVec3) -> f64 {
    let coord = |p: DVec3| Coord3D { x: p.x, y: p.y, z: p.z };
    -orient3d(coord(a), coord(b), coord(c), coord(point))
}

/// True if three points lie on a line: exactly, seen along all three axes.
fn is_on_line(a: DVec3, b: DVec3, c: DVec3) -> bool {
    let flat = |x: usize, y: usize| {
        let coord = |p: DVec3| robust::Coord { x: p[x], y: p[y] };
        robust::orient2d(coord(a), coord(b), coord(c)) == 0.0
    };
    flat(0, 1) && flat(1, 2) && flat(2, 0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{generate, measure};

    fn numbers(seed: u32) -> impl Iterator<Item = f32> {
        let mut state = seed;
        std::iter::repeat_with(move || {
            state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            (state >> 8) as f32 / (1 << 24) as f32
        })
    }

    /// Closed, and no point above any facet.
    fn check(points: &[Vec3]) -> TriangleMesh {
        let hull = convex_hull(points).expect("a body");
        let report = measure::closedness(&hull);
        assert!(report.is_closed() && report.genus == Some(0) && report.pinched == 0, "{report}");
        for t in 0..hull.triangles.len() {
            let [a, b, c] = hull.corners(t).map(|p| p.as_dvec3());
            assert!(points.iter().all(|p| height(a, b, c, p.as_dvec3()) <= 0.0));
        }
        hull
    }

    #[test]
    fn a_grid_in_a_cube_has_eight_corners() {
        let points: Vec<Vec3> = (0..1000)
            .map(|i| Vec3::new((i % 10) as f32, (i / 10 % 10) as f32, (i / 100) as f32) / 9.0 * 2.1 - 0.7)
            .collect();
        let hull = check(&points);
        assert_eq!((hull.positions.len(), hull.triangles.len()), (8, 12));
        assert!((measure::volume(&hull) - 2.1 * 2.1 * 2.1).abs() < 1e-5);
    }

    #[test]
    fn convex_bodies_are_their_own_hull() {
        let bodies = [
            generate::icosphere(1.0, 3),
            generate::cylinder(1.0, 2.0, 40, 1, true),
            generate::cone(1.0, 0.0, 1.5, 30, 1, true),
            generate::cuboid(Vec3::new(1.0, 2.0, 3.0), [4, 3, 2]),
        ];
        for body in bodies {
            let hull = check(&body.positions);
            assert!((measure::volume(&hull) / measure::volume(&body) - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn random_points_and_hostile_ones() {
        for seed in 0..30 {
            let mut random = numbers(seed);
            let scale = if seed % 3 == 0 { 1e-30 } else { 1e30 };
            let points: Vec<Vec3> = (0..200)
                .map(|_| {
                    let p = [0; 3].map(|_| random.next().unwrap_or(0.0));
                    // Rounded to a coarse grid every other time: many coplanar points.
                    Vec3::from(if seed % 2 == 0 { p } else { p.map(|x| (x * 4.0).round()) }) * scale
                })
                .chain([Vec3::NAN, Vec3::splat(f32::INFINITY)])
                .collect();
            check(&points[..200]);
            assert_eq!(convex_hull(&points), convex_hull(&points[..200]));
        }
    }

    #[test]
    fn flat_points_are_refused() {
        let line: Vec<Vec3> = (0..9).map(|i| Vec3::new(0.1, 0.2, 0.3) * i as f32).collect();
        let plane: Vec<Vec3> = (0..25).map(|i| Vec3::new((i % 5) as f32, (i / 5) as f32, 0.25)).collect();
        for points in [&line[..1], &plane[..], &[], &[Vec3::ONE; 10]] {
            assert_eq!(convex_hull(points), Err(HullError::Flat));
        }
    }
}
