//! Second points that reflect differently to everyone.
//!
//! What a diffuse second point sends to the first points is the same for all. What a glossy one sends is not; but light that
//! arrives there from one direction serves all of them, each with the value of the BSDF toward itself. Two directions are
//! known at each such point y: one that was sampled for light, ω_l, and one in which the path went on, ω_s. With w(m) the
//! share of path m in y (its density, zero where it does not see y, over the sum of all) and p_s(ω | m) the density with which
//! it had scattered at y into ω,
//!
//! ```text
//! q(ω) = Σ over m of w(m) · p_s(ω | m)
//! radiance of path k = w(k) · f/p (k → y) · [ f_y(ω_l → k) L(ω_l) / p_l · p_l² / (p_l² + q(ω_l)²)
//!                                          + f_y(ω_s → k) (E · q² / (p_l² + q²) + further light) / q(ω_s) ]
//! ```
//!
//! with E what a lamp met along ω_s sends. The weights are functions of y and ω alone, as multiple importance sampling asks.

use super::points::{LANES, Lanes, Vectors, at};
use super::scatterers::{Optics, Scattered};
use glam::Vec3;
use luch_bvh::simd::Task;
use luch_image::Rgb;

/// A second point of metal whose light bounces once.
#[derive(Clone, Debug)]
pub(super) struct Glint {
    pub(super) lane: usize,
    pub(super) optics: Optics,
    /// Of the shading frame, on the side that is seen.
    pub(super) normal: Vec3,
    pub(super) lit: Option<Lit>,
    /// Where the path went on.
    pub(super) way: Option<Vec3>,
    /// What it met there that shines, with the density of light sampling for it.
    pub(super) met: Vec<Met>,
    /// What it found later.
    pub(super) tail: Rgb,
}

/// Light that was sampled.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lit {
    pub(crate) direction: Vec3,
    /// Radiance over density.
    pub(crate) light: Rgb,
    /// Per solid angle.
    pub(crate) pdf: f32,
    /// Whether scattering cannot find it.
    pub(crate) delta: bool,
    /// Whether nothing stands between.
    pub(crate) is_free: bool,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Met {
    pub(super) light: Rgb,
    pub(super) pdf: f32,
}

/// Adds what a glint sends, by the shares `weights` of the first points, to `sums`.
pub(super) struct Gleam<'a> {
    pub(super) glint: &'a Glint,
    /// From the first points to the glint.
    pub(super) toward: &'a Vectors,
    pub(super) weights: &'a Lanes,
    pub(super) sums: &'a mut Vectors,
}

impl Task for Gleam<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { glint, toward, weights, sums } = self;
        let mut scattered = Scattered::default();
        if let Some(lit) = glint.lit.filter(|lit| lit.is_free) {
            let q = glint.scatter(toward, weights, lit.direction, &mut scattered);
            let ratio = q / lit.pdf;
            let weight = if lit.delta { 1.0 } else { 1.0 / (1.0 + ratio * ratio) };
            add(&scattered, weights, lit.light * weight, sums);
        }
        if let Some(way) = glint.way {
            let mut light = glint.tail;
            let found = !light.is_black() || !glint.met.is_empty();
            let q = if found { glint.scatter(toward, weights, way, &mut scattered) } else { 0.0 };
            if q > 0.0 {
                for met in &glint.met {
                    let ratio = met.pdf / q;
                    light += met.light * (1.0 / (1.0 + ratio * ratio));
                }
                add(&scattered, weights, light * (1.0 / q), sums);
            }
        }
    }
}

impl Glint {
    /// Whether any light is known to come from here.
    pub(super) fn sends(&self) -> bool {
        self.lit.is_some_and(|lit| lit.is_free)
            || (self.way.is_some() && (!self.tail.is_black() || !self.met.is_empty()))
    }

    /// What it scatters from a direction toward every first point; returns the mean density of that direction.
    #[inline(always)]
    fn scatter(&self, toward: &Vectors, weights: &Lanes, incoming: Vec3, scattered: &mut Scattered) -> f32 {
        for k in 0..LANES {
            let (value, pdf) = self.optics.reflected(self.normal, -at(toward, k), incoming);
            scattered.pdf[k] = pdf;
            for (channel, value) in scattered.value.iter_mut().zip(value) {
                channel[k] = value;
            }
        }
        // What a lane without a share scatters means nothing, and may not be a number.
        let part = |(weight, pdf): (&f32, &f32)| if *weight > 0.0 { weight * pdf } else { 0.0 };
        weights.iter().zip(&scattered.pdf).map(part).sum()
    }
}

#[inline(always)]
fn add(scattered: &Scattered, weights: &Lanes, light: Rgb, sums: &mut Vectors) {
    for (channel, light) in light.to_array().into_iter().enumerate() {
        for k in 0..LANES {
            let part = weights[k] * scattered.value[channel][k] * light;
            let counts = (weights[k] > 0.0) & (part < f32::INFINITY);
            sums[channel][k] += if counts { part } else { 0.0 };
        }
    }
}
