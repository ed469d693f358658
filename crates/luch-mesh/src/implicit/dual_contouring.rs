//! Dual contouring (Ju et al., "Dual Contouring of Hermite Data", 2002), always a manifold.
//!
//! Every crossed edge gives a polygon between the cells about it. A cell has one vertex for each loop of the surface on its
//! faces (as in dual marching cubes, Nielson 2004), placed where the tangent planes at the loop's crossings meet, so that edges
//! and corners come out sharp. If the surface crosses a face twice and both times joins the same two vertices, their edge would
//! have four polygons; then each crossing gets a vertex of its own on that face, and the two edges are apart.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::Grid;
use super::cases::CASES;
use super::cell::{faces_of_edge, other_axes};
use super::crossing::Crossing;
use super::field::{Field, PointList};
use super::marching_cubes::{corner_values, variant_number};
use super::quadric::Quadric;
use super::roots::Root;
use super::signs::{EdgeNumbers, Signs, for_each_crossed_cell};
use crate::TriangleMesh;

/// Slices of cells that are worked on together; fixed, so that threads change nothing.
const SLAB: usize = 8;
/// Quads that are worked on together.
const BATCH: usize = 1024;
/// No vertex.
const NONE: u32 = u32::MAX;
/// The cells about an edge in order round its axis: bit 0 and bit 1 set if the cell lies before the edge along the first and the
/// second of the other axes.
const ROUND: [usize; 4] = [0, 1, 3, 2];

/// The surface with a vertex for each loop in a cell.
pub(super) fn contour(
    field: &dyn Field,
    grid: &Grid,
    signs: &Signs,
    numbers: &EdgeNumbers,
    crossings: &[Crossing],
    roots: &[Root],
) -> TriangleMesh {
    let slices = grid.counts()[2] - 1;
    let slabs: Vec<Slab> = (0..slices.div_ceil(SLAB))
        .into_par_iter()
        .map(|slab| {
            let mut found = Slab::default();
            for z in slab * SLAB..((slab + 1) * SLAB).min(slices) {
                found.add_slice(grid, signs, numbers, roots, z);
            }
            found
        })
        .collect();
    // The vertices about each crossed edge.
    let mut about = vec![[NONE; 4]; crossings.len()];
    let mut positions: Vec<Vec3> = Vec::new();
    let mut double_segments = Vec::new();
    for slab in slabs {
        let first = positions.len() as u32;
        positions.extend(slab.positions);
        for Use { edge, side, vertex } in slab.uses {
            about[edge as usize][side as usize] = first + vertex;
        }
        double_segments.extend(slab.double_segments);
    }
    let middles = Middles::new(double_segments, roots, &mut positions);
    let mut quads = Vec::with_capacity(crossings.len());
    let mut fans = Vec::new();
    let mut polygon = Vec::new();
    for (edge, (crossing, about)) in crossings.iter().zip(&about).enumerate() {
        // At the border of the grid some cells are missing: the surface is open there.
        if about.contains(&NONE) {
            continue;
        }
        polygon.clear();
        for n in 0..4 {
            let [side, next] = [ROUND[n], ROUND[(n + 1) % 4]];
            polygon.push(about[side]);
            polygon.extend(middles.get(edge as u32, || face_between(grid, crossing, side, next)));
        }
        // Along y the other axes, x and z, turn the other way.
        if crossing.starts_inside == (crossing.axis == 1) {
            polygon.reverse();
        }
        match *polygon {
            [a, b, c, d] => quads.push([a, b, c, d]),
            _ => fan(&polygon, &mut fans),
        }
    }
    let mut triangles = cut(field, &quads, &positions);
    triangles.extend(fans);
    let mesh = TriangleMesh::new(positions, triangles);
    crate::clean::remove_unused_positions(&mesh).mesh
}

/// What some slices of cells give.
#[derive(Default)]
struct Slab {
    positions: Vec<Vec3>,
    uses: Vec<Use>,
    double_segments: Vec<DoubleSegment>,
}

/// A vertex belongs to the polygon of an edge.
struct Use {
    edge: u32,
    /// Where its cell lies about the edge.
    side: u8,
    /// Its place in the slab.
    vertex: u32,
}

/// A segment on a face whose other segment belongs to the same loop of the cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct DoubleSegment {
    /// The face.
    face: u64,
    /// The crossed edges at its ends, rising.
    edges: [u32; 2],
}

impl Slab {
    fn add_slice(&mut self, grid: &Grid, signs: &Signs, numbers: &EdgeNumbers, roots: &[Root], z: usize) {
        let mut quadric = Quadric::default();
        for y in 0..grid.counts()[1] - 1 {
            for_each_crossed_cell(signs, numbers, y, z, |x, corners, edges| {
                let case = &CASES.all[corners as usize];
                let number = if case.open_faces.is_empty() {
                    0
                } else {
                    variant_number(corners as usize, &corner_values(grid, 0.0, [x, y, z]))
                };
                let variant = &case.variants[number];
                let (low, high) = (grid.position([x, y, z]), grid.position([x + 1, y + 1, z + 1]));
                for round in &variant.loops {
                    let vertex = self.positions.len() as u32;
                    quadric.clear();
                    for &edge in round {
                        let number = edges[edge as usize];
                        let root = &roots[number as usize];
                        quadric.add(root.position, root.normal.as_dvec3());
                        self.uses.push(Use { edge: number, side: edge % 4, vertex });
                    }
                    self.positions.push(quadric.solve(low, high).as_vec3());
                    if variant.twice_crossed != 0 {
                        self.note_double_segments([x, y, z], grid, round, variant.twice_crossed, edges);
                    }
                }
            });
        }
    }

    fn note_double_segments(
        &mut self,
        cell: [usize; 3],
        grid: &Grid,
        round: &[u8],
        twice_crossed: u8,
        edges: &[u32; 12],
    ) {
        for (n, &edge) in round.iter().enumerate() {
            let next = round[(n + 1) % round.len()];
            let shared = faces_of_edge(edge as usize) & faces_of_edge(next as usize) & twice_crossed;
            if shared == 0 {
                continue;
            }
            let face = shared.trailing_zeros() as usize;
            let mut first = cell;
            first[face / 2] += face % 2;
            let mut ends = [edges[edge as usize], edges[next as usize]];
            ends.sort_unstable();
            self.double_segments
                .push(DoubleSegment { face: face_number(grid, first, face / 2), edges: ends });
        }
    }
}

/// The number of the face across `axis` that begins at a sample.
fn face_number(grid: &Grid, sample: [usize; 3], axis: usize) -> u64 {
    grid.place(sample) as u64 * 3 + axis as u64
}

/// The face between two neighbouring cells about an edge.
fn face_between(grid: &Grid, crossing: &Crossing, side: usize, next: usize) -> u64 {
    let axes = other_axes(crossing.axis as usize);
    let across = usize::from(side ^ next == 2);
    let mut first = crossing.start.map(|n| n as usize);
    // The face reaches from the edge to the side on which both cells lie.
    first[axes[1 - across]] -= side >> (1 - across) & 1;
    face_number(grid, first, axes[across])
}

/// A vertex on a face, in the polygon of an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Middle {
    edge: u32,
    face: u64,
    vertex: u32,
}

/// The vertices on faces where two edges would coincide, rising.
struct Middles(Vec<Middle>);

impl Middles {
    fn new(mut segments: Vec<DoubleSegment>, roots: &[Root], positions: &mut Vec<Vec3>) -> Self {
        segments.sort_unstable();
        let mut list = Vec::new();
        for pair in segments.windows(2) {
            // Only if both cells of the face name it.
            if pair[0] == pair[1] {
                let DoubleSegment { face, edges } = pair[0];
                let vertex = positions.len() as u32;
                let [a, b]: [DVec3; 2] = edges.map(|edge| roots[edge as usize].position);
                positions.push(((a + b) / 2.0).as_vec3());
                list.extend(edges.map(|edge| Middle { edge, face, vertex }));
            }
        }
        list.sort_unstable();
        Self(list)
    }

    fn get(&self, edge: u32, face: impl FnOnce() -> u64) -> Option<u32> {
        if self.0.is_empty() {
            return None;
        }
        let wanted = Middle { edge, face: face(), vertex: 0 };
        let found = self.0.get(self.0.partition_point(|middle| *middle < wanted))?;
        (found.edge == wanted.edge && found.face == wanted.face).then_some(found.vertex)
    }
}

/// Cuts quads in two, each along the diagonal whose middle is nearer to the surface: so edges that run along it stay sharp. Where
/// both are as near as the corners, along the one that is bent less.
fn cut(field: &dyn Field, quads: &[[u32; 4]], positions: &[Vec3]) -> Vec<[u32; 3]> {
    let place = |vertex: u32| positions[vertex as usize].as_dvec3();
    let distances_at = |points: PointList| {
        let mut values = vec![0.0f64; points.points().len()];
        field.values(points.points(), &mut values);
        values.into_iter().map(f64::abs)
    };
    let batches = positions.par_chunks(BATCH);
    let of_corners: Vec<f64> =
        batches.flat_map_iter(|batch| distances_at(batch.iter().map(|p| p.as_dvec3()).collect())).collect();
    let flatness = |[a, b, c]: [u32; 3], [d, e, f]: [u32; 3]| {
        let normal = |a, b, c| (place(b) - place(a)).cross(place(c) - place(a)).normalize_or_zero();
        normal(a, b, c).dot(normal(d, e, f))
    };
    let halves = quads.par_chunks(BATCH).flat_map_iter(|quads| {
        let middle = |a: u32, b: u32| (place(a) + place(b)) / 2.0;
        let middles = quads.iter().flat_map(|&[a, b, c, d]| [middle(a, c), middle(b, d)]).collect();
        let distances: Vec<f64> = distances_at(middles).collect();
        let cut = |(n, &[a, b, c, d]): (usize, &[u32; 4])| {
            let (first, second) = ([[a, b, c], [a, c, d]], [[a, b, d], [b, c, d]]);
            let corners = [a, b, c, d].map(|v| of_corners[v as usize]).into_iter().fold(0.0, f64::max);
            let [one, other] = [distances[2 * n], distances[2 * n + 1]];
            let is_second = if one.max(other) <= 4.0 * corners {
                flatness(second[0], second[1]) > flatness(first[0], first[1])
            } else {
                other < one
            };
            if is_second { second } else { first }
        };
        quads.iter().enumerate().flat_map(cut).collect::<Vec<_>>()
    });
    halves.collect()
}

/// Cuts a polygon with corners on faces by a fan about one of these: no other polygon has two of its other corners.
fn fan(polygon: &[u32], triangles: &mut Vec<[u32; 3]>) {
    // They come after all other vertices.
    let first = (0..polygon.len()).max_by_key(|&n| polygon[n]).unwrap_or(0);
    let at = |n: usize| polygon[(first + n) % polygon.len()];
    triangles.extend((1..polygon.len() - 1).map(|n| [at(0), at(n), at(n + 1)]));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::implicit::cell::edge_corners;

    #[test]
    fn sides_of_an_edge_are_its_places_in_the_cells() {
        // The cell at the edge's own sample sees the edge at its low sides.
        for axis in 0..3 {
            let [one, other] = other_axes(axis);
            for side in 0..4 {
                let [start, _] = edge_corners(axis * 4 + side);
                assert_eq!((start >> one & 1, start >> other & 1), (side & 1, side >> 1));
            }
        }
    }
}
