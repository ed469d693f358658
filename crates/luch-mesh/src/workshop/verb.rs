//! What a verb is.

use super::{Arguments, Kind, WorkshopError};
use crate::PolygonMesh;

/// A function on meshes, described.
#[derive(Clone, Copy, Debug)]
pub struct Verb {
    /// Lower case, words joined by `-`.
    pub name: &'static str,
    /// What it does, in a line without a full stop.
    pub summary: &'static str,
    /// What it takes; the first may be given without its name.
    pub parameters: &'static [Parameter],
    /// How it is used: parameters only, such as `--radius 2 --segments 24`. The contract suite runs it.
    pub example: &'static str,
    /// What it does.
    pub action: Action,
}

/// How a verb is called.
#[derive(Clone, Copy, Debug)]
pub enum Action {
    /// Makes a mesh from nothing but its arguments.
    Make {
        /// Whether the result of the example encloses a body.
        closed: bool,
        /// The function.
        run: fn(&Arguments) -> Result<PolygonMesh, WorkshopError>,
    },
    /// Changes a mesh.
    Change {
        /// What stays true of a mesh, whatever the arguments are.
        keeps: Keeps,
        /// The function. Meshes may be of any kind, broken ones too.
        run: fn(PolygonMesh, &Arguments) -> Result<PolygonMesh, WorkshopError>,
    },
}

/// What an operation keeps. The contract suite holds it to that, on every mesh that can be made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Keeps {
    /// A closed mesh stays closed, and an edge has two faces of opposite direction.
    pub closed: bool,
    /// A mesh with uvs has uvs afterwards.
    pub uvs: bool,
    /// Creases stay.
    pub creases: bool,
    /// The number of faces stays.
    pub faces: bool,
    /// The number of positions stays.
    pub positions: bool,
}

impl Keeps {
    /// Nothing.
    pub const NOTHING: Self =
        Self { closed: false, uvs: false, creases: false, faces: false, positions: false };
    /// Whatever only moves positions keeps everything.
    pub const ALL: Self = Self { closed: true, uvs: true, creases: true, faces: true, positions: true };
}

/// What a verb takes.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Lower case, words joined by `-`.
    pub name: &'static str,
    /// What it is, in a line without a full stop, with its unit.
    pub summary: &'static str,
    /// What may be given.
    pub kind: Kind,
    /// What it is if it is not given, as it would be typed.
    pub default: Fallback,
}

/// What happens where a parameter is not given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fallback {
    /// This is taken.
    Value(&'static str),
    /// There is none; the function knows what to do.
    Nothing,
    /// It must be given.
    Required,
}

impl Parameter {
    /// One that has a default.
    pub const fn new(name: &'static str, kind: Kind, default: &'static str, summary: &'static str) -> Self {
        Self { name, summary, kind, default: Fallback::Value(default) }
    }

    /// One that must be given.
    pub const fn required(name: &'static str, kind: Kind, summary: &'static str) -> Self {
        Self { name, summary, kind, default: Fallback::Required }
    }

    /// One that may be absent.
    pub const fn optional(name: &'static str, kind: Kind, summary: &'static str) -> Self {
        Self { name, summary, kind, default: Fallback::Nothing }
    }
}
