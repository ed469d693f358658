//! How much counts that first points found a lamp by scattering, where the bundle samples light as well.
//!
//! Both are techniques of the whole bundle: over all first points of one depth, light sampling finds a point y of a lamp with
//! the sum A of their densities, scattering with the sum B, both per area and as if nothing stood between. The power heuristic of
//! A and B depends on y alone, so it weighs what everyone receives from there.

use super::Reuse;
use super::points::{LANES, Points, at, directions_to};
use super::scatterers::{Scattered, Scatterers};
use crate::surface::SurfacePoint;
use crate::world::World;
use glam::Vec3;
use luch_bvh::simd::{Task, dispatch};

impl Reuse {
    /// The weight of a lamp that the path of `sample` met on the way from its first point.
    pub(crate) fn weight_of_lamp(&self, world: &World, sample: u32, point: &SurfacePoint) -> f32 {
        let Some(pdf_area) = world.lights.candidate_pdf_area(point) else { return 1.0 };
        let (bundle, own) = self.places[sample as usize];
        let firsts = &self.bundles[bundle as usize].firsts;
        let depth = firsts.points.depth[own as usize];
        let chance = |lane: usize| {
            let from = firsts.points.position(lane);
            world.lights.probability(pdf_area.emitter, from, firsts.receiving(lane))
        };
        let all: f32 = (0..LANES).filter(|&lane| firsts.points.is_at(lane, depth)).map(chance).sum();
        let side = if point.is_front() { 1.0 } else { -1.0 };
        let (place, normal) = (point.position, point.geometric_normal * side);
        let scattered = dispatch(FoundByScattering { firsts, depth, place, normal });
        scattering_weight(all * pdf_area.pdf_area, scattered)
    }
}

/// The weight of scattering against light sampling, by the densities of both.
#[inline(always)]
pub(super) fn scattering_weight(light: f32, scattering: f32) -> f32 {
    let ratio = light / scattering;
    let weight = 1.0 / (1.0 + ratio * ratio);
    // Not a number where neither could have found it but for rounding.
    if weight >= 0.0 { weight } else { 0.0 }
}

/// Sum of the densities per area with which all first points of a depth find a place by scattering.
struct FoundByScattering<'a> {
    firsts: &'a Scatterers,
    depth: u32,
    place: Vec3,
    normal: Vec3,
}

impl Task for FoundByScattering<'_> {
    type Output = f32;

    #[inline(always)]
    fn run(self) -> f32 {
        let (toward, squared) = directions_to(&self.firsts.points, self.place);
        let mut scattered = Scattered::default();
        let member = |k| self.firsts.points.is_at(k, self.depth);
        self.firsts.densities(&toward, member, &mut scattered);
        let arriving = std::array::from_fn(|k| -at(&toward, k).dot(self.normal));
        sum_over_area(&self.firsts.points, self.depth, &scattered.pdf, &arriving, &squared)
    }
}

/// Sum of densities over the points of a depth, per area where the directions arrive; a negative cosine finds nothing.
#[inline(always)]
pub(super) fn sum_over_area(
    points: &Points,
    depth: u32,
    pdf: &[f32; LANES],
    arriving: &[f32; LANES],
    squared: &[f32; LANES],
) -> f32 {
    let mut sum = 0.0;
    for k in 0..LANES {
        let density = pdf[k] * arriving[k] / squared[k];
        let counts = points.is_at(k, depth) & (arriving[k] > 0.0) & (density < f32::INFINITY);
        sum += if counts { density } else { 0.0 };
    }
    sum
}
