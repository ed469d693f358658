//! Which samples lie inside, one bit each; the crossed edges follow from 64 samples at a time.
//!
//! The edges that a surface crosses are numbered row by row: those that start at a row's samples along x, then along y, then
//! along z, each rising with x. Rows rise with y, then z. A walk along four rows therefore meets the numbers in order, and no
//! table from edges to numbers is needed (Schroeder et al., "Flying Edges", 2015).

use luch_bvh::simd::{Task, dispatch};
use rayon::prelude::*;

use super::{Grid, ImplicitError, MOST_VERTICES};

/// The signs of all samples of a grid.
pub(super) struct Signs {
    counts: [usize; 3],
    words_per_row: usize,
    words: Vec<u64>,
}

impl Signs {
    /// Bit set: the value lies below the level. What is not a number does not.
    pub(super) fn new(grid: &Grid, level: f32) -> Self {
        let counts = grid.counts();
        let words_per_row = counts[0].div_ceil(64);
        let mut words = vec![0u64; words_per_row * counts[1] * counts[2]];
        words
            .par_chunks_mut(words_per_row * counts[1])
            .zip(grid.samples().par_chunks(counts[0] * counts[1]))
            .for_each(|(words, values)| dispatch(Pack { words, values, row: counts[0], level }));
        Self { counts, words_per_row, words }
    }

    /// The signs of a row of samples, 64 a word; those past the end are zero.
    #[inline]
    pub(super) fn row(&self, y: usize, z: usize) -> &[u64] {
        let start = (z * self.counts[1] + y) * self.words_per_row;
        &self.words[start..start + self.words_per_row]
    }

    /// Whether a sample lies inside.
    pub(super) fn inside(&self, [x, y, z]: [usize; 3]) -> bool {
        self.row(y, z)[x / 64] >> (x % 64) & 1 == 1
    }

    /// How many of the six edges at a sample are crossed.
    pub(super) fn crossed_edges_at(&self, sample: [usize; 3]) -> usize {
        let here = self.inside(sample);
        let mut count = 0;
        for axis in 0..3 {
            let mut beside = sample;
            if sample[axis] > 0 {
                beside[axis] = sample[axis] - 1;
                count += usize::from(self.inside(beside) != here);
            }
            if sample[axis] + 1 < self.counts[axis] {
                beside[axis] = sample[axis] + 1;
                count += usize::from(self.inside(beside) != here);
            }
        }
        count
    }

    /// Of the edges that start at 64 samples of a row, those that are crossed, along each axis.
    #[inline(always)]
    pub(super) fn crossed(&self, y: usize, z: usize, word: usize) -> [u64; 3] {
        let row = self.row(y, z);
        let signs = row[word];
        let next = row.get(word + 1).copied().unwrap_or(0);
        // The last sample starts no edge along x.
        let last = self.counts[0] - 1;
        let starts = if last / 64 > word { u64::MAX } else { (1u64 << (last % 64)) - 1 };
        [
            (signs ^ (signs >> 1 | next << 63)) & starts,
            if y + 1 < self.counts[1] { signs ^ self.row(y + 1, z)[word] } else { 0 },
            if z + 1 < self.counts[2] { signs ^ self.row(y, z + 1)[word] } else { 0 },
        ]
    }

    /// The number of the first crossed edge of each row along each axis, and the count of all as a last entry.
    pub(super) fn number_edges(&self) -> Result<EdgeNumbers, ImplicitError> {
        let [_, ny, nz] = self.counts;
        let mut rows = vec![[0u32; 3]; ny * nz + 1];
        rows[..ny * nz]
            .par_chunks_mut(ny)
            .enumerate()
            .for_each(|(z, rows)| dispatch(Count { signs: self, z, rows }));
        let mut next = 0usize;
        for row in &mut rows {
            for first in row {
                let count = *first as usize;
                *first = next as u32;
                next += count;
                if next > MOST_VERTICES {
                    return Err(ImplicitError::TooManyVertices { most: MOST_VERTICES });
                }
            }
        }
        Ok(EdgeNumbers { rows, rows_per_slice: ny, total: next })
    }
}

/// The numbers of crossed edges.
pub(super) struct EdgeNumbers {
    rows: Vec<[u32; 3]>,
    rows_per_slice: usize,
    /// How many there are.
    pub(super) total: usize,
}

impl EdgeNumbers {
    /// The first number along each axis in a row.
    #[inline]
    pub(super) fn row(&self, y: usize, z: usize) -> [u32; 3] {
        self.rows[z * self.rows_per_slice + y]
    }

    /// Parts of a list of all crossed edges, one for each slice.
    pub(super) fn split<'a, T>(&self, mut list: &'a mut [T]) -> Vec<&'a mut [T]> {
        let slices = (self.rows.len() - 1) / self.rows_per_slice;
        let first = |slice: usize| self.rows[slice * self.rows_per_slice][0] as usize;
        (0..slices)
            .map(|slice| {
                let count = first(slice + 1) - first(slice);
                let (part, rest) = std::mem::take(&mut list).split_at_mut(count);
                list = rest;
                part
            })
            .collect()
    }
}

/// Fills words from values.
struct Pack<'a> {
    words: &'a mut [u64],
    values: &'a [f32],
    row: usize,
    level: f32,
}

impl Task for Pack<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let words_per_row = self.row.div_ceil(64);
        let rows = self.words.chunks_exact_mut(words_per_row).zip(self.values.chunks_exact(self.row));
        for (words, values) in rows {
            let (groups, rest) = values.as_chunks::<64>();
            for (word, group) in words.iter_mut().zip(groups) {
                let mut bits = 0;
                for (n, eight) in group.as_chunks::<8>().0.iter().enumerate() {
                    // Eight bytes of 0 or 1; the product moves them side by side into the top byte.
                    let flags = u64::from_le_bytes(eight.map(|value| u8::from(value < self.level)));
                    bits |= (flags.wrapping_mul(0x0102_0408_1020_4080) >> 56) << (8 * n);
                }
                *word = bits;
            }
            for (n, &value) in rest.iter().enumerate() {
                words[groups.len()] |= u64::from(value < self.level) << n;
            }
        }
    }
}

/// Counts the crossed edges of each row of a slice.
struct Count<'a> {
    signs: &'a Signs,
    z: usize,
    rows: &'a mut [[u32; 3]],
}

impl Task for Count<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for (y, row) in self.rows.iter_mut().enumerate() {
            for word in 0..self.signs.words_per_row {
                let crossed = self.signs.crossed(y, self.z, word);
                for axis in 0..3 {
                    row[axis] += crossed[axis].count_ones();
                }
            }
        }
    }
}

/// Calls `visit(x, edges)` for each cell of a row that the surface runs through, with its signs; and tells the numbers of its
/// edges.
#[inline(always)]
pub(super) fn for_each_crossed_cell(
    signs: &Signs,
    numbers: &EdgeNumbers,
    y: usize,
    z: usize,
    mut visit: impl FnMut(usize, u8, &[u32; 12]),
) {
    let rows = [signs.row(y, z), signs.row(y + 1, z), signs.row(y, z + 1), signs.row(y + 1, z + 1)];
    let [x0, y0, z0] = numbers.row(y, z);
    let [x1, _, z1] = numbers.row(y + 1, z);
    let [x2, y1, _] = numbers.row(y, z + 1);
    let [x3, _, _] = numbers.row(y + 1, z + 1);
    let mut along_x = [x0, x1, x2, x3];
    let mut along_y = [y0, y1];
    let mut along_z = [z0, z1];
    let cells = signs.counts[0] - 1;
    for word in 0..cells.div_ceil(64) {
        let here = rows.map(|row| row[word]);
        let next = rows.map(|row| row.get(word + 1).copied().unwrap_or(0));
        let beside: [u64; 4] = std::array::from_fn(|n| here[n] >> 1 | next[n] << 63);
        let any = here.iter().chain(&beside).fold(0, |any, bits| any | bits);
        let all = here.iter().chain(&beside).fold(u64::MAX, |all, bits| all & bits);
        let in_row = if cells - word * 64 >= 64 { u64::MAX } else { (1u64 << (cells - word * 64)) - 1 };
        let mut crossed = any & !all & in_row;
        while crossed != 0 {
            let bit = crossed.trailing_zeros();
            crossed &= crossed - 1;
            let mut corners = 0u32;
            for n in 0..4 {
                corners |= ((here[n] >> bit & 1) as u32) << (2 * n);
                corners |= ((beside[n] >> bit & 1) as u32) << (2 * n + 1);
            }
            let (by_x, by_y, by_z) = (corners ^ corners >> 1, corners ^ corners >> 2, corners ^ corners >> 4);
            let (y_low, y_high) = (by_y & 1, by_y >> 4 & 1);
            let (z_low, z_high) = (by_z & 1, by_z >> 2 & 1);
            let edges = [
                along_x[0],
                along_x[1],
                along_x[2],
                along_x[3],
                along_y[0],
                along_y[0] + y_low,
                along_y[1],
                along_y[1] + y_high,
                along_z[0],
                along_z[0] + z_low,
                along_z[1],
                along_z[1] + z_high,
            ];
            visit(word * 64 + bit as usize, corners as u8, &edges);
            for (n, next) in along_x.iter_mut().enumerate() {
                *next += by_x >> (2 * n) & 1;
            }
            along_y = [along_y[0] + y_low, along_y[1] + y_high];
            along_z = [along_z[0] + z_low, along_z[1] + z_high];
        }
    }
}
