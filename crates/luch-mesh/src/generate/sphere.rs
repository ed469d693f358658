//! A sphere by longitude and latitude.

use glam::{Vec2, Vec3};

use super::MAX_DIVISIONS;
use super::circle::on_circle;
use crate::PolygonMesh;
use crate::polygon_mesh::CornerAttribute;

/// A sphere of `radius` around the origin, `segments` pieces around the y axis (at least 3) and `rings` from pole to
/// pole (at least 2).
///
/// u runs around from +x over −z, v from the south pole to the north pole.
pub(super) fn sphere(radius: f32, segments: u32, rings: u32) -> PolygonMesh {
    let (segments, rings) = (segments.clamp(3, MAX_DIVISIONS), rings.clamp(2, MAX_DIVISIONS));
    // South pole, the rings between, north pole.
    let mut normals = vec![Vec3::NEG_Y];
    for ring in 1..rings {
        let latitude = on_circle(ring, 2 * rings);
        for segment in 0..segments {
            let around = on_circle(segment, segments) * latitude.y;
            normals.push(Vec3::new(around.x as f32, -latitude.x as f32, -around.y as f32));
        }
    }
    normals.push(Vec3::Y);
    let north = normals.len() as u32 - 1;
    let at = |ring: u32, segment: u32| match ring {
        0 => 0,
        _ if ring == rings => north,
        _ => 1 + (ring - 1) * segments + segment % segments,
    };
    // The poles have one uv per segment, in its middle.
    let mut uvs = Vec::new();
    for ring in 0..=rings {
        let shift = if ring == 0 || ring == rings { 0.5 } else { 0.0 };
        let u = |segment: u32| (segment as f32 + shift) / segments as f32;
        uvs.extend((0..=segments).map(|segment| Vec2::new(u(segment), ring as f32 / rings as f32)));
    }
    let uv_at = |ring: u32, segment: u32| ring * (segments + 1) + segment;

    let (mut mesh, mut uv_corners) = (PolygonMesh::default(), Vec::new());
    for ring in 0..rings {
        for segment in 0..segments {
            let cell = [(ring, segment), (ring, segment + 1), (ring + 1, segment + 1), (ring + 1, segment)];
            // Next to a pole a cell is one triangle.
            let kept: &[usize] = match ring {
                0 => &[0, 2, 3],
                _ if ring + 1 == rings => &[0, 1, 3],
                _ => &[0, 1, 2, 3],
            };
            mesh.corners.extend(kept.iter().map(|&k| at(cell[k].0, cell[k].1)));
            mesh.face_ends.push(mesh.corners.len() as u32);
            uv_corners.extend(kept.iter().map(|&k| uv_at(cell[k].0, cell[k].1)));
        }
    }
    mesh.positions = normals.iter().map(|n| *n * radius).collect();
    mesh.normals = CornerAttribute::per_position(normals);
    mesh.uv_sets.push(CornerAttribute::indexed(uvs, uv_corners));
    mesh
}
