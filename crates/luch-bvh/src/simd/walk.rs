//! One ray through one tree: for single questions, small batches, and the few rays of a packet that go ways of their own.

use super::lanes::{Isa, Lanes, Mask};
use super::ray::Prepared;
use crate::tree::Tree;
use crate::wide::{EMPTY, LEAF, MAX_WAITING};

/// Entries above the top that may be written.
pub(super) const SLACK: usize = 8;

/// The children a walk has put off. One serves a whole batch of rays.
pub(crate) struct Stack {
    distances: [f32; MAX_WAITING + SLACK],
    references: [u32; MAX_WAITING + SLACK],
}

impl Stack {
    pub(crate) fn new() -> Self {
        Self { distances: [0.0; MAX_WAITING + SLACK], references: [0; MAX_WAITING + SLACK] }
    }
}

/// Hands every leaf below `from` that may hold a hit at or before the best one to `visit`, near ones first. `visit` takes the
/// number of the leaf and the bound so far, and returns the bound from now on; -∞ ends the walk.
#[inline(always)]
pub(crate) fn walk_from<I: Isa>(
    tree: &Tree,
    from: u32,
    ray: &Prepared,
    bound: f32,
    stack: &mut Stack,
    mut visit: impl FnMut(usize, f32) -> f32,
) {
    let nodes = tree.nodes();
    let mut bound = bound;
    let mut current = from;
    if current == EMPTY {
        return;
    }
    let spread = ray.spread::<I>();
    let mut height = 0;
    loop {
        if current & LEAF == 0 {
            // SAFETY: references that are not leaves lead to a node.
            let node = unsafe { nodes.get_unchecked(current as usize) };
            let entered = spread.enter(node, bound);
            let bits = entered.met.bits();
            if bits != 0 {
                let first = (bits.trailing_zeros() & 7) as usize;
                let others = bits & (bits - 1);
                if others == 0 {
                    current = node.children[first];
                    continue;
                }
                if others & (others - 1) == 0 {
                    let second = (others.trailing_zeros() & 7) as usize;
                    let near = entered.near.to_array();
                    let (next, later) =
                        if near[second] < near[first] { (second, first) } else { (first, second) };
                    // SAFETY: the depth of the tree bounds what waits.
                    unsafe {
                        *stack.distances.get_unchecked_mut(height) = near[later];
                        *stack.references.get_unchecked_mut(height) = node.children[later];
                    }
                    height += 1;
                    current = node.children[next];
                    continue;
                }
                // SAFETY: as above, and the stack has eight places more; entry distances are not negative.
                unsafe {
                    I::push_sorted(
                        entered.near,
                        entered.met,
                        &node.children,
                        stack.distances.as_mut_ptr().add(height),
                        stack.references.as_mut_ptr().add(height),
                    );
                    height += bits.count_ones() as usize - 1;
                    current = *stack.references.get_unchecked(height);
                }
                continue;
            }
        } else {
            bound = visit((current & !LEAF) as usize, bound);
        }
        loop {
            if height == 0 {
                return;
            }
            height -= 1;
            // SAFETY: what is below the top was written.
            unsafe {
                if *stack.distances.get_unchecked(height) <= bound {
                    current = *stack.references.get_unchecked(height);
                    break;
                }
            }
        }
    }
}

/// [`walk_from`] the root.
#[inline(always)]
pub(crate) fn walk<I: Isa>(
    tree: &Tree,
    ray: &Prepared,
    bound: f32,
    stack: &mut Stack,
    visit: impl FnMut(usize, f32) -> f32,
) {
    walk_from::<I>(tree, tree.root(), ray, bound, stack, visit);
}
