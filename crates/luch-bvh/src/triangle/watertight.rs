//! The watertight test: a ray through a shared edge or vertex meets at least one of the triangles there.
//!
//! Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2 (1), 2013. The triangle is moved and sheared so that
//! the ray becomes the z axis; three edge functions of the sheared corners then decide in the plane. Both triangles at an
//! edge see the same sheared corners, hence the same number with the opposite sign. A difference of two rounded products
//! has the right sign or is zero, and when one is zero the three are taken again in double precision, where products of
//! single precision numbers are exact. Sizes beyond the safe range of single precision go the same way, and so do weights
//! that rounding has led astray.

use super::Triangle;
use crate::slab::{larger, smaller};
use crate::{Crossing, Ray};

/// Sums of edge functions whose products neither overflow nor lose bits: squares of lengths of 10⁻¹⁵ to 10¹⁵.
pub(crate) const SAFE: std::ops::Range<f32> = 1e-30..1e30;

/// How far off the ray, as a part of the triangle's reach across it, the weighted sum of the corners may lie: 2⁻²⁰. Weights
/// that miss by more, because the ray runs almost along the plane of the triangle or the triangle is a sliver, are taken
/// again in double precision. [`slab`](crate::slab) tells what rests on this.
pub(crate) const RESIDUAL: f32 = 1.0 / 1_048_576.0;

/// A ray prepared for triangle tests.
#[derive(Clone, Copy, Debug)]
pub struct ShearedRay {
    origin: [f32; 3],
    /// The axis the ray follows most. It becomes z; the two after it become x and y.
    axis: usize,
    /// Whether the ray runs toward greater coordinates on it. Otherwise the triangle is seen from behind, and all edge
    /// functions change their sign.
    ahead: bool,
    shear: [f32; 3],
    t_min: f32,
    t_max: f32,
}

impl ShearedRay {
    /// Prepares a ray; `None` under the conditions of [`SlabRay::new`](crate::SlabRay::new).
    pub fn new(ray: &Ray) -> Option<Self> {
        crate::SlabRay::new(ray).map(|slab| Self::of_valid(ray, slab.t_min, slab.t_max))
    }

    /// As [`ShearedRay::new`] for a ray that is known to be sound.
    pub(crate) fn of_valid(ray: &Ray, t_min: f32, t_max: f32) -> Self {
        let direction = crate::slab::direction(ray);
        let [x, y, z] = direction.map(f32::abs);
        let axis = if x > y && x > z { 0 } else { 1 + usize::from(y <= z) };
        let along = direction[axis];
        let shear = [direction[(axis + 1) % 3] / along, direction[(axis + 2) % 3] / along, 1.0 / along];
        Self { origin: ray.origin.to_array(), axis, ahead: along > 0.0, shear, t_min, t_max }
    }

    /// Where the ray meets the triangle, from either side. A pure function of ray and triangle.
    #[inline]
    pub fn hit(&self, triangle: &Triangle) -> Option<Crossing> {
        match self.axis {
            0 => self.hit_along::<0>(triangle),
            1 => self.hit_along::<1>(triangle),
            _ => self.hit_along::<2>(triangle),
        }
    }

    #[inline(always)]
    fn hit_along<const AXIS: usize>(&self, triangle: &Triangle) -> Option<Crossing> {
        let [ax, ay, az] = self.sheared::<AXIS>(triangle.a.to_array());
        let [bx, by, bz] = self.sheared::<AXIS>(triangle.b.to_array());
        let [cx, cy, cz] = self.sheared::<AXIS>(triangle.c.to_array());
        // Each is twice the area of a triangle of the ray and one edge: the weight of the corner opposite.
        let a = cx * by - cy * bx;
        let b = ax * cy - ay * cx;
        let c = bx * ay - by * ax;
        let (least, greatest) = (smaller(smaller(a, b), c), larger(larger(a, b), c));
        if least < 0.0 && greatest > 0.0 {
            return None;
        }
        let sum = a + b + c;
        let inverse = 1.0 / sum;
        let (a, b, c) = (a * inverse, b * inverse, c * inverse);
        let off_x = a * ax + b * bx + c * cx;
        let off_y = a * ay + b * by + c * cy;
        let reach = [ay, bx, by, cx, cy].into_iter().fold(ax.abs(), |most, side| larger(most, side.abs()));
        let is_near = larger(off_x.abs(), off_y.abs()) <= reach * RESIDUAL;
        if least == 0.0 || greatest == 0.0 || !SAFE.contains(&sum.abs()) || !is_near {
            let corners = [[ax, ay, az], [bx, by, bz], [cx, cy, cz]];
            return exact_crossing(corners, self.shear[2], self.t_min, self.t_max, self.ahead);
        }
        let t = (a * az + b * bz + c * cz) * self.shear[2];
        accepted(t, b, c, self.t_min, self.t_max, (sum > 0.0) == self.ahead)
    }

    /// Turns a corner into the frame where the ray is the z axis; z is not yet divided by the direction.
    #[inline(always)]
    fn sheared<const AXIS: usize>(&self, corner: [f32; 3]) -> [f32; 3] {
        let from_origin = |axis: usize| corner[axis] - self.origin[axis];
        let along = from_origin(AXIS);
        let x = from_origin((AXIS + 1) % 3) - self.shear[0] * along;
        let y = from_origin((AXIS + 2) % 3) - self.shear[1] * along;
        [x, y, along]
    }
}

/// The crossing in double precision, from three corners sheared as above.
#[cold]
pub(crate) fn exact_crossing(
    [a, b, c]: [[f32; 3]; 3],
    shear_z: f32,
    t_min: f32,
    t_max: f32,
    ahead: bool,
) -> Option<Crossing> {
    let [ax, ay, az] = a.map(f64::from);
    let [bx, by, bz] = b.map(f64::from);
    let [cx, cy, cz] = c.map(f64::from);
    let a = cx * by - cy * bx;
    let b = ax * cy - ay * cx;
    let c = bx * ay - by * ax;
    if (a < 0.0 || b < 0.0 || c < 0.0) && (a > 0.0 || b > 0.0 || c > 0.0) {
        return None;
    }
    let sum = a + b + c;
    let t = (a * az + b * bz + c * cz) * f64::from(shear_z) / sum;
    accepted(t as f32, (b / sum) as f32, (c / sum) as f32, t_min, t_max, (sum > 0.0) == ahead)
}

/// Keeps the crossing if it lies on the ray. A sum of zero, a ray in the plane of the triangle or a degenerate triangle,
/// made `t` infinite or no number, and the comparison fails.
#[inline(always)]
fn accepted(t: f32, u: f32, v: f32, t_min: f32, t_max: f32, front: bool) -> Option<Crossing> {
    if !(t_min <= t && t <= t_max) {
        return None;
    }
    // Adding zero makes a negative zero positive; rounding may not leave less than nothing for the first corner.
    let u = smaller(1.0, u + 0.0);
    Some(Crossing { t: t + 0.0, u, v: smaller(1.0 - u, v + 0.0), front })
}
