//! Light found over mirrors and glass, tried again by the whole bundle.
//!
//! A path that left its first point along ω, met only mirrors and glass, and then a lamp, was lucky: such caustics are found by
//! chance alone. Its neighbours would probably find the lamp along the same ω, with the same choices between reflection and
//! refraction. So they all try. With F(k) what path k finds and S those who find anything, path k receives
//!
//! ```text
//! F(k) · f(k) cos(k) / Σ over m in S of p(m)
//! ```
//!
//! which is the balance heuristic among techniques of density p(m) restricted to where they are lucky: whoever in S had sent its
//! own path along ω, the same would have been done. The mean stays what it was.

use super::points::LEAST_PART;
use super::scatterers::{Scattered, Scatterers};
use super::{LANES, Reuse};
use crate::material::{bsdf_at, emitted};
use crate::purpose;
use crate::surface::SurfacePoint;
use crate::world::World;
use glam::Vec3;
use luch_bvh::simd::{Task, dispatch};
use luch_bvh::{Coherence, InstanceHit, Ray};
use luch_image::Rgb;
use luch_sampling::Sampler;

/// A path that found light over mirrors.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lucky {
    pub(crate) sample: u32,
    /// The direction it left its first point in.
    pub(crate) direction: Vec3,
    /// Its random numbers, with which all decide alike.
    pub(crate) sampler: Sampler,
}

/// One neighbour's try.
#[derive(Clone, Copy)]
struct Try {
    ray: Ray,
    throughput: Rgb,
    found: Rgb,
    /// What the first point scatters of it, and with which density it sends paths there.
    value: Rgb,
    pdf: f32,
    lucky: u32,
    lane: u32,
    depth: u32,
    /// Whether it met a mirror yet.
    mirrored: bool,
}

impl Reuse {
    /// Lets every bundle try the directions of its lucky paths.
    pub(super) fn echo(&mut self, world: &World, max_depth: u32, radiance: &mut [Rgb]) {
        let lucky = std::mem::take(&mut self.lucky);
        let mut tries = Vec::with_capacity(lucky.len() * LANES);
        for (number, path) in lucky.iter().enumerate() {
            let (bundle, own) = self.places[path.sample as usize];
            let firsts = &self.bundles[bundle as usize].firsts;
            let depth = firsts.points.depth[own as usize];
            let scattered = dispatch(Sent { firsts, direction: path.direction });
            let pdf = |lane: usize| if firsts.connects(lane, depth) { scattered.pdf[lane] } else { 0.0 };
            let least = (0..LANES).map(pdf).fold(0.0, f32::max) * LEAST_PART;
            // Whose direction it was by a chance that is none for the others keeps it.
            let shared = pdf(own as usize) >= least;
            for lane in 0..LANES {
                let counts =
                    if shared { pdf(lane) > 0.0 && pdf(lane) >= least } else { lane == own as usize };
                if counts {
                    let [r, g, b] = scattered.value.map(|channel| channel[lane]);
                    tries.push(Try {
                        ray: Ray::new(firsts.start_toward(lane, path.direction), path.direction),
                        throughput: Rgb::WHITE,
                        found: Rgb::BLACK,
                        value: Rgb::new(r, g, b),
                        pdf: scattered.pdf[lane],
                        lucky: number as u32,
                        lane: lane as u32,
                        depth: depth + 1,
                        mirrored: false,
                    });
                }
            }
        }
        let mut walking: Vec<usize> = (0..tries.len()).collect();
        let (mut rays, mut hits) = (Vec::new(), Vec::new());
        while !walking.is_empty() {
            rays.clear();
            rays.extend(walking.iter().map(|&i| tries[i].ray));
            hits.clear();
            hits.resize(rays.len(), None);
            world.geometry.nearest_hits(&world.scene, &rays, &mut hits, Coherence::Coherent, |_| 0);
            let mut answers = hits.iter();
            walking.retain(|&i| {
                let hit = answers.next().copied().flatten();
                let path = &mut tries[i];
                path.step(world, hit, &lucky[path.lucky as usize].sampler, max_depth)
            });
        }
        for tries in tries.chunk_by(|a, b| a.lucky == b.lucky) {
            let sum: f32 = tries.iter().filter(|path| !path.found.is_black()).map(|path| path.pdf).sum();
            if sum <= 0.0 {
                continue;
            }
            let sample = lucky[tries[0].lucky as usize].sample;
            let bundle = &self.bundles[self.places[sample as usize].0 as usize];
            for path in tries {
                let share = path.found * path.value * (1.0 / sum);
                radiance[(bundle.start + path.lane) as usize] += bundle.gains[path.lane as usize] * share;
            }
        }
    }
}

/// What all first points scatter from one direction.
struct Sent<'a> {
    firsts: &'a Scatterers,
    direction: Vec3,
}

impl Task for Sent<'_> {
    type Output = Scattered;

    #[inline(always)]
    fn run(self) -> Scattered {
        let mut scattered = Scattered::default();
        let toward = self.direction.to_array().map(|axis| [axis; LANES]);
        self.firsts.evaluate(&toward, |k| self.firsts.points.is_set(k), &mut scattered);
        scattered
    }
}

impl Try {
    /// Takes what light there is and goes on over a mirror; false if that is the end.
    fn step(&mut self, world: &World, hit: Option<InstanceHit>, sampler: &Sampler, max_depth: u32) -> bool {
        let Some(hit) = hit else {
            if self.mirrored {
                for light in
                    world.lights.beyond(&world.scene, self.ray.origin, Vec3::ZERO, self.ray.direction)
                {
                    self.found += self.throughput * light.radiance;
                }
            }
            return false;
        };
        let point = SurfacePoint::new(&world.scene, &world.geometry, &self.ray, hit);
        if self.mirrored {
            self.found += self.throughput * emitted(&point);
        }
        if self.depth == max_depth {
            return false;
        }
        let bsdf = bsdf_at(world, &point, sampler, self.depth);
        let outgoing = point.frame.to_local(point.outgoing);
        let [u, v, lobe, _] = sampler.group(purpose::scatter(self.depth));
        let Some(scattered) = bsdf.sample(outgoing, [u, v], lobe).filter(|scattered| scattered.specular)
        else {
            return false;
        };
        let incoming = point.frame.to_world(scattered.incoming);
        let exit = point.exit();
        if !exit.is_honest(incoming) {
            return false;
        }
        self.throughput *= scattered.weight();
        self.ray = exit.ray_toward(incoming);
        self.depth += 1;
        self.mirrored = true;
        true
    }
}
