//! Meshes: files are read, generators run, operations are done.

use super::{Names, Resolver};
use crate::scene_file::{MeshOperation, MeshOrigin, MeshSource, SceneFile};
use luch_mesh::normals::{self, Weight};
use luch_mesh::weld::{weld_exact, weld_within};
use luch_mesh::{Attribute, TriangleMesh};
use luch_scene::{Id, Shape};
use std::path::PathBuf;

/// The meshes of a scene file in the scene.
pub(super) struct Meshes {
    pub(super) names: Names,
    /// For each mesh of the file its shape; `None` if it is wrong.
    pub(super) shapes: Vec<Option<Id<Shape>>>,
}

/// Most triangles of all meshes after reading.
const MOST_TRIANGLES: usize = 1 << 26;

impl Resolver<'_> {
    pub(super) fn meshes(&mut self, file: &SceneFile) -> Meshes {
        let names = self.names("mesh", file.meshes.iter().map(|mesh| mesh.name.as_ref()));
        let mut shapes = Vec::with_capacity(file.meshes.len());
        let mut triangles = 0;
        // The last file read, if the next mesh is made from it too.
        let mut last: Option<(PathBuf, TriangleMesh)> = None;
        for (place, source) in file.meshes.iter().enumerate() {
            let next = file.meshes.get(place + 1).map(|next| &next.value);
            let mesh = self.mesh(&source.value, next, &mut last);
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
        source: &MeshSource,
        next: Option<&MeshSource>,
        last: &mut Option<(PathBuf, TriangleMesh)>,
    ) -> Option<TriangleMesh> {
        let mut mesh = match &source.origin {
            MeshOrigin::Generator(generator) => generator.mesh(),
            MeshOrigin::File(name) => {
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
                mesh
            }
        };
        for operation in &source.operations {
            apply(operation, &mut mesh);
        }
        if let Some(problem) = mesh.validate().first() {
            self.report.add(&source.span, format!("this mesh cannot be used: {problem}"), None);
            return None;
        }
        Some(mesh)
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
    }
}
