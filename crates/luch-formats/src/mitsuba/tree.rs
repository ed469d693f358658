//! A scene as the XML says it: plugins with their properties, names not yet followed.

use crate::scene_file::Span;
use glam::{DMat4, Vec3};
use luch_image::Rgb;
use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};

/// What kind of thing an element describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tag {
    Scene,
    Integrator,
    Sensor,
    Film,
    Filter,
    Sampler,
    Shape,
    Bsdf,
    Emitter,
    Texture,
    Medium,
    Phase,
    Volume,
    Subsurface,
}

impl Tag {
    /// Elements that describe a plugin, by the names that some version of the format gives them.
    pub(super) const NAMES: [(&str, Tag); 16] = [
        ("scene", Tag::Scene),
        ("integrator", Tag::Integrator),
        ("sensor", Tag::Sensor),
        ("camera", Tag::Sensor),
        ("film", Tag::Film),
        ("rfilter", Tag::Filter),
        ("sampler", Tag::Sampler),
        ("shape", Tag::Shape),
        ("bsdf", Tag::Bsdf),
        ("emitter", Tag::Emitter),
        ("luminaire", Tag::Emitter),
        ("texture", Tag::Texture),
        ("medium", Tag::Medium),
        ("phase", Tag::Phase),
        ("volume", Tag::Volume),
        ("subsurface", Tag::Subsurface),
    ];

    /// The name of today's format.
    pub(super) fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, tag)| *tag == self).map_or("plugin", |(name, _)| name)
    }
}

/// One element with a type: `<bsdf type="diffuse">`.
#[derive(Debug)]
pub(super) struct Plugin {
    pub(super) tag: Tag,
    /// The type.
    pub(super) kind: String,
    pub(super) id: Option<String>,
    /// The beginning of the element.
    pub(super) span: Span,
    pub(super) properties: Vec<Property>,
    /// Names that were asked for, to tell what is accepted.
    pub(super) asked: RefCell<BTreeSet<&'static str>>,
}

/// A value of a plugin.
#[derive(Debug)]
pub(super) struct Property {
    /// Empty for nested plugins and references without a name.
    pub(super) name: String,
    pub(super) span: Span,
    pub(super) value: Value,
    /// Whether anybody has looked at it.
    pub(super) used: Cell<bool>,
}

/// What a property is.
#[derive(Debug)]
pub(super) enum Value {
    Integer(i64),
    Float(f64),
    Flag(bool),
    Text(String),
    Vector(Vec3),
    /// Linear Rec. 709.
    Color(Rgb),
    /// Wavelengths in nanometres and values, wavelengths rising.
    Spectrum(Vec<[f64; 2]>),
    /// Planck's radiance at a temperature in kelvin, times a factor.
    Blackbody {
        temperature: f64,
        scale: f64,
    },
    Transform(DMat4),
    /// A place among the plugins.
    Plugin(usize),
    /// The id of a plugin.
    Reference(String),
}

impl Value {
    /// What the value is, for messages.
    pub(super) fn describe(&self) -> &'static str {
        match self {
            Value::Integer(_) => "a whole number",
            Value::Float(_) => "a number",
            Value::Flag(_) => "a boolean",
            Value::Text(_) => "a string",
            Value::Vector(_) => "a point or vector",
            Value::Color(_) => "a colour",
            Value::Spectrum(_) | Value::Blackbody { .. } => "a spectrum",
            Value::Transform(_) => "a transform",
            Value::Plugin(_) | Value::Reference(_) => "a plugin",
        }
    }
}

/// All plugins of a scene.
#[derive(Debug, Default)]
pub(super) struct Document {
    pub(super) plugins: Vec<Plugin>,
    /// Plugins by id; aliases are further ids.
    pub(super) ids: BTreeMap<String, usize>,
    /// Folders in which files are looked for, as written.
    pub(super) folders: Vec<String>,
    /// The major version of the scene's format.
    pub(super) version: u32,
}

impl Document {
    /// The plugin that a property holds or refers to.
    pub(super) fn target(&self, value: &Value) -> Option<usize> {
        match value {
            Value::Plugin(place) => Some(*place),
            Value::Reference(id) => self.ids.get(id).copied(),
            _ => None,
        }
    }
}
