//! How a point of a surface scatters light.
//!
//! Directions are unit vectors in the local frame: +Z is the shading normal on the outside of the surface, whoever looks.
//! `outgoing` points to the viewer, `incoming` to where the light comes from. A *value* is f(outgoing, incoming) · |cos incoming|
//! for radiance; refraction scales it by the squared ratio of the indices, which cancels when light leaves a body again.
//!
//! | member | file | reciprocal | what it loses |
//! |---|---|---|---|
//! | [`Diffuse`] | `diffuse.rs` | yes | nothing |
//! | [`Conductor`] | `conductor.rs` | yes | nothing (compensated) |
//! | [`Dielectric`] | `dielectric.rs` | yes, as f / η² | nothing (compensated) |
//! | [`Principled`] | `principled.rs` | yes | nothing (compensated) |
//! | [`Phong`] | `phong.rs` | yes | what the lobe puts below the horizon |
//! | [`Glossy`] | `glossy.rs` | no | what the lobe puts below the horizon |

mod albedo;
mod conductor;
mod dielectric;
mod diffuse;
mod examples;
mod fresnel;
mod glossy;
mod interface;
mod microfacet;
mod phong;
mod principled;
mod quadrature;

pub use conductor::{Conductor, ConductorFresnel};
pub use dielectric::Dielectric;
pub use diffuse::Diffuse;
pub use fresnel::{
    conductor_reflectance, conductor_reflectance_mean, dielectric_reflectance, dielectric_reflectance_mean,
    schlick_reflectance, schlick_reflectance_mean,
};
pub use glossy::Glossy;
pub use microfacet::Ggx;
pub use phong::Phong;
pub use principled::{Principled, PrincipledParameters};

use glam::Vec3;
use luch_image::Rgb;

/// A direction drawn from a [`Bsdf`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BsdfSample {
    /// Where the light comes from.
    pub incoming: Vec3,
    /// f · |cos incoming|; for a delta lobe the number whose quotient by `pdf` is the throughput.
    pub value: Rgb,
    /// Density per solid angle of `incoming`; for a delta lobe the probability of the lobe.
    pub pdf: f32,
    /// True if the direction came from a delta lobe: no other strategy can find it.
    pub specular: bool,
}

impl BsdfSample {
    /// The only way to make a sample: `None` unless the density is positive and every number is finite.
    pub fn checked(incoming: Vec3, value: Rgb, pdf: f32, specular: bool) -> Option<Self> {
        let usable = pdf > 0.0 && pdf.is_finite() && value.is_finite() && incoming.is_finite();
        usable.then_some(Self { incoming, value, pdf, specular })
    }

    /// What light from `incoming` is multiplied by: value / pdf.
    pub fn weight(&self) -> Rgb {
        self.value / self.pdf
    }
}

/// What a [`Bsdf`] says of a pair of directions, delta lobes left out.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BsdfValue {
    /// f · |cos incoming|.
    pub value: Rgb,
    /// Density with which [`Bsdf::sample`] would draw `incoming`, per solid angle.
    pub pdf: f32,
}

impl BsdfValue {
    /// No light and no chance.
    pub const NONE: BsdfValue = BsdfValue { value: Rgb::BLACK, pdf: 0.0 };

    /// This value as a drawn sample.
    fn drawn(self, incoming: Vec3) -> Option<BsdfSample> {
        BsdfSample::checked(incoming, self.value, self.pdf, false)
    }
}

/// A scattering model with its parameters at one point.
#[derive(Clone, Copy, Debug)]
pub enum Bsdf {
    /// Swallows everything.
    Absorber,
    /// Lambert.
    Diffuse(Diffuse),
    /// Metal or mirror.
    Conductor(Conductor),
    /// Glass or water.
    Dielectric(Dielectric),
    /// Metallic-roughness model of glTF 2.0.
    Principled(Principled),
    /// Modified Phong.
    Phong(Phong),
    /// The lecture's tilted normal.
    Glossy(Glossy),
}

impl Bsdf {
    /// Value and density together, which share most of their work. Both are zero for delta lobes.
    pub fn evaluate(&self, outgoing: Vec3, incoming: Vec3) -> BsdfValue {
        if in_horizon(outgoing) || in_horizon(incoming) {
            return BsdfValue::NONE;
        }
        let result = match self {
            Bsdf::Absorber => BsdfValue::NONE,
            Bsdf::Diffuse(member) => member.evaluate(outgoing, incoming),
            Bsdf::Conductor(member) => member.evaluate(outgoing, incoming),
            Bsdf::Dielectric(member) => member.evaluate(outgoing, incoming),
            Bsdf::Principled(member) => member.evaluate(outgoing, incoming),
            Bsdf::Phong(member) => member.evaluate(outgoing, incoming),
            Bsdf::Glossy(member) => member.evaluate(outgoing, incoming),
        };
        // At the edge of single precision a density can vanish before its value does.
        if result.pdf > 0.0 { result } else { BsdfValue::NONE }
    }

    /// f(outgoing, incoming) · |cos incoming|, delta lobes left out.
    pub fn eval(&self, outgoing: Vec3, incoming: Vec3) -> Rgb {
        self.evaluate(outgoing, incoming).value
    }

    /// Density with which `sample` draws `incoming`, per solid angle, delta lobes left out.
    pub fn pdf(&self, outgoing: Vec3, incoming: Vec3) -> f32 {
        self.evaluate(outgoing, incoming).pdf
    }

    /// Draws a direction; `u` and `choice` are uniform in [0, 1). `choice` picks the lobe, `u` the direction in it.
    ///
    /// `None` means that this draw carries no light; it counts as a sample of value zero.
    pub fn sample(&self, outgoing: Vec3, u: [f32; 2], choice: f32) -> Option<BsdfSample> {
        if in_horizon(outgoing) {
            return None;
        }
        match self {
            Bsdf::Absorber => None,
            Bsdf::Diffuse(member) => member.sample(outgoing, u),
            Bsdf::Conductor(member) => member.sample(outgoing, u, choice),
            Bsdf::Dielectric(member) => member.sample(outgoing, u, choice),
            Bsdf::Principled(member) => member.sample(outgoing, u, choice),
            Bsdf::Phong(member) => member.sample(outgoing, u, choice),
            Bsdf::Glossy(member) => member.sample(outgoing, u),
        }
    }

    /// True if there are only delta lobes (or none at all): sampling the lights is useless.
    pub fn is_specular(&self) -> bool {
        match self {
            Bsdf::Absorber => true,
            Bsdf::Diffuse(_) | Bsdf::Phong(_) => false,
            Bsdf::Conductor(member) => member.is_smooth(),
            Bsdf::Dielectric(member) => member.is_smooth(),
            Bsdf::Principled(member) => member.is_specular(),
            Bsdf::Glossy(member) => member.is_mirror(),
        }
    }

    /// True if light can come through to the other side.
    pub fn transmits(&self) -> bool {
        match self {
            Bsdf::Dielectric(_) => true,
            Bsdf::Principled(member) => member.transmits(),
            _ => false,
        }
    }

    /// Index of refraction of the inside over the outside as refraction sees it; 1 if light is not bent.
    ///
    /// A refracted radiance carries the factor (η of the outgoing side / η of the incoming side)²: divide it out before
    /// judging how much energy a path still carries.
    pub fn ior(&self) -> f32 {
        match self {
            Bsdf::Dielectric(member) => member.ior(),
            Bsdf::Principled(member) => member.refraction_ior(),
            _ => 1.0,
        }
    }

    /// True if f(o, i) / η_o² = f(i, o) / η_i² holds.
    pub fn is_reciprocal(&self) -> bool {
        !matches!(self, Bsdf::Glossy(_))
    }

    /// About the fraction of light that is scattered; for the albedo layer, not for transport.
    pub fn albedo(&self) -> Rgb {
        match self {
            Bsdf::Absorber => Rgb::BLACK,
            Bsdf::Diffuse(member) => member.color(),
            Bsdf::Conductor(member) => member.albedo(),
            Bsdf::Dielectric(member) => member.albedo(),
            Bsdf::Principled(member) => member.albedo(),
            Bsdf::Phong(member) => member.albedo(),
            Bsdf::Glossy(member) => member.color(),
        }
    }

    /// Named members of the family with many parameters each, for the contract suite and galleries.
    pub fn examples() -> Vec<(&'static str, Bsdf)> {
        examples::examples()
    }
}

/// The mirror direction about the normal.
fn mirror(direction: Vec3) -> Vec3 {
    Vec3::new(-direction.x, -direction.y, direction.z)
}

/// The same direction seen from the other side of the surface.
fn flip(direction: Vec3) -> Vec3 {
    Vec3::new(direction.x, direction.y, -direction.z)
}

/// True for directions that neither side can claim: nearer to the horizon, single precision overflows.
fn in_horizon(direction: Vec3) -> bool {
    direction.z.abs() < 1e-12
}

/// True if both directions are strictly on one side.
fn same_side(outgoing: Vec3, incoming: Vec3) -> bool {
    outgoing.z * incoming.z > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bsdf_stays_small() {
        assert!(size_of::<Bsdf>() <= 128, "{}", size_of::<Bsdf>());
    }
}
