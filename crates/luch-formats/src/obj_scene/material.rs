//! MTL materials as luch materials. The keywords describe pictures of the nineties; this is what comes nearest.

use super::beside_or_near;
use crate::images::Images;
use crate::{Files, Warning};
use glam::{Affine2, Vec2, Vec3};
use luch_image::{Encoding, Rgb};
use luch_mesh::codec::mtl::{Channel as MtlChannel, MtlMaterial, MtlTexture};
use luch_scene::{
    Channel, ColorValue, Emission, Id, Material, NormalMap, Opacity, Principled, Reflectance, ScalarValue,
    Scene, Surface, Texture, TextureFilter, TextureUse, Wrap,
};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Diffuse albedo of a material that says nothing.
const USUAL_DIFFUSE: Vec3 = Vec3::splat(0.8);

/// Turns materials over; says each complaint once for each file.
pub(super) struct Conversion<'a> {
    images: Images<'a>,
    files: &'a Files,
    said: BTreeSet<(PathBuf, String)>,
}

/// What one conversion works on.
struct Work<'w, 'a> {
    conversion: &'w mut Conversion<'a>,
    file: &'w Path,
    scene: &'w mut Scene,
    warnings: &'w mut Vec<Warning>,
}

impl<'a> Conversion<'a> {
    pub(super) fn new(images: Images<'a>, files: &'a Files) -> Self {
        Self { images, files, said: BTreeSet::new() }
    }

    /// Puts a material of `file` into the scene.
    pub(super) fn convert(
        &mut self,
        file: &Path,
        source: &MtlMaterial,
        scene: &mut Scene,
        warnings: &mut Vec<Warning>,
    ) -> Id<Material> {
        let mut work = Work { conversion: self, file, scene, warnings };
        work.complain(source);
        let surface = work.surface(source);
        let is_glass = matches!(surface, Surface::Dielectric { .. });
        let mut material = Material { name: source.name.clone(), ..Material::new(surface) };
        material.emission = work.emission(source);
        if !is_glass {
            material.opacity = work.opacity(source);
        }
        if let Some(map) = &source.normal_map {
            let texture = work.texture(map, Encoding::Linear);
            material.normal_map = texture.map(|texture| NormalMap { texture, scale: map.bump_multiplier });
        }
        scene.add_material(material)
    }
}

impl Work<'_, '_> {
    fn warn(&mut self, message: String) {
        if self.conversion.said.insert((self.file.to_owned(), message.clone())) {
            self.warnings.push(Warning::new(self.file, message));
        }
    }

    /// Names what is not honoured.
    fn complain(&mut self, source: &MtlMaterial) {
        let ignored = [
            ("Pc (clearcoat)", source.clearcoat.is_some_and(|v| v != 0.0)),
            ("Ps (sheen)", source.sheen.is_some_and(|v| v != 0.0) || source.sheen_map.is_some()),
            ("aniso", source.anisotropy.is_some_and(|v| v != 0.0)),
            ("map_Ns", source.shininess_map.is_some()),
            ("bump (heights)", source.bump_map.is_some()),
            ("disp", source.displacement_map.is_some()),
            ("decal", source.decal_map.is_some()),
            ("refl", source.reflection_map.is_some()),
        ];
        for (keyword, is_used) in ignored {
            if is_used {
                self.warn(format!("{keyword} is not honoured"));
            }
        }
    }

    fn surface(&mut self, source: &MtlMaterial) -> Surface {
        let model = source.illumination_model.unwrap_or(2);
        let is_physical = source.roughness.is_some()
            || source.metallic.is_some()
            || source.roughness_map.is_some()
            || source.metallic_map.is_some();
        let lets_through = source.transmission_filter.is_some_and(|filter| filter.max_element() > 0.0);
        let is_clear = source.opacity.is_some_and(|opacity| opacity < 1.0);
        let bends = source.index_of_refraction.is_some_and(|index| index > 1.0);
        let is_glass = matches!(model, 6 | 7)
            || (matches!(model, 4 | 9) && (is_clear || lets_through))
            || (bends
                && is_clear
                && source.transmission_filter.is_some_and(|filter| filter.min_element() < 1.0));
        if is_glass {
            return self.glass(source);
        }
        if is_physical {
            return self.principled(source);
        }
        let specular = self.color("Ks", source.specular, &source.specular_map, Vec3::ZERO);
        match model {
            3 | 5 | 8 if specular.factor.max_channel() > 0.0 => self.mirror(source, specular),
            0 | 1 => Surface::Diffuse { color: self.diffuse(source) },
            _ if specular.factor.max_channel() == 0.0 => Surface::Diffuse { color: self.diffuse(source) },
            _ => self.phong(source, specular),
        }
    }

    fn glass(&mut self, source: &MtlMaterial) -> Surface {
        // Black lets nothing through and white is the usual value: exporters write both without a thought.
        let filter = source.transmission_filter.filter(|filter| filter.max_element() > 0.0);
        Surface::Dielectric {
            ior: self.index(source),
            roughness: source.roughness.map_or(0.0, unit).into(),
            tint: self.color("Tf", filter, &None, Vec3::ONE),
        }
    }

    fn principled(&mut self, source: &MtlMaterial) -> Surface {
        let metallic_default = if source.metallic_map.is_some() { 1.0 } else { 0.0 };
        let roughness_default = if source.roughness_map.is_some() { 1.0 } else { 0.5 };
        Surface::Principled(Principled {
            base_color: self.diffuse(source),
            metallic: self.number("Pm", source.metallic.unwrap_or(metallic_default), &source.metallic_map),
            roughness: self.number(
                "Pr",
                source.roughness.unwrap_or(roughness_default),
                &source.roughness_map,
            ),
            ior: self.index(source),
            ..Principled::default()
        })
    }

    /// A mirror; with a diffuse part a mix whose halves are as bright as the two colours say.
    fn mirror(&mut self, source: &MtlMaterial, specular: ColorValue) -> Surface {
        let roughness = source.shininess.filter(|&ns| ns > 0.0 && ns < 1000.0).map_or(0.0, roughness_of);
        let diffuse = self.diffuse(source);
        let is_plain =
            source.diffuse.is_none_or(|kd| kd.max_element() <= 0.0) && source.diffuse_map.is_none();
        let conductor = |color| Surface::Conductor {
            reflectance: Reflectance::Color(color),
            roughness: roughness.into(),
            compensated: true,
        };
        if is_plain {
            return conductor(specular);
        }
        let (kd, ks) = (diffuse.factor.luminance(), specular.factor.luminance());
        let weight = ks / (kd + ks).max(f32::MIN_POSITIVE);
        let raised = |color: ColorValue, part: f32| ColorValue {
            factor: color.factor.map(|v| (v / part.max(1e-6)).min(1.0)),
            ..color
        };
        let first = Material::new(Surface::Diffuse { color: raised(diffuse, 1.0 - weight) });
        let second = Material::new(conductor(raised(specular, weight)));
        let (first, second) = (self.scene.add_material(first), self.scene.add_material(second));
        Surface::Mix { first, second, weight: weight.into() }
    }

    fn phong(&mut self, source: &MtlMaterial, mut specular: ColorValue) -> Surface {
        let mut diffuse = self.diffuse(source);
        let sum = (diffuse.factor + specular.factor).max_channel();
        if sum > 1.0 {
            self.warn(format!("Kd and Ks of \"{}\" add up to {sum}: both are scaled down to 1", source.name));
            // A little less, so that rounding does not bring the sum above 1 again.
            diffuse.factor *= 0.999_999 / sum;
            specular.factor *= 0.999_999 / sum;
        }
        let exponent = source.shininess.unwrap_or(10.0);
        let exponent = if exponent.is_nan() { 10.0 } else { exponent.clamp(0.0, 1e6) };
        Surface::Phong { diffuse, specular, exponent: exponent.into() }
    }

    fn diffuse(&mut self, source: &MtlMaterial) -> ColorValue {
        // Some exporters write a black Kd beside the map that is meant.
        let is_black = source.diffuse.is_none_or(|kd| kd.max_element() <= 0.0);
        let kd = if source.diffuse_map.is_some() && is_black { Some(Vec3::ONE) } else { source.diffuse };
        self.color("Kd", kd, &source.diffuse_map, USUAL_DIFFUSE)
    }

    fn index(&mut self, source: &MtlMaterial) -> f32 {
        let index = source.index_of_refraction.filter(|index| *index > 0.0).unwrap_or(1.5);
        let near = index.clamp(0.1, 10.0);
        if near != index {
            self.warn(format!("Ni of \"{}\" is {index}: taken as {near}", source.name));
        }
        near
    }

    fn emission(&mut self, source: &MtlMaterial) -> Option<Emission> {
        let is_black = source.emission.is_none_or(|ke| ke.max_element() <= 0.0);
        let radiance = match (&source.emission_map, source.emission) {
            (Some(_), ke) => ke.filter(|_| !is_black).unwrap_or(Vec3::ONE),
            (None, Some(ke)) if !is_black => ke,
            (None, _) => return None,
        };
        let bounded = |v: f32| if v.is_finite() { v.clamp(0.0, 1e18) } else { 0.0 };
        let factor = Rgb::new(bounded(radiance.x), bounded(radiance.y), bounded(radiance.z));
        let texture = source.emission_map.as_ref().and_then(|map| self.texture(map, Encoding::Srgb));
        if source.emission_map.is_some() && texture.is_none() {
            return None;
        }
        // MTL knows no front: a lamp shines whichever way its faces are wound.
        Some(Emission { radiance: ColorValue { factor, texture, vertex_color: false }, two_sided: true })
    }

    fn opacity(&mut self, source: &MtlMaterial) -> Opacity {
        let alpha = unit(source.opacity.unwrap_or(1.0));
        let texture = source.opacity_map.as_ref().and_then(|map| {
            let texture = self.texture(map, Encoding::Linear)?;
            let channel = map.channel.map_or_else(|| self.alpha_channel(texture), channel_of);
            Some((texture, channel))
        });
        if texture.is_none() && alpha >= 1.0 {
            return Opacity::Opaque;
        }
        Opacity::Blend { alpha: ScalarValue { factor: alpha, texture, vertex_alpha: false } }
    }

    /// Where a picture has its opacity: in its alpha, or else in its gray.
    fn alpha_channel(&self, used: TextureUse) -> Channel {
        match self.scene.textures[used.texture.index()] {
            Texture::Image { image, .. } if self.scene.images[image.index()].has_alpha => Channel::Alpha,
            _ => Channel::Luminance,
        }
    }

    /// A colour in 0 to 1, with its texture; a missing picture makes it half as bright.
    fn color(
        &mut self,
        keyword: &str,
        color: Option<Vec3>,
        map: &Option<MtlTexture>,
        usual: Vec3,
    ) -> ColorValue {
        let color = color.unwrap_or(if map.is_some() { Vec3::ONE } else { usual });
        let bounded = color.to_array().map(unit);
        if bounded != color.to_array() {
            self.warn(format!("{keyword} is {color}: taken as {}", Vec3::from_array(bounded)));
        }
        let mut value = ColorValue::constant(Rgb::from(bounded));
        if let Some(map) = map {
            let encoding = match map.color_space.as_deref() {
                Some(space) if space.eq_ignore_ascii_case("linear") => Encoding::Linear,
                _ => Encoding::Srgb,
            };
            value.texture = self.texture(map, encoding);
            let gain = if value.texture.is_some() { map.gain } else { 0.5 };
            value.factor = value.factor.map(|v| unit(v * gain));
        }
        value
    }

    /// A number in 0 to 1, with its texture.
    fn number(&mut self, keyword: &str, number: f32, map: &Option<MtlTexture>) -> ScalarValue {
        if unit(number) != number {
            self.warn(format!("{keyword} is {number}: taken as {}", unit(number)));
        }
        let mut value = ScalarValue::constant(unit(number));
        if let Some(map) = map {
            let channel = map.channel.map_or(Channel::Luminance, channel_of);
            value.texture = self.texture(map, Encoding::Linear).map(|texture| (texture, channel));
        }
        value
    }

    /// The texture of a map; `None`, and a warning, if its picture cannot be had.
    fn texture(&mut self, map: &MtlTexture, encoding: Encoding) -> Option<TextureUse> {
        if map.base != 0.0 || map.turbulence != Vec3::ZERO || map.kind.is_some() {
            self.warn(format!("options -mm, -t and -type of map \"{}\" are not honoured", map.file));
        }
        let path = beside_or_near(self.conversion.files, self.file, &map.file);
        let image = self.conversion.images.load(&path, self.scene, self.warnings)?;
        let wrap = if map.clamp { [Wrap::Clamp; 2] } else { [Wrap::Repeat; 2] };
        let texture = Texture::Image { image, encoding, wrap, filter: TextureFilter::Bilinear };
        let known = self.scene.textures.iter().position(|other| *other == texture);
        let id = known.map_or_else(|| self.scene.add_texture(texture), |place| Id::new(place as u32));
        let finite = |v: Vec2, usual: Vec2| if v.is_finite() { v } else { usual };
        let scale = finite(map.scale.truncate(), Vec2::ONE);
        let offset = finite(map.offset.truncate(), Vec2::ZERO);
        let transform = Affine2::from_scale_angle_translation(scale, 0.0, offset);
        Some(TextureUse { transform, ..TextureUse::new(id) })
    }
}

fn channel_of(channel: MtlChannel) -> Channel {
    match channel {
        MtlChannel::Red | MtlChannel::Depth => Channel::Red,
        MtlChannel::Green => Channel::Green,
        MtlChannel::Blue => Channel::Blue,
        MtlChannel::Matte => Channel::Alpha,
        MtlChannel::Luminance => Channel::Luminance,
    }
}

/// A number brought into 0 to 1; what is no number is 0.
fn unit(number: f32) -> f32 {
    if number.is_nan() { 0.0 } else { number.clamp(0.0, 1.0) }
}

/// Perceptual roughness of a Phong exponent: the GGX width α of the same sharpness is √(2 / (n + 2)), and α is its square
/// (Walter et al. 2007, equation 60 of the Beckmann case).
fn roughness_of(exponent: f32) -> f32 {
    unit((2.0 / (exponent + 2.0)).sqrt().sqrt())
}
