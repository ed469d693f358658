//! The watertight test: a ray through a shared edge or vertex meets at least one of the triangles there.
//!
//! Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2 (1), 2013. The triangle is moved and sheared so that
//! the ray becomes the z axis; three edge functions of the sheared corners then decide in the plane. Both triangles at an
//! edge see the same sheared corners, hence the same number with the opposite sign. A difference of two rounded products
//! has the right sign or is zero, and when one is zero the three are taken again in double precision, where products of
//! single precision numbers are exact. Sizes beyond the safe range of single precision go the same way.

use super::Triangle;
use crate::slab::{larger, smaller};
use crate::{Crossing, Ray};

/// Sums of edge functions whose products neither overflow nor lose bits: squares of lengths of 10⁻¹⁵ to 10¹⁵.
const SAFE: std::ops::Range<f32> = 1e-30..1e30;

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
        let direction = ray.direction.to_array();
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
        if least == 0.0 || greatest == 0.0 || !SAFE.contains(&sum.abs()) {
            return self.exact_hit([ax, ay, az], [bx, by, bz], [cx, cy, cz]);
        }
        let inverse = 1.0 / sum;
        let (a, b, c) = (a * inverse, b * inverse, c * inverse);
        self.accept((a * az + b * bz + c * cz) * self.shear[2], b, c, sum > 0.0)
    }

    /// The same in double precision, from the same sheared corners.
    #[cold]
    fn exact_hit(&self, a: [f32; 3], b: [f32; 3], c: [f32; 3]) -> Option<Crossing> {
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
        let t = (a * az + b * bz + c * cz) * f64::from(self.shear[2]) / sum;
        self.accept(t as f32, (b / sum) as f32, (c / sum) as f32, sum > 0.0)
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

    /// Keeps the hit if it lies on the ray. A sum of zero, a ray in the plane of the triangle or a degenerate triangle,
    /// made `t` infinite or no number, and the comparison fails.
    #[inline(always)]
    fn accept(&self, t: f32, u: f32, v: f32, positive: bool) -> Option<Crossing> {
        if !(self.t_min <= t && t <= self.t_max) {
            return None;
        }
        // Adding zero makes a negative zero positive; rounding may not leave less than nothing for the first corner.
        let u = smaller(1.0, u + 0.0);
        Some(Crossing { t: t + 0.0, u, v: smaller(1.0 - u, v + 0.0), front: positive == self.ahead })
    }
}
