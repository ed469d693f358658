//! Questions about places near, on and in a mesh: nearest point, signed distance, inside or not, rays, how far apart two
//! meshes are.
//!
//! ```
//! use glam::Vec3;
//! use luch_mesh::{generate, query::Surface};
//!
//! let ball = generate::icosphere(1.0, 4);
//! let surface = Surface::new(&ball);
//! let nearest = surface.nearest(Vec3::new(0.0, 3.0, 0.0)).unwrap();
//! assert!((nearest.distance - 2.0).abs() < 1e-6);
//! assert!(surface.is_inside(Vec3::ZERO) && !surface.is_inside(Vec3::ONE));
//! assert!((surface.signed_distance(Vec3::X * 0.5).unwrap() + 0.5).abs() < 0.01);
//! ```
//!
//! Every question can be asked in bulk, on all threads of the current pool, with the same bits as one by one. Triangles with
//! an index out of range or a corner that is not finite take no part.

mod hausdorff;
mod nearest;
mod rays;
mod sign;
pub(crate) mod tree;
mod winding;

use glam::Vec3;
use luch_bvh::Aabb;
use rayon::prelude::*;

use crate::TriangleMesh;
pub use hausdorff::{Deviation, DeviationOptions, deviation, hausdorff};
pub use nearest::Nearest;
pub use rays::Rays;
use sign::Pseudonormals;
use tree::{BoxTree, bounds_of};
use winding::Dipoles;

/// A mesh made ready to be asked.
pub struct Surface<'a> {
    mesh: &'a TriangleMesh,
    tree: BoxTree,
    sign: Sign,
}

/// How inside is told from outside.
enum Sign {
    /// By the side of the nearest point: for closed meshes.
    Pseudonormals(Pseudonormals),
    /// By how often the surface goes round the point: for all others.
    Winding(Dipoles),
}

impl<'a> Surface<'a> {
    /// Builds the trees. Closed meshes tell inside from outside by the side of the nearest point, all others by the winding
    /// number. Equal positions count as one.
    pub fn new(mesh: &'a TriangleMesh) -> Self {
        let tree = BoxTree::new(mesh.triangles.len(), |t| match sound_corners(mesh, t) {
            Some(corners) => bounds_of(corners),
            None => Aabb::empty(),
        });
        let sign = match Pseudonormals::new(mesh) {
            Some(pseudonormals) => Sign::Pseudonormals(pseudonormals),
            None => Sign::Winding(Dipoles::new(mesh, &tree)),
        };
        Self { mesh, tree, sign }
    }

    /// The nearest point of the surface; of equally near triangles the lowest. `None` if there are no triangles or `point` is
    /// not finite.
    pub fn nearest(&self, point: Vec3) -> Option<Nearest> {
        nearest::nearest(self.mesh, &self.tree, point.as_dvec3(), f64::INFINITY)
    }

    /// The nearest point no farther than `farthest`.
    pub fn nearest_within(&self, point: Vec3, farthest: f64) -> Option<Nearest> {
        nearest::nearest(self.mesh, &self.tree, point.as_dvec3(), farthest)
    }

    /// [`Surface::nearest`] of each point.
    pub fn nearest_of_all(&self, points: &[Vec3]) -> Vec<Option<Nearest>> {
        points.par_iter().map(|&point| self.nearest(point)).collect()
    }

    /// Distance to the surface, negative inside.
    ///
    /// For closed meshes the sign is that of the angle-weighted pseudonormal at the nearest point (Bærentzen & Aanæs, "Signed
    /// distance computation using the angle weighted pseudonormal", 2005), which is exact; for others that of the
    /// winding number.
    pub fn signed_distance(&self, point: Vec3) -> Option<f64> {
        let nearest = self.nearest(point)?;
        let is_inside = match &self.sign {
            Sign::Pseudonormals(normals) => {
                let normal = normals.at(self.mesh, &nearest);
                (point.as_dvec3() - nearest.point).dot(normal) < 0.0
            }
            Sign::Winding(dipoles) => dipoles.winding_number(self.mesh, &self.tree, point.as_dvec3()) > 0.5,
        };
        Some(if is_inside { -nearest.distance } else { nearest.distance })
    }

    /// [`Surface::signed_distance`] of each point.
    pub fn signed_distance_of_all(&self, points: &[Vec3]) -> Vec<Option<f64>> {
        points.par_iter().map(|&point| self.signed_distance(point)).collect()
    }

    /// True if a point is inside; points on the surface count as outside.
    pub fn is_inside(&self, point: Vec3) -> bool {
        match &self.sign {
            Sign::Pseudonormals(_) => {
                let bounds = self.tree.bounds(1);
                let is_in_box = point.cmpge(bounds.min).all() && point.cmple(bounds.max).all();
                is_in_box && self.signed_distance(point).is_some_and(|distance| distance < 0.0)
            }
            Sign::Winding(dipoles) => dipoles.winding_number(self.mesh, &self.tree, point.as_dvec3()) > 0.5,
        }
    }

    /// [`Surface::is_inside`] of each point.
    pub fn is_inside_of_all(&self, points: &[Vec3]) -> Vec<bool> {
        points.par_iter().map(|&point| self.is_inside(point)).collect()
    }
}

/// The generalised winding number of a mesh about each point: 1 inside and 0 outside of a closed mesh that faces outward,
/// fractions near the holes of an open one (Jacobson, Kavan, Sorkine-Hornung, "Robust inside-outside segmentation using
/// generalized winding numbers", 2013). Far triangles are taken together, which costs less than 0.02.
pub fn winding_numbers(mesh: &TriangleMesh, points: &[Vec3]) -> Vec<f64> {
    let tree =
        BoxTree::new(mesh.triangles.len(), |t| sound_corners(mesh, t).map_or(Aabb::empty(), bounds_of));
    let dipoles = Dipoles::new(mesh, &tree);
    points.par_iter().map(|point| dipoles.winding_number(mesh, &tree, point.as_dvec3())).collect()
}

/// The corners of a triangle if they exist and are finite.
fn sound_corners(mesh: &TriangleMesh, triangle: usize) -> Option<[Vec3; 3]> {
    let [a, b, c] =
        mesh.triangles[triangle].map(|i| mesh.positions.get(i as usize).filter(|p| p.is_finite()).copied());
    Some([a?, b?, c?])
}

#[cfg(test)]
mod tests;
