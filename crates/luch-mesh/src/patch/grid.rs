//! Triangles of one Bezier piece: a grid inside, and a strip to the vertices of each side.

use super::fineness::Divisions;

/// A place on a side or in a row: how far along it is, and its number.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stop {
    pub(super) fraction: f64,
    pub(super) place: u32,
}

/// The four sides, each in the direction in which its parameter grows. Corners are the ends of two sides.
pub(super) struct Sides {
    pub(super) bottom: Vec<Stop>,
    pub(super) right: Vec<Stop>,
    pub(super) top: Vec<Stop>,
    pub(super) left: Vec<Stop>,
}

/// The cells that fit the sides: where a side has vertices between its ends, there must be a row of vertices inside.
pub(super) fn fitting(wanted: Divisions, segments_u: u64, segments_v: u64) -> Divisions {
    let Divisions { mut u, mut v } = wanted;
    if (v == 1 && segments_v > 1) || (u == 1 && segments_u > 1) {
        (u, v) = (u.max(2), v.max(2));
    }
    Divisions { u, v }
}

/// The triangles over the sides and the inner vertices `inner(i, j)`, `0 < i < u`, `0 < j < v`.
///
/// If the sides have at least as many segments as there are cells, every triangle lies in a box of the size of a cell.
pub(super) fn triangles(
    cells: Divisions,
    sides: &Sides,
    inner: impl Fn(u64, u64) -> u32,
    triangles: &mut Vec<[u32; 3]>,
) {
    let Divisions { u, v } = cells;
    let row = |j: u64| -> Vec<Stop> {
        (1..u).map(|i| Stop { fraction: i as f64 / u as f64, place: inner(i, j) }).collect()
    };
    let column = |i: u64| -> Vec<Stop> {
        (1..v).map(|j| Stop { fraction: j as f64 / v as f64, place: inner(i, j) }).collect()
    };
    match (u, v) {
        (_, 1) if sides.bottom.len() >= sides.top.len() => strip(&sides.bottom, &sides.top, triangles),
        (_, 1) => strip(&reversed(&sides.top), &reversed(&sides.bottom), triangles),
        (1, _) if sides.right.len() >= sides.left.len() => strip(&sides.right, &sides.left, triangles),
        (1, _) => strip(&reversed(&sides.left), &reversed(&sides.right), triangles),
        _ => {
            for j in 1..v - 1 {
                for i in 1..u - 1 {
                    let [a, b] = [inner(i, j), inner(i + 1, j)];
                    let [c, d] = [inner(i + 1, j + 1), inner(i, j + 1)];
                    triangles.extend([[a, b, c], [a, c, d]]);
                }
            }
            strip(&sides.bottom, &row(1), triangles);
            strip(&sides.right, &column(u - 1), triangles);
            strip(&reversed(&sides.top), &reversed(&row(v - 1)), triangles);
            strip(&reversed(&sides.left), &reversed(&column(1)), triangles);
        }
    }
}

fn reversed(stops: &[Stop]) -> Vec<Stop> {
    stops.iter().rev().map(|stop| Stop { fraction: 1.0 - stop.fraction, place: stop.place }).collect()
}

/// Triangles between an outer line, which runs with the inside on its left, and an inner line beside it.
fn strip(outer: &[Stop], inner: &[Stop], triangles: &mut Vec<[u32; 3]>) {
    let mut from = 0;
    for (i, here) in inner.iter().enumerate() {
        // The outer stop below the middle of the inner segment that follows.
        let next = inner.get(i + 1);
        let to = next.map_or(outer.len() - 1, |next| {
            let middle = here.fraction.midpoint(next.fraction);
            let away = |k: usize| (outer[k].fraction - middle).abs();
            let mut nearest = from;
            while nearest + 1 < outer.len() && away(nearest + 1) < away(nearest) {
                nearest += 1;
            }
            nearest
        });
        triangles.extend((from..to).map(|k| [outer[k].place, outer[k + 1].place, here.place]));
        if let Some(next) = next {
            triangles.push([next.place, here.place, outer[to].place]);
        }
        from = to;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Over many counts: the triangles cover the square once, and none is larger than a cell.
    #[test]
    fn triangles_tile_the_square_within_cells() {
        for (u, v, extra) in
            [(1, 1, 0), (1, 4, 0), (5, 1, 0), (5, 1, 3), (2, 2, 0), (3, 4, 5), (7, 2, 1), (1, 3, 2)]
        {
            let counts = [u + extra, v + 2 * extra, u + extra / 2, v];
            let wanted = Divisions { u, v };
            let cells = fitting(wanted, counts[0].max(counts[2]), counts[1].max(counts[3]));
            let mut places: Vec<[f64; 2]> = Vec::new();
            let mut side = |count: u64, place: &dyn Fn(f64) -> [f64; 2]| -> Vec<Stop> {
                let mut stops = Vec::new();
                for k in 0..=count {
                    let fraction = k as f64 / count as f64;
                    stops.push(Stop { fraction, place: places.len() as u32 });
                    places.push(place(fraction));
                }
                stops
            };
            // A single cell along a direction asks for sides without stops.
            let [b, r, t, l] = counts;
            let (r, l) = if cells.v == 1 { (1, 1) } else { (r, l) };
            let (b, t) = if cells.u == 1 { (1, 1) } else { (b, t) };
            let sides = Sides {
                bottom: side(b, &|t| [t, 0.0]),
                right: side(r, &|t| [1.0, t]),
                top: side(t, &|t| [t, 1.0]),
                left: side(l, &|t| [0.0, t]),
            };
            let first = places.len() as u64;
            for j in 1..cells.v {
                for i in 1..cells.u {
                    places.push([i as f64 / cells.u as f64, j as f64 / cells.v as f64]);
                }
            }
            let mut list = Vec::new();
            triangles(cells, &sides, |i, j| (first + (j - 1) * (cells.u - 1) + i - 1) as u32, &mut list);
            let mut area = 0.0;
            for triangle in list {
                let [a, b, c] = triangle.map(|k| places[k as usize]);
                let double = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
                assert!(double > 0.0, "{u} {v} {extra}: {a:?} {b:?} {c:?}");
                area += double / 2.0;
                for axis in 0..2 {
                    let values = [a[axis], b[axis], c[axis]];
                    let extent = values.iter().fold(0.0, |most: f64, x| most.max((x - values[0]).abs()));
                    assert!(extent <= 1.0 / [u, v][axis] as f64 + 1e-12, "{u} {v} {extra}");
                }
            }
            assert!((area - 1.0).abs() < 1e-12, "{u} {v} {extra}: {area}");
        }
    }
}
