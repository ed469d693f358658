//! Whether borders cross.

use glam::DVec2;

use super::edges;

/// A place where two edges cross within, if there is any. Borders that only touch do not cross.
///
/// Edges are sorted from left to right, and each is tried with those that begin before it ends: quadratic at worst,
/// which the limit on points keeps to seconds.
pub(super) fn crossing<'a>(loops: impl IntoIterator<Item = &'a Vec<DVec2>>) -> Option<DVec2> {
    let mut all: Vec<[DVec2; 2]> = loops.into_iter().flat_map(|points| edges(points)).collect();
    let low = |edge: &[DVec2; 2]| edge[0].x.min(edge[1].x);
    all.sort_by(|one, other| low(one).total_cmp(&low(other)));
    for (number, &one) in all.iter().enumerate() {
        let end = one[0].x.max(one[1].x);
        let following = all[number + 1..].iter().take_while(|other| low(other) < end);
        if let Some(place) = following.filter_map(|&other| meeting(one, other)).next() {
            return Some(place);
        }
    }
    None
}

/// Where two edges cross, strictly within both.
fn meeting(one: [DVec2; 2], other: [DVec2; 2]) -> Option<DVec2> {
    let apart = one[0].y.max(one[1].y) <= other[0].y.min(other[1].y)
        || other[0].y.max(other[1].y) <= one[0].y.min(one[1].y);
    if apart {
        return None;
    }
    let side = |[from, to]: [DVec2; 2], point: DVec2| {
        let (along, aside) = (to - from, point - from);
        let turn = along.perp_dot(aside);
        // Rounding of the products: on the line is on neither side.
        let noise = 4.0 * f64::EPSILON * ((along.x * aside.y).abs() + (along.y * aside.x).abs());
        if turn.abs() <= noise { 0.0 } else { turn }
    };
    let [a, b] = other.map(|point| side(one, point));
    let [c, d] = one.map(|point| side(other, point));
    (a * b < 0.0 && c * d < 0.0).then(|| one[0].lerp(one[1], c / (c - d)))
}
