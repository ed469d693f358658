//! Spatial splits: where boxes overlap much, a plane may cut primitives in two.
//!
//! Stich, Friedrich, Dietrich, "Spatial Splits in Bounding Volume Hierarchies" (2009).

use super::Clip;
use super::binary::Piece;
use super::binned::{self, Buffers, Found};
use super::bins::{Cut, Grid};
use super::bounds::Bounds;
use super::item::Item;
use super::lanes::{Lanes, run};
use super::plan::{Extent, Plan};
use crate::Triangle;
use crate::simd::Task;

/// Planes tried along each axis, plus one.
const SLICES: usize = 16;
/// Spatial splits are tried where the children of the best other split overlap in this part of the whole tree's area.
const OVERLAP: f32 = 1e-5;
/// … and in this part of the node's own.
const SHARE: f32 = 0.2;
/// Nodes of fewer items are not split spatially.
const FEW: usize = 16;
/// One in so many primitives may be in the tree twice.
const BUDGET: usize = 5;

/// Grows the tree over the items, of which there is at least one.
pub(super) fn grow(items: Vec<Item>, clip: &dyn Clip, plan: Plan) -> Piece {
    let budget = items.len() / BUDGET;
    let whole = items.iter().fold(Bounds::EMPTY, |all, item| all.union(&item.bounds()));
    let overlap = plan.scale.half_area(&whole) * OVERLAP;
    Grower { clip, plan, overlap }.grow(items, budget, 0)
}

struct Grower<'a> {
    clip: &'a dyn Clip,
    plan: Plan,
    /// The least area of overlap.
    overlap: f32,
}

/// A plane across an axis.
#[derive(Clone, Copy)]
struct Plane {
    cost: f32,
    axis: usize,
    at: f32,
}

/// The items of two children.
#[derive(Default)]
struct Sides {
    left: Vec<Item>,
    right: Vec<Item>,
}

/// Parts items without cutting any.
struct Sort<'a> {
    items: &'a [Item],
    cut: Cut,
}

impl Task for Sort<'_> {
    type Output = Sides;
    #[inline(always)]
    fn run(self) -> Sides {
        let (left, right) = self.items.iter().partition(|item| self.cut.side(self.cut.middle(item)) == 0);
        Sides { left, right }
    }
}

impl Grower<'_> {
    fn grow(&self, mut items: Vec<Item>, budget: usize, depth: u32) -> Piece {
        let extent = Extent::of(&items, self.plan.scale);
        let Some(Sides { left, right }) = self.split(&items, &extent, budget, depth) else {
            let mut spare = items.clone();
            return binned::grow(Buffers { items: &mut items, spare: &mut spare }, extent, depth, self.plan);
        };
        let budget = (budget + items.len()).saturating_sub(left.len() + right.len());
        let share = (budget as u128 * left.len() as u128 / (left.len() + right.len()) as u128) as usize;
        drop(items);
        let grow = |items, budget| self.grow(items, budget, depth + 1);
        let (left, right) = rayon::join(|| grow(left, share), || grow(right, budget - share));
        Piece::Pair(extent.bounds, Box::new([left, right]))
    }

    /// The better of the best split of either kind; `None` where nothing is to be gained by spatial ones.
    fn split(&self, items: &[Item], extent: &Extent, budget: usize, depth: u32) -> Option<Sides> {
        let levels = usize::BITS - (2 * items.len()).leading_zeros();
        if items.len() < FEW || budget == 0 || depth + levels >= binned::MAX_DEPTH {
            return None;
        }
        let grid = Grid::new(&extent.middles, items.len(), self.plan)?;
        let Found { best, sides: [left, right] } = binned::best_split(items, &grid, self.plan)?;
        let common = left.intersection(&right);
        if !common.is_empty()
            && self.plan.scale.half_area(&common)
                >= self.overlap.max(SHARE * self.plan.scale.half_area(&extent.bounds))
            && let Some(plane) = self.best_plane(items, &extent.bounds)
            && plane.cost < best.cost
            && let Some(sides) = self.cut(items, plane, budget)
        {
            return Some(sides);
        }
        Some(run(Sort { items, cut: Cut::new(grid, &best) }))
    }

    fn best_plane(&self, items: &[Item], bounds: &Bounds) -> Option<Plane> {
        let mut best: Option<Plane> = None;
        for axis in 0..3 {
            let (low, size) = (bounds.low(axis), bounds.high(axis) - bounds.low(axis));
            if !(size > 0.0 && size.is_finite()) {
                continue;
            }
            let cuts = Cuts { axis, low, step: size / SLICES as f32, factor: SLICES as f32 / size };
            let mut slices = [Bounds::EMPTY; SLICES];
            let mut entries = [0_u32; SLICES];
            let mut exits = [0_u32; SLICES];
            for item in items {
                let (from, to) = item.along(axis);
                let (mut first, mut last) = (cuts.slice(from), cuts.slice(to));
                if first < last {
                    if let Some(triangle) = self.clip.triangle(item.primitive()) {
                        cuts.add(&mut slices[first..=last], first, &triangle, &item.bounds());
                    } else {
                        first = cuts.slice(from * 0.5 + to * 0.5);
                        last = first;
                    }
                }
                if first == last {
                    slices[first] = slices[first].union(&item.bounds());
                }
                entries[first] += 1;
                exits[last] += 1;
            }
            let mut behind = [0.0; SLICES];
            let mut right = Bounds::EMPTY;
            let mut count = 0;
            for at in (1..SLICES).rev() {
                right = right.union(&slices[at]);
                count += exits[at];
                behind[at] = if count > 0 {
                    self.plan.scale.half_area(&right) * self.plan.blocks(count)
                } else {
                    f32::INFINITY
                };
            }
            let mut left = Bounds::EMPTY;
            let mut count = 0;
            for at in 1..SLICES {
                left = left.union(&slices[at - 1]);
                count += entries[at - 1];
                let cost = self.plan.scale.half_area(&left) * self.plan.blocks(count) + behind[at];
                if count > 0 && cost < best.map_or(f32::INFINITY, |best| best.cost) {
                    best = Some(Plane { cost, axis, at: cuts.plane(at) });
                }
            }
        }
        best
    }

    /// Cuts at the plane; `None` if that leaves a side empty, parts nothing or needs more parts than there may be.
    fn cut(&self, items: &[Item], plane: Plane, budget: usize) -> Option<Sides> {
        let Plane { axis, at, .. } = plane;
        let mut sides = Sides::default();
        for item in items {
            let (low, high) = item.along(axis);
            if high <= at {
                sides.left.push(*item);
            } else if low >= at {
                sides.right.push(*item);
            } else {
                match self.clip.triangle(item.primitive()) {
                    Some(triangle) => {
                        let part = |low, high| {
                            Bounds::of(&triangle.between(axis, low, high)).intersection(&item.bounds())
                        };
                        let (left, right) = (part(f32::NEG_INFINITY, at), part(at, f32::INFINITY));
                        if !left.is_empty() {
                            sides.left.push(Item::of(&left, item.primitive()));
                        }
                        if !right.is_empty() {
                            sides.right.push(Item::of(&right, item.primitive()));
                        }
                    }
                    None if low * 0.5 + high * 0.5 < at => sides.left.push(*item),
                    None => sides.right.push(*item),
                }
            }
        }
        let total = sides.left.len() + sides.right.len();
        let parts = !sides.left.is_empty()
            && !sides.right.is_empty()
            && sides.left.len().max(sides.right.len()) < items.len();
        (parts && total <= items.len() + budget).then_some(sides)
    }
}

/// Planes at equal distances across an axis, and the slices between them.
#[derive(Clone, Copy)]
struct Cuts {
    axis: usize,
    low: f32,
    step: f32,
    factor: f32,
}

impl Cuts {
    fn plane(self, at: usize) -> f32 {
        self.low + self.step * at as f32
    }

    fn slice(self, value: f32) -> usize {
        (((value - self.low) * self.factor) as usize).min(SLICES - 1)
    }

    /// Grows the slices, of which the first has the number `first`, by what of a triangle lies in each and within `bounds`.
    /// An estimate: it only serves to choose a plane.
    fn add(self, slices: &mut [Bounds], first: usize, triangle: &Triangle, bounds: &Bounds) {
        let last = first + slices.len() - 1;
        let mut grow = |slice: usize, point: [f32; 4]| {
            if (first..=last).contains(&slice) {
                slices[slice - first]
                    .grow(Lanes(bounds.lows()).larger(Lanes(bounds.highs()).smaller(Lanes(point))).0);
            }
        };
        let corners = [triangle.a, triangle.b, triangle.c].map(|corner| [corner.x, corner.y, corner.z, 0.0]);
        for (index, from) in corners.into_iter().enumerate() {
            let to = corners[(index + 1) % 3];
            let (from, to) = if from[self.axis] <= to[self.axis] { (from, to) } else { (to, from) };
            let (begin, end) = (self.slice(from[self.axis]), self.slice(to[self.axis]));
            grow(begin, from);
            grow(end, to);
            let inverse = 1.0 / (to[self.axis] - from[self.axis]);
            for at in begin.max(first) + 1..=end.min(last) {
                let part = (self.plane(at) - from[self.axis]) * inverse;
                let point = std::array::from_fn(|lane| from[lane] + (to[lane] - from[lane]) * part);
                grow(at - 1, point);
                grow(at, point);
            }
        }
    }
}
