//! Meshes made by formulas.

use crate::random::Random;
use glam::{Vec2, Vec3, vec3};
use std::f32::consts::{PI, TAU};

#[derive(Clone)]
pub(crate) struct Mesh {
    pub(crate) name: String,
    pub(crate) positions: Vec<Vec3>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

impl Mesh {
    pub(crate) fn new(name: &str, positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Self {
        Self { name: name.into(), positions, triangles }
    }

    pub(crate) fn corners(&self, triangle: usize) -> [Vec3; 3] {
        self.triangles[triangle].map(|corner| self.positions[corner as usize])
    }

    pub(crate) fn mapped(mut self, name: &str, map: impl Fn(Vec3) -> Vec3) -> Self {
        self.positions.iter_mut().for_each(|position| *position = map(*position));
        self.name = format!("{} {name}", self.name);
        self
    }
}

/// Closed and convex; counter-clockwise seen from outside.
pub(crate) fn sphere(rings: u32, sectors: u32) -> Mesh {
    let mut positions = vec![Vec3::Y];
    for ring in 1..rings {
        let polar = Vec2::from_angle(PI * ring as f32 / rings as f32);
        for sector in 0..sectors {
            let around = Vec2::from_angle(TAU * sector as f32 / sectors as f32);
            positions.push(vec3(polar.y * around.x, polar.x, -polar.y * around.y));
        }
    }
    positions.push(Vec3::NEG_Y);
    let at = |ring: u32, sector: u32| 1 + (ring - 1) * sectors + sector % sectors;
    let south = positions.len() as u32 - 1;
    let mut triangles = Vec::new();
    for sector in 0..sectors {
        triangles.push([0, at(1, sector), at(1, sector + 1)]);
        triangles.push([south, at(rings - 1, sector + 1), at(rings - 1, sector)]);
        for ring in 1..rings - 1 {
            let [a, b] = [at(ring, sector), at(ring, sector + 1)];
            let [c, d] = [at(ring + 1, sector + 1), at(ring + 1, sector)];
            triangles.extend([[a, d, c], [a, c, b]]);
        }
    }
    Mesh::new("sphere", positions, triangles)
}

pub(crate) fn torus(rings: u32, sides: u32) -> Mesh {
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for ring in 0..rings {
        let around = Vec2::from_angle(TAU * ring as f32 / rings as f32);
        for side in 0..sides {
            let tube = Vec2::from_angle(TAU * side as f32 / sides as f32) * 0.4;
            positions.push(vec3(around.x * (1.0 + tube.x), tube.y, around.y * (1.0 + tube.x)));
            let at = |ring: u32, side: u32| (ring % rings) * sides + side % sides;
            let (a, b, c, d) =
                (at(ring, side), at(ring, side + 1), at(ring + 1, side + 1), at(ring + 1, side));
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    Mesh::new("torus", positions, triangles)
}

/// A flat grid in the plane y = 0: boxes without height, vertices at round coordinates.
pub(crate) fn grid(size: u32) -> Mesh {
    let at = |x: u32, z: u32| x + z * (size + 1);
    let position = |index: u32| vec3((index % (size + 1)) as f32, 0.0, (index / (size + 1)) as f32);
    let positions = (0..(size + 1) * (size + 1)).map(position).collect();
    let cell = |index: u32| {
        let (x, z) = (index % size, index / size);
        [[at(x, z), at(x, z + 1), at(x + 1, z + 1)], [at(x, z), at(x + 1, z + 1), at(x + 1, z)]]
    };
    Mesh::new("grid", positions, (0..size * size).flat_map(cell).collect())
}

/// The cube from -1 to 1, two triangles a side.
pub(crate) fn cube() -> Mesh {
    let corner = |index: u32| {
        let sign = |bit: u32| if index >> bit & 1 == 1 { 1.0 } else { -1.0 };
        vec3(sign(0), sign(1), sign(2))
    };
    let sides = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    Mesh::new("cube", (0..8).map(corner).collect(), triangles)
}

/// Triangles thrown anywhere, of all sizes; among them copies, degenerate ones, corners that are no numbers, wrong indices.
pub(crate) fn soup(count: u32, seed: u64) -> Mesh {
    let mut random = Random::new(seed);
    let mut positions = Vec::new();
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    for index in 0..count {
        let first = positions.len() as u32;
        let middle = random.vector();
        let size = [1e-4, 0.02, 0.1, 1.0][random.below(4)];
        positions.extend((0..3).map(|_| middle + random.vector() * size));
        match random.below(24) {
            0 => positions[first as usize].x = f32::NAN,
            1 => positions[first as usize + 1].z = f32::INFINITY,
            2 => positions[first as usize + 2] = positions[first as usize],
            3 => {
                positions[first as usize + 2] =
                    (positions[first as usize] + positions[first as usize + 1]) * 0.5
            }
            4 => triangles.push([first, first + 1, u32::MAX - index]),
            5 | 6 if index > 0 => triangles.push(triangles[random.below(triangles.len())]),
            _ => {}
        }
        triangles.push([first, first + 1, first + 2]);
    }
    Mesh::new("soup", positions, triangles)
}

pub(crate) fn all() -> Vec<Mesh> {
    let far = vec3(4096.5, -777.25, 65_000.0);
    vec![
        cube(),
        sphere(12, 20),
        torus(24, 12),
        grid(12),
        soup(500, 7),
        torus(24, 12).mapped("far away", |p| p + far),
        soup(200, 8).mapped("flattened", |p| p * vec3(1.0, 0.0, 1.0)),
        cube().mapped("in a far corner", |p| p * 1e-3 + far),
    ]
}
