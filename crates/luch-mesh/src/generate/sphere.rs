//! A sphere by longitude and latitude.

use glam::{Vec2, Vec3};

use super::{MAX_DIVISIONS, on_circle, quad};
use crate::{Attribute, TriangleMesh};

/// A sphere of `radius` around the origin, `segments` pieces around the y axis (at least 3) and `rings` from pole to
/// pole (at least 2).
///
/// u runs around from +x over −z, v from the south pole to the north pole.
pub fn sphere(radius: f32, segments: u32, rings: u32) -> TriangleMesh {
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

    let (mut triangles, mut uv_triangles) = (Vec::new(), Vec::new());
    for ring in 0..rings {
        for segment in 0..segments {
            let next = segment + 1;
            let cell = [(ring, segment), (ring, next), (ring + 1, next), (ring + 1, segment)];
            let mut corners = quad(cell.map(|(r, s)| at(r, s))).to_vec();
            let mut corner_uvs = quad(cell.map(|(r, s)| uv_at(r, s))).to_vec();
            // Next to a pole a cell is one triangle.
            if ring == 0 {
                corners = vec![[at(0, 0), at(1, next), at(1, segment)]];
                corner_uvs = vec![[uv_at(0, segment), uv_at(1, next), uv_at(1, segment)]];
            } else if ring + 1 == rings {
                corners = vec![[at(ring, segment), at(ring, next), north]];
                corner_uvs = vec![[uv_at(ring, segment), uv_at(ring, next), uv_at(rings, segment)]];
            }
            triangles.append(&mut corners);
            uv_triangles.append(&mut corner_uvs);
        }
    }
    TriangleMesh {
        positions: normals.iter().map(|n| *n * radius).collect(),
        normals: Attribute::per_position(normals),
        uv_sets: vec![Attribute::indexed(uvs, uv_triangles)],
        triangles,
        ..TriangleMesh::default()
    }
}
