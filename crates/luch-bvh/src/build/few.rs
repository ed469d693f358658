//! The splits of five to eight items: every way is tried. Half of all splits are of this kind.

use super::bounds::{Bounds, Scale};
use super::item::Item;

/// The most items of a leaf.
pub(super) const LEAF: usize = 4;
const MOST: usize = 2 * LEAF;

/// Puts the items into `spare`, those of the first child before the others, and returns how many they are: the least sum of
/// area times blocks over all places to part them in the order of their middles along each axis.
pub(super) fn split(items: &[Item], spare: &mut [Item], scale: Scale) -> usize {
    let count = items.len().min(MOST);
    let mut bounds = [Bounds::EMPTY; MOST];
    let mut middles = [[0.0; 4]; MOST];
    for (place, item) in items.iter().enumerate().take(MOST) {
        bounds[place] = item.bounds();
        middles[place] =
            scale.middle(&bounds[place]).map(|middle| if middle.is_nan() { 0.0 } else { middle });
    }
    let mut least = f32::INFINITY;
    let mut best = ([0, 1, 2, 3, 4, 5, 6, 7], count.min(LEAF));
    for axis in 0..3 {
        let order = sorted(&middles, count, axis);
        // The box of all from a place on.
        let mut behind = [Bounds::EMPTY; MOST + 1];
        for place in (1..count).rev() {
            behind[place] = behind[place + 1].union(&bounds[order[place] as usize % MOST]);
        }
        let mut before = Bounds::EMPTY;
        for at in 1..count {
            before = before.union(&bounds[order[at - 1] as usize % MOST]);
            let blocks = |items: usize| if items > LEAF { 2.0 } else { 1.0 };
            let cost =
                scale.half_area(&before) * blocks(at) + scale.half_area(&behind[at]) * blocks(count - at);
            if cost < least {
                least = cost;
                best = (order, at);
            }
        }
    }
    let (order, at) = best;
    for (target, place) in spare.iter_mut().zip(order) {
        *target = items[usize::from(place) % items.len()];
    }
    at
}

/// The places in the order of their middles; equal ones in the order they have.
#[inline(always)]
fn sorted(middles: &[[f32; 4]; MOST], count: usize, axis: usize) -> [u8; MOST] {
    // A place comes after all that are less and all equal ones before it.
    let mut order = [0; MOST];
    for place in 0..count {
        let own = middles[place][axis];
        let less = (0..place).filter(|other| middles[*other][axis] <= own).count()
            + (place + 1..count).filter(|other| middles[*other][axis] < own).count();
        order[less % MOST] = place as u8;
    }
    order
}
