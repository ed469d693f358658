//! Lamps without a surface, and what surrounds the scene.

use super::Import;
use super::fields::{NOT_NEGATIVE, described};
use super::tree::Plugin;
use glam::{DAffine3, DMat3, DVec3, Vec3};
use luch_image::Rgb;
use luch_scene::{Environment, Light};

impl<'a> Import<'a> {
    /// Adds an emitter that is no part of a shape.
    pub(super) fn emitter(&mut self, place: usize) {
        let plugin = &self.document.plugins[place];
        self.ignore(plugin, &["sampling_weight"]);
        match plugin.kind.as_str() {
            "point" => self.point(plugin),
            "spot" => self.spot(plugin),
            "directional" => self.directional(plugin),
            "constant" => {
                let radiance = self.light(plugin, "radiance", Rgb::WHITE);
                self.surround(plugin, Environment::Constant { radiance });
            }
            "envmap" => self.envmap(plugin),
            "area" => {
                let message = "an area emitter that is inside no shape lights nothing";
                self.report.add(&plugin.span, message, Some("put it into a `shape`".to_owned()));
                return;
            }
            _ => {
                self.left_out(&plugin.span, &described(plugin));
                plugin.properties.iter().for_each(|property| property.used.set(true));
                return;
            }
        }
        self.finish(plugin);
    }

    fn point(&mut self, plugin: &'a Plugin) {
        let placement = self.transform(plugin, "to_world");
        let position = self.vector(plugin, "position").unwrap_or(placement.translation.as_vec3());
        let intensity = self.light(plugin, "intensity", Rgb::WHITE);
        self.scene.lights.push(Light::Point { position, intensity });
    }

    fn spot(&mut self, plugin: &'a Plugin) {
        let placement = self.transform(plugin, "to_world");
        let cutoff = self.number(plugin, "cutoff_angle", 0.0..=180.0, 20.0);
        let beam = self.number(plugin, "beam_width", 0.0..=180.0, cutoff * 0.75);
        let intensity = self.light(plugin, "intensity", Rgb::WHITE);
        if let Some(texture) = self.property(plugin, "texture") {
            self.warn(&texture.span, "the `texture` of a spot is not supported: its light is even");
        }
        let Some(direction) = self.direction(plugin, &placement) else { return };
        if beam < cutoff {
            self.warn(
                &plugin.span,
                "the rim of a spot falls off with the square of the cosine, not with the angle",
            );
        }
        self.scene.lights.push(Light::Spot {
            position: placement.translation.as_vec3(),
            direction,
            intensity,
            inner_angle: beam.min(cutoff).to_radians(),
            outer_angle: cutoff.to_radians(),
        });
    }

    fn directional(&mut self, plugin: &'a Plugin) {
        let placement = self.transform(plugin, "to_world");
        let irradiance = self.light(plugin, "irradiance", Rgb::WHITE);
        let direction = match self.vector(plugin, "direction") {
            Some(given) => given.try_normalize(),
            None => self.direction(plugin, &placement),
        };
        match direction {
            Some(direction) => {
                self.scene.lights.push(Light::Sun { direction, irradiance, angular_radius: 0.0 })
            }
            None => self.report.add(&plugin.span, "this light has no direction", None),
        }
    }

    /// Where +Z goes.
    fn direction(&mut self, plugin: &'a Plugin, placement: &DAffine3) -> Option<Vec3> {
        let direction =
            placement.matrix3.z_axis.try_normalize().map(DVec3::as_vec3).and_then(Vec3::try_normalize);
        if direction.is_none() {
            self.report.add(&plugin.span, "the transform of this light leaves it no direction", None);
        }
        direction
    }

    fn envmap(&mut self, plugin: &'a Plugin) {
        let scale = self.number(plugin, "scale", NOT_NEGATIVE, 1.0);
        let placement = self.transform(plugin, "to_world");
        self.ignore(plugin, &["mis_compensation", "cache"]);
        let image = self.image(plugin);
        let m = placement.matrix3;
        let lengths = [m.x_axis, m.y_axis, m.z_axis].map(DVec3::length);
        let size = lengths[0];
        let turned = m * (1.0 / size);
        if !(turned.transpose() * turned).abs_diff_eq(DMat3::IDENTITY, 1e-3) {
            self.report.add(&plugin.span, "the transform of an environment must be a rotation", None);
            return;
        }
        // The first column of Mitsuba's pictures is −Z, ours is +Z: half a turn about +Y.
        let half_turn = DMat3::from_diagonal(DVec3::new(-1.0, 1.0, -1.0));
        let rotation = orthonormal(turned * half_turn).as_mat3();
        let environment = match image {
            Some(image) => Environment::LatLong { image, scale: Rgb::gray(scale), rotation },
            None => Environment::Constant { radiance: Rgb::gray(0.5 * scale) },
        };
        self.surround(plugin, environment);
    }

    fn surround(&mut self, plugin: &'a Plugin, environment: Environment) {
        if self.scene.environment.is_some() {
            self.report.add(&plugin.span, "the scene has two environments, expected one", None);
        }
        self.scene.environment = Some(environment);
    }
}

/// The rotation nearest to one with rounded numbers.
fn orthonormal(m: DMat3) -> DMat3 {
    let x = m.x_axis.normalize_or(DVec3::X);
    let y = (m.y_axis - x * x.dot(m.y_axis)).normalize_or(DVec3::Y);
    let z = x.cross(y);
    DMat3::from_cols(x, y, if z.dot(m.z_axis) < 0.0 { -z } else { z })
}
