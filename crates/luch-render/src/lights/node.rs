//! Eight groups of lights side by side, and how much light each may send to a receiver.

use super::bounds::LightBounds;
use glam::Vec3;

/// Children of a node.
pub(crate) const WIDTH: usize = 8;

/// A child that is an emitter has this bit set; the others are nodes.
pub(crate) const LEAF: u32 = 1 << 31;

/// Eight children by columns, so that a compiler weighs them in vector registers. Unused places have no intensity.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    center: [[f32; WIDTH]; 3],
    radius: [f32; WIDTH],
    /// What stands for the inverse squared distance within the ball.
    inside: [f32; WIDTH],
    axis: [[f32; WIDTH]; 3],
    cos_normals: [f32; WIDTH],
    sin_normals: [f32; WIDTH],
    cos_falloff: [f32; WIDTH],
    /// −1 if light leaves along the axis and against it, else 1.
    fold: [f32; WIDTH],
    intensity: [f32; WIDTH],
    pub(crate) children: [u32; WIDTH],
}

impl Node {
    /// A node without children.
    pub(crate) fn empty() -> Self {
        let zero = [0.0; WIDTH];
        Self {
            center: [zero; 3],
            radius: zero,
            inside: zero,
            axis: [zero; 3],
            cos_normals: zero,
            sin_normals: zero,
            cos_falloff: zero,
            fold: [1.0; WIDTH],
            intensity: zero,
            children: [0; WIDTH],
        }
    }

    /// Puts a child in its place.
    pub(crate) fn set(&mut self, lane: usize, bounds: &LightBounds, child: u32) {
        for i in 0..3 {
            self.center[i][lane] = bounds.center[i];
            self.axis[i][lane] = bounds.axis[i];
        }
        self.radius[lane] = bounds.radius;
        // A point has no inside.
        self.inside[lane] = 1.0 / (bounds.radius * bounds.radius).max(f32::MIN_POSITIVE);
        self.cos_normals[lane] = bounds.cos_normals;
        self.sin_normals[lane] = (1.0 - bounds.cos_normals * bounds.cos_normals).max(0.0).sqrt();
        self.cos_falloff[lane] = bounds.cos_falloff;
        self.fold[lane] = if bounds.two_sided { -1.0 } else { 1.0 };
        self.intensity[lane] = bounds.intensity;
        self.children[lane] = child;
    }

    /// The places that hold a child.
    pub(crate) fn used(&self) -> impl Iterator<Item = usize> {
        (0..WIDTH).filter(|&lane| self.intensity[lane] > 0.0)
    }

    /// Moves the places of child nodes.
    pub(crate) fn shift(&mut self, by: u32) {
        for (child, intensity) in self.children.iter_mut().zip(self.intensity) {
            if *child & LEAF == 0 && intensity > 0.0 {
                *child += by;
            }
        }
    }

    /// About the irradiance that each child sends to `from`: intensity over squared distance, times bounds of the cosines at the
    /// light and at the receiver (Conty Estevez and Kulla 2018, section 3.3; here with a ball in place of the box).
    ///
    /// `normal` is of unit length, or zero if light counts from whatever side it comes. Zero only if no light can arrive.
    #[inline(always)]
    pub(crate) fn importances(&self, from: Vec3, normal: Vec3) -> [f32; WIDTH] {
        /// Squared distance, in sizes of all the lights, below which a point light gets no stronger.
        const NEAREST: f32 = 1e-18;
        let least = if normal == Vec3::ZERO { 1.0 } else { 0.0 };
        let mut importances = [0.0; WIDTH];
        for (i, importance) in importances.iter_mut().enumerate() {
            let (x, y, z) =
                (self.center[0][i] - from.x, self.center[1][i] - from.y, self.center[2][i] - from.z);
            let squared = larger(x * x + y * y + z * z, NEAREST);
            let inverse = 1.0 / squared.sqrt();
            // The ball is seen under this angle.
            let sin_ball = self.radius[i] * inverse;
            let cos_ball = other_leg(sin_ball);
            // From the axis of the light to the receiver; past its normals and past all of its points.
            let along = -(self.axis[0][i] * x + self.axis[1][i] * y + self.axis[2][i] * z) * inverse;
            let cos_axis = larger(along, along * self.fold[i]);
            let sin_axis = other_leg(cos_axis);
            let (cos_n, sin_n) = (self.cos_normals[i], self.sin_normals[i]);
            let within = cos_axis >= cos_n;
            let cos_past = either(within, 1.0, cos_axis * cos_n + sin_axis * sin_n);
            let sin_past = either(within, 0.0, sin_axis * cos_n - cos_axis * sin_n);
            let cos_light = either(cos_past >= cos_ball, 1.0, cos_past * cos_ball + sin_past * sin_ball);
            let leaving = either(cos_light > self.cos_falloff[i], cos_light, 0.0);
            // From the receiver's normal to the nearest point of the ball.
            let up = (normal.x * x + normal.y * y + normal.z * z) * inverse;
            let cos_up = either(up >= cos_ball, 1.0, up * cos_ball + other_leg(up) * sin_ball);
            let arriving = larger(cos_up, least);
            let outside = self.radius[i] * self.radius[i] < squared;
            let seen = either(outside, leaving * arriving * (inverse * inverse), self.inside[i]);
            *importance = self.intensity[i] * seen;
        }
        importances
    }
}

/// One number or another, without a branch: that is what lets the compiler take several at a time.
#[inline(always)]
fn either(condition: bool, yes: f32, no: f32) -> f32 {
    let mask = u32::from(condition).wrapping_neg();
    f32::from_bits((yes.to_bits() & mask) | (no.to_bits() & !mask))
}

#[inline(always)]
fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// The sine of a cosine and the other way round.
#[inline(always)]
fn other_leg(x: f32) -> f32 {
    larger(1.0 - x * x, 0.0).sqrt()
}

/// The children's chances.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shares {
    /// Running sum of the importances.
    ends: [f64; WIDTH],
}

/// A child that was picked.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PickedLane {
    pub(crate) lane: usize,
    pub(crate) probability: f64,
    /// What is left of the number that chose, in [0, 1) and uniform again.
    pub(crate) rest: f64,
}

impl Shares {
    /// Chances in proportion to the importances.
    #[inline(always)]
    pub(crate) fn new(importances: [f32; WIDTH]) -> Self {
        let [a, b, c, d, e, f, g, h] = importances.map(f64::from);
        // In pairs, since each sum waits for the one before. Rounding keeps the order: no term is ever taken away.
        let (ab, cd, ef) = (a + b, c + d, e + f);
        let abcd = ab + cd;
        let ends = [a, ab, ab + c, abcd, abcd + e, abcd + ef, abcd + (ef + g), abcd + (ef + (g + h))];
        Self { ends }
    }

    /// Sum of the importances.
    #[inline(always)]
    pub(crate) fn total(&self) -> f64 {
        self.ends[WIDTH - 1]
    }

    #[inline(always)]
    fn start(&self, lane: usize) -> f64 {
        if lane == 0 { 0.0 } else { self.ends[lane - 1] }
    }

    /// Picks a child; `None` if no light arrives from any.
    #[inline(always)]
    pub(crate) fn pick(&self, choice: f64) -> Option<PickedLane> {
        let total = self.total();
        // Also false for what is not a number.
        if !(total > 0.0 && total.is_finite()) {
            return None;
        }
        let target = (choice * total).min(total.next_down());
        let lane = self.ends.iter().map(|&end| usize::from(end <= target)).sum::<usize>().min(WIDTH - 1);
        let (start, width) = (self.start(lane), self.ends[lane] - self.start(lane));
        let rest = ((target - start) / width).clamp(0.0, 1f64.next_down());
        Some(PickedLane { lane, probability: width / total, rest })
    }

    /// The chance of a child.
    #[inline(always)]
    pub(crate) fn probability(&self, lane: usize) -> f64 {
        let total = self.total();
        if total > 0.0 && total.is_finite() { (self.ends[lane] - self.start(lane)) / total } else { 0.0 }
    }
}
