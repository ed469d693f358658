//! Exact nested uniform scrambling by stochastic generation.
//!
//! In a digital (0,1)-sequence point i of the second half of 2^(m+1) points lies, in each coordinate, in the cell of width 2^−m
//! that holds exactly one earlier point, but in the other half of that cell. Which earlier point it is depends on i by an
//! exclusive or with a constant of the dimension and of m. So a scrambled coordinate is made from that earlier one: keep its
//! leading bits, flip the next, draw the rest at random (Helmer, Christensen, Kensler, "Stochastic generation of (t, s) sample
//! sequences", 2021). The law is that of Owen's scramble; no tree is ever built.

use super::matrices::{self, Columns};
use super::{Rule, unit};
use luch_sampling::hash;

/// For each dimension and each m the constant that leads to the earlier point.
type Partners = [u32; 32];

/// One group of coordinates with its own order.
struct Group {
    partners: Vec<Partners>,
    /// Seed of the shuffle of the order; none for the first group.
    order: Option<u32>,
    /// Key of its random bits.
    key: u64,
}

/// The groups of a rule: Sobol' is one, pairs are many.
fn groups(rule: Rule, key: u64, dimensions: usize) -> Vec<Group> {
    if rule == Rule::SobolOwen {
        let partners = matrices::sobol()[..dimensions].iter().map(partners).collect();
        return vec![Group { partners, order: None, key }];
    }
    (0..dimensions.div_ceil(2))
        .map(|g| {
            let key = hash::word(key, g as u64);
            let width = (dimensions - 2 * g).min(2);
            let partners = matrices::progressive(key)[..width].iter().map(partners).collect();
            Group { partners, order: (g > 0).then_some(hash::word(key, 1 << 40) as u32), key }
        })
        .collect()
}

/// For every m: the index below 2^m whose coordinate agrees with column m in the leading m bits.
fn partners(columns: &Columns) -> Partners {
    // Columns reduced so far, with the indices they stand for, by leading bit.
    let mut reduced: [Option<(u32, u32)>; 32] = [None; 32];
    std::array::from_fn(|m| {
        let (mut word, mut index) = (columns[m], 0u32);
        // Leading bits first; every bit above m has a reduced column, for the coordinate is a (0,1)-sequence.
        for (bit, earlier) in reduced.iter().enumerate().take(m) {
            if let Some((column, names)) = *earlier
                && word >> (31 - bit) & 1 == 1
            {
                word ^= column;
                index ^= names;
            }
        }
        reduced[m] = Some((word, index | 1 << m));
        index
    })
}

/// Random bits of point `index` in a dimension: half of a word shared by two dimensions.
#[inline(always)]
fn random(key: u64, index: u32, dimension: usize) -> u32 {
    let word = hash::word(key.wrapping_add((dimension as u64 / 2) << 40), u64::from(index));
    if dimension.is_multiple_of(2) { word as u32 } else { (word >> 32) as u32 }
}

/// The bits above bit m, counted from the highest, m below 32.
#[inline(always)]
fn leading(m: u32) -> u32 {
    !(u32::MAX >> m)
}

/// All points of a set, each from an earlier one.
pub(super) fn fill_all(rule: Rule, key: u64, dimensions: usize, out: &mut [f64]) {
    let count = out.len() / dimensions;
    let mut offset = 0;
    for group in groups(rule, key, dimensions) {
        let width = group.partners.len();
        match group.order {
            None => {
                let words = generate(&group, count);
                for (point, words) in out.chunks_exact_mut(dimensions).zip(words.chunks_exact(width)) {
                    for (out, &word) in point[offset..].iter_mut().zip(words) {
                        *out = unit(word);
                    }
                }
            }
            // The shuffle leads anywhere below 2³², so nothing made earlier helps.
            Some(order) => {
                for (i, point) in out.chunks_exact_mut(dimensions).enumerate() {
                    let shuffled = hash::nested_scramble(i as u32, order);
                    for (c, out) in point[offset..offset + width].iter_mut().enumerate() {
                        *out = unit(word(&group, c, shuffled));
                    }
                }
            }
        }
        offset += width;
    }
}

/// The words of the first `count` points of a group in plain order, point after point.
fn generate(group: &Group, count: usize) -> Vec<u32> {
    let width = group.partners.len();
    let mut words = vec![0u32; count * width];
    for (d, word) in words.iter_mut().enumerate().take(width) {
        *word = random(group.key, 0, d);
    }
    for m in 0..32u32 {
        let half = 1usize << m;
        if half >= count {
            break;
        }
        let constants: Vec<usize> = group.partners.iter().map(|p| p[m as usize] as usize).collect();
        let (flip, kept) = (1 << (31 - m), leading(m) | 1 << (31 - m));
        let (earlier, later) = words.split_at_mut(half * width);
        for (i, point) in later.chunks_exact_mut(width).take(half).enumerate() {
            let index = (half + i) as u32;
            for (pair, coordinates) in point.chunks_mut(2).enumerate() {
                let bits = hash::word(group.key.wrapping_add((pair as u64) << 40), u64::from(index));
                for (c, coordinate) in coordinates.iter_mut().enumerate() {
                    let d = 2 * pair + c;
                    let partner = earlier[(i ^ constants[d]) * width + d];
                    let fresh = (bits >> (32 * c)) as u32;
                    *coordinate = ((partner ^ flip) & kept) | (fresh & !kept);
                }
            }
        }
    }
    words
}

/// One coordinate of point `index` without the others: the chain of earlier points back to the first.
fn word(group: &Group, dimension: usize, index: u32) -> u32 {
    let (mut result, mut flips, mut open, mut i) = (0, 0, u32::MAX, index);
    while i != 0 {
        let m = i.ilog2();
        let kept = leading(m) | 1 << (31 - m);
        result |= random(group.key, i, dimension) & open & !kept;
        flips ^= 1 << (31 - m);
        open &= kept;
        i = (i ^ 1 << m) ^ group.partners[dimension][m as usize];
    }
    (result | (random(group.key, 0, dimension) & open)) ^ flips
}

/// The points from `first` on.
pub(super) fn fill(rule: Rule, key: u64, dimensions: usize, first: u64, out: &mut [f64]) {
    let groups = groups(rule, key, dimensions);
    for (i, point) in out.chunks_exact_mut(dimensions).enumerate() {
        let index = (first + i as u64) as u32;
        let mut rest = point;
        for group in &groups {
            let (coordinates, later) = rest.split_at_mut(group.partners.len());
            let shuffled = group.order.map_or(index, |order| hash::nested_scramble(index, order));
            for (c, out) in coordinates.iter_mut().enumerate() {
                *out = unit(word(group, c, shuffled));
            }
            rest = later;
        }
    }
}
