//! Forms without triangles: what the renderer asks of each.

mod frustum;
mod height_field;
mod implicit;

use crate::place::Place;
use glam::{Vec2, Vec3};
use luch_bvh::{Aabb, Geometry};
use luch_scene::Traced;
use std::sync::Arc;

/// The ray test.
pub(crate) fn geometry(form: &Traced) -> Geometry {
    match form {
        Traced::Frustum(frustum) => Geometry::Frustum(frustum::test(frustum)),
        Traced::HeightField(field) => {
            Geometry::Traced(Arc::new(height_field::Tracer::new(Arc::clone(field))))
        }
        Traced::Implicit(surface) => Geometry::Traced(Arc::new(implicit::Tracer::new(surface))),
    }
}

/// A box around it.
pub(crate) fn bounds(form: &Traced) -> Aabb {
    Aabb::of_points(form.corners())
}

/// The point of the surface at a place whose `local` is near it.
pub(crate) fn point(form: &Traced, place: &Place) -> Vec3 {
    match form {
        Traced::Frustum(frustum) => frustum::point(frustum, place.local, place.weights[1]),
        Traced::HeightField(field) => height_field::Facet::of(field, place.primitive).point(place.weights),
        Traced::Implicit(surface) => implicit::point(surface, place.local),
    }
}

/// The normal toward the outside, of any length.
pub(crate) fn normal(form: &Traced, place: &Place) -> Vec3 {
    match form {
        Traced::Frustum(frustum) => frustum::normal(frustum, place.local, place.weights[1]),
        Traced::HeightField(field) => height_field::Facet::of(field, place.primitive).area_normal(),
        Traced::Implicit(surface) => implicit::normal(surface, place.local),
    }
}

/// The corners of the flat piece at a place and the normals there, for a form that is made of such pieces.
pub(crate) fn facet(form: &Traced, place: &Place) -> Option<([Vec3; 3], [Vec3; 3])> {
    match form {
        Traced::Frustum(_) | Traced::Implicit(_) => None,
        Traced::HeightField(field) => {
            let facet = height_field::Facet::of(field, place.primitive);
            Some((facet.corners, facet.normals(field)))
        }
    }
}

/// Texture coordinates.
pub(crate) fn uv(form: &Traced, place: &Place) -> Vec2 {
    match form {
        Traced::Frustum(frustum) => frustum::uv(frustum, place.local, place.weights[1]),
        Traced::HeightField(field) => height_field::uv(field, place.local),
        Traced::Implicit(surface) => implicit::uv(surface, place.local),
    }
}

/// How texture coordinates change with a small step along the surface.
pub(crate) fn uv_step(form: &Traced, place: &Place, step: Vec3) -> Vec2 {
    match form {
        Traced::Frustum(frustum) => frustum::uv_step(frustum, place.local, place.weights[1], step),
        Traced::HeightField(field) => Vec2::new(step.x, -step.z) / field.size,
        Traced::Implicit(surface) => implicit::uv_step(surface, step),
    }
}

/// A direction along the surface in which u grows.
pub(crate) fn tangent(form: &Traced, place: &Place) -> Vec3 {
    match form {
        Traced::Frustum(_) => frustum::tangent(place.local, place.weights[1]),
        Traced::HeightField(_) | Traced::Implicit(_) => Vec3::X,
    }
}
