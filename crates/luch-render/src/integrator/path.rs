//! Path tracing with light sampling and multiple importance sampling (Veach 1997), one bounce of a whole wave at a time.

mod lanes;

use super::Integrator;
use crate::bsdf::{Bsdf, Diffuse};
use crate::material::{bsdf_at, emitted};
use crate::purpose;
use crate::reuse::{Lucky, Standpoint};
use crate::roulette::survive;
use crate::stop::{Stop, Stopped};
use crate::surface::{Exit, SurfacePoint, segment_before};
use crate::view::CameraSample;
use crate::wave::{Arrival, Found, Leg, Origin, Path, Wave};
use crate::world::World;
use glam::Vec3;
use luch_bvh::Ray;
use luch_bvh::simd::dispatch;
use luch_image::Rgb;
use luch_sampling::{Frame, hash, mis};

/// Scatterings up to which paths of a bundle help each other.
const TOGETHER: u32 = 32;

/// Path tracing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PathTracer {
    /// Most scatterings of a path; 0 shows only lamps.
    pub max_depth: u32,
    /// Whether neighbouring pixels share the second halves of their paths.
    pub reuse: bool,
}

impl Default for PathTracer {
    fn default() -> Self {
        Self { max_depth: 64, reuse: true }
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
        let mut wave = Wave::start(samples, radiance);
        let share = self.reuse && world.geometry.is_certain();
        let mut bounce = 0;
        while !wave.is_empty() {
            stop.check()?;
            wave.extend(world);
            wave.shade(
                world,
                radiance,
                |path, hit, found| match hit {
                    None => {
                        escape(world, path, found, share);
                        false
                    }
                    Some(hit) => {
                        let point = SurfacePoint::new(&world.scene, &world.geometry, &path.ray, hit);
                        self.arrive(world, path, &point, found, share)
                    }
                },
                |paths, arrivals, found, alive| {
                    if bounce < self.max_depth {
                        arrive_plain(world, paths, arrivals, found, alive, share);
                    }
                },
            );
            wave.connect(world, radiance);
            bounce += 1;
        }
        if share {
            wave.reuse.share(world, self.max_depth, radiance);
        }
        wave.end();
        Ok(())
    }
}

/// The path leaves the scene: it finds what lies beyond.
fn escape(world: &World, path: &mut Path, found: &mut Found, share: bool) {
    let (from, normal) = path.origin.map_or((Vec3::ZERO, Vec3::ZERO), |o| (o.position, o.normal));
    for light in world.lights.beyond(&world.scene, from, normal, path.ray.direction) {
        let light = light.radiance * path.weight_of_found(light.pdf * path.partners(found));
        path.come_upon(light, found, share);
    }
}

/// Paths meet plain surfaces. Says which of them go on.
fn arrive_plain(
    world: &World,
    paths: &mut [Path],
    arrivals: &[Arrival],
    found: &mut Found,
    alive: &mut [bool],
    share: bool,
) {
    let Some(first) = arrivals.first().map(|arrival| &paths[arrival.path]) else { return };
    let bounce = first.depth;
    let mut lanes = lanes::Arrivals::new(first.sampler);
    for Arrival { path, hit, triangle } in arrivals {
        let path = &paths[*path];
        lanes.push(path, hit, triangle, share && path.may_be_first());
    }
    let mut departures = lanes::Departures::new();
    dispatch(lanes::Scatter { arrivals: &lanes, departures: &mut departures, bounce });
    for (lane, arrival) in arrivals.iter().enumerate() {
        if !departures.is_seen(lane) {
            continue;
        }
        let path = &mut paths[arrival.path];
        let albedo = arrival.triangle.albedo;
        let is_first = share && path.offer(&departures.exit(lane), albedo, found);
        let (position, normal, near) =
            (departures.position(lane), departures.normal(lane), departures.near(lane));
        let together = share && path.lights_together(world);
        if together {
            found.standpoints.push(Standpoint {
                sample: path.sample,
                exit: departures.exit(lane),
                frame: Frame::from_normal(normal),
                bsdf: Bsdf::Diffuse(Diffuse::new(albedo)),
                outgoing: Vec3::Z,
                toward_viewer: -path.ray.direction,
                throughput: path.throughput,
                numbers: path.together.group_words(purpose::light(bounce)),
            });
        } else if let Some(light) = {
            let choice = f64::from(departures.light_choice[lane]) / 4_294_967_296.0;
            world.lights.sample(&world.scene, position, normal, choice, departures.light_place(lane))
        } {
            let (value, pdf) = lanes::reflected(normal, light.incoming, albedo);
            let weight = if light.delta { 1.0 } else { mis::power(light.pdf, pdf) };
            let carried = path.throughput * value * light.radiance * (weight / light.pdf);
            if !carried.is_black() {
                let ray = light
                    .target
                    .map_or_else(|| Ray::new(near, light.incoming), |target| segment_before(near, target));
                found.ask(path, ray, carried);
            }
        }
        let factor = if is_first { 1.0 } else { departures.factor(lane) };
        if factor > 0.0 {
            path.leave(departures.direction(lane), false, is_first);
            path.throughput *= albedo * factor;
            path.origin =
                Some(Origin { position, normal, together, pdf: departures.pdf(lane), specular: false });
            path.ray = Ray::new(near, departures.direction(lane));
            path.depth += 1;
            alive[arrival.path] = true;
        }
    }
}

impl PathTracer {
    /// The path meets a surface. False if it ends there.
    fn arrive(
        &self,
        world: &World,
        path: &mut Path,
        point: &SurfacePoint,
        found: &mut Found,
        share: bool,
    ) -> bool {
        // Light of the surface itself.
        let light = emitted(point);
        if !light.is_black() {
            let pdf = path.origin.map_or(0.0, |origin| match origin.together {
                true => world.lights.candidate_pdf_of_hit(origin.position, origin.normal, point),
                false => world.lights.pdf_of_hit(origin.position, origin.normal, point),
            });
            let pdf = pdf * path.partners(found);
            path.come_upon(light * path.weight_of_found(pdf), found, share);
        }
        if path.depth == self.max_depth {
            return false;
        }
        let bsdf = bsdf_at(world, point, &path.sampler, path.depth);
        let outgoing = point.frame.to_local(point.outgoing);
        let exit = point.exit();
        // Light is sampled for the pixel alone, directions for the whole bundle.
        let own = path.sampler;
        let together = share && !bsdf.is_specular() && path.lights_together(world);
        let is_first = match &bsdf {
            Bsdf::Diffuse(diffuse) if share && point.is_seen_alike() => {
                path.offer(&exit, diffuse.color(), found)
            }
            _ => false,
        };

        let receiving = if bsdf.transmits() { Vec3::ZERO } else { exit.normal };

        // Light sampled from here.
        if together {
            found.standpoints.push(Standpoint {
                sample: path.sample,
                exit,
                frame: point.frame,
                bsdf,
                outgoing,
                toward_viewer: point.outgoing,
                throughput: path.throughput,
                numbers: path.together.group_words(purpose::light(path.depth)),
            });
        } else if !bsdf.is_specular() {
            let [choice, u, v, _] = own.group_words(purpose::light(path.depth));
            let choice = f64::from(choice) / 4_294_967_296.0;
            let [u, v] = [u, v].map(hash::unit_f32);
            if let Some(light) = world.lights.sample(&world.scene, point.position, receiving, choice, [u, v])
                && exit.is_honest(light.incoming)
            {
                let scattered = bsdf.evaluate(outgoing, point.frame.to_local(light.incoming));
                let weight = if light.delta { 1.0 } else { mis::power(light.pdf, scattered.pdf) };
                let carried = path.throughput * scattered.value * light.radiance * (weight / light.pdf);
                if !carried.is_black() {
                    let ray =
                        light.target.map_or_else(|| exit.ray_toward(light.incoming), |to| exit.ray_to(to));
                    found.ask(path, ray, carried);
                }
            }
        }

        // The next direction.
        let [u, v, lobe, chance] = path.sampler.group(purpose::scatter(path.depth));
        let Some(scattered) = bsdf.sample(outgoing, [u, v], lobe) else { return false };
        let incoming = point.frame.to_world(scattered.incoming);
        if !exit.is_honest(incoming) {
            return false;
        }
        path.throughput *= scattered.weight();
        // Refraction scales radiance by the squared index; whether a path is worth going on does not depend on that.
        if scattered.incoming.z * outgoing.z < 0.0 {
            let ior = bsdf.ior();
            path.radiance_scale *= if outgoing.z > 0.0 { 1.0 / (ior * ior) } else { ior * ior };
        }
        // What the bundle takes together is not left to chance.
        let sure = matches!(path.leg, Leg::Seen | Leg::Sent { .. }) && path.depth < TOGETHER;
        if !(is_first || (sure && scattered.specular)) {
            let carried = path.throughput * path.carried / path.radiance_scale;
            let Some(factor) = survive(path.depth, carried, chance) else {
                return false;
            };
            path.throughput *= factor;
        }
        path.leave(incoming, scattered.specular, is_first);
        path.origin = Some(Origin {
            position: point.position,
            normal: receiving,
            together,
            pdf: scattered.pdf,
            specular: scattered.specular,
        });
        path.ray = exit.ray_toward(incoming);
        path.depth += 1;
        true
    }
}

impl Path {
    /// Whether a diffuse surface here would be the path's first.
    fn may_be_first(&self) -> bool {
        self.leg == Leg::Seen && self.depth < TOGETHER
    }

    /// Whether the bundle samples direct light together where the path is now.
    fn lights_together(&self, world: &World) -> bool {
        self.may_be_first() && world.lights.is_shareable()
    }

    /// How many paths sampled direct light together where this one comes from.
    fn partners(&self, found: &Found) -> f32 {
        match self.origin {
            Some(origin) if origin.together => found.reuse.partners(self.sample),
            _ => 1.0,
        }
    }

    /// Lets the bundle know of a diffuse surface. The first is where others are connected from: then the answer is true. The
    /// second is where they are connected to: what the path finds from then on belongs to all.
    fn offer(&mut self, exit: &Exit, albedo: Rgb, found: &mut Found) -> bool {
        match self.leg {
            Leg::Seen if self.may_be_first() => {
                found.reuse.set_first(self.sample, exit, self.depth, self.throughput * albedo);
                self.sampler = self.together;
                true
            }
            Leg::Sent { mirrors: 0, .. } => {
                found.reuse.set_second(self.sample, exit, self.depth);
                self.carried = self.throughput;
                self.throughput = Rgb::WHITE;
                self.leg = Leg::Shared;
                false
            }
            _ => false,
        }
    }

    /// Notes that the path goes on, after a first point or over a mirror or otherwise.
    fn leave(&mut self, direction: Vec3, specular: bool, is_first: bool) {
        self.leg = match self.leg {
            Leg::Seen if is_first => {
                self.sent = direction;
                Leg::Sent { mirrors: 0, lit: false }
            }
            Leg::Seen if specular => Leg::Seen,
            Leg::Sent { mirrors, lit } if specular && self.depth < TOGETHER => {
                Leg::Sent { mirrors: mirrors + 1, lit }
            }
            Leg::Shared => Leg::Shared,
            _ => Leg::Own,
        };
    }

    /// Takes light that the path found by itself; over mirrors from a first point it is the bundle's to share out.
    fn come_upon(&mut self, light: Rgb, found: &mut Found, share: bool) {
        if let Leg::Sent { mirrors, lit } = &mut self.leg
            && share
            && *mirrors > 0
        {
            if !*lit && !light.is_black() {
                *lit = true;
                let (sample, direction, sampler) = (self.sample, self.sent, self.sampler);
                found.reuse.add_lucky(Lucky { sample, direction, sampler });
            }
            return;
        }
        found.add(self, self.throughput * light);
    }

    /// How much light counts that the path found by itself, where light sampling has density `light_pdf` for it.
    fn weight_of_found(&self, light_pdf: f32) -> f32 {
        match self.origin {
            Some(origin) if !origin.specular => mis::power(origin.pdf, light_pdf),
            _ => 1.0,
        }
    }
}
