//! Metals: by name, or by their complex index of refraction.

use super::Import;
use super::fields::described;
use super::tree::Plugin;
use crate::scene_file::{advice, clip};
use luch_image::Rgb;
use luch_scene::{ColorValue, Metal, Reflectance};

/// Metals by Mitsuba's names, with η and k as its RGB variants reduce the measured spectra: averages over broad bands, where those of
/// [`luch_scene::Metal`] are at single wavelengths.
const METALS: [(&str, Rgb, Rgb); 11] = [
    ("Ag", Rgb::new(0.155276, 0.116728, 0.138388), Rgb::new(4.82835, 3.12222, 2.1469)),
    ("Al", Rgb::new(1.6575, 0.880405, 0.521244), Rgb::new(9.22381, 6.2695, 4.837)),
    ("Au", Rgb::new(0.143036, 0.375307, 1.44205), Rgb::new(3.983, 2.38556, 1.60336)),
    ("Cr", Rgb::new(4.36967, 2.91651, 1.6549), Rgb::new(5.20655, 4.23131, 3.7547)),
    ("Cu", Rgb::new(0.201005, 0.92375, 1.10222), Rgb::new(3.91326, 2.45305, 2.14209)),
    ("Hg", Rgb::new(2.39894, 1.44003, 0.90957), Rgb::new(6.32759, 4.37192, 3.42176)),
    ("Ir", Rgb::new(3.0863, 2.08219, 1.61791), Rgb::new(5.59215, 4.06709, 3.26731)),
    ("Mo", Rgb::new(4.48397, 3.52513, 2.77631), Rgb::new(4.11144, 3.42083, 3.15061)),
    ("Ni_palik", Rgb::new(2.3673, 1.66337, 1.46708), Rgb::new(4.49881, 3.05015, 2.34544)),
    ("Rh", Rgb::new(2.58579, 1.86022, 1.55426), Rgb::new(6.78226, 4.70299, 3.97607)),
    ("W", Rgb::new(4.37082, 3.30025, 2.99841), Rgb::new(3.50064, 2.60487, 2.27323)),
];

impl<'a> Import<'a> {
    /// What a facet of `conductor` and `roughconductor` reflects.
    pub(super) fn metal(&mut self, plugin: &'a Plugin) -> Reflectance {
        let is_old = self.document.version < 2;
        let material = self.text(plugin, "material");
        let eta = self.property(plugin, "eta");
        let k = self.property(plugin, "k");
        let tint = self.reflectance(plugin, "specular_reflectance", 1.0);
        let is_tinted = tint != ColorValue::constant(Rgb::WHITE);
        // Relative to what is outside; old files may say what that is.
        let outside = if self.property(plugin, "ext_eta").is_some() {
            self.number(plugin, "ext_eta", 0.1..=10.0, 1.0)
        } else {
            1.0
        };
        let index = match (material, eta, k) {
            (_, Some(eta), Some(k)) => {
                let [eta, k] = [eta, k].map(|property| {
                    let value = self.color_of(plugin, property, false);
                    if value.texture.is_some() {
                        self.warn(&property.span, "an index of refraction that varies: its mean is taken");
                    }
                    self.mean(&value) / outside
                });
                Some(Reflectance::Index { eta, k })
            }
            (_, Some(one), None) | (_, None, Some(one)) => {
                let message = format!("{} needs both `eta` and `k`, or `material`", described(plugin));
                self.report.add(&one.span, message, None);
                None
            }
            (Some("none"), ..) => None,
            (Some(name), ..) => Some(self.named_metal(plugin, name)),
            (None, ..) if is_old => Some(self.named_metal(plugin, "Cu")),
            (None, ..) => None,
        };
        match index {
            None => Reflectance::Color(tint),
            Some(index) if !is_tinted => index,
            Some(index) => {
                let message = "`specular_reflectance` of a metal: Fresnel's formula is replaced by Schlick's";
                self.warn(&plugin.span, message);
                let facing = facing_reflectance(&index);
                Reflectance::Color(ColorValue { factor: tint.factor * facing, ..tint })
            }
        }
    }

    fn named_metal(&mut self, plugin: &'a Plugin, name: &str) -> Reflectance {
        let known = METALS.iter().find(|(known, ..)| known.eq_ignore_ascii_case(name));
        let Some(&(_, eta, k)) = known else {
            let names = METALS.iter().map(|(known, ..)| *known).chain(["none"]);
            let help = advice(name, names, "known", "\"");
            let span = self.property(plugin, "material").map_or(&plugin.span, |property| &property.span);
            let message = format!("the metal \"{}\" is not known: chromium takes its place", clip(name));
            self.notices.add(span, message, Some(help));
            return Reflectance::Metal(Metal::Chromium);
        };
        Reflectance::Index { eta, k }
    }
}

/// Reflectance at normal incidence: ((η − 1)² + k²) / ((η + 1)² + k²).
fn facing_reflectance(reflectance: &Reflectance) -> Rgb {
    let (eta, k) = match reflectance {
        Reflectance::Metal(metal) => (metal.eta(), metal.k()),
        Reflectance::Index { eta, k } => (*eta, *k),
        Reflectance::Color(color) => return color.factor,
    };
    let one = |eta: f32, k: f32| {
        let above = (eta - 1.0) * (eta - 1.0) + k * k;
        (above / ((eta + 1.0) * (eta + 1.0) + k * k)).clamp(0.0, 1.0)
    };
    Rgb::new(one(eta.r, k.r), one(eta.g, k.g), one(eta.b, k.b))
}
