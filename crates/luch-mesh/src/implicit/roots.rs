//! Where on the crossed edges a field is zero, to a hundred-millionth of the edge or better, and its normals there.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::Grid;
use super::crossing::{Crossing, fraction, unit_or};
use super::field::{Field, PointList};

/// Edges that are worked on together.
const BATCH: usize = 1024;
/// The width of the interval, as part of an edge, that is small enough: the last step, by false position, is far nearer.
const NARROW: f64 = 1e-8;
/// A continuous field takes about six steps; one that jumps is halved until [`NARROW`].
const MOST_STEPS: usize = 40;

/// Where the surface crosses an edge.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Root {
    /// The part of the edge before it.
    pub(super) fraction: f64,
    /// The place.
    pub(super) position: DVec3,
    /// The unit normal.
    pub(super) normal: Vec3,
}

/// The roots of all crossed edges. Where the grid was closed they lie at its outermost samples.
pub(super) fn roots(field: &dyn Field, grid: &Grid, crossings: &[Crossing]) -> Vec<Root> {
    let batches = crossings.par_chunks(BATCH);
    batches.flat_map_iter(|crossings| batch(field, grid, crossings)).collect()
}

/// An interval that holds a root.
struct Bracket {
    /// Fractions of the edge.
    ends: [f64; 2],
    /// Values there; one is below zero, the other is not.
    values: [f64; 2],
    /// Which end moved last.
    moved: Option<usize>,
    next: f64,
}

impl Bracket {
    /// The Illinois variant of false position (Dowell and Jarratt, 1971), every third step halving for fields that jump or bend
    /// sharply.
    fn step(&mut self, steps: usize) {
        let [low, high] = self.ends;
        let part = if steps % 3 == 2 { 0.5 } else { fraction(self.values[0], self.values[1]) };
        self.next = low + (high - low) * part;
    }

    fn take(&mut self, value: f64) {
        let side = usize::from((value < 0.0) == (self.values[1] < 0.0));
        self.ends[side] = self.next;
        self.values[side] = value;
        if self.moved == Some(side) {
            self.values[1 - side] *= 0.5;
        }
        self.moved = Some(side);
        if value == 0.0 {
            self.ends = [self.next; 2];
        }
    }

    fn is_narrow(&self) -> bool {
        self.ends[1] - self.ends[0] <= NARROW
    }
}

fn batch(field: &dyn Field, grid: &Grid, crossings: &[Crossing]) -> Vec<Root> {
    let mut brackets: Vec<Bracket> = crossings
        .iter()
        .map(|crossing| {
            let values = [crossing.start, crossing.end()].map(|s| f64::from(grid.at(s.map(|n| n as usize))));
            // The layer round a closed grid is infinite; nothing is to be found there.
            let ends = match values.map(f64::is_infinite) {
                [true, false] => [1.0; 2],
                [false, true] => [0.0; 2],
                _ => [0.0, 1.0],
            };
            Bracket { ends, values, moved: None, next: ends[0] }
        })
        .collect();
    let at_border: Vec<bool> = brackets.iter().map(Bracket::is_narrow).collect();
    let mut values = vec![0.0; crossings.len()];
    let mut open: Vec<usize> = (0..crossings.len()).filter(|&n| !at_border[n]).collect();
    let mut points = PointList::default();
    for steps in 0..MOST_STEPS {
        if open.is_empty() {
            break;
        }
        points.clear();
        for &n in &open {
            brackets[n].step(steps);
            points.push(crossings[n].point(grid, brackets[n].next));
        }
        field.values(points.points(), &mut values[..open.len()]);
        for (&n, &value) in open.iter().zip(&values) {
            brackets[n].take(value);
        }
        open.retain(|&n| !brackets[n].is_narrow());
    }
    let fractions: Vec<f64> = brackets
        .iter()
        .map(|bracket| {
            let [low, high] = bracket.ends;
            low + (high - low) * fraction(bracket.values[0], bracket.values[1])
        })
        .collect();
    let positions: Vec<DVec3> =
        crossings.iter().zip(&fractions).map(|(crossing, &part)| crossing.point(grid, part)).collect();
    let mut gradients = vec![DVec3::ZERO; positions.len()];
    let points: PointList = positions.iter().copied().collect();
    field.gradients(points.points(), &mut gradients);
    (0..crossings.len())
        .map(|n| {
            let outward = crossings[n].outward();
            let gradient = gradients[n].try_normalize().map_or(Vec3::ZERO, DVec3::as_vec3);
            let normal = if at_border[n] { outward } else { unit_or(gradient, outward) };
            Root { fraction: fractions[n], position: positions[n], normal }
        })
        .collect()
}
