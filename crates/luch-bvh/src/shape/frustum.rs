//! Cylinders, cones and what lies between.

use super::WideRay;
use crate::aabb::PADDING;
use crate::{Aabb, Crossing, Ray};
use glam::Vec3;

/// A round body that stands upright around the origin: its radius goes evenly from the bottom's to the top's.
///
/// A cylinder if both are equal, a cone if one is zero. The outside is the front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frustum {
    /// Radius at the lower end.
    pub bottom_radius: f32,
    /// Radius at the upper end.
    pub top_radius: f32,
    /// Length along y; the origin is in the middle. Frustums without a positive finite one are never hit.
    pub height: f32,
    /// With a disc at both ends.
    pub capped: bool,
}

/// A part of the surface of a [`Frustum`], as it stands in the `u` of a crossing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrustumPart {
    /// The side.
    Side,
    /// The disc at the upper end.
    Top,
    /// The disc at the lower end.
    Bottom,
}

impl FrustumPart {
    /// The part that a crossing's `u` tells.
    pub fn of(u: f32) -> Self {
        match u {
            1.0 => Self::Top,
            2.0 => Self::Bottom,
            _ => Self::Side,
        }
    }

    fn number(self) -> f32 {
        match self {
            Self::Side => 0.0,
            Self::Top => 1.0,
            Self::Bottom => 2.0,
        }
    }
}

/// Where a line goes into or out of a part of space, and through which part of the surface.
#[derive(Clone, Copy)]
struct End {
    t: f64,
    part: FrustumPart,
}

/// A stretch of a line.
#[derive(Clone, Copy)]
struct Stretch {
    enter: End,
    leave: End,
}

impl Frustum {
    /// The box of the frustum, a trifle too large; empty if it cannot be hit.
    pub fn bounds(&self) -> Aabb {
        if !self.is_sound() {
            return Aabb::empty();
        }
        let radius = self.bottom_radius.max(self.top_radius);
        let corner = Vec3::new(radius, 0.5 * self.height, radius);
        Aabb { min: -corner, max: corner }.padded(corner.max_element() * PADDING)
    }

    /// Where the ray goes in and where it comes out; without caps where it crosses the side. `u` tells the
    /// [part](FrustumPart::of), `v` is 0.
    ///
    /// A capped body is convex: the stretch of the line between both planes and the stretch inside the side are cut with one
    /// another, so no ray slips through where cap and side meet.
    pub fn crossings(&self, ray: &Ray) -> [Option<Crossing>; 2] {
        let Some(ray) = WideRay::new(ray).filter(|_| self.is_sound()) else { return [None; 2] };
        let Some(side) = self.inside_side(&ray) else { return [None; 2] };
        let crossing =
            |end: End, front| ray.on_ray(end.t).map(|t| Crossing { t, u: end.part.number(), v: 0.0, front });
        let Stretch { enter, leave } = side;
        if !self.capped {
            let half = 0.5 * f64::from(self.height);
            let is_between = |end: &End| end.t.is_finite() && ray.at(end.t)[1].abs() <= half;
            let on_side = |end: End, front| if is_between(&end) { crossing(end, front) } else { None };
            return [on_side(enter, true), on_side(leave, false)];
        }
        let Some(slab) = self.between_planes(&ray) else { return [None; 2] };
        let enter = if slab.enter.t > enter.t { slab.enter } else { enter };
        let leave = if slab.leave.t < leave.t { slab.leave } else { leave };
        if enter.t <= leave.t { [crossing(enter, true), crossing(leave, false)] } else { [None; 2] }
    }

    /// The stretch between the planes of the ends.
    fn between_planes(&self, ray: &WideRay) -> Option<Stretch> {
        let half = 0.5 * f64::from(self.height);
        let (from, along) = (ray.origin[1], ray.direction[1]);
        if along == 0.0 {
            let everywhere = Stretch {
                enter: End { t: f64::NEG_INFINITY, part: FrustumPart::Bottom },
                leave: End { t: f64::INFINITY, part: FrustumPart::Top },
            };
            return (from.abs() <= half).then_some(everywhere);
        }
        let bottom = End { t: (-half - from) / along, part: FrustumPart::Bottom };
        let top = End { t: (half - from) / along, part: FrustumPart::Top };
        let (enter, leave) = if along > 0.0 { (bottom, top) } else { (top, bottom) };
        Some(Stretch { enter, leave })
    }

    /// The stretch of the line that is nearer to the axis than the side is, on the side's own half of the double cone:
    /// x² + z² ≤ r(y)², a quadratic in t.
    fn inside_side(&self, ray: &WideRay) -> Option<Stretch> {
        let (bottom, top) = (f64::from(self.bottom_radius), f64::from(self.top_radius));
        let slope = (top - bottom) / f64::from(self.height);
        let ([ox, oy, oz], [dx, dy, dz]) = (ray.origin, ray.direction);
        let radius = 0.5 * (bottom + top) + slope * oy;
        let growth = slope * dy;
        let a = dx * dx + dz * dz - growth * growth;
        let b = ox * dx + oz * dz - radius * growth;
        let c = ox * ox + oz * oz - radius * radius;
        let end = |t| End { t, part: FrustumPart::Side };
        let (first, last) = (end(f64::NEG_INFINITY), end(f64::INFINITY));
        if a == 0.0 {
            // Along the side's own slope, or straight up a cylinder.
            if b == 0.0 {
                return (c <= 0.0).then_some(Stretch { enter: first, leave: last });
            }
            let t = -0.5 * c / b;
            return Some(if b > 0.0 {
                Stretch { enter: first, leave: end(t) }
            } else {
                Stretch { enter: end(t), leave: last }
            });
        }
        let discriminant = b * b - a * c;
        if discriminant.is_nan() || (discriminant < 0.0 && a > 0.0) {
            return None;
        }
        // The root without cancellation first, the other by the product of both.
        let root = discriminant.max(0.0).sqrt();
        let larger = if b < 0.0 { root - b } else { -root - b };
        let (one, other) = (larger / a, if larger == 0.0 { 0.0 } else { c / larger });
        let (low, high) = if one <= other { (one, other) } else { (other, one) };
        if a > 0.0 {
            return Some(Stretch { enter: end(low), leave: end(high) });
        }
        // Steeper than the side: inside from the surface on, toward where the radius grows.
        Some(if growth > 0.0 {
            Stretch { enter: end(high), leave: last }
        } else {
            Stretch { enter: first, leave: end(low) }
        })
    }

    fn is_sound(&self) -> bool {
        let sizes = [self.bottom_radius, self.top_radius, self.height];
        sizes.iter().all(|size| *size >= 0.0 && size.is_finite())
            && self.height > 0.0
            && self.bottom_radius.max(self.top_radius) > 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    const CONE: Frustum = Frustum { bottom_radius: 1.0, top_radius: 0.0, height: 2.0, capped: true };

    fn times(frustum: Frustum, origin: Vec3, direction: Vec3) -> Vec<(f32, FrustumPart)> {
        let crossings = frustum.crossings(&Ray::new(origin, direction));
        crossings.into_iter().flatten().map(|c| (c.t, FrustumPart::of(c.u))).collect()
    }

    #[test]
    fn a_cylinder_is_crossed_where_it_should_be() {
        let cylinder = Frustum { bottom_radius: 1.0, top_radius: 1.0, height: 2.0, capped: true };
        use FrustumPart::{Bottom, Side, Top};
        assert_eq!(times(cylinder, vec3(-3.0, 0.0, 0.0), Vec3::X), [(2.0, Side), (4.0, Side)]);
        assert_eq!(times(cylinder, vec3(0.5, 3.0, 0.0), -Vec3::Y), [(2.0, Top), (4.0, Bottom)]);
        assert_eq!(times(cylinder, vec3(0.0, 2.0, 0.0), vec3(1.0, -1.0, 0.0)), [(1.0, Top), (1.0, Side)]);
        assert_eq!(times(cylinder, vec3(-3.0, 1.5, 0.0), Vec3::X), []);
        assert_eq!(times(Frustum { capped: false, ..cylinder }, vec3(0.5, 3.0, 0.0), -Vec3::Y), []);
        // From inside only the way out.
        assert_eq!(times(cylinder, Vec3::ZERO, Vec3::Z), [(1.0, Side)]);
    }

    #[test]
    fn a_cone_has_one_half_only() {
        use FrustumPart::{Bottom, Side};
        assert_eq!(times(CONE, vec3(-3.0, 0.0, 0.0), Vec3::X), [(2.5, Side), (3.5, Side)]);
        assert_eq!(times(CONE, vec3(0.0, 4.0, 0.0), -Vec3::Y), [(3.0, Side), (5.0, Bottom)]);
        // Above the tip the other half of the double cone is not there.
        assert_eq!(times(CONE, vec3(-3.0, 2.0, 0.0), Vec3::X), []);
        // Along the slope of the side.
        assert_eq!(times(CONE, vec3(0.0, -3.0, 0.0), vec3(0.25, 2.0, 0.0)).len(), 2);
    }

    /// Every point in the box is inside exactly if a ray from it leaves without entering.
    #[test]
    fn rays_agree_with_the_inside() {
        let bodies = [
            CONE,
            Frustum { bottom_radius: 0.0, top_radius: 0.7, height: 1.0, capped: true },
            Frustum { bottom_radius: 0.4, top_radius: 1.1, height: 1.5, capped: true },
            Frustum { bottom_radius: 0.8, top_radius: 0.8, height: 0.6, capped: true },
        ];
        let mut state = 7_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f32 / (1 << 24) as f32 * 2.4 - 1.2
        };
        for body in bodies {
            let mut inside = 0;
            for _ in 0..4000 {
                let point = vec3(random(), random(), random());
                let direction = vec3(random(), random(), random());
                let ends = body.crossings(&Ray::new(point, direction));
                let part = (point.y / body.height) + 0.5;
                let radius = body.bottom_radius + (body.top_radius - body.bottom_radius) * part;
                let is_inside =
                    (0.0..=1.0).contains(&part) && (point.x * point.x + point.z * point.z).sqrt() < radius;
                assert_eq!(ends[0].is_none() && ends[1].is_some(), is_inside, "{body:?} {point} {direction}");
                inside += usize::from(is_inside);
            }
            assert!(inside > 100);
        }
    }
}
