//! Ready-made meshes: what there is, and what each promises.
//!
//! All stand upright along +Y around the origin (the teapot on it), wound counter-clockwise seen from outside, with uv
//! origin at the lower left of the unrolled surface. Hard edges and uv seams have normals and uvs of their own;
//! positions are never split, so a closed shape is closed. Curved shapes have their vertices on the true surface: area
//! and volume approach those of the shape with the square of the resolution.
//!
//! A [`Generator`] gives polygons for editing and subdivision, mostly quads, or triangles for everything else. The
//! functions here are short for the triangles of the most common ones.
//!
//! Counts that are too small are raised to the least that gives a body, counts above [`MAX_DIVISIONS`] are lowered to it.

mod assembly;
mod capsule;
pub(crate) mod circle;
mod cone;
mod cuboid;
mod disc;
mod ellipsoid;
mod examples;
mod fan;
mod generator;
mod grid;
mod icosphere;
mod klein;
pub(crate) mod knot;
mod measures;
mod moebius;
mod plane;
mod polyhedron;
mod prism;
mod resolution;
mod rounded;
mod sphere;
mod teapot;
mod teapot_table;
mod torus;

use glam::{Vec2, Vec3};

use crate::TriangleMesh;
pub use generator::Generator;
pub use icosphere::MAX_SUBDIVISIONS;
pub use klein::KleinForm;
pub use knot::{MAX_KNOT_TURNS, MAX_SPRING_TURNS};
pub use moebius::MAX_HALF_TWISTS;
pub use polyhedron::Solid;
pub use rounded::MAX_ROUNDING;
pub use teapot::MAX_TEAPOT_DIVISIONS;

/// The most pieces along one direction.
pub const MAX_DIVISIONS: u32 = 4096;

/// A sphere by longitude and latitude: [`Generator::Sphere`].
pub fn sphere(radius: f32, segments: u32, rings: u32) -> TriangleMesh {
    Generator::Sphere { radius, segments, rings }.mesh()
}

/// A sphere of nearly equal triangles: [`Generator::Icosphere`].
pub fn icosphere(radius: f32, subdivisions: u32) -> TriangleMesh {
    Generator::Icosphere { radius, subdivisions }.mesh()
}

/// A box with hard edges: [`Generator::Cuboid`].
pub fn cuboid(size: Vec3, divisions: [u32; 3]) -> TriangleMesh {
    Generator::Cuboid { size, divisions }.mesh()
}

/// A rectangle facing up: [`Generator::Plane`].
pub fn plane(size: Vec2, divisions: [u32; 2]) -> TriangleMesh {
    Generator::Plane { size, divisions }.mesh()
}

/// A cylinder: [`Generator::Cylinder`].
pub fn cylinder(radius: f32, height: f32, segments: u32, stacks: u32, capped: bool) -> TriangleMesh {
    Generator::Cylinder { radius, height, segments, stacks, capped }.mesh()
}

/// A cone or truncated cone: [`Generator::Cone`].
pub fn cone(
    bottom_radius: f32,
    top_radius: f32,
    height: f32,
    segments: u32,
    stacks: u32,
    capped: bool,
) -> TriangleMesh {
    Generator::Cone { bottom_radius, top_radius, height, segments, stacks, capped }.mesh()
}

/// A ring: [`Generator::Torus`].
pub fn torus(major_radius: f32, minor_radius: f32, segments: u32, sides: u32) -> TriangleMesh {
    Generator::Torus { major_radius, minor_radius, segments, sides }.mesh()
}
