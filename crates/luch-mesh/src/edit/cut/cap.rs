//! Closing what a plane has opened: edges to loops, loops to faces with holes.

use std::collections::HashMap;

use glam::{DVec2, DVec3};

use super::fragments::Fragment;
use crate::edit::builder::{Builder, NewCorner, Shade, Uv};
use crate::edit::geometry::plane_axes;

/// The edges in the plane, of what stays and of what goes.
#[derive(Default)]
pub(super) struct PlaneEdges {
    /// Edges, lower end first, and whether a face runs along them upward or downward.
    kept: Vec<([u32; 2], i32)>,
    removed: Vec<([u32; 2], i32)>,
    /// For each vertex on the plane a corner that stays, and its face.
    corners: HashMap<u32, (u32, NewCorner)>,
}

/// A closed way along the border of a cap, the cap on its left.
struct Loop {
    vertices: Vec<u32>,
    points: Vec<DVec2>,
    doubled_area: f64,
    low: DVec2,
    high: DVec2,
}

impl PlaneEdges {
    pub(super) fn add(&mut self, fragment: &Fragment, is_kept: bool, is_on_plane: impl Fn(u32) -> bool) {
        for border in &fragment.borders {
            for (i, corner) in border.iter().enumerate() {
                let (from, to) = (corner.vertex, border[(i + 1) % border.len()].vertex);
                if !is_on_plane(from) {
                    continue;
                }
                if is_kept {
                    self.corners.entry(from).or_insert_with(|| (fragment.face, corner.clone()));
                }
                if is_on_plane(to) {
                    let list = if is_kept { &mut self.kept } else { &mut self.removed };
                    list.push(([from.min(to), from.max(to)], if from < to { 1 } else { -1 }));
                }
            }
        }
    }

    /// Makes the caps: where a face that went leaves an edge of one that stays alone.
    pub(super) fn build_caps(self, builder: &mut Builder, outward: DVec3, slot: Option<u16>) {
        let [right, up] = plane_axes(outward);
        let edges = opened(net(self.kept), net(self.removed));
        let ways = edges.iter().map(|&[from, to]| [from, to].map(|vertex| flat(builder, vertex, right, up)));
        let ways: Vec<[DVec2; 2]> = ways.collect();
        let loops = loops(&edges, &ways);
        for borders in nested(&loops) {
            let border = |&number: &usize| -> Vec<NewCorner> {
                let Loop { vertices, points, .. } = &loops[number];
                let corner = |(vertex, point): (&u32, &DVec2)| {
                    let (_, corner) = self.corners.get(vertex)?;
                    Some(NewCorner { vertex: *vertex, uv: Uv::At(point.as_vec2()), ..corner.clone() })
                };
                vertices.iter().zip(points).filter_map(corner).collect()
            };
            let first = loops[borders[0]].vertices[0];
            let like = self.corners.get(&first).map_or(0, |(face, _)| *face as usize);
            let borders: Vec<Vec<NewCorner>> = borders.iter().map(border).collect();
            builder.face(like, &borders, Shade::Flat, slot);
        }
    }
}

fn flat(builder: &Builder, vertex: u32, right: DVec3, up: DVec3) -> DVec2 {
    let place = builder.place(vertex);
    DVec2::new(place.dot(right), place.dot(up))
}

/// Sums of directions by edge, without those that cancel.
fn net(mut edges: Vec<([u32; 2], i32)>) -> Vec<([u32; 2], i32)> {
    edges.sort_unstable();
    let sums = edges.chunk_by(|one, other| one.0 == other.0);
    let sums = sums.map(|same| (same[0].0, same.iter().map(|(_, direction)| direction).sum::<i32>()));
    sums.filter(|(_, sum)| *sum != 0).collect()
}

/// The edges of caps: they run as the removed faces did, against the kept ones.
fn opened(kept: Vec<([u32; 2], i32)>, removed: Vec<([u32; 2], i32)>) -> Vec<[u32; 2]> {
    let mut edges = Vec::new();
    for (edge, gone) in removed {
        let Ok(found) = kept.binary_search_by_key(&edge, |(other, _)| *other) else { continue };
        let stays = kept[found].1;
        if stays.signum() == -gone.signum() {
            let directed = if gone > 0 { edge } else { [edge[1], edge[0]] };
            let count = stays.unsigned_abs().min(gone.unsigned_abs());
            edges.extend(std::iter::repeat_n(directed, count as usize));
        }
    }
    edges.sort_unstable();
    edges
}

/// Joins directed edges to closed ways. Where several begin at a vertex, the way goes on with the first clockwise from where
/// it came: the cap is on the left, and ways that touch do not cross. Ways that do not close are left out.
fn loops(edges: &[[u32; 2]], ways: &[[DVec2; 2]]) -> Vec<Loop> {
    let mut is_taken = vec![false; edges.len()];
    let successors: Vec<Option<usize>> = edges
        .iter()
        .zip(ways)
        .map(|(&[_, to], &[start, end])| {
            let first = edges.partition_point(|edge| edge[0] < to);
            let candidates = (first..edges.len()).take_while(|&next| edges[next][0] == to);
            let back = start - end;
            let turn = |next: usize| {
                let forward = ways[next][1] - ways[next][0];
                let angle = libm::atan2(forward.perp_dot(back), forward.dot(back));
                if angle > 0.0 { angle } else { angle + std::f64::consts::TAU }
            };
            let open = candidates.filter(|&next| !is_taken[next]);
            let next = open.min_by(|&one, &other| turn(one).total_cmp(&turn(other)))?;
            is_taken[next] = true;
            Some(next)
        })
        .collect();
    let mut is_seen = vec![false; edges.len()];
    let mut loops = Vec::new();
    for start in 0..edges.len() {
        let (mut way, mut at) = (Vec::new(), Some(start));
        while let Some(edge) = at.filter(|&edge| !is_seen[edge]) {
            is_seen[edge] = true;
            way.push(edge);
            at = successors[edge];
        }
        // Ways that do not come back to their first edge stay open.
        if at == Some(start) && way.len() > 2 {
            loops.push(Loop::new(&way, edges, ways));
        }
    }
    loops
}

impl Loop {
    fn new(way: &[usize], edges: &[[u32; 2]], ways: &[[DVec2; 2]]) -> Self {
        let vertices = way.iter().map(|&edge| edges[edge][0]).collect();
        let points: Vec<DVec2> = way.iter().map(|&edge| ways[edge][0]).collect();
        let origin = points[0];
        let spokes = points.windows(2).map(|pair| (pair[0] - origin).perp_dot(pair[1] - origin));
        let doubled_area = spokes.sum();
        let low = points.iter().copied().fold(origin, DVec2::min);
        let high = points.iter().copied().fold(origin, DVec2::max);
        Self { vertices, points, doubled_area, low, high }
    }

    /// Whether another loop lies inside: by the first of its vertices that is not on this one.
    fn holds(&self, other: &Loop) -> bool {
        if self.low.cmpgt(other.low).any() || self.high.cmplt(other.high).any() {
            return false;
        }
        let free =
            other.vertices.iter().zip(&other.points).find(|(vertex, _)| !self.vertices.contains(vertex));
        free.is_some_and(|(_, &point)| self.is_around(point))
    }

    /// Even–odd rule.
    fn is_around(&self, point: DVec2) -> bool {
        let next = self.points.iter().cycle().skip(1);
        let crossings = self.points.iter().zip(next).filter(|(a, b)| {
            (a.y > point.y) != (b.y > point.y) && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)
        });
        crossings.count() % 2 == 1
    }
}

/// Outer loops, each with the holes that lie in it and in no smaller one. A hole in nothing becomes a face of its own.
fn nested(loops: &[Loop]) -> Vec<Vec<usize>> {
    let outer: Vec<usize> = (0..loops.len()).filter(|&number| loops[number].doubled_area >= 0.0).collect();
    let mut faces: Vec<Vec<usize>> = outer.iter().map(|&number| vec![number]).collect();
    for hole in (0..loops.len()).filter(|&number| loops[number].doubled_area < 0.0) {
        let around = (0..outer.len()).filter(|&face| loops[outer[face]].holds(&loops[hole]));
        let area = |face: &usize| loops[outer[*face]].doubled_area;
        match around.min_by(|one, other| area(one).total_cmp(&area(other))) {
            Some(face) => faces[face].push(hole),
            None => faces.push(vec![hole]),
        }
    }
    faces
}
