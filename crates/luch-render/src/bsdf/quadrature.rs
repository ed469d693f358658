//! Deterministic integrals over the visible normals.

use super::microfacet::Ggx;
use glam::{Vec2, Vec3};
use std::f64::consts::PI;

/// A quadrature rule over the normals that are visible from a direction: Gauss–Legendre along the height of the spherical cap of
/// [`Ggx::sample_visible`], midpoints around it. Half of the circle suffices, as an integrand that depends on angles to the surface
/// normal and to `outgoing` alone is even.
pub(super) struct VisibleNormals {
    /// Points of the half circle.
    around: Vec<Vec2>,
    /// Places between the top of the cap (0) and its rim (1).
    heights: Vec<Node>,
}

impl VisibleNormals {
    /// A rule of `count` × `count` points.
    pub(super) fn new(count: usize) -> Self {
        let around = (0..count)
            .map(|step| {
                let angle = std::f32::consts::PI * (step as f32 + 0.5) / count as f32;
                let (sine, cosine) = libm::sincosf(angle);
                Vec2::new(cosine, sine)
            })
            .collect();
        // Graded towards the rim, p = 1 − (1 − v)³: there the normals of a narrow distribution turn quickly.
        let heights = gauss_legendre(count)
            .into_iter()
            .map(|Node { position, weight }| {
                let left = 1.0 - position;
                Node { position: 1.0 - left * left * left, weight: weight * 3.0 * left * left }
            })
            .collect();
        Self { around, heights }
    }

    /// The mean of `f` over the normals visible from `outgoing`, which lies in the xz plane.
    pub(super) fn mean(&self, ggx: Ggx, outgoing: Vec3, f: impl Fn(Vec3) -> f32) -> f32 {
        self.mean_above(ggx, outgoing, |_| 1.0, f)
    }

    /// The same for an `f` that has a kink where `height_above` changes its sign: both parts of each meridian are integrated apart.
    pub(super) fn mean_above(
        &self,
        ggx: Ggx,
        outgoing: Vec3,
        height_above: impl Fn(Vec3) -> f32,
        f: impl Fn(Vec3) -> f32,
    ) -> f32 {
        let mut sum = 0.0;
        for &around in &self.around {
            let normal = |place: f64| ggx.visible_normal(outgoing, around, place as f32);
            let break_at = change_of_sign(|place| f64::from(height_above(normal(place))));
            for (start, length) in [(0.0, break_at), (break_at, 1.0 - break_at)] {
                if length > 0.0 {
                    for node in &self.heights {
                        sum += length * node.weight * f64::from(f(normal(start + length * node.position)));
                    }
                }
            }
        }
        (sum / self.around.len() as f64) as f32
    }
}

/// A place where `f`, positive at 0, becomes negative, or 1: halving, then one step of the secant rule.
fn change_of_sign(f: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    let (mut low_value, mut high_value) = (f(low), f(high));
    if high_value >= 0.0 {
        return 1.0;
    }
    for _ in 0..18 {
        let middle = 0.5 * (low + high);
        let value = f(middle);
        if value >= 0.0 {
            (low, low_value) = (middle, value);
        } else {
            (high, high_value) = (middle, value);
        }
    }
    low + (high - low) * (low_value / (low_value - high_value)).clamp(0.0, 1.0)
}

/// A node of a rule on 0 to 1; the weights add to 1.
struct Node {
    position: f64,
    weight: f64,
}

/// Gauss–Legendre nodes by Newton's method on the Legendre polynomial.
fn gauss_legendre(count: usize) -> Vec<Node> {
    (0..count)
        .map(|index| {
            let mut x = libm::cos(PI * (index as f64 + 0.75) / (count as f64 + 0.5));
            let mut slope = 1.0;
            for _ in 0..8 {
                let (mut previous, mut value) = (1.0, x);
                for degree in 2..=count {
                    let n = degree as f64;
                    (previous, value) = (value, ((2.0 * n - 1.0) * x * value - (n - 1.0) * previous) / n);
                }
                slope = count as f64 * (x * value - previous) / (x * x - 1.0);
                x -= value / slope;
            }
            Node { position: 0.5 * (1.0 - x), weight: 1.0 / ((1.0 - x * x) * slope * slope) }
        })
        .collect()
}
