//! A glowing disc, sampled uniformly in area.

use super::{EmitterSample, in_front, pdf_of_area};
use crate::lights::LightBounds;
use crate::place::Place;
use glam::{Affine3A, Vec3};
use luch_image::Rgb;
use luch_sampling::warp::disc;
use luch_scene::{Emission, Id, Material, Scene};
use std::f32::consts::PI;

/// A disc in the world that emits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DiscEmitter {
    placement: Affine3A,
    /// In the shape's coordinates.
    local_radius: f32,
    normal: Vec3,
    area: f32,
    instance: u32,
    material: Id<Material>,
    two_sided: bool,
}

impl DiscEmitter {
    /// Number of the instance that shines.
    pub(crate) fn instance(&self) -> u32 {
        self.instance
    }

    /// The emitter of a disc of `radius` placed by a similarity.
    pub(crate) fn new(
        radius: f32,
        placement: &Affine3A,
        instance: u32,
        material: Id<Material>,
        emission: &Emission,
    ) -> Self {
        let y = Vec3::from(placement.matrix3.y_axis);
        let world_radius = radius * y.length();
        Self {
            placement: *placement,
            local_radius: radius,
            normal: y.normalize_or(Vec3::Y),
            area: PI * world_radius * world_radius,
            instance,
            material,
            two_sided: emission.two_sided,
        }
    }

    fn faces(&self, from: Vec3) -> bool {
        self.two_sided || (from - Vec3::from(self.placement.translation)).dot(self.normal) > 0.0
    }

    fn radiance(&self, scene: &Scene, local: Vec3) -> Rgb {
        let instance = &scene.instances[self.instance as usize];
        let shape = &scene.shapes[instance.shape.index()];
        let place =
            Place { scene, instance, shape, primitive: 0, weights: [1.0, 0.0, 0.0], local, footprint: None };
        place.lamp_radiance(&scene.materials[self.material.index()])
    }

    pub(crate) fn sample(&self, scene: &Scene, from: Vec3, u: [f32; 2]) -> Option<EmitterSample> {
        if !self.faces(from) {
            return None;
        }
        let place = disc(u) * self.local_radius;
        let local = Vec3::new(place.x, 0.0, place.y);
        let to = self.placement.transform_point3(local);
        let pdf = pdf_of_area(from, to, self.normal, self.area)?;
        EmitterSample::checked(
            (to - from).try_normalize()?,
            Some(in_front(to, self.normal, from, self.local_radius)),
            self.radiance(scene, local),
            pdf,
            false,
        )
    }

    pub(crate) fn pdf(&self, from: Vec3, to: Vec3) -> f32 {
        if self.faces(from) { pdf_of_area(from, to, self.normal, self.area).unwrap_or(0.0) } else { 0.0 }
    }

    pub(crate) fn bounds(&self, scene: &Scene) -> LightBounds {
        let emission = scene.materials[self.material.index()].emission.as_ref();
        let intensity = emission.map_or(0.0, |e| e.radiance.factor.luminance()) * self.area;
        let (center, radius) = (self.placement.translation.into(), (self.area / PI).sqrt());
        LightBounds::flat(center, radius, self.normal, intensity, self.two_sided)
    }
}
