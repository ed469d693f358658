//! Integrators: how light is carried, and how many times it may scatter.

use super::Import;
use super::fields::{POSITIVE, described};
use super::tree::Tag;
use luch_scene::{Integrator, Property};

/// Most scatterings where the file sets no bound.
const DEEPEST: i64 = 1 << 20;

/// Settings of how the work is done, which change no picture.
const WORK: [&str; 16] = [
    "rr_depth",
    "block_size",
    "samples_per_pass",
    "timeout",
    "version",
    "strict_normals",
    "emitter_samples",
    "bsdf_samples",
    "shading_samples",
    "direct_samples",
    "light_image",
    "sample_direct",
    "lt_spp",
    "mis",
    "use_mis",
    "sppmbc",
];

impl Import<'_> {
    /// Sets the integrator from a plugin.
    pub(super) fn integrator(&mut self, place: usize) {
        let plugin = &self.document.plugins[place];
        self.ignore(plugin, &WORK);
        let owner = described(plugin);
        match plugin.kind.as_str() {
            "path" | "volpath" | "volpathmis" | "volpath_simple" | "prb" | "prb_basic" | "prbvolpath" => {
                self.path_integrator(place);
            }
            "direct" | "direct_projective" | "emission_reparam" => {
                self.scene.settings.integrator = Integrator::Direct;
                self.hidden_emitters(place);
            }
            "bdpt" | "pssmlt" | "mlt" | "erpt" | "ptracer" | "photonmapper" | "ppm" | "sppm" | "vpl" => {
                self.path_integrator(place);
                self.warn(
                    &plugin.span,
                    format!("{owner} becomes a path tracer: another way to the same picture"),
                );
            }
            "ao" | "AO" => {
                let distance = self.number(plugin, "ray_length", -1.0..=1e18, -1.0);
                let distance = if distance > 0.0 { distance } else { f32::INFINITY };
                self.scene.settings.integrator = Integrator::Occlusion { distance };
            }
            "depth" => {
                self.scene.settings.integrator = Integrator::Inspect(Property::Depth);
                self.warn(
                    &plugin.span,
                    "`depth` shows the distance along the viewing axis, not along the ray",
                );
            }
            "moment" | "aov" | "adaptive" | "irrcache" | "multichannel" => self.wrapping_integrator(place),
            _ => {
                self.path_integrator(place);
                self.warn(&plugin.span, format!("{owner} is not known: a path tracer takes its place"));
            }
        }
        self.finish(plugin);
    }

    /// The document has no integrator: Mitsuba takes a path tracer without bound.
    pub(super) fn default_integrator(&mut self) {
        let root = &self.document.plugins[0];
        let has_one = root.properties.iter().any(|property| {
            let target = self.document.target(&property.value);
            target.is_some_and(|target| self.document.plugins[target].tag == Tag::Integrator)
        });
        if !has_one {
            self.scene.settings.integrator = Integrator::Path { max_depth: DEEPEST as u32 };
        }
    }

    fn path_integrator(&mut self, place: usize) {
        let plugin = &self.document.plugins[place];
        // Mitsuba counts the pieces of a path, luch its corners on surfaces; -1 means no bound.
        let pieces = self.whole(plugin, "max_depth", -1..=i64::from(i32::MAX), -1);
        if pieces == 0 {
            self.warn(&plugin.span, "`max_depth` 0 would show nothing: lamps are shown");
        }
        let max_depth = if pieces < 0 { DEEPEST } else { (pieces - 1).clamp(0, DEEPEST) };
        self.scene.settings.integrator = Integrator::Path { max_depth: max_depth as u32 };
        self.hidden_emitters(place);
    }

    fn hidden_emitters(&mut self, place: usize) {
        let plugin = &self.document.plugins[place];
        if self.flag(plugin, "hide_emitters", false) {
            self.warn(&plugin.span, "`hide_emitters` is not supported: lamps are seen");
        }
    }

    /// Integrators that say more about the picture of another one.
    fn wrapping_integrator(&mut self, place: usize) {
        let plugin = &self.document.plugins[place];
        let owner = described(plugin);
        self.ignore(plugin, &["aovs"]);
        self.number(plugin, "max_error", POSITIVE, 1.0);
        self.warn(&plugin.span, format!("{owner}: only the picture of the integrator inside it is made"));
        let inner = self.parts(plugin, Tag::Integrator);
        if self.open.len() > 8 || self.open.contains(&place) {
            self.report.add(&plugin.span, "integrators stand inside one another without end", None);
            return;
        }
        self.open.push(place);
        match inner.first() {
            Some(&(inner, _)) => self.integrator(inner),
            None => self.scene.settings.integrator = Integrator::Path { max_depth: DEEPEST as u32 },
        }
        self.open.pop();
    }
}
