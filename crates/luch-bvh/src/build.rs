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
mod lanes;
mod morton;
mod partition;
mod plan;
mod reinsert;
mod spatial;
#[cfg(test)]
mod tests;

use crate::Triangle;
use crate::wide::Wide;
use binary::{Binary, Grown};
use binned::Buffers;
use bounds::{Bounds, Scale};
use collapse::collapse;
pub(crate) use item::Item;
use plan::{Extent, Plan};
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

/// What spatial splits ask the owner of the primitives.
pub(crate) trait Clip: Sync {
    /// The primitive, if it is a triangle that [may be cut](Triangle::may_be_cut).
    fn triangle(&self, primitive: u32) -> Option<Triangle>;
}

/// The items of as many primitives as there are, made on all threads; `None` for what has no place in the tree.
pub(crate) fn items(count: usize, item: impl Fn(usize) -> Option<Item> + Sync) -> Vec<Item> {
    let made = (0..count).into_par_iter().map(|place| item(place).unwrap_or(Item::NOTHING));
    let mut items: Vec<Item> = made.collect();
    items.retain(|item| !item.bounds().is_empty());
    items
}

/// Builds the wide tree over the items, which it uses up. With `clip` a primitive may be in more than one leaf.
pub(crate) fn build_wide(items: Vec<Item>, quality: Quality, clip: Option<&dyn Clip>) -> Wide {
    collapse(&binary(items, quality, clip))
}

/// Builds the binary tree.
fn binary(mut items: Vec<Item>, quality: Quality, clip: Option<&dyn Clip>) -> Binary {
    let union = |items: &[Item]| items.iter().fold(Bounds::EMPTY, |all, item| all.union(&item.bounds()));
    let whole = items.par_chunks(4096).map(union).reduce(|| Bounds::EMPTY, |a, b| a.union(&b));
    let scale = Scale::of(&whole);
    if items.is_empty() {
        return Binary { nodes: Vec::new(), order: Vec::new(), scale };
    }
    let plan = Plan { scale, leaf_bits: 2, bins: 32, depth: binned::MAX_DEPTH };
    let extent = Extent::of(&items, scale);
    let Grown { nodes, order } = match (quality, clip) {
        (Quality::Fast, _) => morton::grow(&items, &extent.middles, plan),
        (Quality::Best, Some(clip)) => spatial::grow(items, clip, plan).joined(),
        _ => {
            let mut spare = items.clone();
            binned::grow(Buffers { items: &mut items, spare: &mut spare }, extent, 0, plan).joined()
        }
    };
    let mut tree = Binary { nodes, order, scale };
    match quality {
        Quality::Fast => {}
        Quality::Balanced => reinsert::improve(&mut tree, 4, 32),
        // Nodes in their new order between passes: the next pass finds its way faster.
        Quality::Best => (0..4).for_each(|_| reinsert::improve(&mut tree, 1, 2)),
    }
    tree
}
