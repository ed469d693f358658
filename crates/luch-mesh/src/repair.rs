//! Putting meshes right: one function for each fault, and [`repair`] for all of them.
//!
//! Every function accepts any mesh, also one with indices out of range, and works on its sound faces: see [`sound`].

mod faces;
mod holes;
mod manifold;
mod merge;
mod orient;
mod slivers;
mod sound;

use std::fmt;

use crate::PolygonMesh;
pub(crate) use faces::with_faces;
pub use faces::{Repaired, remove_unused};
pub use holes::{Filling, MOST_CORNERS, fill_holes};
pub use manifold::make_manifold;
pub use merge::{keep_largest, merge, remove_duplicate_faces};
pub use orient::orient;
pub use slivers::{Dropped, drop_slivers};
pub use sound::{Sound, sound};

/// What [`repair`] did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// Faces that were none: too few corners, indices out of range, not finite.
    pub dropped_faces: usize,
    /// Positions merged into others.
    pub merged_positions: usize,
    /// Faces that were there already.
    pub duplicate_faces: usize,
    /// Faces turned round.
    pub turned_faces: usize,
    /// Vertices made where surfaces were parted.
    pub split_vertices: usize,
    /// Holes filled.
    pub filled_holes: usize,
    /// Positions no face used.
    pub unused_positions: usize,
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = [
            (self.dropped_faces, "faces dropped"),
            (self.merged_positions, "positions merged"),
            (self.duplicate_faces, "double faces removed"),
            (self.turned_faces, "faces turned"),
            (self.split_vertices, "vertices split"),
            (self.filled_holes, "holes filled"),
            (self.unused_positions, "unused positions removed"),
        ];
        let done: Vec<String> = parts
            .iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, what)| format!("{count} {what}"))
            .collect();
        if done.is_empty() { f.write_str("nothing to repair") } else { f.write_str(&done.join(", ")) }
    }
}

/// A repaired mesh and what was done.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outcome {
    /// The mesh.
    pub mesh: PolygonMesh,
    /// What was done.
    pub report: Report,
}

/// Makes a closed, consistently wound manifold if the faces allow it: merges positions within `distance`, removes double
/// faces, turns faces, parts what is no manifold, fills all holes, and leaves out what is not used.
pub fn repair(mesh: &PolygonMesh, distance: f32) -> Outcome {
    let mut report = Report::default();
    let start = sound(mesh);
    report.dropped_faces = start.dropped_faces;
    let merged = merge(&start.mesh, distance);
    report.merged_positions = merged.count;
    report.dropped_faces += start.mesh.face_count().saturating_sub(merged.mesh.face_count());
    let single = remove_duplicate_faces(&merged.mesh);
    report.duplicate_faces = single.count;
    let agreeing = orient(&single.mesh);
    let parted = make_manifold(&agreeing.mesh);
    report.split_vertices = parted.count;
    let filled = fill_holes(&parted.mesh, Filling::LeastArea, usize::MAX);
    report.filled_holes = filled.count;
    // Only now is it known which pieces are closed.
    let outward = orient(&filled.mesh);
    report.turned_faces = agreeing.count + outward.count;
    let used = remove_unused(&outward.mesh);
    report.unused_positions = used.count;
    Outcome { mesh: used.mesh, report }
}

#[cfg(test)]
mod tests;
