//! Colours and numbers that may vary, and the textures that vary them.
//!
//! Mitsuba's v runs down: its coordinates are F uv with F: (u, v) ↦ (u, 1 − v), for pictures and meshes alike. A transform T of the
//! file is F T F for a picture, whose first row is at v = 0 there; patterns are looked up where Mitsuba does.

use super::Import;
use super::fields::{ANY, NOT_NEGATIVE, described};
use super::spectrum;
use super::tree::{Plugin, Property, Tag, Value};
use glam::{Affine2, Mat2, Vec2};
use luch_image::{Bitmap, Encoding, Pixels, Rgb};
use luch_scene::{Channel, ColorValue, Id, ScalarValue, Texture, TextureFilter, TextureUse, Wrap};

/// (u, v) to (u, 1 − v).
const FLIP: Affine2 = Affine2 { matrix2: Mat2::from_cols(Vec2::X, Vec2::NEG_Y), translation: Vec2::Y };

/// Textures inside one another.
const DEEPEST: usize = 16;

impl<'a> Import<'a> {
    /// The colour of a surface called `name`, or `default`; at most 1.
    pub(super) fn reflectance(&mut self, plugin: &'a Plugin, name: &'static str, default: f32) -> ColorValue {
        let Some(property) = self.property(plugin, name) else { return Rgb::gray(default).into() };
        let mut value = self.color_of(plugin, property, false);
        if value.factor.max_channel() > 1.0 {
            let message = format!("`{name}` of {} is more than 1, which is what is taken", described(plugin));
            self.warn(&property.span, message);
            value.factor = value.factor.map(|channel| channel.min(1.0));
        }
        value
    }

    /// The colour of light called `name`, or `default`.
    pub(super) fn radiance(&mut self, plugin: &'a Plugin, name: &'static str, default: f32) -> ColorValue {
        match self.property(plugin, name) {
            Some(property) => self.color_of(plugin, property, true),
            None => Rgb::gray(default).into(),
        }
    }

    /// A number called `name` that may vary, or `default`; kept between 0 and 1.
    pub(super) fn fraction(&mut self, plugin: &'a Plugin, name: &'static str, default: f32) -> ScalarValue {
        let Some(property) = self.property(plugin, name) else { return default.into() };
        let value = self.color_of(plugin, property, false);
        let scalar = scalar_of(&value);
        if (0.0..=1.0).contains(&scalar.factor) {
            return scalar;
        }
        let message =
            format!("`{name}` of {} is {}, expected a number from 0 to 1", described(plugin), scalar.factor);
        self.report.add(&property.span, message, None);
        default.into()
    }

    /// A property as a colour that may vary; a problem and gray if it is none.
    pub(super) fn color_of(
        &mut self,
        plugin: &'a Plugin,
        property: &'a Property,
        is_light: bool,
    ) -> ColorValue {
        let color = match self.constant_color(&property.value, is_light) {
            Some(color) => color.into(),
            None => match self.document.target(&property.value) {
                Some(place) if self.document.plugins[place].tag == Tag::Texture => {
                    self.texture(place, is_light, 0)
                }
                _ => {
                    let found = property.value.describe();
                    let message = format!(
                        "`{}` of {} is {found}, expected a colour, a number or a texture",
                        property.name,
                        described(plugin)
                    );
                    self.report.add(&property.span, message, None);
                    Rgb::gray(0.5).into()
                }
            },
        };
        if color.factor.is_finite() && color.factor.r.min(color.factor.g).min(color.factor.b) >= 0.0 {
            return color;
        }
        let message = format!("`{}` of {} is negative or not finite", property.name, described(plugin));
        self.report.add(&property.span, message, None);
        Rgb::gray(0.5).into()
    }

    /// A texture plugin as a colour.
    pub(super) fn texture(&mut self, place: usize, is_light: bool, depth: usize) -> ColorValue {
        let plugin = &self.document.plugins[place];
        if depth > DEEPEST {
            self.report.add(&plugin.span, "textures stand inside one another without end", None);
            return Rgb::gray(0.5).into();
        }
        if let Some(&known) = self.textures.get(&(place, is_light)) {
            return known;
        }
        let value = match plugin.kind.as_str() {
            "bitmap" => self.bitmap(plugin),
            "checkerboard" => self.checkerboard(plugin),
            "mesh_attribute" => self.mesh_attribute(plugin),
            "vertexcolors" => ColorValue { vertex_color: true, ..Rgb::WHITE.into() },
            "scale" => self.scaled(plugin, is_light, depth),
            "uniform" => {
                let value = self.number(plugin, "value", NOT_NEGATIVE, 1.0);
                self.ignore(plugin, &["lambda_min", "lambda_max"]);
                let value = Value::Spectrum(spectrum::constant(f64::from(value)));
                self.constant_color(&value, is_light).unwrap_or(Rgb::WHITE).into()
            }
            "srgb" => self.radiance(plugin, "color", 1.0),
            "rawconstant" => self.radiance(plugin, "value", 1.0),
            "d65" => {
                let scale = self.number(plugin, "scale", NOT_NEGATIVE, 1.0);
                let color = self.radiance(plugin, "color", 1.0);
                ColorValue { factor: color.factor * scale, ..color }
            }
            "blackbody" => {
                let temperature = f64::from(self.number(plugin, "temperature", 1.0..=1e6, 5000.0));
                let scale = f64::from(self.number(plugin, "scale", NOT_NEGATIVE, 1.0));
                self.ignore(plugin, &["wavelength_min", "wavelength_max"]);
                spectrum::blackbody(temperature, scale).into()
            }
            "regular" | "irregular" => self.listed_spectrum(plugin, is_light),
            _ => {
                let message = format!("{} is not supported: gray takes its place", described(plugin));
                self.warn(&plugin.span, message);
                plugin.properties.iter().for_each(|property| property.used.set(true));
                Rgb::gray(0.5).into()
            }
        };
        self.finish(plugin);
        self.textures.insert((place, is_light), value);
        value
    }

    fn bitmap(&mut self, plugin: &'a Plugin) -> ColorValue {
        let gamma = self.number(plugin, "gamma", ANY, -1.0);
        let raw = self.flag(plugin, "raw", gamma == 1.0);
        self.ignore(plugin, &["max_anisotropy", "cache", "format", "accel", "channel"]);
        if gamma > 0.0 && gamma != 1.0 {
            self.warn(&plugin.span, "`gamma` of a bitmap other than 1 is read as the sRGB curve");
        }
        let filters = [
            ("bilinear", TextureFilter::Bilinear),
            ("nearest", TextureFilter::Nearest),
            ("trilinear", TextureFilter::Bilinear),
            ("ewa", TextureFilter::Bilinear),
        ];
        let filter = self.word(plugin, "filter_type", &filters, TextureFilter::Bilinear);
        let wraps = [("repeat", Wrap::Repeat), ("mirror", Wrap::Mirror), ("clamp", Wrap::Clamp)];
        let both = self.word(plugin, "wrap_mode", &wraps, Wrap::Repeat);
        let wrap = ["wrap_mode_u", "wrap_mode_v"].map(|name| self.word(plugin, name, &wraps, both));
        let transform = FLIP * self.uv_transform(plugin) * FLIP;
        let Some(image) = self.image(plugin) else { return Rgb::gray(0.5).into() };
        let encoding = if raw { Encoding::Linear } else { Encoding::Srgb };
        let texture = self.scene.add_texture(Texture::Image { image, encoding, wrap, filter });
        ColorValue::textured(TextureUse { texture, uv_set: 0, transform })
    }

    /// The picture that `filename` names; a warning if it cannot be had.
    pub(super) fn image(&mut self, plugin: &'a Plugin) -> Option<Id<Bitmap>> {
        let Some(name) = self.text(plugin, "filename") else {
            self.report.add(&plugin.span, format!("{} lacks its `filename`", described(plugin)), None);
            return None;
        };
        let path = self.path(name);
        self.images.load(&path, &mut self.scene, &mut self.warnings)
    }

    fn checkerboard(&mut self, plugin: &'a Plugin) -> ColorValue {
        let even = self.light(plugin, "color0", Rgb::gray(0.4));
        let odd = self.light(plugin, "color1", Rgb::gray(0.2));
        // A period has two squares, here each square is a unit.
        let transform = Affine2::from_scale(Vec2::splat(2.0)) * self.uv_transform(plugin) * FLIP;
        let texture = self.scene.add_texture(Texture::Checker { even, odd });
        ColorValue::textured(TextureUse { texture, uv_set: 0, transform })
    }

    /// `to_uv`, or the scales and offsets of old files.
    fn uv_transform(&mut self, plugin: &'a Plugin) -> Affine2 {
        let m = self.matrix(plugin, "to_uv");
        let [x, y, w] = [m.x_axis, m.y_axis, m.w_axis].map(|axis| axis.truncate().truncate().as_vec2());
        let old = |import: &mut Self, names: [&'static str; 2], default| {
            Vec2::from(names.map(|name| import.number(plugin, name, ANY, default)))
        };
        let scale = old(self, ["uscale", "vscale"], 1.0);
        let offset = old(self, ["uoffset", "voffset"], 0.0);
        Affine2::from_mat2_translation(Mat2::from_diagonal(scale), offset)
            * Affine2::from_mat2_translation(Mat2::from_cols(x, y), w)
    }

    fn mesh_attribute(&mut self, plugin: &'a Plugin) -> ColorValue {
        let name = self.text(plugin, "name").unwrap_or("vertex_color");
        let scale = self.number(plugin, "scale", NOT_NEGATIVE, 1.0);
        if name != "vertex_color" {
            let shown = crate::scene_file::clip(name);
            self.warn(
                &plugin.span,
                format!("the mesh attribute \"{shown}\" is not read: vertex colours take its place"),
            );
        }
        ColorValue { vertex_color: true, ..Rgb::gray(scale).into() }
    }

    fn scaled(&mut self, plugin: &'a Plugin, is_light: bool, depth: usize) -> ColorValue {
        let scale = self.radiance(plugin, "scale", 1.0).factor;
        match self.parts(plugin, Tag::Texture).first() {
            Some(&(inner, _)) => {
                let value = self.texture(inner, is_light, depth + 1);
                ColorValue { factor: value.factor * scale, ..value }
            }
            None => scale.into(),
        }
    }

    fn listed_spectrum(&mut self, plugin: &'a Plugin, is_light: bool) -> ColorValue {
        let numbers = |text: Option<&str>| text.map(super::literal::numbers).unwrap_or(Ok(Vec::new()));
        let values = numbers(self.text(plugin, "values"));
        let wavelengths = numbers(self.text(plugin, "wavelengths"));
        let least = f64::from(self.number(plugin, "wavelength_min", 1.0..=1e5, 360.0));
        let most = f64::from(self.number(plugin, "wavelength_max", 1.0..=1e5, 830.0));
        let pairs = match (values, wavelengths) {
            (Ok(values), Ok(wavelengths)) if plugin.kind == "irregular" => {
                wavelengths.into_iter().zip(values).map(|(at, value)| [at, value]).collect()
            }
            (Ok(values), Ok(_)) => {
                let step = (most - least) / (values.len().max(2) - 1) as f64;
                values.into_iter().enumerate().map(|(i, value)| [least + step * i as f64, value]).collect()
            }
            (Err(message), _) | (_, Err(message)) => {
                self.report.add(&plugin.span, message, None);
                return Rgb::gray(0.5).into();
            }
        };
        match spectrum::rising(pairs) {
            Ok(pairs) => {
                self.constant_color(&Value::Spectrum(pairs), is_light).unwrap_or(Rgb::gray(0.5)).into()
            }
            Err(message) => {
                self.report.add(&plugin.span, message, None);
                Rgb::gray(0.5).into()
            }
        }
    }

    /// The mean of a colour over its texture.
    pub(super) fn mean(&self, value: &ColorValue) -> Rgb {
        let texture = value.texture.map(|used| &self.scene.textures[used.texture.index()]);
        let mean = match texture {
            None => Rgb::WHITE,
            Some(Texture::Checker { even, odd }) => (*even + *odd) * 0.5,
            Some(Texture::Image { image, .. }) => {
                let [r, g, b, _] = self.scene.images[image.index()].average();
                Rgb::new(r, g, b)
            }
        };
        value.factor * mean
    }

    /// A number with `change` done to every value of it: its picture is made anew.
    pub(super) fn changed(&mut self, value: ScalarValue, change: impl Fn(f32) -> f32) -> ScalarValue {
        let Some((used, _)) = value.texture else { return change(value.factor).into() };
        let gray = |color: Rgb| Rgb::gray(change(color.luminance() * value.factor));
        ScalarValue::textured(self.made_anew(used, gray), Channel::Luminance)
    }

    /// A colour with `change` done to every channel of every value of it: its picture is made anew.
    pub(super) fn recolored(&mut self, value: ColorValue, change: impl Fn(f32) -> f32) -> ColorValue {
        match value.texture {
            None => ColorValue { factor: value.factor.map(change), ..value },
            Some(used) => {
                let texture = self.made_anew(used, |color| (color * value.factor).map(&change));
                ColorValue { factor: Rgb::WHITE, texture: Some(texture), ..value }
            }
        }
    }

    fn made_anew(&mut self, used: TextureUse, change: impl Fn(Rgb) -> Rgb) -> TextureUse {
        let texture = match self.scene.textures[used.texture.index()].clone() {
            Texture::Checker { even, odd } => Texture::Checker { even: change(even), odd: change(odd) },
            Texture::Image { image, encoding, wrap, filter } => {
                let old = &self.scene.images[image.index()];
                let (width, height, has_alpha) = (old.width, old.height, old.has_alpha);
                let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
                let pixels = places.map(|(x, y)| {
                    let [r, g, b, a] = old.linear(x, y, encoding);
                    let Rgb { r, g, b } = change(Rgb::new(r, g, b));
                    [r, g, b, a]
                });
                let pixels = Pixels::F32(pixels.collect());
                let new = Bitmap { width, height, pixels, encoding: Encoding::Linear, has_alpha };
                let image = self.scene.add_image(new);
                Texture::Image { image, encoding: Encoding::Linear, wrap, filter }
            }
        };
        TextureUse { texture: self.scene.add_texture(texture), ..used }
    }
}

/// A colour as a number: its luminance.
fn scalar_of(value: &ColorValue) -> ScalarValue {
    let factor = value.factor.luminance();
    ScalarValue {
        factor: if value.factor.r == value.factor.g && value.factor.g == value.factor.b {
            value.factor.r
        } else {
            factor
        },
        texture: value.texture.map(|used| (used, Channel::Luminance)),
        vertex_alpha: false,
    }
}
