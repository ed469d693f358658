//! glTF 2.0 (.gltf and .glb): a static scene in its rest pose.
//!
//! The document is read as plain JSON through [`json::Json`], a value that knows its place, rather than through a library of
//! ready-made types: every index, length and offset of a hostile file is checked here, and every complaint names its JSON
//! pointer. Buffers, views and accessors are checked as a whole; meshes, materials and pictures are read only if the shown
//! scene uses them. What is not honoured is named once for each kind ([`notices::Notices`]).

mod accessor;
mod asset;
mod budget;
mod buffer;
mod camera;
mod container;
mod document;
mod extensions;
mod hierarchy;
mod instance;
mod json;
mod light;
mod material;
mod mesh;
mod notices;
mod primitive;
mod reader;
mod texture;
mod uri;
mod vertices;

use crate::images::{Images, Pictures};
use crate::{Files, LoadError, Loaded, Problem};
use budget::Budget;
use buffer::Buffers;
use container::Container;
use document::Document;
use hierarchy::Hierarchy;
use json::Json;
use luch_image::Bitmap;
use luch_scene::{Id, Scene, Texture};
use material::Variants;
use mesh::Part;
use notices::Notices;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::rc::Rc;
use texture::{ImageSource, TextureKey};

/// Reads the scene that the file shows; it may lack a camera and light.
///
/// # Errors
/// If the file or one of its buffers cannot be read, or the file contradicts itself or requires what is not known.
pub(crate) fn load(path: &Path, files: &Files, pictures: Pictures) -> Result<Loaded, LoadError> {
    Ok(read(path, files, pictures)?)
}

fn read(file: &Path, files: &Files, pictures: Pictures) -> Result<Loaded, Problem> {
    let bytes = files.read(file)?;
    let size = bytes.len() as u64;
    let mut notices = Notices::new(file);
    let Container { json: value, binary } = Container::parse(file, bytes, &mut notices)?;
    let root = Json::root(&value, file);
    asset::check(&root, &mut notices)?;
    extensions::check_required(&root)?;
    extensions::name_ignored(&root, &value, &mut notices)?;
    let buffers = Buffers::load(&root, binary, file, files)?;
    let mut budget = Budget::new(size.saturating_add(buffers.total));
    let document = Document::new(root, buffers, &mut budget, file, files)?;
    let hierarchy = Hierarchy::build(&document, &mut notices)?;
    let mut import = Import::new(document, hierarchy, budget, notices, Images::new(files, pictures))?;
    import.place_nodes()?;
    let Import { scene, notices, has_unlit, .. } = import;
    let note = "unlit materials emit their own colour, and so light what is near them";
    let notes = if has_unlit { vec![note.to_owned()] } else { Vec::new() };
    Ok(Loaded { scene, warnings: notices.into_warnings(), notes, ..Loaded::default() })
}

/// A document on its way to a scene.
#[derive(Debug)]
struct Import<'a> {
    document: Document<'a>,
    hierarchy: Hierarchy,
    budget: Budget,
    notices: Notices,
    scene: Scene,
    /// Whether any mesh has vertex colours, which then multiply base colours.
    has_vertex_colors: bool,
    /// By place in the document; `None` if not yet made.
    meshes: Vec<Option<Rc<Vec<Part>>>>,
    /// By place in the document; the default material under `None`.
    materials: BTreeMap<Option<usize>, Variants>,
    textures: BTreeMap<TextureKey, Option<Id<Texture>>>,
    images: BTreeMap<ImageSource, Option<Id<Bitmap>>>,
    pictures: Images<'a>,
    camera_names: BTreeSet<String>,
    /// Whether a material is one of KHR_materials_unlit.
    has_unlit: bool,
}

impl<'a> Import<'a> {
    fn new(
        document: Document<'a>,
        hierarchy: Hierarchy,
        budget: Budget,
        notices: Notices,
        pictures: Images<'a>,
    ) -> Result<Self, Problem> {
        Ok(Self {
            has_vertex_colors: has_vertex_colors(&document)?,
            meshes: vec![None; document.meshes.len()],
            document,
            hierarchy,
            budget,
            notices,
            scene: Scene::default(),
            materials: BTreeMap::new(),
            textures: BTreeMap::new(),
            images: BTreeMap::new(),
            pictures,
            camera_names: BTreeSet::new(),
            has_unlit: false,
        })
    }

    /// Everything that the nodes of the shown scene carry.
    fn place_nodes(&mut self) -> Result<(), Problem> {
        let shown = self.hierarchy.shown(&self.document, &mut self.notices)?;
        if self.document.nodes.is_empty() && !self.document.meshes.is_empty() {
            self.notices.add(self.document.meshes.path(), "the file has meshes, but no node that shows one");
        }
        for index in shown {
            let node = self.document.nodes.at(index);
            let world = self.hierarchy.world[index];
            if let Some(mesh) = node.get("mesh")? {
                self.place_mesh(&node, &mesh, world)?;
            }
            if let Some(camera) = node.get("camera")? {
                self.place_camera(&node, &camera, world)?;
            }
            if let Some(light) = node.extension("KHR_lights_punctual")? {
                self.place_light(&node, &light, world)?;
            }
        }
        Ok(())
    }
}

fn has_vertex_colors(document: &Document) -> Result<bool, Problem> {
    for mesh in document.meshes.iter() {
        for primitive in mesh.list("primitives")?.iter() {
            if primitive.need("attributes")?.get("COLOR_0")?.is_some() {
                return Ok(true);
            }
        }
    }
    Ok(false)
}
