//! Rays, boxes and a tree over anything that has a box.
//!
//! The one promise everything here is built around: **tree shape, build order, thread count and vector width never change
//! a hit**. A query of a tree returns the same bits as the plain loop over all primitives; [`slab`] holds the proof.
//!
//! * [`TriangleBvh`] is a tree over a triangle mesh, with a watertight test.
//! * [`SceneTree`] places meshes and simple shapes many times in a world.
//! * [`Bvh`] is the bare tree over boxes; the caller brings the leaf test.
//! * [`BruteForce`] is the loop over all triangles: the reference, and the right choice for a handful.
//!
//! ```
//! use glam::vec3;
//! use luch_bvh::{Quality, Ray, TriangleBvh};
//!
//! let positions = [vec3(0.0, 0.0, 0.0), vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0)];
//! let tree = TriangleBvh::build(&positions, &[[0, 1, 2]], Quality::Balanced);
//! let hit = tree.nearest(&Ray::new(vec3(0.25, 0.5, 2.0), vec3(0.0, 0.0, -1.0))).unwrap();
//! assert_eq!((hit.t, hit.u, hit.v, hit.primitive), (2.0, 0.25, 0.5, 0));
//! ```

mod aabb;
mod brute_force;
mod build;
mod bvh;
mod hit;
mod ray;
mod scene_tree;
pub mod shape;
pub mod simd;
pub mod slab;
mod tree;
pub mod triangle;
mod triangle_bvh;
mod wide;

pub use aabb::Aabb;
pub use brute_force::{BruteForce, TriangleTest};
pub use build::Quality;
pub use bvh::{Bvh, NearestPoint};
pub use hit::{Coherence, Crossing, Hit};
pub use ray::Ray;
pub use scene_tree::{Geometry, Instance, InstanceHit, SceneTree, Traced, TracedHit};
pub use slab::{Interval, SlabRay};
pub use tree::Statistics;
pub use triangle::Triangle;
pub use triangle_bvh::TriangleBvh;
