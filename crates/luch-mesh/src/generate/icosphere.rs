//! A sphere of nearly equal triangles.

use std::collections::HashMap;

use glam::{DVec3, Vec2};

use super::circle::on_circle;
use crate::PolygonMesh;
use crate::polygon_mesh::CornerAttribute;

/// The most often an icosphere is subdivided: 20 · 4⁹ ≈ 5 million triangles.
pub const MAX_SUBDIVISIONS: u32 = 9;

/// A sphere of `radius` around the origin: an icosahedron with corners at the poles of the y axis, each triangle cut
/// into four `subdivisions` times (at most [`MAX_SUBDIVISIONS`]) and pushed out to the sphere.
///
/// u is the longitude from +x over −z (past 1 where a triangle crosses the seam), v the latitude from pole to pole.
pub(super) fn icosphere(radius: f32, subdivisions: u32) -> PolygonMesh {
    let (mut points, mut triangles) = icosahedron();
    for _ in 0..subdivisions.min(MAX_SUBDIVISIONS) {
        let mut middles: HashMap<[u32; 2], u32> = HashMap::new();
        let mut finer = Vec::with_capacity(triangles.len() * 4);
        for [a, b, c] in triangles {
            let mut middle = |one: u32, other: u32| {
                *middles.entry([one.min(other), one.max(other)]).or_insert_with(|| {
                    points.push((points[one as usize] + points[other as usize]).normalize());
                    points.len() as u32 - 1
                })
            };
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        triangles = finer;
    }
    PolygonMesh {
        positions: points.iter().map(|p| (*p * f64::from(radius)).as_vec3()).collect(),
        normals: CornerAttribute::per_position(points.iter().map(|p| p.as_vec3()).collect()),
        uv_sets: vec![longitude_latitude(&points, &triangles)],
        face_ends: (1..=triangles.len() as u32).map(|t| 3 * t).collect(),
        corners: triangles.into_flattened(),
        ..PolygonMesh::default()
    }
}

pub(super) fn icosahedron() -> (Vec<DVec3>, Vec<[u32; 3]>) {
    // Two rings of five at latitudes ± arctan ½, the upper one turned by half a step.
    let (height, radius) = (1.0 / 5f64.sqrt(), 2.0 / 5f64.sqrt());
    let mut points = vec![DVec3::NEG_Y];
    for (y, turned) in [(-height, 0), (height, 1)] {
        points.extend((0..5).map(|k| {
            let around = on_circle(2 * k + turned, 10) * radius;
            DVec3::new(around.x, y, -around.y)
        }));
    }
    points.push(DVec3::Y);
    let mut triangles = Vec::new();
    for k in 0..5 {
        let (lower, next_lower) = (1 + k, 1 + (k + 1) % 5);
        let (upper, next_upper) = (6 + k, 6 + (k + 1) % 5);
        triangles.extend([
            [0, next_lower, lower],
            [lower, next_lower, upper],
            [upper, next_lower, next_upper],
            [upper, next_upper, 11],
        ]);
    }
    (points, triangles)
}

fn longitude_latitude(points: &[DVec3], triangles: &[[u32; 3]]) -> CornerAttribute<Vec2> {
    use std::f64::consts::{PI, TAU};
    let flat: Vec<[f64; 2]> = points
        .iter()
        .map(|p| {
            let around = libm::atan2(-p.z, p.x) / TAU;
            let up = libm::atan2(p.y, libm::sqrt(p.x * p.x + p.z * p.z)) / PI + 0.5;
            [if around < 0.0 { around + 1.0 } else { around }, up]
        })
        .collect();
    let is_pole = |corner: u32| points[corner as usize].x == 0.0 && points[corner as usize].z == 0.0;
    let mut uvs = CornerAttribute::default();
    let mut numbers: HashMap<(u32, u64), u32> = HashMap::new();
    for corners in triangles {
        // Across the seam the small longitudes count on past one.
        let around = corners.map(|c| flat[c as usize][0]);
        let others = |keep: fn(f64, f64) -> f64, start| {
            corners
                .iter()
                .zip(around)
                .filter(|(c, _)| !is_pole(**c))
                .fold(start, |best, (_, u)| keep(best, u))
        };
        let crosses = others(f64::max, 0.0) - others(f64::min, 1.0) > 0.5;
        let unwrapped = around.map(|u| if crosses && u < 0.5 { u + 1.0 } else { u });
        // A pole has no longitude: it takes the middle of the other two.
        let sum_of_others: f64 =
            corners.iter().zip(unwrapped).filter(|(c, _)| !is_pole(**c)).map(|(_, u)| u).sum();
        uvs.corners.extend(std::array::from_fn::<u32, 3, _>(|k| {
            let u = if is_pole(corners[k]) { sum_of_others / 2.0 } else { unwrapped[k] };
            *numbers.entry((corners[k], u.to_bits())).or_insert_with(|| {
                uvs.values.push(Vec2::new(u as f32, flat[corners[k] as usize][1] as f32));
                uvs.values.len() as u32 - 1
            })
        }));
    }
    uvs
}
