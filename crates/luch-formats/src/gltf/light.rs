//! Lamps of KHR_lights_punctual.
//!
//! The file counts in candela (point, spot) and lux (directional). All these, and the emission of materials in nits, share
//! the factor of 683 lm/W to watts, which for a whole picture is an exposure only. So the numbers are taken as they stand:
//! 1 cd is 1 W·sr⁻¹, 1 lx is 1 W·m⁻², 1 nt is 1 W·sr⁻¹·m⁻².

use super::Import;
use super::json::{Json, short};
use crate::Problem;
use glam::{DAffine3, DVec3, Vec3};
use luch_image::Rgb;
use luch_scene::Light;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

impl Import<'_> {
    /// Adds the lamp of a node; it shines along the node's −Z.
    pub(super) fn place_light(
        &mut self,
        node: &Json,
        extension: &Json,
        world: DAffine3,
    ) -> Result<(), Problem> {
        let index = extension.need("light")?.reference(&self.document.lights)?;
        let json = self.document.lights.at(index);
        json.name()?;
        let color = json.numbers_or("color", [1.0; 3])?;
        let strength = json.number_or("intensity", 1.0)?;
        let light = color.map(|channel| (channel * strength) as f32);
        let light = if light.iter().all(|channel| channel.is_finite() && *channel >= 0.0) {
            Rgb::from(light)
        } else {
            self.notices.add(
                json.path(),
                "a colour times an intensity that is negative or too large counts as 0 in that channel",
            );
            Rgb::from(light.map(|channel| if channel.is_finite() { channel.max(0.0) } else { 0.0 }))
        };
        if json.get("range")?.is_some() {
            self.notices.add(
                json.path(),
                "the range of a lamp is not honoured; its light falls with the square for ever",
            );
        }
        let position = world.translation.as_vec3();
        let direction = (world.matrix3 * DVec3::NEG_Z).try_normalize().map_or(Vec3::NEG_Z, DVec3::as_vec3);
        if !position.is_finite() || !direction.is_finite() {
            self.notices.add(node.path(), "a lamp whose transform is not finite is left out");
            return Ok(());
        }
        let kind = json.need("type")?;
        let light = match kind.text()? {
            "point" => Light::Point { position, intensity: light },
            "directional" => Light::Sun { direction, irradiance: light, angular_radius: 0.0 },
            "spot" => {
                let [inner_angle, outer_angle] = self.cone(&json)?;
                Light::Spot { position, direction, intensity: light, inner_angle, outer_angle }
            }
            other => {
                let message =
                    format!("is \"{}\", expected \"directional\", \"point\" or \"spot\"", short(other));
                return Err(kind.problem(message));
            }
        };
        self.scene.lights.push(light);
        Ok(())
    }

    /// The inner and outer half-angle of a spot.
    fn cone(&mut self, json: &Json) -> Result<[f32; 2], Problem> {
        let spot = json.need("spot")?;
        let inner = spot.number_or("innerConeAngle", 0.0)?;
        let outer = spot.number_or("outerConeAngle", FRAC_PI_4)?;
        let good_outer = outer.clamp(0.0, FRAC_PI_2);
        let good_inner = inner.clamp(0.0, good_outer);
        if (good_inner, good_outer) != (inner, outer) {
            let message = format!(
                "the cone angles {inner} and {outer} are not 0 ≤ inner ≤ outer ≤ π/2; the nearest are taken"
            );
            self.notices.add(spot.path(), message);
        }
        Ok([good_inner as f32, good_outer as f32])
    }
}
