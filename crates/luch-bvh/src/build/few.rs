//! The splits of five to eight items: every way is tried. Half of all splits are of this kind.

use super::bounds::{Bounds, Scale};
use super::item::Item;
use super::lanes::Lanes;

/// The most items of a leaf.
pub(super) const LEAF: usize = 4;
const MOST: usize = 2 * LEAF;

/// How many items the first child has, and the boxes of both.
pub(super) struct Parted {
    pub(super) at: usize,
    pub(super) sides: [Bounds; 2],
}

/// Puts the items into `spare`, those of the first child before the others: the least sum of area times blocks over all places
/// to part them in the order of their middles along each axis.
#[inline(always)]
pub(super) fn split(items: &[Item], spare: &mut [Item], scale: Scale) -> Parted {
    let count = items.len().min(MOST);
    let mut bounds = [Bounds::EMPTY; MOST];
    // A row for each axis; places without an item come last.
    let mut middles = [[f32::INFINITY; MOST]; 3];
    for (place, item) in items.iter().enumerate().take(MOST) {
        bounds[place] = item.bounds();
        let middle = scale.middle(&bounds[place]).0;
        for axis in 0..3 {
            middles[axis][place] = if middle[axis].is_nan() { 0.0 } else { middle[axis] };
        }
    }
    let orders = [sorted(&middles[0]), sorted(&middles[1]), sorted(&middles[2])];
    // The boxes of all from a place on, along each axis.
    let mut behind = [[Bounds::EMPTY; 3]; MOST + 1];
    for place in (1..count).rev() {
        for axis in 0..3 {
            behind[place][axis] = behind[place + 1][axis].union(&bounds[orders[axis][place] as usize % MOST]);
        }
    }
    let mut before = [[Bounds::EMPTY; 3]; MOST];
    let mut least = [f32::INFINITY; 4];
    let mut places = [LEAF.min(count - 1) as u32; 4];
    for at in 1..count {
        for axis in 0..3 {
            before[at][axis] = before[at - 1][axis].union(&bounds[orders[axis][at - 1] as usize % MOST]);
        }
        let blocks = |items: usize| if items > LEAF { 2.0 } else { 1.0 };
        let first = scale.half_areas(&before[at]) * Lanes::<4>::splat(blocks(at));
        let second = scale.half_areas(&behind[at]) * Lanes::<4>::splat(blocks(count - at));
        let costs = (first + second).0;
        for lane in 0..4 {
            let better = costs[lane] < least[lane];
            least[lane] = if better { costs[lane] } else { least[lane] };
            places[lane] = if better { at as u32 } else { places[lane] };
        }
    }
    let axis = (1..3).fold(0, |best, axis| if least[axis] < least[best] { axis } else { best });
    let at = places[axis] as usize;
    if least[axis] < f32::INFINITY {
        for (target, place) in spare.iter_mut().zip(orders[axis]) {
            *target = items[place as usize % items.len()];
        }
        Parted { at, sides: [before[at % MOST][axis], behind[at % MOST][axis]] }
    } else {
        // Boxes without an end: no way is better than another.
        spare.copy_from_slice(items);
        let union = |bounds: &[Bounds]| bounds.iter().fold(Bounds::EMPTY, |all, bounds| all.union(bounds));
        Parted { at, sides: [union(&bounds[..at]), union(&bounds[at..count])] }
    }
}

/// The places in the order of their middles; equal ones in the order they have.
#[inline(always)]
fn sorted(middles: &[f32; MOST]) -> [u32; MOST] {
    // A place comes after all that are less and all equal ones before it.
    let mut ranks = [0; MOST];
    for other in 0..MOST {
        for place in 0..MOST {
            let less =
                (middles[other] < middles[place]) | ((middles[other] == middles[place]) & (other < place));
            ranks[place] += u32::from(less);
        }
    }
    let mut order = [0; MOST];
    for (place, rank) in ranks.into_iter().enumerate() {
        order[rank as usize % MOST] = place as u32;
    }
    order
}
