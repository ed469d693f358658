//! Indices of refraction by name or number.

use super::Import;
use super::fields::described;
use super::tree::{Plugin, Value};
use crate::scene_file::{advice, clip};

/// Indices at the yellow sodium line, as tables of optics give them.
const INDICES: [(&str, f32); 23] = [
    ("vacuum", 1.0),
    ("helium", 1.000_036),
    ("hydrogen", 1.000_132),
    ("air", 1.000_277),
    ("carbon dioxide", 1.000_45),
    ("water", 1.333),
    ("acetone", 1.36),
    ("ethanol", 1.361),
    ("carbon tetrachloride", 1.461),
    ("glycerol", 1.4729),
    ("benzene", 1.501),
    ("silicone oil", 1.520_45),
    ("bromine", 1.661),
    ("water ice", 1.31),
    ("fused quartz", 1.458),
    ("pyrex", 1.47),
    ("acrylic glass", 1.49),
    ("polypropylene", 1.49),
    ("bk7", 1.5046),
    ("sodium chloride", 1.544),
    ("amber", 1.55),
    ("pet", 1.575),
    ("diamond", 2.419),
];

impl<'a> Import<'a> {
    /// Index of the inside over the outside.
    pub(super) fn relative_index(&mut self, plugin: &'a Plugin, inside: f32) -> f32 {
        let inside = self.named_index(plugin, "int_ior", inside);
        let outside = self.named_index(plugin, "ext_ior", 1.000_277);
        let ratio = inside / outside;
        if (0.1..=10.0).contains(&ratio) {
            return ratio;
        }
        let message = format!(
            "{} has {inside} inside and {outside} outside, expected 0.1 to 10 times",
            described(plugin)
        );
        self.report.add(&plugin.span, message, None);
        1.5
    }

    fn named_index(&mut self, plugin: &'a Plugin, name: &'static str, default: f32) -> f32 {
        let Some(property) = self.property(plugin, name) else { return default };
        let Value::Text(text) = &property.value else {
            return self.number(plugin, name, 0.1..=10.0, default);
        };
        match INDICES.iter().find(|(known, _)| known.eq_ignore_ascii_case(text)) {
            Some(&(_, index)) => index,
            None => {
                let help = advice(text, INDICES.iter().map(|(known, _)| *known), "known", "\"");
                let message = format!("`{name}` of {} cannot be \"{}\"", described(plugin), clip(text));
                self.report.add(&property.span, message, Some(help));
                default
            }
        }
    }
}
