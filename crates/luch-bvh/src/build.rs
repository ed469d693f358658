//! Building: a binary tree by the surface area heuristic, from that the wide one.
//!
//! Each step is a file. The binary tree grows top-down ([`binned`]), over groups of neighbours only ([`morton`]), or with cuts
//! through triangles ([`spatial`]); [`reinsert`] moves nodes to where they cost less; [`collapse`] makes nodes of eight
//! children out of it and lays them out. The result is the same for any number of threads.

mod binary;
mod binned;
mod bins;
mod bounds;
mod collapse;
mod costs;
mod few;
mod item;
mod morton;
mod partition;
mod reinsert;
mod spatial;
#[cfg(test)]
mod tests;

use crate::wide::Wide;
use crate::{Aabb, Triangle};
use binary::{Binary, Grown};
use binned::{Buffers, Plan};
use bounds::{Bounds, Scale};
use collapse::collapse;
use item::Item;
use rayon::prelude::*;

/// How much time a build takes for how good a tree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Quality {
    /// Neighbours along a space-filling curve are gathered first; only the groups are split with care. For edits.
    Fast,
    /// Every split by the surface area heuristic, and some nodes moved afterward to where they cost less.
    #[default]
    Balanced,
    /// The same with more nodes moved, and large triangles in several leaves, each with a part. Takes several times as long;
    /// for long renders.
    Best,
}

impl Quality {
    /// All of them, quickest build first.
    pub const ALL: [Self; 3] = [Self::Fast, Self::Balanced, Self::Best];
}

/// A primitive to be put into the tree.
#[derive(Clone, Copy)]
pub(crate) struct Reference {
    pub(crate) bounds: Aabb,
    pub(crate) primitive: u32,
}

impl Reference {
    /// `None` for an empty box or one that is not a number: such a primitive is never hit.
    pub(crate) fn new(bounds: Aabb, primitive: u32) -> Option<Self> {
        (!bounds.is_empty()).then_some(Self { bounds, primitive })
    }
}

/// What spatial splits ask the owner of the primitives.
pub(crate) trait Clip: Sync {
    /// The primitive, if it is a triangle that [may be cut](Triangle::may_be_cut).
    fn triangle(&self, primitive: u32) -> Option<Triangle>;
}

/// Builds the wide tree over the references, which it uses up. With `clip` a primitive may be in more than one leaf.
pub(crate) fn build_wide(references: &mut Vec<Reference>, quality: Quality, clip: Option<&dyn Clip>) -> Wide {
    let tree = binary(references, quality, clip);
    references.clear();
    collapse(&tree)
}

/// Builds the binary tree.
fn binary(references: &[Reference], quality: Quality, clip: Option<&dyn Clip>) -> Binary {
    let mut items: Vec<Item> =
        references.par_iter().map(|reference| Item::new(&reference.bounds, reference.primitive)).collect();
    let whole = items.par_iter().map(Item::bounds).reduce(|| Bounds::EMPTY, |a, b| a.union(&b));
    let scale = Scale::of(&whole);
    if items.is_empty() {
        return Binary { nodes: Vec::new(), order: Vec::new(), scale };
    }
    let plan = Plan { scale, leaf: 4, bins: 32, depth: binned::MAX_DEPTH };
    let Grown { nodes, order } = match (quality, clip) {
        (Quality::Fast, _) => morton::grow(&items, plan),
        (Quality::Best, Some(clip)) => spatial::grow(items, clip, plan).joined(),
        _ => {
            let mut spare = items.clone();
            binned::grow(Buffers { items: &mut items, spare: &mut spare }, 0, plan).joined()
        }
    };
    let mut tree = Binary { nodes, order, scale };
    match quality {
        Quality::Fast => {}
        Quality::Balanced => reinsert::improve(&mut tree, 2, 8),
        Quality::Best => reinsert::improve(&mut tree, 4, 2),
    }
    tree
}
