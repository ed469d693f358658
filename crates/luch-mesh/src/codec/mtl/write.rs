//! The writer of material files.

use std::fmt::Write;

use glam::Vec3;

use super::{Channel, Field, KEYWORDS, MtlMaterial, MtlTexture};

/// Writes materials. Only what is set is written; reading gives the same values back.
pub fn encode(materials: &[MtlMaterial]) -> String {
    let mut text = String::new();
    for material in materials {
        let mut material = material.clone();
        let name = std::mem::take(&mut material.name);
        text.push_str(&format!("newmtl {name}\n"));
        for keyword in KEYWORDS {
            let values = match material.field(&keyword.to_ascii_lowercase()) {
                Some(Field::Color(Some(color))) => numbers(*color),
                Some(Field::Number(Some(number))) => number.to_string(),
                Some(Field::Map(Some(texture))) => texture.to_text(),
                _ => continue,
            };
            text.push_str(&format!("{keyword} {values}\n"));
        }
        if let Some(model) = material.illumination_model {
            text.push_str(&format!("illum {model}\n"));
        }
        text.push('\n');
    }
    text
}

fn numbers(vector: Vec3) -> String {
    format!("{} {} {}", vector.x, vector.y, vector.z)
}

impl MtlTexture {
    fn to_text(&self) -> String {
        let plain = Self::new("");
        let mut text = String::new();
        let mut option = |is_set: bool, name: &str, value: String| {
            if is_set {
                // Writing to a string cannot fail.
                let _ = write!(text, "-{name} {value} ");
            }
        };
        let on_off = |value: bool| if value { "on" } else { "off" }.to_owned();
        option(self.scale != plain.scale, "s", numbers(self.scale));
        option(self.offset != plain.offset, "o", numbers(self.offset));
        option(self.turbulence != plain.turbulence, "t", numbers(self.turbulence));
        option(self.clamp, "clamp", on_off(self.clamp));
        option(!self.blend_u, "blendu", on_off(self.blend_u));
        option(!self.blend_v, "blendv", on_off(self.blend_v));
        option(self.color_correction, "cc", on_off(self.color_correction));
        option(self.bump_multiplier != 1.0, "bm", self.bump_multiplier.to_string());
        let levels = (self.base, self.gain) != (0.0, 1.0);
        option(levels, "mm", format!("{} {}", self.base, self.gain));
        option(self.boost.is_some(), "boost", self.boost.unwrap_or_default().to_string());
        option(self.resolution.is_some(), "texres", self.resolution.unwrap_or_default().to_string());
        let letter = Channel::ALL.iter().find(|(channel, _)| Some(*channel) == self.channel);
        option(letter.is_some(), "imfchan", letter.map_or("", |(_, letter)| letter).to_owned());
        option(self.kind.is_some(), "type", self.kind.clone().unwrap_or_default());
        option(self.color_space.is_some(), "colorspace", self.color_space.clone().unwrap_or_default());
        text.push_str(&self.file);
        text
    }
}
