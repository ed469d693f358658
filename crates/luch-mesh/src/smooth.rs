//! Smoothing, and triangles of even size.
//!
//! [`smooth`] moves vertices and changes nothing else: Laplace (shrinks) or Taubin (does not). [`remesh`] makes new triangles
//! with edges of a given length on the same surface.

mod remesh;
mod surface;

use glam::DVec3;
use rayon::prelude::*;

use crate::PolygonMesh;
use crate::polygon_mesh::HalfEdges;
use crate::repair::sound;
pub use remesh::{MOST_TRIANGLES, Remesh, RemeshError, remesh};

/// How neighbours count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Weights {
    /// All alike: vertices also become evenly spread.
    #[default]
    Uniform,
    /// By the cotangents of the angles across the edge (Pinkall and Polthier 1993), those of obtuse pairs as zero: vertices move
    /// along the normal only.
    Cotangent,
}

/// How to smooth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// How often.
    pub iterations: u32,
    /// How far toward the mean of the neighbours, from 0 to 1.
    pub factor: f64,
    /// How far back after each step, from 0 to 1 (μ of Taubin 1995, "A signal processing approach to fair surface design",
    /// without its sign); somewhat more than `factor` keeps the volume. Zero for plain Laplace.
    pub back: f64,
    /// How neighbours count.
    pub weights: Weights,
    /// Borders stay; else they are smoothed as curves.
    pub keeps_borders: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self { iterations: 10, factor: 0.5, back: 0.0, weights: Weights::Uniform, keeps_borders: true }
    }
}

/// The most iterations.
pub const MOST_ITERATIONS: u32 = 1 << 16;

/// Smooths the positions of a mesh; faces, uvs and creases stay. Normals, if there are any, become the means of facets.
///
/// Factors are clamped to their range. Positions in no sound face stay. Where more than two faces meet at an edge,
/// vertices stay.
pub fn smooth(mesh: &PolygonMesh, settings: &Settings) -> PolygonMesh {
    let neighbours = Neighbours::of(mesh, settings);
    let mut places: Vec<DVec3> = mesh.positions.iter().map(|p| p.as_dvec3()).collect();
    let clamped = |x: f64| if x.is_finite() { x.clamp(0.0, 1.0) } else { 0.0 };
    for _ in 0..settings.iterations.min(MOST_ITERATIONS) {
        places = neighbours.step(&places, clamped(settings.factor));
        if settings.back > 0.0 {
            places = neighbours.step(&places, -clamped(settings.back));
        }
    }
    let mut smooth = mesh.clone();
    for (position, place) in smooth.positions.iter_mut().zip(places) {
        // Going back too far may run away.
        if place.as_vec3().is_finite() {
            *position = place.as_vec3();
        }
    }
    if !smooth.normals.is_empty() {
        smooth.normals = facet_means(&smooth);
    }
    smooth
}

/// Means of the facets about each value of the normals: hard edges stay hard.
fn facet_means(mesh: &PolygonMesh) -> crate::polygon_mesh::CornerAttribute<glam::Vec3> {
    let mut normals = mesh.normals.clone();
    let mut sums = vec![DVec3::ZERO; normals.values.len()];
    for face in 0..mesh.face_count() {
        let corners = mesh.face(face);
        let place = |corner: usize| {
            mesh.corners.get(corner).and_then(|&v| mesh.positions.get(v as usize)).map(|p| p.as_dvec3())
        };
        let Some(origin) = place(corners.start) else { continue };
        let spokes = (corners.start + 1..corners.end.max(1) - 1)
            .filter_map(|corner| Some((place(corner)? - origin).cross(place(corner + 1)? - origin)));
        let normal: DVec3 = spokes.sum();
        for corner in corners.filter(|_| normal.is_finite()) {
            let indices = if normals.corners.is_empty() { &mesh.corners } else { &normals.corners };
            if let Some(sum) = indices.get(corner).and_then(|&i| sums.get_mut(i as usize)) {
                *sum += normal;
            }
        }
    }
    for (value, sum) in normals.values.iter_mut().zip(sums) {
        *value = sum.try_normalize().map_or(*value, |n| n.as_vec3());
    }
    normals
}

/// For each vertex its neighbours with weights that add up to one; none if it stays.
struct Neighbours {
    starts: Vec<u32>,
    list: Vec<(u32, f64)>,
}

impl Neighbours {
    fn of(mesh: &PolygonMesh, settings: &Settings) -> Self {
        let mut sound = sound(mesh).mesh;
        if settings.weights == Weights::Cotangent {
            sound = PolygonMesh::from(&sound.triangulate());
        }
        let half_edges = HalfEdges::new(&sound);
        let count = sound.positions.len();
        let mut is_border = vec![false; count];
        let mut is_fixed = vec![false; count];
        for edge in half_edges.edges() {
            for &vertex in &edge.vertices {
                is_border[vertex as usize] |= edge.half_edges.len() == 1;
                is_fixed[vertex as usize] |= edge.half_edges.len() > 2;
            }
        }
        let mut links: Vec<(u32, u32, f64)> = Vec::new();
        for edge in half_edges.edges() {
            let weight = match settings.weights {
                Weights::Uniform => 1.0,
                Weights::Cotangent => {
                    let cotangents = edge.half_edges.iter().map(|&half| cotangent(&sound, &half_edges, half));
                    cotangents.sum::<f64>().max(0.0)
                }
            };
            let [a, b] = edge.vertices;
            for (from, to) in [(a, b), (b, a)] {
                let along = edge.half_edges.len() == 1 && !settings.keeps_borders;
                let moves = !is_fixed[from as usize] && (!is_border[from as usize] || along);
                if moves && weight > 0.0 && weight.is_finite() {
                    links.push((from, to, if is_border[from as usize] { 1.0 } else { weight }));
                }
            }
        }
        links.sort_by_key(|link| link.0);
        let mut starts = vec![0u32; count + 1];
        links.iter().for_each(|link| starts[link.0 as usize + 1] += 1);
        (0..count).for_each(|vertex| starts[vertex + 1] += starts[vertex]);
        let mut list: Vec<(u32, f64)> = links.iter().map(|link| (link.1, link.2)).collect();
        for pair in starts.windows(2) {
            let own = &mut list[pair[0] as usize..pair[1] as usize];
            let total: f64 = own.iter().map(|link| link.1).sum();
            own.iter_mut().for_each(|link| link.1 /= total);
        }
        Self { starts, list }
    }

    fn step(&self, places: &[DVec3], factor: f64) -> Vec<DVec3> {
        let moved = |vertex: usize| {
            let own = &self.list[self.starts[vertex] as usize..self.starts[vertex + 1] as usize];
            if own.is_empty() {
                return places[vertex];
            }
            let mean: DVec3 = own.iter().map(|&(other, weight)| places[other as usize] * weight).sum();
            places[vertex] + (mean - places[vertex]) * factor
        };
        (0..places.len()).into_par_iter().with_min_len(1 << 12).map(moved).collect()
    }
}

/// Cotangent of the angle across a half-edge of a triangle.
fn cotangent(mesh: &PolygonMesh, half_edges: &HalfEdges, half: u32) -> f64 {
    let place = |vertex: u32| mesh.positions[vertex as usize].as_dvec3();
    let tip = half_edges.next(half_edges.next(half));
    let [a, b] = half_edges.ends(half).map(|v| place(v) - place(mesh.corners[tip as usize]));
    let area = a.cross(b).length();
    if area > 0.0 { a.dot(b) / area } else { 0.0 }
}

#[cfg(test)]
mod tests;
