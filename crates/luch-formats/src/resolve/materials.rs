//! Textures and materials: references become ids, in an order in which the parts of a mix come first.

use super::{Names, Resolver};
use crate::material_values::values;
use crate::scene_file::{ImageSource, MaterialUse, Picture, SceneFile, TextureSource, clip};
use luch_image::Encoding;
use luch_scene::{Id, Material, Surface, Texture, TextureUse};
use std::collections::BTreeMap;

/// What a picture is read as.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Reading {
    /// Light: sRGB pictures are decoded.
    Color,
    /// Numbers and normals as they are stored.
    Data,
}

/// What a texture is once its picture has been looked for.
#[derive(Clone, Copy)]
enum Found {
    Texture(Id<Texture>),
    /// A neutral value takes its place.
    Missing,
}

/// Where a material stands on its way into the scene.
#[derive(Clone, Copy)]
enum Progress {
    Untouched,
    /// Its parts are being looked for.
    Open,
    Done(Id<Material>),
}

impl Resolver<'_> {
    /// Puts all textures and materials into the scene; says for each reference to a material where it is.
    pub(super) fn materials(&mut self, file: &SceneFile) -> Vec<Option<Id<Material>>> {
        let texture_names = self.names("texture", file.textures.iter().map(|texture| texture.name.as_ref()));
        let mut textures = Textures { file, names: texture_names, known: BTreeMap::new() };
        // Every texture is resolved, so that one nobody uses is checked as well.
        for place in 0..file.textures.len() {
            textures.named(self, place, Reading::Color);
        }
        let names = self.names("material", file.materials.iter().map(|material| material.name.as_ref()));
        let targets: Vec<Option<usize>> = file
            .material_uses
            .iter()
            .map(|used| match used {
                MaterialUse::Named(name) => self.find("material", &names, name),
                MaterialUse::Inline(place) => Some(*place),
            })
            .collect();
        let mut progress = vec![Progress::Untouched; file.materials.len()];
        for place in 0..file.materials.len() {
            self.material(file, place, &targets, &mut textures, &mut progress);
        }
        let done = |place: usize| match progress[place] {
            Progress::Done(id) => Some(id),
            Progress::Untouched | Progress::Open => None,
        };
        targets.into_iter().map(|target| target.and_then(done)).collect()
    }

    /// Puts one material into the scene after those it mixes. A stack of its own: a long chain must not overflow ours.
    fn material(
        &mut self,
        file: &SceneFile,
        place: usize,
        targets: &[Option<usize>],
        textures: &mut Textures,
        progress: &mut [Progress],
    ) {
        let mut stack = vec![place];
        while let Some(&top) = stack.last() {
            if let Progress::Done(_) = progress[top] {
                stack.pop();
                continue;
            }
            progress[top] = Progress::Open;
            let uses = match &file.materials[top].value.surface {
                Surface::Mix { first, second, .. } => vec![first.index(), second.index()],
                _ => Vec::new(),
            };
            let parts: Vec<usize> = uses.iter().filter_map(|&used| targets[used]).collect();
            if let Some(&open) = parts.iter().find(|&&part| matches!(progress[part], Progress::Open)) {
                self.mixes_itself(file, open, &uses, targets);
                // Anything will do in its place: the load fails.
                progress[open] = Progress::Done(Id::new(0));
                continue;
            }
            if let Some(&part) = parts.iter().find(|&&part| matches!(progress[part], Progress::Untouched)) {
                stack.push(part);
                continue;
            }
            let mut material = file.materials[top].value.clone();
            self.lay(&mut material, textures);
            for part in values(&mut material).parts {
                if let Some(Progress::Done(id)) = targets[part.index()].map(|target| progress[target]) {
                    *part = id;
                }
            }
            progress[top] = Progress::Done(self.scene.add_material(material));
            stack.pop();
        }
    }

    fn mixes_itself(&mut self, file: &SceneFile, place: usize, uses: &[usize], targets: &[Option<usize>]) {
        let guilty = uses.iter().find(|&&used| targets[used] == Some(place));
        if let Some(MaterialUse::Named(name)) = guilty.map(|&used| &file.material_uses[used]) {
            let message = format!("the mix leads back to material \"{}\"", clip(&name.value));
            self.report.add(&name.span, message, Some("a material cannot be a part of itself".into()));
        }
    }

    /// Gives the textures of a material their ids; those without a picture are replaced by neutral values.
    fn lay(&mut self, material: &mut Material, textures: &mut Textures) {
        if let Some(map) = &mut material.normal_map
            && !textures.lay(self, &mut map.texture, Reading::Data)
        {
            material.normal_map = None;
        }
        let all = values(material);
        for color in all.colors {
            if let Some(used) = &mut color.texture
                && !textures.lay(self, used, Reading::Color)
            {
                color.texture = None;
                color.factor *= 0.5;
            }
        }
        for scalar in all.scalars {
            if let Some((used, _)) = &mut scalar.texture
                && !textures.lay(self, used, Reading::Data)
            {
                scalar.texture = None;
            }
        }
    }
}

/// The textures of a scene file, and those that are in the scene by now.
struct Textures<'a> {
    file: &'a SceneFile,
    names: Names,
    known: BTreeMap<(usize, Reading), Found>,
}

impl Textures<'_> {
    /// Gives a use of a texture its id; false if the picture is missing.
    fn lay(&mut self, resolver: &mut Resolver, used: &mut TextureUse, reading: Reading) -> bool {
        let found = match &self.file.pictures[used.texture.index()] {
            Picture::Named(name) => match resolver.find("texture", &self.names, name) {
                Some(place) => self.named(resolver, place, reading),
                None => Found::Missing,
            },
            Picture::Image(image) => Self::image(resolver, image, reading),
        };
        match found {
            Found::Texture(id) => {
                used.texture = id;
                true
            }
            Found::Missing => false,
        }
    }

    fn named(&mut self, resolver: &mut Resolver, place: usize, reading: Reading) -> Found {
        if let Some(&known) = self.known.get(&(place, reading)) {
            return known;
        }
        let found = match &self.file.textures[place].value {
            TextureSource::Checker { even, odd } => {
                // A pattern is the same however it is read.
                match self.known.get(&(place, Reading::Color)) {
                    Some(&known) => known,
                    None => Found::Texture(
                        resolver.scene.add_texture(Texture::Checker { even: *even, odd: *odd }),
                    ),
                }
            }
            TextureSource::Image(image) => Self::image(resolver, image, reading),
        };
        self.known.insert((place, reading), found);
        found
    }

    fn image(resolver: &mut Resolver, source: &ImageSource, reading: Reading) -> Found {
        let path = resolver.path(&source.path);
        let Some(image) = resolver.images.load(&path, &mut resolver.scene, &mut resolver.warnings) else {
            return Found::Missing;
        };
        let encoding = source.encoding.unwrap_or_else(|| match reading {
            Reading::Color => resolver.scene.images[image.index()].encoding,
            Reading::Data => Encoding::Linear,
        });
        let texture = Texture::Image { image, encoding, wrap: source.wrap, filter: source.filter };
        // Equal textures are one.
        let known = resolver.scene.textures.iter().position(|other| *other == texture);
        Found::Texture(match known {
            Some(place) => Id::new(place as u32),
            None => resolver.scene.add_texture(texture),
        })
    }
}
