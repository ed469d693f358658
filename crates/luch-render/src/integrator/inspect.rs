//! One property of the surface seen, as a colour: the cheapest pictures, and the layers beside the beauty.

use super::Integrator;
use crate::material::{bsdf_at, emitted};
use crate::stop::{Stop, Stopped};
use crate::surface::SurfacePoint;
use crate::view::{CameraSample, View};
use crate::world::World;
use crate::{opacity_key, purpose};
use glam::Vec3;
use luch_bvh::{Coherence, Ray};
use luch_image::Rgb;
use luch_sampling::hash;
use luch_scene::Property;

/// Shows a property; what meets nothing is black.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inspect {
    property: Property,
    /// The camera's place and viewing axis.
    eye: Vec3,
    forward: Vec3,
}

impl Inspect {
    /// The property as seen by a view's camera.
    pub fn new(property: Property, view: &View) -> Self {
        let camera = view.camera();
        Self { property, eye: camera.position, forward: -camera.orientation.z_axis }
    }

    fn show(&self, world: &World, sample: &CameraSample, point: &SurfacePoint) -> Rgb {
        let color = |v: Vec3| Rgb::new(v.x, v.y, v.z);
        match self.property {
            Property::Normal => color(point.frame.normal),
            Property::GeometricNormal => color(point.geometric_normal),
            Property::Uv => {
                let uv = point.place.uv(0);
                Rgb::new(uv.x, uv.y, 0.0)
            }
            Property::Depth => Rgb::gray((point.position - self.eye).dot(self.forward)),
            Property::Albedo => {
                let albedo = bsdf_at(world, point, &sample.sampler, 0).albedo();
                // Lamps have no albedo worth speaking of: they show their own light, as white at most.
                let light = emitted(point);
                if light.is_black() { albedo } else { light.map(|v| v.min(1.0)) }
            }
            Property::Instance => id_color(u64::from(point.hit.instance)),
            Property::Material => id_color(point.material.index() as u64),
            Property::Primitive => {
                id_color(u64::from(point.hit.instance) << 32 | u64::from(point.hit.hit.primitive))
            }
            Property::Barycentric => color(Vec3::from(point.place.weights)),
        }
    }
}

/// A colour that tells neighbouring ids apart.
fn id_color(id: u64) -> Rgb {
    let bits = hash::mix64(id.wrapping_add(hash::GOLDEN));
    let channel = |shift: u32| 0.15 + 0.75 * hash::unit_f32((bits >> shift) as u32);
    Rgb::new(channel(0), channel(20), channel(32))
}

impl Integrator for Inspect {
    fn radiance(
        &self,
        world: &World,
        samples: &[CameraSample],
        radiance: &mut [Rgb],
        stop: &Stop,
    ) -> Result<(), Stopped> {
        stop.check()?;
        let rays: Vec<Ray> = samples.iter().map(|sample| sample.ray).collect();
        let mut hits = vec![None; rays.len()];
        let key = |i: usize| opacity_key(&samples[i].sampler, purpose::opacity(0));
        world.geometry.nearest_hits(&world.scene, &rays, &mut hits, Coherence::Coherent, key);
        for ((sample, hit), radiance) in samples.iter().zip(hits).zip(radiance) {
            *radiance = hit.map_or(Rgb::BLACK, |hit| {
                let mut point = SurfacePoint::new(&world.scene, &world.geometry, &sample.ray, hit);
                point.width = sample.cone.at(hit.hit.t);
                self.show(world, sample, &point)
            });
        }
        Ok(())
    }
}
