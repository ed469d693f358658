//! Corners at one vertex whose faces hang together there.

use crate::polygon_mesh::HalfEdges;
use crate::sets::DisjointSets;

/// Which corners hang together: those of two faces at both ends of an edge they share, if it is joined.
pub(super) struct Fans {
    sets: DisjointSets,
}

impl Fans {
    /// Joins the corners at all edges with two faces of opposite direction for which `is_joined` says so of one of the
    /// half-edges. `opposites` are those of the half-edges.
    pub(super) fn new(
        half_edges: &HalfEdges,
        opposites: &[Option<u32>],
        is_joined: impl Fn(u32, u32) -> bool,
    ) -> Self {
        let mut sets = DisjointSets::new(opposites.len());
        for (one, other) in opposites.iter().enumerate() {
            let one = one as u32;
            if let &Some(other) = other
                && one < other
                && is_joined(one, other)
            {
                sets.join(one, half_edges.next(other));
                sets.join(half_edges.next(one), other);
            }
        }
        Self { sets }
    }

    /// The lowest corner of the fan of a corner.
    pub(super) fn of(&mut self, corner: u32) -> u32 {
        self.sets.root(corner)
    }
}
