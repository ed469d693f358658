//! What can be sampled for light.
//!
//! One lamp of the scene may become many emitters: a glowing mesh is one for each triangle or pair of triangles. The contract of the family: `sample`
//! draws a direction toward the emitter with a density per solid angle, `pdf` is that density for a direction that a ray found by
//! itself, and their quotient with the radiance is the irradiance, without bias.

mod ball;
mod disc;
mod environment;
mod flat;
mod point;
mod sun;

pub(crate) use ball::BallEmitter;
pub(crate) use disc::DiscEmitter;
pub(crate) use environment::EnvironmentEmitter;
pub use flat::{FlatForm, FlatLamp};
pub(crate) use point::{PointEmitter, SpotEmitter};
pub(crate) use sun::SunEmitter;

use crate::lights::LightBounds;
use glam::Vec3;
use luch_image::Rgb;
use luch_scene::Scene;

/// A direction toward light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmitterSample {
    /// Toward the light; unit length.
    pub incoming: Vec3,
    /// The point of the emitter, or `None` if it is infinitely far.
    pub target: Option<Vec3>,
    /// What comes from there: radiance, or for delta lights irradiance on a surface that faces it.
    pub radiance: Rgb,
    /// Density per solid angle; for delta lights the probability alone.
    pub pdf: f32,
    /// True if no ray finds this light by itself.
    pub delta: bool,
}

impl EmitterSample {
    /// The only way to make a sample: `None` unless it carries light with a positive density.
    fn checked(incoming: Vec3, target: Option<Vec3>, radiance: Rgb, pdf: f32, delta: bool) -> Option<Self> {
        let usable = pdf > 0.0 && pdf.is_finite() && radiance.is_finite() && incoming.is_finite();
        (usable && !radiance.is_black()).then_some(Self { incoming, target, radiance, pdf, delta })
    }
}

/// Light from infinity.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FarLight {
    pub(crate) radiance: Rgb,
    /// Density with which the emitter's sampling draws the direction.
    pub(crate) pdf: f32,
}

/// One thing that shines and is not a flat lamp.
#[derive(Debug)]
pub(crate) enum Emitter {
    Ball(Box<BallEmitter>),
    Disc(Box<DiscEmitter>),
    Point(PointEmitter),
    Spot(SpotEmitter),
    Sun(Box<SunEmitter>),
    Environment(Box<EnvironmentEmitter>),
}

impl Emitter {
    /// Draws a direction from `from` toward the emitter.
    pub(crate) fn sample(&self, scene: &Scene, from: Vec3, u: [f32; 2]) -> Option<EmitterSample> {
        match self {
            Emitter::Ball(emitter) => emitter.sample(scene, from, u),
            Emitter::Disc(emitter) => emitter.sample(scene, from, u),
            Emitter::Point(emitter) => emitter.sample(from),
            Emitter::Spot(emitter) => emitter.sample(from),
            Emitter::Sun(emitter) => emitter.sample(u),
            Emitter::Environment(emitter) => emitter.sample(scene, u),
        }
    }

    /// Density with which `sample` draws the direction from `from` to the point `to` of an emitter that has a surface.
    pub(crate) fn pdf(&self, from: Vec3, to: Vec3) -> f32 {
        match self {
            Emitter::Ball(emitter) => emitter.pdf(from, to),
            Emitter::Disc(emitter) => emitter.pdf(from, to),
            Emitter::Point(_) | Emitter::Spot(_) | Emitter::Sun(_) | Emitter::Environment(_) => 0.0,
        }
    }

    /// Bounds for the choice of light; `None` if it is infinitely far.
    pub(crate) fn bounds(&self, scene: &Scene) -> Option<LightBounds> {
        match self {
            Emitter::Ball(emitter) => Some(emitter.bounds(scene)),
            Emitter::Disc(emitter) => Some(emitter.bounds(scene)),
            Emitter::Point(emitter) => Some(emitter.bounds()),
            Emitter::Spot(emitter) => Some(emitter.bounds()),
            Emitter::Sun(_) | Emitter::Environment(_) => None,
        }
    }
}

/// A point of an emitter with this unit normal, moved toward `from` until rounding cannot put it behind the surface: where the ray
/// that asks whether it is seen may end. `size` is the emitter's extent.
fn in_front(to: Vec3, normal: Vec3, from: Vec3, size: f32) -> Vec3 {
    /// Roundings of the point, of the segment to it and of the test.
    const ROUNDINGS: f32 = 32.0;
    let side = if (from - to).dot(normal) < 0.0 { -1.0 } else { 1.0 };
    to + normal * (side * ROUNDINGS * (f32::EPSILON / 2.0) * (to.abs().max_element() + size))
}

/// Density per solid angle of a point drawn by area: `pdf_area · distance² / |cos|`; `None` on edge or in place.
fn pdf_of_area(from: Vec3, to: Vec3, normal: Vec3, area: f32) -> Option<f32> {
    let way = to - from;
    let squared = way.length_squared();
    let cosine = way.dot(normal).abs() / squared.sqrt();
    let pdf = squared / (cosine * area);
    (pdf > 0.0 && pdf.is_finite()).then_some(pdf)
}
