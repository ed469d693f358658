//! Two groups out of one, in an order that depends on nothing but the items.

use super::binned::PORTION;
use super::item::Item;
use rayon::prelude::*;

/// Puts what is `before` at the front of `target` and the rest, in reverse, at its end; returns how much is before.
/// Each item is written to both ends, and one end moves on: no branch to guess.
pub(super) fn partition(items: &[Item], target: &mut [Item], before: impl Fn(&Item) -> bool) -> usize {
    let (mut front, mut end) = (0, items.len());
    for item in items {
        let is_before = before(item);
        target[front] = *item;
        target[end - 1] = *item;
        front += usize::from(is_before);
        end -= usize::from(!is_before);
    }
    front
}

/// The same for many items on all threads: first count, then put each portion where it belongs.
pub(super) fn partition_parallel(
    items: &[Item],
    target: &mut [Item],
    before: impl Fn(&Item) -> bool + Sync,
) -> usize {
    let count = |portion: &[Item]| portion.iter().filter(|item| before(item)).count();
    let counts: Vec<usize> = items.par_chunks(PORTION).map(count).collect();
    let at = counts.iter().sum();
    let (mut front, mut back) = target.split_at_mut(at);
    let mut jobs = Vec::with_capacity(counts.len());
    for (portion, count) in items.chunks(PORTION).zip(counts) {
        let (mine, rest) = front.split_at_mut(count);
        front = rest;
        let (others, rest) = back.split_at_mut(portion.len() - count);
        back = rest;
        jobs.push((portion, mine, others));
    }
    jobs.into_par_iter().for_each(|(portion, mine, others)| {
        let (mut first, mut second) = (0, 0);
        for item in portion {
            if before(item) {
                mine[first] = *item;
                first += 1;
            } else {
                others[second] = *item;
                second += 1;
            }
        }
    });
    at
}
