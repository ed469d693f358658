//! Lambert: the same radiance in every direction, on the side of the viewer.

use super::{BsdfSample, BsdfValue, flip, same_side};
use glam::Vec3;
use luch_image::Rgb;
use luch_sampling::warp::cosine_hemisphere;
use std::f32::consts::FRAC_1_PI;

/// A Lambertian reflector; both sides alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Diffuse {
    color: Rgb,
}

impl Diffuse {
    /// A reflector that scatters back the fraction `color`, 0 to 1.
    pub fn new(color: Rgb) -> Self {
        Self { color }
    }

    /// The albedo.
    pub fn color(&self) -> Rgb {
        self.color
    }

    pub(super) fn evaluate(&self, outgoing: Vec3, incoming: Vec3) -> BsdfValue {
        if !same_side(outgoing, incoming) {
            return BsdfValue::NONE;
        }
        let pdf = incoming.z.abs() * FRAC_1_PI;
        BsdfValue { value: self.color * pdf, pdf }
    }

    pub(super) fn sample(&self, outgoing: Vec3, u: [f32; 2]) -> Option<BsdfSample> {
        let above = cosine_hemisphere(u);
        let incoming = if outgoing.z < 0.0 { flip(above) } else { above };
        self.evaluate(outgoing, incoming).drawn(incoming)
    }
}
