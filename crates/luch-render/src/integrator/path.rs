//! Path tracing with light sampling and multiple importance sampling (Veach 1997), one bounce of a whole wave at a time.

mod follow;
mod lanes;

pub use follow::{AskedLamp, Departure, FollowedPath, FoundOnPath, MetSurface, PathEnd, PathVertex};

use super::Integrator;
use crate::cone::Cone;
use crate::material::{bsdf_at, emitted};
use crate::purpose;
use crate::reuse::{Lit, Lucky, Scatterer, Standpoint};
use crate::roulette::survive;
use crate::stop::{Stop, Stopped};
use crate::surface::{SurfacePoint, segment_before};
use crate::view::CameraSample;
use crate::wave::{Arrival, Found, Leg, Origin, Path, Wave};
use crate::world::World;
use glam::Vec3;
use luch_bvh::Ray;
use luch_bvh::simd::dispatch;
use luch_image::Rgb;
use luch_sampling::{hash, mis};

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
            self.shade(world, &mut wave, bounce, share, radiance);
            wave.connect(world, bounce, radiance);
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
        let pdf = light.pdf * path.partners(found);
        path.come_upon(light.radiance, pdf, found, share);
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
        let is_first = share && path.may_be_first();
        if is_first {
            let (depth, throughput) = (path.depth, path.throughput);
            found.reuse.set_first_diffuse(path.sample, &departures.exit(lane), depth, throughput, albedo);
            path.sampler = path.together;
        } else if path.may_be_second() {
            found.reuse.set_second(path.sample, &departures.exit(lane), path.depth);
            path.hand_over();
        }
        let (position, normal, near) =
            (departures.position(lane), departures.normal(lane), departures.near(lane));
        let together = is_first && world.lights.is_shareable();
        if together {
            found.standpoints.push(Standpoint { sample: path.sample, sampler: path.together });
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
            path.leave(departures.direction(lane), false, if is_first { Turn::First } else { Turn::Other });
            path.throughput *= albedo * factor;
            path.origin =
                Some(Origin { position, normal, together, pdf: departures.pdf(lane), specular: false });
            path.ray = Ray::new(near, departures.direction(lane));
            path.cone = Cone::SCATTERED;
            path.depth += 1;
            alive[arrival.path] = true;
        }
    }
}

impl PathTracer {
    /// Lets every path of a wave deal with what it met.
    fn shade(&self, world: &World, wave: &mut Wave, bounce: u32, share: bool, radiance: &mut [Rgb]) {
        wave.shade(
            world,
            radiance,
            |path, hit, found| match hit {
                None => {
                    escape(world, path, found, share);
                    false
                }
                Some(hit) => {
                    let mut point = SurfacePoint::new(&world.scene, &world.geometry, &path.ray, hit);
                    point.width = path.reading_cone().at(hit.hit.t);
                    self.arrive(world, path, &point, found, share)
                }
            },
            |paths, arrivals, found, alive| {
                if bounce < self.max_depth {
                    arrive_plain(world, paths, arrivals, found, alive, share);
                }
            },
        );
    }

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
            path.meet_lamp(world, light, point, found, share);
        }
        if path.depth == self.max_depth {
            return false;
        }
        let bsdf = bsdf_at(world, point, &path.sampler, path.depth);
        let outgoing = point.frame.to_local(point.outgoing);
        let exit = point.exit();
        // Light is sampled for the pixel alone, directions for the whole bundle.
        let own = path.sampler;
        let scatterer = Scatterer { exit, frame: point.frame, bsdf, toward_viewer: point.outgoing };
        let turn = if share { path.turn(&scatterer, point.is_seen_alike(), found) } else { Turn::Other };
        let together = matches!(turn, Turn::First | Turn::Lit) && world.lights.is_shareable();
        let receiving = if bsdf.transmits() { Vec3::ZERO } else { exit.normal };

        // Light sampled from here.
        if together {
            found.standpoints.push(Standpoint { sample: path.sample, sampler: path.together });
        } else if !bsdf.is_specular() {
            let [choice, u, v, _] = own.group_words(purpose::light(path.depth));
            let choice = f64::from(choice) / 4_294_967_296.0;
            let [u, v] = [u, v].map(hash::unit_f32);
            if let Some(light) = world.lights.sample(&world.scene, point.position, receiving, choice, [u, v])
                && exit.is_honest(light.incoming)
            {
                let ray = light.target.map_or_else(|| exit.ray_toward(light.incoming), |to| exit.ray_to(to));
                if turn == Turn::Glint {
                    let (direction, pdf, delta) = (light.incoming, light.pdf, light.delta);
                    let light = light.radiance * (1.0 / pdf);
                    found.ask_for_glint(path, ray, Lit { direction, light, pdf, delta, is_free: false });
                } else {
                    let scattered = bsdf.evaluate(outgoing, point.frame.to_local(light.incoming));
                    let weight = if light.delta { 1.0 } else { mis::power(light.pdf, scattered.pdf) };
                    let carried = path.throughput * scattered.value * light.radiance * (weight / light.pdf);
                    if !carried.is_black() {
                        found.ask(path, ray, carried);
                    }
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
        let mut factor = 1.0;
        if !(turn == Turn::First || (sure && scattered.specular)) {
            let carried = path.throughput * path.carried / path.radiance_scale;
            let Some(survived) = survive(path.depth, carried, chance) else {
                return false;
            };
            factor = survived;
        }
        path.throughput *= factor;
        if turn == Turn::Glint {
            found.reuse.set_way(path.sample, incoming);
            path.throughput = Rgb::WHITE * factor;
        }
        path.leave(incoming, scattered.specular, turn);
        path.origin = Some(Origin {
            position: point.position,
            normal: receiving,
            together: together && !scattered.specular,
            pdf: scattered.pdf,
            specular: scattered.specular,
        });
        path.ray = exit.ray_toward(incoming);
        path.cone = if scattered.specular { path.cone.passed_on(point.hit.hit.t) } else { Cone::SCATTERED };
        path.depth += 1;
        true
    }
}

/// What a surface is to the bundle of a path that meets it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Turn {
    /// The first point, where others are connected from.
    First,
    /// The first point, but only its direct light is everybody's.
    Lit,
    /// A second point that sends everyone something else.
    Glint,
    Other,
}

impl Path {
    /// Whether a surface here that is no mirror would be the path's first.
    fn may_be_first(&self) -> bool {
        self.leg == Leg::Seen && self.depth < TOGETHER
    }

    /// Whether it would be the second.
    fn may_be_second(&self) -> bool {
        matches!(self.leg, Leg::Sent { mirrors: 0, .. })
    }

    /// How many paths sampled direct light together where this one comes from.
    fn partners(&self, found: &Found) -> f32 {
        match self.origin {
            Some(origin) if origin.together => found.reuse.partners(self.sample),
            _ => 1.0,
        }
    }

    /// Lets the bundle know of a surface. The first that is no mirror is where others are connected from, the second is where
    /// they are connected to: what the path finds from then on belongs to all.
    fn turn(&mut self, scatterer: &Scatterer, is_seen_alike: bool, found: &mut Found) -> Turn {
        if scatterer.bsdf.is_specular() {
            return Turn::Other;
        }
        if self.may_be_first() {
            found.reuse.set_first(self.sample, scatterer, self.depth, self.throughput);
            if !scatterer.is_simple() {
                return Turn::Lit;
            }
            self.sampler = self.together;
            Turn::First
        } else if self.may_be_second() && is_seen_alike && scatterer.is_simple() {
            let optics = scatterer.optics();
            match optics {
                None => found.reuse.set_second(self.sample, &scatterer.exit, self.depth),
                Some(optics) => found.reuse.set_glint(self.sample, &scatterer.exit, optics, self.depth),
            }
            self.hand_over();
            if optics.is_none() { Turn::Other } else { Turn::Glint }
        } else {
            Turn::Other
        }
    }

    /// From here on what the path finds belongs to all, so it is counted from here.
    fn hand_over(&mut self) {
        self.carried = self.throughput;
        self.throughput = Rgb::WHITE;
        self.leg = Leg::Shared;
    }

    /// Notes that the path goes on, after a first point or over a mirror or otherwise.
    fn leave(&mut self, direction: Vec3, specular: bool, turn: Turn) {
        self.leg = match self.leg {
            Leg::Seen if turn == Turn::First => {
                self.sent = direction;
                Leg::Sent { mirrors: 0, lit: false }
            }
            Leg::Seen if turn == Turn::Other && specular => Leg::Seen,
            Leg::Sent { mirrors, lit } if specular && self.depth < TOGETHER => {
                Leg::Sent { mirrors: mirrors + 1, lit }
            }
            Leg::Shared | Leg::Glanced => match turn {
                Turn::Glint => Leg::Glanced,
                _ => Leg::Shared,
            },
            _ => Leg::Own,
        };
    }

    /// Meets a surface that shines.
    fn meet_lamp(&mut self, world: &World, light: Rgb, point: &SurfacePoint, found: &mut Found, share: bool) {
        match self.origin {
            Some(origin) if origin.together => {
                let light = light * found.reuse.weight_of_lamp(world, self.sample, point);
                if self.may_be_second() && point.is_seen_alike() {
                    found.reuse.set_second(self.sample, &point.exit(), self.depth);
                    found.reuse.add(self.sample, light);
                } else {
                    found.add(self, self.throughput * light);
                }
            }
            Some(origin) => {
                let pdf = world.lights.pdf_of_hit(origin.position, origin.normal, point);
                self.come_upon(light, pdf, found, share);
            }
            None => self.come_upon(light, 0.0, found, share),
        }
    }

    /// Takes light that the path found by itself, where light sampling has density `light_pdf` for it; over mirrors from a first
    /// point it is the bundle's to share out.
    fn come_upon(&mut self, light: Rgb, light_pdf: f32, found: &mut Found, share: bool) {
        match &mut self.leg {
            Leg::Sent { mirrors, lit } if share && *mirrors > 0 => {
                if !*lit && !light.is_black() {
                    *lit = true;
                    let (sample, direction, sampler) = (self.sample, self.sent, self.sampler);
                    found.reuse.add_lucky(Lucky { sample, direction, sampler });
                }
            }
            Leg::Glanced => found.reuse.meet(self.sample, self.throughput * light, light_pdf),
            _ => found.add(self, self.throughput * light * self.weight_of_found(light_pdf)),
        }
    }

    /// How much light counts that the path found by itself, where light sampling has density `light_pdf` for it.
    fn weight_of_found(&self, light_pdf: f32) -> f32 {
        match self.origin {
            Some(origin) if !origin.specular => mis::power(origin.pdf, light_pdf),
            _ => 1.0,
        }
    }
}
