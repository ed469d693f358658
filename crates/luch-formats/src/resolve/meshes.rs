//! Meshes: files are read, forms are made, operations are done.

use super::views::Views;
use super::{Names, Resolver};
use crate::scene_file::{MeshOperation, MeshOrigin, MeshSource, SceneFile, Spanned, WorkshopStep};
use crate::{Files, mesh_file};
use luch_mesh::normals::{self, Weight};
use luch_mesh::screen::ScreenView;
use luch_mesh::weld::{weld_exact, weld_within};
use luch_mesh::{Attribute, PolygonMesh, TriangleMesh, workshop};
use luch_scene::{Id, Shape, Traced};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The meshes of a scene file in the scene.
pub(super) struct Meshes {
    pub(super) names: Names,
    /// For each mesh of the file its shape; `None` if it is wrong.
    pub(super) shapes: Vec<Option<Id<Shape>>>,
}

/// Most triangles of all meshes after reading.
const MOST_TRIANGLES: usize = 1 << 26;

/// A mesh on its way: verbs change polygons, everything else triangles.
enum Model {
    Triangles(TriangleMesh),
    Polygons(PolygonMesh),
}

impl Model {
    fn into_polygons(self) -> PolygonMesh {
        match self {
            Self::Triangles(mesh) => PolygonMesh::from(&mesh),
            Self::Polygons(mesh) => mesh,
        }
    }

    fn into_triangles(self) -> TriangleMesh {
        match self {
            Self::Triangles(mesh) => mesh,
            Self::Polygons(mesh) => mesh.triangulate(),
        }
    }
}

impl Resolver<'_> {
    pub(super) fn meshes(&mut self, file: &SceneFile) -> Meshes {
        let names = self.names("mesh", file.meshes.iter().map(|mesh| mesh.name.as_ref()));
        let mut shapes = Vec::with_capacity(file.meshes.len());
        let views = Views::new(file);
        let mut triangles = 0;
        // The last file read, if the next mesh is made from it too.
        let mut last: Option<(PathBuf, TriangleMesh)> = None;
        for (place, source) in file.meshes.iter().enumerate() {
            let next = file.meshes.get(place + 1).map(|next| &next.value);
            let mesh = self.mesh(Seen { views: &views, place }, &source.value, next, &mut last);
            triangles += mesh.as_ref().map_or(0, |mesh| mesh.triangles.len());
            if triangles > MOST_TRIANGLES {
                let message =
                    format!("the meshes of the scene have more than {MOST_TRIANGLES} triangles together");
                self.report.add(&source.value.span, message, None);
                break;
            }
            shapes.push(mesh.map(|mesh| self.scene.add_shape(Shape::Mesh(mesh))));
        }
        shapes.resize(file.meshes.len(), None);
        Meshes { names, shapes }
    }

    fn mesh(
        &mut self,
        seen: Seen,
        source: &MeshSource,
        next: Option<&MeshSource>,
        last: &mut Option<(PathBuf, TriangleMesh)>,
    ) -> Option<TriangleMesh> {
        let mut model = match &source.origin {
            MeshOrigin::Form(form) => {
                Model::Polygons(self.step(form, None, seen.before(&source.operations))?)
            }
            // Faces of the file itself: a cage is of quads, not of their halves.
            MeshOrigin::File(name) if source.is_worked_on() => Model::Polygons(self.polygons(name)?),
            MeshOrigin::File(name) => Model::Triangles(self.triangles(name, next, last)?),
        };
        for (k, operation) in source.operations.iter().enumerate() {
            model = match operation {
                MeshOperation::Workshop(step) => {
                    let views = seen.before(&source.operations[k + 1..]);
                    Model::Polygons(self.step(step, Some(model.into_polygons()), views)?)
                }
                other => {
                    let mut mesh = model.into_triangles();
                    apply(other, &mut mesh);
                    Model::Triangles(mesh)
                }
            };
        }
        let mesh = model.into_triangles();
        if let Some(problem) = mesh.validate().first() {
            self.report.add(&source.span, format!("this mesh cannot be used: {problem}"), None);
            return None;
        }
        Some(mesh)
    }

    /// The triangles of a file; kept if the next mesh is made of the same file.
    fn triangles(
        &mut self,
        name: &Spanned<String>,
        next: Option<&MeshSource>,
        last: &mut Option<(PathBuf, TriangleMesh)>,
    ) -> Option<TriangleMesh> {
        let path = self.path(name);
        let mesh = match last.take() {
            Some((known, mesh)) if known == path => mesh,
            _ => match crate::bare_mesh::read(&path, self.files, &mut self.warnings) {
                Ok(mesh) => mesh,
                Err(error) => {
                    self.refer(&name.span, "read", error.problems);
                    return None;
                }
            },
        };
        if let Some(MeshOrigin::File(next)) = next.map(|next| &next.origin)
            && self.path(next) == path
        {
            *last = Some((path, mesh.clone()));
        }
        Some(mesh)
    }

    /// The polygons of a file.
    fn polygons(&mut self, name: &Spanned<String>) -> Option<PolygonMesh> {
        match mesh_file::read_mesh(&self.path(name), self.files) {
            Ok(read) => {
                self.warnings.extend(read.warnings);
                Some(read.mesh)
            }
            Err(error) => {
                self.refer(&name.span, "read", error.problems);
                None
            }
        }
    }

    /// A height field that is traced as it is.
    pub(super) fn height_field(&mut self, step: &WorkshopStep) -> Option<Id<Shape>> {
        let WorkshopStep { span, step } = step;
        let base = self.report.sources[span.source].path.clone();
        let views = Err("heights are traced as they are".into());
        match step.height_field(&mut Beside { files: self.files, base: &base, views }) {
            Ok(field) => Some(self.scene.add_shape(Shape::Traced(Traced::HeightField(Arc::new(field))))),
            Err(error) => {
                self.report.add(span, error.to_string(), None);
                None
            }
        }
    }

    fn step(
        &mut self,
        step: &WorkshopStep,
        mesh: Option<PolygonMesh>,
        views: Result<Vec<ScreenView>, String>,
    ) -> Option<PolygonMesh> {
        let WorkshopStep { span, step } = step;
        let base = self.report.sources[span.source].path.clone();
        match step.run(mesh, &mut Beside { files: self.files, base: &base, views }) {
            Ok(mesh) => Some(mesh),
            Err(error) => {
                self.report.add(span, error.to_string(), None);
                None
            }
        }
    }
}

impl MeshSource {
    /// Whether a verb changes it before anything else makes triangles of it.
    fn is_worked_on(&self) -> bool {
        matches!(self.operations.first(), Some(MeshOperation::Workshop(_)))
    }
}

/// Files that steps name, relative to the scene file.
struct Beside<'a> {
    files: &'a Files,
    base: &'a Path,
    views: Result<Vec<ScreenView>, String>,
}

/// A mesh of the file and who sees it.
#[derive(Clone, Copy)]
struct Seen<'a> {
    views: &'a Views,
    place: usize,
}

impl Seen<'_> {
    /// The views before some operations.
    fn before(self, later: &[MeshOperation]) -> Result<Vec<ScreenView>, String> {
        self.views.of(self.place, later)
    }
}

impl workshop::Files for Beside<'_> {
    fn bytes(&mut self, name: &str) -> Result<Vec<u8>, String> {
        self.files.read(&Files::beside(self.base, name)).map_err(|problem| problem.to_string())
    }

    fn mesh(&mut self, name: &str) -> Result<PolygonMesh, String> {
        let read = mesh_file::read_mesh(&Files::beside(self.base, name), self.files);
        read.map(|read| read.mesh).map_err(|error| error.to_string())
    }

    fn views(&mut self) -> Result<Vec<ScreenView>, String> {
        self.views.clone()
    }
}

fn apply(operation: &MeshOperation, mesh: &mut TriangleMesh) {
    match operation {
        MeshOperation::FlatNormals => mesh.normals = Attribute::default(),
        MeshOperation::SmoothNormals => mesh.normals = normals::smooth(mesh, Weight::Angle),
        MeshOperation::CreasedNormals(angle) => mesh.normals = normals::creased(mesh, *angle, Weight::Angle),
        MeshOperation::Weld(distance) if *distance > 0.0 => *mesh = weld_within(mesh, *distance).mesh,
        MeshOperation::Weld(_) => *mesh = weld_exact(mesh).mesh,
        MeshOperation::Flip => mesh.flip(),
        MeshOperation::Transform(map) => mesh.transform(map),
        MeshOperation::Workshop(_) => {}
    }
}
