//! A rectangle in the xz plane, facing up.

use glam::{Vec2, Vec3};

use super::MAX_DIVISIONS;
use crate::PolygonMesh;
use crate::polygon_mesh::CornerAttribute;

/// A rectangle of `size` along x and z around the origin, facing +Y, in `divisions` pieces along x and z.
///
/// u runs along +x, v along −z: seen from above with −z up, the picture lies upright.
pub(super) fn plane(size: Vec2, divisions: [u32; 2]) -> PolygonMesh {
    let [columns, rows] = divisions.map(|n| n.clamp(1, MAX_DIVISIONS));
    let mut uvs = Vec::new();
    for row in 0..=rows {
        uvs.extend((0..=columns).map(|c| Vec2::new(c as f32 / columns as f32, row as f32 / rows as f32)));
    }
    let place = |uv: &Vec2| Vec3::new((uv.x - 0.5) * size.x, 0.0, (0.5 - uv.y) * size.y);
    let at = |column: u32, row: u32| row * (columns + 1) + column;
    let mut mesh = PolygonMesh { positions: uvs.iter().map(place).collect(), ..PolygonMesh::default() };
    for row in 0..rows {
        for column in 0..columns {
            let lower = [at(column, row), at(column + 1, row)];
            mesh.add_face(&[lower[0], lower[1], at(column + 1, row + 1), at(column, row + 1)]);
        }
    }
    mesh.normals = CornerAttribute::indexed(vec![Vec3::Y], vec![0; mesh.corners.len()]);
    mesh.uv_sets.push(CornerAttribute::per_position(uvs));
    mesh
}
