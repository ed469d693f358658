//! Elementary intervals: the quality t of points as a (t, m, d)-net in base 2.

use crate::points::PointSet;

/// The least t for which 2^m points are a (t, m, d)-net in base 2: every dyadic box of volume 2^(t−m) holds exactly 2^t of them.
///
/// `None` if the number of points is no power of two or a coordinate lies outside [0, 1). m is always reached. Meant for few dimensions:
/// all shapes of boxes are counted.
pub fn quality(points: &PointSet) -> Option<u32> {
    let columns: Vec<Vec<u32>> = (0..points.dimensions()).map(|d| words(points, d)).collect::<Option<_>>()?;
    of_columns(&columns.iter().map(Vec::as_slice).collect::<Vec<_>>())
}

/// The quality of one projection onto two dimensions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PairQuality {
    /// First dimension, from 0.
    pub first: usize,
    /// Second dimension, larger than the first.
    pub second: usize,
    /// Quality t of the projection; 0 is best.
    pub quality: u32,
}

/// The quality of all projections onto two dimensions; `None` as for [`quality`].
pub fn pair_qualities(points: &PointSet) -> Option<Vec<PairQuality>> {
    let columns: Vec<Vec<u32>> = (0..points.dimensions()).map(|d| words(points, d)).collect::<Option<_>>()?;
    let mut found = Vec::new();
    for second in 1..columns.len() {
        for first in 0..second {
            found.push(PairQuality {
                first,
                second,
                quality: of_columns(&[&columns[first], &columns[second]])?,
            });
        }
    }
    Some(found)
}

/// One coordinate of all points as fractions of 2³².
fn words(points: &PointSet, dimension: usize) -> Option<Vec<u32>> {
    points
        .iter()
        .map(|point| point[dimension])
        .map(|x| (0.0..1.0).contains(&x).then_some((x * 4_294_967_296.0) as u32))
        .collect()
}

fn of_columns(columns: &[&[u32]]) -> Option<u32> {
    let count = columns.first()?.len();
    if !count.is_power_of_two() || count > 1 << 31 {
        return None;
    }
    let m = count.ilog2();
    let mut cells = vec![0u32; count];
    (0..=m).find(|&t| {
        let mut shape = vec![0; columns.len()];
        every_shape(m - t, 0, &mut shape, &mut |shape| even(columns, shape, t, &mut cells))
    })
}

/// Whether a property holds for all ways to share `left` bits among the dimensions from `from` on.
fn every_shape(left: u32, from: usize, shape: &mut [u32], holds: &mut impl FnMut(&[u32]) -> bool) -> bool {
    if from + 1 == shape.len() {
        shape[from] = left;
        return holds(shape);
    }
    (0..=left).all(|share| {
        shape[from] = share;
        every_shape(left - share, from + 1, shape, holds)
    })
}

/// Whether all boxes of one shape hold 2^t points.
fn even(columns: &[&[u32]], shape: &[u32], t: u32, cells: &mut [u32]) -> bool {
    let boxes = 1usize << shape.iter().sum::<u32>();
    cells[..boxes].fill(0);
    for i in 0..columns[0].len() {
        let cell = columns
            .iter()
            .zip(shape)
            .fold(0u64, |cell, (column, &bits)| cell << bits | u64::from(column[i]) >> (32 - bits));
        cells[cell as usize] += 1;
        if cells[cell as usize] > 1 << t {
            return false;
        }
    }
    // As many points as places: none too full means none too empty.
    true
}
