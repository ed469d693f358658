//! One path told step by step: what it meets, what it asks of lamps, with which densities and weights.
//!
//! The path is the one that [`PathTracer`] takes without sharing between pixels; nothing is computed a second time but the densities
//! that are only told. So what it carries home is the very sample.

use super::PathTracer;
use crate::integrator::Integrator;
use crate::lights::LightSource;
use crate::material::bsdf_at;
use crate::purpose;
use crate::stop::{Stop, Stopped};
use crate::surface::SurfacePoint;
use crate::view::CameraSample;
use crate::wave::{Path, Wave};
use crate::world::World;
use glam::Vec3;
use luch_bvh::InstanceHit;
use luch_image::Rgb;
use luch_sampling::{hash, mis};
use luch_scene::{Id, Material};

/// A path with everything that happened on it.
#[derive(Clone, Debug, PartialEq)]
pub struct FollowedPath {
    /// What the camera sees along it: the sample, bit by bit.
    pub radiance: Rgb,
    /// From the camera on; the last may lie at infinity.
    pub vertices: Vec<PathVertex>,
    /// Why there are no more.
    pub end: PathEnd,
}

/// Why a path ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PathEnd {
    /// It left the scene.
    Escaped,
    /// It had scattered as often as it may.
    Depth,
    /// The surface swallowed it: no direction with light was drawn.
    Absorbed,
    /// Russian roulette.
    Roulette,
}

/// Where a path came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathVertex {
    /// What light that arrives here is multiplied with on its way to the camera.
    pub throughput: Rgb,
    /// The surface; `None` at infinity.
    pub surface: Option<MetSurface>,
    /// Light that the path came upon here by itself.
    pub found: Option<FoundOnPath>,
    /// The lamp that was asked from here.
    pub asked: Option<AskedLamp>,
    /// How it went on.
    pub departure: Option<Departure>,
}

/// A surface that a path met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetSurface {
    /// Number of the instance.
    pub instance: u32,
    /// Triangle of a mesh, 0 of other shapes.
    pub primitive: u32,
    /// What it is made of.
    pub material: Id<Material>,
    /// In the world, metres.
    pub position: Vec3,
    /// Unit shading normal, on the outside.
    pub normal: Vec3,
    /// Length of the ray that came here, metres.
    pub distance: f32,
    /// Whether the ray came from outside.
    pub is_front: bool,
}

/// Light that a path came upon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundOnPath {
    /// What it adds to the sample.
    pub contribution: Rgb,
    /// Density of the direction that led here by the BSDF, per solid angle; `None` from the camera and over mirrors.
    pub pdf_bsdf: Option<f32>,
    /// Density with which a lamp would have been asked in this direction, per solid angle; 0 if never.
    pub pdf_light: f32,
    /// The weight of this technique (power heuristic).
    pub weight: f32,
    /// Where the light is from; `None` if several things beyond the scene shine along the ray.
    pub source: Option<LightSource>,
}

/// A lamp that was asked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AskedLamp {
    /// What it adds to the sample; black if something stands in the way or nothing would be reflected.
    pub contribution: Rgb,
    /// What it would add if nothing stood in the way.
    pub unblocked: Rgb,
    /// Which.
    pub source: LightSource,
    /// Toward it, unit length.
    pub direction: Vec3,
    /// The point of the lamp; `None` at infinity.
    pub target: Option<Vec3>,
    /// Density of the direction by the choice of lamp, per solid angle; for lamps without extent the probability alone.
    pub pdf_light: f32,
    /// Density of the direction by the BSDF, per solid angle.
    pub pdf_bsdf: f32,
    /// The weight of this technique (power heuristic); 1 for lamps without extent.
    pub weight: f32,
}

/// How a path went on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Departure {
    /// Unit length.
    pub direction: Vec3,
    /// Density by the BSDF, per solid angle; of a mirror the probability of the lobe.
    pub pdf: f32,
    /// True if only this technique could have taken the direction.
    pub is_specular: bool,
    /// Throughput from here on, roulette included.
    pub throughput: Rgb,
}

impl PathTracer {
    /// Follows the path of a sample, taken for itself (without sharing between pixels).
    ///
    /// # Errors
    /// [`Stopped`] if `stop` came due.
    pub fn follow(&self, world: &World, sample: &CameraSample, stop: &Stop) -> Result<FollowedPath, Stopped> {
        let alone = Self { reuse: false, ..*self };
        let samples = std::slice::from_ref(sample);
        let mut total = [Rgb::BLACK];
        alone.radiance(world, samples, &mut total, stop)?;

        let mut vertices = Vec::new();
        let mut end = PathEnd::Escaped;
        let mut slot = [Rgb::BLACK];
        let mut wave = Wave::start(samples, &mut slot);
        let mut bounce = 0;
        while let Some(before) = wave.first().copied() {
            stop.check()?;
            wave.extend(world);
            let hit = wave.first_hit();
            slot = [Rgb::BLACK];
            alone.shade(world, &mut wave, bounce, false, &mut slot);
            let found = slot[0];
            let unblocked = wave.first_asked();
            slot = [Rgb::BLACK];
            wave.connect(world, bounce, &mut slot);
            let after = wave.first().copied();
            let point = hit.map(|hit| point_of(world, &before, hit));
            let departure = after.map(|path| path.departure());
            vertices.push(PathVertex {
                throughput: before.throughput,
                surface: point.as_ref().map(met_surface),
                found: (!found.is_black()).then(|| before.tell_found(world, point.as_ref(), found)),
                asked: (point.as_ref().filter(|_| bounce < self.max_depth))
                    .and_then(|point| tell_asked(world, &before, point, unblocked, slot[0])),
                departure,
            });
            if after.is_none() {
                end = match &point {
                    None => PathEnd::Escaped,
                    Some(_) if bounce >= self.max_depth => PathEnd::Depth,
                    Some(point) if is_absorbed(world, &before, point) => PathEnd::Absorbed,
                    Some(_) => PathEnd::Roulette,
                };
            }
            bounce += 1;
        }
        wave.end();
        Ok(FollowedPath { radiance: total[0], vertices, end })
    }
}

fn point_of<'w>(world: &'w World, path: &Path, hit: InstanceHit) -> SurfacePoint<'w> {
    let mut point = SurfacePoint::new(&world.scene, &world.geometry, &path.ray, hit);
    point.width = path.reading_cone().at(hit.hit.t);
    point
}

fn met_surface(point: &SurfacePoint) -> MetSurface {
    MetSurface {
        instance: point.hit.instance,
        primitive: point.place.primitive as u32,
        material: point.material,
        position: point.position,
        normal: point.frame.normal,
        distance: point.hit.hit.t,
        is_front: point.is_front(),
    }
}

/// Whether no direction that carries light was drawn.
fn is_absorbed(world: &World, path: &Path, point: &SurfacePoint) -> bool {
    let bsdf = bsdf_at(world, point, &path.sampler, path.depth);
    let [u, v, lobe, _] = path.sampler.group(purpose::scatter(path.depth));
    let drawn = bsdf.sample(point.frame.to_local(point.outgoing), [u, v], lobe);
    drawn.is_none_or(|drawn| {
        let incoming = point.frame.to_world(drawn.incoming);
        drawn.weight().is_black() || !point.exit().is_honest(incoming)
    })
}

/// The lamp that a path asked from a point.
fn tell_asked(
    world: &World,
    path: &Path,
    point: &SurfacePoint,
    unblocked: Rgb,
    contribution: Rgb,
) -> Option<AskedLamp> {
    let bsdf = bsdf_at(world, point, &path.sampler, path.depth);
    if bsdf.is_specular() {
        return None;
    }
    let normal = if bsdf.transmits() { Vec3::ZERO } else { point.exit().normal };
    let [choice, u, v, _] = path.sampler.group_words(purpose::light(path.depth));
    let choice = f64::from(choice) / 4_294_967_296.0;
    let chosen = world.lights.choose(point.position, normal, choice)?;
    let place = [u, v].map(hash::unit_f32);
    let light = world.lights.sample_emitter(chosen.emitter, &world.scene, point.position, place)?;
    let pdf_light = light.pdf * chosen.probability;
    let outgoing = point.frame.to_local(point.outgoing);
    let pdf_bsdf = bsdf.pdf(outgoing, point.frame.to_local(light.incoming));
    Some(AskedLamp {
        contribution,
        unblocked,
        source: world.lights.source(chosen.emitter),
        direction: light.incoming,
        target: light.target,
        pdf_light,
        pdf_bsdf,
        weight: if light.delta { 1.0 } else { mis::power(pdf_light, pdf_bsdf) },
    })
}

impl Path {
    fn departure(&self) -> Departure {
        let origin = self.origin.as_ref();
        Departure {
            direction: self.ray.direction,
            pdf: origin.map_or(0.0, |origin| origin.pdf),
            is_specular: origin.is_some_and(|origin| origin.specular),
            throughput: self.throughput,
        }
    }

    /// What the path came upon at `point`, or beyond the scene.
    fn tell_found(&self, world: &World, point: Option<&SurfacePoint>, contribution: Rgb) -> FoundOnPath {
        let (from, normal) = self.origin.map_or((Vec3::ZERO, Vec3::ZERO), |o| (o.position, o.normal));
        let (source, pdf_light) = match point {
            Some(point) => {
                let pdf = self.origin.map_or(0.0, |_| world.lights.pdf_of_hit(from, normal, point));
                (Some(LightSource::Instance(point.hit.instance)), pdf)
            }
            None => {
                let lit = world.lights.beyond_with_emitter(&world.scene, from, normal, self.ray.direction);
                let mut lit = lit.filter(|(_, light)| !light.radiance.is_black());
                match (lit.next(), lit.next()) {
                    (Some((emitter, light)), None) => (Some(world.lights.source(emitter)), light.pdf),
                    _ => (None, 0.0),
                }
            }
        };
        FoundOnPath {
            contribution,
            pdf_bsdf: self.origin.filter(|origin| !origin.specular).map(|origin| origin.pdf),
            pdf_light,
            weight: self.weight_of_found(pdf_light),
            source,
        }
    }
}
