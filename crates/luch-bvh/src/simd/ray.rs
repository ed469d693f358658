//! A ray made ready for boxes and triangles of any level.

use super::lanes::{Isa, Lanes};
use crate::slab::{LONGEST, MARGIN, larger, smaller};
use crate::wide::WideNode;
use crate::{Aabb, Interval, Ray};

/// All numbers that depend on the ray alone.
///
/// The axis the ray follows most becomes the z axis of triangle tests, the two after it x and y. Which number of a corner
/// that is, is a matter of its address.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(crate) struct Prepared {
    pub(super) origin: [f32; 3],
    /// The ray's own, at least zero.
    pub(super) t_min: f32,
    /// See [`SlabRay`](crate::SlabRay).
    pub(super) near_inverse: [f32; 3],
    /// The ray's own, finite.
    pub(super) t_max: f32,
    pub(super) far_inverse: [f32; 3],
    /// Where in a node the planes that face the ray stand, in bytes: rows 0 or 1, 2 or 3, 4 or 5 of 32 bytes.
    pub(super) facing: [u32; 3],
    /// Where in a corner of a block its x, y, z of triangle tests stand, in bytes: rows 0 to 2 of 16 bytes.
    pub(super) rows: [u32; 3],
    /// The origin in that order.
    pub(super) turned: [f32; 3],
    pub(super) shear: [f32; 3],
    /// Whether the ray runs toward greater coordinates along z.
    pub(super) ahead: bool,
}

impl Prepared {
    /// `None` under the conditions of [`SlabRay::new`](crate::SlabRay::new).
    #[inline(always)]
    pub(crate) fn new(ray: &Ray) -> Option<Self> {
        let direction = crate::slab::direction(ray);
        let origin = ray.origin.to_array();
        let [x, y, z] = direction.map(f32::abs);
        let t_min = if ray.t_min < 0.0 { 0.0 } else { ray.t_min };
        let t_max = if ray.t_max > f32::MAX { f32::MAX } else { ray.t_max };
        let axis = if x > y && x > z { 0 } else { 1 + usize::from(y <= z) };
        let turn = TURNS[axis];
        let along = direction[axis];
        let turned = |values: [f32; 3]| [values[turn[0]], values[turn[1]], values[turn[2]]];
        let [across_x, across_y, _] = turned(direction);
        // Two divisions of four lanes.
        let inverse = [1.0 / direction[0], 1.0 / direction[1], 1.0 / direction[2]];
        let shear = [across_x / along, across_y / along, 1.0 / along];
        // Whatever is not finite leaves a difference that is not zero.
        let finite = [origin, direction].iter().flatten().fold(0.0, |sum, value| sum + value * 0.0);
        let length = shear[2].abs();
        let sound = finite == 0.0 && (1.0 / LONGEST..=f32::MAX).contains(&length) && t_min <= t_max;
        if !sound {
            return None;
        }
        Some(Self {
            origin,
            t_min: t_min + 0.0,
            near_inverse: inverse.map(|inverse| inverse * (1.0 - MARGIN)),
            t_max,
            far_inverse: inverse.map(|inverse| inverse * (1.0 + MARGIN)),
            facing: [0, 1, 2].map(|axis| 64 * axis + (direction[axis as usize].to_bits() >> 31 << 5)),
            rows: turn.map(|row| 16 * row as u32),
            turned: turned(origin),
            shear,
            ahead: along > 0.0,
        })
    }

    /// A ray whose numbers are known: its piece that counts, the reciprocals of its direction for planes near and far, by axis
    /// whether it runs toward lesser coordinates, and what triangle tests along the axis `along` need.
    #[inline(always)]
    pub(super) fn from_parts(
        origin: [f32; 3],
        whole: Interval,
        [near_inverse, far_inverse]: [[f32; 3]; 2],
        backward: [bool; 3],
        along: usize,
        shear: [f32; 3],
        ahead: bool,
    ) -> Self {
        let turn = TURNS[along];
        Self {
            origin,
            t_min: whole.near,
            near_inverse,
            t_max: whole.far,
            far_inverse,
            facing: [0, 1, 2].map(|axis| 64 * axis + (u32::from(backward[axis as usize]) << 5)),
            rows: turn.map(|row| 16 * row as u32),
            turned: turn.map(|axis| origin[axis]),
            shear,
            ahead,
        }
    }

    /// The piece of the ray inside a box, as [`SlabRay::interval`](crate::SlabRay::interval).
    #[inline(always)]
    pub(crate) fn interval(&self, bounds: &Aabb) -> Option<Interval> {
        let mut near = self.t_min;
        let mut far = self.t_max;
        for axis in 0..3 {
            let (low, high) = (bounds.min[axis], bounds.max[axis]);
            let (first, last) = if self.is_backward(axis) { (high, low) } else { (low, high) };
            near = larger(near, (first - self.origin[axis]) * self.near_inverse[axis]);
            far = smaller(far, (last - self.origin[axis]) * self.far_inverse[axis]);
        }
        (near <= far).then_some(Interval { near, far })
    }

    /// Whether the ray runs toward lesser coordinates.
    #[inline(always)]
    pub(super) fn is_backward(&self, axis: usize) -> bool {
        self.facing[axis] & 32 != 0
    }

    /// The whole piece of the ray that counts.
    pub(crate) fn whole(&self) -> Interval {
        Interval { near: self.t_min, far: self.t_max }
    }

    /// The numbers of a box test, each in all lanes.
    #[inline(always)]
    pub(super) fn spread<I: Isa>(&self) -> Spread<I> {
        Spread {
            origin: self.origin.map(I::Eight::splat),
            near_inverse: self.near_inverse.map(I::Eight::splat),
            far_inverse: self.far_inverse.map(I::Eight::splat),
            t_min: I::Eight::splat(self.t_min),
            facing: self.facing,
        }
    }
}

/// Which axis comes first, second and last, by the axis that comes last.
const TURNS: [[usize; 3]; 3] = [[1, 2, 0], [2, 0, 1], [0, 1, 2]];

/// A ray in front of eight boxes.
#[derive(Clone, Copy)]
pub(super) struct Spread<I: Isa> {
    origin: [I::Eight; 3],
    near_inverse: [I::Eight; 3],
    far_inverse: [I::Eight; 3],
    t_min: I::Eight,
    facing: [u32; 3],
}

/// Where a ray enters eight boxes, and which of them it meets at all.
pub(super) struct Entered<I: Isa> {
    pub(super) near: I::Eight,
    pub(super) met: <I::Eight as Lanes<8>>::Mask,
}

impl<I: Isa> Spread<I> {
    /// The intervals within all eight children, as far as they begin at or before `bound`.
    #[inline(always)]
    pub(super) fn enter(&self, node: &WideNode, bound: f32) -> Entered<I> {
        let mut near = self.t_min;
        let mut far = I::Eight::splat(bound);
        for axis in 0..3 {
            let planes: *const u8 = node.planes.as_ptr().cast();
            let row = self.facing[axis] as usize;
            // SAFETY: these are rows of the node; both rows of an axis stand in one pair.
            let (first, last) = unsafe { (&*planes.add(row).cast(), &*planes.add(row ^ 32).cast()) };
            let (first, last) = (I::Eight::load(first), I::Eight::load(last));
            near = near.larger((first - self.origin[axis]) * self.near_inverse[axis]);
            far = far.smaller((last - self.origin[axis]) * self.far_inverse[axis]);
        }
        Entered { near, met: near.at_most(far) }
    }
}
