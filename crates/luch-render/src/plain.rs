//! Plain surfaces: opaque triangles of one diffuse colour that emit nothing. Most of most scenes is made of them, so their
//! paths are scattered side by side.

use crate::cone::Cone;
use crate::footprint::Footprint;
use crate::place::{Place, blend};
use crate::world::World;
use glam::{Affine3A, Vec3};
use luch_bvh::{InstanceHit, Ray};
use luch_image::Rgb;
use luch_scene::{ColorValue, Normals, Opacity, Scene, Shape, Sides, Surface};

/// Which instances and materials are plain.
#[derive(Debug)]
pub(crate) struct Plain {
    /// A byte each: there may be millions.
    instances: Vec<Stands>,
    materials: Vec<Option<ColorValue>>,
}

/// How a mesh stands in the world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stands {
    /// It is no plain mesh.
    NotPlain,
    /// Where it was made.
    Unmoved,
    /// Elsewhere.
    Moved,
    /// Elsewhere, and its corners run the other way round.
    Mirrored,
}

/// A triangle that was hit, in the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlainHit {
    pub(crate) corners: [Vec3; 3],
    /// −1 if the outside is where the corners run clockwise.
    pub(crate) outward: f32,
    /// Largest coordinate that went into the corners.
    pub(crate) extent: f32,
    pub(crate) albedo: Rgb,
}

impl Plain {
    pub(crate) fn new(scene: &Scene) -> Self {
        let instance = |instance: &luch_scene::Instance| {
            let Shape::Mesh(mesh) = &*scene.shapes[instance.shape.index()] else { return Stands::NotPlain };
            let has_normals = !mesh.triangles.is_empty() && mesh.corner_normals(0).is_some();
            let smooth = scene.settings.normals == Normals::Interpolated && has_normals;
            match &instance.placement {
                _ if smooth => Stands::NotPlain,
                map if *map == Affine3A::IDENTITY => Stands::Unmoved,
                map if map.matrix3.determinant() < 0.0 => Stands::Mirrored,
                _ => Stands::Moved,
            }
        };
        let material = |material: &luch_scene::Material| match material.surface {
            Surface::Diffuse { color }
                if material.emission.is_none()
                    && material.normal_map.is_none()
                    && material.opacity == Opacity::Opaque
                    && material.sides == Sides::Both =>
            {
                Some(color)
            }
            _ => None,
        };
        Self {
            instances: scene.instances.iter().map(instance).collect(),
            materials: scene.materials.iter().map(material).collect(),
        }
    }

    /// The triangle that a ray hit, if it is plain.
    #[inline]
    pub(crate) fn hit(&self, world: &World, hit: &InstanceHit, ray: &Ray, cone: Cone) -> Option<PlainHit> {
        let stands = self.instances[hit.instance as usize];
        if stands == Stands::NotPlain {
            return None;
        }
        let mut place = Place::of_hit(&world.scene, hit, Vec3::ZERO);
        let color = self.materials[place.material_id().index()].as_ref()?;
        let Shape::Mesh(mesh) = place.shape else { return None };
        let corners = mesh.corners(place.primitive);
        let bounded = |value: f32| if value > 0.0 { value.min(1.0) } else { 0.0 };
        if color.texture.is_some() {
            let (direction, width) = (ray.direction, cone.at(hit.hit.t));
            place.footprint = Some(Footprint { pyramids: &world.pyramids, direction, width });
        }
        let albedo = place.color(color).map(bounded);
        let reach = corners.iter().fold(Vec3::ZERO, |reach, corner| reach.max(corner.abs()));
        if stands == Stands::Unmoved {
            return Some(PlainHit { corners, outward: 1.0, extent: reach.max_element(), albedo });
        }
        let map = &place.instance.placement;
        let [x, y, z] = [map.matrix3.x_axis, map.matrix3.y_axis, map.matrix3.z_axis].map(Vec3::from);
        let extent = blend([x.abs(), y.abs(), z.abs()], reach.to_array()) + Vec3::from(map.translation).abs();
        Some(PlainHit {
            corners: corners.map(|corner| map.transform_point3(corner)),
            outward: if stands == Stands::Mirrored { -1.0 } else { 1.0 },
            extent: extent.max_element(),
            albedo,
        })
    }
}
