//! Digital sequences in base 2 and their randomisations, in bulk.

use super::blocks::{self, Kernel};
use super::matrices::{self, Columns};
use super::{Rule, unit};
use luch_sampling::hash;

/// What is done to the plain points, with the key of the randomisation.
#[derive(Clone, Copy, Debug)]
pub(super) enum Change {
    /// Nothing.
    None,
    /// A random word is added to each coordinate without carry.
    Shift(u64),
    /// Each digit becomes itself plus a random combination of those above it, plus a random digit (Matoušek 1998).
    Linear(u64),
    /// Nested scramble by hashing (Burley 2020).
    Hash(u64),
}

/// A random word of 32 bits for each dimension.
fn random_word(key: u64, dimension: usize) -> u32 {
    hash::word(key, dimension as u64) as u32
}

/// The points of the Sobol' sequence from `first` on, in natural order.
pub(super) fn fill_sobol(dimensions: usize, first: u64, change: Change, out: &mut [f64]) {
    let plain = &matrices::sobol()[..dimensions];
    match change {
        Change::None => {
            blocks::fill(&Xor { columns: plain, shifts: vec![0; dimensions] }, dimensions, first, out);
        }
        Change::Shift(key) => {
            let shifts = (0..dimensions).map(|d| random_word(key, d)).collect();
            blocks::fill(&Xor { columns: plain, shifts }, dimensions, first, out);
        }
        Change::Linear(key) => {
            let columns: Vec<Columns> = plain.iter().enumerate().map(|(d, c)| linear(c, key, d)).collect();
            let shifts = (0..dimensions).map(|d| random_word(key, d)).collect();
            blocks::fill(&Xor { columns: &columns, shifts }, dimensions, first, out);
        }
        Change::Hash(key) => blocks::fill(&Hashed::new(plain, key), dimensions, first, out),
    }
}

/// The matrix multiplied from the left by a random lower triangular one with a unit diagonal.
fn linear(columns: &Columns, key: u64, dimension: usize) -> Columns {
    let tree = hash::word(key, (1 << 32) + dimension as u64);
    // Output digit r is input digit r plus a random combination of the digits above it.
    let rows: [u32; 32] = std::array::from_fn(|row| {
        let above = !(u64::from(u32::MAX) >> row) as u32;
        (hash::word(tree, row as u64) as u32 & above) | 1 << (31 - row)
    });
    columns.map(|word| {
        (0..32).fold(0, |result, row| result | ((word & rows[row]).count_ones() & 1) << (31 - row))
    })
}

fn word_of(columns: &Columns, index: u32) -> u32 {
    let (mut word, mut rest) = (0, index);
    while rest != 0 {
        word ^= columns[rest.trailing_zeros() as usize];
        rest &= rest - 1;
    }
    word
}

/// Plain words with a shift.
struct Xor<'a> {
    columns: &'a [Columns],
    shifts: Vec<u32>,
}

impl Kernel for Xor<'_> {
    fn place(&self, dimension: usize, index: u32) -> u32 {
        word_of(&self.columns[dimension], index)
    }

    fn block(&self, dimension: usize, index: u32) -> u32 {
        word_of(&self.columns[dimension], index) ^ self.shifts[dimension]
    }

    #[inline(always)]
    fn finish(&self, places: &[u32], blocks: &[u32], out: &mut [f64]) {
        for ((out, place), block) in out.iter_mut().zip(places).zip(blocks) {
            *out = unit(place ^ block);
        }
    }
}

/// Words under a hash that is a nested scramble. They are kept with their bits in opposite order, as the hash wants them.
struct Hashed {
    columns: Vec<Columns>,
    /// Addend and factor of each dimension, repeated for a run.
    addends: Vec<u32>,
    factors: Vec<u32>,
}

impl Hashed {
    fn new(columns: &[Columns], key: u64) -> Hashed {
        let dimensions = columns.len();
        Hashed {
            columns: columns.iter().map(|column| column.map(u32::reverse_bits)).collect(),
            addends: blocks::repeated(dimensions, |d| random_word(key, d)),
            factors: blocks::repeated(dimensions, |d| random_word(key, d) >> 16 | 1),
        }
    }
}

impl Kernel for Hashed {
    fn place(&self, dimension: usize, index: u32) -> u32 {
        word_of(&self.columns[dimension], index)
    }

    fn block(&self, dimension: usize, index: u32) -> u32 {
        word_of(&self.columns[dimension], index)
    }

    /// `hash::laine_karras`, with its seed taken apart, eight words at a time and step by step: vectors take it so.
    #[inline(always)]
    fn finish(&self, places: &[u32], blocks: &[u32], out: &mut [f64]) {
        let (places, blocks) = (places.as_chunks::<8>().0, blocks.as_chunks::<8>().0);
        let (addends, factors) = (self.addends.as_chunks::<8>().0, self.factors.as_chunks::<8>().0);
        let out = out.as_chunks_mut::<8>().0;
        let seeds = addends.iter().zip(factors);
        for (((out, place), block), (addend, factor)) in out.iter_mut().zip(places).zip(blocks).zip(seeds) {
            let mut v: [u32; 8] = std::array::from_fn(|i| place[i] ^ block[i]);
            v = v.map(|v| v ^ v.wrapping_mul(0x3d20_adea));
            v = std::array::from_fn(|i| v[i].wrapping_add(addend[i]).wrapping_mul(factor[i]));
            v = v.map(|v| v ^ v.wrapping_mul(0x0552_6c56));
            v = v.map(|v| v ^ v.wrapping_mul(0x53a2_2864));
            v = v.map(|v| (v >> 1 & 0x5555_5555) | (v & 0x5555_5555) << 1);
            v = v.map(|v| (v >> 2 & 0x3333_3333) | (v & 0x3333_3333) << 2);
            v = v.map(|v| (v >> 4 & 0x0f0f_0f0f) | (v & 0x0f0f_0f0f) << 4);
            v = v.map(|v| (v >> 8 & 0x00ff_00ff) | (v & 0x00ff_00ff) << 8);
            *out = v.map(|v| unit(v.rotate_left(16)));
        }
    }
}

/// Groups of a small digital sequence side by side, each with its own nested scramble and, from the second on, its own order.
pub(super) fn fill_padded(rule: Rule, key: u64, dimensions: usize, first: u64, out: &mut [f64]) {
    let group = matrices::group(rule);
    let width = group.len();
    // Tables for eight bits of the index each: [byte][value][coordinate].
    let table: Vec<u32> = (0..4 * 256 * width)
        .map(|entry| {
            let (coordinate, value, byte) = (entry % width, entry / width % 256, entry / width / 256);
            word_of(&group[coordinate], (value as u32) << (8 * byte))
        })
        .collect();
    let seeds: Vec<u32> = (0..dimensions).map(|d| random_word(key, d)).collect();
    let orders: Vec<u32> =
        (0..dimensions.div_ceil(width)).map(|g| random_word(hash::word(key, 1 << 32), g)).collect();
    for (i, point) in out.chunks_exact_mut(dimensions).enumerate() {
        let index = (first + i as u64) as u32;
        for (g, coordinates) in point.chunks_mut(width).enumerate() {
            let shuffled = if g == 0 { index } else { hash::nested_scramble(index, orders[g]) };
            let rows =
                [0, 1, 2, 3].map(|byte| ((byte << 8) + (shuffled >> (8 * byte) & 255)) as usize * width);
            for (c, (out, &seed)) in coordinates.iter_mut().zip(&seeds[g * width..]).enumerate() {
                let word = rows.iter().fold(0, |word, row| word ^ table[row + c]);
                *out = unit(hash::nested_scramble(word, seed));
            }
        }
    }
}
