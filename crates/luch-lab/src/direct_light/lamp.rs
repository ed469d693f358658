//! One lamp of a scene and samples of it.

use super::sky::{self, Beyond};
use super::{DIMENSIONS, LampKind};
use crate::integral::Points;
use glam::{Affine3A, Vec3};
use luch_bvh::Ray;
use luch_render::{EmitterSample, SurfacePoint, World, emitted};
use luch_sampling::{Frame, hash, warp};
use luch_scene::{Camera, Light, Scene, Shape};
use std::f64::consts::PI;

/// The place that receives light.
pub(super) struct Receiver<'a> {
    pub(super) world: &'a World,
    /// Clear of the surface that the point lies on, if it lies on one.
    pub(super) at: Vec3,
    pub(super) normal: Vec3,
    /// Lengths below this are rounding.
    slack: f32,
}

/// What one sample, or the mean of many, found.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sample {
    /// 1 if the place of the lamp is seen.
    pub(super) seen: f64,
    /// Irradiance.
    pub(super) light: [f64; 3],
}

/// A lamp.
pub(super) struct Lamp {
    pub(super) name: String,
    what: What,
}

enum What {
    Surface {
        instance: u32,
        form: Form,
        area: f64,
    },
    /// Found by rays alone.
    Unknown {
        instance: u32,
    },
    /// A world with this light alone.
    Light {
        alone: Box<World>,
        is_sun: bool,
    },
    Sky {
        alone: Box<World>,
    },
}

enum Form {
    /// Corners in the world, and the sums of the areas up to each.
    Triangles {
        corners: Vec<[Vec3; 3]>,
        sums: Vec<f64>,
    },
    Sphere {
        radius: f32,
        placement: Affine3A,
    },
    Disc {
        radius: f32,
        placement: Affine3A,
    },
}

/// A world of nothing but what has no surface.
fn alone(scene: &Scene, change: impl FnOnce(&mut Scene)) -> Option<Box<World>> {
    let mut bare = Scene { images: scene.images.clone(), settings: scene.settings, ..Scene::default() };
    bare.add_camera(Camera::looking_at(Vec3::ZERO, Vec3::X, Vec3::Y, 1.0));
    change(&mut bare);
    World::build(bare).ok().map(Box::new)
}

impl Lamp {
    /// All lamps of a scene: surfaces, lights, the sky.
    pub(super) fn of_scene(scene: &Scene) -> Vec<Self> {
        let mut all = Vec::new();
        for (index, instance) in scene.instances.iter().enumerate() {
            let shines = |slot: u16| {
                let material = instance.material(slot).map(|id| &scene.materials[id.index()]);
                material.is_some_and(|material| material.emission.is_some())
            };
            let placement = instance.placement;
            let scale = Vec3::from(placement.matrix3.x_axis).length();
            let index = index as u32;
            let what = match &*scene.shapes[instance.shape.index()] {
                Shape::Mesh(mesh) => {
                    let mut corners = Vec::new();
                    let (mut sums, mut area) = (Vec::new(), 0.0);
                    let glowing = (0..mesh.triangles.len()).filter(|triangle| shines(mesh.slot(*triangle)));
                    for triangle in glowing {
                        let [a, b, c] =
                            mesh.corners(triangle).map(|corner| placement.transform_point3(corner));
                        let part = 0.5 * f64::from((b - a).cross(c - a).length());
                        if part > 0.0 && part.is_finite() {
                            area += part;
                            corners.push([a, b, c]);
                            sums.push(area);
                        }
                    }
                    if corners.is_empty() {
                        continue;
                    }
                    What::Surface { instance: index, form: Form::Triangles { corners, sums }, area }
                }
                _ if !shines(0) => continue,
                Shape::Sphere { radius } => {
                    let world = f64::from(radius * scale);
                    let form = Form::Sphere { radius: *radius, placement };
                    What::Surface { instance: index, form, area: 4.0 * PI * world * world }
                }
                Shape::Disc { radius } => {
                    let world = f64::from(radius * scale);
                    let form = Form::Disc { radius: *radius, placement };
                    What::Surface { instance: index, form, area: PI * world * world }
                }
                Shape::Plane | Shape::Traced(_) => What::Unknown { instance: index },
            };
            let name = match instance.name.is_empty() {
                true => format!("object {}", index + 1),
                false => instance.name.clone(),
            };
            all.push(Self { name, what });
        }
        for (index, light) in scene.lights.iter().enumerate() {
            let kind = match light {
                Light::Point { .. } => "point",
                Light::Spot { .. } => "spot",
                Light::Sun { .. } => "sun",
            };
            let is_sun = matches!(light, Light::Sun { .. });
            if let Some(alone) = alone(scene, |bare| bare.lights.push(*light)) {
                all.push(Self { name: format!("{kind} {}", index + 1), what: What::Light { alone, is_sun } });
            }
        }
        // A black sky is none.
        if scene.environment.is_some()
            && let Some(alone) = alone(scene, |bare| bare.environment = scene.environment)
            && alone.lights.count() > 0
        {
            all.push(Self { name: "sky".to_owned(), what: What::Sky { alone } });
        }
        all
    }

    pub(super) fn kind(&self) -> LampKind {
        match &self.what {
            What::Surface { .. } => LampKind::Surface,
            What::Unknown { .. } => LampKind::Form,
            What::Light { is_sun: false, .. } => LampKind::Point,
            What::Light { .. } => LampKind::Sun,
            What::Sky { .. } => LampKind::Sky,
        }
    }

    pub(super) fn area(&self) -> Option<f64> {
        match &self.what {
            What::Surface { area, .. } => Some(*area),
            _ => None,
        }
    }

    /// The mean of `count` samples of a randomisation.
    pub(super) fn mean(
        &self,
        receiver: &Receiver<'_>,
        points: &dyn Points,
        replicate: u64,
        count: u64,
    ) -> Sample {
        const CHUNK: u64 = 1024;
        let mut room = vec![0.0; CHUNK as usize * DIMENSIONS];
        let mut sum = Sample::default();
        for first in (0..count).step_by(CHUNK as usize) {
            let length = (count - first).min(CHUNK) as usize;
            let numbers = &mut room[..length * DIMENSIONS];
            points.fill(replicate, first, DIMENSIONS, numbers);
            for (at, u) in numbers.chunks(DIMENSIONS).enumerate() {
                let key = hash::combine(replicate, first + at as u64);
                let sample = self.sample(receiver, [u[0], u[1], u[2], u[3]], key);
                sum.seen += sample.seen;
                sum.light.iter_mut().zip(sample.light).for_each(|(sum, light)| *sum += light);
            }
        }
        Sample { seen: sum.seen / count as f64, light: sum.light.map(|light| light / count as f64) }
    }

    fn sample(&self, receiver: &Receiver<'_>, u: [f64; 4], key: u64) -> Sample {
        let pair = [u[0] as f32, u[1] as f32];
        match &self.what {
            What::Surface { instance, form, area } => {
                receiver.toward_place(*instance, form.place(u), *area, key)
            }
            What::Unknown { instance } => receiver.over_hemisphere(*instance, pair, key),
            What::Light { alone, .. } => {
                let drawn = alone.lights.sample_emitter(0, &alone.scene, receiver.at, pair);
                drawn.map_or(Sample::default(), |drawn| receiver.toward_light(&drawn, key))
            }
            What::Sky { alone } => sky::sample(receiver, &Beyond { alone }, u, key),
        }
    }
}

impl Form {
    /// A place of the surface, even by area.
    fn place(&self, u: [f64; 4]) -> Vec3 {
        let pair = [u[0] as f32, u[1] as f32];
        match self {
            Self::Triangles { corners, sums } => {
                let wanted = u[2] * sums.last().copied().unwrap_or(0.0);
                let at = sums.partition_point(|sum| *sum <= wanted).min(corners.len() - 1);
                let ([a, b, c], weights) = (corners[at], warp::triangle(pair));
                a * weights.x + b * weights.y + c * weights.z
            }
            Self::Sphere { radius, placement } => placement.transform_point3(warp::sphere(pair) * *radius),
            Self::Disc { radius, placement } => {
                let place = warp::disc(pair) * *radius;
                placement.transform_point3(Vec3::new(place.x, 0.0, place.y))
            }
        }
    }
}

/// Red, green, blue in double precision.
pub(super) fn scaled(color: luch_image::Rgb, by: f64) -> [f64; 3] {
    color.to_array().map(|channel| f64::from(channel) * by)
}

impl<'a> Receiver<'a> {
    /// The receiver at a point with a unit normal.
    pub(super) fn new(world: &'a World, at: Vec3, normal: Vec3) -> Self {
        let World { scene, geometry, .. } = world;
        let slack = 2e-5 * (1.0 + at.abs().max_element());
        // People write the coordinates of a surface with few digits: what is right under the point is what it lies on.
        let probe = Ray::new(at + normal * slack, -normal);
        let under = geometry.nearest_hit(scene, &probe, 0).filter(|hit| hit.hit.t <= 2.0 * slack);
        let start = under.map(|hit| SurfacePoint::new(scene, geometry, &probe, hit).exit().near);
        Self { world, at: start.unwrap_or(at), normal, slack }
    }

    /// Light from one place of a surface, for all of its area.
    fn toward_place(&self, instance: u32, target: Vec3, area: f64, key: u64) -> Sample {
        let World { scene, geometry, .. } = self.world;
        let Some(direction) = (target - self.at).try_normalize() else { return Sample::default() };
        let ray = Ray::new(self.at, direction);
        let Some(hit) = geometry.nearest_hit(scene, &ray, key) else { return Sample::default() };
        let distance = self.at.distance(target);
        let point = SurfacePoint::new(scene, geometry, &ray, hit);
        let is_there = point.position.distance(target) <= 4.0 * self.slack + 1e-4 * distance;
        if hit.instance != instance || !is_there {
            return Sample::default();
        }
        let cosine = f64::from(direction.dot(self.normal).max(0.0));
        let other = f64::from(direction.dot(point.geometric_normal).abs());
        let squared = f64::from(distance) * f64::from(distance);
        Sample { seen: 1.0, light: scaled(emitted(&point), cosine * other / squared * area) }
    }

    /// Light of a surface that a ray of the hemisphere happens to meet.
    fn over_hemisphere(&self, instance: u32, u: [f32; 2], key: u64) -> Sample {
        let World { scene, geometry, .. } = self.world;
        let direction = Frame::from_normal(self.normal).to_world(warp::cosine_hemisphere(u));
        let ray = Ray::new(self.at, direction);
        match geometry.nearest_hit(scene, &ray, key) {
            Some(hit) if hit.instance == instance => {
                let point = SurfacePoint::new(scene, geometry, &ray, hit);
                Sample { seen: 1.0, light: scaled(emitted(&point), PI) }
            }
            _ => Sample::default(),
        }
    }

    /// Light without a surface, if nothing stands between.
    fn toward_light(&self, drawn: &EmitterSample, key: u64) -> Sample {
        let reach = drawn.target.map_or(f32::INFINITY, |target| self.at.distance(target));
        if !self.is_free(drawn.incoming, reach, key) {
            return Sample::default();
        }
        let cosine = f64::from(drawn.incoming.dot(self.normal).max(0.0));
        Sample { seen: 1.0, light: scaled(drawn.radiance, cosine / f64::from(drawn.pdf)) }
    }

    /// Whether nothing stands in a direction up to a distance.
    pub(super) fn is_free(&self, direction: Vec3, reach: f32, key: u64) -> bool {
        let World { scene, geometry, .. } = self.world;
        let hit = geometry.nearest_hit(scene, &Ray::new(self.at, direction), key);
        hit.is_none_or(|hit| hit.hit.t >= reach * (1.0 - 1e-5))
    }
}
