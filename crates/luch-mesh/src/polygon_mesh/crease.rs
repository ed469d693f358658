//! What subdivision keeps sharp (DeRose, Kass, Truong 1998, "Subdivision surfaces in character animation").

use serde::{Deserialize, Serialize};

/// An edge that stays sharp for `sharpness` levels of subdivision.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Crease {
    /// The ends, in any order.
    pub vertices: [u32; 2],
    /// How many levels the edge stays sharp; infinite for ever, a fraction blends the last level.
    pub sharpness: f32,
}

/// A vertex that stays where it is for `sharpness` levels of subdivision.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SharpVertex {
    /// The vertex.
    pub vertex: u32,
    /// How many levels; infinite for ever, a fraction blends the last level.
    pub sharpness: f32,
}
