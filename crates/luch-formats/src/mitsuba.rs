//! Scenes of Mitsuba (XML, versions 0.4 to 3).
//!
//! [`read`] turns the text into a tree of plugins whose values know their places: parameters are put in, included files
//! spliced, names of before version 2 renewed. The other modules make a scene of it, each for one family of plugins. What is
//! not honoured is named once for each kind, with its line; what is contradictory or misspelt is an error.
//!
//! Where Mitsuba's conventions differ from ours: its cameras look along +Z with +X to the left, v runs down, its meshes face
//! where their shading normals point, and its sides of paths are counted with the one from the eye.

mod bsdf;
mod conductor;
mod directive;
mod emitter;
mod fields;
mod index;
mod integrator;
mod literal;
mod mesh;
mod notices;
mod primitive;
mod read;
mod sensor;
mod serialized;
mod shape;
mod spectrum;
mod surface;
mod texture;
mod transform;
mod tree;
mod value;

use crate::images::{Images, Pictures};
use crate::scene_file::{Report, Span};
use crate::{Files, LoadError, Loaded, Warning, Wishes};
use glam::DAffine3;
use luch_scene::{ColorValue, Id, Material, Scene, Shape};
use mesh::MeshKey;
use notices::Notices;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use tree::{Document, Tag};

/// Reads a Mitsuba scene; it may lack a camera and light. `parameters` replace the defaults in the file.
///
/// # Errors
/// All that is wrong in the file and in those it needs.
pub(crate) fn load(
    path: &Path,
    files: &Files,
    pictures: Pictures,
    parameters: &BTreeMap<String, String>,
) -> Result<Loaded, LoadError> {
    let read::Reading { report, document, .. } = read::Reading::read(path, files, parameters)?;
    let mut import = Import {
        document: &document,
        files,
        file: path.to_owned(),
        report,
        notices: Notices::default(),
        warnings: Vec::new(),
        notes: Vec::new(),
        images: Images::new(files, pictures),
        scene: Scene::default(),
        wishes: Wishes::default(),
        materials: BTreeMap::new(),
        surfaces: BTreeMap::new(),
        open: Vec::new(),
        textures: BTreeMap::new(),
        meshes: BTreeMap::new(),
        computed: BTreeSet::new(),
        triangles: 0,
        is_one_sided: false,
        has_film: false,
    };
    import.everything();
    import.loaded()
}

/// A document on its way to a scene.
struct Import<'a> {
    document: &'a Document,
    files: &'a Files,
    file: PathBuf,
    report: Report,
    notices: Notices,
    /// Of other files.
    warnings: Vec<Warning>,
    notes: Vec<String>,
    images: Images<'a>,
    scene: Scene,
    wishes: Wishes,
    /// By the plugins of surface and emitter.
    materials: BTreeMap<(Option<usize>, Option<usize>), Id<Material>>,
    /// Surfaces by plugin, before anything emits.
    surfaces: BTreeMap<usize, Material>,
    /// Plugins whose parts are being made, against cycles.
    open: Vec<usize>,
    /// By the plugin and whether numbers are read as they are stored.
    textures: BTreeMap<(usize, bool), ColorValue>,
    meshes: BTreeMap<MeshKey, Option<Id<Shape>>>,
    /// Meshes whose files have no normals, by their places in the scene.
    computed: BTreeSet<usize>,
    /// Triangles of all meshes so far.
    triangles: usize,
    /// Whether a surface has a back that would be black.
    is_one_sided: bool,
    /// Whether a camera has said how large the picture is.
    has_film: bool,
}

impl Import<'_> {
    /// All that stands at the top of the document.
    fn everything(&mut self) {
        let root = &self.document.plugins[0];
        for (tag, convert) in [
            (Tag::Sensor, Self::sensor as fn(&mut Self, usize)),
            (Tag::Integrator, Self::integrator),
            (Tag::Shape, |import, place| import.shape(place, DAffine3::IDENTITY)),
            (Tag::Emitter, Self::emitter),
        ] {
            for (place, _) in self.parts(root, tag) {
                convert(self, place);
            }
        }
        self.default_integrator();
        // What may be referred to is read where it is.
        for tag in [
            Tag::Bsdf,
            Tag::Texture,
            Tag::Medium,
            Tag::Phase,
            Tag::Volume,
            Tag::Film,
            Tag::Sampler,
            Tag::Filter,
        ] {
            self.parts(root, tag);
        }
        self.finish(root);
        if self.is_one_sided {
            self.notes.push("surfaces outside `twosided` scatter light on their backs as well, which are black in Mitsuba".into());
        }
    }

    fn loaded(self) -> Result<Loaded, LoadError> {
        let Self { report, notices, scene, wishes, notes, .. } = self;
        if report.count() > 0 {
            return Err(LoadError { problems: report.into_problems() });
        }
        let mut warnings = notices.into_warnings(&report);
        warnings.extend(self.warnings);
        Ok(Loaded { scene, warnings, notes, wishes })
    }

    /// The path that a name in the document means: in the folder of the scene, in those that it names, or, for paths of
    /// another machine, beside the scene by the last part.
    fn path(&self, name: &str) -> PathBuf {
        let beside = Files::beside(&self.file, name);
        let last = name.rsplit(['/', '\\']).next().unwrap_or(name);
        let folders = self.document.folders.iter().map(|folder| Files::beside(&self.file, folder).join(name));
        let near = std::iter::once(Files::beside(&self.file, last));
        let all = std::iter::once(beside.clone()).chain(folders).chain(near);
        all.into_iter().find(|path| self.files.has(path)).unwrap_or(beside)
    }

    /// Warns that `span` is left out.
    fn left_out(&mut self, span: &Span, what: &str) {
        self.notices.add(span, format!("{what} is not supported: it is left out"), None);
    }
}
