//! Which corners of a cell are joined inside it, where values are interpolated trilinearly.
//!
//! On a slice across z the values are bilinear, with corners A, B, C, D in order round it, each linear in z. Corners of equal
//! sign that are opposite each other are joined over the slice as the sign of A C − B D says. All of this changes only where a
//! corner passes zero and at the two roots of that quadratic, so the slices between these places tell everything. This is the
//! test that Chernyaev ("Marching Cubes 33", 1995) makes at one slice only; Custodio et al. ("Practical considerations on
//! Marching Cubes 33 topological correctness", 2013) show that one is not enough.

use super::cell::CORNERS;

/// Corners of a slice in order round it: the corners 0, 1, 3, 2 of the cell.
const ROUND: [usize; 4] = [0, 1, 3, 2];
/// At most four zeros of corners and two roots, hence seven slices.
const SLICES: usize = 7;

/// Whether the inner corners of a face are joined over it; `values` in order round it, of which the first and the third have one
/// sign and the others the other.
///
/// Both cells of a face must give the same order up to a turn; a turn changes no bit of the result.
pub(super) fn joined_over_face(values: [f64; 4]) -> bool {
    let [a, b, c, d] = values;
    let (one, other) = (a * c, b * d);
    // The product on the inner diagonal must win.
    if a < 0.0 { one > other } else { other > one }
}

/// For each corner a number; corners with one number are joined inside the cell.
pub(super) fn joined_inside(values: &[f64; CORNERS]) -> [u8; CORNERS] {
    // Zero counts as outside, here too.
    let value = |corner: usize| match values[corner] {
        v if v < 0.0 => v.max(-1e100),
        v if v > 0.0 => v.min(1e100),
        _ => f64::MIN_POSITIVE,
    };
    let low = ROUND.map(value);
    let rise: [f64; 4] = std::array::from_fn(|n| value(ROUND[n] + 4) - low[n]);

    // Where slices change.
    let mut heights = [1.0; SLICES + 1];
    heights[0] = 0.0;
    let mut count = 1;
    let mut note = |height: f64| {
        if height > 0.0 && height < 1.0 {
            heights[count] = height;
            count += 1;
        }
    };
    for n in 0..4 {
        note(-low[n] / rise[n]);
    }
    let square = rise[0] * rise[2] - rise[1] * rise[3];
    let linear = low[0] * rise[2] + low[2] * rise[0] - low[1] * rise[3] - low[3] * rise[1];
    let constant = low[0] * low[2] - low[1] * low[3];
    let root = (linear * linear - 4.0 * square * constant).sqrt();
    // The sum of two numbers of one sign, so that nothing cancels.
    let half = -0.5 * (linear + root.copysign(linear));
    note(half / square);
    note(constant / half);
    let slices = count;
    let heights = &mut heights[..=slices];
    heights[slices] = 1.0;
    heights.sort_unstable_by(f64::total_cmp);

    // Join within slices and from slice to slice.
    let mut group: [u8; SLICES * 4] = std::array::from_fn(|n| n as u8);
    let mut join = |a: usize, b: usize| {
        let [from, to] = [group[a].max(group[b]), group[a].min(group[b])];
        for place in &mut group {
            if *place == from {
                *place = to;
            }
        }
    };
    let mut before = [false; 4];
    for slice in 0..slices {
        let height = 0.5 * (heights[slice] + heights[slice + 1]);
        let at: [f64; 4] = std::array::from_fn(|n| low[n] + height * rise[n]);
        let inside = at.map(|v| v < 0.0);
        let node = |n: usize| slice * 4 + n % 4;
        for n in 0..4 {
            if inside[n] == inside[(n + 1) % 4] {
                join(node(n), node(n + 1));
            }
            if slice > 0 && inside[n] == before[n] {
                join(node(n), node(n) - 4);
            }
        }
        if inside[0] == inside[2] && inside[1] == inside[3] && inside[0] != inside[1] {
            let first = inside[0] == joined_over_face(at);
            join(node(usize::from(!first)), node(usize::from(!first) + 2));
        }
        before = inside;
    }
    let mut joined = [0; CORNERS];
    for n in 0..4 {
        joined[ROUND[n]] = group[n];
        joined[ROUND[n] + 4] = group[(slices - 1) * 4 + n];
    }
    joined
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The groups of lattice points inside and outside, by flooding a fine lattice.
    fn flooded(values: &[f64; CORNERS], n: usize) -> [u32; CORNERS] {
        let at = |p: [usize; 3]| {
            let t = p.map(|p| p as f64 / (n - 1) as f64);
            (0..CORNERS).fold(0.0, |sum, corner| {
                let weight =
                    (0..3).fold(1.0, |w, a| w * if corner >> a & 1 == 1 { t[a] } else { 1.0 - t[a] });
                sum + weight * values[corner]
            })
        };
        let place = |p: [usize; 3]| (p[2] * n + p[1]) * n + p[0];
        let mut sets = crate::sets::DisjointSets::new(n * n * n);
        for z in 0..n {
            for y in 0..n {
                for x in 0..n {
                    for axis in 0..3 {
                        let mut q = [x, y, z];
                        q[axis] += 1;
                        if q[axis] < n && (at([x, y, z]) < 0.0) == (at(q) < 0.0) {
                            sets.join(place([x, y, z]) as u32, place(q) as u32);
                        }
                    }
                }
            }
        }
        std::array::from_fn(|corner| sets.root(place([0, 1, 2].map(|a| (corner >> a & 1) * (n - 1))) as u32))
    }

    /// Flooding finds a bridge only if it is wide, so what it joins must be joined; and cells it calls parted at a level as well
    /// as at a slightly lower and higher one must be parted.
    #[test]
    fn agrees_with_flooding() {
        let mut state = 7u64;
        let mut number = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
        };
        let (mut joined, mut parted) = (0, 0);
        for _ in 0..400 {
            let values: [f64; CORNERS] = std::array::from_fn(|_| number());
            let found = joined_inside(&values);
            let flood = flooded(&values, 24);
            for a in 0..CORNERS {
                for b in 0..a {
                    if (values[a] < 0.0) != (values[b] < 0.0) {
                        assert_ne!(found[a], found[b]);
                    } else if flood[a] == flood[b] {
                        assert_eq!(found[a], found[b], "{values:?}");
                        joined += 1;
                    } else {
                        let shift = 0.01f64.copysign(values[a]);
                        let wider = flooded(&values.map(|v| v + shift), 24);
                        if wider[a] != wider[b] {
                            assert_ne!(found[a], found[b], "{values:?}");
                            parted += 1;
                        }
                    }
                }
            }
        }
        assert!(joined > 1000 && parted > 50, "{joined} {parted}");
    }
}
