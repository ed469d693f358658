//! Forms that the renderer traces as they are: here they become triangles, fine enough for a look.

use luch_mesh::{TriangleMesh, generate, height_map};
use luch_scene::{Frustum, Traced};

/// Pieces around the axis of round forms.
const SEGMENTS: u32 = 256;

/// Triangles that stand for a form.
pub(crate) fn triangles(form: &Traced) -> TriangleMesh {
    match form {
        Traced::Frustum(Frustum { bottom_radius, top_radius, height, capped }) => {
            generate::cone(*bottom_radius, *top_radius, *height, SEGMENTS, 1, *capped)
        }
        Traced::HeightField(field) => height_map::sheet(field),
        Traced::Implicit(_) => TriangleMesh::default(),
    }
}
