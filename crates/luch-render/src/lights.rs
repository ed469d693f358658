//! Every emitter of a world, and how one is picked: about in proportion to the light it sends to the receiver.
//!
//! A receiver is a place and a normal. Bounded lights stand in a tree (`lights/tree.rs`) that weighs them by strength, distance and
//! the cosines at both ends; lights at infinity are weighed by the irradiance they would bring. Both are irradiances, so they
//! share the samples in that proportion; but neither kind gets less than an eighth, since one of them may be hidden from everywhere
//! (a sun outside a lit room). What can send nothing, because it faces away or lies below the horizon, is not picked.

mod bounds;
mod build;
mod candidate;
mod choice;
mod distant;
mod mesh;
mod node;
mod places;
mod tree;

use crate::emitter::{
    BallEmitter, DiscEmitter, Emitter, EmitterSample, EnvironmentEmitter, FlatLamp, PointEmitter,
    SpotEmitter, SunEmitter,
};
use crate::surface::SurfacePoint;
pub(crate) use bounds::LightBounds;
pub use candidate::Candidate;
pub(crate) use candidate::Shone;
use choice::{Choose, ChooseMany, Probability};
use distant::{DistantLight, DistantLights};
use glam::Vec3;
use luch_bvh::simd::dispatch;
use luch_image::Rgb;
use luch_scene::{Emission, Id, Light, Material, Scene, Shape, Sides};
use mesh::{MeshLamps, mesh_lamps};
use places::Places;
use tree::LightTree;

/// More are not sampled but only met by chance, which is as right and bounds the memory.
const MOST_EMITTERS: usize = 1 << 26;

/// All that shines in a world.
///
/// Emitters are numbered; flat lamps come first.
#[derive(Debug)]
pub struct Lights {
    flat: Vec<FlatLamp>,
    others: Vec<Emitter>,
    places: Places,
    tree: Option<LightTree>,
    distant: DistantLights,
    /// Emitters that are met by rays that meet nothing else.
    beyond: Vec<u32>,
    /// The emitter that is sampled, if it is the only one.
    only: Option<u32>,
}

/// Light that a ray found by itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundLight {
    /// What comes along the ray.
    pub radiance: Rgb,
    /// Density with which light sampling would have found it, per solid angle; 0 if it could not.
    pub pdf: f32,
}

/// A place that receives light, and the number that picks an emitter for it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Receiver {
    /// In the world.
    pub position: Vec3,
    /// Unit length, on the side that receives light; zero where light of all sides counts.
    pub normal: Vec3,
    /// Uniform in [0, 1), with more digits than an `f32` has.
    pub choice: f64,
}

/// An emitter picked for a receiver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChosenEmitter {
    /// Its number.
    pub emitter: u32,
    /// The chance with which it was picked; positive.
    pub probability: f32,
}

/// What of a scene an emitter belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum LightSource {
    /// The instance of this number shines.
    Instance(u32),
    /// The lamp without a surface of this number.
    Lamp(u32),
    /// What surrounds the scene.
    Environment,
}

impl Lights {
    /// Finds everything that shines.
    pub(crate) fn build(scene: &Scene) -> Self {
        let mut lights = Self {
            flat: Vec::new(),
            others: Vec::new(),
            places: Places::new(scene.instances.len()),
            tree: None,
            distant: DistantLights::default(),
            beyond: Vec::new(),
            only: None,
        };
        for instance in 0..scene.instances.len() as u32 {
            lights.add_mesh(scene, instance);
        }
        for instance in 0..scene.instances.len() as u32 {
            lights.add_round(scene, instance);
        }
        for light in &scene.lights {
            let emitter = match *light {
                Light::Point { position, intensity } => Emitter::Point(PointEmitter { position, intensity }),
                Light::Spot { position, direction, intensity, inner_angle, outer_angle } => {
                    Emitter::Spot(SpotEmitter::new(position, direction, intensity, inner_angle, outer_angle))
                }
                Light::Sun { direction, irradiance, angular_radius } => {
                    Emitter::Sun(Box::new(SunEmitter::new(direction, irradiance, angular_radius)))
                }
            };
            lights.push(emitter);
        }
        let environment = scene.environment.as_ref().and_then(|e| EnvironmentEmitter::new(scene, e));
        if let Some(environment) = environment {
            lights.push(Emitter::Environment(Box::new(environment)));
        }
        let bounds: Vec<Option<LightBounds>> = (lights.flat.iter().map(|lamp| Some(lamp.bounds())))
            .chain(lights.others.iter().map(|emitter| emitter.bounds(scene)))
            .collect();
        lights.tree = LightTree::new(&bounds);
        let mut sampled = (bounds.iter().enumerate())
            .filter_map(|(i, bounds)| bounds.filter(LightBounds::is_usable).map(|_| i as u32))
            .chain(lights.distant.0.iter().map(|light| light.emitter));
        lights.only = sampled.next().filter(|_| sampled.next().is_none());
        drop(sampled);
        lights
    }

    /// Adds an emitter that is no flat lamp, and returns its number.
    fn push(&mut self, emitter: Emitter) -> u32 {
        let place = (self.flat.len() + self.others.len()) as u32;
        let distant = match &emitter {
            Emitter::Sun(sun) => Some((sun.irradiance(), sun.direction(), sun.angle())),
            Emitter::Environment(environment) => Some((environment.irradiance(), Vec3::ZERO, [0.0, 1.0])),
            _ => None,
        };
        if let Some((irradiance, direction, angle)) = distant {
            self.beyond.push(place);
            if irradiance > 0.0 {
                let irradiance = irradiance.min(1e30);
                self.distant.0.push(DistantLight { emitter: place, irradiance, direction, angle });
            }
        }
        self.others.push(emitter);
        place
    }

    /// Adds the lamps of a mesh.
    fn add_mesh(&mut self, scene: &Scene, index: u32) {
        let instance = &scene.instances[index as usize];
        let Shape::Mesh(mesh) = &*scene.shapes[instance.shape.index()] else { return };
        if (0..instance.materials.len() as u16).all(|slot| emission_of(scene, index, slot).is_none()) {
            return;
        }
        let most = MOST_EMITTERS - self.flat.len();
        let emission = |slot| emission_of(scene, index, slot);
        let MeshLamps { lamps, places } = mesh_lamps(scene, mesh, index, most, emission);
        // Copies past the most lamps there may be take no memory.
        if lamps.is_empty() {
            return;
        }
        let first = self.flat.len() as u32;
        self.places.add(index, places.into_iter().map(|place| place.map(|place| first + place)));
        self.flat.extend(lamps);
    }

    /// Adds the lamp of a sphere or disc.
    fn add_round(&mut self, scene: &Scene, index: u32) {
        let instance = &scene.instances[index as usize];
        let Some((material, emission)) = emission_of(scene, index, 0) else { return };
        let placement = &instance.placement;
        let emitter = match &*scene.shapes[instance.shape.index()] {
            Shape::Sphere { radius } => {
                Emitter::Ball(Box::new(BallEmitter::new(*radius, placement, index, material, &emission)))
            }
            Shape::Disc { radius } => {
                Emitter::Disc(Box::new(DiscEmitter::new(*radius, placement, index, material, &emission)))
            }
            Shape::Mesh(_) | Shape::Plane | Shape::Traced(_) => return,
        };
        let place = self.push(emitter);
        self.places.add(index, [Some(place)]);
    }

    /// How many emitters there are.
    pub fn count(&self) -> usize {
        self.flat.len() + self.others.len()
    }

    /// The flat lamps: emitters 0 and up.
    pub fn flat_lamps(&self) -> &[FlatLamp] {
        &self.flat
    }

    /// The emitter that is sampled, if there is one only: it is picked for every receiver.
    pub fn only(&self) -> Option<u32> {
        self.only
    }

    /// The emitter that a primitive of an instance is.
    pub fn emitter_at(&self, instance: u32, primitive: u32) -> Option<u32> {
        self.places.get(instance, primitive)
    }

    /// What an emitter belongs to.
    ///
    /// # Panics
    /// If there is no emitter of this number.
    pub fn source(&self, emitter: u32) -> LightSource {
        let Some(other) = (emitter as usize).checked_sub(self.flat.len()) else {
            return LightSource::Instance(self.flat[emitter as usize].instance());
        };
        match &self.others[other] {
            Emitter::Ball(ball) => LightSource::Instance(ball.instance()),
            Emitter::Disc(disc) => LightSource::Instance(disc.instance()),
            Emitter::Environment(_) => LightSource::Environment,
            Emitter::Point(_) | Emitter::Spot(_) | Emitter::Sun(_) => {
                let is_round = |emitter: &&Emitter| matches!(emitter, Emitter::Ball(_) | Emitter::Disc(_));
                // Round lamps come before those without a surface.
                LightSource::Lamp((other - self.others.iter().take_while(is_round).count()) as u32)
            }
        }
    }

    /// Picks an emitter for a receiver; `None` if none can send it light.
    ///
    /// `normal` has unit length and is on the side that receives light, or is zero where light of all sides counts. `choice` is
    /// uniform in [0, 1) with more digits than an `f32` has: a glowing mesh may be a million emitters.
    #[inline]
    pub fn choose(&self, from: Vec3, normal: Vec3, choice: f64) -> Option<ChosenEmitter> {
        match self.only {
            Some(emitter) => Some(ChosenEmitter { emitter, probability: 1.0 }),
            None => dispatch(Choose { lights: self, receiver: Receiver { position: from, normal, choice } }),
        }
    }

    /// The same for many receivers at once, which is several times as fast for each where there are many lights.
    pub fn choose_many(&self, receivers: &[Receiver], chosen: &mut [Option<ChosenEmitter>]) {
        match self.only {
            Some(emitter) => chosen.fill(Some(ChosenEmitter { emitter, probability: 1.0 })),
            None => dispatch(ChooseMany { lights: self, receivers, chosen }),
        }
    }

    /// The chance with which [`Lights::choose`] picks an emitter for a receiver.
    #[inline]
    pub fn probability(&self, emitter: u32, from: Vec3, normal: Vec3) -> f32 {
        match self.only {
            Some(only) => f32::from(u8::from(only == emitter)),
            None => dispatch(Probability { lights: self, emitter, from, normal }),
        }
    }

    /// A direction toward an emitter.
    pub fn sample_emitter(
        &self,
        emitter: u32,
        scene: &Scene,
        from: Vec3,
        u: [f32; 2],
    ) -> Option<EmitterSample> {
        let emitter = emitter as usize;
        match emitter.checked_sub(self.flat.len()) {
            None => self.flat[emitter].sample(scene, from, u),
            Some(other) => self.others[other].sample(scene, from, u),
        }
    }

    /// Picks an emitter and a direction toward it; the density includes the choice. Arguments as of [`Lights::choose`].
    pub fn sample(
        &self,
        scene: &Scene,
        from: Vec3,
        normal: Vec3,
        choice: f64,
        u: [f32; 2],
    ) -> Option<EmitterSample> {
        let chosen = self.choose(from, normal, choice)?;
        let mut sample = self.sample_emitter(chosen.emitter, scene, from, u)?;
        sample.pdf *= chosen.probability;
        Some(sample)
    }

    /// Density with which `sample` draws the direction from a receiver to a point of a surface.
    pub fn pdf_of_hit(&self, from: Vec3, normal: Vec3, point: &SurfacePoint) -> f32 {
        let primitive = match point.place.shape {
            Shape::Mesh(_) => point.place.primitive as u32,
            _ => 0,
        };
        let Some(emitter) = self.emitter_at(point.hit.instance, primitive) else { return 0.0 };
        let pdf = match (emitter as usize).checked_sub(self.flat.len()) {
            None => self.flat[emitter as usize].pdf(from, point.position),
            Some(other) => self.others[other].pdf(from, point.position),
        };
        if pdf > 0.0 { pdf * self.probability(emitter, from, normal) } else { 0.0 }
    }

    /// The lights that a ray from a receiver into empty space finds. For rays from the camera any receiver will do.
    pub fn beyond(
        &self,
        scene: &Scene,
        from: Vec3,
        normal: Vec3,
        direction: Vec3,
    ) -> impl Iterator<Item = FoundLight> {
        self.beyond_with_emitter(scene, from, normal, direction).map(|(_, light)| light)
    }

    /// The same with the number of each emitter.
    pub(crate) fn beyond_with_emitter(
        &self,
        scene: &Scene,
        from: Vec3,
        normal: Vec3,
        direction: Vec3,
    ) -> impl Iterator<Item = (u32, FoundLight)> {
        self.beyond.iter().filter_map(move |&emitter| {
            let light = match &self.others[emitter as usize - self.flat.len()] {
                Emitter::Sun(sun) => sun.toward(direction)?,
                Emitter::Environment(environment) => environment.toward(scene, direction),
                _ => return None,
            };
            let chance = if light.pdf > 0.0 { self.probability(emitter, from, normal) } else { 0.0 };
            Some((emitter, FoundLight { radiance: light.radiance, pdf: light.pdf * chance }))
        })
    }
}

/// What a slot of an instance emits.
fn emission_of(scene: &Scene, instance: u32, slot: u16) -> Option<(Id<Material>, Emission)> {
    let id = scene.instances[instance as usize].material(slot)?;
    let material = &scene.materials[id.index()];
    let mut emission = material.emission?;
    // A back that is not there does not shine.
    emission.two_sided &= material.sides == Sides::Both;
    Some((id, emission))
}
