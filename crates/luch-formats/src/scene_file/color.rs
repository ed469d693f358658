//! Colours: `0.8 0.5 0.3`, a gray `0.5`, or `"#cc8844"` as screens write it; and values that a texture varies.

use super::decoder::Decoder;
use super::fields::{Argument, Field, Fields};
use super::source::{Span, clip};
use super::value::Range;
use super::{ImageSource, Picture};
use crate::kdl::Value;
use glam::{Affine2, Vec2};
use luch_image::{Rgb, srgb};
use luch_scene::{Channel, ColorValue, Id, ScalarValue, TextureFilter, TextureUse, Wrap};

/// What a value may refer to besides its number.
struct Varying {
    texture: Option<TextureUse>,
    vertex: bool,
}

const CHANNELS: [(&str, Channel); 5] = [
    ("red", Channel::Red),
    ("green", Channel::Green),
    ("blue", Channel::Blue),
    ("alpha", Channel::Alpha),
    ("luminance", Channel::Luminance),
];

impl Decoder<'_> {
    /// A colour from the arguments of a node.
    pub(super) fn color(
        &mut self,
        owner: &str,
        span: &Span,
        arguments: &[Argument],
        range: Range,
    ) -> Option<Rgb> {
        match arguments {
            [one] => match one.value {
                Value::Text(text) => {
                    let color = hex(text);
                    if color.is_none() {
                        let help = match text.starts_with('#') {
                            true => "a colour is \"#rrggbb\" or \"#rgb\", with digits 0 to 9 and a to f"
                                .to_owned(),
                            false => {
                                let picture = if owner == "`environment`" {
                                    "a picture is image"
                                } else {
                                    "a texture is texture"
                                };
                                let name = clip(text);
                                format!(
                                    "a colour is three numbers, one for gray, or \"#rrggbb\"; {picture}=\"{name}\""
                                )
                            }
                        };
                        let shown = self.quote(&one.span);
                        self.problem(
                            &one.span,
                            format!("{owner} is {shown}, which is no colour"),
                            Some(help),
                        );
                    }
                    color
                }
                _ => self.number(owner, one, range).map(Rgb::gray),
            },
            [_, _, _] => self.array(owner, span, arguments, range).map(|[r, g, b]| Rgb::new(r, g, b)),
            _ => {
                let have = arguments.len();
                let message = format!(
                    "{owner} has {have} values, expected three numbers, one for gray, or \"#rrggbb\""
                );
                self.problem(span, message, None);
                None
            }
        }
    }

    /// A colour called `name` that does not vary, or `default`.
    pub(super) fn constant_or(
        &mut self,
        fields: &mut Fields,
        name: &'static str,
        range: Range,
        default: Rgb,
    ) -> Rgb {
        self.optional_constant(fields, name, range).unwrap_or(default)
    }

    /// A colour called `name` that does not vary.
    pub(super) fn optional_constant(
        &mut self,
        fields: &mut Fields,
        name: &'static str,
        range: Range,
    ) -> Option<Rgb> {
        let mut inner = fields.take(self, name)?.fields();
        let arguments = inner.all_arguments();
        let color = self.color(&inner.owner.clone(), &inner.span, &arguments, range);
        inner.finish(self, "option");
        color
    }

    /// A colour called `name`, or `default`.
    pub(super) fn color_or(
        &mut self,
        fields: &mut Fields,
        name: &'static str,
        range: Range,
        default: Rgb,
    ) -> ColorValue {
        match fields.take(self, name) {
            Some(field) => self.color_value(&mut field.fields(), range),
            None => default.into(),
        }
    }

    /// The colour that a node itself is: its arguments and options, and nothing else.
    pub(super) fn color_value(&mut self, fields: &mut Fields, range: Range) -> ColorValue {
        let varying = self.varying(fields, "vertex-color");
        let arguments = fields.all_arguments();
        let has_other = varying.texture.is_some() || varying.vertex;
        let factor = if arguments.is_empty() && (has_other || !fields.nothing_left()) {
            Rgb::WHITE
        } else {
            self.color(&fields.owner.clone(), &fields.span, &arguments, range).unwrap_or(Rgb::WHITE)
        };
        fields.finish(self, "option");
        ColorValue { factor, texture: varying.texture, vertex_color: varying.vertex }
    }

    /// A number called `name` that may vary, or `default`.
    pub(super) fn scalar_or(
        &mut self,
        fields: &mut Fields,
        name: &'static str,
        range: Range,
        default: f32,
    ) -> ScalarValue {
        match fields.take(self, name) {
            Some(field) => self.scalar_value(&mut field.fields(), range, Channel::Red),
            None => default.into(),
        }
    }

    /// The number that a node itself is; `channel` is read unless another is asked for.
    pub(super) fn scalar_value(
        &mut self,
        fields: &mut Fields,
        range: Range,
        channel: Channel,
    ) -> ScalarValue {
        let varying = self.varying(fields, "vertex-alpha");
        let asked = fields.take(self, "channel");
        if let Some(field) = asked.as_ref().filter(|_| varying.texture.is_none()) {
            self.problem(&field.span, "`channel` is of use only with a texture", None);
        }
        let channel = asked
            .and_then(|field| self.single(field, "a word"))
            .and_then(|argument| self.word("`channel`", &argument, &CHANNELS))
            .unwrap_or(channel);
        let owner = fields.owner.clone();
        let factor = match fields.argument() {
            Some(argument) => self.number(&owner, &argument, range),
            None if varying.texture.is_some() || varying.vertex || !fields.nothing_left() => None,
            None => {
                self.problem(&fields.span, format!("{owner} lacks its value"), None);
                None
            }
        };
        fields.finish(self, "option");
        let texture = varying.texture.map(|texture| (texture, channel));
        ScalarValue { factor: factor.unwrap_or(1.0), texture, vertex_alpha: varying.vertex }
    }

    /// The texture of a value and how it lies, and whether vertex colours count.
    fn varying(&mut self, fields: &mut Fields, vertex: &'static str) -> Varying {
        let vertex = self.flag_or(fields, vertex, false);
        Varying { texture: self.texture_use(fields), vertex }
    }

    /// `texture="name"` or `image="file"`, and `scale`, `rotate`, `offset`, `uv-set`.
    pub(super) fn texture_use(&mut self, fields: &mut Fields) -> Option<TextureUse> {
        let named = fields.take_one_of(self, &["texture", "image"]);
        let is_texture = named.is_some();
        let [scale, rotate, offset, uv_set] = ["scale", "rotate", "offset", "uv-set"].map(|name| {
            let field = fields.take(self, name);
            if let Some(field) = field.as_ref().filter(|_| !is_texture) {
                self.problem(&field.span, format!("`{name}` is of use only with a texture"), None);
            }
            field
        });
        let picture = self.picture(named?)?;
        self.scene.pictures.push(picture);
        let scale = scale.and_then(|field| self.pair(field)).unwrap_or(Vec2::ONE);
        let rotate = rotate.and_then(|field| self.numbers(field, Range::between(-1e6, 1e6)));
        let angle = rotate.map_or(0.0, |[degrees]| (degrees % 360.0).to_radians());
        let offset =
            offset.and_then(|field| self.numbers(field, Range::ANY)).map_or(Vec2::ZERO, Vec2::from_array);
        let uv_set = uv_set
            .and_then(|field| self.single(field, "a whole number"))
            .and_then(|argument| self.whole("`uv-set`", &argument, 0, 255))
            .unwrap_or(0) as u8;
        let transform = Affine2::from_scale_angle_translation(scale, angle, offset);
        Some(TextureUse { texture: Id::new(self.scene.pictures.len() as u32 - 1), uv_set, transform })
    }

    fn picture(&mut self, field: Field) -> Option<Picture> {
        let is_name = field.name == "texture";
        let owner = format!("`{}`", field.name);
        let argument = self.single(field, "a text in quotes")?;
        let text = self.text(&owner, &argument)?;
        Some(if is_name {
            Picture::Named(text)
        } else {
            let (wrap, filter) = ([Wrap::Repeat; 2], TextureFilter::Bilinear);
            Picture::Image(ImageSource { path: text, encoding: None, wrap, filter })
        })
    }

    /// One number for u and v, or two.
    fn pair(&mut self, field: Field) -> Option<Vec2> {
        let mut fields = field.fields();
        let arguments = fields.all_arguments();
        let pair = match arguments.as_slice() {
            [one] => self.number(&fields.owner.clone(), one, Range::ANY).map(Vec2::splat),
            _ => {
                self.array(&fields.owner.clone(), &fields.span, &arguments, Range::ANY).map(Vec2::from_array)
            }
        };
        fields.finish(self, "option");
        pair
    }
}

/// The linear colour of `#rgb` or `#rrggbb`.
fn hex(text: &str) -> Option<Rgb> {
    let digits = text.strip_prefix('#')?;
    if !digits.chars().all(|c| c.is_ascii_hexdigit()) {
        return None;
    }
    let number = u32::from_str_radix(digits, 16).ok()?;
    let bytes = match digits.len() {
        3 => [8, 4, 0].map(|shift| (number >> shift & 15) as u8 * 17),
        6 => [16, 8, 0].map(|shift| (number >> shift & 255) as u8),
        _ => return None,
    };
    Some(Rgb::from(bytes.map(srgb::decode_u8)))
}
