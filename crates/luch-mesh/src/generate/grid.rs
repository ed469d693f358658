//! Surfaces over a grid: quads, joined at the sides in any of the ways that make a tube, a ring, a band or a bottle.

use glam::{DVec3, Vec2};

use crate::PolygonMesh;
use crate::polygon_mesh::CornerAttribute;

/// What happens at the right side of a grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Join {
    /// It is a border.
    Open,
    /// It is the left side.
    Straight,
    /// It is the left side upside down: row `r` meets row `rows − r`, or `rows − 1 − r` where the rows are joined
    /// too. The surface has one side only; normals turn round at the seam.
    Reversed,
}

/// A grid of quads. u runs along the columns, v along the rows; the normal is ∂u × ∂v.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    /// Cells along u.
    pub columns: u32,
    /// Cells along v.
    pub rows: u32,
    /// How the right side meets the left.
    pub join: Join,
    /// Whether the upper side is the lower.
    pub rows_joined: bool,
    /// Whether the lowest and the highest row are single points; cells there are triangles.
    pub poles: [bool; 2],
}

/// A point of the true surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    /// The place.
    pub position: DVec3,
    /// The unit normal.
    pub normal: DVec3,
}

impl Grid {
    /// Closed around, between two poles.
    pub(super) fn ball(columns: u32, rows: u32) -> Self {
        Self { columns, rows, join: Join::Straight, rows_joined: false, poles: [true; 2] }
    }

    /// Closed both ways.
    pub(super) fn ring(columns: u32, rows: u32) -> Self {
        Self { columns, rows, join: Join::Straight, rows_joined: true, poles: [false; 2] }
    }

    /// The surface through the samples at (column, row).
    pub(super) fn mesh(&self, sample: impl Fn(u32, u32) -> Sample) -> PolygonMesh {
        let mut mesh = PolygonMesh::default();
        let columns = if self.join == Join::Open { self.columns + 1 } else { self.columns };
        let reversed = self.join == Join::Reversed;
        let mut normals = Vec::new();
        for row in 0..=self.last_row() {
            let count = if self.is_pole(row) { 1 } else { columns };
            for column in 0..count + u32::from(reversed) {
                let Sample { position, normal } = sample(column, row);
                if column < count {
                    mesh.positions.push(position.as_vec3());
                }
                normals.push(normal.as_vec3());
            }
        }
        let (mut normal_corners, mut uv_corners) = (Vec::new(), Vec::new());
        for row in 0..self.rows {
            for column in 0..self.columns {
                let cell = [(column, row), (column + 1, row), (column + 1, row + 1), (column, row + 1)];
                // Next to a pole a cell is the triangle that keeps the other side; the corner at the pole is that of
                // the cell's own column.
                let kept: &[usize] = match (self.is_pole(row), self.is_pole(row + 1)) {
                    (true, _) => &[0, 2, 3],
                    (_, true) => &[0, 1, 3],
                    _ => &[0, 1, 2, 3],
                };
                for &k in kept {
                    let (column, row) = cell[k];
                    mesh.corners.push(self.number(column, row, columns));
                    uv_corners.push(row * (self.columns + 1) + column);
                    if reversed {
                        normal_corners.push(self.wrapped(row) * (columns + 1) + column);
                    }
                }
                mesh.face_ends.push(mesh.corners.len() as u32);
            }
        }
        mesh.normals = CornerAttribute { values: normals, corners: normal_corners };
        mesh.uv_sets.push(CornerAttribute::indexed(self.uvs(), uv_corners));
        mesh
    }

    fn uvs(&self) -> Vec<Vec2> {
        let mut uvs = Vec::new();
        for row in 0..=self.rows {
            // A pole has one uv per column, in its middle.
            let shift = if self.is_pole(row) { 0.5 } else { 0.0 };
            let u = |column: u32| (column as f32 + shift) / self.columns as f32;
            uvs.extend((0..=self.columns).map(|c| Vec2::new(u(c), row as f32 / self.rows as f32)));
        }
        uvs
    }

    fn is_pole(&self, row: u32) -> bool {
        (row == 0 && self.poles[0]) || (row == self.rows && self.poles[1])
    }

    fn last_row(&self) -> u32 {
        if self.rows_joined { self.rows - 1 } else { self.rows }
    }

    fn wrapped(&self, row: u32) -> u32 {
        if self.rows_joined { row % self.rows } else { row }
    }

    /// The number of a position; `columns` positions stand in a row.
    fn number(&self, column: u32, row: u32, columns: u32) -> u32 {
        let (mut column, mut row) = (column, self.wrapped(row));
        if self.join != Join::Open && column == self.columns {
            column = 0;
            if self.join == Join::Reversed {
                row = self.last_row() - row;
            }
        }
        if self.is_pole(row) {
            column = 0;
        }
        // The lower pole stands before all rows instead of one.
        let first = if self.poles[0] && row > 0 { 1 + (row - 1) * columns } else { row * columns };
        first + column
    }
}
