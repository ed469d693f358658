//! Topology and deformations: what changes a mesh by hand.

use super::Verb;

/// The verbs of this group.
pub(super) const VERBS: &[Verb] = &[];
