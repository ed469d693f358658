//! Points of a bundle side by side, and the densities between all of them.

use super::Table;
use super::scatterers::{Scattered, Scatterers};
use crate::surface::Exit;
use glam::Vec3;
use luch_bvh::simd::Task;

/// Points side by side.
pub(super) const LANES: usize = 16;

/// Least cosine at which a shading normal is not tilted toward the viewer.
const LEAST_COSINE: f32 = 1e-3;

/// Who finds a point with less than this part of the largest density has no share in it: the ray would not be worth it.
pub(super) const LEAST_PART: f32 = 1.0 / 32.0;

/// A number for each lane.
pub(super) type Lanes = [f32; LANES];
/// A vector or colour for each lane, `[axis][lane]`.
pub(super) type Vectors = [Lanes; 3];

pub(super) const NONE: Vectors = [[0.0; LANES]; 3];

/// Points of surfaces, `[axis][lane]`; what stands in places that are not set means nothing.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(super) struct Points {
    pub(super) position: Vectors,
    pub(super) geometric_normal: Vectors,
    pub(super) normal: Vectors,
    near: Vectors,
    /// 1 where smooth shading lifts the point.
    pub(super) lifted: Lanes,
    /// How often the path scattered before.
    pub(super) depth: [u32; LANES],
    set: u32,
}

impl Default for Points {
    fn default() -> Self {
        Self {
            position: NONE,
            geometric_normal: NONE,
            normal: NONE,
            near: NONE,
            lifted: [0.0; LANES],
            depth: [0; LANES],
            set: 0,
        }
    }
}

impl Points {
    pub(super) fn clear(&mut self) {
        self.set = 0;
    }

    pub(super) fn set(&mut self, lane: usize, exit: &Exit, depth: u32) {
        for axis in 0..3 {
            self.position[axis][lane] = exit.position[axis];
            self.geometric_normal[axis][lane] = exit.geometric_normal[axis];
            self.normal[axis][lane] = exit.normal[axis];
            self.near[axis][lane] = exit.near[axis];
        }
        self.lifted[lane] = f32::from(u8::from(exit.lifted));
        self.depth[lane] = depth;
        self.set |= 1 << lane;
    }

    pub(super) fn is_set(&self, lane: usize) -> bool {
        self.set >> lane & 1 == 1
    }

    /// Whether a lane is set and its path had scattered so often.
    #[inline(always)]
    pub(super) fn is_at(&self, lane: usize, depth: u32) -> bool {
        self.is_set(lane) & (self.depth[lane] == depth)
    }

    pub(super) fn position(&self, lane: usize) -> Vec3 {
        at(&self.position, lane)
    }

    /// Normal of the shading frame, on the side of the viewer.
    pub(super) fn normal(&self, lane: usize) -> Vec3 {
        at(&self.normal, lane)
    }

    /// Where rays on the viewer's side start and end.
    pub(super) fn near(&self, lane: usize) -> Vec3 {
        at(&self.near, lane)
    }
}

/// The vector of one lane.
#[inline(always)]
pub(super) fn at(vectors: &Vectors, lane: usize) -> Vec3 {
    Vec3::new(vectors[0][lane], vectors[1][lane], vectors[2][lane])
}

/// Unit vectors from the points to one place.
#[inline(always)]
pub(super) fn directions_to(points: &Points, place: Vec3) -> (Vectors, Lanes) {
    let (mut toward, mut squared) = (NONE, [0.0; LANES]);
    for k in 0..LANES {
        let way = place - at(&points.position, k);
        squared[k] = way.dot(way);
        let direction = way * (1.0 / squared[k].sqrt());
        for axis in 0..3 {
            toward[axis][k] = direction[axis];
        }
    }
    (toward, squared)
}

/// Fills in, for each second point (row) and each first point (column), the density per area at the second with which the
/// first finds it if it sees it.
pub(super) struct Densities<'a> {
    pub(super) firsts: &'a Scatterers,
    pub(super) seconds: &'a Points,
    pub(super) table: &'a mut Table,
}

impl Task for Densities<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { firsts, seconds, table } = self;
        let mut scattered = Scattered::default();
        for (j, row) in table.iter_mut().enumerate() {
            *row = [0.0; LANES];
            if !seconds.is_set(j) {
                continue;
            }
            let (geometric, shading) = (at(&seconds.geometric_normal, j), at(&seconds.normal, j));
            let (toward, squared) = directions_to(&firsts.points, at(&seconds.position, j));
            let arriving: Lanes = std::array::from_fn(|k| -at(&toward, k).dot(geometric));
            // Only paths of one length so far: how much longer they may get is then the same for all.
            let member = |k: usize| firsts.connects(k, seconds.depth[j].wrapping_sub(1));
            firsts.densities(&toward, |k| arriving[k] > 0.0 && member(k), &mut scattered);
            let mut most = 0.0_f32;
            for k in 0..LANES {
                let shaded = -at(&toward, k).dot(shading);
                // Who looks at a flatter angle would see another shading frame.
                let alike = (shaded >= LEAST_COSINE) | (shaded >= arriving[k]);
                // Not a number where both points are one.
                let density = scattered.pdf[k] * arriving[k] / squared[k];
                let seen = (density < f32::INFINITY) & (arriving[k] > 0.0) & alike;
                row[k] = if seen & member(k) { density } else { 0.0 };
                most = if row[k] > most { row[k] } else { most };
            }
            let least = most * LEAST_PART;
            if row[j] > least {
                row.iter_mut().for_each(|density| *density = if *density < least { 0.0 } else { *density });
            } else {
                // Whoever found the point by a chance that is none for the others, or by rounding, keeps it.
                *row = std::array::from_fn(|k| if k == j { 1.0 } else { 0.0 });
            }
        }
    }
}
