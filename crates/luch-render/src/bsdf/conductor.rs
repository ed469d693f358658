//! Metals and mirrors: GGX facets with the light of further bounces put back.
//!
//! Value of a rough one: F D G₂ / (4 cos o) plus the lobe of Kulla and Conty,
//! (1 − E(o)) (1 − E(i)) / (π (1 − Ē)) · cos i times F̄² Ē / (1 − F̄ (1 − Ē)), where E is the single-bounce albedo at reflectance 1,
//! Ē its mean and F̄ the mean of Fresnel's reflectance. At F = 1 the albedo is 1 for every roughness. Both sides alike.
//! The second lobe can be left out, for scenes that were made for renderers without it.

use super::albedo::CompensatedGgx;
use super::fresnel::{
    conductor_reflectance, conductor_reflectance_mean, schlick_reflectance, schlick_reflectance_mean,
};
use super::{BsdfSample, BsdfValue, flip, mirror, same_side};
use glam::Vec3;
use luch_image::Rgb;
use luch_sampling::warp::cosine_hemisphere;
use std::f32::consts::{FRAC_1_PI, PI};

/// What a single facet of a metal reflects. Worth making once per material: [`ConductorFresnel::from_index`] integrates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ConductorFresnel {
    /// Exact, from the complex index η + i k.
    Index {
        /// Real part.
        eta: Rgb,
        /// Imaginary part.
        k: Rgb,
        /// Mean reflectance over the hemisphere.
        mean: Rgb,
    },
    /// Schlick's formula from the reflectance at normal incidence to 1.
    Schlick {
        /// Reflectance at normal incidence.
        f0: Rgb,
    },
}

impl ConductorFresnel {
    /// A metal of complex index `eta` + i `k`.
    pub fn from_index(eta: Rgb, k: Rgb) -> Self {
        let mean = Rgb::new(
            conductor_reflectance_mean(eta.r, k.r),
            conductor_reflectance_mean(eta.g, k.g),
            conductor_reflectance_mean(eta.b, k.b),
        );
        Self::Index { eta, k, mean }
    }

    /// A metal of colour `f0` at normal incidence.
    pub fn from_color(f0: Rgb) -> Self {
        Self::Schlick { f0 }
    }

    /// Reflectance at an angle.
    pub fn reflectance(&self, cosine: f32) -> Rgb {
        match *self {
            Self::Index { eta, k, .. } => Rgb::new(
                conductor_reflectance(cosine, eta.r, k.r),
                conductor_reflectance(cosine, eta.g, k.g),
                conductor_reflectance(cosine, eta.b, k.b),
            ),
            Self::Schlick { f0 } => schlick_reflectance(cosine, f0, 1.0),
        }
    }

    /// Mean reflectance over the hemisphere.
    pub fn mean(&self) -> Rgb {
        match *self {
            Self::Index { mean, .. } => mean,
            Self::Schlick { f0 } => schlick_reflectance_mean(f0, 1.0),
        }
    }
}

/// A metal or mirror.
#[derive(Clone, Copy, Debug)]
pub struct Conductor {
    fresnel: ConductorFresnel,
    lobe: Option<CompensatedGgx>,
    compensated: bool,
}

impl Conductor {
    /// A metal of perceptual `roughness`, 0 (mirror) to 1; the GGX width is its square.
    pub fn new(fresnel: ConductorFresnel, roughness: f32) -> Self {
        Self { fresnel, lobe: CompensatedGgx::from_roughness(roughness), compensated: true }
    }

    /// The same metal, whose light bounces once: what a single bounce loses is lost.
    pub fn uncompensated(self) -> Self {
        Self { compensated: false, ..self }
    }

    /// Width and complex index of a rough metal whose light bounces once.
    pub(crate) fn single_bounce(&self) -> Option<(f32, Rgb, Rgb)> {
        match (&self.lobe, self.fresnel) {
            (Some(lobe), ConductorFresnel::Index { eta, k, .. }) if !self.compensated => {
                Some((lobe.ggx.alpha(), eta, k))
            }
            _ => None,
        }
    }

    pub(super) fn is_smooth(&self) -> bool {
        self.lobe.is_none()
    }

    pub(super) fn albedo(&self) -> Rgb {
        self.fresnel.mean()
    }

    pub(super) fn evaluate(&self, outgoing: Vec3, incoming: Vec3) -> BsdfValue {
        let Some(lobe) = &self.lobe else { return BsdfValue::NONE };
        if !same_side(outgoing, incoming) {
            return BsdfValue::NONE;
        }
        if outgoing.z < 0.0 {
            return self.evaluate(flip(outgoing), flip(incoming));
        }
        let normal = (outgoing + incoming).normalize_or_zero();
        let single = 0.25 * lobe.ggx.density(normal) * lobe.ggx.visibility(outgoing, incoming) * incoming.z;
        if !self.compensated {
            let value = self.fresnel.reflectance(outgoing.dot(normal)) * single;
            return BsdfValue { value, pdf: 0.25 * lobe.ggx.visible_density(outgoing, normal) };
        }
        let outgoing_missing = lobe.missing(outgoing.z);
        let multiple = compensation_lobe(lobe, outgoing_missing, lobe.missing(incoming.z)) * incoming.z;
        let value = self.fresnel.reflectance(outgoing.dot(normal)) * single
            + compensation_color(lobe, self.fresnel.mean()) * multiple;
        let pdf = (1.0 - outgoing_missing) * 0.25 * lobe.ggx.visible_density(outgoing, normal)
            + outgoing_missing * incoming.z * FRAC_1_PI;
        BsdfValue { value, pdf }
    }

    pub(super) fn sample(&self, outgoing: Vec3, u: [f32; 2], choice: f32) -> Option<BsdfSample> {
        let Some(lobe) = &self.lobe else {
            let reflectance = self.fresnel.reflectance(outgoing.z.abs());
            return BsdfSample::checked(mirror(outgoing), reflectance, 1.0, true);
        };
        let upper = if outgoing.z < 0.0 { flip(outgoing) } else { outgoing };
        let incoming = if self.compensated && choice < lobe.missing(upper.z) {
            cosine_hemisphere(u)
        } else {
            reflect_visible(lobe, upper, u)
        };
        let incoming = if outgoing.z < 0.0 { flip(incoming) } else { incoming };
        self.evaluate(outgoing, incoming).drawn(incoming)
    }
}

/// The mirror image of `outgoing` (upper side) in a visible normal.
pub(super) fn reflect_visible(lobe: &CompensatedGgx, outgoing: Vec3, u: [f32; 2]) -> Vec3 {
    let normal = lobe.ggx.sample_visible(outgoing, u);
    (2.0 * outgoing.dot(normal) * normal - outgoing).normalize_or_zero()
}

/// (1 − E(o)) (1 − E(i)) / (π (1 − Ē)): what a single bounce lost, spread over the hemisphere; cos i is left out.
pub(super) fn compensation_lobe(lobe: &CompensatedGgx, outgoing_missing: f32, incoming_missing: f32) -> f32 {
    outgoing_missing * incoming_missing / (PI * lobe.missing_mean()).max(f32::MIN_POSITIVE)
}

/// The colour of light that bounced more than once: the geometric series F̄² Ē Σ (F̄ (1 − Ē))ⁿ.
pub(super) fn compensation_color(lobe: &CompensatedGgx, mean_reflectance: Rgb) -> Rgb {
    let missing = lobe.missing_mean();
    mean_reflectance.map(|mean| mean * mean * (1.0 - missing) / (1.0 - mean * missing))
}
