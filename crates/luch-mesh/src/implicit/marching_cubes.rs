//! Marching cubes (Lorensen and Cline, 1987) with the topology of trilinear interpolation.
//!
//! Signs are found 64 samples at a time, crossed edges are numbered by counting bits, and cells are visited only where the
//! surface runs (see [`super::signs`]). Faces whose signs alternate are decided as the bilinear values on them demand, and the
//! inside of a cell as the trilinear values do ([`super::interior`]). The result is a manifold for every field, closed but at
//! the border of the grid.

use glam::Vec3;
use luch_bvh::simd::{Task, dispatch};
use rayon::prelude::*;

use super::cases::{CASES, CENTRE};
use super::cell::face_corners;
use super::crossing::{Vertices, interpolated};
use super::interior::{joined_inside, joined_over_face};
use super::signs::{EdgeNumbers, Signs, for_each_crossed_cell};
use super::{Grid, ImplicitError};
use crate::{Attribute, TriangleMesh};

/// Slices of cells that are worked on together; fixed, so that threads change nothing.
const SLAB: usize = 8;

/// The surface where the interpolated samples are at `level`, with normals from their gradient. Lower values are inside.
///
/// It is open where it meets the border of the grid; [`Grid::closed`] closes it. Values that are not a number are outside.
/// Vertices lie on the edges of the lattice; no two share a place, as long as single precision can tell 1/4096 of a cell.
pub fn marching_cubes(grid: &Grid, level: f32) -> Result<TriangleMesh, ImplicitError> {
    let signs = Signs::new(grid, level);
    let numbers = signs.number_edges()?;
    let vertices = interpolated(grid, level, &signs, &numbers);
    Ok(triangles(grid, level, &signs, &numbers, vertices))
}

/// The surface over vertices that were placed on the crossed edges.
pub(super) fn triangles(
    grid: &Grid,
    level: f32,
    signs: &Signs,
    numbers: &EdgeNumbers,
    vertices: Vertices,
) -> TriangleMesh {
    let slices = grid.counts()[2] - 1;
    let slabs: Vec<Slab> = (0..slices.div_ceil(SLAB))
        .into_par_iter()
        .map(|slab| {
            let cells = slab * SLAB..((slab + 1) * SLAB).min(slices);
            dispatch(March { grid, level, signs, numbers, cells })
        })
        .collect();
    let Vertices { mut positions, mut normals } = vertices;
    let mut triangles = Vec::with_capacity(slabs.iter().map(|slab| slab.triangles.len()).sum());
    for slab in slabs {
        let start = triangles.len();
        triangles.extend_from_slice(&slab.triangles);
        if slab.centres.is_empty() {
            continue;
        }
        // Middles of loops come after all other vertices.
        let first = positions.len() as u32;
        for corner in triangles[start..].as_flattened_mut() {
            let from_end = u32::MAX - *corner;
            if (from_end as usize) < slab.centres.len() {
                *corner = first + from_end;
            }
        }
        for round in &slab.centres {
            let mean = |list: &[Vec3]| {
                round.iter().fold(Vec3::ZERO, |sum, &v| sum + list[v as usize]) / round.len() as f32
            };
            let (position, normal) = (mean(&positions), mean(&normals));
            positions.push(position);
            normals.push(normal.try_normalize().unwrap_or(normals[round[0] as usize]));
        }
    }
    TriangleMesh { normals: Attribute::per_position(normals), ..TriangleMesh::new(positions, triangles) }
}

/// What some slices give.
#[derive(Default)]
struct Slab {
    /// Corners are numbers of crossed edges; counted down from the greatest number, places in `centres`.
    triangles: Vec<[u32; 3]>,
    /// The vertices round each middle.
    centres: Vec<Vec<u32>>,
}

/// Makes the triangles of some slices of cells.
struct March<'a> {
    grid: &'a Grid,
    level: f32,
    signs: &'a Signs,
    numbers: &'a EdgeNumbers,
    cells: std::ops::Range<usize>,
}

impl Task for March<'_> {
    type Output = Slab;

    #[inline(always)]
    fn run(self) -> Slab {
        let Self { grid, level, signs, numbers, cells } = self;
        let cases = &*CASES;
        let mut slab = Slab::default();
        for z in cells {
            for y in 0..grid.counts()[1] - 1 {
                for_each_crossed_cell(signs, numbers, y, z, |x, corners, edges| {
                    let corners = corners as usize;
                    if cases.is_open[corners] {
                        open_cell(corners, &corner_values(grid, level, [x, y, z]), edges, &mut slab);
                    } else {
                        let range = cases.starts[corners] as usize..cases.starts[corners + 1] as usize;
                        let of_edges = |triangle: &[u8; 3]| triangle.map(|edge| edges[edge as usize]);
                        slab.triangles.extend(cases.triangles[range].iter().map(of_edges));
                    }
                });
            }
        }
        slab
    }
}

/// The samples at the corners of a cell, above the level.
pub(super) fn corner_values(grid: &Grid, level: f32, [x, y, z]: [usize; 3]) -> [f64; 8] {
    std::array::from_fn(|corner| {
        let sample = [x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2)];
        f64::from(grid.at(sample)) - f64::from(level)
    })
}

/// The number of the variant that the values on the open faces choose.
pub(super) fn variant_number(corners: usize, values: &[f64; 8]) -> usize {
    let open_faces = CASES.all[corners].open_faces.iter().enumerate();
    open_faces.fold(0, |number, (n, &face)| {
        let round = face_corners(face as usize).map(|corner| values[corner]);
        number | usize::from(joined_over_face(round)) << n
    })
}

/// The triangles of a cell where the signs alone do not tell them.
#[inline(never)]
fn open_cell(corners: usize, values: &[f64; 8], edges: &[u32; 12], slab: &mut Slab) {
    let variant = &CASES.all[corners].variants[variant_number(corners, values)];
    let (mut triangles, mut centre_of) = (&variant.triangles, &variant.centre_of);
    if !variant.tubes.is_empty() {
        let joined = joined_inside(values);
        let is_there = |[a, b]: [u8; 2]| joined[a as usize] == joined[b as usize];
        if let Some(tube) = variant.tubes.iter().find(|tube| is_there(tube.corners)) {
            (triangles, centre_of) = (&tube.triangles, &tube.centre_of);
        }
    }
    let centre = u32::MAX - slab.centres.len() as u32;
    if !centre_of.is_empty() {
        slab.centres.push(centre_of.iter().map(|&edge| edges[edge as usize]).collect());
    }
    let of_edge = |edge: u8| if edge == CENTRE { centre } else { edges[edge as usize] };
    slab.triangles.extend(triangles.iter().map(|triangle| triangle.map(of_edge)));
}
