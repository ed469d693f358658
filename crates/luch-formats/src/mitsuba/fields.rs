//! Values of a plugin by their names; what nobody asks for is told in the end.

use super::Import;
use super::spectrum;
use super::tree::{Plugin, Property, Tag, Value};
use crate::scene_file::{Span, advice, clip};
use glam::{DAffine3, DMat4, Vec3};
use luch_image::Rgb;
use std::ops::RangeInclusive;

/// Finite numbers of any size.
pub(super) const ANY: RangeInclusive<f32> = -1e18..=1e18;
/// Lengths and strengths.
pub(super) const NOT_NEGATIVE: RangeInclusive<f32> = 0.0..=1e18;
/// Lengths that must not vanish.
pub(super) const POSITIVE: RangeInclusive<f32> = 1e-18..=1e18;
/// Fractions.
pub(super) const UNIT: RangeInclusive<f32> = 0.0..=1.0;

impl<'a> Import<'a> {
    /// The property called `name`. Of several the last counts.
    pub(super) fn property(&self, plugin: &'a Plugin, name: &'static str) -> Option<&'a Property> {
        plugin.asked.borrow_mut().insert(name);
        let mut found = None;
        for property in plugin.properties.iter().filter(|property| property.name == name) {
            property.used.set(true);
            found = Some(property);
        }
        found
    }

    /// Accepts properties that change nothing in the picture.
    pub(super) fn ignore(&self, plugin: &'a Plugin, names: &[&'static str]) {
        for name in names {
            self.property(plugin, name);
        }
    }

    /// The plugins of a kind that stand in `plugin` or are referred to there, whatever their names.
    pub(super) fn parts(&self, plugin: &'a Plugin, tag: Tag) -> Vec<(usize, &'a Span)> {
        let mut parts = Vec::new();
        for property in &plugin.properties {
            if let Some(target) = self.document.target(&property.value)
                && self.document.plugins[target].tag == tag
            {
                property.used.set(true);
                parts.push((target, &property.span));
            }
        }
        parts
    }

    /// A problem of a property that is of another type.
    fn mistaken(&mut self, plugin: &Plugin, property: &Property, expected: &str) {
        let owner = described(plugin);
        let found = property.value.describe();
        self.report.add(
            &property.span,
            format!("`{}` of {owner} is {found}, expected {expected}", property.name),
            None,
        );
    }

    /// A number of a range, if there is one.
    pub(super) fn optional_number(
        &mut self,
        plugin: &'a Plugin,
        name: &'static str,
        range: RangeInclusive<f32>,
    ) -> Option<f32> {
        let property = self.property(plugin, name)?;
        let value = match property.value {
            Value::Float(value) => value as f32,
            Value::Integer(value) => value as f32,
            _ => {
                self.mistaken(plugin, property, "a number");
                return None;
            }
        };
        if range.contains(&value) {
            return Some(value);
        }
        let (least, most) = (range.start(), range.end());
        let accepted = match (*least, *most) {
            (l, m) if l == *POSITIVE.start() && m == 1e18 => "a number above 0".to_owned(),
            (_, 1e18) => format!("a number of at least {least}"),
            _ => format!("a number from {least} to {most}"),
        };
        let owner = described(plugin);
        self.report.add(&property.span, format!("`{name}` of {owner} is {value}, expected {accepted}"), None);
        None
    }

    /// A number of a range, or `default`.
    pub(super) fn number(
        &mut self,
        plugin: &'a Plugin,
        name: &'static str,
        range: RangeInclusive<f32>,
        default: f32,
    ) -> f32 {
        self.optional_number(plugin, name, range).unwrap_or(default)
    }

    /// A whole number of a range, or `default`.
    pub(super) fn whole(
        &mut self,
        plugin: &'a Plugin,
        name: &'static str,
        range: RangeInclusive<i64>,
        default: i64,
    ) -> i64 {
        let Some(property) = self.property(plugin, name) else { return default };
        match property.value {
            Value::Integer(value) if range.contains(&value) => value,
            Value::Integer(value) => {
                let (least, most) = (range.start(), range.end());
                let message = format!(
                    "`{name}` of {} is {value}, expected a whole number from {least} to {most}",
                    described(plugin)
                );
                self.report.add(&property.span, message, None);
                default
            }
            _ => {
                self.mistaken(plugin, property, "a whole number");
                default
            }
        }
    }

    /// True or false, or `default`.
    pub(super) fn flag(&mut self, plugin: &'a Plugin, name: &'static str, default: bool) -> bool {
        let Some(property) = self.property(plugin, name) else { return default };
        match property.value {
            Value::Flag(value) => value,
            _ => {
                self.mistaken(plugin, property, "a boolean");
                default
            }
        }
    }

    /// A text, if there is one.
    pub(super) fn text(&mut self, plugin: &'a Plugin, name: &'static str) -> Option<&'a str> {
        let property = self.property(plugin, name)?;
        match &property.value {
            Value::Text(text) => Some(text),
            _ => {
                self.mistaken(plugin, property, "a string");
                None
            }
        }
    }

    /// One of the words of a list, or `default` with a warning.
    pub(super) fn word<T: Copy>(
        &mut self,
        plugin: &'a Plugin,
        name: &'static str,
        words: &[(&str, T)],
        default: T,
    ) -> T {
        let Some(text) = self.text(plugin, name) else { return default };
        match words.iter().find(|(word, _)| word.eq_ignore_ascii_case(text)) {
            Some(&(_, value)) => value,
            None => {
                let help = advice(text, words.iter().map(|(word, _)| *word), "accepted", "\"");
                let span = self.property(plugin, name).map_or(&plugin.span, |property| &property.span);
                let message = format!("`{name}` of {} cannot be \"{}\"", described(plugin), clip(text));
                self.notices.add(span, message, Some(help));
                default
            }
        }
    }

    /// A point or vector, if there is one.
    pub(super) fn vector(&mut self, plugin: &'a Plugin, name: &'static str) -> Option<Vec3> {
        let property = self.property(plugin, name)?;
        match property.value {
            Value::Vector(vector) => Some(vector),
            _ => {
                self.mistaken(plugin, property, "a point or vector");
                None
            }
        }
    }

    /// A transform of space, or none.
    pub(super) fn transform(&mut self, plugin: &'a Plugin, name: &'static str) -> DAffine3 {
        DAffine3::from_mat4(self.matrix(plugin, name))
    }

    /// A transform as a matrix whose last row is 0 0 0 1.
    pub(super) fn matrix(&mut self, plugin: &'a Plugin, name: &'static str) -> DMat4 {
        let Some(property) = self.property(plugin, name) else { return DMat4::IDENTITY };
        match property.value {
            Value::Transform(matrix) => matrix,
            _ => {
                self.mistaken(plugin, property, "a transform");
                DMat4::IDENTITY
            }
        }
    }

    /// The colour of light that does not vary, or `default`.
    pub(super) fn light(&mut self, plugin: &'a Plugin, name: &'static str, default: Rgb) -> Rgb {
        let Some(property) = self.property(plugin, name) else { return default };
        let value = self.color_of(plugin, property, true);
        if value.texture.is_some() {
            let message = format!("`{name}` of {} varies; its mean is taken", described(plugin));
            self.notices.add(&property.span, message, None);
            return self.mean(&value);
        }
        value.factor
    }

    /// A constant spectrum as a colour: light, or a property of a surface; `None` for what is none.
    pub(super) fn constant_color(&self, value: &Value, is_light: bool) -> Option<Rgb> {
        Some(match value {
            Value::Color(color) => *color,
            Value::Float(value) => Rgb::gray(*value as f32),
            Value::Integer(value) => Rgb::gray(*value as f32),
            Value::Spectrum(pairs) if is_light => spectrum::color_of_light(pairs),
            Value::Spectrum(pairs) => spectrum::color_of_surface(pairs),
            Value::Blackbody { temperature, scale } => spectrum::blackbody(*temperature, *scale),
            _ => return None,
        })
    }

    /// Names all properties that nobody asked for.
    pub(super) fn finish(&mut self, plugin: &'a Plugin) {
        let asked = plugin.asked.borrow().clone();
        for property in plugin.properties.iter().filter(|property| !property.used.replace(true)) {
            let owner = described(plugin);
            let target = self.document.target(&property.value).map(|place| &self.document.plugins[place]);
            let (message, help) = match target {
                Some(target) if matches!(target.tag, Tag::Medium | Tag::Subsurface) => {
                    ("media are left out: light goes straight through".to_owned(), None)
                }
                Some(target) if property.name.is_empty() => {
                    (format!("{} has no use in {owner}", described(target)), None)
                }
                _ => {
                    let help = advice(&property.name, asked.iter().copied(), "accepted", "`");
                    (format!("{owner} has no `{}`: it is left out", clip(&property.name)), Some(help))
                }
            };
            self.notices.add(&property.span, message, help);
        }
    }

    /// Warns of something that `plugin` asks for and does not get.
    pub(super) fn warn(&mut self, span: &Span, message: impl Into<String>) {
        self.notices.add(span, message, None);
    }
}

/// A plugin in words: bsdf `diffuse`.
pub(super) fn described(plugin: &Plugin) -> String {
    format!("{} `{}`", plugin.tag.name(), clip(&plugin.kind))
}
