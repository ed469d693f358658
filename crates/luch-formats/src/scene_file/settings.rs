//! `settings { … }`: how the picture is to be made.

use super::decoder::Decoder;
use super::fields::Fields;
use super::value::Range;
use super::{Spanned, fields::Argument};
use luch_image::tone::{Curve, Tone};
use luch_sampling::Sequence;
use luch_scene::{Filter, Integrator, Minification, Normals, Property, Settings};

/// Most pixels along a side.
const LONGEST_SIDE: u64 = 1 << 16;

/// Most samples of a pixel: what one randomisation has.
const MOST_SAMPLES: u64 = 1 << 33;

/// Stops by which a picture may be made brighter or darker.
const EXPOSURES: Range = Range { least: -64.0, most: 64.0, with_least: true, with_most: true };

/// Most scatterings of a path that can be asked for.
const DEEPEST_PATH: u64 = 1 << 20;

/// Integrators by name, with what their options say by default.
const INTEGRATORS: [(&str, Integrator); 5] = [
    ("path", Integrator::Path { max_depth: 64 }),
    ("plain-path", Integrator::PlainPath { max_depth: 64 }),
    ("direct", Integrator::Direct),
    ("occlusion", Integrator::Occlusion { distance: f32::INFINITY }),
    ("inspect", Integrator::Inspect(Property::Normal)),
];

/// Filters by name, with the usual width.
const FILTERS: [(&str, Filter); 4] = [
    ("box", Filter::Box { radius: 0.5 }),
    ("tent", Filter::Tent { radius: 1.0 }),
    ("gaussian", Filter::Gaussian { radius: 1.5, deviation: 0.5 }),
    ("blackman-harris", Filter::BlackmanHarris { radius: 1.5 }),
];

impl Decoder<'_> {
    pub(super) fn settings(&mut self, mut fields: Fields) {
        let span = fields.span.clone();
        if let Some(first) = &self.scene.settings {
            let first = first.span.clone();
            return self.twice(&span, &first, "`settings`");
        }
        let mut settings = Settings::default();
        if let Some(field) = fields.take(self, "size") {
            let mut size = field.fields();
            let arguments = size.all_arguments();
            match arguments.as_slice() {
                [width, height] => {
                    let side = |decoder: &mut Self, argument: &Argument| {
                        decoder.whole("`size`", argument, 1, LONGEST_SIDE).map(|side| side as u32)
                    };
                    settings.width = side(self, width).unwrap_or(settings.width);
                    settings.height = side(self, height).unwrap_or(settings.height);
                }
                _ => self.problem(&size.span, "`size` has two whole numbers: `size 960 540`", None),
            }
            size.finish(self, "option");
        }
        if let Some(field) = fields.take(self, "integrator") {
            settings.integrator = self.integrator(field.fields());
        }
        if let Some(field) = fields.take(self, "filter") {
            settings.filter = self.filter(field.fields());
        }
        let sequences = Sequence::ALL.map(|sequence| (sequence.name(), sequence));
        settings.sequence = self.word_or(&mut fields, "sequence", &sequences, settings.sequence);
        settings.seed = self.whole_or(&mut fields, "seed", 0, u64::MAX, settings.seed);
        let normals = [("smooth", Normals::Interpolated), ("flat", Normals::Flat)];
        settings.normals = self.word_or(&mut fields, "normals", &normals, settings.normals);
        settings.cull_back_faces = self.flag_or(&mut fields, "cull-back-faces", settings.cull_back_faces);
        let minifications = Minification::ALL.map(|kind| (kind.name(), kind));
        settings.texture_filter =
            self.word_or(&mut fields, "texture-filter", &minifications, settings.texture_filter);
        let samples = self.whole_or(&mut fields, "samples", 1, MOST_SAMPLES, 0);
        self.scene.wishes.samples = (samples > 0).then_some(samples);
        let curves = Curve::ALL.map(|curve| (curve.name(), curve));
        self.scene.wishes.tone = Tone {
            exposure: self.number_or(&mut fields, "exposure", EXPOSURES, 0.0),
            curve: self.word_or(&mut fields, "tone", &curves, Curve::Linear),
        };
        fields.finish(self, "setting");
        self.scene.settings = Some(Spanned { value: settings, span });
    }

    fn integrator(&mut self, mut fields: Fields) -> Integrator {
        let mut integrator = self.kind(&mut fields, &INTEGRATORS).unwrap_or_default();
        match &mut integrator {
            Integrator::Path { max_depth } | Integrator::PlainPath { max_depth } => {
                *max_depth =
                    self.whole_or(&mut fields, "max-depth", 0, DEEPEST_PATH, u64::from(*max_depth)) as u32;
            }
            Integrator::Direct => {}
            Integrator::Occlusion { distance } => {
                *distance = self.number_or(&mut fields, "distance", Range::POSITIVE, *distance);
            }
            Integrator::Inspect(property) => {
                let properties = Property::ALL.map(|property| (property.name(), property));
                *property = self.word_or(&mut fields, "property", &properties, *property);
            }
        }
        fields.finish(self, "option");
        integrator
    }

    fn filter(&mut self, mut fields: Fields) -> Filter {
        /// Filters wider than this are a slip of the pen.
        const WIDTH: Range = Range { least: 0.0, most: 64.0, with_least: false, with_most: true };
        let mut filter = self.kind(&mut fields, &FILTERS).unwrap_or_default();
        match &mut filter {
            Filter::Box { radius } | Filter::Tent { radius } | Filter::BlackmanHarris { radius } => {
                *radius = self.number_or(&mut fields, "radius", WIDTH, *radius);
            }
            Filter::Gaussian { radius, deviation } => {
                *radius = self.number_or(&mut fields, "radius", WIDTH, *radius);
                *deviation = self.number_or(&mut fields, "deviation", WIDTH, *deviation);
            }
        }
        fields.finish(self, "option");
        filter
    }

    /// The word a node begins with, one of a list.
    fn kind<T: Copy>(&mut self, fields: &mut Fields, kinds: &[(&str, T)]) -> Option<T> {
        let Some(argument) = fields.argument() else {
            let list: Vec<String> = kinds.iter().map(|(name, _)| format!("\"{name}\"")).collect();
            let message = format!("{} lacks its kind, one of {}", fields.owner, list.join(", "));
            self.problem(&fields.span, message, None);
            return None;
        };
        self.word(&fields.owner.clone(), &argument, kinds)
    }
}
