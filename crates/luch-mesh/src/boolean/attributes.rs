//! Normals, uvs, colours and materials of pieces, from the triangles that they were cut out of.

use glam::{DVec3, Vec2, Vec3, Vec4};

use super::{Operand, Pieces};
use crate::{Attribute, TriangleMesh, clean, weld};

/// The pieces as a mesh. `turns_second`: faces of the second body were turned inside out.
pub(super) fn carried(
    first: &TriangleMesh,
    second: &TriangleMesh,
    pieces: &Pieces,
    turns_second: bool,
) -> TriangleMesh {
    let sources: Vec<Source> =
        (0..pieces.triangles.len()).map(|t| Source::new([first, second], pieces, t, turns_second)).collect();
    let bodies = [first, second];
    let triangles = pieces.triangles.clone();
    let with_normals = bodies.iter().any(|body| !body.normals.is_empty());
    let with_colors = bodies.iter().any(|body| !body.colors.is_empty());
    let with_slots = bodies.iter().any(|body| !body.slots.is_empty());
    let sets = bodies.iter().map(|body| body.uv_sets.len()).max().unwrap_or(0);
    let mesh = TriangleMesh {
        positions: pieces.positions.iter().map(|p| p.as_vec3()).collect(),
        normals: if with_normals {
            shared(&sources, |source| source.normals(), |normal: &Vec3| normal.to_array())
        } else {
            Attribute::default()
        },
        uv_sets: (0..sets)
            .map(|set| shared(&sources, |source| source.uvs(set), |uv: &Vec2| uv.to_array()))
            .collect(),
        colors: if with_colors {
            shared(&sources, |source| source.colors(), |color: &Vec4| color.to_array())
        } else {
            Attribute::default()
        },
        slots: if with_slots {
            sources.iter().map(|s| s.body.slot(s.triangle)).collect()
        } else {
            Vec::new()
        },
        tangents: Attribute::default(),
        triangles,
    };
    clean::remove_unused_positions(&mesh).mesh
}

/// A list with the values of all corners, equal ones once.
fn shared<T: Copy, const N: usize>(
    sources: &[Source],
    values: impl Fn(&Source) -> [T; 3],
    to_array: impl Fn(&T) -> [f32; N],
) -> Attribute<T> {
    let all: Vec<T> = sources.iter().flat_map(&values).collect();
    let indices: Vec<[u32; 3]> = (0..sources.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    let attribute = Attribute::indexed(all, indices.clone());
    weld::share_values(&attribute, &indices, |value| to_array(&value).map(f32::to_bits))
}

/// Where a piece comes from.
struct Source<'a> {
    body: &'a TriangleMesh,
    triangle: usize,
    /// Weights of the three corners of that triangle, for each corner of the piece.
    weights: [[f32; 3]; 3],
    /// The piece faces the other way.
    is_turned: bool,
    facet: Vec3,
}

impl<'a> Source<'a> {
    fn new(bodies: [&'a TriangleMesh; 2], pieces: &Pieces, piece: usize, turns_second: bool) -> Self {
        let (operand, triangle) = pieces.sources[piece];
        let body = match operand {
            Operand::First => bodies[0],
            Operand::Second => bodies[1],
        };
        let triangle = (triangle as usize).min(body.triangles.len() - 1);
        let corners = body.corners(triangle).map(|p| p.as_dvec3());
        let places = pieces.triangles[piece].map(|v| pieces.positions[v as usize]);
        let [a, b, c] = places;
        let facet = (b - a).cross(c - a).try_normalize().map_or(Vec3::Z, |n| n.as_vec3());
        Self {
            body,
            triangle,
            weights: places.map(|place| weights(corners, place)),
            is_turned: turns_second && operand == Operand::Second,
            facet,
        }
    }

    fn normals(&self) -> [Vec3; 3] {
        let Some(normals) = self.body.corner_normals(self.triangle) else { return [self.facet; 3] };
        let sign = if self.is_turned { -1.0 } else { 1.0 };
        self.weights.map(|[u, v, w]| {
            let sum = normals[0] * u + normals[1] * v + normals[2] * w;
            (sum * sign).try_normalize().unwrap_or(self.facet)
        })
    }

    fn uvs(&self, set: usize) -> [Vec2; 3] {
        let Some(uvs) = self.body.corner_uvs(self.triangle, set) else { return [Vec2::ZERO; 3] };
        self.weights.map(|[u, v, w]| uvs[0] * u + uvs[1] * v + uvs[2] * w)
    }

    fn colors(&self) -> [Vec4; 3] {
        let colors = self.body.colors.corners(self.triangle, self.body.triangles[self.triangle]);
        let Some(colors) = colors else { return [Vec4::ONE; 3] };
        self.weights.map(|[u, v, w]| colors[0] * u + colors[1] * v + colors[2] * w)
    }
}

/// Barycentric coordinates of the place in the triangle that is next to a point in its plane.
fn weights([a, b, c]: [DVec3; 3], point: DVec3) -> [f32; 3] {
    let normal = (b - a).cross(c - a);
    let parts = [(b, c), (c, a), (a, b)].map(|(p, q)| (p - point).cross(q - point).dot(normal).max(0.0));
    let total = parts[0] + parts[1] + parts[2];
    if total > 0.0 { parts.map(|part| (part / total) as f32) } else { [1.0, 0.0, 0.0] }
}
