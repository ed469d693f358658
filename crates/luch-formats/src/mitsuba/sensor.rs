//! Sensors with their films, filters and samplers: where the picture is taken from, and how large it is.

use super::Import;
use super::fields::{ANY, NOT_NEGATIVE, POSITIVE, described};
use super::literal;
use super::tree::{Plugin, Tag};
use glam::{DAffine3, DVec3, Mat3};
use luch_scene::{Camera, Filter, NamedCamera, Projection};

/// Which extent of the picture an angle spans.
#[derive(Clone, Copy)]
enum Axis {
    X,
    Y,
    Diagonal,
    Smaller,
    Larger,
}

/// Longest side of a picture, pixels.
const LONGEST_SIDE: i64 = 1 << 16;

/// Most samples of a pixel.
const MOST_SAMPLES: i64 = 1 << 33;

impl<'a> Import<'a> {
    /// Adds a camera; the first one's film makes the picture's size.
    pub(super) fn sensor(&mut self, place: usize) {
        let plugin = &self.document.plugins[place];
        let aspect = self.film(plugin);
        self.sampler(plugin);
        let placement = self.transform(plugin, "to_world");
        self.number(plugin, "near_clip", ANY, 1e-2);
        let far = self.number(plugin, "far_clip", ANY, 1e4);
        self.ignore(plugin, &["shutter_open", "shutter_close", "srf", "kc"]);
        let is_orthographic = plugin.kind == "orthographic" || plugin.kind == "telecentric";
        let projection = match plugin.kind.as_str() {
            "perspective" | "thinlens" => self.perspective(plugin, aspect),
            "orthographic" | "telecentric" => {
                let [across, up] = [placement.matrix3.x_axis, placement.matrix3.y_axis].map(DVec3::length);
                if (across - up).abs() > 1e-4 * across {
                    self.warn(&plugin.span, "an orthographic sensor that is stretched: its height counts");
                }
                // The film spans −1 to 1 across.
                Projection::Orthographic { height: (2.0 * up / aspect) as f32 }
            }
            _ => {
                self.left_out(&plugin.span, &described(plugin));
                plugin.properties.iter().for_each(|property| property.used.set(true));
                return;
            }
        };
        for (name, offset) in ["principal_point_offset_x", "principal_point_offset_y"]
            .map(|name| (name, self.number(plugin, name, ANY, 0.0)))
        {
            if offset != 0.0 {
                self.warn(&plugin.span, format!("`{name}` is not supported: the picture is not shifted"));
            }
        }
        let has_lens = plugin.kind == "thinlens" || plugin.kind == "telecentric";
        let focus_distance = self.number(plugin, "focus_distance", POSITIVE, far.max(1e-6));
        let lens_radius =
            if has_lens { self.number(plugin, "aperture_radius", NOT_NEGATIVE, 0.0) } else { 0.0 };
        let Some(orientation) = orientation(&placement) else {
            self.report.add(&plugin.span, "the sensor is placed by a matrix that cannot be inverted", None);
            return;
        };
        let axes = [placement.matrix3.x_axis, placement.matrix3.y_axis, placement.matrix3.z_axis];
        if !is_orthographic && axes.iter().any(|axis| (axis.length() - 1.0).abs() > 1e-3) {
            self.warn(&plugin.span, "the scale in the placement of a perspective sensor is not used");
        }
        let position = placement.translation.as_vec3();
        let camera = Camera { position, orientation, projection, lens_radius, focus_distance };
        let name = plugin.id.clone().unwrap_or_default();
        self.scene.cameras.push(NamedCamera { name, camera });
        self.finish(plugin);
    }

    fn perspective(&mut self, plugin: &'a Plugin, aspect: f64) -> Projection {
        let axes = [
            ("x", Axis::X),
            ("y", Axis::Y),
            ("diagonal", Axis::Diagonal),
            ("smaller", Axis::Smaller),
            ("larger", Axis::Larger),
        ];
        let axis = self.word(plugin, "fov_axis", &axes, Axis::X);
        let angle = self.optional_number(plugin, "fov", 1e-3..=179.999);
        let length = self.text(plugin, "focal_length");
        // Half the extent of the picture at distance 1, along the axis that is spoken of.
        let (axis, half) = match (angle, length) {
            (Some(angle), _) => (axis, libm::tan(f64::from(angle).to_radians() / 2.0)),
            (None, length) => {
                // The diagonal of 35 mm film, 36 × 24 mm, is what a focal length speaks of.
                let millimetres = length.unwrap_or("50mm").trim_end_matches("mm");
                let millimetres = match literal::number(millimetres) {
                    Ok(number) if (0.01..=1e6).contains(&number) => number,
                    _ => {
                        let shown = crate::scene_file::clip(length.unwrap_or_default());
                        let span = self.property(plugin, "focal_length").map_or(&plugin.span, |p| &p.span);
                        self.report.add(
                            span,
                            format!("\"{shown}\" is no focal length such as \"50mm\""),
                            None,
                        );
                        50.0
                    }
                };
                (Axis::Diagonal, (36.0_f64 * 36.0 + 24.0 * 24.0).sqrt() / (2.0 * millimetres))
            }
        };
        let half_height = match axis {
            Axis::Y => half,
            Axis::X => half / aspect,
            Axis::Diagonal => half / (1.0 + aspect * aspect).sqrt(),
            Axis::Smaller => half / aspect.min(1.0),
            Axis::Larger => half / aspect.max(1.0),
        };
        Projection::Perspective { field_of_view_y: (2.0 * libm::atan(half_height)) as f32 }
    }

    /// Width over height of the film; sets the picture's size and filter if this is the first.
    fn film(&mut self, sensor: &'a Plugin) -> f64 {
        let films = self.parts(sensor, Tag::Film);
        // Some exporters put the filter beside the film.
        let mut filters = self.parts(sensor, Tag::Filter);
        let (mut width, mut height) = (768, 576);
        if let Some(&(place, span)) = films.first() {
            let film = &self.document.plugins[place];
            if !["hdrfilm", "ldrfilm", "tiledhdrfilm", "mfilm", "specfilm"].contains(&film.kind.as_str()) {
                self.warn(span, format!("{} is not known: only its size is read", described(film)));
            }
            width = self.whole(film, "width", 1..=LONGEST_SIDE, width);
            height = self.whole(film, "height", 1..=LONGEST_SIDE, height);
            let crop = ["crop_offset_x", "crop_offset_y", "crop_width", "crop_height"];
            let whole = [0, 0, width, height];
            let cropped = crop.iter().zip(whole).filter(|(name, whole)| {
                let value = self.whole(film, name, 0..=LONGEST_SIDE, *whole);
                value != *whole
            });
            if cropped.count() > 0 {
                self.warn(span, "the crop window of the film is not supported: the whole picture is made");
            }
            self.ignore(
                film,
                &[
                    "file_format",
                    "pixel_format",
                    "component_format",
                    "banner",
                    "high_quality_edges",
                    "sample_border",
                    "attach_log",
                    "compensate",
                    "gamma",
                    "exposure",
                    "tonemap_method",
                    "label",
                    "variable",
                    "digits",
                    "key",
                    "burn",
                    "temporary",
                ],
            );
            if film.kind == "ldrfilm" {
                self.warn(span, "the tone curve of `ldrfilm` is left to whoever shows the picture");
            }
            let own = self.parts(film, Tag::Filter);
            if !own.is_empty() {
                filters = own;
            }
            self.finish(film);
        }
        let filter = match filters.first() {
            Some(&(place, _)) => self.filter(place),
            None => Filter::Gaussian { radius: 2.0, deviation: 0.5 },
        };
        if !std::mem::replace(&mut self.has_film, true) {
            let settings = &mut self.scene.settings;
            (settings.width, settings.height, settings.filter) = (width as u32, height as u32, filter);
        }
        width as f64 / height as f64
    }

    fn filter(&mut self, place: usize) -> Filter {
        let plugin = &self.document.plugins[place];
        let filter = match plugin.kind.as_str() {
            "box" => Filter::Box { radius: self.number(plugin, "radius", 1e-3..=64.0, 0.5) },
            "tent" => Filter::Tent { radius: self.number(plugin, "radius", 1e-3..=64.0, 1.0) },
            "gaussian" => {
                let deviation = self.number(plugin, "stddev", 1e-3..=16.0, 0.5);
                Filter::Gaussian { radius: 4.0 * deviation, deviation }
            }
            kind => {
                self.ignore(plugin, &["B", "C", "A", "lobes", "b", "c"]);
                let known = ["mitchell", "catmullrom", "lanczos"].contains(&kind);
                let reason = if known { "has negative weights" } else { "is not known" };
                let message =
                    format!("{} {reason}: Blackman and Harris's window takes its place", described(plugin));
                self.warn(&plugin.span, message);
                Filter::BlackmanHarris { radius: 1.5 }
            }
        };
        self.finish(plugin);
        filter
    }

    fn sampler(&mut self, sensor: &'a Plugin) {
        let Some(&(place, _)) = self.parts(sensor, Tag::Sampler).first() else { return };
        let plugin = &self.document.plugins[place];
        let samples = self.whole(plugin, "sample_count", 1..=MOST_SAMPLES, 4);
        let seed = self.whole(plugin, "seed", i64::MIN..=i64::MAX, 0);
        if self.wishes.samples.is_none() {
            self.wishes.samples = Some(samples as u64);
            self.scene.settings.seed = seed as u64;
        }
        // Which points are taken is luch's own affair: every sampler leads to the same picture.
        self.ignore(plugin, &["jitter", "dimension", "scramble"]);
        self.finish(plugin);
    }
}

/// Right, up and backward of a camera that looks along +Z with +X to the left, and mirrored if its placement is.
fn orientation(placement: &DAffine3) -> Option<Mat3> {
    let m = placement.matrix3;
    let backward = -m.z_axis.try_normalize()?;
    let up = (m.y_axis - backward * backward.dot(m.y_axis)).try_normalize()?;
    let right = up.cross(backward);
    let mirrored = if m.determinant() < 0.0 { -right } else { right };
    Some(Mat3::from_cols(mirrored.as_vec3(), up.as_vec3(), backward.as_vec3()))
}
