//! Surfaces: each bsdf of Mitsuba as the one of luch's that is the same or nearest.

use super::Import;
use super::fields::described;
use super::tree::{Plugin, Tag, Value};
use luch_image::{Encoding, Rgb};
use luch_scene::{Emission, Id, Material, NormalMap, Opacity, Surface, Texture, TextureUse};

/// Surfaces inside one another.
const DEEPEST: usize = 32;

/// Surfaces whose backs are black in Mitsuba unless they stand in `twosided`.
const ONE_SIDED: [&str; 6] =
    ["diffuse", "roughdiffuse", "conductor", "roughconductor", "plastic", "roughplastic"];

impl<'a> Import<'a> {
    /// The material of a surface and a lamp; without a surface it is Mitsuba's gray.
    pub(super) fn material(&mut self, bsdf: Option<usize>, emitter: Option<usize>) -> Id<Material> {
        if let Some(&known) = self.materials.get(&(bsdf, emitter)) {
            return known;
        }
        let mut material = match bsdf {
            Some(place) => self.surface(place),
            None => Material::diffuse(Rgb::gray(0.5)),
        };
        let kind = bsdf.map_or("diffuse", |place| self.document.plugins[place].kind.as_str());
        self.is_one_sided |= ONE_SIDED.contains(&kind);
        if let Some(place) = emitter {
            let plugin = &self.document.plugins[place];
            let radiance = self.radiance(plugin, "radiance", 1.0);
            self.ignore(plugin, &["sampling_weight", "is_environment"]);
            self.finish(plugin);
            material.emission = Some(Emission { radiance, two_sided: false });
        }
        let id = self.scene.add_material(material);
        self.materials.insert((bsdf, emitter), id);
        id
    }

    /// One surface; gray with a problem if it holds itself.
    fn surface(&mut self, place: usize) -> Material {
        let plugin = &self.document.plugins[place];
        if let Some(known) = self.surfaces.get(&place) {
            return known.clone();
        }
        if self.open.contains(&place) || self.open.len() > DEEPEST {
            self.report.add(&plugin.span, "bsdfs stand inside one another without end", None);
            return Material::diffuse(Rgb::gray(0.5));
        }
        self.open.push(place);
        let mut material = self.one_of_its_kind(plugin);
        self.open.pop();
        self.finish(plugin);
        if let Some(id) = &plugin.id {
            material.name.clone_from(id);
        }
        self.surfaces.insert(place, material.clone());
        material
    }

    fn one_of_its_kind(&mut self, plugin: &'a Plugin) -> Material {
        Material::new(match plugin.kind.as_str() {
            "diffuse" | "lambertian" => {
                Surface::Diffuse { color: self.reflectance(plugin, "reflectance", 0.5) }
            }
            "roughdiffuse" => {
                self.ignore(plugin, &["alpha", "use_fast_approx"]);
                self.warn(&plugin.span, "`roughdiffuse` is not supported: it is as smooth as `diffuse`");
                Surface::Diffuse { color: self.reflectance(plugin, "reflectance", 0.5) }
            }
            "dielectric" => self.dielectric(plugin, 0.0.into()),
            "roughdielectric" => {
                let roughness = self.roughness(plugin);
                self.dielectric(plugin, roughness)
            }
            "thindielectric" => self.thin_dielectric(plugin),
            "conductor" => Surface::Conductor {
                reflectance: self.metal(plugin),
                roughness: 0.0.into(),
                compensated: false,
            },
            "roughconductor" => {
                let roughness = self.roughness(plugin);
                Surface::Conductor { reflectance: self.metal(plugin), roughness, compensated: false }
            }
            "plastic" => self.plastic(plugin, 0.0.into()),
            "roughplastic" => {
                let roughness = self.roughness(plugin);
                self.plastic(plugin, roughness)
            }
            "principled" | "principledthin" => self.principled(plugin),
            "phong" => self.phong(plugin),
            "null" | "nullbsdf" => {
                return Material {
                    opacity: Opacity::Blend { alpha: 0.0.into() },
                    ..Material::new(Surface::Absorber)
                };
            }
            "twosided" => return self.two_sided(plugin),
            "mask" => return self.mask(plugin),
            "normalmap" => return self.normal_map(plugin),
            "bumpmap" | "bump" => {
                self.warn(&plugin.span, "`bumpmap` is not supported: the surface stays as it is below");
                self.ignore(plugin, &["scale", "arbitrary"]);
                self.parts(plugin, Tag::Texture);
                return self.inner(plugin, 0);
            }
            "coating" | "roughcoating" => {
                self.warn(
                    &plugin.span,
                    format!("{} is not supported: only what it covers is read", described(plugin)),
                );
                plugin.properties.iter().filter(|p| !self.is_surface(p)).for_each(|p| p.used.set(true));
                return self.inner(plugin, 0);
            }
            "blendbsdf" => return self.blend(plugin),
            "mixturebsdf" => return self.mixture(plugin),
            _ => {
                let message = format!("{} is not supported: gray takes its place", described(plugin));
                self.warn(&plugin.span, message);
                plugin.properties.iter().for_each(|property| property.used.set(true));
                Surface::Diffuse { color: Rgb::gray(0.5).into() }
            }
        })
    }

    fn is_surface(&self, property: &super::tree::Property) -> bool {
        let target = self.document.target(&property.value);
        target.is_some_and(|target| self.document.plugins[target].tag == Tag::Bsdf)
    }

    /// The surface at `index` among those inside `plugin`, under the name of neither.
    fn inner(&mut self, plugin: &'a Plugin, index: usize) -> Material {
        let inner = self.parts(plugin, Tag::Bsdf);
        match inner.get(index) {
            Some(&(place, _)) => self.surface(place),
            None => {
                self.report.add(
                    &plugin.span,
                    format!("{} lacks the bsdf inside it", described(plugin)),
                    None,
                );
                Material::diffuse(Rgb::gray(0.5))
            }
        }
    }

    fn two_sided(&mut self, plugin: &'a Plugin) -> Material {
        let inner = self.parts(plugin, Tag::Bsdf);
        if inner.len() > 1 {
            self.warn(&plugin.span, "`twosided` with two bsdfs is not supported: the first is on both sides");
        }
        match inner.first() {
            Some(&(place, _)) => self.surface(place),
            None => {
                self.report.add(&plugin.span, "bsdf `twosided` lacks the bsdf inside it", None);
                Material::diffuse(Rgb::gray(0.5))
            }
        }
    }

    fn mask(&mut self, plugin: &'a Plugin) -> Material {
        let alpha = self.fraction(plugin, "opacity", 0.5);
        let mut material = self.inner(plugin, 0);
        if material.opacity != Opacity::Opaque {
            self.warn(&plugin.span, "a mask of a mask is not supported: only the outer one counts");
        }
        material.opacity = Opacity::Blend { alpha };
        material
    }

    fn normal_map(&mut self, plugin: &'a Plugin) -> Material {
        self.ignore(plugin, &["flip_invalid_normals", "use_shadowing_function"]);
        let textures = self.parts(plugin, Tag::Texture);
        let map = textures.first().and_then(|&(place, _)| {
            // A normal map is no light: where nothing else is said, its numbers count as they are stored.
            let texture = &self.document.plugins[place];
            if !self.flag(texture, "raw", true) {
                self.warn(&texture.span, "a normal map is read as it is stored, whatever `raw` says");
            }
            self.texture(place, false, 0).texture
        });
        let mut material = self.inner(plugin, 0);
        match map {
            Some(texture) => {
                material.normal_map = Some(NormalMap { texture: self.as_stored(texture), scale: 1.0 });
            }
            None => self.warn(&plugin.span, "a normal map without a picture changes nothing"),
        }
        material
    }

    fn blend(&mut self, plugin: &'a Plugin) -> Material {
        let weight = self.fraction(plugin, "weight", 0.5);
        let parts: Vec<usize> = self.parts(plugin, Tag::Bsdf).into_iter().map(|(place, _)| place).collect();
        let [first, second] = parts[..] else {
            let message = format!("{} has {} bsdfs inside it, expected 2", described(plugin), parts.len());
            self.report.add(&plugin.span, message, None);
            return Material::diffuse(Rgb::gray(0.5));
        };
        let [first, second] = [first, second].map(|place| self.part(plugin, place));
        Material::new(Surface::Mix { first, second, weight })
    }

    /// `weights` of old files: each bsdf's share.
    fn mixture(&mut self, plugin: &'a Plugin) -> Material {
        let shares = match self.property(plugin, "weights").map(|property| &property.value) {
            Some(Value::Text(text)) => super::literal::numbers(text).unwrap_or_default(),
            Some(Value::Float(share)) => vec![*share],
            _ => Vec::new(),
        };
        let parts: Vec<usize> = self.parts(plugin, Tag::Bsdf).into_iter().map(|(place, _)| place).collect();
        if shares.len() != parts.len() || parts.is_empty() || shares.iter().any(|share| *share < 0.0) {
            let message =
                format!("{} needs one weight for each of its {} bsdfs", described(plugin), parts.len());
            self.report.add(&plugin.span, message, None);
            return Material::diffuse(Rgb::gray(0.5));
        }
        let mut total = shares[0];
        let mut mixed = self.part(plugin, parts[0]);
        let mut material = None;
        for (&place, &share) in parts.iter().zip(&shares).skip(1) {
            let second = self.part(plugin, place);
            total += share;
            let weight = if total > 0.0 { (share / total) as f32 } else { 0.0 };
            let mix = Material::new(Surface::Mix { first: mixed, second, weight: weight.into() });
            mixed = self.scene.add_material(mix.clone());
            material = Some(mix);
        }
        if (total - 1.0).abs() > 1e-3 {
            self.warn(
                &plugin.span,
                "the weights of `mixturebsdf` do not add up to 1: only their ratios count",
            );
        }
        material.unwrap_or_else(|| self.scene.materials[mixed.index()].clone())
    }

    /// A part of a mixture.
    fn part(&mut self, plugin: &'a Plugin, place: usize) -> Id<Material> {
        let id = self.material(Some(place), None);
        let part = &self.scene.materials[id.index()];
        if part.opacity != Opacity::Opaque || part.normal_map.is_some() {
            self.warn(
                &plugin.span,
                "masks and normal maps inside a blend are not supported: they count as not there",
            );
        }
        id
    }

    /// A texture whose numbers are read as they are stored.
    fn as_stored(&mut self, used: TextureUse) -> TextureUse {
        match self.scene.textures[used.texture.index()].clone() {
            Texture::Image { image, encoding: Encoding::Srgb, wrap, filter } => {
                let texture = Texture::Image { image, encoding: Encoding::Linear, wrap, filter };
                TextureUse { texture: self.scene.add_texture(texture), ..used }
            }
            _ => used,
        }
    }
}
