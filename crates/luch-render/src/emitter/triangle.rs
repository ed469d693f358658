//! One triangle of a glowing mesh.
//!
//! Seen under a large angle it is sampled uniformly in solid angle (Arvo 1995), otherwise uniformly in area.

use super::{EmitterSample, in_front, pdf_of_area};
use crate::place::Place;
use glam::Vec3;
use luch_image::Rgb;
use luch_sampling::warp::{SphericalTriangle, triangle};
use luch_scene::{Emission, Id, Instance, Material, Scene};

/// Solid angle, in steradians, from which on sampling by solid angle pays for its cost.
const LARGE: f32 = 0.02;

/// A triangle in the world that emits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TriangleEmitter {
    corners: [Vec3; 3],
    /// Unit length, outward.
    normal: Vec3,
    area: f32,
    instance: u32,
    primitive: u32,
    material: Id<Material>,
    two_sided: bool,
}

impl TriangleEmitter {
    /// The emitter of a triangle in the world; `outward` fixes which side is the front. `None` if it has no area.
    pub(crate) fn new(
        corners: [Vec3; 3],
        outward: Vec3,
        instance: u32,
        primitive: u32,
        material: Id<Material>,
        emission: &Emission,
    ) -> Option<Self> {
        let [a, b, c] = corners;
        let across = (b - a).cross(c - a);
        let area = across.length() / 2.0;
        let normal = across.try_normalize()?;
        let normal = if normal.dot(outward) < 0.0 { -normal } else { normal };
        let usable = area > 0.0 && area.is_finite();
        let two_sided = emission.two_sided;
        usable.then_some(Self { corners, normal, area, instance, primitive, material, two_sided })
    }

    /// The triangle as seen from a point, if it is large enough there; the same answer for sampling and density.
    fn spherical(&self, from: Vec3) -> Option<SphericalTriangle> {
        let [a, b, c] = self.corners;
        // No triangle looks larger than its area over the squared distance to its circumscribed ball.
        let center = (a + b + c) / 3.0;
        let reach = a.distance(center).max(b.distance(center)).max(c.distance(center));
        let gap = from.distance(center) - reach;
        if gap > 0.0 && self.area < LARGE * gap * gap {
            return None;
        }
        SphericalTriangle::new(from, self.corners).filter(|t| t.solid_angle() >= LARGE)
    }

    fn target(&self, from: Vec3, to: Vec3) -> Vec3 {
        in_front(to, self.normal, from, 0.0)
    }

    fn faces(&self, from: Vec3) -> bool {
        self.two_sided || (from - self.corners[0]).dot(self.normal) > 0.0
    }

    fn radiance(&self, scene: &Scene, weights: Vec3) -> Rgb {
        let instance: &Instance = &scene.instances[self.instance as usize];
        let place = Place {
            scene,
            instance,
            shape: &scene.shapes[instance.shape.index()],
            primitive: self.primitive as usize,
            weights: weights.to_array(),
            local: Vec3::ZERO,
        };
        place.lamp_radiance(&scene.materials[self.material.index()])
    }

    pub(crate) fn sample(&self, scene: &Scene, from: Vec3, u: [f32; 2]) -> Option<EmitterSample> {
        if !self.faces(from) {
            return None;
        }
        let [a, b, c] = self.corners;
        let point = |w: Vec3| a * w.x + b * w.y + c * w.z;
        if let Some(seen) = self.spherical(from) {
            let drawn = seen.sample(u);
            let radiance = self.radiance(scene, drawn.barycentrics);
            let target = self.target(from, point(drawn.barycentrics));
            return EmitterSample::checked(drawn.direction, Some(target), radiance, drawn.pdf, false);
        }
        let weights = triangle(u);
        let to = point(weights);
        let pdf = pdf_of_area(from, to, self.normal, self.area)?;
        let incoming = (to - from).try_normalize()?;
        EmitterSample::checked(
            incoming,
            Some(self.target(from, to)),
            self.radiance(scene, weights),
            pdf,
            false,
        )
    }

    pub(crate) fn pdf(&self, from: Vec3, to: Vec3) -> f32 {
        if !self.faces(from) {
            return 0.0;
        }
        match self.spherical(from) {
            Some(seen) => seen.pdf(),
            None => pdf_of_area(from, to, self.normal, self.area).unwrap_or(0.0),
        }
    }

    pub(crate) fn power(&self, scene: &Scene) -> f32 {
        // The mean over corners and centre stands for the texture.
        let third = 1.0 / 3.0;
        let places = [Vec3::X, Vec3::Y, Vec3::Z, Vec3::splat(third)];
        let radiance = places.map(|weights| self.radiance(scene, weights).luminance());
        // A texture may be dark at these and bright between: a floor keeps every triangle reachable.
        let brightest = scene.materials[self.material.index()]
            .emission
            .as_ref()
            .map_or(0.0, |e| e.radiance.factor.luminance());
        let mean = radiance.iter().sum::<f32>() / 4.0;
        let sides = if self.two_sided { 2.0 } else { 1.0 };
        mean.max(0.05 * brightest) * self.area * std::f32::consts::PI * sides
    }
}
