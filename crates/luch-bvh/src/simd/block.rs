//! Four triangles side by side, and the watertight test of all four at once.
//!
//! The formulas are those of [`ShearedRay::hit`](crate::triangle::ShearedRay::hit), operation by operation.

use super::lanes::{Isa, Lanes, Mask};
use super::ray::Prepared;
use crate::Hit;
use crate::aabb::PADDING;
use crate::triangle::{RESIDUAL, SAFE, Triangle, exact_crossing};
use crate::wide::NO_PRIMITIVE;
use std::array::from_fn;

/// The triangles of one leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub(crate) struct Block {
    /// For each corner rows x, y, z; one column for each triangle.
    corners: [[[f32; 4]; 3]; 3],
    /// [`NO_PRIMITIVE`] where there is none.
    primitives: [u32; 4],
}

/// The hits of a ray among four triangles, clamped into their own boxes.
pub(super) struct Hits {
    /// A bit for each lane that is hit.
    pub(super) lanes: u32,
    t: [f32; 4],
    u: [f32; 4],
    v: [f32; 4],
}

impl Hits {
    const NONE: Self = Self { lanes: 0, t: [0.0; 4], u: [0.0; 4], v: [0.0; 4] };

    /// The hit of one lane.
    #[inline(always)]
    pub(super) fn hit(&self, lane: usize, block: &Block) -> Hit {
        let lane = lane & 3;
        Hit { t: self.t[lane], u: self.u[lane], v: self.v[lane], primitive: block.primitives[lane] }
    }
}

impl Block {
    /// Packs the triangles of a leaf; `corners` finds a triangle by its number.
    pub(crate) fn new(primitives: [u32; 4], corners: impl Fn(u32) -> Triangle) -> Self {
        let mut block = Self { corners: [[[f32::NAN; 4]; 3]; 3], primitives };
        for (lane, primitive) in primitives.into_iter().enumerate() {
            if primitive == NO_PRIMITIVE {
                continue;
            }
            let Triangle { a, b, c } = corners(primitive);
            for (rows, corner) in block.corners.iter_mut().zip([a, b, c]) {
                for (row, value) in rows.iter_mut().zip(corner.to_array()) {
                    row[lane] = value;
                }
            }
        }
        block
    }

    /// The triangles that are there.
    pub(crate) fn triangles(&self) -> impl Iterator<Item = (u32, Triangle)> {
        let there = self.primitives.iter().enumerate().filter(|(_, primitive)| **primitive != NO_PRIMITIVE);
        there.map(|(lane, primitive)| (*primitive, self.triangle(lane)))
    }

    pub(super) fn triangle(&self, lane: usize) -> Triangle {
        let [a, b, c] =
            from_fn(|corner| glam::Vec3::from_array(from_fn(|axis| self.corners[corner][axis][lane])));
        Triangle { a, b, c }
    }

    /// How many triangles there are.
    #[inline(always)]
    pub(super) fn count(&self) -> usize {
        (0..4).fold(0, |count, lane| count + usize::from(self.primitives[lane] != NO_PRIMITIVE))
    }

    /// Number of the triangle in a lane.
    pub(super) fn primitive(&self, lane: usize) -> u32 {
        self.primitives[lane & 3]
    }

    /// Rows of one corner.
    #[inline(always)]
    pub(super) fn corner(&self, corner: usize) -> &[[f32; 4]; 3] {
        &self.corners[corner]
    }

    /// The hits of all four that are on the ray and, with `cull_back`, seen from outside.
    #[inline(always)]
    pub(super) fn hits<I: Isa>(&self, ray: &Prepared, cull_back: bool) -> Hits {
        let (edges, candidates) = self.edges::<I>(ray);
        if candidates == 0 { Hits::NONE } else { self.decide::<I>(ray, &edges, candidates, cull_back) }
    }

    /// The edge functions, and a bit for each triangle whose edge functions do not differ in sign.
    #[inline(always)]
    pub(super) fn edges<I: Isa>(&self, ray: &Prepared) -> (Edges, u32) {
        let sheared = |corner: usize| self.sheared::<I>(ray, corner);
        let ([ax, ay, az], [bx, by, bz], [cx, cy, cz]) = (sheared(0), sheared(1), sheared(2));
        let a = cx * by - cy * bx;
        let b = ax * cy - ay * cx;
        let c = bx * ay - by * ax;
        let zero = I::Four::splat(0.0);
        let apart = a.smaller(b).smaller(c).below(zero) & zero.below(a.larger(b).larger(c));
        let candidates = !apart.bits() & I::differing(&self.primitives, NO_PRIMITIVE);
        ([a, b, c, az, bz, cz].map(I::Four::to_array), candidates)
    }

    /// A corner of each triangle in the frame where the ray is the z axis; z not yet divided by the direction.
    #[inline(always)]
    fn sheared<I: Isa>(&self, ray: &Prepared, corner: usize) -> [I::Four; 3] {
        let [x, y, z] = from_fn(|axis| {
            let rows: *const u8 = self.corners[corner].as_ptr().cast();
            // SAFETY: this is a row of the corner.
            let row = unsafe { &*rows.add(ray.rows[axis] as usize).cast() };
            I::Four::load(row) - I::Four::splat(ray.turned[axis])
        });
        [x - I::Four::splat(ray.shear[0]) * z, y - I::Four::splat(ray.shear[1]) * z, z]
    }

    /// Which candidates are hits.
    #[inline(always)]
    pub(super) fn decide<I: Isa>(
        &self,
        ray: &Prepared,
        edges: &Edges,
        candidates: u32,
        cull_back: bool,
    ) -> Hits {
        let splat = I::Four::splat;
        let zero = splat(0.0);
        let [a, b, c, az, bz, cz] = from_fn(|row| I::Four::load(&edges[row]));
        let touches = a.smaller(b).smaller(c).equals(zero) | a.larger(b).larger(c).equals(zero);
        let sum = a + b + c;
        let size = sum.abs();
        let plain = splat(SAFE.start).at_most(size) & size.below(splat(SAFE.end)) & !touches;
        let inverse = splat(1.0) / sum;
        let (a, b, c) = (a * inverse, b * inverse, c * inverse);
        // Weights that rounding has led astray are taken again; spatial splits rest on this. See `RESIDUAL`.
        let [[ax, ay, _], [bx, by, _], [cx, cy, _]] = from_fn(|corner| self.sheared::<I>(ray, corner));
        let off_x = a * ax + b * bx + c * cx;
        let off_y = a * ay + b * by + c * cy;
        let reach =
            ax.abs().larger(ay.abs()).larger(bx.abs()).larger(by.abs()).larger(cx.abs()).larger(cy.abs());
        let plain = plain & off_x.abs().larger(off_y.abs()).at_most(reach * splat(RESIDUAL));
        let u = splat(1.0).smaller(b + zero);
        let mut found = Found::<I> {
            t: (a * az + b * bz + c * cz) * splat(ray.shear[2]) + zero,
            u,
            v: (splat(1.0) - u).smaller(c + zero),
            front: zero.below(sum).bits() ^ if ray.ahead { 0 } else { 15 },
        };
        let on_ray = splat(ray.t_min).at_most(found.t) & found.t.at_most(splat(ray.t_max));
        let mut lanes = candidates & plain.bits() & on_ray.bits();
        let doubtful = candidates & !plain.bits();
        if doubtful != 0 {
            lanes |= self.decide_exactly(ray, doubtful, &mut found);
        }
        if cull_back {
            lanes &= found.front;
        }
        if lanes == 0 {
            return Hits::NONE;
        }
        let Interval4 { near, far } = self.intervals::<I>(ray);
        lanes &= near.at_most(far).bits();
        // Below the near end the near end, beyond the far end the far end.
        let t = I::Four::select(found.t.below(near), near, found.t);
        let t = I::Four::select(far.below(t), far, t);
        Hits { lanes, t: t.to_array(), u: found.u.to_array(), v: found.v.to_array() }
    }

    /// The lanes in which a ray goes through an edge, or sizes are beyond single precision.
    #[cold]
    #[inline(never)]
    fn decide_exactly<I: Isa>(&self, ray: &Prepared, doubtful: u32, found: &mut Found<I>) -> u32 {
        let (mut t, mut u, mut v) = (found.t.to_array(), found.u.to_array(), found.v.to_array());
        let mut lanes = 0;
        for lane in (0..4).filter(|lane| doubtful >> lane & 1 == 1) {
            let sheared = |corner: [[f32; 4]; 3]| {
                let [x, y, z]: [f32; 3] =
                    from_fn(|axis| corner[ray.rows[axis] as usize / 16][lane] - ray.turned[axis]);
                [x - ray.shear[0] * z, y - ray.shear[1] * z, z]
            };
            let corners = self.corners.map(sheared);
            let crossing = exact_crossing(corners, ray.shear[2], ray.t_min, ray.t_max, ray.ahead);
            if let Some(crossing) = crossing {
                (t[lane], u[lane], v[lane]) = (crossing.t, crossing.u, crossing.v);
                found.front = found.front & !(1 << lane) | u32::from(crossing.front) << lane;
                lanes |= 1 << lane;
            }
        }
        (found.t, found.u, found.v) = (I::Four::load(&t), I::Four::load(&u), I::Four::load(&v));
        lanes
    }

    /// The triangles' own boxes as [`Triangle::bounds`] has them: by axis the least and the greatest coordinates.
    #[inline(always)]
    pub(super) fn boxes<I: Isa>(&self) -> [[I::Four; 2]; 3] {
        let splat = I::Four::splat;
        let [x, y, z] = [self.ends::<I>(0), self.ends::<I>(1), self.ends::<I>(2)];
        let margin = (x[1] - x[0]).larger(y[1] - y[0]).larger(z[1] - z[0]) * splat(PADDING);
        let mut boxes = [x, y, z];
        for [low, high] in &mut boxes {
            *low = *low - (margin + low.abs() * splat(Triangle::ROUNDING));
            *high = *high + (margin + high.abs() * splat(Triangle::ROUNDING));
        }
        boxes
    }

    /// The least and the greatest coordinates of the corners along an axis.
    #[inline(always)]
    fn ends<I: Isa>(&self, axis: usize) -> [I::Four; 2] {
        let [a, b, c] = &self.corners;
        let (a, b, c) = (I::Four::load(&a[axis]), I::Four::load(&b[axis]), I::Four::load(&c[axis]));
        [a.smaller(b).smaller(c), a.larger(b).larger(c)]
    }

    /// The pieces of the ray inside these boxes, as [`SlabRay::interval`](crate::SlabRay::interval).
    #[inline(always)]
    fn intervals<I: Isa>(&self, ray: &Prepared) -> Interval4<I> {
        let splat = I::Four::splat;
        let boxes = self.boxes::<I>();
        let (mut near, mut far) = (splat(ray.t_min), splat(ray.t_max));
        for (axis, [low, high]) in boxes.into_iter().enumerate() {
            let backward = I::Four::mask(if ray.is_backward(axis) { 15 } else { 0 });
            let first = I::Four::select(backward, high, low);
            let last = I::Four::select(backward, low, high);
            let origin = splat(ray.origin[axis]);
            near = near.larger((first - origin) * splat(ray.near_inverse[axis]));
            far = far.smaller((last - origin) * splat(ray.far_inverse[axis]));
        }
        Interval4 { near, far }
    }
}

/// Edge functions of four triangles (the weights of their first, second, third corners) and the sheared z of these corners.
pub(super) type Edges = [[f32; 4]; 6];

/// Crossings of four triangles, on the ray or not.
struct Found<I: Isa> {
    t: I::Four,
    u: I::Four,
    v: I::Four,
    /// A bit for each lane that is seen from outside.
    front: u32,
}

struct Interval4<I: Isa> {
    near: I::Four,
    far: I::Four,
}
