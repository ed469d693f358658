//! Where the surface crosses the edges of a grid.

use glam::{DVec3, Vec3};
use luch_bvh::simd::{Task, dispatch};
use rayon::prelude::*;

use super::Grid;
use super::signs::{EdgeNumbers, Signs};

/// Vertices nearer to a sample than this part of an edge would share a place with those of the sample's other edges.
const NEAR: f64 = 1.0 / 4096.0;

/// A crossed edge.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Crossing {
    /// The sample where the edge starts.
    pub(super) start: [u32; 3],
    /// The axis it runs along.
    pub(super) axis: u8,
    /// Whether its start lies inside.
    pub(super) starts_inside: bool,
}

/// Calls `visit(place in the slice, crossing)` for every crossed edge that starts in slice `z`.
#[inline(always)]
pub(super) fn for_each_in_slice(
    grid: &Grid,
    signs: &Signs,
    numbers: &EdgeNumbers,
    z: usize,
    mut visit: impl FnMut(usize, Crossing),
) {
    let first = numbers.row(0, z)[0];
    for y in 0..grid.counts()[1] {
        let mut next = numbers.row(y, z);
        for (word, &inside) in signs.row(y, z).iter().enumerate() {
            for (axis, mut crossed) in signs.crossed(y, z, word).into_iter().enumerate() {
                while crossed != 0 {
                    let bit = crossed.trailing_zeros();
                    crossed &= crossed - 1;
                    let start = [word as u32 * 64 + bit, y as u32, z as u32];
                    let starts_inside = inside >> bit & 1 == 1;
                    visit((next[axis] - first) as usize, Crossing { start, axis: axis as u8, starts_inside });
                    next[axis] += 1;
                }
            }
        }
    }
}

/// All crossed edges in the order of their numbers.
pub(super) fn crossings(grid: &Grid, signs: &Signs, numbers: &EdgeNumbers) -> Vec<Crossing> {
    let mut list = vec![Crossing::default(); numbers.total];
    numbers.split(&mut list).into_par_iter().enumerate().for_each(|(z, part)| {
        for_each_in_slice(grid, signs, numbers, z, |place, crossing| part[place] = crossing);
    });
    list
}

/// The part of an edge, from 0 to 1, at which values that run straight from `start` to `end` are zero. One of them is below zero.
#[inline(always)]
pub(super) fn fraction(start: f64, end: f64) -> f64 {
    let part = start / (start - end);
    if part.is_finite() {
        return part.clamp(0.0, 1.0);
    }
    // An infinite end is far away; what is not a number tells nothing.
    match (start.is_infinite(), end.is_infinite()) {
        (true, false) if !end.is_nan() => 1.0,
        (false, true) if !start.is_nan() => 0.0,
        _ => 0.5,
    }
}

impl Crossing {
    /// The sample where the edge ends.
    #[inline(always)]
    pub(super) fn end(&self) -> [u32; 3] {
        let mut end = self.start;
        end[self.axis as usize] += 1;
        end
    }

    /// Moves a vertex off a sample at which several edges are crossed, so that no two vertices share a place.
    #[inline(always)]
    pub(super) fn apart(&self, signs: &Signs, fraction: f64) -> f64 {
        if fraction < NEAR && signs.crossed_edges_at(self.start.map(|n| n as usize)) > 1 {
            NEAR
        } else if fraction > 1.0 - NEAR && signs.crossed_edges_at(self.end().map(|n| n as usize)) > 1 {
            1.0 - NEAR
        } else {
            fraction
        }
    }

    /// A point of the edge.
    #[inline(always)]
    pub(super) fn point(&self, grid: &Grid, fraction: f64) -> DVec3 {
        let mut along = self.start.map(f64::from);
        along[self.axis as usize] += fraction;
        grid.origin + grid.spacing * DVec3::from(along)
    }

    /// From inside to outside.
    #[inline(always)]
    pub(super) fn outward(&self) -> Vec3 {
        let mut outward = Vec3::ZERO;
        outward[self.axis as usize] = if self.starts_inside { 1.0 } else { -1.0 };
        outward
    }
}

/// A vertex on every crossed edge, in the order of their numbers, where straight interpolation of the samples is at the level;
/// with the unit normal along the gradient, which is interpolated between central differences at the samples.
pub(super) fn interpolated(grid: &Grid, level: f32, signs: &Signs, numbers: &EdgeNumbers) -> Vertices {
    let mut positions = vec![Vec3::ZERO; numbers.total];
    let mut normals = vec![Vec3::ZERO; numbers.total];
    let parts = numbers.split(&mut positions).into_par_iter().zip(numbers.split(&mut normals));
    parts.enumerate().for_each(|(z, (positions, normals))| {
        dispatch(Interpolate { grid, level, signs, numbers, z, positions, normals });
    });
    Vertices { positions, normals }
}

/// Positions and unit normals.
pub(super) struct Vertices {
    pub(super) positions: Vec<Vec3>,
    pub(super) normals: Vec<Vec3>,
}

/// The vertices of one slice.
struct Interpolate<'a> {
    grid: &'a Grid,
    level: f32,
    signs: &'a Signs,
    numbers: &'a EdgeNumbers,
    z: usize,
    positions: &'a mut [Vec3],
    normals: &'a mut [Vec3],
}

impl Task for Interpolate<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { grid, level, signs, numbers, z, positions, normals } = self;
        let counts = grid.counts();
        let steps = [1, counts[0], counts[0] * counts[1]];
        let values = grid.samples();
        let inverse = (1.0 / grid.spacing).as_vec3();
        // Differences over two cells, or one at the border, times this.
        let scale = [inverse * 0.5, inverse];
        let slope = |place: usize, sample: [u32; 3]| -> Vec3 {
            let mut slope = Vec3::ZERO;
            for axis in 0..3 {
                let (low, high) = (sample[axis] > 0, (sample[axis] as usize) + 1 < counts[axis]);
                let difference = values[place + if high { steps[axis] } else { 0 }]
                    - values[place - if low { steps[axis] } else { 0 }];
                slope[axis] = difference * scale[usize::from(!(low && high))][axis];
            }
            slope
        };
        let inner_slope = |place: usize| {
            let [x, y, z] = steps.map(|step| values[place + step] - values[place - step]);
            Vec3::new(x, y, z) * scale[0]
        };
        for_each_in_slice(grid, signs, numbers, z, |n, crossing| {
            let place = grid.place(crossing.start.map(|n| n as usize));
            let end = place + steps[crossing.axis as usize];
            let above = |place: usize| f64::from(values[place]) - f64::from(level);
            let part = crossing.apart(signs, fraction(above(place), above(end)));
            positions[n] = crossing.point(grid, part).as_vec3();
            // Away from the border the same without asking at every step.
            let is_inner = (0..3).all(|axis| {
                let at = crossing.start[axis] as usize;
                at > 0 && at + 2 < counts[axis]
            });
            let (one, other) = if is_inner {
                (inner_slope(place), inner_slope(end))
            } else {
                (slope(place, crossing.start), slope(end, crossing.end()))
            };
            let gradient = one + (other - one) * part as f32;
            normals[n] = unit_or(gradient, crossing.outward());
        });
    }
}

/// The direction of a gradient, or another where it has none.
#[inline(always)]
pub(super) fn unit_or(gradient: Vec3, otherwise: Vec3) -> Vec3 {
    let square = gradient.length_squared();
    if square > 1e-30 && square < 1e30 {
        return gradient / square.sqrt();
    }
    // Far too small or large for single precision, or none at all.
    gradient.as_dvec3().try_normalize().map_or(otherwise, DVec3::as_vec3)
}
