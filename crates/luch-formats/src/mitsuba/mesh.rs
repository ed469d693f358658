//! Meshes as Mitsuba has them: where their normals come from, and which way they face.

use super::{Import, primitive, serialized};
use crate::scene_file::Span;
use crate::{Problem, bare_mesh};
use glam::Vec2;
use luch_mesh::codec::Format;
use luch_mesh::normals::{self, Weight};
use luch_mesh::{Attribute, TriangleMesh, unify};
use luch_scene::{Id, Shape};
use std::path::PathBuf;

/// Most triangles of all meshes together.
const MOST_TRIANGLES: usize = 1 << 27;

/// Where the normals of a mesh come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Smoothing {
    /// From the file, or else the mean of the faces about a vertex.
    Given,
    /// Each face has its own.
    Flat,
    /// Smooth over edges bent by less than an angle: the bits of a number in radians.
    Creased(u32),
}

/// A form before it is placed.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Form {
    Rectangle,
    Cube,
    Sphere,
    Disk,
    Tube,
    File {
        path: PathBuf,
        /// Which mesh of a serialized file.
        part: u32,
        is_serialized: bool,
        smoothing: Smoothing,
        /// Whether v of the file runs upward.
        flips_uv: bool,
    },
}

/// What makes a mesh.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct MeshKey {
    form: Form,
    /// Turned inside out.
    flipped: bool,
}

impl MeshKey {
    pub(super) fn of(form: Form, flipped: bool) -> Self {
        Self { form, flipped }
    }
}

impl Import<'_> {
    /// The mesh of a key; `None`, with a problem at `span`, if there is none.
    pub(super) fn mesh(&mut self, key: MeshKey, span: Option<&Span>) -> Option<Id<Shape>> {
        if let Some(known) = self.meshes.get(&key) {
            return *known;
        }
        let shape = self.made(&key, span).map(|mesh| self.scene.add_shape(Shape::Mesh(mesh)));
        self.meshes.insert(key, shape);
        shape
    }

    fn made(&mut self, key: &MeshKey, span: Option<&Span>) -> Option<TriangleMesh> {
        let mut mesh = match &key.form {
            Form::Rectangle => primitive::rectangle(),
            Form::Cube => primitive::cube(),
            Form::Sphere => primitive::sphere(),
            Form::Disk => primitive::disk(),
            Form::Tube => primitive::tube(),
            Form::File { .. } => self.loaded_mesh(&key.form, span)?,
        };
        if key.flipped {
            mesh.flip();
        }
        Some(mesh)
    }

    /// Whether a file says itself how its mesh is smooth.
    pub(super) fn file_has_normals(&mut self, form: &Form, span: &Span) -> Option<bool> {
        let id = self.mesh(MeshKey::of(form.clone(), false), Some(span))?;
        Some(!self.computed.contains(&id.index()))
    }

    fn loaded_mesh(&mut self, form: &Form, span: Option<&Span>) -> Option<TriangleMesh> {
        let Form::File { path, part, is_serialized, smoothing, flips_uv } = form else { return None };
        let read = self.read_mesh(path, *part, *is_serialized);
        let mut mesh = match read {
            Ok(mesh) => mesh,
            Err(error) => {
                if let Some(span) = span {
                    self.report.add(span, "cannot read this mesh", None);
                }
                for problem in error.problems {
                    self.report.add_other(problem);
                }
                return None;
            }
        };
        self.triangles += mesh.triangles.len();
        if self.triangles > MOST_TRIANGLES {
            if let Some(span) = span {
                self.report.add(
                    span,
                    format!("with this mesh there are over {MOST_TRIANGLES} triangles"),
                    None,
                );
            }
            return None;
        }
        mesh.slots.clear();
        // Mitsuba knows one set.
        mesh.uv_sets.truncate(1);
        if !flips_uv {
            for uv in mesh.uv_sets.iter_mut().flat_map(|set| &mut set.values) {
                *uv = Vec2::new(uv.x, 1.0 - uv.y);
            }
        }
        match smoothing {
            Smoothing::Flat => mesh.normals = Attribute::default(),
            Smoothing::Creased(angle) => {
                mesh.normals = normals::creased(&mesh, f32::from_bits(*angle), Weight::Angle);
            }
            Smoothing::Given if mesh.normals.is_empty() => {
                // There a vertex is a position with its uv: normals are not smooth over seams.
                mesh = unify::split_positions(&mesh);
                mesh.normals = normals::smooth(&mesh, Weight::Angle);
                self.computed.insert(self.scene.shapes.len());
            }
            Smoothing::Given => face_by_normals(&mut mesh),
        }
        Some(mesh)
    }

    fn read_mesh(
        &mut self,
        path: &std::path::Path,
        part: u32,
        is_serialized: bool,
    ) -> Result<TriangleMesh, crate::LoadError> {
        let bytes = self.files.read(path)?;
        if is_serialized {
            let mesh = serialized::decode(&bytes, part).map_err(|problem| {
                let told = Problem::new(path, problem.message);
                problem.offset.map_or(told.clone(), |offset| told.at(crate::Place::Byte(offset)))
            })?;
            return bare_mesh::checked(path, mesh);
        }
        let by_name = path.extension().and_then(|e| e.to_str()).and_then(Format::from_extension);
        let format = by_name.or_else(|| Format::from_magic(&bytes)).unwrap_or(Format::Obj);
        bare_mesh::decode(path, &bytes, format, &mut self.warnings)
    }
}

/// Turns triangles whose corner normals look the other way: in Mitsuba a surface faces where its shading normal points.
fn face_by_normals(mesh: &mut TriangleMesh) {
    for t in 0..mesh.triangles.len() {
        let Some([a, b, c]) = mesh.corner_normals(t) else { return };
        if mesh.area_normal(t).dot(a + b + c) >= 0.0 {
            continue;
        }
        mesh.triangles[t].swap(1, 2);
        let lists = [&mut mesh.normals.triangles, &mut mesh.tangents.triangles, &mut mesh.colors.triangles];
        let uvs = mesh.uv_sets.iter_mut().map(|set| &mut set.triangles);
        for corners in lists.into_iter().chain(uvs).filter_map(|list| list.get_mut(t)) {
            corners.swap(1, 2);
        }
    }
}
