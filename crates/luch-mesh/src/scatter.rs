//! Points scattered over a surface.
//!
//! ```
//! use luch_mesh::{generate, scatter};
//!
//! let ball = generate::icosphere(1.0, 3);
//! let points = scatter::uniform(&ball, 1000, 7);
//! assert_eq!(points.len(), 1000);
//! // No two of these are closer than a twentieth.
//! let apart = scatter::apart(&ball, 0.05, 1 << 16, 7);
//! assert!(apart.len() > 1000);
//! ```

mod blue;
mod grid;

use glam::{DVec3, Vec2, Vec3};
use luch_sampling::sampler::Domain;
use luch_sampling::{Sampler, Sequence};
use rayon::prelude::*;

use crate::TriangleMesh;
pub use blue::{apart, even};

/// The most points that are made.
pub const MOST_POINTS: usize = 1 << 26;

/// A point of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scattered {
    /// Where it is.
    pub position: Vec3,
    /// The shading normal there, or that of the triangle if the mesh has none.
    pub normal: Vec3,
    /// Its place in uv set 0, if the mesh has one.
    pub uv: Option<Vec2>,
    /// The triangle.
    pub triangle: u32,
    /// The weights of the triangle's corners, one in sum.
    pub weights: [f32; 3],
}

/// Points spread evenly by area: the first `count` of a scrambled Sobol sequence over the surface. Any beginning of the list is
/// spread evenly as well; triangles that follow one another lie side by side in most meshes, so that it is so in space too.
///
/// No points if no triangle has an area. At most [`MOST_POINTS`].
pub fn uniform(mesh: &TriangleMesh, count: usize, seed: u64) -> Vec<Scattered> {
    weighted(mesh, count, seed, |_| 1.0)
}

/// Points as [`uniform`] has them, with a density in proportion to a weight of each triangle. Weights below zero and those that
/// are not finite count as zero.
pub fn weighted(
    mesh: &TriangleMesh,
    count: usize,
    seed: u64,
    weight: impl Fn(usize) -> f64 + Sync,
) -> Vec<Scattered> {
    let Some(areas) = Areas::new(mesh, weight) else { return Vec::new() };
    let count = count.min(MOST_POINTS);
    (0..count)
        .into_par_iter()
        .with_min_len(256)
        .filter_map(|index| areas.point(mesh, seed, index as u64))
        .collect()
}

/// Sums of areas, for choosing triangles.
struct Areas {
    /// For each triangle the sum up to and with it.
    sums: Vec<f64>,
}

impl Areas {
    fn new(mesh: &TriangleMesh, weight: impl Fn(usize) -> f64 + Sync) -> Option<Self> {
        let mut sums: Vec<f64> = (0..mesh.triangles.len())
            .into_par_iter()
            .map(|t| {
                let area = sound(mesh, t).map_or(0.0, |[a, b, c]| (b - a).cross(c - a).length() / 2.0);
                let weight = weight(t);
                if area.is_finite() && weight.is_finite() && weight > 0.0 { area * weight } else { 0.0 }
            })
            .collect();
        let mut sum = 0.0;
        for part in &mut sums {
            sum += *part;
            *part = sum;
        }
        (sum > 0.0 && sum.is_finite()).then_some(Self { sums })
    }

    fn total(&self) -> f64 {
        self.sums.last().copied().unwrap_or(0.0)
    }

    fn point(&self, mesh: &TriangleMesh, seed: u64, index: u64) -> Option<Scattered> {
        let sampler = Sampler::at(Sequence::Sobol, seed, [0, 0], index);
        let [choice, u, v, more] = sampler.group_words(Domain::new(0, 0));
        // Two words: even the smallest of many triangles has its turn.
        let fraction = (u64::from(choice) << 20 | u64::from(more >> 12)) as f64 / (1u64 << 52) as f64;
        let chosen = fraction * self.total();
        let triangle = self.sums.partition_point(|sum| *sum <= chosen);
        let unit = |word: u32| (word >> 8) as f32 / (1 << 24) as f32;
        let weights = luch_sampling::warp::triangle([unit(u), unit(v)]).to_array();
        (triangle < self.sums.len()).then(|| scattered(mesh, triangle, weights))
    }
}

/// The corners of a triangle if they exist and are finite.
fn sound(mesh: &TriangleMesh, triangle: usize) -> Option<[DVec3; 3]> {
    let at = |i: u32| mesh.positions.get(i as usize).filter(|p| p.is_finite()).map(|p| p.as_dvec3());
    let [a, b, c] = mesh.triangles[triangle].map(at);
    Some([a?, b?, c?])
}

fn scattered(mesh: &TriangleMesh, triangle: usize, weights: [f32; 3]) -> Scattered {
    let corners = mesh.corners(triangle).map(|corner| corner.as_dvec3());
    let [x, y, z] = weights.map(f64::from);
    let position = (corners[0] * x + corners[1] * y + corners[2] * z).as_vec3();
    let flat = || (corners[1] - corners[0]).cross(corners[2] - corners[0]).as_vec3();
    let shading =
        mesh.corner_normals(triangle).map(|[a, b, c]| a * weights[0] + b * weights[1] + c * weights[2]);
    let normal = shading.and_then(Vec3::try_normalize).or_else(|| flat().try_normalize()).unwrap_or(Vec3::Z);
    let uv = mesh.corner_uvs(triangle, 0).map(|[a, b, c]| a * weights[0] + b * weights[1] + c * weights[2]);
    Scattered { position, normal, uv, triangle: triangle as u32, weights }
}

#[cfg(test)]
mod tests;
