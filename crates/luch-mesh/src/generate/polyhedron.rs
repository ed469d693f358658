//! Regular polyhedra and what becomes of them when their corners are cut off.

use std::collections::HashMap;

use glam::{DVec2, DVec3, Vec2};

use super::assembly::Assembly;
use super::icosphere::icosahedron;
use crate::PolygonMesh;

/// Convex bodies whose faces are regular and whose corners are all alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Solid {
    /// 4 triangles.
    Tetrahedron,
    /// 6 squares.
    Cube,
    /// 8 triangles.
    Octahedron,
    /// 12 pentagons.
    Dodecahedron,
    /// 20 triangles.
    Icosahedron,
    /// 4 triangles, 4 hexagons.
    TruncatedTetrahedron,
    /// 8 triangles, 6 octagons.
    TruncatedCube,
    /// 6 squares, 8 hexagons.
    TruncatedOctahedron,
    /// 20 triangles, 12 decagons.
    TruncatedDodecahedron,
    /// 12 pentagons, 20 hexagons: the football.
    TruncatedIcosahedron,
    /// 8 triangles, 6 squares.
    Cuboctahedron,
    /// 20 triangles, 12 pentagons.
    Icosidodecahedron,
}

impl Solid {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::Tetrahedron,
        Self::Cube,
        Self::Octahedron,
        Self::Dodecahedron,
        Self::Icosahedron,
        Self::TruncatedTetrahedron,
        Self::TruncatedCube,
        Self::TruncatedOctahedron,
        Self::TruncatedDodecahedron,
        Self::TruncatedIcosahedron,
        Self::Cuboctahedron,
        Self::Icosidodecahedron,
    ];

    /// Radius of the sphere through the corners, area and volume, for edges of length 1.
    pub(super) fn measures(self) -> SolidMeasures {
        let root = f64::sqrt;
        let (two, three, five) = (root(2.0), root(3.0), root(5.0));
        let pentagons = root(25.0 + 10.0 * five);
        let [radius, area, volume] = match self {
            Self::Tetrahedron => [root(6.0) / 4.0, three, 1.0 / (6.0 * two)],
            Self::Cube => [three / 2.0, 6.0, 1.0],
            Self::Octahedron => [1.0 / two, 2.0 * three, two / 3.0],
            Self::Dodecahedron => [three * (1.0 + five) / 4.0, 3.0 * pentagons, (15.0 + 7.0 * five) / 4.0],
            Self::Icosahedron => [root(10.0 + 2.0 * five) / 4.0, 5.0 * three, 5.0 * (3.0 + five) / 12.0],
            Self::TruncatedTetrahedron => [root(22.0) / 4.0, 7.0 * three, 23.0 * two / 12.0],
            Self::TruncatedCube => {
                [root(7.0 + 4.0 * two) / 2.0, 2.0 * (6.0 + 6.0 * two + three), (21.0 + 14.0 * two) / 3.0]
            }
            Self::TruncatedOctahedron => [root(10.0) / 2.0, 6.0 + 12.0 * three, 8.0 * two],
            Self::TruncatedDodecahedron => [
                root(74.0 + 30.0 * five) / 4.0,
                5.0 * (three + 6.0 * root(5.0 + 2.0 * five)),
                5.0 * (99.0 + 47.0 * five) / 12.0,
            ],
            Self::TruncatedIcosahedron => {
                [root(58.0 + 18.0 * five) / 4.0, 30.0 * three + 3.0 * pentagons, (125.0 + 43.0 * five) / 4.0]
            }
            Self::Cuboctahedron => [1.0, 6.0 + 2.0 * three, 5.0 * two / 3.0],
            Self::Icosidodecahedron => {
                [(1.0 + five) / 2.0, 5.0 * three + 3.0 * pentagons, (45.0 + 17.0 * five) / 6.0]
            }
        };
        SolidMeasures { radius, area, volume }
    }

    fn faces(self) -> Faces {
        match self {
            Self::Tetrahedron => Faces::tetrahedron(),
            Self::Cube => Faces::octahedron().dual(),
            Self::Octahedron => Faces::octahedron(),
            Self::Dodecahedron => Faces::icosahedron().dual(),
            Self::Icosahedron => Faces::icosahedron(),
            Self::TruncatedTetrahedron => Faces::tetrahedron().truncated(),
            Self::TruncatedCube => Faces::octahedron().dual().truncated(),
            Self::TruncatedOctahedron => Faces::octahedron().truncated(),
            Self::TruncatedDodecahedron => Faces::icosahedron().dual().truncated(),
            Self::TruncatedIcosahedron => Faces::icosahedron().truncated(),
            Self::Cuboctahedron => Faces::octahedron().rectified(),
            Self::Icosidodecahedron => Faces::icosahedron().rectified(),
        }
    }
}

/// Measures of a solid with edges of length 1.
pub(super) struct SolidMeasures {
    pub radius: f64,
    pub area: f64,
    pub volume: f64,
}

/// See [`super::Generator::Polyhedron`].
pub(super) fn polyhedron(solid: Solid, radius: f32) -> PolygonMesh {
    let Faces { points, faces } = solid.faces();
    let mut assembly = Assembly::default();
    for face in faces {
        let corners: Vec<DVec3> =
            face.iter().map(|&k| points[k as usize].normalize() * f64::from(radius)).collect();
        let normal = face.iter().map(|&k| points[k as usize]).sum::<DVec3>().normalize();
        // Each face lies upright in the middle of the uv square: its corners on the inscribed circle.
        let up = if normal.y.abs() < 0.999 { DVec3::Y } else { DVec3::NEG_Z * normal.y };
        let right = up.cross(normal).normalize();
        let up = normal.cross(right);
        let uv = |corner: &DVec3| {
            let flat = DVec2::new(corner.dot(right), corner.dot(up)).normalize_or_zero();
            (flat * 0.5 + 0.5).as_vec2()
        };
        let uvs: Vec<Vec2> = corners.iter().map(uv).collect();
        assembly.flat_face(&corners, &uvs, normal);
    }
    assembly.finish()
}

/// A convex polyhedron around the origin.
struct Faces {
    points: Vec<DVec3>,
    faces: Vec<Vec<u32>>,
}

impl Faces {
    /// Four corners of a cube.
    fn tetrahedron() -> Self {
        let points =
            [(1.0, 1.0, 1.0), (-1.0, 1.0, -1.0), (-1.0, -1.0, 1.0), (1.0, -1.0, -1.0)].map(DVec3::from);
        let faces = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]].map(Vec::from);
        Self { points: points.into(), faces: faces.into() }
    }

    /// The six ends of the axes.
    fn octahedron() -> Self {
        let points = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
        let mut faces = Vec::new();
        for octant in 0..8u32 {
            let ends = [0, 1, 2].map(|axis| 2 * axis + (octant >> axis & 1));
            // Each reflection turns the face round.
            let [x, y, z] = ends;
            faces.push(if octant.count_ones() % 2 == 0 { vec![x, y, z] } else { vec![x, z, y] });
        }
        Self { points: points.into(), faces }
    }

    fn icosahedron() -> Self {
        let (points, triangles) = icosahedron();
        Self { points, faces: triangles.into_iter().map(Vec::from).collect() }
    }

    /// For each directed edge the face it belongs to and the corner before it.
    fn half_edges(&self) -> HashMap<[u32; 2], HalfEdge> {
        let mut half_edges = HashMap::new();
        for (number, face) in self.faces.iter().enumerate() {
            for (place, &from) in face.iter().enumerate() {
                let to = face[(place + 1) % face.len()];
                let before = face[(place + face.len() - 1) % face.len()];
                half_edges.insert([from, to], HalfEdge { face: number as u32, before });
            }
        }
        half_edges
    }

    /// The edges from a corner, counter-clockwise seen from outside.
    fn edges_at(&self, corner: u32, half_edges: &HashMap<[u32; 2], HalfEdge>) -> Vec<[u32; 2]> {
        let face = self.faces.iter().find(|face| face.contains(&corner));
        let first = face.and_then(|face| {
            let place = face.iter().position(|&k| k == corner)?;
            Some(face[(place + 1) % face.len()])
        });
        let Some(first) = first else { return Vec::new() };
        let mut edges = vec![[corner, first]];
        let mut end = half_edges[&[corner, first]].before;
        while end != first {
            edges.push([corner, end]);
            end = half_edges[&[corner, end]].before;
        }
        edges
    }

    /// Faces become corners and corners faces.
    fn dual(&self) -> Self {
        let middle =
            |face: &Vec<u32>| face.iter().map(|&k| self.points[k as usize]).sum::<DVec3>().normalize();
        let half_edges = self.half_edges();
        let around = |corner: u32| {
            let edges = self.edges_at(corner, &half_edges);
            edges.iter().map(|edge| half_edges[edge].face).collect()
        };
        Self {
            points: self.faces.iter().map(middle).collect(),
            faces: (0..self.points.len() as u32).map(around).collect(),
        }
    }

    /// Corners cut off so that the faces, n-gons before, are regular 2n-gons.
    fn truncated(&self) -> Self {
        let sides = self.faces[0].len() as f64;
        let share = 1.0 / (2.0 + 2.0 * libm::cos(std::f64::consts::PI / sides));
        self.cut(|from, to| from + (to - from) * share, true)
    }

    /// Corners cut off to the middles of the edges.
    fn rectified(&self) -> Self {
        self.cut(|from, to| (from + to) / 2.0, false)
    }

    /// One point on each directed edge, or on each edge; one face for each face and for each corner.
    fn cut(&self, place: impl Fn(DVec3, DVec3) -> DVec3, is_directed: bool) -> Self {
        let mut cut = Self { points: Vec::new(), faces: Vec::new() };
        let mut numbers: HashMap<[u32; 2], u32> = HashMap::new();
        let half_edges = self.half_edges();
        let mut number = |[from, to]: [u32; 2]| {
            let key = if is_directed { [from, to] } else { [from.min(to), from.max(to)] };
            *numbers.entry(key).or_insert_with(|| {
                cut.points.push(place(self.points[from as usize], self.points[to as usize]));
                cut.points.len() as u32 - 1
            })
        };
        for face in &self.faces {
            let mut corners = Vec::new();
            for (place, &from) in face.iter().enumerate() {
                let to = face[(place + 1) % face.len()];
                corners.push(number([from, to]));
                if is_directed {
                    corners.push(number([to, from]));
                }
            }
            cut.faces.push(corners);
        }
        for corner in 0..self.points.len() as u32 {
            let edges = self.edges_at(corner, &half_edges);
            cut.faces.push(edges.into_iter().map(&mut number).collect());
        }
        cut
    }
}

/// What lies beside a directed edge.
struct HalfEdge {
    face: u32,
    before: u32,
}
