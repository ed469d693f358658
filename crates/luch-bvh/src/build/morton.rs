//! The quick build: neighbours along a space-filling curve are gathered first, and only the groups are split with care.
//!
//! Lauterbach et al., "Fast BVH Construction on GPUs" (2009): the bits of the three coordinates, interleaved, number the cells of
//! a grid so that near cells have near numbers (Morton's order). Sorted by that number, items fall into groups of a few.
//! A tree over the groups and a small tree in each are grown [top-down](super::binned); what lies between, most of the work
//! of a full build, is saved.

use super::binary::Grown;
use super::binned::{self, Buffers};
use super::bounds::Bounds;
use super::item::Item;
use super::plan::{Extent, Plan};
use rayon::prelude::*;

/// The most items of a group, unless they share a cell.
const GROUP: usize = 24;
/// Groups that one thread takes at a time.
const PORTION: usize = 256;
/// No way through the tree over the groups is longer; that leaves enough below.
const GROUPS_DEPTH: u32 = 40;
/// Bits along an axis.
const BITS: u32 = 10;

/// Grows the tree over the items, of which there is at least one.
pub(super) fn grow(items: &[Item], middles: &Bounds, plan: Plan) -> Grown {
    let mut sorted = along_curve(items, middles, plan);
    let mut ends = Vec::new();
    cut(&sorted.codes, 0, 3 * BITS, &mut ends);
    // Each group one item, numbered by the group.
    let starts: Vec<usize> = std::iter::once(0).chain(ends.iter().copied()).collect();
    let bounds = |group: usize| {
        let items = &sorted.items[starts[group]..starts[group + 1]];
        items.iter().fold(Bounds::EMPTY, |all, item| all.union(&item.bounds()))
    };
    let mut groups: Vec<Item> =
        (0..ends.len()).into_par_iter().map(|group| Item::of(&bounds(group), group as u32)).collect();
    let mut spare = groups.clone();
    let above = Plan { leaf_bits: 0, bins: 16, depth: GROUPS_DEPTH, ..plan };
    let extent = Extent::of(&groups, plan.scale);
    let mut tree = binned::grow(Buffers { items: &mut groups, spare: &mut spare }, extent, 0, above).joined();
    let below = within(&mut sorted.items, &starts, plan);
    graft(&mut tree, below);
    tree
}

/// Items in the order of their cells.
struct Sorted {
    codes: Vec<u32>,
    items: Vec<Item>,
}

fn along_curve(items: &[Item], middles: &Bounds, plan: Plan) -> Sorted {
    let cells = (1 << BITS) as f32;
    let factor: [f32; 3] = std::array::from_fn(|axis| {
        let size = middles.high(axis) - middles.low(axis);
        if size > 0.0 { cells / size } else { 0.0 }
    });
    let key = |(index, item): (usize, &Item)| {
        let cell = |axis: usize| {
            let (low, high) = item.along(axis);
            let cell = ((plan.scale.middle_along(low, high) - middles.low(axis)) * factor[axis]) as u32;
            spread(cell.min((1 << BITS) - 1))
        };
        u64::from(cell(0) << 2 | cell(1) << 1 | cell(2)) << 32 | index as u64
    };
    let mut keys: Vec<u64> = items.par_iter().enumerate().map(key).collect();
    let mut spare = vec![0; keys.len()];
    for pass in 0..3 {
        sort_by_digit(&keys, &mut spare, 32 + pass * BITS);
        std::mem::swap(&mut keys, &mut spare);
    }
    Sorted {
        codes: keys.par_iter().map(|key| (key >> 32) as u32).collect(),
        items: keys.par_iter().map(|key| items[*key as u32 as usize]).collect(),
    }
}

/// Puts two zero bits behind each of ten bits.
fn spread(bits: u32) -> u32 {
    let bits = (bits | bits << 16) & 0x0300_00ff;
    let bits = (bits | bits << 8) & 0x0300_f00f;
    let bits = (bits | bits << 4) & 0x030c_30c3;
    (bits | bits << 2) & 0x0924_9249
}

/// One pass of a radix sort: by ten bits, equal ones in the order they had.
fn sort_by_digit(keys: &[u64], target: &mut [u64], shift: u32) {
    const DIGITS: usize = 1 << BITS;
    let digit = |key: &u64| (key >> shift) as usize % DIGITS;
    let length = keys.len().div_ceil(16).max(4096);
    let count = |portion: &[u64]| {
        let mut counts = vec![0_usize; DIGITS];
        portion.iter().for_each(|key| counts[digit(key)] += 1);
        counts
    };
    let counts: Vec<Vec<usize>> = keys.par_chunks(length).map(count).collect();
    // The room of each digit of each portion.
    let mut rooms: Vec<Vec<&mut [u64]>> = counts.iter().map(|_| Vec::with_capacity(DIGITS)).collect();
    let mut rest = target;
    for digit in 0..DIGITS {
        for (rooms, counts) in rooms.iter_mut().zip(&counts) {
            let (room, others) = rest.split_at_mut(counts[digit]);
            rooms.push(room);
            rest = others;
        }
    }
    keys.par_chunks(length).zip(rooms).for_each(|(portion, mut rooms)| {
        let mut filled = vec![0_usize; DIGITS];
        for key in portion {
            let digit = digit(key);
            rooms[digit][filled[digit]] = *key;
            filled[digit] += 1;
        }
    });
}

/// Cuts the sorted codes where their highest differing bits change, until groups are small; tells where each ends.
fn cut(codes: &[u32], first: usize, bits: u32, ends: &mut Vec<usize>) {
    if codes.len() <= GROUP || bits == 0 {
        ends.push(first + codes.len());
        return;
    }
    let at = codes.partition_point(|code| code >> (bits - 1) & 1 == 0);
    for (part, first) in [(&codes[..at], first), (&codes[at..], first + at)] {
        if !part.is_empty() {
            cut(part, first, bits - 1, ends);
        }
    }
}

/// The trees of the groups, a portion of groups in each piece; their roots come first.
fn within(items: &mut [Item], starts: &[usize], plan: Plan) -> Vec<Grown> {
    let mut spare = items.to_vec();
    let (mut items, mut spare) = (items, spare.as_mut_slice());
    let mut jobs = Vec::new();
    for first in (0..starts.len() - 1).step_by(PORTION) {
        let starts = &starts[first..starts.len().min(first + PORTION + 1)];
        let count = starts[starts.len() - 1] - starts[0];
        let (mine, others) = items.split_at_mut(count);
        items = others;
        let (mine_spare, others) = spare.split_at_mut(count);
        spare = others;
        jobs.push((starts, mine, mine_spare));
    }
    jobs.into_par_iter()
        .map(|(starts, items, spare)| {
            let ends = starts[1..].iter().map(|start| start - starts[0]);
            binned::grow_side_by_side(Buffers { items, spare }, ends, GROUPS_DEPTH, plan)
        })
        .collect()
}

/// Puts the tree of each group in the place of its leaf.
fn graft(tree: &mut Grown, below: Vec<Grown>) {
    let above = tree.nodes.len();
    // Where the roots of each portion stand.
    let mut offsets = Vec::with_capacity(below.len());
    let groups = std::mem::take(&mut tree.order);
    for grown in &below {
        let (offset, first) = (tree.nodes.len() as u32, tree.order.len() as u32);
        offsets.push(tree.nodes.len());
        tree.nodes.extend(grown.nodes.iter().map(|node| node.moved(offset, first)));
        tree.order.extend_from_slice(&grown.order);
    }
    for place in 0..above {
        let node = tree.nodes[place];
        if node.is_leaf() {
            let group = groups[node.index() as usize] as usize;
            tree.nodes[place] = tree.nodes[offsets[group / PORTION] + group % PORTION];
        }
    }
}
