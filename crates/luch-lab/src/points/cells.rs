//! Sets of a fixed size made of cells: grids, jittered grids, Latin hypercubes, multi-jittered pairs.

use super::{BELOW_ONE, Design};
use crate::generator::{Generator, Stream};

/// A grid: cells along each axis, and of all.
pub(super) struct Grid {
    pub(super) side: u64,
    pub(super) count: u64,
}

/// The largest k^d that is not above `wanted`.
pub(super) fn per_axis(wanted: u64, dimensions: usize) -> Grid {
    let power = |side: u64| (0..dimensions).try_fold(1u64, |product, _| product.checked_mul(side));
    let (mut side, mut above) = (1, wanted.saturating_add(1));
    while side + 1 < above {
        let middle = side + (above - side) / 2;
        if power(middle).is_some_and(|count| count <= wanted) {
            side = middle;
        } else {
            above = middle;
        }
    }
    Grid { side, count: power(side).unwrap_or(1) }
}

/// m and n with m·n = count, m ≤ n ≤ 2m and m largest.
pub(super) fn factors(count: u64) -> Option<[u64; 2]> {
    let root = count.isqrt();
    (1..=root)
        .rev()
        .take_while(|&m| count <= 2 * m * m)
        .find(|&m| count.is_multiple_of(m))
        .map(|m| [m, count / m])
}

/// A number below `bound` without bias worth mention: 64 bits times the bound (Lemire 2019, without rejection).
fn below(stream: &mut Stream, bound: u64) -> u64 {
    ((u128::from(stream.next_native()) * u128::from(bound)) >> 64) as u64
}

/// The numbers 0 … n − 1 in a random order (Fisher and Yates).
fn shuffled(stream: &mut Stream, length: u64, order: &mut Vec<u32>) {
    order.clear();
    order.extend(0..length as u32);
    for i in (1..order.len()).rev() {
        let other = below(stream, i as u64 + 1) as usize;
        order.swap(i, other);
    }
}

/// The middles of the cells, the last coordinate running fastest.
pub(super) fn midpoints(design: &Design, first: u64, out: &mut [f64]) {
    let side = per_axis(design.count, design.dimensions).side;
    for (i, point) in out.chunks_exact_mut(design.dimensions).enumerate() {
        let mut rest = first + i as u64;
        for coordinate in point.iter_mut().rev() {
            *coordinate = ((rest % side) as f64 + 0.5) / side as f64;
            rest /= side;
        }
    }
}

/// A random point in each cell, in the same order.
pub(super) fn jittered(design: &Design, key: u64, out: &mut [f64]) {
    let side = per_axis(design.count, design.dimensions).side;
    Generator::DEFAULT.start(key).fill_unit(out);
    let mut cell = vec![0u64; design.dimensions];
    let width = 1.0 / side as f64;
    for point in out.chunks_exact_mut(design.dimensions) {
        for (coordinate, &cell) in point.iter_mut().zip(&cell) {
            *coordinate = ((cell as f64 + *coordinate) * width).min(BELOW_ONE);
        }
        for digit in cell.iter_mut().rev() {
            *digit += 1;
            if *digit < side {
                break;
            }
            *digit = 0;
        }
    }
}

/// Each axis has one point in each of N slices, in an order of its own.
pub(super) fn latin_hypercube(design: &Design, key: u64, out: &mut [f64]) {
    let mut stream = Generator::DEFAULT.start(key);
    stream.fill_unit(out);
    let mut order = Vec::new();
    let width = 1.0 / design.count as f64;
    for dimension in 0..design.dimensions {
        shuffled(&mut stream, design.count, &mut order);
        for (point, &slice) in out.chunks_exact_mut(design.dimensions).zip(&order) {
            let coordinate = &mut point[dimension];
            *coordinate = ((f64::from(slice) + *coordinate) * width).min(BELOW_ONE);
        }
    }
}

/// Pairs of coordinates with one point in each of m × n cells and in each of N slices along both axes; pairs in orders of their own.
pub(super) fn multi_jittered(design: &Design, key: u64, correlated: bool, out: &mut [f64]) {
    let [columns, rows] = factors(design.count).unwrap_or([1, design.count]);
    let mut stream = Generator::DEFAULT.start(key);
    stream.fill_unit(out);
    let width = 1.0 / design.count as f64;
    // Slice of each cell: within a column one order of the rows, within a row one order of the columns.
    let (mut within_column, mut within_row, mut order) = (Vec::new(), Vec::new(), Vec::new());
    let mut one = Vec::new();
    for pair in 0..design.dimensions.div_ceil(2) {
        for (list, times, length) in [(&mut within_column, columns, rows), (&mut within_row, rows, columns)] {
            list.clear();
            for line in 0..times {
                if line == 0 || !correlated {
                    shuffled(&mut stream, length, &mut one);
                }
                list.extend_from_slice(&one);
            }
        }
        shuffled(&mut stream, design.count, &mut order);
        for (point, &cell) in out.chunks_exact_mut(design.dimensions).zip(&order) {
            let (column, row) = (u64::from(cell) / rows, u64::from(cell) % rows);
            let slices = [
                column * rows + u64::from(within_column[(column * rows + row) as usize]),
                row * columns + u64::from(within_row[(row * columns + column) as usize]),
            ];
            for (coordinate, slice) in point[2 * pair..].iter_mut().zip(slices) {
                *coordinate = ((slice as f64 + *coordinate) * width).min(BELOW_ONE);
            }
        }
    }
}
