//! Elementary intervals: whether points are a (t, m, s)-net in base 2.

/// A dyadic box that does not hold its share of the points.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CrowdedBox<const D: usize> {
    /// The box is 2 to the minus this long in each dimension.
    pub bits: [u32; D],
    /// Its place, in its own lengths.
    pub place: [u32; D],
    /// Points in it.
    pub points: u64,
    /// Points it should hold: 2^quality.
    pub expected: u64,
}

/// Looks for an elementary interval of volume 2^quality/N that does not hold exactly 2^quality of the N points.
///
/// `points` are fractions of 2³², their number a power of two. `None` means that the points are a net of this quality: every
/// box 2^−k₁ × … × 2^−k_D with k₁ + … + k_D = log₂ N − quality holds its share. Quality 0 is the best.
/// A number of points that is no power of two is not a net, reported as the whole cube; nor can a quality of log₂ N or more
/// be missed.
pub fn crowded_box<const D: usize>(points: &[[u32; D]], quality: u32) -> Option<CrowdedBox<D>> {
    if !points.len().is_power_of_two() {
        let n = points.len() as u64;
        return Some(CrowdedBox { bits: [0; D], place: [0; D], points: n, expected: n.next_power_of_two() });
    }
    let total = points.len().ilog2().checked_sub(quality)?;
    let mut bits = [0; D];
    search(points, total, 0, &mut bits)
}

/// Tries all ways to share `left` bits among the dimensions from `dimension` on.
fn search<const D: usize>(
    points: &[[u32; D]],
    left: u32,
    dimension: usize,
    bits: &mut [u32; D],
) -> Option<CrowdedBox<D>> {
    if dimension + 1 >= D {
        if let Some(last) = bits.last_mut() {
            *last = left;
        }
        return count(points, bits);
    }
    (0..=left).find_map(|share| {
        bits[dimension] = share;
        search(points, left - share, dimension + 1, bits)
    })
}

/// Counts the points of every box of one shape.
fn count<const D: usize>(points: &[[u32; D]], bits: &[u32; D]) -> Option<CrowdedBox<D>> {
    let total: u32 = bits.iter().sum();
    let expected = (points.len() >> total) as u64;
    let mut counts = vec![0u64; 1 << total];
    for point in points {
        let cell = point
            .iter()
            .zip(bits)
            .fold(0usize, |cell, (&coordinate, &k)| cell << k | (u64::from(coordinate) >> (32 - k)) as usize);
        counts[cell] += 1;
    }
    let wrong = counts.iter().position(|&n| n != expected)?;
    let (mut place, mut rest) = ([0; D], wrong);
    for dimension in (0..D).rev() {
        place[dimension] = (rest & ((1 << bits[dimension]) - 1)) as u32;
        rest >>= bits[dimension];
    }
    Some(CrowdedBox { bits: *bits, place, points: counts[wrong], expected })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_what_is_wrong() {
        let half = 1u32 << 31;
        assert_eq!(crowded_box(&[[0, 0], [half, half]], 0), None);
        let diagonal_twice = [[0, 0], [half, half], [1, 1], [half, half]];
        let crowded = crowded_box(&diagonal_twice, 0).unwrap();
        assert_eq!((crowded.bits, crowded.place, crowded.points, crowded.expected), ([0, 2], [0, 0], 2, 1));
        assert_eq!(crowded_box(&diagonal_twice, 1), None);
        assert_eq!(crowded_box(&[[0, 0]; 3], 0).unwrap().expected, 4);
    }
}
