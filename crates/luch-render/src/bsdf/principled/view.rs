//! What the principled model looks like from one angle, and how often each lobe is sampled there.

use super::Principled;
use crate::bsdf::fresnel::schlick_reflectance_mean;
use luch_image::Rgb;

/// Shares that depend on the viewer's angle alone. The probabilities of the lobes are their albedos, scaled to a sum of 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    /// Share that one bounce on the facets loses at reflectance 1.
    pub(super) missing: f32,
    /// Share of light that reaches the base between the facets of the dielectric.
    pub(super) reached: Rgb,
    /// Probability of the solid clear body.
    pub(super) body: f32,
    /// Probability of reflection by facets.
    pub(super) facets: f32,
    /// Probability of straight transmission between facets.
    pub(super) through: f32,
    /// Probability of everything smooth on the far side.
    pub(super) cosine_through: f32,
    /// Probability of everything smooth on the near side.
    pub(super) cosine: f32,
}

impl View {
    pub(super) fn new(surface: &Principled, cosine: f32) -> Self {
        let base = surface.base_color;
        let bounce = surface.bounce(cosine);
        let coat = bounce.albedo(surface.f0, surface.f90);
        let reached = Rgb::WHITE - coat;
        let passed_mean = Rgb::WHITE - schlick_reflectance_mean(surface.f0, surface.f90);
        let mut facets = coat * (surface.opaque + surface.thin);
        let mut smooth = base * reached * surface.opaque;
        if surface.metal > 0.0 {
            facets += bounce.albedo(base, 1.0) * surface.metal;
        }
        if let Some(lobe) = &surface.lobe {
            smooth += surface.compensation(lobe) * bounce.missing;
        }
        let through = (base * (reached - Rgb::gray(bounce.missing))).mean().max(0.0) * surface.thin;
        let cosine_through = (base * passed_mean).mean() * bounce.missing * surface.thin;
        let (facets, smooth) = (facets.mean(), smooth.mean());
        let sum = surface.solid + facets + through + cosine_through + smooth;
        let scale = if sum > 0.0 { 1.0 / sum } else { 0.0 };
        Self {
            missing: bounce.missing,
            reached,
            body: surface.solid * scale,
            facets: facets * scale,
            through: through * scale,
            cosine_through: cosine_through * scale,
            cosine: smooth * scale,
        }
    }
}
