//! A place on a surface that a sample shows, and what is known there.

use crate::exact::Meeting;
use crate::subject::{FormKind, Mesh, Part};
use crate::view::Sight;
use crate::visibility::{Seen, Visibility};
use glam::{DVec2, DVec3, Vec2, Vec3, Vec4};
use luch_mesh::Attribute;
use luch_scene::{Material, Normals};

/// Where a line of sight meets what it shows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot<'v> {
    pub(crate) seen: &'v Visibility<'v>,
    pub(crate) part: usize,
    pub(crate) triangle: u32,
    /// Weights of the corners in space, none of them negative; of meshes only.
    pub(crate) weights: [f32; 3],
    /// In the shape's coordinates.
    pub(crate) local: DVec3,
    pub(crate) is_front: bool,
}

impl<'v> Spot<'v> {
    /// What a sample shows at its middle.
    pub(crate) fn of_sample(seen: &'v Visibility<'v>, x: u32, y: u32) -> Option<Self> {
        let found = seen.seen(x, y)?;
        let place = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
        match &seen.subject.forms[seen.subject.parts[found.part].form].kind {
            FormKind::Mesh(_) => Self::of_triangle(seen, found, place),
            FormKind::Exact(exact) => {
                // The meeting that was kept is the one of the stored depth, whatever was passed over before it.
                let sight = seen.local_sight(found.part, place);
                let stored = seen.view.depth(seen.linear(x, y));
                let error = |meeting: &Meeting| (meeting.depth - stored).abs();
                let nearest = exact.meetings(&sight).min_by(|a, b| error(a).total_cmp(&error(b)))?;
                Some(Self::on_exact(seen, found.part, &sight, &nearest))
            }
        }
    }

    /// On an exact shape.
    pub(crate) fn on_exact(seen: &'v Visibility<'v>, part: usize, sight: &Sight, meeting: &Meeting) -> Self {
        let Meeting { depth, is_front } = *meeting;
        Self { seen, part, triangle: 0, weights: [0.0; 3], local: sight.at(depth), is_front }
    }

    /// On the triangle at a place of the picture; a place beside it, by rounding, is taken to its border.
    pub(crate) fn of_triangle(seen: &'v Visibility<'v>, found: Seen, place: DVec2) -> Option<Self> {
        let mesh = mesh_of(seen, found.part)?;
        let sight = seen.local_sight(found.part, place);
        let corners = mesh.corners(found.triangle)?.map(|corner| corner.as_dvec3());
        let [a, b, c] = corners.map(|corner| corner - sight.origin);
        // Volumes over the edges: the weights of the corners in space (the lecture's barycentric coordinates).
        let volumes = [b.cross(c), c.cross(a), a.cross(b)].map(|normal| normal.dot(sight.direction));
        let [u, v, w] = volumes;
        let sum = u + v + w;
        let inside = volumes.map(|volume| (volume / sum).max(0.0));
        let total: f64 = inside.iter().sum();
        let weights = match total > 0.0 && total.is_finite() {
            true => inside.map(|weight| weight / total),
            false => [1.0 / 3.0; 3],
        };
        let from_origin = a * weights[0] + b * weights[1] + c * weights[2];
        Some(Self {
            seen,
            part: found.part,
            triangle: found.triangle,
            weights: weights.map(|weight| weight as f32),
            local: sight.origin + from_origin,
            is_front: sum < 0.0,
        })
    }

    pub(crate) fn part(&self) -> &'v Part<'v> {
        &self.seen.subject.parts[self.part]
    }

    fn kind(&self) -> &'v FormKind<'v> {
        &self.seen.subject.forms[self.part().form].kind
    }

    fn mesh(&self) -> Option<&'v Mesh<'v>> {
        mesh_of(self.seen, self.part)
    }

    /// The number of the face: of the polygon, the triangle or 0.
    pub(crate) fn face(&self) -> u32 {
        self.mesh().map_or(0, |mesh| mesh.face(self.triangle))
    }

    /// The material slot.
    pub(crate) fn slot(&self) -> u16 {
        self.mesh().map_or(0, |mesh| mesh.triangles.slot(self.triangle as usize))
    }

    /// The material, if the scene has one for it.
    pub(crate) fn material(&self) -> Option<&'v Material> {
        self.seen.subject.material(self.part(), self.slot())
    }

    /// The outward unit normal in the world; zero where there is none.
    pub(crate) fn normal(&self, normals: Normals) -> Vec3 {
        let local = match self.kind() {
            FormKind::Exact(exact) => exact.normal(self.local),
            FormKind::Mesh(mesh) => {
                let smooth = match normals {
                    Normals::Flat => None,
                    Normals::Interpolated => self.blend(mesh, &mesh.triangles.normals),
                };
                smooth.map(|normal: Vec3| normal.as_dvec3()).filter(is_direction).unwrap_or_else(|| {
                    let corners = mesh.corners(self.triangle).unwrap_or_default();
                    let [a, b, c] = corners.map(|corner| corner.as_dvec3());
                    (b - a).cross(c - a)
                })
            }
        };
        (self.seen.placed[self.part].normal_map * local).normalize_or_zero().as_vec3()
    }

    /// Texture coordinates of a set; `None` where there are none.
    pub(crate) fn uv(&self, set: usize) -> Option<Vec2> {
        match self.kind() {
            FormKind::Exact(exact) => Some(exact.uv(self.local)),
            FormKind::Mesh(mesh) => self.blend(mesh, mesh.triangles.uv_sets.get(set)?),
        }
    }

    /// Vertex colour; `None` where there is none.
    pub(crate) fn vertex_color(&self) -> Option<Vec4> {
        let mesh = self.mesh()?;
        self.blend(mesh, &mesh.triangles.colors)
    }

    /// The value of an attribute here, if all three corners have one.
    fn blend<T>(&self, mesh: &Mesh, attribute: &Attribute<T>) -> Option<T>
    where
        T: Copy + std::ops::Mul<f32, Output = T> + std::ops::Add<Output = T>,
    {
        if attribute.is_empty() {
            return None;
        }
        let indices = attribute.corner_indices(&mesh.triangles.triangles).get(self.triangle as usize)?;
        let at = |corner: usize| attribute.values.get(indices[corner] as usize).copied();
        let [a, b, c] = self.weights;
        Some(at(0)? * a + at(1)? * b + at(2)? * c)
    }
}

fn is_direction(vector: &DVec3) -> bool {
    vector.is_finite() && *vector != DVec3::ZERO
}

fn mesh_of<'v>(seen: &'v Visibility<'v>, part: usize) -> Option<&'v Mesh<'v>> {
    match &seen.subject.forms[seen.subject.parts[part].form].kind {
        FormKind::Mesh(mesh) => Some(mesh),
        FormKind::Exact(_) => None,
    }
}
