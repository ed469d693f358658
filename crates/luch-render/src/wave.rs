//! Some thousand paths on their way together: extend, shade, connect, compact.
//!
//! Rays of a wave are traced as batches, which is what the hardware wants. Who travels beside whom never changes what a path computes:
//! each keeps its own numbers, and its sums are added in the order of its own bounces.

use crate::view::CameraSample;
use crate::world::World;
use crate::{opacity_key, purpose};
use glam::Vec3;
use luch_bvh::{Coherence, InstanceHit, Ray};
use luch_image::Rgb;
use luch_sampling::Sampler;

/// A path on its way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Path {
    /// Where it is going.
    pub(crate) ray: Ray,
    /// The random numbers of its sample.
    pub(crate) sampler: Sampler,
    /// What light at its end is multiplied with.
    pub(crate) throughput: Rgb,
    /// The part of the throughput that is only radiance scaled by refraction.
    pub(crate) radiance_scale: f32,
    /// Light gathered so far and not yet handed over.
    pub(crate) radiance: Rgb,
    /// Scatterings so far.
    pub(crate) depth: u32,
    /// Where it scattered last; `None` if it comes from the camera.
    pub(crate) origin: Option<Origin>,
    /// Its place in the batch.
    sample: u32,
}

/// Where and how a path scattered.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Origin {
    pub(crate) position: Vec3,
    /// Density of the direction taken, per solid angle.
    pub(crate) pdf: f32,
    /// True if no other strategy could have taken it.
    pub(crate) specular: bool,
}

/// Rays to lights, and what they carry if nothing stands in the way.
#[derive(Debug, Default)]
pub(crate) struct Shadows {
    rays: Vec<Ray>,
    carried: Vec<Carried>,
    current: Option<(u32, Sampler, u32)>,
}

#[derive(Clone, Copy, Debug)]
struct Carried {
    light: Rgb,
    sample: u32,
    sampler: Sampler,
    depth: u32,
}

impl Shadows {
    /// Asks whether `ray` is free, for the path that is being shaded.
    pub(crate) fn push(&mut self, ray: Ray, light: Rgb) {
        if let Some((sample, sampler, depth)) = self.current {
            self.rays.push(ray);
            self.carried.push(Carried { light, sample, sampler, depth });
        }
    }
}

/// Paths that take their bounces together.
#[derive(Debug)]
pub(crate) struct Wave {
    paths: Vec<Path>,
    rays: Vec<Ray>,
    hits: Vec<Option<InstanceHit>>,
    shadows: Shadows,
    occluded: Vec<bool>,
}

impl Wave {
    /// One path for each camera sample.
    pub(crate) fn start(samples: &[CameraSample]) -> Self {
        let path = |(i, sample): (usize, &CameraSample)| Path {
            ray: sample.ray,
            sampler: sample.sampler,
            throughput: Rgb::WHITE,
            radiance_scale: 1.0,
            radiance: Rgb::BLACK,
            depth: 0,
            origin: None,
            sample: i as u32,
        };
        let paths: Vec<Path> = samples.iter().enumerate().map(path).collect();
        let count = paths.len();
        Self {
            paths,
            rays: Vec::with_capacity(count),
            hits: vec![None; count],
            shadows: Shadows::default(),
            occluded: Vec::new(),
        }
    }

    /// True if every path has ended.
    pub(crate) fn is_empty(&self) -> bool {
        self.paths.is_empty()
    }

    /// Finds what every path meets next.
    pub(crate) fn extend(&mut self, world: &World) {
        self.rays.clear();
        self.rays.extend(self.paths.iter().map(|path| path.ray));
        let coherence = match self.paths.first() {
            Some(path) if path.depth == 0 => Coherence::Coherent,
            _ => Coherence::Incoherent,
        };
        let paths = &self.paths;
        let key = |i: usize| opacity_key(&paths[i].sampler, purpose::opacity(paths[i].depth));
        let hits = &mut self.hits[..paths.len()];
        world.geometry.nearest_hits(&world.scene, &self.rays, hits, coherence, key);
    }

    /// Lets every path deal with what it met, hands over the light it gathered, and keeps those that go on.
    ///
    /// `radiance` receives by sample; the first light of a sample replaces what was there.
    pub(crate) fn shade(
        &mut self,
        radiance: &mut [Rgb],
        mut go_on: impl FnMut(&mut Path, Option<InstanceHit>, &mut Shadows) -> bool,
    ) {
        let mut kept = 0;
        for i in 0..self.paths.len() {
            let mut path = self.paths[i];
            self.shadows.current = Some((path.sample, path.sampler, path.depth));
            let first = path.origin.is_none();
            let alive = go_on(&mut path, self.hits[i], &mut self.shadows);
            let sum = &mut radiance[path.sample as usize];
            *sum = if first { path.radiance } else { *sum + path.radiance };
            path.radiance = Rgb::BLACK;
            if alive {
                self.paths[kept] = path;
                kept += 1;
            }
        }
        self.paths.truncate(kept);
    }

    /// Adds the light of every shadow ray that is free.
    pub(crate) fn connect(&mut self, world: &World, radiance: &mut [Rgb]) {
        let Shadows { rays, carried, .. } = &mut self.shadows;
        self.occluded.clear();
        self.occluded.resize(rays.len(), false);
        let key = |i: usize| opacity_key(&carried[i].sampler, purpose::light_opacity(carried[i].depth));
        world.geometry.occluded(&world.scene, rays, &mut self.occluded, Coherence::Incoherent, key);
        for (carried, occluded) in carried.iter().zip(&self.occluded) {
            if !occluded {
                radiance[carried.sample as usize] += carried.light;
            }
        }
        rays.clear();
        carried.clear();
    }
}
