//! A list of patches.

use glam::DVec3;

use super::{Surface, Trimming};

/// A surface, whole or trimmed.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// The surface.
    pub surface: Surface,
    /// What of it is there; `None` for all.
    pub trimming: Option<Trimming>,
}

/// Patches that together make a surface or body.
///
/// Where two patches have the same curve as a side, point for point in either direction, their triangles share its
/// vertices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PatchModel {
    /// The patches.
    pub patches: Vec<Patch>,
}

impl From<Surface> for PatchModel {
    fn from(surface: Surface) -> Self {
        Self::from_iter([surface])
    }
}

impl FromIterator<Surface> for PatchModel {
    fn from_iter<I: IntoIterator<Item = Surface>>(surfaces: I) -> Self {
        Self { patches: surfaces.into_iter().map(|surface| Patch { surface, trimming: None }).collect() }
    }
}

impl PatchModel {
    /// The diagonal of the box around all control points, in metres; 0 if there are none.
    pub fn extent(&self) -> f64 {
        let points =
            || self.patches.iter().flat_map(|patch| patch.surface.points()).map(|point| point.position);
        match (points().reduce(DVec3::min), points().reduce(DVec3::max)) {
            (Some(low), Some(high)) => (high - low).length(),
            _ => 0.0,
        }
    }
}
