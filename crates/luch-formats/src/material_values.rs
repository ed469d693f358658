//! All values of a material that may vary, so that the ids in them can be changed in one place.

use luch_scene::{ColorValue, Id, Material, Opacity, Principled, Reflectance, ScalarValue, Surface};

/// The values of a material.
pub(crate) struct Values<'a> {
    pub(crate) colors: Vec<&'a mut ColorValue>,
    pub(crate) scalars: Vec<&'a mut ScalarValue>,
    /// The parts of a mix.
    pub(crate) parts: Vec<&'a mut Id<Material>>,
}

/// Every colour, number and part of `material`; its normal map is not among them.
pub(crate) fn values(material: &mut Material) -> Values<'_> {
    let mut all = Values { colors: Vec::new(), scalars: Vec::new(), parts: Vec::new() };
    match &mut material.surface {
        Surface::Absorber => {}
        Surface::Diffuse { color } => all.colors.push(color),
        Surface::Conductor { reflectance, roughness, compensated: _ } => {
            if let Reflectance::Color(color) = reflectance {
                all.colors.push(color);
            }
            all.scalars.push(roughness);
        }
        Surface::Dielectric { ior: _, roughness, tint } => {
            all.colors.push(tint);
            all.scalars.push(roughness);
        }
        Surface::Principled(Principled {
            base_color,
            metallic,
            roughness,
            ior: _,
            transmission,
            thin_walled: _,
            specular,
            specular_color,
        }) => {
            all.colors.extend([base_color, specular_color]);
            all.scalars.extend([metallic, roughness, transmission, specular]);
        }
        Surface::Phong { diffuse, specular, exponent } => {
            all.colors.extend([diffuse, specular]);
            all.scalars.push(exponent);
        }
        Surface::Glossy { color, glossiness } => {
            all.colors.push(color);
            all.scalars.push(glossiness);
        }
        Surface::Mix { first, second, weight } => {
            all.parts.extend([first, second]);
            all.scalars.push(weight);
        }
    }
    if let Some(emission) = &mut material.emission {
        all.colors.push(&mut emission.radiance);
    }
    match &mut material.opacity {
        Opacity::Opaque => {}
        Opacity::Mask { alpha, cutoff: _ } | Opacity::Blend { alpha } => all.scalars.push(alpha),
    }
    all
}
