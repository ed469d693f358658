//! A ring.

use glam::{Vec2, Vec3};

use super::MAX_DIVISIONS;
use super::circle::on_circle;
use crate::PolygonMesh;
use crate::polygon_mesh::CornerAttribute;

/// A ring around the y axis: a tube of `minor_radius` about a circle of `major_radius`, in `segments` pieces around the
/// axis and `sides` around the tube (both at least 3).
///
/// u runs around the axis from +x over −z, v around the tube from its inner side over its lower.
pub(super) fn torus(major_radius: f32, minor_radius: f32, segments: u32, sides: u32) -> PolygonMesh {
    let (segments, sides) = (segments.clamp(3, MAX_DIVISIONS), sides.clamp(3, MAX_DIVISIONS));
    let mut mesh = PolygonMesh::default();
    let (mut normals, mut uvs, mut uv_corners) = (Vec::new(), Vec::new(), Vec::new());
    for segment in 0..segments {
        let around = on_circle(segment, segments);
        for side in 0..sides {
            let tube = -on_circle(side, sides);
            let outward = |radial: f64, height: f64| {
                Vec3::new((around.x * radial) as f32, height as f32, (-around.y * radial) as f32)
            };
            normals.push(outward(tube.x, tube.y));
            let minor = f64::from(minor_radius);
            mesh.positions.push(outward(f64::from(major_radius) + minor * tube.x, minor * tube.y));
        }
    }
    for segment in 0..=segments {
        uvs.extend(
            (0..=sides).map(|side| Vec2::new(segment as f32 / segments as f32, side as f32 / sides as f32)),
        );
    }
    let at = |segment: u32, side: u32| segment % segments * sides + side % sides;
    let uv_at = |segment: u32, side: u32| segment * (sides + 1) + side;
    for segment in 0..segments {
        for side in 0..sides {
            let cell = [(segment, side), (segment + 1, side), (segment + 1, side + 1), (segment, side + 1)];
            mesh.add_face(&cell.map(|(a, b)| at(a, b)));
            uv_corners.extend(cell.map(|(a, b)| uv_at(a, b)));
        }
    }
    mesh.normals = CornerAttribute::per_position(normals);
    mesh.uv_sets.push(CornerAttribute::indexed(uvs, uv_corners));
    mesh
}
