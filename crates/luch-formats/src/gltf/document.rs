//! The parts of a document that everything else refers to.

use super::accessor::{self, Accessor, Form};
use super::budget::Budget;
use super::buffer::Buffers;
use super::json::{Json, List};
use super::reader::Reader;
use crate::{Files, Problem};
use std::path::Path;

/// A document whose lists are arrays, whose buffers are read and whose accessors lie inside them.
#[derive(Debug)]
pub(super) struct Document<'a> {
    pub(super) file: &'a Path,
    pub(super) files: &'a Files,
    pub(super) root: Json<'a>,
    pub(super) buffers: Buffers,
    pub(super) accessors: Vec<Accessor>,
    pub(super) accessor_list: List<'a>,
    pub(super) nodes: List<'a>,
    pub(super) meshes: List<'a>,
    pub(super) materials: List<'a>,
    pub(super) textures: List<'a>,
    pub(super) images: List<'a>,
    pub(super) samplers: List<'a>,
    pub(super) cameras: List<'a>,
    pub(super) lights: List<'a>,
    pub(super) skins: List<'a>,
}

impl<'a> Document<'a> {
    /// Checks the lists; `buffers` are those of the document.
    pub(super) fn new(
        root: Json<'a>,
        buffers: Buffers,
        budget: &mut Budget,
        file: &'a Path,
        files: &'a Files,
    ) -> Result<Self, Problem> {
        let accessors = Accessor::parse_all(&root, &buffers, budget)?;
        let punctual = root.extension("KHR_lights_punctual")?;
        let document = Self {
            file,
            files,
            accessors,
            buffers,
            accessor_list: root.list("accessors")?,
            nodes: root.list("nodes")?,
            meshes: root.list("meshes")?,
            materials: root.list("materials")?,
            textures: root.list("textures")?,
            images: root.list("images")?,
            samplers: root.list("samplers")?,
            cameras: root.list("cameras")?,
            lights: punctual.as_ref().unwrap_or(&root).list("lights")?,
            skins: root.list("skins")?,
            root,
        };
        for list in
            [&document.nodes, &document.meshes, &document.materials, &document.textures, &document.images]
        {
            for entry in list.iter() {
                entry.name()?;
            }
        }
        Ok(document)
    }

    /// The accessor that `json` refers to, which must have one of `forms`, and its place.
    pub(super) fn accessor(&self, json: &Json, forms: &[Form]) -> Result<(Accessor, Json<'a>), Problem> {
        accessor::referenced(json, &self.accessor_list, &self.accessors, forms)
    }

    /// As [`Document::accessor`], opened for reading.
    pub(super) fn reader(&self, json: &Json, forms: &[Form]) -> Result<Reader<'_>, Problem> {
        let (accessor, place) = self.accessor(json, forms)?;
        accessor.reader(&self.buffers, &place)
    }
}
