//! Who sees a mesh: for steps that make as many triangles as its size on the screen asks for.

use crate::scene_file::{MeshOperation, SceneFile, ShapeSource, Spanned};
use glam::{Affine3A, DAffine3};
use luch_mesh::screen::ScreenView;
use luch_scene::{Camera, Projection};

/// Nearer than this the size of things on the screen is not judged, metres.
const NEAREST: f64 = 0.01;

/// The views of the meshes of a scene file: by its cameras, at the size of its picture.
pub(super) struct Views {
    cameras: Vec<ScreenView>,
    /// For each mesh of the file where it stands in the world.
    placements: Vec<Vec<Affine3A>>,
}

impl Views {
    pub(super) fn new(file: &SceneFile) -> Self {
        let rows = file.settings.as_ref().map(|settings| settings.value).unwrap_or_default().height;
        let cameras = file.cameras.iter().map(|camera| view(&camera.value.camera, rows)).collect();
        let mut placements = vec![Vec::new(); file.meshes.len()];
        for object in &file.objects {
            let place = match &object.shape {
                ShapeSource::InlineMesh(place) => Some(*place),
                ShapeSource::Mesh(name) => {
                    let is_named = |known: &Spanned<String>| known.value == name.value;
                    file.meshes.iter().position(|mesh| mesh.name.as_ref().is_some_and(is_named))
                }
                _ => None,
            };
            if let Some(place) = place {
                placements[place].extend(&object.placements);
            }
        }
        Self { cameras, placements }
    }

    /// The cameras in the coordinates of a mesh before `later` operations.
    pub(super) fn of(&self, mesh: usize, later: &[MeshOperation]) -> Result<Vec<ScreenView>, String> {
        if self.cameras.is_empty() {
            return Err("the scene has no camera that could count its pixels; give it one".into());
        }
        let moved = later.iter().fold(Affine3A::IDENTITY, |map, operation| match operation {
            MeshOperation::Transform(next) => *next * map,
            _ => map,
        });
        let placements = self.placements[mesh].iter().map(|place| double(&(*place * moved)));
        Ok(placements
            .flat_map(|place| self.cameras.iter().filter_map(move |camera| camera.of_placed(&place)))
            .collect())
    }
}

fn view(camera: &Camera, rows: u32) -> ScreenView {
    match camera.projection {
        Projection::Perspective { field_of_view_y } => {
            ScreenView::perspective(camera.position.as_dvec3(), f64::from(field_of_view_y), rows, NEAREST)
        }
        Projection::Orthographic { height } => ScreenView::orthographic(f64::from(height), rows),
    }
}

fn double(map: &Affine3A) -> DAffine3 {
    DAffine3 { matrix3: map.matrix3.as_dmat3(), translation: map.translation.as_dvec3() }
}
