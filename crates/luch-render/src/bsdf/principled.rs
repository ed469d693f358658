//! The metallic-roughness model of glTF 2.0 with KHR_materials_ior, _specular and _transmission.
//!
//! Three substances are mixed by weight:
//!
//! * *metal* (`metallic`): a [`super::Conductor`] of colour `base_color`.
//! * *opaque dielectric* ((1 − metallic)(1 − transmission)): GGX facets with Schlick's reflectance from
//!   f0 = ((ior − 1) / (ior + 1))² · specular_color (at most 1) · specular to f90 = specular, over a diffuse base. With E(μ) the albedo
//!   of the facets and Ē its mean, the base is base_color · (1 − E(o)) (1 − E(i)) / (π (1 − Ē)) (Kelemen and Szirmay-Kalos 2001): reciprocal,
//!   and a white base gives back exactly what the facets did not reflect. E is taken per channel.
//! * *clear dielectric* ((1 − metallic) transmission): a solid body is the [`super::Dielectric`] of `ior` and tint `base_color`, with Fresnel's
//!   exact reflectance; `specular` and `specular_color` do not change it. If `thin_walled`, the facets reflect as on the opaque dielectric,
//!   and what they do not reflect goes straight through, tinted: the transmitted lobe is the mirror image of the reflected one.
//!   What further bounces carry is restored on both sides by the lobe of Kulla and Conty.
//!
//! The metal, the opaque and the thin-walled dielectric are alike on both sides.

mod view;

use super::albedo::{Bounce, CompensatedGgx};
use super::conductor::{compensation_color, compensation_lobe, reflect_visible};
use super::fresnel::{schlick_reflectance, schlick_reflectance_mean, schlick_weight};
use super::{BsdfSample, BsdfValue, Dielectric, flip, mirror, same_side};
use glam::Vec3;
use luch_image::Rgb;
use luch_sampling::warp::cosine_hemisphere;
use std::f32::consts::FRAC_1_PI;
use view::View;

/// What a [`Principled`] is made of, at one point of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrincipledParameters {
    /// Albedo of the dielectric part, mirror colour of the metallic part, tint of transmission.
    pub base_color: Rgb,
    /// 0 dielectric, 1 metal.
    pub metallic: f32,
    /// Perceptual roughness, 0 to 1.
    pub roughness: f32,
    /// Index of refraction of the dielectric part.
    pub ior: f32,
    /// Part of the dielectric that lets light through instead of scattering it back, 0 to 1.
    pub transmission: f32,
    /// True if light goes through without being bent.
    pub thin_walled: bool,
    /// Strength of the dielectric reflection, 0 to 1.
    pub specular: f32,
    /// Colour of the dielectric reflection at normal incidence.
    pub specular_color: Rgb,
}

impl Default for PrincipledParameters {
    fn default() -> Self {
        Self {
            base_color: Rgb::WHITE,
            metallic: 0.0,
            roughness: 0.5,
            ior: 1.5,
            transmission: 0.0,
            thin_walled: false,
            specular: 1.0,
            specular_color: Rgb::WHITE,
        }
    }
}

/// Metal, plastic, glass and mixtures of them.
#[derive(Clone, Copy, Debug)]
pub struct Principled {
    base_color: Rgb,
    f0: Rgb,
    f90: f32,
    metal: f32,
    opaque: f32,
    thin: f32,
    /// Share of the solid clear body.
    solid: f32,
    lobe: Option<CompensatedGgx>,
    body: Option<Dielectric>,
}

impl Principled {
    /// The model at a point. Shares and roughness are kept in 0 to 1.
    pub fn new(parameters: PrincipledParameters) -> Self {
        let metal = parameters.metallic.clamp(0.0, 1.0);
        let clear = (1.0 - metal) * parameters.transmission.clamp(0.0, 1.0);
        let (thin, solid) = if parameters.thin_walled { (clear, 0.0) } else { (0.0, clear) };
        let amplitude = (parameters.ior - 1.0) / (parameters.ior + 1.0);
        let specular = parameters.specular.clamp(0.0, 1.0);
        Self {
            base_color: parameters.base_color,
            f0: (parameters.specular_color * (amplitude * amplitude)).map(|f0| f0.min(1.0) * specular),
            f90: specular,
            metal,
            opaque: (1.0 - metal) - clear,
            thin,
            solid,
            lobe: CompensatedGgx::from_roughness(parameters.roughness.clamp(0.0, 1.0)),
            body: (solid > 0.0)
                .then(|| Dielectric::new(parameters.ior, parameters.roughness, parameters.base_color)),
        }
    }

    pub(super) fn is_specular(&self) -> bool {
        self.lobe.is_none() && (self.opaque <= 0.0 || self.base_color.is_black())
    }

    pub(super) fn transmits(&self) -> bool {
        self.thin > 0.0 || self.solid > 0.0
    }

    pub(super) fn refraction_ior(&self) -> f32 {
        self.body.map_or(1.0, |body| body.ior())
    }

    pub(super) fn albedo(&self) -> Rgb {
        let coat = schlick_reflectance_mean(self.f0, self.f90);
        let dielectric = coat + self.base_color * (Rgb::WHITE - coat);
        self.base_color * self.metal + dielectric * (1.0 - self.metal)
    }

    pub(super) fn evaluate(&self, outgoing: Vec3, incoming: Vec3) -> BsdfValue {
        self.evaluate_from(&View::new(self, outgoing.z.abs()), outgoing, incoming)
    }

    fn evaluate_from(&self, view: &View, outgoing: Vec3, incoming: Vec3) -> BsdfValue {
        let upper = if outgoing.z < 0.0 { flip(outgoing) } else { outgoing };
        let mut result = if same_side(outgoing, incoming) {
            let incoming = if outgoing.z < 0.0 { flip(incoming) } else { incoming };
            self.evaluate_reflection(view, upper, incoming)
        } else if self.thin > 0.0 {
            // A thin wall shows the mirror image of the lobe that it reflects.
            let incoming = if outgoing.z < 0.0 { incoming } else { flip(incoming) };
            self.evaluate_thin(view, upper, incoming)
        } else {
            BsdfValue::NONE
        };
        if let Some(body) = &self.body {
            let inner = body.evaluate(outgoing, incoming);
            result.value += inner.value * self.solid;
            result.pdf += inner.pdf * view.body;
        }
        result
    }

    /// Reflection by facets, by further bounces, and by the base. Both directions are on the upper side.
    fn evaluate_reflection(&self, view: &View, outgoing: Vec3, incoming: Vec3) -> BsdfValue {
        let mut value = Rgb::BLACK;
        let mut pdf = view.cosine * incoming.z * FRAC_1_PI;
        if view.cosine == 0.0 && view.facets == 0.0 {
            return BsdfValue::NONE;
        }
        let left = self.bounce(incoming.z);
        if let Some(lobe) = &self.lobe {
            let normal = (outgoing + incoming).normalize_or_zero();
            let single = 0.25 * lobe.ggx.density(normal) * lobe.ggx.visibility(outgoing, incoming);
            value += self.facet_reflectance(outgoing.dot(normal)) * (single * incoming.z);
            pdf += view.facets * 0.25 * lobe.ggx.visible_density(outgoing, normal);
            if self.metal > 0.0 || self.thin > 0.0 {
                let lost = compensation_lobe(lobe, view.missing, left.missing) * incoming.z;
                value += self.compensation(lobe) * lost;
            }
        }
        if self.opaque > 0.0 {
            let left = Rgb::WHITE - left.albedo(self.f0, self.f90);
            let mean = Rgb::WHITE - self.bounce_mean().albedo(self.f0, self.f90);
            let shape = |reached: f32, left: f32, mean: f32| reached * left / mean.max(f32::MIN_POSITIVE);
            let base = Rgb::new(
                shape(view.reached.r, left.r, mean.r),
                shape(view.reached.g, left.g, mean.g),
                shape(view.reached.b, left.b, mean.b),
            );
            value += self.base_color * base * (self.opaque * FRAC_1_PI * incoming.z);
        }
        BsdfValue { value, pdf }
    }

    /// Transmission through a thin wall; `incoming` is mirrored to the upper side.
    fn evaluate_thin(&self, view: &View, outgoing: Vec3, incoming: Vec3) -> BsdfValue {
        let Some(lobe) = &self.lobe else { return BsdfValue::NONE };
        let normal = (outgoing + incoming).normalize_or_zero();
        let single = 0.25 * lobe.ggx.density(normal) * lobe.ggx.visibility(outgoing, incoming);
        let passed = Rgb::WHITE - schlick_reflectance(outgoing.dot(normal), self.f0, self.f90);
        let passed_mean = Rgb::WHITE - schlick_reflectance_mean(self.f0, self.f90);
        let lost = compensation_lobe(lobe, view.missing, lobe.missing(incoming.z));
        BsdfValue {
            value: self.base_color * (passed * single + passed_mean * lost) * (self.thin * incoming.z),
            pdf: view.through * 0.25 * lobe.ggx.visible_density(outgoing, normal)
                + view.cosine_through * incoming.z * FRAC_1_PI,
        }
    }

    pub(super) fn sample(&self, outgoing: Vec3, u: [f32; 2], choice: f32) -> Option<BsdfSample> {
        let upper = if outgoing.z < 0.0 { flip(outgoing) } else { outgoing };
        let side = |incoming: Vec3| if outgoing.z < 0.0 { flip(incoming) } else { incoming };
        let view = View::new(self, upper.z);
        let mut choice = choice;
        if choice < view.body {
            let inner = self.body?.sample(outgoing, u, (choice / view.body).min(ONE_BELOW))?;
            if inner.specular {
                let pdf = inner.pdf * view.body;
                return BsdfSample::checked(inner.incoming, inner.value * self.solid, pdf, true);
            }
            return self.evaluate_from(&view, outgoing, inner.incoming).drawn(inner.incoming);
        }
        choice -= view.body;
        let above = if choice < view.facets {
            let Some(lobe) = &self.lobe else {
                let value = self.facet_reflectance(upper.z);
                return BsdfSample::checked(mirror(outgoing), value, view.facets, true);
            };
            Some(reflect_visible(lobe, upper, u)).filter(|direction| direction.z > 0.0)?
        } else if choice < view.facets + view.through {
            let Some(lobe) = &self.lobe else {
                let passed = Rgb::WHITE - schlick_reflectance(upper.z, self.f0, self.f90);
                let value = self.base_color * passed * self.thin;
                return BsdfSample::checked(-outgoing, value, view.through, true);
            };
            flip(Some(reflect_visible(lobe, upper, u)).filter(|direction| direction.z > 0.0)?)
        } else if choice < view.facets + view.through + view.cosine_through {
            flip(cosine_hemisphere(u))
        } else {
            cosine_hemisphere(u)
        };
        let incoming = side(above);
        self.evaluate_from(&view, outgoing, incoming).drawn(incoming)
    }

    /// What a facet reflects, of metal and dielectric together, less the solid body.
    fn facet_reflectance(&self, cosine: f32) -> Rgb {
        schlick_reflectance(cosine, self.base_color, 1.0) * self.metal
            + schlick_reflectance(cosine, self.f0, self.f90) * (self.opaque + self.thin)
    }

    /// Colour of the light that further bounces bring back to the viewer's side.
    fn compensation(&self, lobe: &CompensatedGgx) -> Rgb {
        compensation_color(lobe, schlick_reflectance_mean(self.base_color, 1.0)) * self.metal
            + schlick_reflectance_mean(self.f0, self.f90) * self.thin
    }

    /// What facets give back in one bounce.
    fn bounce(&self, cosine: f32) -> Bounce {
        match &self.lobe {
            None => Bounce::smooth(schlick_weight(cosine)),
            Some(lobe) => lobe.bounce(cosine),
        }
    }

    /// Its mean over the hemisphere.
    fn bounce_mean(&self) -> Bounce {
        match &self.lobe {
            None => Bounce::smooth(1.0 / 21.0),
            Some(lobe) => lobe.bounce_mean(),
        }
    }
}

/// The largest number below 1.
const ONE_BELOW: f32 = 1.0 - f32::EPSILON / 2.0;

#[cfg(test)]
mod tests;
