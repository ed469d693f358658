//! A glowing sphere, sampled uniformly in the solid angle it is seen under.

use super::{EmitterSample, in_front, pdf_of_area};
use crate::lights::LightBounds;
use crate::place::Place;
use glam::{Affine3A, Vec3};
use luch_image::Rgb;
use luch_sampling::Frame;
use luch_sampling::warp::{Cone, sphere};
use luch_scene::{Emission, Id, Material, Scene};
use std::f32::consts::PI;

/// A sphere in the world that emits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BallEmitter {
    center: Vec3,
    radius: f32,
    instance: u32,
    material: Id<Material>,
    two_sided: bool,
    to_local: Affine3A,
}

impl BallEmitter {
    /// Number of the instance that shines.
    pub(crate) fn instance(&self) -> u32 {
        self.instance
    }

    /// The emitter of a sphere of `radius` placed by a similarity.
    pub(crate) fn new(
        radius: f32,
        placement: &Affine3A,
        instance: u32,
        material: Id<Material>,
        emission: &Emission,
    ) -> Self {
        Self {
            center: placement.translation.into(),
            radius: radius * Vec3::from(placement.matrix3.x_axis).length(),
            instance,
            material,
            two_sided: emission.two_sided,
            to_local: placement.inverse(),
        }
    }

    /// The cone it is seen under from outside.
    fn cone(&self, from: Vec3) -> Option<Cone> {
        /// Nearer to the surface than this, rounding may have put a point of the inside outside.
        const OUTSIDE: f32 = 1.0 - 1e-3;
        let squared = from.distance_squared(self.center);
        let sine = self.radius * self.radius / squared;
        if sine < OUTSIDE { Cone::from_sin_squared(sine) } else { None }
    }

    fn radiance(&self, scene: &Scene, at: Vec3) -> Rgb {
        let instance = &scene.instances[self.instance as usize];
        let place = Place {
            scene,
            instance,
            shape: &scene.shapes[instance.shape.index()],
            primitive: 0,
            weights: [1.0, 0.0, 0.0],
            local: self.to_local.transform_point3(at),
            footprint: None,
        };
        place.lamp_radiance(&scene.materials[self.material.index()])
    }

    pub(crate) fn sample(&self, scene: &Scene, from: Vec3, u: [f32; 2]) -> Option<EmitterSample> {
        if let Some(cone) = self.cone(from) {
            let axis = (self.center - from).try_normalize()?;
            let incoming = Frame::from_normal(axis).to_world(cone.sample(u));
            // The nearer of the two places where the direction meets the sphere; at the rim, the nearest to it.
            let along = incoming.dot(self.center - from);
            let off = (self.center - from) - incoming * along;
            let half = (self.radius * self.radius - off.length_squared()).max(0.0).sqrt();
            let out = (from + incoming * (along - half) - self.center).try_normalize()?;
            let to = self.center + out * self.radius;
            return EmitterSample::checked(
                incoming,
                Some(in_front(to, out, from, self.radius)),
                self.radiance(scene, to),
                cone_pdf(&cone),
                false,
            );
        }
        if !self.two_sided {
            return None;
        }
        let normal = sphere(u);
        let to = self.center + normal * self.radius;
        let pdf = pdf_of_area(from, to, normal, self.area())?;
        let target = in_front(to, normal, from, self.radius);
        EmitterSample::checked(
            (to - from).try_normalize()?,
            Some(target),
            self.radiance(scene, to),
            pdf,
            false,
        )
    }

    pub(crate) fn pdf(&self, from: Vec3, to: Vec3) -> f32 {
        match self.cone(from) {
            // From outside only the near side is drawn: the far one can still be met, through a sphere that is partly there.
            Some(_) if (to - self.center).dot(from - self.center) < self.radius * self.radius => 0.0,
            Some(cone) => cone_pdf(&cone),
            None if self.two_sided => {
                let normal = (to - self.center).normalize_or(Vec3::Y);
                pdf_of_area(from, to, normal, self.area()).unwrap_or(0.0)
            }
            None => 0.0,
        }
    }

    fn area(&self) -> f32 {
        4.0 * PI * self.radius * self.radius
    }

    pub(crate) fn bounds(&self, scene: &Scene) -> LightBounds {
        let emission = scene.materials[self.material.index()].emission.as_ref();
        let radiance = emission.map_or(0.0, |e| e.radiance.factor.luminance());
        // From afar a sphere is a disc.
        LightBounds::round(self.center, self.radius, radiance * PI * self.radius * self.radius)
    }
}

fn cone_pdf(cone: &Cone) -> f32 {
    1.0 / cone.solid_angle()
}
