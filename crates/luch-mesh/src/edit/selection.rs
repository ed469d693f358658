//! Which vertices, edges or faces an operation works on.
//!
//! A selection is a rule, not a set: asked for faces, vertices or edges of a mesh, it answers for that kind. A rule about
//! one kind answers for another so: vertices hold an edge or a face if all its vertices are among them; edges hold their
//! two vertices and every face at them; faces hold all their vertices and edges. `and`, `or` and `not` join the answers.

mod evaluate;
mod parse;

use glam::DVec3;

use super::Field;
use crate::PolygonMesh;
pub use parse::SelectionError;

/// A rule that selects elements of any mesh.
#[derive(Clone, Debug, PartialEq)]
pub enum Selection {
    /// Everything.
    All,
    /// Nothing.
    None,
    /// Faces by number, as ranges with both ends.
    Faces(Vec<[u32; 2]>),
    /// Vertices by number, as ranges with both ends.
    Vertices(Vec<[u32; 2]>),
    /// Edges by their ends, in any order.
    Edges(Vec<[u32; 2]>),
    /// Vertices in a box, its surface included.
    Box {
        /// The lowest corner.
        low: DVec3,
        /// The highest corner.
        high: DVec3,
    },
    /// Vertices in a ball, its surface included.
    Sphere {
        /// Its centre.
        center: DVec3,
        /// Its radius.
        radius: f64,
    },
    /// Faces whose normal is near a direction.
    Normal {
        /// The direction, of any length.
        direction: DVec3,
        /// The widest angle to it, in radians.
        angle: f64,
    },
    /// Faces of the piece of this number; pieces hang together by edges and are numbered by their first face.
    Component(u32),
    /// Faces with the material slot of this number.
    Material(u16),
    /// Edges of one face.
    Border,
    /// Edges of two faces whose normals differ by more than an angle in radians.
    Sharp(f64),
    /// Edges marked as creases.
    Creased,
    /// Faces with so many corners, from the first number to the second.
    Corners([u32; 2]),
    /// Vertices where a formula of x, y and z is true: neither zero nor undefined.
    Where(Field),
    /// What all of these select.
    And(Vec<Selection>),
    /// What any of these selects.
    Or(Vec<Selection>),
    /// What this does not select.
    Not(Box<Selection>),
    /// What this selects and its neighbours, so many times.
    Grow(Box<Selection>, u32),
    /// What this selects without what has a neighbour outside, so many times.
    Shrink(Box<Selection>, u32),
}

impl Selection {
    /// Reads a rule such as `normal(0,1,0, 30deg) and not box(-1,-1,-1, 1,1,1)`.
    ///
    /// Rules: `all`, `none`, `faces(0-5,9)`, `vertices(3)`, `edges(0-1,4-5)`, `box(x,y,z, x,y,z)`,
    /// `sphere(x,y,z, radius)`, `normal(x,y,z, angle)`, `component(0)`, `material(1)`, `border`, `sharp(angle)`, `creased`,
    /// `corners(4)` or `corners(5-9)`, `where(z > 0 and x < 1)` by formula, `grow(RULE, times)`, `shrink(RULE, times)`; joined by `and`, `or`, `not` and parentheses, of
    /// which `not` binds most and `or` least. Angles are in degrees unless they end in `rad` or `turn`.
    pub fn parse(text: &str) -> Result<Self, SelectionError> {
        parse::parse(text)
    }

    /// One flag for each face.
    pub fn faces(&self, mesh: &PolygonMesh) -> Vec<bool> {
        let mesh = &*super::prepared(mesh);
        evaluate::Elements::new(mesh).faces(self)
    }

    /// One flag for each position.
    pub fn vertices(&self, mesh: &PolygonMesh) -> Vec<bool> {
        let mesh = &*super::prepared(mesh);
        evaluate::Elements::new(mesh).vertices(self)
    }

    /// The selected edges: lower end first, rising.
    pub fn edges(&self, mesh: &PolygonMesh) -> Vec<[u32; 2]> {
        let mesh = &*super::prepared(mesh);
        let elements = evaluate::Elements::new(mesh);
        let flags = elements.edges(self);
        elements.edge_list().zip(flags).filter_map(|(edge, selected)| selected.then_some(edge)).collect()
    }
}
