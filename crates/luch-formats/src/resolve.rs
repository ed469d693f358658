//! From [`SceneFile`] to [`Scene`]: names become ids, paths become data.

mod materials;
mod meshes;
mod views;

use crate::images::{Images, Pictures};
use crate::scene_file::{
    self, EnvironmentSource, ObjectSource, Report, SceneFile, ShapeSource, Span, Spanned, advice, clip,
};
use crate::{Files, LoadError, Loaded, Problem, Warning, format, merge, neutral_sky};
use luch_image::Rgb;
use luch_scene::{Environment, Id, Instance, Material, Scene, Shape};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// Most scene files that import one another.
const DEEPEST_IMPORT: usize = 8;

/// The files that scenes import from one another.
#[derive(Default)]
pub(crate) struct Imports {
    /// Those being read, one inside the other.
    open: Vec<PathBuf>,
    /// Those read before, `None` if they are wrong: a file that is imported often is read once.
    known: BTreeMap<PathBuf, Option<Rc<Scene>>>,
    /// The pictures of all of them.
    pictures: Pictures,
    /// Values for the parameters of the file that is loaded, not of those it imports.
    parameters: BTreeMap<String, String>,
}

impl Imports {
    /// No files yet; `parameters` are for the first.
    pub(crate) fn new(parameters: &BTreeMap<String, String>) -> Self {
        Self { parameters: parameters.clone(), ..Self::default() }
    }

    /// The pictures of all files that are read.
    pub(crate) fn pictures(&self) -> Pictures {
        self.pictures.clone()
    }

    /// The parameters for a file that is read now.
    pub(crate) fn parameters(&self) -> BTreeMap<String, String> {
        if self.open.is_empty() { self.parameters.clone() } else { BTreeMap::new() }
    }
}

/// Reads a scene in luch's own format.
///
/// # Errors
/// All that is wrong in the file and in those it needs.
pub(crate) fn load(path: &Path, files: &Files, imports: &mut Imports) -> Result<Loaded, LoadError> {
    let (scene_file, report) = scene_file::read(path, files)?;
    imports.open.push(path.to_owned());
    let images = Images::new(files, imports.pictures());
    let resolver = Resolver {
        files,
        imports,
        report,
        images,
        scene: Scene::default(),
        warnings: Vec::new(),
        notes: Vec::new(),
    };
    let loaded = resolver.resolve(scene_file);
    imports.open.pop();
    loaded
}

/// A scene on its way.
struct Resolver<'a> {
    files: &'a Files,
    imports: &'a mut Imports,
    report: Report,
    images: Images<'a>,
    scene: Scene,
    warnings: Vec<Warning>,
    notes: Vec<String>,
}

/// The places of named things.
type Names = BTreeMap<String, usize>;

impl Resolver<'_> {
    fn resolve(mut self, mut file: SceneFile) -> Result<Loaded, LoadError> {
        self.scene.settings = file.settings.as_ref().map(|settings| settings.value).unwrap_or_default();
        let uses = self.materials(&file);
        let shapes = self.meshes(&file);
        self.objects(std::mem::take(&mut file.objects), &uses, &shapes);
        self.scene.lights = file.lights;
        self.scene.cameras = file.cameras.into_iter().map(|camera| camera.value).collect();
        self.environment(file.environment);
        self.put_imports(&file.imports);
        if self.report.count() > 0 {
            return Err(LoadError { problems: self.report.into_problems() });
        }
        Ok(Loaded { scene: self.scene, warnings: self.warnings, notes: self.notes, wishes: file.wishes })
    }

    /// The path that a name in a scene file means.
    fn path(&self, name: &Spanned<String>) -> PathBuf {
        Files::beside(&self.report.sources[name.span.source].path, &name.value)
    }

    /// The places of the names of one kind of thing; a name that is there twice is a problem.
    fn names<'b>(&mut self, kind: &str, names: impl Iterator<Item = Option<&'b Spanned<String>>>) -> Names {
        let mut known: BTreeMap<String, (usize, Span)> = BTreeMap::new();
        for (place, name) in names.enumerate() {
            let Some(name) = name else { continue };
            if let Some((_, first)) = known.get(&name.value) {
                let help = format!("first {}", self.report.line(first, &name.span));
                self.report.add(
                    &name.span,
                    format!("{kind} \"{}\" is defined twice", clip(&name.value)),
                    Some(help),
                );
            } else {
                known.insert(name.value.clone(), (place, name.span.clone()));
            }
        }
        known.into_iter().map(|(name, (place, _))| (name, place)).collect()
    }

    /// The place of what `name` refers to.
    fn find(&mut self, kind: &str, names: &Names, name: &Spanned<String>) -> Option<usize> {
        let found = names.get(&name.value).copied();
        if found.is_none() && !self.report.is_full() {
            let help = advice(&name.value, names.keys().map(String::as_str), "defined", "\"");
            self.report.add(&name.span, format!("unknown {kind} \"{}\"", clip(&name.value)), Some(help));
        }
        found
    }

    fn objects(
        &mut self,
        objects: Vec<ObjectSource>,
        uses: &[Option<Id<Material>>],
        meshes: &meshes::Meshes,
    ) {
        let mut clay = None;
        // Equal shapes are one, by kind and bits of the radius.
        let mut known: BTreeMap<(u8, u32), Id<Shape>> = BTreeMap::new();
        for object in objects {
            let shape = match &object.shape {
                ShapeSource::Mesh(name) => {
                    self.find("mesh", &meshes.names, name).and_then(|at| meshes.shapes[at])
                }
                ShapeSource::InlineMesh(place) => meshes.shapes[*place],
                ShapeSource::Sphere { radius } => {
                    let new = || self.scene.add_shape(Shape::Sphere { radius: *radius });
                    Some(*known.entry((0, radius.to_bits())).or_insert_with(new))
                }
                ShapeSource::Disc { radius } => {
                    let new = || self.scene.add_shape(Shape::Disc { radius: *radius });
                    Some(*known.entry((1, radius.to_bits())).or_insert_with(new))
                }
                ShapeSource::HeightField(step) => self.height_field(step),
                ShapeSource::Traced(form) => Some(self.scene.add_shape(Shape::Traced(form.clone()))),
                ShapeSource::Plane => {
                    Some(*known.entry((2, 0)).or_insert_with(|| self.scene.add_shape(Shape::Plane)))
                }
            };
            let mut materials: Vec<Id<Material>> =
                object.materials.iter().filter_map(|&place| uses[place]).collect();
            if object.materials.is_empty() {
                materials
                    .push(*clay.get_or_insert_with(|| self.scene.add_material(crate::bare_mesh::clay())));
            }
            let (Some(shape), false) = (shape, materials.is_empty()) else { continue };
            if self.emits_badly(shape, &materials, &object) {
                continue;
            }
            let ObjectSource { name, placements, .. } = object;
            let copy =
                |placement| Instance { name: name.clone(), shape, materials: materials.clone(), placement };
            self.scene.instances.extend(placements.into_iter().map(copy));
        }
    }

    /// True, and a problem, if a lamp has a form that light cannot be drawn from.
    fn emits_badly(&mut self, shape: Id<Shape>, materials: &[Id<Material>], object: &ObjectSource) -> bool {
        let emits = materials.iter().any(|id| self.scene.materials[id.index()].emission.is_some());
        let message = match *self.scene.shapes[shape.index()] {
            _ if !emits => return false,
            Shape::Plane => "a plane without end cannot emit: its light would have no bounds",
            Shape::Sphere { .. } | Shape::Disc { .. }
                if !object.placements.iter().all(|place| keeps_angles(&place.matrix3)) =>
            {
                "an emitting sphere or disc cannot be stretched"
            }
            _ => return false,
        };
        let help = "take a mesh for it: `mesh { sphere }`, `mesh { plane }`";
        self.report.add(&object.span, message, Some(help.into()));
        true
    }

    fn environment(&mut self, environment: Option<Spanned<EnvironmentSource>>) {
        let Some(Spanned { value, span }) = environment else { return };
        self.scene.environment = Some(match value {
            EnvironmentSource::Constant(radiance) => Environment::Constant { radiance },
            EnvironmentSource::Neutral { scale, rotation } => {
                let image = self.scene.add_image(neutral_sky());
                Environment::LatLong { image, scale, rotation }
            }
            EnvironmentSource::Image { path, scale, rotation } => {
                let file = self.path(&path);
                match self.images.load(&file, &mut self.scene, &mut self.warnings) {
                    Some(image) => Environment::LatLong { image, scale, rotation },
                    None => {
                        self.warnings
                            .push(self.report.problem(&span, "an even gray takes the place of the picture"));
                        Environment::Constant { radiance: Rgb::gray(0.5) * scale }
                    }
                }
            }
        });
    }

    fn put_imports(&mut self, imports: &[scene_file::ImportSource]) {
        // What a file brings along is put into the scene once, however often its objects are.
        let mut brought: BTreeMap<PathBuf, merge::Places> = BTreeMap::new();
        for import in imports {
            let path = self.path(&import.path);
            let Some(other) = self.import(&path, &import.path.span) else { continue };
            if let Err(message) = merge::check_size(&self.scene, &other, brought.contains_key(&path)) {
                self.report.add(&import.path.span, format!("with this import {message}"), None);
                return;
            }
            if self.scene.environment.is_some() && other.environment.is_some() {
                let message = "the environment of this import is left out: the scene has one";
                self.warnings.push(self.report.problem(&import.path.span, message));
            }
            let places = brought.entry(path).or_insert_with(|| merge::bring(&mut self.scene, &other));
            merge::place(&mut self.scene, &other, places, &import.placement);
        }
    }

    /// The scene of another file.
    fn import(&mut self, path: &Path, span: &Span) -> Option<Rc<Scene>> {
        let open = &self.imports.open;
        let own_name = scene_file::normal(path);
        if let Some(first) = open.iter().position(|open| scene_file::normal(open) == own_name) {
            let cycle: Vec<String> = open[first..].iter().map(|path| path.display().to_string()).collect();
            let message = format!("this file imports itself: {} → {}", cycle.join(" → "), path.display());
            self.report.add(span, message, None);
            return None;
        }
        if open.len() > DEEPEST_IMPORT {
            self.report.add(span, format!("more than {DEEPEST_IMPORT} scenes inside one another"), None);
            return None;
        }
        if let Some(known) = self.imports.known.get(&own_name).cloned() {
            if known.is_none() {
                self.refer(span, "import", Vec::new());
            }
            return known;
        }
        let scene = match format::read(path, self.files, self.imports) {
            Ok(loaded) => {
                self.warnings.extend(loaded.warnings);
                self.notes.extend(loaded.notes);
                Some(Rc::new(loaded.scene))
            }
            Err(error) => {
                self.refer(span, "import", error.problems);
                None
            }
        };
        self.imports.known.insert(own_name, scene.clone());
        scene
    }

    /// Notes problems of another file, and where it is referred to.
    fn refer(&mut self, span: &Span, verb: &str, problems: Vec<Problem>) {
        self.report.add(span, format!("cannot {verb} this file"), None);
        for problem in problems {
            self.report.add_other(problem);
        }
    }
}

/// True if a map is a rotation and a scale by one factor, perhaps mirrored.
fn keeps_angles(m: &glam::Mat3A) -> bool {
    let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis];
    let length = x.length();
    let even = (y.length() - length).abs() <= 1e-4 * length && (z.length() - length).abs() <= 1e-4 * length;
    even && [x.dot(y), y.dot(z), z.dot(x)].iter().all(|cosine| cosine.abs() <= 1e-4 * length * length)
}
