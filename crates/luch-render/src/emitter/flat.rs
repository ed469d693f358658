//! A flat lamp: a triangle of a glowing mesh, or two that make a parallelogram.
//!
//! Seen from near it is sampled uniformly in solid angle (triangles after Arvo 1995, rectangles after Ureña, Fajardo and King
//! 2013), otherwise uniformly in area.

use super::{EmitterSample, in_front, pdf_of_area};
use crate::lights::LightBounds;
use crate::place::Place;
use glam::Vec3;
use luch_image::Rgb;
use luch_sampling::warp::{SphericalRectangle, SphericalTriangle, triangle};
use luch_scene::{Emission, Id, Instance, Material, Opacity, Scene};

/// Distances of the centre, in radii of the lamp, below which sampling by solid angle pays for its cost.
///
/// It takes ten times as long as sampling by area, about a third of the whole work at a surface. At two radii (half a steradian of a
/// facing square) one sample by area scatters by 10 % where the receiver faces the lamp, by 43 % at 45° and by 68 % at a flat angle,
/// against 2.5 % by solid angle; at four radii by 3, 23 and 32 %. What is hidden and what is reflected scatters more than that.
const NEAR: f32 = 2.0;

/// The outline of a flat lamp.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FlatForm {
    /// `corner + s·edge₀ + t·edge₁` with s + t ≤ 1.
    Triangle,
    /// The same with s and t up to 1.
    Parallelogram,
    /// A parallelogram with right angles.
    Rectangle,
}

/// A flat lamp in the world.
#[derive(Clone, Copy, Debug)]
pub struct FlatLamp {
    /// Where both edges start.
    pub corner: Vec3,
    /// From the corner to its two neighbours.
    pub edges: [Vec3; 2],
    /// Unit length, outward: the side that shines.
    pub normal: Vec3,
    /// In the world; the density of a point drawn by area is its inverse.
    pub area: f32,
    /// What it sends, if that is the same everywhere; otherwise about the mean.
    pub radiance: Rgb,
    /// True if `radiance` holds everywhere.
    pub constant: bool,
    /// True if the other side shines as well.
    pub two_sided: bool,
    /// Outline.
    pub form: FlatForm,
    instance: u32,
    primitive: u32,
    material: Id<Material>,
    /// Squared distance from the centre below which the lamp is sampled by solid angle.
    near_squared: f32,
}

/// The lamp as seen from a point near it.
enum Seen {
    Triangle(SphericalTriangle),
    Rectangle(SphericalRectangle),
    /// A parallelogram without right angles: its two halves.
    Halves([SphericalTriangle; 2]),
}

impl Seen {
    fn pdf(&self) -> f32 {
        match self {
            Seen::Triangle(seen) => seen.pdf(),
            Seen::Rectangle(seen) => seen.pdf(),
            Seen::Halves([a, b]) => 1.0 / (a.solid_angle() + b.solid_angle()),
        }
    }
}

/// A direction toward a lamp and the place it meets, in parts of the edges.
struct Toward {
    direction: Vec3,
    place: [f32; 2],
}

/// What a lamp of this material sends everywhere; `None` if that depends on the place.
pub(crate) fn constant_radiance(material: &Material) -> Option<Rgb> {
    let emission = material.emission.as_ref()?;
    let constant = emission.radiance.texture.is_none()
        && !emission.radiance.vertex_color
        && material.opacity == Opacity::Opaque;
    constant.then(|| emission.radiance.factor.map(|v| v.max(0.0)))
}

impl FlatLamp {
    /// Number of the instance that shines.
    pub fn instance(&self) -> u32 {
        self.instance
    }

    /// The lamp of a triangle in the world; `outward` fixes which side is the front. `None` if it has no area.
    pub(crate) fn triangle(
        scene: &Scene,
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
        let mut lamp = Self {
            corner: a,
            edges: [b - a, c - a],
            normal: if normal.dot(outward) < 0.0 { -normal } else { normal },
            area,
            radiance: Rgb::BLACK,
            constant: false,
            two_sided: emission.two_sided,
            form: FlatForm::Triangle,
            instance,
            primitive,
            material,
            near_squared: 0.0,
        };
        let constant = constant_radiance(&scene.materials[material.index()]);
        lamp.constant = constant.is_some();
        lamp.radiance = constant.unwrap_or_else(|| lamp.about_mean(scene));
        lamp.set_near();
        (area > 0.0 && area.is_finite()).then_some(lamp)
    }

    /// This lamp and its neighbour as one, if both are halves of a parallelogram and shine alike.
    ///
    /// Corners must be the same to the bit, and the fourth where the other three put it, up to rounding.
    pub(crate) fn joined(&self, corners: [Vec3; 3], other: &Self, others: [Vec3; 3]) -> Option<Self> {
        /// Roundings of the corners.
        const ROUNDINGS: f32 = 4.0;
        let alike = self.constant
            && other.constant
            && self.material == other.material
            && self.normal.dot(other.normal) > 0.0;
        if !alike {
            return None;
        }
        for i in 0..3 {
            let [apex, p, q] = [corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]];
            // The neighbour runs along the common side the other way.
            let Some(j) = (0..3).find(|&j| others[(j + 1) % 3] == q && others[(j + 2) % 3] == p) else {
                continue;
            };
            let off = (apex + others[j]) - (p + q);
            let largest = corners.into_iter().chain(others).fold(0.0f32, |m, c| m.max(c.abs().max_element()));
            if off.abs().max_element() > ROUNDINGS * f32::EPSILON * largest {
                return None;
            }
            let edges = [p - apex, q - apex];
            let cosine = edges[0].dot(edges[1]).abs() / (edges[0].length() * edges[1].length());
            let form = if cosine < 1e-5 { FlatForm::Rectangle } else { FlatForm::Parallelogram };
            let mut lamp =
                Self { corner: apex, edges, area: edges[0].cross(edges[1]).length(), form, ..*self };
            lamp.set_near();
            return Some(lamp);
        }
        None
    }

    fn set_near(&mut self) {
        let reach = NEAR * self.radius();
        self.near_squared = reach * reach;
    }

    /// Middle of the outline.
    pub fn center(&self) -> Vec3 {
        let part = if self.form == FlatForm::Triangle { 1.0 / 3.0 } else { 0.5 };
        self.corner + (self.edges[0] + self.edges[1]) * part
    }

    /// From the centre to the farthest corner.
    fn radius(&self) -> f32 {
        let [e, f] = self.edges;
        let to_center = self.center() - self.corner;
        [Vec3::ZERO, e, f].into_iter().fold(0.0f32, |most, corner| most.max(corner.distance(to_center)))
    }

    /// True if the lamp is sampled by solid angle from here, false if by area.
    pub fn is_near(&self, from: Vec3) -> bool {
        from.distance_squared(self.center()) < self.near_squared
    }

    /// Whether `from` is on a side that shines.
    pub fn faces(&self, from: Vec3) -> bool {
        self.two_sided || (from - self.corner).dot(self.normal) > 0.0
    }

    /// Bounds for the choice of light.
    pub(crate) fn bounds(&self) -> LightBounds {
        let intensity = self.radiance.luminance() * self.area;
        LightBounds::flat(self.center(), self.radius(), self.normal, intensity, self.two_sided)
    }

    /// The lamp as seen from a point; `None` where it is sampled by area.
    fn seen(&self, from: Vec3) -> Option<Seen> {
        if !self.is_near(from) {
            return None;
        }
        let (corner, [e, f]) = (self.corner, self.edges);
        Some(match self.form {
            FlatForm::Triangle => {
                Seen::Triangle(SphericalTriangle::new(from, [corner, corner + e, corner + f])?)
            }
            FlatForm::Rectangle => Seen::Rectangle(SphericalRectangle::new(from, corner, e, f)?),
            FlatForm::Parallelogram => Seen::Halves([
                SphericalTriangle::new(from, [corner, corner + e, corner + f])?,
                SphericalTriangle::new(from, [corner + e + f, corner + f, corner + e])?,
            ]),
        })
    }

    fn toward(&self, seen: &Seen, [u, v]: [f32; 2]) -> Toward {
        match seen {
            Seen::Triangle(seen) => {
                let drawn = seen.sample([u, v]);
                Toward { direction: drawn.direction, place: [drawn.barycentrics.y, drawn.barycentrics.z] }
            }
            Seen::Rectangle(seen) => {
                let drawn = seen.sample([u, v]);
                Toward { direction: drawn.direction, place: drawn.position }
            }
            Seen::Halves([first, second]) => {
                let share = first.solid_angle() / (first.solid_angle() + second.solid_angle());
                let below_one = 1f32.next_down();
                if u < share {
                    let drawn = first.sample([(u / share).min(below_one), v]);
                    Toward { direction: drawn.direction, place: [drawn.barycentrics.y, drawn.barycentrics.z] }
                } else {
                    let drawn = second.sample([((u - share) / (1.0 - share)).min(below_one), v]);
                    let place = [1.0 - drawn.barycentrics.y, 1.0 - drawn.barycentrics.z];
                    Toward { direction: drawn.direction, place }
                }
            }
        }
    }

    /// A place uniform by area, in parts of the edges.
    pub fn place_by_area(&self, u: [f32; 2]) -> [f32; 2] {
        match self.form {
            FlatForm::Triangle => {
                let weights = triangle(u);
                [weights.y, weights.z]
            }
            FlatForm::Parallelogram | FlatForm::Rectangle => u,
        }
    }

    pub(crate) fn point(&self, [s, t]: [f32; 2]) -> Vec3 {
        self.corner + self.edges[0] * s + self.edges[1] * t
    }

    pub(crate) fn radiance_at(&self, scene: &Scene, [s, t]: [f32; 2]) -> Rgb {
        if self.constant {
            return self.radiance;
        }
        let instance: &Instance = &scene.instances[self.instance as usize];
        let place = Place {
            scene,
            instance,
            shape: &scene.shapes[instance.shape.index()],
            primitive: self.primitive as usize,
            weights: [(1.0 - s - t).max(0.0), s, t],
            local: Vec3::ZERO,
            footprint: None,
        };
        place.lamp_radiance(&scene.materials[self.material.index()])
    }

    pub(crate) fn sample(&self, scene: &Scene, from: Vec3, u: [f32; 2]) -> Option<EmitterSample> {
        if !self.faces(from) {
            return None;
        }
        let (place, direction, pdf) = match self.seen(from) {
            Some(seen) => {
                let toward = self.toward(&seen, u);
                (toward.place, toward.direction, seen.pdf())
            }
            None => {
                let place = self.place_by_area(u);
                let to = self.point(place);
                let pdf = pdf_of_area(from, to, self.normal, self.area)?;
                (place, (to - from).try_normalize()?, pdf)
            }
        };
        let target = in_front(self.point(place), self.normal, from, 0.0);
        EmitterSample::checked(direction, Some(target), self.radiance_at(scene, place), pdf, false)
    }

    /// A place of the lamp as seen from a point, with the density of places drawn by area.
    pub(crate) fn toward_place(&self, scene: &Scene, from: Vec3, place: [f32; 2]) -> Option<EmitterSample> {
        if !self.faces(from) {
            return None;
        }
        let to = self.point(place);
        let pdf = pdf_of_area(from, to, self.normal, self.area)?;
        let incoming = (to - from).try_normalize()?;
        let target = in_front(to, self.normal, from, 0.0);
        EmitterSample::checked(incoming, Some(target), self.radiance_at(scene, place), pdf, false)
    }

    pub(crate) fn pdf(&self, from: Vec3, to: Vec3) -> f32 {
        if !self.faces(from) {
            return 0.0;
        }
        match self.seen(from) {
            Some(seen) => seen.pdf(),
            None => pdf_of_area(from, to, self.normal, self.area).unwrap_or(0.0),
        }
    }

    /// The mean over corners and centre, which stands for the texture.
    fn about_mean(&self, scene: &Scene) -> Rgb {
        let third = 1.0 / 3.0;
        let places = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [third, third]];
        let sum = places.into_iter().fold(Rgb::BLACK, |sum, place| sum + self.radiance_at(scene, place));
        // A texture may be dark at these and bright between: a floor keeps every triangle reachable.
        let brightest = scene.materials[self.material.index()]
            .emission
            .as_ref()
            .map_or(Rgb::BLACK, |e| e.radiance.factor);
        let mean = sum / 4.0;
        let floor = brightest * 0.05;
        Rgb::new(mean.r.max(floor.r), mean.g.max(floor.g), mean.b.max(floor.b))
    }
}
