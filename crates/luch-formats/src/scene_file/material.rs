//! `material "name" { … }`: a surface, and what else a material has.

use super::decoder::Decoder;
use super::fields::{Field, Fields};
use super::surface::SURFACES;
use super::value::Range;
use super::{MaterialUse, Named, Spanned};
use crate::scene_file::source::advice;
use luch_scene::{Channel, Emission, Material, NormalMap, Opacity, Sides, Surface};

impl Decoder<'_> {
    /// A definition at the top level.
    pub(super) fn named_material(&mut self, mut fields: Fields) {
        let name = self.required_name(&mut fields);
        let material = self.material(fields, name.as_ref());
        if let Some(name) = name {
            self.scene.materials.push(Named { name: Some(name), value: material });
        }
    }

    /// A material written where it is used; says which reference it is.
    pub(super) fn inline_material(&mut self, mut fields: Fields) -> Option<usize> {
        if let Some(name) = fields.text_argument() {
            let help = "define it at the top level and refer to it by its name, or leave the name out";
            self.problem(
                &name.span,
                "a material that is written where it is used has no name",
                Some(help.into()),
            );
        }
        let material = self.material(fields, None);
        self.scene.materials.push(Named { name: None, value: material });
        let place = self.scene.materials.len() - 1;
        Some(self.use_material(MaterialUse::Inline(place)))
    }

    fn material(&mut self, mut fields: Fields, name: Option<&Spanned<String>>) -> Material {
        let surface = fields.take_one_of(self, &SURFACES);
        let surface_node = surface.is_some();
        let surface = surface.map(|field| self.surface(field));
        let mut material = Material::new(surface.unwrap_or(Surface::Absorber));
        material.name = name.map(|name| name.value.clone()).unwrap_or_default();
        material.emission = fields.take(self, "emission").map(|field| self.emission(field));
        if let Some(field) = fields.take(self, "opacity") {
            material.opacity = self.opacity(field);
        }
        material.normal_map = fields.take(self, "normal-map").and_then(|field| self.normal_map(field));
        let sides = [("both", Sides::Both), ("front", Sides::Front)];
        material.sides = self.word_or(&mut fields, "sides", &sides, Sides::Both);
        if !surface_node && material.emission.is_none() && fields.nothing_left() {
            let help = advice("", SURFACES, "write one of these in its block", "`");
            self.problem(&fields.span, "`material` lacks its surface", Some(help));
        }
        fields.finish(self, "surface or option");
        material
    }

    /// `emission 10 9 8 two-sided=#true`.
    fn emission(&mut self, field: Field) -> Emission {
        let mut fields = field.fields();
        let two_sided = self.flag_or(&mut fields, "two-sided", false);
        Emission { radiance: self.color_value(&mut fields, Range::NOT_NEGATIVE), two_sided }
    }

    /// `opacity 0.5`, or with a `cutoff` a mask that is there or not.
    fn opacity(&mut self, field: Field) -> Opacity {
        let mut fields = field.fields();
        let cutoff = self.optional_number(&mut fields, "cutoff", Range::UNIT);
        let alpha = self.scalar_value(&mut fields, Range::UNIT, Channel::Alpha);
        match cutoff {
            Some(cutoff) => Opacity::Mask { alpha, cutoff },
            None => Opacity::Blend { alpha },
        }
    }

    /// `normal-map texture="bumps" strength=1`.
    fn normal_map(&mut self, field: Field) -> Option<NormalMap> {
        let mut fields = field.fields();
        let scale = self.number_or(&mut fields, "strength", Range::between(-1e3, 1e3), 1.0);
        let has_texture = fields.has("texture") || fields.has("image");
        let texture = self.texture_use(&mut fields);
        if !has_texture && fields.nothing_left() {
            let help = "write normal-map texture=\"name\" or normal-map image=\"file.png\"";
            self.problem(&fields.span, "`normal-map` lacks its texture", Some(help.into()));
        }
        fields.finish(self, "option");
        Some(NormalMap { texture: texture?, scale })
    }
}
