//! How a material scatters light: one node for each [`Surface`].

use super::decoder::Decoder;
use super::fields::{Field, Fields};
use super::source::advice;
use super::value::Range;
use super::{MaterialUse, Spanned};
use luch_image::Rgb;
use luch_scene::{Id, Metal, Principled, Reflectance, ScalarValue, Surface};

/// The nodes that say how a material scatters.
pub(super) const SURFACES: [&str; 8] =
    ["absorber", "diffuse", "conductor", "dielectric", "principled", "phong", "glossy", "mix"];

/// Indices of refraction that exist, with room.
const INDEX: Range = Range::between(0.1, 10.0);

/// Components of complex indices of refraction.
const COMPLEX_INDEX: Range = Range::between(0.0, 1e3);

/// Exponents of a Phong lobe.
const EXPONENT: Range = Range::between(0.0, 1e6);

const GLOSSINESS: Range = Range { least: 0.0, most: 1.0, with_least: false, with_most: true };

impl Decoder<'_> {
    /// The surface that a node describes.
    pub(super) fn surface(&mut self, field: Field) -> Surface {
        let name = field.name;
        let mut fields = field.fields();
        let surface = match name {
            "diffuse" => Surface::Diffuse { color: self.color_value(&mut fields, Range::UNIT) },
            "conductor" => self.conductor(&mut fields),
            "dielectric" => Surface::Dielectric {
                ior: self.number_or(&mut fields, "ior", INDEX, 1.5),
                roughness: self.scalar_or(&mut fields, "roughness", Range::UNIT, 0.0),
                tint: self.color_or(&mut fields, "tint", Range::UNIT, Rgb::WHITE),
            },
            "principled" => Surface::Principled(self.principled(&mut fields)),
            "phong" => self.phong(&mut fields),
            "glossy" => Surface::Glossy {
                color: self.color_or(&mut fields, "color", Range::UNIT, Rgb::WHITE),
                glossiness: self.scalar_or(&mut fields, "glossiness", GLOSSINESS, 0.9),
            },
            "mix" => self.mix(&mut fields),
            _ => Surface::Absorber,
        };
        fields.finish(self, "option");
        surface
    }

    /// `conductor "gold"`, `conductor color=0.9` or `conductor { eta …; k … }`.
    fn conductor(&mut self, fields: &mut Fields) -> Surface {
        let roughness = self.scalar_or(fields, "roughness", Range::UNIT, 0.0);
        let compensated = self.flag_or(fields, "compensated", true);
        let color = fields.take(self, "color");
        let eta = self.optional_constant(fields, "eta", COMPLEX_INDEX);
        let k = self.optional_constant(fields, "k", COMPLEX_INDEX);
        let metal = fields.argument();
        let ways = usize::from(metal.is_some())
            + usize::from(color.is_some())
            + usize::from(eta.is_some() || k.is_some());
        if ways > 1 {
            let help = "it has a metal's name, or `color`, or `eta` and `k`";
            self.problem(&fields.span, "`conductor` is described twice", Some(help.into()));
        }
        let mut reflectance = Reflectance::Metal(Metal::Silver);
        if let Some(argument) = metal {
            let metals = Metal::ALL.map(|metal| (metal.name(), metal));
            if let Some(metal) = self.word("the metal of `conductor`", &argument, &metals) {
                reflectance = Reflectance::Metal(metal);
            }
        } else if let Some(field) = color {
            reflectance = Reflectance::Color(self.color_value(&mut field.fields(), Range::UNIT));
        } else if let (Some(eta), Some(k)) = (eta, k) {
            reflectance = Reflectance::Index { eta, k };
        } else if fields.nothing_left() {
            let metals = Metal::ALL.map(Metal::name);
            let help = format!(
                "write conductor \"gold\", conductor color=0.9, or both `eta` and `k`; {}",
                advice("", metals, "metals", "\"")
            );
            self.problem(&fields.span, "`conductor` lacks its metal", Some(help));
        }
        Surface::Conductor { reflectance, roughness, compensated }
    }

    fn principled(&mut self, fields: &mut Fields) -> Principled {
        let usual = Principled::default();
        let constant = |value: &ScalarValue| value.factor;
        Principled {
            base_color: self.color_or(fields, "base-color", Range::UNIT, Rgb::gray(0.8)),
            metallic: self.scalar_or(fields, "metallic", Range::UNIT, constant(&usual.metallic)),
            roughness: self.scalar_or(fields, "roughness", Range::UNIT, constant(&usual.roughness)),
            ior: self.number_or(fields, "ior", INDEX, usual.ior),
            transmission: self.scalar_or(fields, "transmission", Range::UNIT, constant(&usual.transmission)),
            thin_walled: self.flag_or(fields, "thin-walled", usual.thin_walled),
            specular: self.scalar_or(fields, "specular", Range::UNIT, constant(&usual.specular)),
            specular_color: self.color_or(fields, "specular-color", Range::NOT_NEGATIVE, Rgb::WHITE),
        }
    }

    fn phong(&mut self, fields: &mut Fields) -> Surface {
        let diffuse = self.color_or(fields, "diffuse", Range::UNIT, Rgb::gray(0.5));
        let specular = self.color_or(fields, "specular", Range::UNIT, Rgb::gray(0.2));
        let exponent = self.scalar_or(fields, "exponent", EXPONENT, 50.0);
        let sum = (diffuse.factor + specular.factor).max_channel();
        if sum > 1.0 + 1e-6 {
            let message =
                format!("`diffuse` and `specular` of `phong` add up to {sum}, which is more than 1");
            let help = "a surface cannot send out more light than it gets";
            self.problem(&fields.span, message, Some(help.into()));
        }
        Surface::Phong { diffuse, specular, exponent }
    }

    /// `mix "first" "second" weight=0.3`, or `mix weight=0.3 { material { … }; material { … } }`.
    fn mix(&mut self, fields: &mut Fields) -> Surface {
        let weight = self.scalar_or(fields, "weight", Range::UNIT, 0.5);
        let arguments = fields.all_arguments();
        let mut parts = Vec::new();
        for argument in &arguments {
            if let Some(name) = self.text("a part of `mix`", argument) {
                parts.push(self.use_material(MaterialUse::Named(name)));
            }
        }
        for field in fields.take_nodes(self, &["material"]) {
            parts.extend(self.inline_material(field.fields()));
        }
        let [first, second] = parts[..] else {
            if parts.len() < arguments.len() {
                return Surface::Absorber;
            }
            let help = "write `mix \"first\" \"second\" weight=0.3`; a part may also be written out as `material { … }`";
            let message = format!("`mix` has {}, expected 2 materials", parts.len());
            self.problem(&fields.span, message, Some(help.into()));
            return Surface::Absorber;
        };
        Surface::Mix { first: Id::new(first as u32), second: Id::new(second as u32), weight }
    }

    /// Notes that a material is referred to, and says which reference it is.
    pub(super) fn use_material(&mut self, material: MaterialUse) -> usize {
        self.scene.material_uses.push(material);
        self.scene.material_uses.len() - 1
    }

    /// A name or a block: `material "gold"`, `material "body" "lid"` or `material { … }`.
    pub(super) fn material_of(&mut self, field: Field) -> Vec<usize> {
        let mut fields = field.fields();
        if fields.has_fields() {
            return self.inline_material(fields).into_iter().collect();
        }
        let arguments = fields.all_arguments();
        let names: Vec<Spanned<String>> =
            arguments.iter().filter_map(|argument| self.text("`material`", argument)).collect();
        if arguments.is_empty() {
            let help = "write material=\"name\" or `material { … }`";
            self.problem(&fields.span, "`material` lacks its name or its block", Some(help.into()));
        }
        names.into_iter().map(|name| self.use_material(MaterialUse::Named(name))).collect()
    }
}
