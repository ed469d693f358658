//! How far one mesh is from another.
//!
//! The distance to a mesh is not convex, but the distance to one triangle of it is: over a piece of the other mesh it is
//! greatest at a corner. So every piece has an upper bound, by the triangle nearest to its middle, and a lower one, by its
//! corners. Pieces whose upper bound is above what is known to be reached are cut into four, until the bounds meet.

use glam::{DVec3, Vec3};
use rayon::prelude::*;
use serde::Serialize;

use super::Surface;
use super::nearest::nearest_weights;
use crate::{TriangleMesh, scatter};

/// How exactly a deviation is wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeviationOptions {
    /// Bounds of the greatest distance may differ by so much of the diagonal of both meshes.
    pub tolerance: f64,
    /// Points for the mean.
    pub samples: usize,
    /// Pieces that are looked at, at most.
    pub most_pieces: usize,
}

impl Default for DeviationOptions {
    fn default() -> Self {
        Self { tolerance: 1e-4, samples: 10_000, most_pieces: 1 << 22 }
    }
}

/// How far the points of one mesh are from another mesh: one direction only.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Deviation {
    /// A distance that is reached, at `at`.
    pub greatest: f64,
    /// No point is farther than this.
    pub upper_bound: f64,
    /// Where the greatest distance is reached.
    pub at: [f64; 3],
    /// The mean over the surface, by sampling.
    pub mean: f64,
    /// Root of the mean square over the surface, by sampling.
    pub root_mean_square: f64,
}

/// Deviation of both meshes from each other: the greater of both directions is the Hausdorff distance. `None` if one of them
/// has no triangles.
pub fn hausdorff(
    one: &TriangleMesh,
    other: &TriangleMesh,
    options: &DeviationOptions,
) -> Option<[Deviation; 2]> {
    let surfaces = [Surface::new(one), Surface::new(other)];
    Some([deviation(one, &surfaces[1], options)?, deviation(other, &surfaces[0], options)?])
}

/// How far the points of `from` are from a surface. `None` if one of them has no triangles.
pub fn deviation(from: &TriangleMesh, to: &Surface, options: &DeviationOptions) -> Option<Deviation> {
    let mut pieces: Vec<Piece> = (0..from.triangles.len())
        .into_par_iter()
        .filter_map(|t| super::sound_corners(from, t))
        .filter_map(|corners| Piece::new(corners.map(|corner| corner.as_dvec3()), to))
        .collect();
    let (mut least, mut most) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for corner in pieces.iter().flat_map(|piece| piece.corners) {
        (least, most) = (least.min(corner.as_vec3()), most.max(corner.as_vec3()));
    }
    let bounds = to.tree.bounds(1);
    let diagonal = (most.max(bounds.max).as_dvec3() - least.min(bounds.min).as_dvec3()).length();
    let tolerance = options.tolerance.max(1e-12) * diagonal;
    let mut deviation = Deviation::default();
    deviation.note(&pieces)?;
    let mut looked_at = pieces.len();
    // What may still be passed by pieces that are no longer cut.
    let mut settled = deviation.greatest;
    loop {
        let is_open = |piece: &Piece| piece.upper > deviation.greatest + tolerance;
        settled =
            pieces.iter().filter(|piece| !is_open(piece)).map(|piece| piece.upper).fold(settled, f64::max);
        pieces.retain(is_open);
        if pieces.is_empty() || looked_at + 4 * pieces.len() > options.most_pieces {
            break;
        }
        pieces = pieces.par_iter().flat_map_iter(|piece| piece.quarters(to)).collect();
        looked_at += pieces.len();
        deviation.note(&pieces)?;
    }
    deviation.upper_bound =
        pieces.iter().map(|piece| piece.upper).fold(settled, f64::max).max(deviation.greatest);
    deviation.note_means(from, to, options.samples);
    Some(deviation)
}

impl Deviation {
    /// Takes over the farthest corner; `None` if there is nothing at all.
    fn note(&mut self, pieces: &[Piece]) -> Option<()> {
        let farthest = pieces.iter().max_by(|one, other| one.lower.total_cmp(&other.lower))?;
        if farthest.lower >= self.greatest {
            (self.greatest, self.at) = (farthest.lower, farthest.farthest.to_array());
        }
        Some(())
    }

    fn note_means(&mut self, from: &TriangleMesh, to: &Surface, samples: usize) {
        let points = scatter::uniform(from, samples, 0);
        let nearest: Vec<f64> =
            points.par_iter().filter_map(|sample| Some(to.nearest(sample.position)?.distance)).collect();
        let count = nearest.len().max(1) as f64;
        self.mean = nearest.iter().sum::<f64>() / count;
        self.root_mean_square =
            (nearest.iter().map(|distance| distance * distance).sum::<f64>() / count).sqrt();
    }
}

/// A part of a triangle and what is known of its distances.
struct Piece {
    corners: [DVec3; 3],
    /// The greatest distance of a corner.
    lower: f64,
    farthest: DVec3,
    /// No point of the piece is farther.
    upper: f64,
}

impl Piece {
    fn new(corners: [DVec3; 3], to: &Surface) -> Option<Self> {
        let ask = |point| super::nearest::nearest(to.mesh, &to.tree, point, f64::INFINITY);
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        let [a, b, c, m] = [corners[0], corners[1], corners[2], middle].map(ask);
        let found = [a?, b?, c?];
        let farthest = (0..3).max_by(|&one, &other| found[one].distance.total_cmp(&found[other].distance))?;
        // The distance to any one triangle bounds that to the surface, and is greatest at a corner of the piece.
        let to_triangle = |triangle: u32| {
            let triangle = to.mesh.corners(triangle as usize).map(|corner| corner.as_dvec3());
            let distances = corners.map(|corner| {
                let weights = nearest_weights(triangle, corner);
                corner
                    .distance(triangle[0] * weights[0] + triangle[1] * weights[1] + triangle[2] * weights[2])
            });
            distances.into_iter().fold(0.0, f64::max)
        };
        let candidates = [m?.triangle, found[0].triangle, found[1].triangle, found[2].triangle];
        let mut upper = candidates.into_iter().map(to_triangle).fold(f64::INFINITY, f64::min);
        // No point is farther from a corner than the longest edge there.
        for k in 0..3 {
            let longest =
                corners[k].distance(corners[(k + 1) % 3]).max(corners[k].distance(corners[(k + 2) % 3]));
            upper = upper.min(found[k].distance + longest);
        }
        let lower = found[farthest].distance;
        Some(Self { corners, lower, farthest: corners[farthest], upper: upper.max(lower) })
    }

    fn quarters(&self, to: &Surface) -> impl Iterator<Item = Self> {
        let [a, b, c] = self.corners;
        let (ab, bc, ca) = ((a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0);
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            .into_iter()
            .filter_map(|corners| Self::new(corners, to))
    }
}
