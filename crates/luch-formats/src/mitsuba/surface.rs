//! Single surfaces: glass, plastics, the principled model.

use super::Import;
use super::fields::{UNIT, described};
use super::tree::{Plugin, Value};
use luch_image::Rgb;
use luch_scene::{ColorValue, Principled, ScalarValue, Surface};

/// Points of an integral over angles.
const STEPS: u32 = 1024;

impl<'a> Import<'a> {
    pub(super) fn dielectric(&mut self, plugin: &'a Plugin, roughness: ScalarValue) -> Surface {
        let ior = self.relative_index(plugin, 1.5046);
        let tint = self.reflectance(plugin, "specular_transmittance", 1.0);
        self.untinted_reflection(plugin);
        Surface::Dielectric { ior, roughness, tint }
    }

    /// Two parallel faces: light that is reflected between them leaves as well, R' = 2 R / (1 + R). luch's thin wall has one face; its
    /// index is that of a face that reflects R' at normal incidence.
    pub(super) fn thin_dielectric(&mut self, plugin: &'a Plugin) -> Surface {
        let ior = self.relative_index(plugin, 1.5046);
        let tint = self.reflectance(plugin, "specular_transmittance", 1.0);
        self.untinted_reflection(plugin);
        let root = (ior - 1.0) / (ior + 1.0);
        let both = (2.0 * root * root / (1.0 + root * root)).sqrt();
        Surface::Principled(Principled {
            base_color: tint,
            ior: ((1.0 + both) / (1.0 - both)).clamp(1.0, 10.0),
            roughness: 0.0.into(),
            transmission: 1.0.into(),
            thin_walled: true,
            ..Principled::default()
        })
    }

    fn untinted_reflection(&mut self, plugin: &'a Plugin) {
        let reflection = self.reflectance(plugin, "specular_reflectance", 1.0);
        if reflection != ColorValue::constant(Rgb::WHITE) {
            let message =
                format!("`specular_reflectance` of {} is not supported: it is 1", described(plugin));
            self.warn(&plugin.span, message);
        }
    }

    /// Diffuse below a coat. With `nonlinear`, light that the coat sends back down takes the colour again each time: the albedo c
    /// becomes c (1 − F) / (1 − c F), where F is what the coat sends back.
    pub(super) fn plastic(&mut self, plugin: &'a Plugin, roughness: ScalarValue) -> Surface {
        let ior = self.relative_index(plugin, 1.49);
        let base_color = self.reflectance(plugin, "diffuse_reflectance", 0.5);
        let base_color = if self.flag(plugin, "nonlinear", false) {
            let kept = internal_reflectance(ior);
            self.recolored(base_color, |albedo| albedo * (1.0 - kept) / (1.0 - albedo * kept))
        } else {
            base_color
        };
        self.untinted_reflection(plugin);
        Surface::Principled(Principled { base_color, ior, roughness, ..Principled::default() })
    }

    pub(super) fn principled(&mut self, plugin: &'a Plugin) -> Surface {
        let usual = Principled::default();
        let thin_walled = plugin.kind == "principledthin";
        let specular = self.optional_number(plugin, "specular", UNIT);
        let ior = match (self.optional_number(plugin, "eta", 1.0..=10.0), specular) {
            (Some(eta), _) => eta,
            // Disney's scale: 0.08 times it is the reflectance at normal incidence.
            (None, specular) => 2.0 / (1.0 - (0.08 * specular.unwrap_or(0.5)).sqrt()) - 1.0,
        };
        for name in [
            "spec_tint",
            "anisotropic",
            "sheen",
            "sheen_tint",
            "clearcoat",
            "clearcoat_gloss",
            "flatness",
            "diff_trans",
        ] {
            // These two say nothing unless the part that they are about is there.
            let matters = name != "sheen_tint" && name != "clearcoat_gloss";
            let Some(property) = self.property(plugin, name) else { continue };
            if matters && !matches!(property.value, Value::Float(0.0) | Value::Integer(0)) {
                let message = format!("`{name}` of {} is not supported: it is 0", described(plugin));
                self.warn(&property.span, message);
            }
        }
        self.ignore(
            plugin,
            &["main_specular_sampling_rate", "clearcoat_sampling_rate", "diffuse_reflectance_sampling_rate"],
        );
        Surface::Principled(Principled {
            base_color: self.reflectance(plugin, "base_color", 0.5),
            metallic: self.fraction(plugin, "metallic", 0.0),
            roughness: self.fraction(plugin, "roughness", 0.5),
            transmission: self.fraction(plugin, "spec_trans", 0.0),
            ior,
            thin_walled,
            ..usual
        })
    }

    pub(super) fn phong(&mut self, plugin: &'a Plugin) -> Surface {
        let exponent = self.number(plugin, "exponent", 0.0..=1e6, 30.0);
        let mut diffuse = self.reflectance(plugin, "diffuse_reflectance", 0.5);
        let mut specular = self.reflectance(plugin, "specular_reflectance", 0.2);
        let sum = (diffuse.factor + specular.factor).max_channel();
        if sum > 1.0 {
            self.warn(
                &plugin.span,
                "the two reflectances of `phong` add up to more than 1: they are scaled down",
            );
            diffuse.factor = diffuse.factor / sum;
            specular.factor = specular.factor / sum;
        }
        Surface::Phong { diffuse, specular, exponent: exponent.into() }
    }

    /// Perceptual roughness: the root of Mitsuba's `alpha`.
    pub(super) fn roughness(&mut self, plugin: &'a Plugin) -> ScalarValue {
        self.ignore(plugin, &["sample_visible"]);
        let distributions = [("ggx", true), ("beckmann", false), ("phong", false), ("as", false)];
        // Mitsuba's own default is Beckmann's.
        if !self.word(plugin, "distribution", &distributions, false) {
            self.warn(&plugin.span, "the facets are distributed by GGX, not by Beckmann");
        }
        let alpha = self.fraction(plugin, "alpha", 0.1);
        let [u, v] = ["alpha_u", "alpha_v"]
            .map(|name| self.property(plugin, name).map(|_| self.fraction(plugin, name, 0.1)));
        let alpha = match (u, v) {
            (Some(u), Some(v)) if u == v => u,
            (Some(u), Some(v)) => {
                self.warn(
                    &plugin.span,
                    "`alpha_u` and `alpha_v` differ: the root of their product is taken for both",
                );
                if u.texture.is_some() || v.texture.is_some() {
                    u
                } else {
                    (u.factor * v.factor).sqrt().into()
                }
            }
            (Some(one), None) | (None, Some(one)) => one,
            (None, None) => alpha,
        };
        self.changed(alpha, |alpha| alpha.clamp(0.0, 1.0).sqrt())
    }
}

/// Mean reflectance of a smooth face of relative index `ior` for light from below, uniform over the hemisphere:
/// 1 − (1 − F) / η², where F is that of light from above.
fn internal_reflectance(ior: f32) -> f32 {
    let eta = f64::from(ior);
    let reflectance = |cosine: f64| {
        let below = (1.0 - (1.0 - cosine * cosine) / (eta * eta)).max(0.0).sqrt();
        let across = (cosine - eta * below) / (cosine + eta * below);
        let along = (eta * cosine - below) / (eta * cosine + below);
        (across * across + along * along) / 2.0
    };
    let sum: f64 = (0..STEPS)
        .map(|step| {
            let cosine = (f64::from(step) + 0.5) / f64::from(STEPS);
            2.0 * cosine * reflectance(cosine)
        })
        .sum();
    (1.0 - (1.0 - sum / f64::from(STEPS)) / (eta * eta)).clamp(0.0, 1.0) as f32
}

#[cfg(test)]
mod tests {
    use super::internal_reflectance;

    #[test]
    fn a_coat_sends_back_what_tables_say() {
        // d'Eon and Irving 2011, and Egan and Hilgeman's fit: 0.5961 at 1.5, 0 at 1.
        assert!((internal_reflectance(1.5) - 0.596).abs() < 1e-3, "{}", internal_reflectance(1.5));
        assert!(internal_reflectance(1.0).abs() < 1e-6);
    }
}
