//! From any borders to outlines with holes.

use glam::DVec2;

use super::crossing::crossing;
use super::{MAX_POINTS, Outline, OutlineError, edges, is_usable, signed_area};

/// Which side of borders is inside.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FillRule {
    /// Where the borders go around a point in sum (fonts, and SVG by default).
    NonZero,
    /// Where an odd number of borders is around a point; their direction does not matter.
    #[default]
    EvenOdd,
}

impl FillRule {
    fn fills(self, winding: i32) -> bool {
        match self {
            Self::NonZero => winding != 0,
            Self::EvenOdd => winding % 2 != 0,
        }
    }
}

/// Outlines made of closed borders: which are outer borders and which are holes follows from the rule. Islands within
/// holes are outlines of their own. Borders may touch but not cross; those without area are left out.
///
/// Points are rounded to single precision, as they will be in a mesh; repeated points are left out.
pub fn nested(borders: &[Vec<DVec2>], rule: FillRule) -> Result<Vec<Outline>, OutlineError> {
    let loops = cleaned(borders)?;
    if let Some(place) = crossing(loops.iter().map(|border| &border.points)) {
        return Err(OutlineError::Crossing { place });
    }
    // What the other borders say about the inner side of each.
    let windings: Vec<i32> = (0..loops.len())
        .map(|number| {
            let others = loops.iter().enumerate().filter(|(other, _)| *other != number);
            others.map(|(_, other)| other.winding(loops[number].inner)).sum()
        })
        .collect();
    let sides = |number: usize| {
        let own = if loops[number].area > 0.0 { 1 } else { -1 };
        [rule.fills(windings[number]), rule.fills(windings[number] + own)]
    };
    let mut outlines = Vec::new();
    let mut owners = Vec::new();
    for (number, border) in loops.iter().enumerate() {
        if sides(number) == [false, true] {
            outlines.push(Outline { outer: border.directed(true), holes: Vec::new() });
            owners.push(number);
        }
    }
    for (number, border) in loops.iter().enumerate() {
        if sides(number) != [true, false] {
            continue;
        }
        // The smallest outer border around it.
        let around = (0..owners.len()).filter(|&k| loops[owners[k]].winding(border.inner) != 0);
        let area = |k: &usize| loops[owners[*k]].area.abs();
        if let Some(owner) = around.min_by(|one, other| area(one).total_cmp(&area(other))) {
            outlines[owner].holes.push(border.directed(false));
        }
    }
    if outlines.is_empty() { Err(OutlineError::Empty) } else { Ok(outlines) }
}

/// The same where borders of one direction may cross one another: each border that runs as the largest does is an
/// outline of its own, with the holes that lie in it. The outlines may overlap. Glyphs of some fonts are drawn so.
pub(super) fn overlapping(borders: &[Vec<DVec2>]) -> Result<Vec<Outline>, OutlineError> {
    let loops = cleaned(borders)?;
    for border in &loops {
        if let Some(place) = crossing([&border.points]) {
            return Err(OutlineError::Crossing { place });
        }
    }
    let largest = loops
        .iter()
        .map(|border| border.area)
        .fold(0.0, |best: f64, area| if area.abs() > best.abs() { area } else { best });
    let (solid, holes): (Vec<&Border>, Vec<&Border>) =
        loops.iter().partition(|border| border.area * largest > 0.0);
    let mut outlines: Vec<Outline> =
        solid.iter().map(|border| Outline { outer: border.directed(true), holes: Vec::new() }).collect();
    for hole in holes {
        let fits = |k: &usize| {
            solid[*k].winding(hole.inner) != 0 && crossing([&solid[*k].points, &hole.points]).is_none()
        };
        let around = (0..solid.len()).filter(fits);
        let area = |k: &usize| solid[*k].area.abs();
        match around.min_by(|one, other| area(one).total_cmp(&area(other))) {
            Some(owner) => outlines[owner].holes.push(hole.directed(false)),
            None => return Err(OutlineError::Crossing { place: hole.inner }),
        }
    }
    if outlines.is_empty() { Err(OutlineError::Empty) } else { Ok(outlines) }
}

/// A border with what is asked of it often.
struct Border {
    points: Vec<DVec2>,
    /// Positive if counter-clockwise.
    area: f64,
    /// A point close to the border on its inner side.
    inner: DVec2,
    low: DVec2,
    high: DVec2,
}

impl Border {
    /// See [`winding`]; most points are far away.
    fn winding(&self, point: DVec2) -> i32 {
        if point.cmplt(self.low).any() || point.cmpgt(self.high).any() {
            return 0;
        }
        winding(&self.points, point)
    }

    fn directed(&self, counter_clockwise: bool) -> Vec<DVec2> {
        let mut points = self.points.clone();
        if (self.area > 0.0) != counter_clockwise {
            points.reverse();
        }
        points
    }
}

/// How often a border goes around a point, counter-clockwise counted positive.
pub(super) fn winding(border: &[DVec2], point: DVec2) -> i32 {
    let mut winding = 0;
    for [a, b] in edges(border) {
        let turn = (b - a).perp_dot(point - a);
        if a.y <= point.y && b.y > point.y && turn > 0.0 {
            winding += 1;
        } else if a.y > point.y && b.y <= point.y && turn < 0.0 {
            winding -= 1;
        }
    }
    winding
}

/// Borders rounded and without repeated points, in their order; those without area are left out.
fn cleaned(borders: &[Vec<DVec2>]) -> Result<Vec<Border>, OutlineError> {
    let count = borders.iter().map(Vec::len).sum();
    if count > MAX_POINTS {
        return Err(OutlineError::TooManyPoints { count, most: MAX_POINTS });
    }
    let mut loops = Vec::new();
    for border in borders {
        if let Some(&point) = border.iter().find(|p| !is_usable(**p)) {
            return Err(OutlineError::NotFinite { point });
        }
        let mut points: Vec<DVec2> = border.iter().map(|p| p.as_vec2().as_dvec2()).collect();
        points.dedup();
        while points.len() > 1 && points[0] == points[points.len() - 1] {
            points.pop();
        }
        let area = signed_area(&points);
        if points.len() < 3 || area == 0.0 {
            continue;
        }
        let longest = edges(&points).max_by(|one, other| {
            one[0].distance_squared(one[1]).total_cmp(&other[0].distance_squared(other[1]))
        });
        let Some([a, b]) = longest else { continue };
        // A millionth of the edge to its left, or right if the border runs clockwise.
        let inner = (a + b) / 2.0 + (b - a).perp() * (1e-6 * area.signum());
        let low = points.iter().fold(points[0], |low, p| low.min(*p));
        let high = points.iter().fold(points[0], |high, p| high.max(*p));
        loops.push(Border { points, area, inner, low, high });
    }
    Ok(loops)
}
