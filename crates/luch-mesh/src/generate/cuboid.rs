//! A box with hard edges.

use glam::{UVec3, Vec2, Vec3};

use super::MAX_DIVISIONS;
use crate::PolygonMesh;
use crate::polygon_mesh::CornerAttribute;

/// A box with sides of `size` around the origin, each side in so many `divisions`.
///
/// Every face carries the whole uv square, upright for one who looks at it from outside (the top with −z up, the
/// bottom with +z up).
pub(super) fn cuboid(size: Vec3, divisions: [u32; 3]) -> PolygonMesh {
    let counts = UVec3::from(divisions.map(|n| n.clamp(1, MAX_DIVISIONS)));
    let mut lattice = Lattice { counts, numbers: Default::default(), positions: Vec::new(), size };
    let mut mesh = PolygonMesh::default();
    let (mut normals, mut uvs) = (CornerAttribute::default(), CornerAttribute::default());
    for (side, face) in FACES.iter().enumerate() {
        let (columns, rows) = (counts[face.right], counts[face.up]);
        let first_uv = uvs.values.len() as u32;
        for row in 0..=rows {
            uvs.values.extend(
                (0..=columns).map(|c| Vec2::new(c as f32 / columns as f32, row as f32 / rows as f32)),
            );
        }
        let uv_at = |column: u32, row: u32| first_uv + row * (columns + 1) + column;
        for row in 0..rows {
            for column in 0..columns {
                let corners = [(column, row), (column + 1, row), (column + 1, row + 1), (column, row + 1)];
                mesh.add_face(&corners.map(|(c, r)| lattice.number(face, c, r)));
                uvs.corners.extend(corners.map(|(c, r)| uv_at(c, r)));
                normals.corners.extend([side as u32; 4]);
            }
        }
        normals.values.push(face.normal());
    }
    mesh.positions = lattice.positions;
    mesh.normals = normals;
    mesh.uv_sets.push(uvs);
    mesh
}

/// A side of the box: which axes point out of it, to the right and up, and whether they run backward.
struct Face {
    outward: usize,
    is_low: bool,
    right: usize,
    right_reversed: bool,
    up: usize,
    up_reversed: bool,
}

const fn face(
    outward: usize,
    is_low: bool,
    right: usize,
    right_reversed: bool,
    up: usize,
    up_reversed: bool,
) -> Face {
    Face { outward, is_low, right, right_reversed, up, up_reversed }
}

/// +x, −x, +y, −y, +z, −z; right × up = outward.
const FACES: [Face; 6] = [
    face(0, false, 2, true, 1, false),
    face(0, true, 2, false, 1, false),
    face(1, false, 0, false, 2, true),
    face(1, true, 0, false, 2, false),
    face(2, false, 0, false, 1, false),
    face(2, true, 0, true, 1, false),
];

impl Face {
    fn normal(&self) -> Vec3 {
        let mut normal = Vec3::ZERO;
        normal[self.outward] = if self.is_low { -1.0 } else { 1.0 };
        normal
    }
}

/// The points of the surface grid, numbered as they are met.
struct Lattice {
    counts: UVec3,
    numbers: std::collections::HashMap<UVec3, u32>,
    positions: Vec<Vec3>,
    size: Vec3,
}

impl Lattice {
    fn number(&mut self, face: &Face, column: u32, row: u32) -> u32 {
        let along =
            |axis: usize, step: u32, reversed: bool| if reversed { self.counts[axis] - step } else { step };
        let mut place = UVec3::ZERO;
        place[face.outward] = if face.is_low { 0 } else { self.counts[face.outward] };
        place[face.right] = along(face.right, column, face.right_reversed);
        place[face.up] = along(face.up, row, face.up_reversed);
        *self.numbers.entry(place).or_insert_with(|| {
            let part = place.as_vec3() / self.counts.as_vec3();
            self.positions.push((part - 0.5) * self.size);
            self.positions.len() as u32 - 1
        })
    }
}
