//! The mesh all benches use: a torus with bumps, as fine as asked for.

use glam::{Vec2, Vec3, vec3};
use std::f32::consts::TAU;

/// Corners and triangles of a mesh.
pub(crate) struct Mesh {
    pub(crate) positions: Vec<Vec3>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

/// A bumpy torus of `4 · sides²` triangles around the y axis.
pub(crate) fn bumpy_torus(sides: u32) -> Mesh {
    let rings = 2 * sides;
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for ring in 0..rings {
        let around = Vec2::from_angle(TAU * ring as f32 / rings as f32);
        for side in 0..sides {
            let about = TAU * side as f32 / sides as f32;
            let bump =
                Vec2::from_angle(9.0 * about).y * Vec2::from_angle(TAU * 31.0 * ring as f32 / rings as f32).y;
            let tube = Vec2::from_angle(about) * (0.35 + 0.04 * bump);
            positions.push(vec3(around.x * (1.0 + tube.x), tube.y, around.y * (1.0 + tube.x)));
            let at = |ring: u32, side: u32| (ring % rings) * sides + side % sides;
            let (a, b) = (at(ring, side), at(ring, side + 1));
            let (c, d) = (at(ring + 1, side + 1), at(ring + 1, side));
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    Mesh { positions, triangles }
}
