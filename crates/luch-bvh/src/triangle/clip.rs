//! Cutting triangles for spatial splits.

use super::Triangle;
use crate::Aabb;
use crate::aabb::PADDING;
use crate::build::Clip;
use crate::slab::LONGEST;
use glam::Vec3;

/// The triangles of a mesh: `corners` finds one by its number.
pub(crate) struct TriangleClip<F>(pub(crate) F);

/// Triangles of a lesser extent stay whole: 2⁻²⁰. The proof in [`slab`](crate::slab) wants them not to vanish beside the
/// least number.
const SMALLEST: f32 = 1.0 / 1_048_576.0;

impl<F: Fn(u32) -> Triangle + Sync> Clip for TriangleClip<F> {
    fn triangle(&self, primitive: u32) -> Option<Triangle> {
        Some((self.0)(primitive)).filter(Triangle::may_be_cut)
    }
}

impl Triangle {
    fn extent(&self) -> f32 {
        let whole = Aabb::of_points([self.a, self.b, self.c]);
        (whole.max - whole.min).max_element()
    }

    /// Whether parts of the triangle may stand for the whole, as [`slab`](crate::slab) has it.
    pub(crate) fn may_be_cut(&self) -> bool {
        (SMALLEST..LONGEST).contains(&self.extent())
    }

    /// The box of what lies between two planes across an axis, padded as [`Triangle::bounds`] is: by the extent of the whole
    /// triangle. Empty if nothing does.
    pub(crate) fn between(&self, axis: usize, low: f32, high: f32) -> Aabb {
        let corners = [self.a, self.b, self.c];
        let mut part = Aabb::empty();
        for (index, from) in corners.into_iter().enumerate() {
            let to = corners[(index + 1) % 3];
            if low <= from[axis] && from[axis] <= high {
                part.grow(from);
            }
            for plane in [low, high] {
                if (from[axis] < plane) != (to[axis] < plane) {
                    part.grow(crossing(from, to, axis, plane));
                }
            }
        }
        if part.is_empty() { part } else { Self::padded(&part, self.extent() * PADDING) }
    }
}

/// Where the edge meets the plane; rounded once from double precision.
fn crossing(from: Vec3, to: Vec3, axis: usize, plane: f32) -> Vec3 {
    let wide = |value: f32| f64::from(value);
    let part = (wide(plane) - wide(from[axis])) / (wide(to[axis]) - wide(from[axis]));
    let at = |other: usize| {
        if other == axis {
            plane
        } else {
            (wide(from[other]) + part * (wide(to[other]) - wide(from[other]))) as f32
        }
    };
    Vec3::new(at(0), at(1), at(2))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::triangle::ShearedRay;
    use crate::{Ray, SlabRay};
    use glam::vec3;

    /// Numbers from -1 to 1, the same each time.
    fn numbers() -> impl FnMut() -> f32 {
        let mut state = 11_u64;
        move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f32 / 8_388_608.0 - 1.0
        }
    }

    /// The lemma behind spatial splits: wherever a hit says it lies in the triangle, a box around no more than that point,
    /// padded as parts of the triangle are, is met by the ray at the hit.
    #[test]
    fn a_hit_lies_where_its_weights_say() {
        let mut next = numbers();
        let mut hits = 0;
        for index in 0..3_000_000_u32 {
            let mut point = || vec3(next(), next(), next());
            // Slivers of all widths, seen along their planes, exactly or nearly.
            let a = point();
            let along = point();
            let width = [1.0, 1e-2, 1e-4, 1e-6][index as usize % 4];
            let triangle = Triangle { a, b: a + along, c: a + along * 0.6 + point() * width };
            let target = triangle.at(0.3, 0.4);
            let across = triangle.at(0.5, 0.1) - triangle.at(0.1, 0.7);
            let tilt = [0.0, 1e-7, 1e-6, 1e-4, 1e-2, 1.0][index as usize / 4 % 6];
            let direction = across + point() * across.length() * tilt;
            let distance = [0.5, 2.0, 1e3, 1e6][index as usize / 24 % 4];
            let ray = Ray::new(target - direction * distance, direction);
            let (Some(slab), Some(sheared)) = (SlabRay::new(&ray), ShearedRay::new(&ray)) else { continue };
            let Some(hit) = sheared.hit(&triangle) else { continue };
            hits += 1;
            let margin = triangle.extent() * PADDING;
            let place = Triangle::padded(&Aabb::of_points([triangle.at(hit.u, hit.v)]), margin);
            let interval =
                slab.interval(&place).unwrap_or_else(|| panic!("{index}: {hit:?} {ray:?} {triangle:?}"));
            assert_eq!(interval.clamp(hit.t), hit.t, "{index}: {interval:?} {hit:?} {ray:?} {triangle:?}");
            assert_eq!(slab.clamp(&triangle.bounds(), hit.t), Some(hit.t), "{index}");
        }
        assert!(hits > 1_000_000, "{hits}");
    }

    #[test]
    fn parts_between_planes() {
        let triangle = Triangle { a: Vec3::ZERO, b: vec3(4.0, 0.0, 0.0), c: vec3(0.0, 2.0, 1.0) };
        let part = |axis, low, high| triangle.between(axis, low, high);
        let near = |bounds: Aabb, low: Vec3, high: Vec3| {
            assert!((bounds.min - low).abs().max_element() < 1e-4, "{bounds:?}");
            assert!((bounds.max - high).abs().max_element() < 1e-4, "{bounds:?}");
            assert!(bounds.contains(low) && bounds.contains(high));
        };
        near(part(0, 1.0, 2.0), vec3(1.0, 0.0, 0.0), vec3(2.0, 1.5, 0.75));
        near(part(0, f32::NEG_INFINITY, 2.0), Vec3::ZERO, vec3(2.0, 2.0, 1.0));
        near(part(2, 0.5, f32::INFINITY), vec3(0.0, 1.0, 0.5), vec3(2.0, 2.0, 1.0));
        assert!(part(1, 3.0, 4.0).is_empty());
        let tiny = Triangle { a: Vec3::ZERO, b: Vec3::X * 1e-7, c: Vec3::Y * 1e-7 };
        assert!(!tiny.may_be_cut() && triangle.may_be_cut());
    }
}
