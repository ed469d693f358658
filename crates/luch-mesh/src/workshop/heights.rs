//! Height maps.

use super::Verb;

/// The verbs of this group.
pub(super) const VERBS: &[Verb] = &[];
