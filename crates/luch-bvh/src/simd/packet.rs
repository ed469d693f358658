//! Sixteen rays side by side, in front of one box or one triangle.
//!
//! The formulas are those of [`Prepared`](super::Prepared) and [`Block`], operation by operation.

mod pieces;

pub(super) use pieces::Pieces;

use super::block::Block;
use super::lanes::{Isa, Lanes, Mask};
use crate::slab::{LONGEST, MARGIN};
use crate::triangle::{RESIDUAL, SAFE, exact_crossing};
use crate::wide::WideNode;
use crate::{Hit, Ray};
use std::array::from_fn;

/// One number of each ray.
pub(super) type Row = [f32; 16];

/// Rays side by side and their best hits.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
pub(super) struct Packet {
    pub(super) origin: [Row; 3],
    pub(super) direction: [Row; 3],
    pub(super) near_inverse: [Row; 3],
    far_inverse: [Row; 3],
    pub(super) t_min: Row,
    pub(super) t_max: Row,
    shear: [Row; 3],
    /// What lies farther cannot count; -∞ for a ray that needs nothing more.
    pub(super) bound: Row,
    u: Row,
    v: Row,
    /// The bits of their numbers; [`NO_HIT`] if there is none.
    primitive: Row,
    /// A bit for each ray that can meet anything.
    pub(super) sound: u32,
    /// By axis a bit for each ray that runs toward lesser coordinates.
    pub(super) backward: [u32; 3],
    /// By axis a bit for each ray that follows it most.
    along: [u32; 3],
    /// A bit for each ray that runs toward greater coordinates on the axis it follows most.
    ahead: u32,
}

/// Stands for the lack of a hit.
pub(super) const NO_HIT: u32 = u32::MAX;

impl Packet {
    /// Prepares up to sixteen rays, at least one.
    #[inline(always)]
    pub(super) fn new<I: Isa>(rays: &[Ray]) -> Self {
        let (mut origin, mut direction) = ([[0.0; 16]; 3], [[0.0; 16]; 3]);
        let (mut t_min, mut t_max) = ([0.0; 16], [0.0; 16]);
        for lane in 0..16 {
            // Lanes without a ray of their own repeat the first one and are never asked.
            let ray = &rays[if lane < rays.len() { lane } else { 0 }];
            for axis in 0..3 {
                origin[axis][lane] = ray.origin[axis];
                direction[axis][lane] = ray.direction[axis];
            }
            t_min[lane] = ray.t_min;
            t_max[lane] = ray.t_max;
        }
        let splat = I::Sixteen::splat;
        let load = I::Sixteen::load;
        let zero = splat(0.0);
        // As [`direction`](crate::slab::direction) has it.
        for row in &mut direction {
            let side = load(row);
            let small = side.abs().below(splat(f32::MIN_POSITIVE));
            *row = I::Sixteen::select(small, side * zero, side).to_array();
        }
        let (dx, dy, dz) = (load(&direction[0]), load(&direction[1]), load(&direction[2]));
        let (x, y, z) = (dx.abs(), dy.abs(), dz.abs());
        let first = y.below(x) & z.below(x);
        let last = !first & y.at_most(z);
        macro_rules! pick {
            ($first:expr, $second:expr, $last:expr) => {
                I::Sixteen::select(first, $first, I::Sixteen::select(last, $last, $second))
            };
        }
        let along = pick!(dx, dy, dz);
        let (ix, iy, iz) = (splat(1.0) / dx, splat(1.0) / dy, splat(1.0) / dz);
        let (less, more) = (splat(1.0 - MARGIN), splat(1.0 + MARGIN));
        let shear_z = pick!(ix, iy, iz);
        let start = load(&t_min);
        let start = I::Sixteen::select(start.below(zero), zero, start);
        let end = load(&t_max);
        let end = I::Sixteen::select(splat(f32::MAX).below(end), splat(f32::MAX), end);
        let mut finite = zero;
        for row in origin.iter().chain(&direction) {
            finite = finite + (load(row) - load(row));
        }
        let length = shear_z.abs();
        let in_reach = splat(1.0 / LONGEST).at_most(length) & length.at_most(splat(f32::MAX));
        let sound = finite.equals(zero) & in_reach & start.at_most(end);
        let sound = sound.bits() & ((1_u32 << rays.len().min(16)) - 1);
        let bound = I::Sixteen::select(I::Sixteen::mask(sound), end, splat(f32::NEG_INFINITY));
        let (first, last) = (first.bits(), last.bits());
        Self {
            backward: [dx.signs(), dy.signs(), dz.signs()],
            near_inverse: [(ix * less).to_array(), (iy * less).to_array(), (iz * less).to_array()],
            far_inverse: [(ix * more).to_array(), (iy * more).to_array(), (iz * more).to_array()],
            shear: [
                (pick!(dy, dz, dx) / along).to_array(),
                (pick!(dz, dx, dy) / along).to_array(),
                shear_z.to_array(),
            ],
            origin,
            direction,
            t_min: (start + zero).to_array(),
            t_max: end.to_array(),
            bound: bound.to_array(),
            u: [0.0; 16],
            v: [0.0; 16],
            primitive: [f32::from_bits(NO_HIT); 16],
            sound,
            along: [first, !(first | last) & 0xffff, last],
            ahead: zero.below(along).bits(),
        }
    }

    /// Whether all rays run to the same side on all axes.
    pub(super) fn agrees(&self) -> bool {
        self.backward.iter().all(|bits| *bits == 0 || *bits == 0xffff)
    }

    /// The best hit of a ray.
    pub(super) fn best(&self, lane: usize) -> Option<Hit> {
        let Self { bound, u, v, primitive, .. } = self;
        let hit = Hit { t: bound[lane], u: u[lane], v: v[lane], primitive: primitive[lane].to_bits() };
        (hit.primitive != NO_HIT).then_some(hit)
    }

    /// Takes over what a ray found on its own.
    pub(super) fn set_best(&mut self, lane: usize, hit: &Hit) {
        (self.bound[lane], self.u[lane], self.v[lane]) = (hit.t, hit.u, hit.v);
        self.primitive[lane] = f32::from_bits(hit.primitive);
    }

    /// The greatest bound of all rays.
    #[inline(always)]
    pub(super) fn reach<I: Isa>(&self) -> f32 {
        I::Sixteen::load(&self.bound).most()
    }

    /// A bit for each ray that enters a child of a node at or before its bound. With `AGREE` all rays run to the same side.
    #[inline(always)]
    pub(super) fn enter<I: Isa, const AGREE: bool>(&self, node: &WideNode, child: usize) -> u32 {
        let child = child & 7;
        let mut near = I::Sixteen::load(&self.t_min);
        let mut far = I::Sixteen::load(&self.bound);
        for axis in 0..3 {
            let (first, last) = if AGREE {
                let row = 2 * axis + (self.backward[axis] & 1) as usize;
                (node.planes[row][child], node.planes[row ^ 1][child])
            } else {
                (node.planes[2 * axis][child], node.planes[2 * axis + 1][child])
            };
            let (mut first, mut last) = (I::Sixteen::splat(first), I::Sixteen::splat(last));
            if !AGREE {
                let backward = I::Sixteen::mask(self.backward[axis]);
                (first, last) =
                    (I::Sixteen::select(backward, last, first), I::Sixteen::select(backward, first, last));
            }
            let origin = I::Sixteen::load(&self.origin[axis]);
            near = near.larger((first - origin) * I::Sixteen::load(&self.near_inverse[axis]));
            far = far.smaller((last - origin) * I::Sixteen::load(&self.far_inverse[axis]));
        }
        near.at_most(far).bits()
    }

    /// Tests one triangle of a block against the rays of `active`. Returns those whose hit precedes their best, and the hits;
    /// nothing is taken over yet.
    #[inline(always)]
    pub(super) fn triangle<I: Isa>(
        &self,
        block: &Block,
        place: usize,
        active: u32,
        cull_back: bool,
    ) -> Option<Found<I>> {
        let mut all: Option<Found<I>> = None;
        for axis in 0..3 {
            let active = active & self.along[axis];
            if active != 0
                && let Some(found) = self.triangle_along::<I>(axis, block, place, active, cull_back)
            {
                all = Some(match all {
                    Some(others) => others.joined(found),
                    None => found,
                });
            }
        }
        all
    }

    #[inline(always)]
    fn triangle_along<I: Isa>(
        &self,
        axis: usize,
        block: &Block,
        place: usize,
        active: u32,
        cull_back: bool,
    ) -> Option<Found<I>> {
        let place = place & 3;
        let splat = I::Sixteen::splat;
        let load = I::Sixteen::load;
        let [x, y, z] = AXES[axis];
        let (origin_x, origin_y, origin_z) =
            (load(&self.origin[x]), load(&self.origin[y]), load(&self.origin[z]));
        let (shear_x, shear_y) = (load(&self.shear[0]), load(&self.shear[1]));
        // What a corner is in the frame where the ray is the z axis. No closure: those are compiled for all processors.
        macro_rules! sheared {
            ($corner:literal) => {{
                let rows = block.corner($corner);
                let along = splat(rows[z][place]) - origin_z;
                let across_x = splat(rows[x][place]) - origin_x - shear_x * along;
                let across_y = splat(rows[y][place]) - origin_y - shear_y * along;
                (across_x, across_y, along)
            }};
        }
        let ((ax, ay, az), (bx, by, bz), (cx, cy, cz)) = (sheared!(0), sheared!(1), sheared!(2));
        let a = cx * by - cy * bx;
        let b = ax * cy - ay * cx;
        let c = bx * ay - by * ax;
        let zero = splat(0.0);
        let (least, greatest) = (a.smaller(b).smaller(c), a.larger(b).larger(c));
        let apart = least.below(zero) & zero.below(greatest);
        let candidates = active & !apart.bits();
        if candidates == 0 {
            return None;
        }
        let sum = a + b + c;
        let size = sum.abs();
        let touches = least.equals(zero) | greatest.equals(zero);
        let inverse = splat(1.0) / sum;
        let (a, b, c) = (a * inverse, b * inverse, c * inverse);
        let off_x = a * ax + b * bx + c * cx;
        let off_y = a * ay + b * by + c * cy;
        let reach =
            ax.abs().larger(ay.abs()).larger(bx.abs()).larger(by.abs()).larger(cx.abs()).larger(cy.abs());
        let is_near = off_x.abs().larger(off_y.abs()).at_most(reach * splat(RESIDUAL));
        let plain = splat(SAFE.start).at_most(size) & size.below(splat(SAFE.end)) & is_near & !touches;
        let plain = plain.bits();
        let u = splat(1.0).smaller(b + zero);
        let mut found = Found {
            t: (a * az + b * bz + c * cz) * load(&self.shear[2]) + zero,
            u,
            v: (splat(1.0) - u).smaller(c + zero),
            rays: candidates & plain,
        };
        let mut front = zero.below(sum).bits() ^ !self.ahead;
        if candidates & !plain != 0 {
            self.decide_exactly::<I>(axis, block, place, candidates & !plain, &mut found, &mut front);
        }
        found.rays &= (load(&self.t_min).at_most(found.t) & found.t.at_most(load(&self.t_max))).bits();
        if cull_back {
            found.rays &= front;
        }
        if found.rays == 0 {
            return None;
        }
        // Rule 2 of the theorem, and what is left of rule 3.
        let boxes = block.boxes::<I>();
        let (mut near, mut far) = (load(&self.t_min), load(&self.t_max));
        for (axis, [low, high]) in boxes.into_iter().enumerate() {
            let backward = I::Sixteen::mask(self.backward[axis]);
            let (low, high) = (splat(low.to_array()[place]), splat(high.to_array()[place]));
            let first = I::Sixteen::select(backward, high, low);
            let last = I::Sixteen::select(backward, low, high);
            let origin = load(&self.origin[axis]);
            near = near.larger((first - origin) * load(&self.near_inverse[axis]));
            far = far.smaller((last - origin) * load(&self.far_inverse[axis]));
        }
        found.rays &= near.at_most(far).bits();
        let t = I::Sixteen::select(found.t.below(near), near, found.t);
        found.t = I::Sixteen::select(far.below(t), far, t);
        let bound = load(&self.bound);
        let mut level = found.rays & found.t.equals(bound).bits();
        found.rays &= found.t.below(bound).bits();
        while level != 0 {
            let lane = level.trailing_zeros() as usize;
            level &= level - 1;
            let precedes = block.primitive(place) < self.primitive[lane & 15].to_bits();
            found.rays |= u32::from(precedes) << lane;
        }
        (found.rays != 0).then_some(found)
    }

    #[cold]
    #[inline(never)]
    fn decide_exactly<I: Isa>(
        &self,
        axis: usize,
        block: &Block,
        place: usize,
        doubtful: u32,
        found: &mut Found<I>,
        front: &mut u32,
    ) {
        let axes = AXES[axis];
        let (mut t, mut u, mut v) = (found.t.to_array(), found.u.to_array(), found.v.to_array());
        for lane in (0..16).filter(|lane| doubtful >> lane & 1 == 1) {
            let sheared = |corner: usize| {
                let [x, y, z]: [f32; 3] =
                    from_fn(|at| block.corner(corner)[axes[at]][place] - self.origin[axes[at]][lane]);
                [x - self.shear[0][lane] * z, y - self.shear[1][lane] * z, z]
            };
            let (t_min, t_max) = (self.t_min[lane], self.t_max[lane]);
            let ahead = self.ahead >> lane & 1 == 1;
            let crossing = exact_crossing([0, 1, 2].map(sheared), self.shear[2][lane], t_min, t_max, ahead);
            if let Some(crossing) = crossing {
                (t[lane], u[lane], v[lane]) = (crossing.t, crossing.u, crossing.v);
                *front = *front & !(1 << lane) | u32::from(crossing.front) << lane;
                found.rays |= 1 << lane;
            }
        }
        (found.t, found.u, found.v) = (I::Sixteen::load(&t), I::Sixteen::load(&u), I::Sixteen::load(&v));
    }

    /// Makes found hits the best ones.
    #[inline(always)]
    pub(super) fn take<I: Isa>(&mut self, found: &Found<I>, primitive: u32) {
        let rays = I::Sixteen::mask(found.rays);
        merge::<I>(&mut self.bound, rays, found.t);
        merge::<I>(&mut self.u, rays, found.u);
        merge::<I>(&mut self.v, rays, found.v);
        merge::<I>(&mut self.primitive, rays, I::Sixteen::splat(f32::from_bits(primitive)));
    }

    /// These rays have met something and that is all they had to find out.
    #[inline(always)]
    pub(super) fn end<I: Isa>(&mut self, rays: u32) {
        let rays = I::Sixteen::mask(rays);
        merge::<I>(&mut self.bound, rays, I::Sixteen::splat(f32::NEG_INFINITY));
        merge::<I>(&mut self.primitive, rays, I::Sixteen::splat(0.0));
    }
}

/// Which axes become x, y, z of triangle tests, by the axis that becomes z.
const AXES: [[usize; 3]; 3] = [[1, 2, 0], [2, 0, 1], [0, 1, 2]];

#[inline(always)]
fn merge<I: Isa>(row: &mut Row, rays: <I::Sixteen as Lanes<16>>::Mask, new: I::Sixteen) {
    *row = I::Sixteen::select(rays, new, I::Sixteen::load(row)).to_array();
}

/// Hits of several rays on one triangle.
#[derive(Clone, Copy)]
pub(super) struct Found<I: Isa> {
    /// A bit for each ray that has one.
    pub(super) rays: u32,
    t: I::Sixteen,
    u: I::Sixteen,
    v: I::Sixteen,
}

impl<I: Isa> Found<I> {
    /// The hit of a ray.
    pub(super) fn hit(&self, lane: usize, primitive: u32) -> Hit {
        let lane = lane & 15;
        Hit { t: self.t.to_array()[lane], u: self.u.to_array()[lane], v: self.v.to_array()[lane], primitive }
    }

    /// Both, where no ray is in both.
    #[inline(always)]
    fn joined(self, other: Self) -> Self {
        let mask = I::Sixteen::mask(other.rays);
        Self {
            rays: self.rays | other.rays,
            t: I::Sixteen::select(mask, other.t, self.t),
            u: I::Sixteen::select(mask, other.u, self.u),
            v: I::Sixteen::select(mask, other.v, self.v),
        }
    }
}
