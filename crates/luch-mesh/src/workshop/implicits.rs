//! Surfaces of formulas, of solids combined, of grids.

use super::Verb;

/// The verbs of this group.
pub(super) const VERBS: &[Verb] = &[];
