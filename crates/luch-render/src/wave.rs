//! Some thousand paths on their way together: extend, shade, connect, compact.
//!
//! Rays of a wave are traced as batches, which is what the hardware wants. Who travels beside whom never changes what a path computes:
//! each keeps its own numbers, and its sums are added in the order of its own bounces.

use crate::cone::Cone;
use crate::plain::PlainHit;
use crate::reuse::{Lit, Reuse, Standpoint};
use crate::view::CameraSample;
use crate::world::World;
use crate::{opacity_key, purpose};
use glam::Vec3;
use luch_bvh::{Coherence, InstanceHit, Ray};
use luch_image::Rgb;
use luch_sampling::Sampler;
use std::cell::Cell;

/// A path on its way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Path {
    /// Where it is going.
    pub(crate) ray: Ray,
    /// How finely it reads textures.
    pub(crate) cone: Cone,
    /// The random numbers of its sample.
    pub(crate) sampler: Sampler,
    /// The numbers to go on with where its bundle works together.
    pub(crate) together: Sampler,
    /// What light at its end is multiplied with.
    pub(crate) throughput: Rgb,
    /// The part of the throughput that is only radiance scaled by refraction.
    pub(crate) radiance_scale: f32,
    /// Scatterings so far.
    pub(crate) depth: u32,
    /// How far it is in the part that its bundle takes together.
    pub(crate) leg: Leg,
    /// The direction it left its first point in.
    pub(crate) sent: Vec3,
    /// What the throughput was before it was set back to one for the others.
    pub(crate) carried: Rgb,
    /// Where it scattered last; `None` if it comes from the camera.
    pub(crate) origin: Option<Origin>,
    /// Its place in the batch.
    pub(crate) sample: u32,
}

/// Parts of a path, by what others have to do with them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Leg {
    /// From the camera over mirrors and glass: the pixel's own.
    Seen,
    /// From the first point that is no mirror on, over so many mirrors and glass surfaces.
    Sent {
        /// Whether it met light there; the bundle takes care of that.
        mirrors: u32,
        lit: bool,
    },
    /// Just left a second point that is not diffuse: how much light counts that it meets next, all have a say in.
    Glanced,
    /// Past a second point: what it finds belongs to all.
    Shared,
    /// Nobody else's business.
    Own,
}

/// Where and how a path scattered.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Origin {
    pub(crate) position: Vec3,
    /// On the side that receives light; zero where light of all sides counts.
    pub(crate) normal: Vec3,
    /// Whether direct light was sampled by the whole bundle there.
    pub(crate) together: bool,
    /// Density of the direction taken, per solid angle.
    pub(crate) pdf: f32,
    /// True if no other strategy could have taken it.
    pub(crate) specular: bool,
}

/// A path at a plain surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arrival {
    /// Its place in the wave.
    pub(crate) path: usize,
    pub(crate) hit: InstanceHit,
    pub(crate) triangle: PlainHit,
}

/// Rays to lights, and what they carry if nothing stands in the way.
#[derive(Debug, Default)]
pub(crate) struct Shadows {
    rays: Vec<Ray>,
    carried: Vec<Carried>,
}

#[derive(Clone, Copy, Debug)]
struct Carried {
    light: Rgb,
    sample: u32,
    to: To,
    sampler: Sampler,
    depth: u32,
}

/// Whose light it is.
#[derive(Clone, Copy, Debug)]
enum To {
    /// The pixel's.
    Pixel,
    /// All of the bundle's.
    Bundle,
    /// All of the bundle's, by the direction it comes from.
    Glint,
}

/// Where light goes that paths find.
pub(crate) struct Found<'a> {
    /// Points whose direct light the bundle samples together.
    pub(crate) standpoints: &'a mut Vec<Standpoint>,
    radiance: &'a mut [Rgb],
    shadows: &'a mut Shadows,
    pub(crate) reuse: &'a mut Reuse,
}

impl Found<'_> {
    /// Light that the path came upon.
    pub(crate) fn add(&mut self, path: &Path, light: Rgb) {
        if path.is_shared() {
            self.reuse.add(path.sample, light);
        } else {
            self.radiance[path.sample as usize] += light;
        }
    }

    /// Light that comes along `ray`, if that is free.
    pub(crate) fn ask(&mut self, path: &Path, ray: Ray, light: Rgb) {
        let to = if path.is_shared() { To::Bundle } else { To::Pixel };
        self.ask_for(path, ray, light, to);
    }

    /// Light that comes to a glint along `ray`, if that is free.
    pub(crate) fn ask_for_glint(&mut self, path: &Path, ray: Ray, lit: Lit) {
        self.reuse.set_lit(path.sample, lit);
        self.ask_for(path, ray, lit.light, To::Glint);
    }

    fn ask_for(&mut self, path: &Path, ray: Ray, light: Rgb, to: To) {
        let Path { sample, sampler, depth, .. } = *path;
        self.shadows.rays.push(ray);
        self.shadows.carried.push(Carried { light, sample, to, sampler, depth });
    }
}

impl Path {
    /// How finely it reads textures where it arrives. Past a first point others look at the same places, or walk over the same
    /// mirrors: they must see the same there, so it is read as it is.
    pub(crate) fn reading_cone(&self) -> Cone {
        if matches!(self.leg, Leg::Sent { .. }) { Cone { width: 0.0, spread: 0.0 } } else { self.cone }
    }

    /// Whether what it finds belongs to all.
    fn is_shared(&self) -> bool {
        matches!(self.leg, Leg::Shared | Leg::Glanced)
    }
}

thread_local! {
    /// The memory of this thread's last wave: fresh memory would have to be cleared by the system, page by page.
    static SPARE: Cell<Option<Wave>> = const { Cell::new(None) };
}

/// Paths that take their bounces together.
#[derive(Debug, Default)]
pub(crate) struct Wave {
    paths: Vec<Path>,
    rays: Vec<Ray>,
    hits: Vec<Option<InstanceHit>>,
    shadows: Shadows,
    occluded: Vec<bool>,
    arrivals: Vec<Arrival>,
    alive: Vec<bool>,
    standpoints: Vec<Standpoint>,
    /// By sample.
    samplers: Vec<Sampler>,
    pub(crate) reuse: Reuse,
}

/// Paths that are shaded side by side.
pub(crate) const SIDE_BY_SIDE: usize = 16;

impl Wave {
    /// One path for each camera sample, whose radiance is set to nothing.
    pub(crate) fn start(samples: &[CameraSample], radiance: &mut [Rgb]) -> Self {
        radiance.fill(Rgb::BLACK);
        let path = |(i, sample): (usize, &CameraSample)| Path {
            ray: sample.ray,
            cone: sample.cone,
            sampler: sample.sampler,
            together: sample.together,
            throughput: Rgb::WHITE,
            radiance_scale: 1.0,
            depth: 0,
            leg: Leg::Seen,
            sent: Vec3::ZERO,
            carried: Rgb::WHITE,
            origin: None,
            sample: i as u32,
        };
        let mut wave = SPARE.take().unwrap_or_default();
        wave.paths.clear();
        wave.paths.extend(samples.iter().enumerate().map(path));
        wave.hits.clear();
        wave.hits.resize(samples.len(), None);
        wave.samplers.clear();
        wave.samplers.extend(samples.iter().map(|sample| sample.sampler));
        wave.shadows.rays.clear();
        wave.shadows.carried.clear();
        wave.standpoints.clear();
        wave.reuse.start(samples.iter().map(|sample| sample.bundle));
        wave
    }

    /// Leaves the memory to the thread's next wave.
    pub(crate) fn end(self) {
        SPARE.set(Some(self));
    }

    /// True if every path has ended.
    pub(crate) fn is_empty(&self) -> bool {
        self.paths.is_empty()
    }

    /// The first path.
    pub(crate) fn first(&self) -> Option<&Path> {
        self.paths.first()
    }

    /// What it met.
    pub(crate) fn first_hit(&self) -> Option<InstanceHit> {
        self.hits.first().copied().flatten()
    }

    /// The light of the first ray to a lamp that waits to be traced; black if there is none.
    pub(crate) fn first_asked(&self) -> Rgb {
        self.shadows.carried.first().map_or(Rgb::BLACK, |carried| carried.light)
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

    /// Lets every path deal with what it met and keeps those that go on.
    ///
    /// `single` deals with one path, `plain` with up to sixteen that met plain surfaces; both tell who goes on.
    pub(crate) fn shade(
        &mut self,
        world: &World,
        radiance: &mut [Rgb],
        mut single: impl FnMut(&mut Path, Option<InstanceHit>, &mut Found) -> bool,
        mut plain: impl FnMut(&mut [Path], &[Arrival], &mut Found, &mut [bool]),
    ) {
        let Self { paths, hits, shadows, reuse, arrivals, alive, standpoints, .. } = self;
        let mut found = Found { standpoints, radiance, shadows, reuse };
        arrivals.clear();
        alive.clear();
        for (i, (path, hit)) in paths.iter_mut().zip(&*hits).enumerate() {
            let plain = |hit| Some((hit, world.plain.hit(world, hit, &path.ray, path.reading_cone())?));
            let triangle = hit.as_ref().and_then(plain);
            alive.push(match triangle {
                None => single(path, *hit, &mut found),
                Some((hit, triangle)) => {
                    arrivals.push(Arrival { path: i, hit: *hit, triangle });
                    false
                }
            });
        }
        for arrivals in arrivals.chunks(SIDE_BY_SIDE) {
            plain(paths, arrivals, &mut found, alive);
        }
        let mut kept = 0;
        for i in 0..paths.len() {
            if alive[i] {
                paths[kept] = paths[i];
                kept += 1;
            }
        }
        paths.truncate(kept);
    }

    /// Adds the light of every shadow ray that is free.
    ///
    /// The paths had scattered `depth` times before this bounce.
    pub(crate) fn connect(&mut self, world: &World, depth: u32, radiance: &mut [Rgb]) {
        let Shadows { rays, carried } = &mut self.shadows;
        let paths = &self.samplers;
        self.reuse.light(world, depth, &mut self.standpoints, |sample, ray, light| {
            rays.push(ray);
            let sampler = paths[sample as usize];
            carried.push(Carried { light, sample, to: To::Pixel, sampler, depth: 0 });
        });
        self.standpoints.clear();
        self.occluded.clear();
        self.occluded.resize(rays.len(), false);
        let key = |i: usize| opacity_key(&carried[i].sampler, purpose::light_opacity(carried[i].depth));
        world.geometry.occluded(&world.scene, rays, &mut self.occluded, Coherence::Incoherent, key);
        for (carried, occluded) in carried.iter().zip(&self.occluded) {
            if !occluded {
                match carried.to {
                    To::Pixel => radiance[carried.sample as usize] += carried.light,
                    To::Bundle => self.reuse.add(carried.sample, carried.light),
                    To::Glint => self.reuse.set_free(carried.sample),
                }
            }
        }
        rays.clear();
        carried.clear();
    }
}
