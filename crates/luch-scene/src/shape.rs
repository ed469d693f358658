//! What can be hit.

use crate::{Id, Material, Traced};
use glam::Affine3A;
use luch_mesh::TriangleMesh;
use serde::{Deserialize, Serialize};

/// A form in its own coordinates.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Shape {
    /// Triangles.
    Mesh(TriangleMesh),
    /// The exact sphere of this radius about the origin.
    Sphere {
        /// Metres.
        radius: f32,
    },
    /// The exact disc of this radius about the origin in the plane y = 0, facing +Y.
    Disc {
        /// Metres.
        radius: f32,
    },
    /// The whole plane y = 0, facing +Y.
    Plane,
    /// Another form that is met by a ray test of its own.
    Traced(Traced),
}

/// A shape put somewhere, with its materials.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Instance {
    /// What people call it; empty if it has no name.
    pub name: String,
    /// What is put.
    pub shape: Id<Shape>,
    /// For each material slot of the shape its material; a slot past the end takes the last one.
    pub materials: Vec<Id<Material>>,
    /// From the shape's coordinates to the world's; invertible.
    pub placement: Affine3A,
}

impl Instance {
    /// The material of slot `slot`, if the instance has any.
    pub fn material(&self, slot: u16) -> Option<Id<Material>> {
        self.materials.get(usize::from(slot)).or(self.materials.last()).copied()
    }
}
