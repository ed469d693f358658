//! Every emitter of a world, and how one is picked: by power.

use crate::emitter::{
    BallEmitter, DiscEmitter, Emitter, EmitterSample, EnvironmentEmitter, PointEmitter, SpotEmitter,
    SunEmitter, TriangleEmitter,
};
use crate::surface::SurfacePoint;
use glam::{Mat3, Vec3};
use luch_bvh::Aabb;
use luch_image::Rgb;
use luch_sampling::Alias;
use luch_scene::{Light, Scene, Shape, Sides};
use std::collections::BTreeMap;

/// Marks a primitive that does not shine.
const DARK: u32 = u32::MAX;

/// More are not sampled but only met by chance, which is as right and bounds the memory.
const MOST_EMITTERS: usize = 1 << 26;

/// A power that can be a weight: what is not a number must not put out all other lights.
fn usable_power(power: f32) -> f32 {
    if power > 0.0 { power.min(1e30) } else { 0.0 }
}

/// All that shines in a world.
#[derive(Debug)]
pub struct Lights {
    emitters: Vec<Emitter>,
    /// Picks an emitter; `None` if there is none.
    choice: Option<Alias>,
    /// For each instance that shines, by primitive, the place of its emitter or [`DARK`].
    by_instance: BTreeMap<u32, Vec<u32>>,
    /// Emitters that are met by rays that meet nothing else.
    distant: Vec<u32>,
}

/// Light that a ray found by itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundLight {
    /// What comes along the ray.
    pub radiance: Rgb,
    /// Density with which light sampling would have found it, per solid angle; 0 if it could not.
    pub pdf: f32,
}

impl Lights {
    /// Finds everything that shines.
    pub(crate) fn build(scene: &Scene, bounds: Aabb) -> Self {
        let mut lights =
            Self { emitters: Vec::new(), choice: None, by_instance: BTreeMap::new(), distant: Vec::new() };
        for instance in 0..scene.instances.len() as u32 {
            lights.add_instance(scene, instance);
        }
        for light in &scene.lights {
            lights.emitters.push(match *light {
                Light::Point { position, intensity } => Emitter::Point(PointEmitter { position, intensity }),
                Light::Spot { position, direction, intensity, inner_angle, outer_angle } => {
                    Emitter::Spot(SpotEmitter::new(position, direction, intensity, inner_angle, outer_angle))
                }
                Light::Sun { direction, irradiance, angular_radius } => {
                    lights.distant.push(lights.emitters.len() as u32);
                    Emitter::Sun(SunEmitter::new(direction, irradiance, angular_radius))
                }
            });
        }
        let environment = scene.environment.as_ref().and_then(|e| EnvironmentEmitter::new(scene, e));
        if let Some(environment) = environment {
            lights.distant.push(lights.emitters.len() as u32);
            lights.emitters.push(Emitter::Environment(environment));
        }
        let radius = if bounds.is_empty() { 1.0 } else { (bounds.max - bounds.min).length() / 2.0 };
        // A scene of planes alone has no size of its own.
        let radius = if radius > 0.0 && radius.is_finite() { radius } else { 1.0 };
        let powers: Vec<f32> = lights.emitters.iter().map(|e| usable_power(e.power(scene, radius))).collect();
        lights.choice = Alias::new(&powers).ok();
        lights
    }

    /// Adds the emitters of an instance, one for each triangle that shines.
    fn add_instance(&mut self, scene: &Scene, index: u32) {
        let instance = &scene.instances[index as usize];
        let emission = |slot| {
            let id = instance.material(slot)?;
            let material = &scene.materials[id.index()];
            let mut emission = material.emission?;
            // A back that is not there does not shine.
            emission.two_sided &= material.sides == Sides::Both;
            Some((id, emission))
        };
        let placement = &instance.placement;
        match &scene.shapes[instance.shape.index()] {
            Shape::Mesh(mesh) => {
                if (0..instance.materials.len() as u16).all(|slot| emission(slot).is_none()) {
                    return;
                }
                let normal_map = Mat3::from(placement.matrix3).inverse().transpose();
                let mut places = vec![DARK; mesh.triangles.len()];
                for (triangle, place) in places.iter_mut().enumerate() {
                    let Some((material, emission)) = emission(mesh.slot(triangle)) else { continue };
                    let corners = mesh.corners(triangle).map(|corner| placement.transform_point3(corner));
                    let outward = normal_map * mesh.area_normal(triangle);
                    let emitter =
                        TriangleEmitter::new(corners, outward, index, triangle as u32, material, &emission);
                    if let Some(emitter) = emitter
                        && self.emitters.len() < MOST_EMITTERS
                    {
                        *place = self.emitters.len() as u32;
                        self.emitters.push(Emitter::Triangle(emitter));
                    }
                }
                self.by_instance.insert(index, places);
            }
            Shape::Sphere { radius } => {
                if let Some((material, emission)) = emission(0) {
                    self.by_instance.insert(index, vec![self.emitters.len() as u32]);
                    self.emitters.push(Emitter::Ball(BallEmitter::new(
                        *radius, placement, index, material, &emission,
                    )));
                }
            }
            Shape::Disc { radius } => {
                if let Some((material, emission)) = emission(0) {
                    self.by_instance.insert(index, vec![self.emitters.len() as u32]);
                    self.emitters.push(Emitter::Disc(DiscEmitter::new(
                        *radius, placement, index, material, &emission,
                    )));
                }
            }
            Shape::Plane => {}
        }
    }

    /// How many emitters there are.
    pub fn count(&self) -> usize {
        self.emitters.len()
    }

    /// Picks an emitter and a direction toward it; the density includes the choice.
    ///
    /// `choice` is uniform in [0, 1) with more digits than an `f32` has: a glowing mesh may be a million emitters.
    pub fn sample(&self, scene: &Scene, from: Vec3, choice: f64, u: [f32; 2]) -> Option<EmitterSample> {
        let picked = self.choice.as_ref()?.sample_f64(choice);
        let mut sample = self.emitters[picked.index].sample(scene, from, u)?;
        sample.pdf *= picked.probability;
        Some(sample)
    }

    /// Density with which `sample` draws the direction from `from` to a point of a surface.
    pub fn pdf_of_hit(&self, from: Vec3, point: &SurfacePoint) -> f32 {
        let primitive = match point.place.shape {
            Shape::Mesh(_) => point.place.primitive,
            _ => 0,
        };
        let place = self.by_instance.get(&point.hit.instance).and_then(|places| places.get(primitive));
        match (place, &self.choice) {
            (Some(&place), Some(choice)) if place != DARK => {
                choice.pmf(place as usize) * self.emitters[place as usize].pdf(from, point.position)
            }
            _ => 0.0,
        }
    }

    /// The lights that a ray into empty space finds.
    pub fn beyond(&self, scene: &Scene, direction: Vec3) -> impl Iterator<Item = FoundLight> {
        self.distant.iter().filter_map(move |&place| {
            let (radiance, pdf) = match &self.emitters[place as usize] {
                Emitter::Sun(sun) => sun.toward(direction)?,
                Emitter::Environment(environment) => {
                    (environment.radiance(scene, direction), environment.pdf(direction))
                }
                _ => return None,
            };
            let chance = self.choice.as_ref().map_or(0.0, |choice| choice.pmf(place as usize));
            Some(FoundLight { radiance, pdf: pdf * chance })
        })
    }
}
