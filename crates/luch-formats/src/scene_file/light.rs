//! `point-light`, `spot-light`, `sun`, and the `environment`.

use super::decoder::Decoder;
use super::fields::Fields;
use super::value::Range;
use super::{EnvironmentSource, Spanned};
use crate::merge::place_light;
use glam::{Affine3A, Vec3};
use luch_image::Rgb;
use luch_scene::Light;

/// Half-angles of a cone in degrees.
const CONE: Range = Range::between(0.0, 180.0);

/// Half-angles under which a sun is seen, in degrees.
const SUN_RADIUS: Range = Range { least: 0.0, most: 90.0, with_least: true, with_most: false };

impl Decoder<'_> {
    /// One of the lamps; `outer` places the group it is in.
    pub(super) fn light(&mut self, mut fields: Fields, kind: &str, outer: &Affine3A) {
        // The name is for the reader of the file.
        fields.text_argument();
        let light = match kind {
            "point-light" => self.point_light(&mut fields),
            "spot-light" => self.spot_light(&mut fields),
            _ => self.sun(&mut fields),
        };
        fields.finish(self, "option");
        if let Some(light) = light {
            self.scene.lights.push(place_light(light, outer));
        }
    }

    fn point_light(&mut self, fields: &mut Fields) -> Option<Light> {
        let position = self.required(fields, "position", "position x y z", Self::optional_point);
        let intensity = self.required(fields, "intensity", "intensity 10", Self::strength);
        Some(Light::Point { position: position?, intensity: intensity? })
    }

    fn spot_light(&mut self, fields: &mut Fields) -> Option<Light> {
        let position = self.required(fields, "position", "position x y z", Self::optional_point);
        let has_target = fields.has("to") || fields.has("direction");
        let target = self.optional_point(fields, "to");
        let direction = self.optional_direction(fields, "direction");
        let toward = match (target, direction) {
            (Some(_), Some(_)) => {
                self.problem(&fields.span, "`spot-light` has both `to` and `direction`", None);
                None
            }
            (Some(target), None) => self.direction_to(fields, position, target),
            (None, Some(direction)) => Some(direction),
            (None, None) => {
                if !has_target {
                    let help = "write `to x y z` or `direction x y z` in its block";
                    self.problem(&fields.span, "`spot-light` shines nowhere", Some(help.into()));
                }
                None
            }
        };
        let intensity = self.required(fields, "intensity", "intensity 10", Self::strength);
        let outer = self.optional_angle(fields, "outer-angle", CONE).unwrap_or(30f32.to_radians());
        let inner = self.optional_angle(fields, "inner-angle", CONE).unwrap_or(outer * 0.8);
        if inner > outer {
            self.problem(&fields.span, "`inner-angle` of `spot-light` is larger than `outer-angle`", None);
        }
        let (inner_angle, outer_angle) = (inner, outer.min(std::f32::consts::PI));
        Some(Light::Spot {
            position: position?,
            direction: toward?,
            intensity: intensity?,
            inner_angle,
            outer_angle,
        })
    }

    fn direction_to(&mut self, fields: &Fields, position: Option<Vec3>, target: Vec3) -> Option<Vec3> {
        let direction = (target - position?).try_normalize();
        if direction.is_none() {
            self.problem(&fields.span, "`spot-light` shines at the point where it stands", None);
        }
        direction
    }

    fn sun(&mut self, fields: &mut Fields) -> Option<Light> {
        let direction = self.required(fields, "direction", "direction x y z", Self::optional_direction);
        let irradiance = self.required(fields, "irradiance", "irradiance 3", Self::strength);
        let angular_radius = self.optional_angle(fields, "angular-radius", SUN_RADIUS).unwrap_or(0.004_65);
        Some(Light::Sun { direction: direction?, irradiance: irradiance?, angular_radius })
    }

    fn strength(&mut self, fields: &mut Fields, name: &'static str) -> Option<Rgb> {
        self.optional_constant(fields, name, Range::NOT_NEGATIVE)
    }

    /// A field that must be there; `example` says how it is written.
    fn required<T>(
        &mut self,
        fields: &mut Fields,
        name: &'static str,
        example: &str,
        read: impl FnOnce(&mut Self, &mut Fields, &'static str) -> Option<T>,
    ) -> Option<T> {
        if !fields.has(name) {
            let message = format!("{} lacks `{name}`", fields.owner);
            self.problem(&fields.span, message, Some(format!("write `{example}` in its block")));
        }
        read(self, fields, name)
    }

    /// `environment 1 1 1`, `environment image="studio.exr"` or `environment preset="neutral"`.
    pub(super) fn environment(&mut self, mut fields: Fields) {
        let span = fields.span.clone();
        if let Some(first) = &self.scene.environment {
            let first = first.span.clone();
            return self.twice(&span, &first, "`environment`");
        }
        let image = self.optional_text(&mut fields, "image");
        let preset = fields.take(self, "preset");
        let environment = if image.is_some() || preset.is_some() {
            if let (Some(_), Some(preset)) = (&image, &preset) {
                self.problem(&preset.span, "`environment` has both `image` and `preset`", None);
            }
            let scale = self.constant_or(&mut fields, "scale", Range::NOT_NEGATIVE, Rgb::WHITE);
            let rotation = self.rotation(&mut fields);
            if let Some(argument) = preset.and_then(|field| self.single(field, "a word")) {
                self.word("`preset`", &argument, &[("neutral", ())]);
            }
            Some(match image {
                Some(path) => EnvironmentSource::Image { path, scale, rotation },
                None => EnvironmentSource::Neutral { scale, rotation },
            })
        } else {
            let arguments = fields.all_arguments();
            self.color("`environment`", &span, &arguments, Range::NOT_NEGATIVE)
                .map(EnvironmentSource::Constant)
        };
        fields.finish(self, "option");
        if let Some(value) = environment {
            self.scene.environment = Some(Spanned { value, span });
        }
    }
}
