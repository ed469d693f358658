//! The same integral as the path tracer's with no cleverness: follow the scattered ray, count the light it happens to meet.
//!
//! It sees only lights that have a surface or fill the sky. For those it is the reference in tests.

use super::Integrator;
use crate::cone::Cone;
use crate::material::{bsdf_at, emitted};
use crate::roulette::survive;
use crate::stop::{Stop, Stopped};
use crate::surface::SurfacePoint;
use crate::view::CameraSample;
use crate::world::World;
use crate::{opacity_key, purpose};
use luch_image::Rgb;

/// Path tracing without light sampling.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlainPathTracer {
    /// Most scatterings of a path; 0 shows only lamps.
    pub max_depth: u32,
}

impl PlainPathTracer {
    fn trace(&self, world: &World, sample: &CameraSample, stop: &Stop) -> Result<Rgb, Stopped> {
        let scene = &world.scene;
        let sampler = &sample.sampler;
        let (mut radiance, mut throughput) = (Rgb::BLACK, Rgb::WHITE);
        let (mut ray, mut cone) = (sample.ray, sample.cone);
        for depth in 0.. {
            if depth & 63 == 63 {
                stop.check()?;
            }
            let Some(hit) =
                world.geometry.nearest_hit(scene, &ray, opacity_key(sampler, purpose::opacity(depth)))
            else {
                for light in world.lights.beyond(scene, ray.origin, glam::Vec3::ZERO, ray.direction) {
                    radiance += throughput * light.radiance;
                }
                break;
            };
            let mut point = SurfacePoint::new(scene, &world.geometry, &ray, hit);
            point.width = cone.at(hit.hit.t);
            radiance += throughput * emitted(&point);
            if depth == self.max_depth {
                break;
            }
            let bsdf = bsdf_at(world, &point, sampler, depth);
            let [u, v, lobe, chance] = sampler.group(purpose::scatter(depth));
            let outgoing = point.frame.to_local(point.outgoing);
            let Some(scattered) = bsdf.sample(outgoing, [u, v], lobe) else { break };
            let incoming = point.frame.to_world(scattered.incoming);
            if !point.exit().is_honest(incoming) {
                break;
            }
            throughput *= scattered.weight();
            let Some(factor) = survive(depth, throughput, chance) else { break };
            throughput *= factor;
            ray = point.exit().ray_toward(incoming);
            cone = if scattered.specular { cone.passed_on(hit.hit.t) } else { Cone::SCATTERED };
        }
        Ok(radiance)
    }
}

impl Integrator for PlainPathTracer {
    fn radiance(
        &self,
        world: &World,
        samples: &[CameraSample],
        radiance: &mut [Rgb],
        stop: &Stop,
    ) -> Result<(), Stopped> {
        for (samples, radiance) in samples.chunks(256).zip(radiance.chunks_mut(256)) {
            stop.check()?;
            for (sample, radiance) in samples.iter().zip(radiance) {
                *radiance = self.trace(world, sample, stop)?;
            }
        }
        Ok(())
    }
}
