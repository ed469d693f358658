//! Walls between rows of points, and flat ends.

use glam::{DVec2, DVec3, Vec2};

use super::{Outline, shading};
use crate::PolygonMesh;
use crate::polygon_mesh::CornerAttribute;

/// A mesh with uvs that is being made.
#[derive(Default)]
pub(super) struct Skin {
    mesh: PolygonMesh,
    uvs: CornerAttribute<Vec2>,
}

/// A wall: rows of as many position numbers each.
pub(super) struct Wall<'a> {
    /// From bottom to top. A row that is one number throughout is a point.
    pub rows: &'a [Vec<u32>],
    /// Whether the last column meets the first.
    pub is_ring: bool,
    /// u of each column, and of the first met again where it is a ring.
    pub across: &'a [f64],
    /// v of each row.
    pub along: &'a [f64],
}

impl Skin {
    /// Adds a position and returns its number.
    pub(super) fn position(&mut self, place: DVec3) -> u32 {
        self.mesh.positions.push(place.as_vec3());
        self.mesh.positions.len() as u32 - 1
    }

    /// Adds a wall of quads that faces the side from which columns run to the right and rows up.
    pub(super) fn wall(&mut self, wall: &Wall) {
        let Some(columns) = wall.rows.first().map(Vec::len) else { return };
        let cells = if wall.is_ring { columns } else { columns.saturating_sub(1) };
        let first = self.uvs.values.len();
        for v in wall.along {
            self.uvs.values.extend(wall.across.iter().map(|u| DVec2::new(*u, *v).as_vec2()));
        }
        for row in 0..wall.rows.len() - 1 {
            for column in 0..cells {
                let cell = [(column, row), (column + 1, row), (column + 1, row + 1), (column, row + 1)];
                let corners = cell.map(|(column, row)| wall.rows[row][column % columns]);
                // Cells at a point are triangles, and those between two points are nothing.
                let kept = (0..4).filter(|&k| corners[k] != corners[(k + 1) % 4]);
                let kept: Vec<usize> = kept.collect();
                if kept.len() < 3 {
                    continue;
                }
                for k in kept {
                    self.mesh.corners.push(corners[k]);
                    let (column, row) = cell[k];
                    self.uvs.corners.push((first + row * wall.across.len() + column) as u32);
                }
                self.mesh.face_ends.push(self.mesh.corners.len() as u32);
            }
        }
    }

    /// Adds an outline as a flat face; `loops` are the numbers of its points. A reversed one looks the other way.
    pub(super) fn cap(&mut self, loops: &[Vec<u32>], outline: &Outline, map: &PlaneMap, is_reversed: bool) {
        let mut borders = loops.to_vec();
        let mut flat: Vec<Vec<Vec2>> =
            outline.loops().map(|points| points.iter().map(|&p| map.uv(p, is_reversed)).collect()).collect();
        if is_reversed {
            borders.iter_mut().for_each(|border| border.reverse());
            flat.iter_mut().for_each(|border| border.reverse());
        }
        let holes: Vec<&[u32]> = borders[1..].iter().map(Vec::as_slice).collect();
        self.mesh.add_face_with_holes(&borders[0], &holes);
        let first = self.uvs.values.len() as u32;
        self.uvs.values.extend(flat.concat());
        self.uvs.corners.extend(first..self.uvs.values.len() as u32);
    }

    /// The mesh, with normals that are hard at edges bent by more than `crease_angle`.
    pub(super) fn finish(self, crease_angle: f64) -> PolygonMesh {
        let mut mesh = self.mesh;
        mesh.uv_sets.push(self.uvs);
        mesh.normals = shading::creased(&mesh, crease_angle);
        mesh
    }
}

/// From a plane to the uv square: the bounds of all outlines fit into it, and nothing is stretched.
pub(super) struct PlaneMap {
    low: DVec2,
    size: DVec2,
}

impl PlaneMap {
    pub(super) fn of(outlines: &[Outline]) -> Self {
        let points = || outlines.iter().flat_map(|outline| &outline.outer);
        let low = points().fold(DVec2::INFINITY, |low, p| low.min(*p));
        let high = points().fold(DVec2::NEG_INFINITY, |high, p| high.max(*p));
        Self { low, size: high - low }
    }

    /// Seen from the other side, u runs the other way.
    fn uv(&self, point: DVec2, is_reversed: bool) -> Vec2 {
        let mut from_low = point - self.low;
        if is_reversed {
            from_low.x = self.size.x - from_low.x;
        }
        (from_low / self.size.max_element()).as_vec2()
    }
}

/// The length along a line up to each of its points, over the whole length; the last is 1. A ring ends where it began.
pub(super) fn shares<P: Copy>(points: &[P], is_ring: bool, distance: impl Fn(P, P) -> f64) -> Vec<f64> {
    let mut lengths = vec![0.0];
    for k in 1..points.len() + usize::from(is_ring) {
        lengths.push(lengths[k - 1] + distance(points[k - 1], points[k % points.len()]));
    }
    let whole = lengths[lengths.len() - 1];
    lengths.into_iter().map(|length| if whole > 0.0 { length / whole } else { 0.0 }).collect()
}
