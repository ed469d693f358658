//! Modified Phong: a diffuse part and a cosine lobe about the mirror direction.
//!
//! Lafortune and Willems, *Using the modified Phong reflectance model for physically based rendering*, 1994:
//! f = diffuse / π + specular (n + 2) / 2π cosⁿα, with α between `incoming` and the mirror image of `outgoing`. The lobe's albedo is
//! `specular` at normal incidence and falls towards grazing, where the horizon cuts it. Both sides alike.

use super::{BsdfSample, BsdfValue, flip, mirror, same_side};
use glam::Vec3;
use luch_image::Rgb;
use luch_sampling::warp::cosine_hemisphere;
use std::f32::consts::{FRAC_1_PI, TAU};

/// Largest exponent: beyond it single precision cannot tell the lobe from a mirror.
const MAX_EXPONENT: f32 = 1e6;

/// Diffuse plus cosine lobe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phong {
    diffuse: Rgb,
    specular: Rgb,
    exponent: f32,
    specular_probability: f32,
}

impl Phong {
    /// `diffuse` + `specular` should not pass 1 in any channel; `exponent` is kept in 0 to 10⁶.
    pub fn new(diffuse: Rgb, specular: Rgb, exponent: f32) -> Self {
        let total = diffuse.mean() + specular.mean();
        let specular_probability = if total > 0.0 { specular.mean() / total } else { 0.0 };
        Self { diffuse, specular, exponent: exponent.clamp(0.0, MAX_EXPONENT), specular_probability }
    }

    pub(super) fn albedo(&self) -> Rgb {
        self.diffuse + self.specular
    }

    pub(super) fn evaluate(&self, outgoing: Vec3, incoming: Vec3) -> BsdfValue {
        if !same_side(outgoing, incoming) {
            return BsdfValue::NONE;
        }
        let cosine = incoming.z.abs();
        // cos α = 1 − |i − m|² / 2 keeps the digits that the scalar product loses for narrow lobes.
        let half_chord = (incoming - mirror(outgoing)).length_squared() * 0.5;
        let power =
            if half_chord < 1.0 { libm::expf(self.exponent * libm::log1pf(-half_chord)) } else { 0.0 };
        // At exponent 0 the lobe is a constant over the whole hemisphere about the mirror direction.
        let lobe = power / TAU;
        let diffuse_pdf = cosine * FRAC_1_PI;
        let pdf = diffuse_pdf * (1.0 - self.specular_probability)
            + (self.exponent + 1.0) * lobe * self.specular_probability;
        let value = self.diffuse * diffuse_pdf + self.specular * ((self.exponent + 2.0) * lobe * cosine);
        BsdfValue { value, pdf }
    }

    pub(super) fn sample(&self, outgoing: Vec3, u: [f32; 2], choice: f32) -> Option<BsdfSample> {
        let upper = if outgoing.z < 0.0 { flip(outgoing) } else { outgoing };
        let above = if choice < self.specular_probability {
            self.sample_lobe(mirror(upper), u)
        } else {
            cosine_hemisphere(u)
        };
        let incoming = if outgoing.z < 0.0 { flip(above) } else { above };
        self.evaluate(outgoing, incoming).drawn(incoming)
    }

    /// cos α = u^{1/(n+1)} about `axis`.
    fn sample_lobe(&self, axis: Vec3, u: [f32; 2]) -> Vec3 {
        let below_one = -libm::expm1f(libm::logf(1.0 - u[0]) / (self.exponent + 1.0));
        let radius = (below_one * (2.0 - below_one)).max(0.0).sqrt();
        let (sine, cosine) = libm::sincosf(TAU * u[1]);
        let (tangent, bitangent) = axis.any_orthonormal_pair();
        let direction = tangent * (radius * cosine) + bitangent * (radius * sine) + axis * (1.0 - below_one);
        direction.normalize_or_zero()
    }
}

#[cfg(test)]
mod tests;
