//! Borders moved inward.

use glam::DVec2;

use super::crossing::crossing;
use super::nesting::winding;
use super::{Outline, OutlineError, signed_area};

/// The outline with all borders moved into the body by `distance`, corner by corner: each edge keeps its direction. An
/// error if they would meet.
pub(super) fn inset(outline: &Outline, distance: f64) -> Result<Outline, OutlineError> {
    let smaller = Outline {
        outer: moved(&outline.outer, distance),
        holes: outline.holes.iter().map(|hole| moved(hole, distance)).collect(),
    };
    let keeps_sense = outline
        .loops()
        .zip(smaller.loops())
        .all(|(before, after)| signed_area(before) * signed_area(after) > 0.0 && keeps_edges(before, after));
    let too_much =
        OutlineError::OutOfRange { name: "the bevel", found: distance, expected: "less: borders would meet" };
    // Borders may have passed one another without crossing at the end.
    let holes = &smaller.holes;
    let keeps_place = holes.iter().enumerate().all(|(number, hole)| {
        let is_outside = |other: &Vec<DVec2>| winding(other, hole[0]) == 0;
        let others = holes.iter().enumerate().filter(|(other, _)| *other != number);
        winding(&smaller.outer, hole[0]) == 1 && others.map(|(_, other)| other).all(is_outside)
    });
    let fits = keeps_sense && keeps_place && crossing(smaller.loops()).is_none();
    if fits { Ok(smaller) } else { Err(too_much) }
}

/// Whether every edge still runs its way: one that turned round has been used up.
fn keeps_edges(before: &[DVec2], after: &[DVec2]) -> bool {
    super::edges(before).zip(super::edges(after)).all(|([a, b], [c, d])| (b - a).dot(d - c) > 0.0)
}

/// Every point to where its two edges meet when they are moved to their left.
fn moved(points: &[DVec2], distance: f64) -> Vec<DVec2> {
    let count = points.len();
    let left = |from: DVec2, to: DVec2| (to - from).perp().normalize_or_zero();
    (0..count)
        .map(|k| {
            let [before, at, after] = [k + count - 1, k, k + 1].map(|k| points[k % count]);
            let [one, other] = [left(before, at), left(at, after)];
            // The sum points along the middle; its length tells how far the corner must go.
            let sum = one + other;
            let shift = if sum.length_squared() > 1e-6 { sum * (2.0 / sum.length_squared()) } else { one };
            at + shift * distance
        })
        .collect()
}
