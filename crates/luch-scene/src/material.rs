//! What a surface does with light.

use crate::texture::{ColorValue, ScalarValue, TextureUse};
use crate::{Id, Metal};
use luch_image::Rgb;
use serde::{Deserialize, Serialize};

/// A surface: how it scatters, what it emits, where it is cut out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Material {
    /// What people call it; empty if it has no name.
    pub name: String,
    /// How it scatters light.
    pub surface: Surface,
    /// What it emits; `None` for most.
    pub emission: Option<Emission>,
    /// Where it is there at all.
    pub opacity: Opacity,
    /// Tilts the shading normal.
    pub normal_map: Option<NormalMap>,
    /// Which sides are there.
    pub sides: Sides,
}

impl Material {
    /// An opaque, dark, two-sided material that scatters as `surface` says.
    pub fn new(surface: Surface) -> Self {
        Self {
            name: String::new(),
            surface,
            emission: None,
            opacity: Opacity::Opaque,
            normal_map: None,
            sides: Sides::Both,
        }
    }

    /// A Lambertian material of one colour.
    pub fn diffuse(color: Rgb) -> Self {
        Self::new(Surface::Diffuse { color: color.into() })
    }

    /// A surface that emits `radiance` from its front and reflects nothing.
    pub fn emitter(radiance: Rgb) -> Self {
        Self { emission: Some(Emission::constant(radiance)), ..Self::new(Surface::Absorber) }
    }
}

/// How a surface scatters light.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Surface {
    /// Swallows everything.
    Absorber,
    /// Lambert: the same radiance in every direction.
    Diffuse {
        /// Albedo, 0 to 1.
        color: ColorValue,
    },
    /// A metal or mirror: GGX microfacets.
    Conductor {
        /// Reflection at the single facet.
        reflectance: Reflectance,
        /// Perceptual roughness, 0 (mirror) to 1; the GGX width is its square.
        roughness: ScalarValue,
        /// Whether the light of multiple bounces between the facets is put back. Without it rough metals are too dark, as they are in
        /// renderers that leave it out.
        compensated: bool,
    },
    /// Glass or water: reflects and refracts.
    Dielectric {
        /// Index of refraction of the inside over the outside.
        ior: f32,
        /// Perceptual roughness, 0 (polished) to 1.
        roughness: ScalarValue,
        /// Tints refracted light at each crossing, 0 to 1.
        tint: ColorValue,
    },
    /// The metallic-roughness model of glTF 2.0.
    Principled(Principled),
    /// Modified Phong (Lafortune and Willems 1994): a diffuse part and a cosine lobe about the mirror direction.
    Phong {
        /// Albedo of the diffuse part.
        diffuse: ColorValue,
        /// Albedo of the lobe at normal incidence.
        specular: ColorValue,
        /// Exponent of the lobe, at least 0.
        exponent: ScalarValue,
    },
    /// The lecture's glossy reflection: the normal is tilted by a point of the disc of radius tan((1 − glossiness) π/2).
    Glossy {
        /// Fraction of light that is reflected.
        color: ColorValue,
        /// 1 is a mirror; the smaller, the more blurred; more than 0.
        glossiness: ScalarValue,
    },
    /// At each point the surface of one of two materials, at random: `second` with probability `weight`. Emission, opacity, normal map
    /// and sides are those of the mixture itself.
    Mix {
        /// Taken at weight 0.
        first: Id<Material>,
        /// Taken at weight 1.
        second: Id<Material>,
        /// 0 to 1.
        weight: ScalarValue,
    },
}

/// How much a metal's facet reflects.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Reflectance {
    /// A named metal by its complex index of refraction.
    Metal(Metal),
    /// Complex index of refraction η + i k in red, green and blue.
    Index {
        /// Real part.
        eta: Rgb,
        /// Imaginary part.
        k: Rgb,
    },
    /// Reflectance at normal incidence, rising to 1 at grazing by Schlick's formula.
    Color(ColorValue),
}

/// Parameters of the metallic-roughness model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Principled {
    /// Albedo of the dielectric part, mirror colour of the metallic part.
    pub base_color: ColorValue,
    /// 0 dielectric, 1 metal.
    pub metallic: ScalarValue,
    /// Perceptual roughness, 0 to 1.
    pub roughness: ScalarValue,
    /// Index of refraction of the dielectric part.
    pub ior: f32,
    /// Part of the dielectric's unreflected light that goes through instead of being scattered back, 0 to 1.
    pub transmission: ScalarValue,
    /// True if light goes through without being bent, as through a film or a leaf.
    pub thin_walled: bool,
    /// Strength of the dielectric reflection (KHR_materials_specular), 0 to 1.
    pub specular: ScalarValue,
    /// Colour of the dielectric reflection at normal incidence.
    pub specular_color: ColorValue,
}

impl Default for Principled {
    fn default() -> Self {
        Self {
            base_color: Rgb::WHITE.into(),
            metallic: 0.0.into(),
            roughness: 0.5.into(),
            ior: 1.5,
            transmission: 0.0.into(),
            thin_walled: false,
            specular: 1.0.into(),
            specular_color: Rgb::WHITE.into(),
        }
    }
}

/// Light that a surface sends out by itself.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Emission {
    /// Radiance, W·sr⁻¹·m⁻².
    pub radiance: ColorValue,
    /// Whether the back emits as well.
    pub two_sided: bool,
}

impl Emission {
    /// The same radiance everywhere, from the front only.
    pub const fn constant(radiance: Rgb) -> Self {
        Self { radiance: ColorValue::constant(radiance), two_sided: false }
    }
}

/// Where a surface is there.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Opacity {
    /// Everywhere.
    Opaque,
    /// Where alpha reaches the cutoff.
    Mask {
        /// Alpha, 0 to 1.
        alpha: ScalarValue,
        /// Least alpha that is there.
        cutoff: f32,
    },
    /// With probability alpha.
    Blend {
        /// Alpha, 0 to 1.
        alpha: ScalarValue,
    },
}

/// A tangent-space normal map: red along increasing u, green along increasing v, blue outward.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct NormalMap {
    /// The map; read linearly.
    pub texture: TextureUse,
    /// Multiplies the map's red and green before normalising.
    pub scale: f32,
}

/// Which sides of a surface are there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Sides {
    /// Both.
    #[default]
    Both,
    /// Rays that come from behind pass through.
    Front,
}
