//! Mitsuba's simple forms as meshes, in its own coordinates; v of their uvs runs upward as ours does.

use glam::{Vec2, Vec3};
use luch_mesh::{Attribute, TriangleMesh, generate};
use std::f32::consts::TAU;

/// Pieces around an axis.
const SEGMENTS: u32 = 256;

/// A point of Mitsuba's texture space as ours.
fn uv(u: f32, v: f32) -> Vec2 {
    Vec2::new(u, 1.0 - v)
}

/// The square from −1 to 1 in the plane z = 0, facing +Z.
pub(super) fn rectangle() -> TriangleMesh {
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    TriangleMesh {
        uv_sets: vec![Attribute::per_position(
            corners.map(|[x, y]| uv((x + 1.0) / 2.0, (y + 1.0) / 2.0)).to_vec(),
        )],
        ..TriangleMesh::new(corners.map(|[x, y]| Vec3::new(x, y, 0.0)).to_vec(), vec![[0, 1, 2], [2, 3, 0]])
    }
}

/// The cube from −1 to 1. Each side has the whole texture, turned as Mitsuba turns it.
pub(super) fn cube() -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    let mut uvs = Vec::new();
    let mut normals = Vec::new();
    // The normal, and the directions in which u and v of Mitsuba grow.
    let sides = [
        (Vec3::Z, Vec3::Y, Vec3::X),
        (Vec3::X, Vec3::Y, Vec3::NEG_Z),
        (Vec3::Y, Vec3::NEG_X, Vec3::NEG_Z),
        (Vec3::NEG_Z, Vec3::NEG_Y, Vec3::X),
        (Vec3::NEG_X, Vec3::Y, Vec3::Z),
        (Vec3::NEG_Y, Vec3::Z, Vec3::X),
    ];
    for (side, (normal, along_u, along_v)) in sides.into_iter().enumerate() {
        for [u, v] in [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]] {
            mesh.positions.push(normal + along_u * u + along_v * v);
            uvs.push(uv((u + 1.0) / 2.0, (v + 1.0) / 2.0));
            normals.push(normal);
        }
        let first = 4 * side as u32;
        let [a, b, c, d] = [0, 1, 2, 3].map(|corner| first + corner);
        if along_u.cross(along_v).dot(normal) > 0.0 {
            mesh.triangles.extend([[a, b, c], [c, d, a]]);
        } else {
            mesh.triangles.extend([[a, c, b], [c, a, d]]);
        }
    }
    mesh.normals = Attribute::per_position(normals);
    mesh.uv_sets = vec![Attribute::per_position(uvs)];
    mesh
}

/// The unit sphere in luch's own coordinates, for where the exact one cannot be.
pub(super) fn sphere() -> TriangleMesh {
    generate::sphere(1.0, SEGMENTS, SEGMENTS / 2)
}

/// Places around the axis: cosine and sine, and the fraction of the turn.
fn around() -> impl Iterator<Item = (Vec2, f32)> {
    (0..=SEGMENTS).map(|step| {
        let fraction = step as f32 / SEGMENTS as f32;
        // The end meets the beginning.
        let angle = if step == SEGMENTS { 0.0 } else { fraction * TAU };
        (Vec2::new(libm::cosf(angle), libm::sinf(angle)), fraction)
    })
}

/// The unit disc in the plane z = 0, facing +Z; u is the distance from the middle, v the angle.
pub(super) fn disk() -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    let mut uvs = Vec::new();
    for (place, fraction) in around() {
        mesh.positions.extend([Vec3::ZERO, place.extend(0.0)]);
        uvs.extend([uv(0.0, fraction), uv(1.0, fraction)]);
    }
    mesh.triangles = (0..SEGMENTS).map(|step| [2 * step, 2 * step + 1, 2 * step + 3]).collect();
    mesh.uv_sets = vec![Attribute::per_position(uvs)];
    mesh
}

/// The open tube of radius 1 about the z axis from 0 to 1, facing outward; u is the angle, v the height.
pub(super) fn tube() -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    let mut uvs = Vec::new();
    let mut normals = Vec::new();
    for (place, fraction) in around() {
        mesh.positions.extend([place.extend(0.0), place.extend(1.0)]);
        normals.extend([place.extend(0.0); 2]);
        uvs.extend([uv(fraction, 0.0), uv(fraction, 1.0)]);
    }
    let side = |step: u32| {
        let [a, b, c, d] = [0, 2, 3, 1].map(|corner| 2 * step + corner);
        [[a, b, c], [c, d, a]]
    };
    mesh.triangles = (0..SEGMENTS).flat_map(side).collect();
    mesh.normals = Attribute::per_position(normals);
    mesh.uv_sets = vec![Attribute::per_position(uvs)];
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;
    use luch_mesh::measure;

    #[test]
    fn forms_face_outward_and_have_their_areas() {
        let pi = std::f64::consts::PI;
        for (mesh, area) in
            [(rectangle(), 4.0), (cube(), 24.0), (sphere(), 4.0 * pi), (disk(), pi), (tube(), 2.0 * pi)]
        {
            assert_eq!(mesh.validate(), []);
            assert!((measure::area(&mesh) / area - 1.0).abs() < 3e-4, "{} of {area}", measure::area(&mesh));
            for t in 0..mesh.triangles.len() {
                let [a, b, c] = mesh.corner_normals(t).unwrap_or([Vec3::Z; 3]);
                assert!(mesh.area_normal(t).dot(a + b + c) > 0.0, "triangle {t}");
            }
        }
    }

    #[test]
    fn the_texture_lies_as_mitsuba_lays_it() {
        // Points and uvs that Mitsuba 3.9 gives for rays along the axes; its v runs down.
        let cases = [
            (rectangle(), Vec3::new(0.3, 0.2, 0.0), [0.65, 0.6]),
            (cube(), Vec3::new(0.3, 0.2, 1.0), [0.6, 0.65]),
            (cube(), Vec3::new(1.0, 0.3, 0.2), [0.65, 0.4]),
            (cube(), Vec3::new(0.3, 1.0, 0.2), [0.35, 0.4]),
            (cube(), Vec3::new(-0.3, -0.2, -1.0), [0.6, 0.35]),
            (cube(), Vec3::new(-1.0, -0.3, 0.2), [0.35, 0.6]),
            (cube(), Vec3::new(-0.3, -1.0, 0.2), [0.6, 0.35]),
            (tube(), Vec3::new(0.954, 0.3, 0.2), [0.048, 0.2]),
            (tube(), Vec3::new(-0.3, -0.954, 0.2), [0.702, 0.2]),
        ];
        for (mesh, point, [u, v]) in cases {
            let found = (0..mesh.triangles.len()).find_map(|t| {
                let [a, b, c] = mesh.corners(t);
                let normal = (b - a).cross(c - a);
                let weight = |p: Vec3, q: Vec3| (q - p).cross(point - p).dot(normal) / normal.dot(normal);
                let weights = [weight(b, c), weight(c, a), weight(a, b)];
                let near = (point - a).dot(normal.normalize()).abs() < 1e-3;
                let [ua, ub, uc] = mesh.corner_uvs(t, 0)?;
                (near && weights.iter().all(|w| *w >= -1e-3))
                    .then(|| ua * weights[0] + ub * weights[1] + uc * weights[2])
            });
            let found = found.expect("the point is on the form");
            assert!(found.abs_diff_eq(uv(u, v), 2e-3), "{point}: {found}, expected {}", uv(u, v));
        }
    }
}
