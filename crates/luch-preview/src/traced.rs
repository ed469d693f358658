//! Forms that the renderer traces as they are: here they become triangles, fine enough for a look.

use luch_formula::Formula;
use luch_mesh::implicit::{self, Method, Region, Sampling, Solid};
use luch_mesh::{TriangleMesh, generate, height_map};
use luch_scene::{Frustum, Implicit, Traced};

/// Pieces around the axis of round forms.
const SEGMENTS: u32 = 256;

/// Triangles that stand for a form.
pub(crate) fn triangles(form: &Traced) -> TriangleMesh {
    match form {
        Traced::Frustum(Frustum { bottom_radius, top_radius, height, capped }) => {
            generate::cone(*bottom_radius, *top_radius, *height, SEGMENTS, 1, *capped)
        }
        Traced::HeightField(field) => height_map::sheet(field),
        Traced::Implicit(surface) => implicit_triangles(surface),
    }
}

/// Samples along the longest side of the box of a formula.
const RESOLUTION: u32 = 96;

/// A formula with mistakes has no triangles.
fn implicit_triangles(surface: &Implicit) -> TriangleMesh {
    let [low, high] = surface.corners();
    let region = Region { min: low.as_dvec3(), max: high.as_dvec3() };
    let sampling = Sampling { region, resolution: RESOLUTION, closed: surface.is_closed() };
    let formula: Formula = surface.formula().clone();
    let field = Solid::Formula(formula).field();
    field
        .ok()
        .and_then(|field| implicit::surface(&field, &sampling, Method::MarchingCubes).ok())
        .unwrap_or_default()
}
