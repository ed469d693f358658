//! Surfaces where a formula is zero. Roots along rays are found by interval arithmetic, so that the first one is the first.

use glam::{Vec2, Vec3};
use luch_bvh::{Aabb, Crossing, Ray, SlabRay, Traced, TracedHit};
use luch_formula::{FirstRoot, RootFinder, Tape};
use luch_scene::Implicit;
use std::sync::Arc;

/// Roots are right to this part of the size of the box.
const TOLERANCE: f64 = 1e-9;
/// Roots that round to a place before the ray are passed over; more in a row are those of noise.
const MOST_PASSED: usize = 64;

/// The ray test of a formula.
#[derive(Debug)]
pub(super) struct Tracer {
    /// `None` for a formula with mistakes, which is never met.
    tape: Option<Arc<Tape>>,
    bounds: Aabb,
}

impl Tracer {
    pub(super) fn new(surface: &Implicit) -> Self {
        // A closed surface has walls in the sides of the box.
        let [low, high] = surface.corners();
        let room = (high - low) * 1e-4;
        Self { tape: surface.tape().cloned(), bounds: Aabb { min: low - room, max: high + room } }
    }
}

impl Traced for Tracer {
    fn bounds(&self) -> Aabb {
        self.bounds
    }

    fn nearest(&self, ray: &Ray) -> Option<TracedHit> {
        let tape = self.tape.as_deref()?;
        let interval = SlabRay::new(ray)?.interval(&self.bounds)?;
        let (origin, direction) = (wide(ray.origin), wide(ray.direction));
        let length = direction.iter().map(|d| d * d).sum::<f64>().sqrt();
        let tolerance = TOLERANCE * f64::from((self.bounds.max - self.bounds.min).length()) / length;
        let mut finder = RootFinder::new(tape, tolerance);
        // What rounds to the start of the ray may lie a little before it.
        let mut from = f64::from(interval.near) - f64::from(interval.near.abs()) * 1e-7;
        let to = f64::from(interval.far) + f64::from(interval.far.abs()) * 1e-7;
        for _ in 0..MOST_PASSED {
            let root = match finder.first(&origin, &direction, from, to) {
                FirstRoot::Crossing(t) | FirstRoot::Touching(t) | FirstRoot::Jump(t) => t,
                FirstRoot::None | FirstRoot::Exhausted(_) => return None,
            };
            let t = root as f32 + 0.0;
            if t > ray.t_max {
                return None;
            }
            if t >= ray.t_min {
                let front = is_outside_before(tape, origin, direction, root, 4.0 * tolerance);
                return Some(TracedHit { crossing: Crossing { t, u: 0.0, v: 0.0, front }, primitive: 0 });
            }
            from = root + 2.0 * tolerance;
        }
        None
    }
}

/// Whether the ray comes from outside: the formula is larger a little before the root than behind it.
fn is_outside_before(tape: &Tape, origin: [f64; 3], direction: [f64; 3], root: f64, step: f64) -> bool {
    let value = |t: f64| tape.value(&[0, 1, 2].map(|axis| origin[axis] + direction[axis] * t));
    value(root - step) >= value(root + step)
}

fn wide(vector: Vec3) -> [f64; 3] {
    vector.to_array().map(f64::from)
}

/// The point of the surface near a place: two steps of Newton along the gradient.
pub(super) fn point(surface: &Implicit, near: Vec3) -> Vec3 {
    let Some(tape) = surface.tape() else { return near };
    let [low, high] = surface.corners();
    // Farther off than rounding can explain is no correction.
    let most = f64::from((high - low).length()) * 1e-4;
    let mut place = wide(near);
    for _ in 0..2 {
        let mut gradient = [0.0; 3];
        let value = tape.gradient(&place, &mut gradient);
        let squared: f64 = gradient.iter().map(|g| g * g).sum();
        let step = value / squared;
        let length = step.abs() * squared.sqrt();
        if length.is_nan() || length > most {
            break;
        }
        for axis in 0..3 {
            place[axis] -= gradient[axis] * step;
        }
    }
    Vec3::from_array(place.map(|coordinate| coordinate as f32))
}

/// The gradient, which points outward.
pub(super) fn normal(surface: &Implicit, point: Vec3) -> Vec3 {
    let Some(tape) = surface.tape() else { return Vec3::Y };
    let mut gradient = [0.0; 3];
    tape.gradient(&wide(point), &mut gradient);
    let largest = gradient.iter().fold(0.0_f64, |most, g| most.max(g.abs()));
    // Scaled, so that it neither vanishes nor overflows in single precision.
    let normal = Vec3::from_array(gradient.map(|g| (g / largest) as f32));
    if normal.is_finite() { normal } else { Vec3::Y }
}

/// From 0 to 1 over the front of the box.
pub(super) fn uv(surface: &Implicit, point: Vec3) -> Vec2 {
    let [low, high] = surface.corners();
    ((point - low) / (high - low)).truncate()
}

pub(super) fn uv_step(surface: &Implicit, step: Vec3) -> Vec2 {
    let [low, high] = surface.corners();
    (step / (high - low)).truncate()
}
