//! Path tracing with light sampling and multiple importance sampling (Veach 1997), one bounce of a whole wave at a time.

use super::Integrator;
use crate::bsdf::BsdfSample;
use crate::material::{bsdf_at, emitted};
use crate::purpose;
use crate::roulette::survive;
use crate::stop::{Stop, Stopped};
use crate::surface::SurfacePoint;
use crate::view::CameraSample;
use crate::wave::{Origin, Path, Shadows, Wave};
use crate::world::World;
use glam::Vec3;
use luch_image::Rgb;
use luch_sampling::{hash, mis};

/// Path tracing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PathTracer {
    /// Most scatterings of a path; 0 shows only lamps.
    pub max_depth: u32,
}

impl Default for PathTracer {
    fn default() -> Self {
        Self { max_depth: 64 }
    }
}

impl Integrator for PathTracer {
    fn radiance(
        &self,
        world: &World,
        samples: &[CameraSample],
        radiance: &mut [Rgb],
        stop: &Stop,
    ) -> Result<(), Stopped> {
        let mut wave = Wave::start(samples);
        while !wave.is_empty() {
            stop.check()?;
            wave.extend(world);
            wave.shade(radiance, |path, hit, shadows| match hit {
                None => {
                    self.escape(world, path);
                    false
                }
                Some(hit) => {
                    let point = SurfacePoint::new(&world.scene, &world.geometry, &path.ray, hit);
                    self.arrive(world, path, &point, shadows)
                }
            });
            wave.connect(world, radiance);
        }
        Ok(())
    }
}

impl PathTracer {
    /// The path leaves the scene: it finds what lies beyond.
    fn escape(&self, world: &World, path: &mut Path) {
        for light in world.lights.beyond(&world.scene, path.ray.direction) {
            path.radiance += path.throughput * light.radiance * path.weight_of_found(light.pdf);
        }
    }

    /// The path meets a surface. False if it ends there.
    fn arrive(&self, world: &World, path: &mut Path, point: &SurfacePoint, shadows: &mut Shadows) -> bool {
        // Light of the surface itself.
        let light = emitted(point);
        if !light.is_black() {
            let pdf = path.origin.map_or(0.0, |origin| world.lights.pdf_of_hit(origin.position, point));
            path.radiance += path.throughput * light * path.weight_of_found(pdf);
        }
        if path.depth == self.max_depth {
            return false;
        }
        let bsdf = bsdf_at(world, point, &path.sampler, path.depth);
        let outgoing = point.frame.to_local(point.outgoing);

        // Light sampled from here.
        if !bsdf.is_specular() {
            let [choice, u, v, _] = path.sampler.group_words(purpose::light(path.depth));
            let choice = f64::from(choice) / 4_294_967_296.0;
            let [u, v] = [u, v].map(hash::unit_f32);
            if let Some(light) = world.lights.sample(&world.scene, point.position, choice, [u, v])
                && point.is_honest(light.incoming)
            {
                let scattered = bsdf.evaluate(outgoing, point.frame.to_local(light.incoming));
                let weight = if light.delta { 1.0 } else { mis::power(light.pdf, scattered.pdf) };
                let carried = path.throughput * scattered.value * light.radiance * (weight / light.pdf);
                if !carried.is_black() {
                    let ray =
                        light.target.map_or_else(|| point.ray_toward(light.incoming), |to| point.ray_to(to));
                    shadows.push(ray, carried);
                }
            }
        }

        // The next direction.
        let [u, v, lobe, chance] = path.sampler.group(purpose::scatter(path.depth));
        let Some(scattered) = bsdf.sample(outgoing, [u, v], lobe) else { return false };
        let incoming = point.frame.to_world(scattered.incoming);
        if !point.is_honest(incoming) {
            return false;
        }
        path.throughput *= scattered.weight();
        // Refraction scales radiance by the squared index; whether a path is worth going on does not depend on that.
        if scattered.incoming.z * outgoing.z < 0.0 {
            let ior = bsdf.ior();
            path.radiance_scale *= if outgoing.z > 0.0 { 1.0 / (ior * ior) } else { ior * ior };
        }
        let Some(factor) = survive(path.depth, path.throughput / path.radiance_scale, chance) else {
            return false;
        };
        path.throughput *= factor;
        path.follow(point, incoming, &scattered);
        true
    }
}

impl Path {
    /// How much light counts that the path found by itself, where light sampling has density `light_pdf` for it.
    fn weight_of_found(&self, light_pdf: f32) -> f32 {
        match self.origin {
            Some(origin) if !origin.specular => mis::power(origin.pdf, light_pdf),
            _ => 1.0,
        }
    }

    fn follow(&mut self, point: &SurfacePoint, incoming: Vec3, scattered: &BsdfSample) {
        self.origin =
            Some(Origin { position: point.position, pdf: scattered.pdf, specular: scattered.specular });
        self.ray = point.ray_toward(incoming);
        self.depth += 1;
    }
}
