//! Generator matrices of digital sequences in base 2, a column for each bit of the index.

use super::joe_kuo::{JOE_KUO, JoeKuo};
use super::{MOST_DIMENSIONS, Rule};
use luch_sampling::hash;
use std::sync::OnceLock;

/// What each bit of the index adds (exclusive or) to a coordinate, as fractions of 2³².
pub(super) type Columns = [u32; 32];

/// The direction numbers of one Sobol' dimension as fractions of 2³², in natural order: entry k belongs to bit k of the index.
/// `None` from dimension 64 on.
pub fn sobol_directions(dimension: usize) -> Option<[u32; 32]> {
    sobol().get(dimension).copied()
}

/// All Sobol' dimensions.
pub(super) fn sobol() -> &'static [Columns] {
    static TABLE: OnceLock<Vec<Columns>> = OnceLock::new();
    TABLE.get_or_init(|| {
        let first: Columns = std::array::from_fn(|bit| 1 << (31 - bit));
        std::iter::once(first).chain(JOE_KUO.iter().map(columns)).take(MOST_DIMENSIONS).collect()
    })
}

/// The recurrence of Bratley and Fox (1988).
fn columns(of: &JoeKuo) -> Columns {
    let mut table = [0u32; 32];
    for bit in 0..32 {
        table[bit] = match of.initial.get(bit) {
            Some(&initial) => initial << (31 - bit),
            None => {
                let oldest = table[bit - of.degree];
                (1..of.degree)
                    .filter(|k| of.coefficients >> (of.degree - 1 - k) & 1 == 1)
                    .fold(oldest ^ oldest >> of.degree, |value, k| value ^ table[bit - k])
            }
        };
    }
    table
}

/// A (0,4)-sequence in base 4 whose coordinates (0, 1) and (2, 3) are (0,2)-sequences in base 2.
///
/// Niederreiter's construction over the field of four elements (1987): dimension s has the matrix of binomials
/// C(j, i)·s^(j−i), each element written as the 2 × 2 binary matrix that multiplies by it. In front of the odd dimensions every
/// digit is multiplied by (1 1; 0 1). That changes nothing in base 4, and of the 36 choices per pair it is among those for
/// which the pairs are nets in base 2; the test checks it.
pub(super) fn four() -> &'static [Columns; 4] {
    static TABLE: OnceLock<[Columns; 4]> = OnceLock::new();
    TABLE.get_or_init(|| std::array::from_fn(four_columns))
}

/// A 2 × 2 matrix of bits: rows of two, the first in the high half.
type Block = [[u32; 2]; 2];

fn product(a: Block, b: Block) -> Block {
    std::array::from_fn(|i| std::array::from_fn(|j| (a[i][0] & b[0][j]) ^ (a[i][1] & b[1][j])))
}

fn four_columns(dimension: usize) -> Columns {
    const ONE: Block = [[1, 0], [0, 1]];
    /// Multiplication by a root of x² + x + 1.
    const ROOT: Block = [[0, 1], [1, 1]];
    const ZERO: Block = [[0, 0], [0, 0]];
    let element = [ZERO, ONE, ROOT, product(ROOT, ROOT)][dimension % 4];
    let front = if dimension % 2 == 1 { [[1, 1], [0, 1]] } else { ONE };
    let mut table = [0u32; 32];
    for column in 0..16usize {
        let mut power = front;
        for row in (0..=column).rev() {
            // Binomials modulo 2 by Lucas: C(j, i) is odd if the bits of i are among those of j.
            if row & !column == 0 {
                for (r, bits) in power.iter().enumerate() {
                    for (c, &bit) in bits.iter().enumerate() {
                        table[2 * column + c] |= bit << (31 - (2 * row + r));
                    }
                }
            }
            power = product(power, element);
        }
    }
    table
}

/// The matrices of one coordinate pair of a progressive multi-jittered (0,2)-sequence, chosen at random.
///
/// Column by column. Going from 4^k points to 2·4^k, the new point of each cell of the 2^k × 2^k grid must lie diagonally
/// opposite the old one; from 2·4^k to 4^(k+1) it must lie in a cell quarter that is still empty, which leaves one bit of
/// choice. That the points stay a net in base 2 is one linear equation for each shape of box: the new column must not be in
/// the span of the old ones. The solutions of all these equations together are one for each choice.
pub(super) fn progressive(key: u64) -> [Columns; 2] {
    let mut rows = [[0u32; 32]; 2];
    for column in 0..32usize {
        let height = column + 1;
        let mut equations = Vec::with_capacity(2 * height + 4);
        for first in 0..=height {
            let chosen = (0..first).map(|r| (0, r)).chain((0..height - first).map(|r| (1, r)));
            equations.push((dependency(&rows, chosen, height), true));
        }
        let quarter = column / 2;
        for row in 0..quarter {
            equations.push((1 << row, false));
            equations.push((1 << (height + row), false));
        }
        let sides = [1u64 << quarter, 1u64 << (height + quarter)];
        let choice = hash::word(key, column as u64) >> 63 == 1;
        if column % 2 == 0 {
            equations.extend(sides.map(|side| (side, true)));
        } else {
            equations.extend([(sides[0], choice), (sides[1], !choice)]);
        }
        let solution = solve(&equations);
        for (matrix, rows) in rows.iter_mut().enumerate() {
            for (row, bits) in rows.iter_mut().enumerate().take(height) {
                *bits |= ((solution >> (matrix * height + row) & 1) as u32) << column;
            }
        }
    }
    rows.map(|rows| {
        std::array::from_fn(|column| {
            (0..32).fold(0, |word, row| word | (rows[row] >> column & 1) << (31 - row))
        })
    })
}

/// The combination of the chosen rows that vanishes on all columns so far, as a set of unknowns of the next column: row r of the
/// first matrix is unknown r, of the second `height` + r.
fn dependency(rows: &[[u32; 32]; 2], chosen: impl Iterator<Item = (usize, usize)>, height: usize) -> u64 {
    let mut pivots: Vec<(u32, u64)> = Vec::with_capacity(32);
    for (matrix, row) in chosen {
        let (mut value, mut names) = (rows[matrix][row], 1u64 << (matrix * height + row));
        for &(pivot, pivot_names) in &pivots {
            if value >> pivot.ilog2() & 1 == 1 {
                value ^= pivot;
                names ^= pivot_names;
            }
        }
        if value == 0 {
            return names;
        }
        pivots.push((value, names));
    }
    0
}

/// Solves linear equations over bits, (set of unknowns, their sum); unknowns left free are zero.
fn solve(equations: &[(u64, bool)]) -> u64 {
    let mut pivots: Vec<(u64, bool)> = Vec::with_capacity(64);
    for &(mut set, mut sum) in equations {
        for &(pivot, pivot_sum) in &pivots {
            if set >> pivot.ilog2() & 1 == 1 {
                set ^= pivot;
                sum ^= pivot_sum;
            }
        }
        if set != 0 {
            pivots.push((set, sum));
        }
    }
    let mut solution = 0u64;
    for &(set, sum) in pivots.iter().rev() {
        let lead = 1u64 << set.ilog2();
        // Later pivots may hold higher unknowns than this one, so all others are looked at.
        if ((solution & set & !lead).count_ones() % 2 == 1) != sum {
            solution |= lead;
        }
    }
    solution
}

/// The matrices of all dimensions of a rule's group.
pub(super) fn group(rule: Rule) -> &'static [Columns] {
    match rule {
        Rule::Sz => four(),
        _ => &sobol()[..2],
    }
}
