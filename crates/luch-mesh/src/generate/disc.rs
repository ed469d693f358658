//! Flat round forms and the pipe.

use glam::{DVec3, Vec2};

use super::MAX_DIVISIONS;
use super::circle::{around, on_circle};
use super::grid::{Grid, Join, Sample};
use crate::PolygonMesh;
use crate::polygon_mesh::CornerAttribute;

/// See [`super::Generator::Annulus`]; with an inner radius of zero, [`super::Generator::Disc`].
pub(super) fn annulus(outer_radius: f32, inner_radius: f32, segments: u32, rings: u32) -> PolygonMesh {
    let (segments, rings) = (segments.clamp(3, MAX_DIVISIONS), rings.clamp(1, MAX_DIVISIONS));
    let (outer, inner) = (f64::from(outer_radius), f64::from(inner_radius));
    // Rows run inward, so that the surface faces up.
    let grid = Grid {
        columns: segments,
        rows: rings,
        join: Join::Straight,
        rows_joined: false,
        poles: [false, inner == 0.0],
    };
    let mut mesh = grid.mesh(|column, row| {
        let part = f64::from(row) / f64::from(rings);
        let radius = if row == rings { inner } else { outer + (inner - outer) * part };
        Sample { position: around(on_circle(column, segments), radius, 0.0), normal: DVec3::Y }
    });
    let normals = vec![0; mesh.corners.len()];
    mesh.normals = CornerAttribute::indexed(vec![glam::Vec3::Y], normals);
    let uvs = mesh
        .positions
        .iter()
        .map(|p| Vec2::new(0.5 + 0.5 * p.x / outer_radius, 0.5 - 0.5 * p.z / outer_radius));
    mesh.uv_sets = vec![CornerAttribute::per_position(uvs.collect())];
    mesh
}

/// See [`super::Generator::Tube`].
pub(super) fn tube(
    outer_radius: f32,
    inner_radius: f32,
    height: f32,
    segments: u32,
    stacks: u32,
) -> PolygonMesh {
    let (segments, stacks) = (segments.clamp(3, MAX_DIVISIONS), stacks.clamp(1, MAX_DIVISIONS));
    let (outer, inner, height) = (f64::from(outer_radius), f64::from(inner_radius), f64::from(height));
    // Once around the profile: the outer side upward, the upper ring inward, the inner side down, the lower ring out.
    let rows = 2 * stacks + 2;
    let place = |row: u32| {
        let (radius, step) = if row <= stacks { (outer, row) } else { (inner, rows - 1 - row) };
        (radius, (f64::from(step) / f64::from(stacks) - 0.5) * height)
    };
    let mut mesh = Grid::ring(segments, rows).mesh(|column, row| {
        let (radius, y) = place(row);
        // The normals are replaced below.
        Sample { position: around(on_circle(column, segments), radius, y), normal: DVec3::Y }
    });
    let turns: Vec<_> = (0..segments).map(|column| on_circle(column, segments)).collect();
    let outward = turns.iter().map(|&turn| around(turn, 1.0, 0.0).as_vec3());
    let inward = turns.iter().map(|&turn| around(turn, -1.0, 0.0).as_vec3());
    let values = outward.chain(inward).chain([glam::Vec3::Y, glam::Vec3::NEG_Y]).collect();
    let mut normals = CornerAttribute { values, corners: Vec::with_capacity(mesh.corners.len()) };
    let mut uvs = CornerAttribute { values: Vec::new(), corners: Vec::with_capacity(mesh.corners.len()) };
    for row in 0..=stacks {
        let v = row as f32 / stacks as f32;
        uvs.values.extend((0..=segments).map(|column| Vec2::new(column as f32 / segments as f32, v)));
    }
    let first_flat = uvs.values.len() as u32;
    // The rings lie as one sees them: the upper with −z up, the lower with +z up.
    for upward in [1.0, -1.0] {
        for share in [0.5, 0.5 * inner / outer] {
            let flat = turns.iter().map(|turn| glam::DVec2::new(turn.x, turn.y * upward) * share + 0.5);
            uvs.values.extend(flat.map(|uv| uv.as_vec2()));
        }
    }
    for row in 0..rows {
        for column in 0..segments {
            for (column, above) in [(column, 0), (column + 1, 0), (column + 1, 1), (column, 1)] {
                let around = column % segments;
                let (normal, uv) = if row < stacks {
                    (around, (row + above) * (segments + 1) + column)
                } else if row == stacks {
                    (2 * segments, first_flat + above * segments + around)
                } else if row < rows - 1 {
                    // Seen from inside u runs the other way.
                    let v = rows - 1 - row - above;
                    (segments + around, v * (segments + 1) + segments - column)
                } else {
                    (2 * segments + 1, first_flat + (3 - above) * segments + around)
                };
                normals.corners.push(normal);
                uvs.corners.push(uv);
            }
        }
    }
    mesh.normals = normals;
    mesh.uv_sets = vec![uvs];
    mesh
}
