//! All standpoints of a bundle weigh a candidate side by side.

use super::super::lamp::{scattering_weight, sum_over_area};
use super::super::points::{LANES, Lanes, NONE, Points, Vectors, at, directions_to};
use super::super::scatterers::{Scattered, Scatterers};
use crate::lights::{Candidate, Shone};
use crate::world::World;
use luch_bvh::simd::Task;
use luch_image::Rgb;

/// What a candidate sends to standpoints.
pub(super) enum Shine {
    /// The same light to all.
    Alike(Shone),
    /// A light without extent: to each its own.
    Each(Box<Each>),
}

/// Directions to a light and what comes from there.
pub(super) struct Each {
    toward: Vectors,
    irradiance: Vectors,
}

impl Shine {
    pub(super) fn new(
        world: &World,
        candidate: &Candidate,
        points: &Points,
        lanes: impl Iterator<Item = usize>,
    ) -> Self {
        if let Some(shone) = world.lights.shone(candidate, &world.scene) {
            return Self::Alike(shone);
        }
        let (mut toward, mut irradiance) = (NONE, NONE);
        for lane in lanes {
            if let Some(light) = world.lights.toward(candidate, &world.scene, points.position(lane)) {
                let light_of = light.radiance * (1.0 / light.pdf);
                for axis in 0..3 {
                    toward[axis][lane] = light.incoming[axis];
                    irradiance[axis][lane] = light_of.to_array()[axis];
                }
            }
        }
        Self::Each(Box::new(Each { toward, irradiance }))
    }
}

/// What a candidate brings, for all lanes.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(super) struct Bringing {
    pub(super) light: Vectors,
    pub(super) weight: Lanes,
    /// With which chance each standpoint would choose the emitter.
    pub(super) chances: Lanes,
}

impl Bringing {
    pub(super) fn new(chances: Lanes) -> Self {
        Self { light: NONE, weight: [0.0; LANES], chances }
    }
}

/// Weighs one candidate for all lanes.
pub(super) struct Weigh<'a> {
    pub(super) firsts: &'a Scatterers,
    /// What light from each standpoint is multiplied by.
    pub(super) gains: &'a [Rgb; LANES],
    /// Of the standpoints.
    pub(super) depth: u32,
    pub(super) shine: &'a Shine,
    /// How many standpoints there are.
    pub(super) partners: f32,
    pub(super) bringing: &'a mut Bringing,
}

impl Task for Weigh<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { firsts, gains, depth, shine, partners, bringing } = self;
        let chances = &bringing.chances;
        let all: f32 = chances.iter().sum();
        // Scattering by the others counts too, in the sum over the bundle.
        let wanted = |lane: usize| firsts.points.is_at(lane, depth);
        let mut scattered = Scattered::default();
        let mut arriving = NONE;
        // Radiance over density and weight, the same for all channels but for the radiance.
        let mut scale = [0.0_f32; LANES];
        match shine {
            Shine::Each(each) => {
                firsts.evaluate(&each.toward, wanted, &mut scattered);
                arriving = each.irradiance;
                scale = [1.0 / all; LANES];
            }
            Shine::Alike(shone) if shone.pdf_area == 0.0 => {
                let toward = [[shone.place.x; LANES], [shone.place.y; LANES], [shone.place.z; LANES]];
                firsts.evaluate(&toward, wanted, &mut scattered);
                for l in 0..LANES {
                    // Against the path's own scattering; a light without extent has no rival.
                    let ratio = scattered.pdf[l] / (chances[l] * partners * shone.pdf);
                    let rivalry = if shone.delta { 0.0 } else { ratio * ratio };
                    scale[l] = 1.0 / ((1.0 + rivalry) * (all * shone.pdf));
                }
            }
            Shine::Alike(shone) => {
                let (toward, squared) = directions_to(&firsts.points, shone.place);
                firsts.evaluate(&toward, wanted, &mut scattered);
                let front: Lanes = std::array::from_fn(|l| -at(&toward, l).dot(shone.normal));
                let back = front.map(|cosine| -cosine);
                let light = all * shone.pdf_area;
                let pdf = &scattered.pdf;
                let weight = |cosines: &Lanes| {
                    1.0 - scattering_weight(
                        light,
                        sum_over_area(&firsts.points, depth, pdf, cosines, &squared),
                    )
                };
                let front_weight = weight(&front);
                let back_weight = if shone.two_sided { weight(&back) } else { 0.0 };
                for l in 0..LANES {
                    let weight = if front[l] > 0.0 { front_weight } else { back_weight };
                    let pdf = squared[l] * light / front[l].abs();
                    scale[l] = weight / pdf;
                }
            }
        }
        if let Shine::Alike(shone) = shine {
            for (channel, radiance) in arriving.iter_mut().zip(shone.radiance.to_array()) {
                *channel = [radiance; LANES];
            }
        }
        for l in 0..LANES {
            let usable = (chances[l] > 0.0) & (scattered.pdf[l] > 0.0) & (scale[l] < f32::INFINITY);
            let gain = gains[l].to_array();
            let mut most = 0.0_f32;
            for channel in 0..3 {
                let light = gain[channel] * scattered.value[channel][l] * arriving[channel][l] * scale[l];
                let light = if usable & (light < f32::INFINITY) { light } else { 0.0 };
                bringing.light[channel][l] = light;
                most = if light > most { light } else { most };
            }
            bringing.weight[l] = most;
        }
    }
}
