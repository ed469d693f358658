//! Glass and water: reflection and refraction by Fresnel's exact formulas, smooth or with GGX facets.
//!
//! The rough form is that of Walter et al. 2007 with visible normals and the masking 1 / (1 + Λ(o) + Λ(i)) for both parts. The light
//! that a single scattering loses is put back on both sides; see `interface.rs`. Refracted radiance carries (η_o / η_i)².

use super::fresnel::{dielectric_reflectance, reflectance_of_cosines};
use super::interface::{CompensatedInterface, Crossing};
use super::{BsdfSample, BsdfValue, flip, mirror};
use glam::Vec3;
use luch_image::Rgb;
use luch_sampling::warp::cosine_hemisphere;
use std::f32::consts::FRAC_1_PI;

/// Indices nearer to 1 than this do not scatter: a rough interface is taken as smooth.
const INDEX_MATCHED: f32 = 5e-3;

/// An interface between two clear media.
#[derive(Clone, Copy, Debug)]
pub struct Dielectric {
    ior: f32,
    tint: Rgb,
    rough: Option<CompensatedInterface>,
}

impl Dielectric {
    /// `ior` is the index of the inside over the outside, kept in 0.1 to 10; `roughness` is perceptual, 0 (polished) to 1; `tint`
    /// multiplies what is refracted, once per crossing.
    pub fn new(ior: f32, roughness: f32, tint: Rgb) -> Self {
        let ior = ior.clamp(0.1, 10.0);
        let matched = (ior - 1.0).abs() < INDEX_MATCHED;
        let rough = if matched { None } else { CompensatedInterface::new(ior, roughness) };
        Self { ior, tint, rough }
    }

    /// Index of the inside over the outside.
    pub fn ior(&self) -> f32 {
        self.ior
    }

    pub(super) fn is_smooth(&self) -> bool {
        self.rough.is_none()
    }

    pub(super) fn albedo(&self) -> Rgb {
        let reflected = dielectric_reflectance(1.0, self.ior);
        Rgb::gray(reflected) + self.tint * (1.0 - reflected)
    }

    pub(super) fn evaluate(&self, outgoing: Vec3, incoming: Vec3) -> BsdfValue {
        let Some(rough) = &self.rough else { return BsdfValue::NONE };
        if outgoing.z < 0.0 {
            self.evaluate_rough(rough, rough.inward(), flip(outgoing), flip(incoming))
        } else {
            self.evaluate_rough(rough, rough.outward(), outgoing, incoming)
        }
    }

    /// `outgoing` is on the upper side, `crossing` belongs to that side.
    fn evaluate_rough(
        &self,
        rough: &CompensatedInterface,
        crossing: Crossing,
        outgoing: Vec3,
        incoming: Vec3,
    ) -> BsdfValue {
        let missing = rough.missing(crossing.near, outgoing.z);
        let single_probability = 1.0 - missing;
        if incoming.z > 0.0 {
            let normal = (outgoing + incoming).normalize_or_zero();
            let reflectance = dielectric_reflectance(outgoing.dot(normal), crossing.eta);
            let single = 0.25
                * rough.ggx.density(normal)
                * rough.ggx.visibility(outgoing, incoming)
                * incoming.z
                * reflectance;
            let multiple = missing * rough.missing(crossing.near, incoming.z) * crossing.same * incoming.z;
            let pdf = single_probability * reflectance * 0.25 * rough.ggx.visible_density(outgoing, normal)
                + missing * (1.0 - crossing.probability) * incoming.z * FRAC_1_PI;
            return BsdfValue { value: Rgb::gray(single + multiple), pdf };
        }
        let cosine = -incoming.z;
        let scale = 1.0 / (crossing.eta * crossing.eta);
        let multiple = missing * rough.missing(crossing.far, cosine) * crossing.across * cosine * scale;
        let mut value = multiple;
        let mut pdf = missing * crossing.probability * cosine * FRAC_1_PI;
        let half = (outgoing + incoming * crossing.eta).normalize_or_zero();
        let normal = if half.z < 0.0 { -half } else { half };
        let (near, far) = (outgoing.dot(normal), incoming.dot(normal));
        if near > 0.0 && far < 0.0 {
            let transmittance = 1.0 - reflectance_of_cosines(near, -far, crossing.eta);
            let denominator = near + crossing.eta * far;
            let jacobian = -far / (denominator * denominator);
            let facets = rough.ggx.density(normal) * rough.ggx.visibility(outgoing, flip(incoming));
            value += transmittance * near * jacobian * facets * cosine;
            pdf += single_probability
                * transmittance
                * near
                * jacobian
                * crossing.eta
                * crossing.eta
                * rough.ggx.visible_density(outgoing, normal);
        }
        BsdfValue { value: self.tint * value, pdf }
    }

    pub(super) fn sample(&self, outgoing: Vec3, u: [f32; 2], choice: f32) -> Option<BsdfSample> {
        let from_inside = outgoing.z < 0.0;
        let upper = if from_inside { flip(outgoing) } else { outgoing };
        let side = |incoming: Vec3| if from_inside { flip(incoming) } else { incoming };
        let Some(rough) = &self.rough else {
            let eta = if from_inside { 1.0 / self.ior } else { self.ior };
            let reflectance = dielectric_reflectance(upper.z, eta);
            if choice < reflectance {
                return BsdfSample::checked(mirror(outgoing), Rgb::gray(reflectance), reflectance, true);
            }
            let incoming = side(refract(upper, Vec3::Z, eta)?);
            let transmittance = 1.0 - reflectance;
            return BsdfSample::checked(
                incoming,
                self.tint * (transmittance / (eta * eta)),
                transmittance,
                true,
            );
        };
        let crossing = if from_inside { rough.inward() } else { rough.outward() };
        let missing = rough.missing(crossing.near, upper.z);
        let incoming = if choice < missing {
            let above = cosine_hemisphere(u);
            if choice < missing * crossing.probability { flip(above) } else { above }
        } else {
            sample_single(rough, crossing.eta, upper, u, (choice - missing) / (1.0 - missing))?
        };
        let incoming = side(incoming);
        self.evaluate(outgoing, incoming).drawn(incoming)
    }
}

/// One reflection or refraction at a visible normal; `None` if it does not leave the surface by that alone.
fn sample_single(
    rough: &CompensatedInterface,
    eta: f32,
    outgoing: Vec3,
    u: [f32; 2],
    choice: f32,
) -> Option<Vec3> {
    let normal = rough.ggx.sample_visible(outgoing, u);
    let facet_cosine = outgoing.dot(normal);
    if choice < dielectric_reflectance(facet_cosine, eta) {
        let reflected = (2.0 * facet_cosine * normal - outgoing).normalize_or_zero();
        (reflected.z > 0.0).then_some(reflected)
    } else {
        refract(outgoing, normal, eta).filter(|refracted| refracted.z < 0.0)
    }
}

/// The direction from which light is refracted into `outgoing` at `normal`; `eta` is the far index over the near one.
pub(super) fn refract(outgoing: Vec3, normal: Vec3, eta: f32) -> Option<Vec3> {
    let cosine = outgoing.dot(normal);
    let far_cosine2 = 1.0 - (1.0 - cosine * cosine).max(0.0) / (eta * eta);
    if far_cosine2 <= 0.0 {
        return None;
    }
    let tangential = (normal * cosine - outgoing) / eta;
    Some((tangential - normal * far_cosine2.sqrt()).normalize_or_zero())
}

#[cfg(test)]
mod tests;
