//! Materials: the metallic-roughness model and its extensions.

use super::Import;
use super::json::{Json, short};
use super::texture::UvSets;
use crate::Problem;
use luch_image::{Encoding, Rgb};
use luch_scene::{
    Channel, ColorValue, Emission, Id, Material, NormalMap, Opacity, Principled, ScalarValue, Sides, Surface,
    Texture,
};
use std::collections::BTreeMap;

/// A material of the document as scene materials, one for each choice of missing uv sets.
#[derive(Debug, Default)]
pub(super) struct Variants {
    /// The uv sets it asks for; `None` before it was first made.
    asked: Option<u32>,
    made: BTreeMap<u32, Id<Material>>,
}

impl Import<'_> {
    /// The material at a place of the document (`None`: the default one) for a mesh that has the uv sets `there`.
    pub(super) fn material(&mut self, index: Option<usize>, there: u32) -> Result<Id<Material>, Problem> {
        let known = self.materials.entry(index).or_default();
        if let Some(&id) = known.asked.and_then(|asked| known.made.get(&(asked & there))) {
            return Ok(id);
        }
        let mut sets = UvSets { there, asked: 0 };
        let material = match index {
            Some(index) => {
                let json = self.document.materials.at(index);
                let mut reader = MaterialReader { import: self, json: &json, sets: &mut sets };
                reader.read()?
            }
            None => {
                let base_color = ColorValue { vertex_color: self.has_vertex_colors, ..Rgb::WHITE.into() };
                let principled = Principled {
                    base_color,
                    metallic: 1.0.into(),
                    roughness: 1.0.into(),
                    ..Principled::default()
                };
                Material { sides: Sides::Front, ..Material::new(Surface::Principled(principled)) }
            }
        };
        let id = self.scene.add_material(material);
        let known = self.materials.entry(index).or_default();
        known.asked = Some(sets.asked);
        known.made.insert(sets.asked & there, id);
        Ok(id)
    }
}

/// One material being read.
struct MaterialReader<'r, 'a, 'j> {
    import: &'r mut Import<'a>,
    json: &'r Json<'j>,
    sets: &'r mut UvSets,
}

/// The base colour and the alpha that comes with it.
struct Base {
    color: ColorValue,
    alpha: ScalarValue,
}

impl MaterialReader<'_, '_, '_> {
    fn read(&mut self) -> Result<Material, Problem> {
        let json = self.json;
        let metallic_roughness = json.get("pbrMetallicRoughness")?;
        let base = self.base(metallic_roughness.as_ref())?;
        let double_sided = json.get("doubleSided")?.map_or(Ok(false), |flag| flag.boolean())?;
        let opacity = self.opacity(base.alpha)?;
        let mut material = Material {
            name: json.name()?,
            opacity,
            sides: if double_sided { Sides::Both } else { Sides::Front },
            ..Material::new(Surface::Absorber)
        };
        if json.extension("KHR_materials_unlit")?.is_some() {
            // Shown as it is, whatever light falls on it: a surface that emits its colour and reflects nothing.
            material.emission = Some(Emission { radiance: base.color, two_sided: double_sided });
            self.import.has_unlit = true;
            return Ok(material);
        }
        let principled = self.principled(base.color, metallic_roughness.as_ref())?;
        if principled.transmission.factor > 0.0 {
            material.sides = Sides::Both;
        }
        material.surface = Surface::Principled(principled);
        material.emission = self.emission()?.map(|radiance| Emission { radiance, two_sided: double_sided });
        if let Some(info) = json.get("normalTexture")? {
            let scale = info.number_or("scale", 1.0)? as f32;
            let texture = self.import.texture_use(&info, Encoding::Linear, self.sets)?;
            material.normal_map = texture.map(|texture| NormalMap { texture, scale });
        }
        if let Some(info) = json.get("occlusionTexture")? {
            // Light that reaches crevices is computed, not looked up; the reference alone is checked.
            info.need("index")?.reference(&self.import.document.textures)?;
        }
        Ok(material)
    }

    fn base(&mut self, json: Option<&Json>) -> Result<Base, Problem> {
        let vertex_color = self.import.has_vertex_colors;
        let [r, g, b, a] = match json.and_then(|json| json.get("baseColorFactor").transpose()).transpose()? {
            Some(factor) => self.within(&factor, factor.numbers()?, 0.0, 1.0),
            None => [1.0; 4],
        };
        let texture = match json.and_then(|json| json.get("baseColorTexture").transpose()).transpose()? {
            Some(info) => self.import.texture_use(&info, Encoding::Srgb, self.sets)?,
            None => None,
        };
        Ok(Base {
            color: ColorValue { factor: Rgb::new(r, g, b), texture, vertex_color },
            alpha: ScalarValue {
                factor: a,
                texture: texture.map(|texture| (texture, Channel::Alpha)),
                vertex_alpha: vertex_color,
            },
        })
    }

    fn opacity(&mut self, mut alpha: ScalarValue) -> Result<Opacity, Problem> {
        let cutoff = self.json.number_or("alphaCutoff", 0.5)? as f32;
        let mode = self.json.get("alphaMode")?;
        // A picture without an alpha channel, JPEG for one, is opaque: such a material needs no alpha test.
        if let Some((used, _)) = alpha.texture
            && let Some(Texture::Image { image, .. }) = self.import.scene.textures.get(used.texture.index())
            && let Some(bitmap) = self.import.scene.images.get(image.index())
            && !bitmap.has_alpha
        {
            alpha.texture = None;
        }
        let is_full = alpha.factor == 1.0 && alpha.texture.is_none() && !alpha.vertex_alpha;
        match mode.as_ref().map_or(Ok("OPAQUE"), |mode| mode.text())? {
            "OPAQUE" => Ok(Opacity::Opaque),
            "MASK" => Ok(Opacity::Mask { alpha, cutoff }),
            "BLEND" if is_full => Ok(Opacity::Opaque),
            "BLEND" => Ok(Opacity::Blend { alpha }),
            other => {
                let message =
                    format!("\"{}\" is no alpha mode (OPAQUE, MASK, BLEND); OPAQUE is taken", short(other));
                self.import.notices.add(mode.as_ref().unwrap_or(self.json).path(), message);
                Ok(Opacity::Opaque)
            }
        }
    }

    fn principled(&mut self, base_color: ColorValue, json: Option<&Json>) -> Result<Principled, Problem> {
        let mut principled =
            Principled { base_color, metallic: 1.0.into(), roughness: 1.0.into(), ..Principled::default() };
        if let Some(json) = json {
            let texture = self.texture(json, "metallicRoughnessTexture", Encoding::Linear)?;
            let [metallic, roughness] =
                [("metallicFactor", Channel::Blue), ("roughnessFactor", Channel::Green)].map(
                    |(key, channel)| -> Result<ScalarValue, Problem> {
                        let factor = self.factor(json, key, 1.0)?;
                        let texture = texture.map(|texture| (texture, channel));
                        Ok(ScalarValue { factor, texture, vertex_alpha: false })
                    },
                );
            (principled.metallic, principled.roughness) = (metallic?, roughness?);
        }
        if let Some(ior) = self.json.extension("KHR_materials_ior")? {
            principled.ior = self.ior(&ior)?;
        }
        if let Some(specular) = self.json.extension("KHR_materials_specular")? {
            let factor = self.factor(&specular, "specularFactor", 1.0)?;
            let texture = self.texture(&specular, "specularTexture", Encoding::Linear)?;
            let texture = texture.map(|texture| (texture, Channel::Alpha));
            principled.specular = ScalarValue { factor, texture, vertex_alpha: false };
            let factor = self.color(&specular, "specularColorFactor", [1.0; 3])?;
            let texture = self.texture(&specular, "specularColorTexture", Encoding::Srgb)?;
            principled.specular_color = ColorValue { factor, texture, vertex_color: false };
        }
        if let Some(transmission) = self.json.extension("KHR_materials_transmission")? {
            let factor = self.factor(&transmission, "transmissionFactor", 0.0)?;
            let texture = self.texture(&transmission, "transmissionTexture", Encoding::Linear)?;
            let texture = texture.map(|texture| (texture, Channel::Red));
            principled.transmission = ScalarValue { factor, texture, vertex_alpha: false };
            principled.thin_walled = factor > 0.0 && !self.has_volume()?;
        }
        Ok(principled)
    }

    /// Whether light is bent on its way through: KHR_materials_volume with a thickness above zero.
    fn has_volume(&mut self) -> Result<bool, Problem> {
        let Some(volume) = self.json.extension("KHR_materials_volume")? else { return Ok(false) };
        if volume.number_or("thicknessFactor", 0.0)? <= 0.0 {
            return Ok(false);
        }
        let color = volume.numbers_or("attenuationColor", [1.0; 3])?;
        if volume.get("attenuationDistance")?.is_some() && color != [1.0; 3] {
            let message = "attenuation inside a volume is not honoured; the glass is clear";
            self.import.notices.add(volume.path(), message);
        }
        Ok(true)
    }

    fn ior(&mut self, json: &Json) -> Result<f32, Problem> {
        let Some(value) = json.get("ior")? else { return Ok(1.5) };
        let ior = value.number()? as f32;
        if (1.0..=10.0).contains(&ior) {
            return Ok(ior);
        }
        self.import
            .notices
            .add(value.path(), format!("the index of refraction {ior} is not within 1 to 10; 1.5 is taken"));
        Ok(1.5)
    }

    fn emission(&mut self) -> Result<Option<ColorValue>, Problem> {
        let mut factor = self.color(self.json, "emissiveFactor", [0.0; 3])?;
        if let Some(extension) = self.json.extension("KHR_materials_emissive_strength")?
            && let Some(strength) = extension.get("emissiveStrength")?
        {
            let [strength_value] = self.within(&strength, [strength.number()?], 0.0, f64::from(f32::MAX));
            factor = (factor * strength_value).map(|channel| channel.min(f32::MAX));
        }
        let texture = self.texture(self.json, "emissiveTexture", Encoding::Srgb)?;
        Ok((!factor.is_black()).then_some(ColorValue { factor, texture, vertex_color: false }))
    }

    fn texture(
        &mut self,
        json: &Json,
        key: &str,
        encoding: Encoding,
    ) -> Result<Option<luch_scene::TextureUse>, Problem> {
        match json.get(key)? {
            Some(info) => self.import.texture_use(&info, encoding, self.sets),
            None => Ok(None),
        }
    }

    /// A property between 0 and 1.
    fn factor(&mut self, json: &Json, key: &str, default: f32) -> Result<f32, Problem> {
        match json.get(key)? {
            Some(value) => {
                let [factor] = self.within(&value, [value.number()?], 0.0, 1.0);
                Ok(factor)
            }
            None => Ok(default),
        }
    }

    /// A colour that is not negative.
    fn color(&mut self, json: &Json, key: &str, default: [f32; 3]) -> Result<Rgb, Problem> {
        match json.get(key)? {
            Some(value) => {
                let numbers = value.numbers()?;
                Ok(self.within(&value, numbers, 0.0, f64::from(f32::MAX)).into())
            }
            None => Ok(default.into()),
        }
    }

    /// Numbers moved into a range, with a warning if they were not.
    fn within<const N: usize>(&mut self, json: &Json, numbers: [f64; N], least: f64, most: f64) -> [f32; N] {
        let inside = numbers.map(|number| number.clamp(least, most));
        if inside != numbers {
            let range =
                if most <= 1.0 { format!("within {least} to {most}") } else { format!("at least {least}") };
            self.import.notices.add(json.path(), format!("{numbers:?} is not {range}; the nearest is taken"));
        }
        inside.map(|number| number as f32)
    }
}
