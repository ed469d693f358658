//! A point of a surface: where a path stands, and how the next ray leaves it safely.

use crate::footprint::{Footprint, Pyramids};
use crate::geometry::{Geometry, is_smooth, local_normal};
use crate::place::{Place, blend};
use crate::traced;
use glam::{Mat3, Vec3};
use luch_bvh::{InstanceHit, Ray};
use luch_sampling::Frame;
use luch_scene::{Id, Material, NormalMap, Scene, Shape, TextureUse};

/// Part of the largest coordinate by which a computed position may miss the surface: the roundings that the analysis of Pharr,
/// Jakob and Humphreys (section 6.8) counts for the chain, doubled, each half a unit in the last place of 1.
pub(crate) const POSITION_ERROR: f32 = 32.0 * f32::EPSILON / 2.0;

/// A point where a ray met a surface.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint<'a> {
    pub(crate) place: Place<'a>,
    /// Ids and barycentric coordinates.
    pub hit: InstanceHit,
    /// In the world.
    pub position: Vec3,
    /// Unit normal of the triangle or shape, on its outside.
    pub geometric_normal: Vec3,
    /// Shading frame; its normal is on the side of the geometric one.
    pub frame: Frame,
    /// Back along the ray that came here; unit length.
    pub outgoing: Vec3,
    /// What the surface is made of.
    pub material: Id<Material>,
    /// Diameter of the ray that came here, metres: textures are averaged over it. 0 reads them as they are.
    pub width: f32,
    /// Bound of the position's rounding error along any axis.
    error: f32,
    /// How far smooth shading lifts the point off the triangle, on the outside and on the inside.
    lift: [Vec3; 2],
    /// Whether the shading normal was tilted toward the viewer, so that others would see another frame.
    tilted: bool,
}

impl<'a> SurfacePoint<'a> {
    /// The point of a hit of `ray`.
    pub fn new(scene: &'a Scene, geometry: &Geometry, ray: &Ray, hit: InstanceHit) -> Self {
        let mut place = Place::of_hit(scene, &hit, Vec3::ZERO);
        let placement = &place.instance.placement;
        place.local = match place.shape {
            Shape::Mesh(mesh) => blend(mesh.corners(place.primitive), place.weights),
            Shape::Sphere { radius } => {
                let near = placement.inverse().transform_point3(ray.at(hit.hit.t));
                near.try_normalize().unwrap_or(Vec3::Y) * *radius
            }
            Shape::Disc { .. } | Shape::Plane => {
                let near = placement.inverse().transform_point3(ray.at(hit.hit.t));
                Vec3::new(near.x, 0.0, near.z)
            }
            Shape::Traced(form) => {
                place.local = placement.inverse().transform_point3(ray.at(hit.hit.t));
                traced::point(form, &place)
            }
        };
        let position = placement.transform_point3(place.local);
        let error = position_error(&place, ray, &hit);
        let outgoing = -ray.direction.normalize();
        let normal_map = geometry.normal_map(hit.instance);
        let geometric_normal = (*normal_map * local_normal(&place)).try_normalize().unwrap_or(outgoing);
        let mut point = Self {
            place,
            hit,
            position,
            geometric_normal,
            frame: Frame::from_normal(geometric_normal),
            outgoing,
            material: place.material_id(),
            width: 0.0,
            error,
            lift: [Vec3::ZERO; 2],
            tilted: false,
        };
        point.shade(normal_map);
        point
    }

    /// The place with the footprint of the ray, for what a surface scatters by.
    pub(crate) fn seen<'w>(&self, pyramids: &'w Pyramids) -> Place<'w>
    where
        'a: 'w,
    {
        let footprint = Footprint { pyramids, direction: -self.outgoing, width: self.width };
        Place { footprint: (self.width > 0.0).then_some(footprint), ..self.place }
    }

    /// True if the ray came from outside.
    pub fn is_front(&self) -> bool {
        self.outgoing.dot(self.geometric_normal) > 0.0
    }

    /// Finds the shading frame.
    fn shade(&mut self, normal_map: &Mat3) {
        let mut normal = self.geometric_normal;
        if is_smooth(self.place.scene)
            && let Some((places, normals)) = self.facet()
        {
            let corners = normals.map(|n| (*normal_map * n).try_normalize().unwrap_or(self.geometric_normal));
            let smooth = blend(corners, self.place.weights).try_normalize().unwrap_or(self.geometric_normal);
            normal = if smooth.dot(self.geometric_normal) < 0.0 { -smooth } else { smooth };
            if corners.iter().any(|n| n.distance_squared(self.geometric_normal) > 1e-10) {
                self.lift = self.terminator_lift(places, corners);
            }
        }
        let material = &self.place.scene.materials[self.material.index()];
        self.frame = match &material.normal_map {
            None => Frame::from_normal(normal),
            Some(map) => {
                let tilted = self.mapped(map, normal);
                Frame::from_normal(if tilted.dot(self.geometric_normal) > 0.0 { tilted } else { normal })
            }
        };
        self.keep_visible();
    }

    /// Corners and normals of the flat piece that the point is on, in the shape's coordinates.
    fn facet(&self) -> Option<([Vec3; 3], [Vec3; 3])> {
        match self.place.shape {
            Shape::Mesh(mesh) => {
                let triangle = self.place.primitive;
                mesh.corner_normals(triangle).map(|normals| (mesh.corners(triangle), normals))
            }
            Shape::Traced(form) => traced::facet(form, &self.place),
            Shape::Sphere { .. } | Shape::Disc { .. } | Shape::Plane => None,
        }
    }

    /// Lifts the point onto the smooth surface that the corner normals suggest, so that shadows do not show the triangles
    /// (Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II, 2021). One lift for each side.
    fn terminator_lift(&self, corners: [Vec3; 3], normals: [Vec3; 3]) -> [Vec3; 2] {
        let corners = corners.map(|corner| self.place.instance.placement.transform_point3(corner));
        [1.0, -1.0].map(|side| {
            let lift = |i: usize| {
                let normal = normals[i] * side;
                normal * -(self.position - corners[i]).dot(normal).min(0.0)
            };
            let lift = blend([lift(0), lift(1), lift(2)], self.place.weights);
            // Only ever outward.
            if lift.dot(self.geometric_normal) * side > 0.0 { lift } else { Vec3::ZERO }
        })
    }

    /// The normal of a tangent-space map.
    fn mapped(&self, map: &NormalMap, normal: Vec3) -> Vec3 {
        let Some(frame) = self.tangent_frame(&map.texture, normal) else { return normal };
        let [r, g, b, _] = self.place.texture(&map.texture);
        let local = Vec3::new((2.0 * r - 1.0) * map.scale, (2.0 * g - 1.0) * map.scale, 2.0 * b - 1.0);
        (frame * local).try_normalize().unwrap_or(normal)
    }

    /// Tangent along u of the map, bitangent along v, normal, as columns.
    fn tangent_frame(&self, map: &TextureUse, normal: Vec3) -> Option<Mat3> {
        let linear = Mat3::from(self.place.instance.placement.matrix3);
        let mirrored = if linear.determinant() < 0.0 { -1.0 } else { 1.0 };
        let (tangent, handedness) = match self.place.shape {
            Shape::Mesh(mesh) => {
                let triangle = self.place.primitive;
                if let Some(given) = mesh.tangents.corners(triangle, mesh.triangles[triangle]) {
                    let tangent = blend(given.map(|t| t.truncate()), self.place.weights);
                    (tangent, given[0].w.signum() * mirrored)
                } else {
                    let [a, b, c] = mesh.corners(triangle);
                    let [ta, tb, tc] =
                        mesh.corner_uvs(triangle, usize::from(map.uv_set))?.map(|uv| map.place(uv));
                    let (du, dv) = (tb - ta, tc - ta);
                    let determinant = du.x * dv.y - du.y * dv.x;
                    if determinant == 0.0 {
                        return None;
                    }
                    let tangent = ((b - a) * dv.y - (c - a) * du.y) * determinant.signum();
                    (tangent, determinant.signum() * mirrored)
                }
            }
            Shape::Sphere { .. } => (Vec3::new(self.place.local.z, 0.0, -self.place.local.x), mirrored),
            Shape::Disc { .. } | Shape::Plane => (Vec3::X, mirrored),
            Shape::Traced(form) => (traced::tangent(form, &self.place), mirrored),
        };
        let tangent = linear * tangent;
        let tangent = (tangent - normal * normal.dot(tangent)).try_normalize()?;
        Some(Mat3::from_cols(tangent, normal.cross(tangent) * handedness, normal))
    }

    /// Tilts the shading normal until the viewer is on the same side of it as of the surface.
    fn keep_visible(&mut self) {
        /// Least cosine between the viewer and the shading normal.
        const LEAST: f32 = 1e-3;
        let side = if self.is_front() { 1.0 } else { -1.0 };
        let cosine = self.outgoing.dot(self.frame.normal) * side;
        let geometric = self.outgoing.dot(self.geometric_normal) * side;
        if cosine < LEAST && cosine < geometric {
            let tilted = self.frame.normal + self.outgoing * (side * (LEAST.min(geometric) - cosine));
            self.frame = Frame::from_normal(tilted.try_normalize().unwrap_or(self.geometric_normal));
            self.tilted = true;
        }
    }

    /// Whether the frame does not depend on who looks.
    pub(crate) fn is_seen_alike(&self) -> bool {
        !self.tilted
    }

    /// What is needed to leave from here.
    pub fn exit(&self) -> Exit {
        let front = self.is_front();
        let side = if front { 1.0 } else { -1.0 };
        let lift = self.lift[usize::from(!front)];
        // The next test's own rounding is along the ray, so the largest extent counts, not that along the normal alone.
        let off = self.geometric_normal * (side * self.error);
        Exit {
            position: self.position,
            geometric_normal: self.geometric_normal * side,
            normal: self.frame.normal * side,
            // Smooth shading is lifted only where light is reflected: refracted rays start on the triangle.
            near: self.position + lift + off,
            far: self.position - off,
            lifted: lift != Vec3::ZERO,
        }
    }
}

/// How rays leave a point of a surface, and arrive at it, without meeting that surface.
#[derive(Clone, Copy, Debug)]
pub struct Exit {
    /// In the world.
    pub position: Vec3,
    /// Unit normal of the triangle or shape, on the side of the viewer.
    pub geometric_normal: Vec3,
    /// Normal of the shading frame, on the same side.
    pub normal: Vec3,
    /// Where rays on the viewer's side start.
    pub near: Vec3,
    /// Where rays on the other side start.
    pub far: Vec3,
    /// Whether smooth shading lifts the point off the triangle on the viewer's side.
    pub lifted: bool,
}

impl Exit {
    /// Whether light may pass along a direction without leaking through the surface: it is on the same side of the shading
    /// normal as of the surface, or it is reflected by the smooth surface that the point is lifted onto.
    ///
    /// The second are directions that dip below the triangle but not below the smooth surface, on the viewer's side. From the
    /// lifted point the mesh itself decides whether something is in the way; without that the triangles show along the
    /// shadow's edge.
    pub fn is_honest(&self, direction: Vec3) -> bool {
        direction.dot(self.geometric_normal) * direction.dot(self.normal) > 0.0
            || (self.lifted && direction.dot(self.normal) > 0.0)
    }

    /// Where a ray along `direction` may start without meeting the surface it leaves.
    pub(crate) fn start_toward(&self, direction: Vec3) -> Vec3 {
        let reflected =
            direction.dot(self.geometric_normal) > 0.0 || (self.lifted && direction.dot(self.normal) > 0.0);
        if reflected { self.near } else { self.far }
    }

    /// The ray that leaves along `direction`.
    pub fn ray_toward(&self, direction: Vec3) -> Ray {
        Ray::new(self.start_toward(direction), direction)
    }

    /// The ray to `target`, ending just before it. A target on a surface must be given on the near side of that.
    pub fn ray_to(&self, target: Vec3) -> Ray {
        segment_before(self.start_toward(target - self.position), target)
    }
}

/// The ray from `start` that ends just before `target`.
#[inline(always)]
pub(crate) fn segment_before(start: Vec3, target: Vec3) -> Ray {
    /// Leaves room for the rounding of the segment itself.
    const BEFORE: f32 = 1.0 - 4.0 * f32::EPSILON;
    Ray { t_max: BEFORE, ..Ray::segment(start, target) }
}

/// How far the computed position may be from the surface, along any axis: roundings of the place in the shape, of the placement,
/// and of the way back to the shape's coordinates when the next ray is tested.
fn position_error(place: &Place, ray: &Ray, hit: &InstanceHit) -> f32 {
    let m = &place.instance.placement.matrix3;
    let (size, far) = match place.shape {
        Shape::Mesh(mesh) => {
            let [a, b, c] = mesh.corners(place.primitive);
            (a.abs().max(b.abs()).max(c.abs()), Vec3::ZERO)
        }
        Shape::Sphere { radius } => (Vec3::splat(*radius), Vec3::ZERO),
        // Their places are found along the ray and carry its rounding.
        Shape::Disc { .. } | Shape::Plane | Shape::Traced(_) => {
            (place.local.abs(), ray.origin.abs() + (ray.direction * hit.hit.t).abs())
        }
    };
    let x = Vec3::from(m.x_axis).abs() * size.x;
    let y = Vec3::from(m.y_axis).abs() * size.y;
    let z = Vec3::from(m.z_axis).abs() * size.z;
    let translation = Vec3::from(place.instance.placement.translation).abs();
    (x + y + z + translation + far).max_element() * POSITION_ERROR
}
