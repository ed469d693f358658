//! Direct light at first points, sampled by the whole bundle.
//!
//! Each path of a bundle draws one point of a lamp (or direction of the sky); every path then weighs all of them, n candidates
//! for the price of one, and asks for the visibility of one that it picks in proportion to what it would bring: resampled
//! importance sampling (Talbot, Cline and Egbert 2005) with the candidates of neighbours. With p(m) the density per area with
//! which path m draws a point, candidate y brings path k
//!
//! ```text
//! c(k, y) = w · throughput · f · L · G / Σ over m of p(m)
//! ```
//!
//! where w is the weight against finding the lamp by scattering: for points of lamps the power heuristic of the sums over the
//! bundle (`lamp.rs`), for the sky that of n · p(k) and path k's own density of scattering. The sum over all candidates is
//! unbiased, since every p is known everywhere; so is one candidate of it, picked with a chance proportional to c and
//! divided by that.

mod weigh;

use super::points::{LANES, Lanes};
use super::scatterers::Scatterers;
use super::{Bundle, Reuse};
use crate::lights::{Candidate, Lights};
use crate::purpose;
use crate::surface::segment_before;
use crate::world::World;
use luch_bvh::Ray;
use luch_bvh::simd::dispatch;
use luch_image::Rgb;
use luch_sampling::{Sampler, hash};
use weigh::{Bringing, Shine, Weigh};

/// A first point that wants direct light.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Standpoint {
    pub(crate) sample: u32,
    /// The numbers of the sample where its bundle works together.
    pub(crate) sampler: Sampler,
}

/// A standpoint by its lane.
#[derive(Clone, Copy)]
struct Place {
    lane: usize,
    /// Which emitter, where on it (two numbers), and which candidate.
    numbers: [u32; 4],
}

impl Reuse {
    /// Answers all standpoints of a bounce, whose paths have scattered `depth` times: `ask` gets the sample, a ray and the
    /// light that comes along it if it is free.
    pub(crate) fn light(
        &mut self,
        world: &World,
        depth: u32,
        standpoints: &mut [Standpoint],
        mut ask: impl FnMut(u32, Ray, Rgb),
    ) {
        standpoints.sort_unstable_by_key(|standpoint| standpoint.sample);
        let Self { bundles, places, .. } = self;
        let bundle = |standpoint: &Standpoint| places[standpoint.sample as usize].0;
        for group in standpoints.chunk_by(|a, b| bundle(a) == bundle(b)) {
            let place = |standpoint: &Standpoint| Place {
                lane: places[standpoint.sample as usize].1 as usize,
                numbers: standpoint.sampler.group_words(purpose::light(depth)),
            };
            let mut members = [Place { lane: 0, numbers: [0; 4] }; LANES];
            for (member, standpoint) in members.iter_mut().zip(group) {
                *member = place(standpoint);
            }
            let members = &members[..group.len()];
            let bundle = &mut bundles[bundle(&group[0]) as usize];
            for member in members {
                bundle.partners[member.lane] = members.len() as f32;
            }
            bundle.light(world, depth, members, &mut ask);
        }
    }

    /// How many paths sampled direct light together at the first point of `sample`.
    pub(crate) fn partners(&self, sample: u32) -> f32 {
        let (bundle, lane) = self.places[sample as usize];
        self.bundles[bundle as usize].partners[lane as usize]
    }
}

impl Bundle {
    fn light(&self, world: &World, depth: u32, members: &[Place], ask: &mut impl FnMut(u32, Ray, Rgb)) {
        let candidates = draw(world, &self.firsts, members);
        let mut bringing: Vec<Bringing> = Vec::with_capacity(candidates.len());
        let mut totals = [0.0_f32; LANES];
        for (j, candidate) in candidates.iter().enumerate() {
            let same = candidates[..j].iter().position(|other| other.emitter == candidate.emitter);
            let chances = match same {
                Some(same) => bringing[same].chances,
                None => chances(&world.lights, candidate.emitter, &self.firsts, members),
            };
            let mut brought = Bringing::new(chances);
            let shine = Shine::new(world, candidate, &self.firsts.points, members.iter().map(|m| m.lane));
            let Self { firsts, gains, .. } = self;
            let partners = members.len() as f32;
            dispatch(Weigh { firsts, gains, depth, shine: &shine, partners, bringing: &mut brought });
            for member in members {
                totals[member.lane] += brought.weight[member.lane];
            }
            bringing.push(brought);
        }
        for member in members {
            let lane = member.lane;
            let total = totals[lane];
            if !(total > 0.0 && total.is_finite()) {
                continue;
            }
            let mut rest = hash::unit_f32(member.numbers[3]) * total;
            let mut picked = None;
            for (j, brought) in bringing.iter().enumerate() {
                let weight = brought.weight[lane];
                if weight > 0.0 {
                    picked = Some(j);
                    if rest < weight {
                        break;
                    }
                    rest -= weight;
                }
            }
            let Some(j) = picked else { continue };
            let from = self.firsts.points.position(lane);
            let Some(toward) = world.lights.toward(&candidates[j], &world.scene, from) else { continue };
            let start = self.firsts.start_toward(lane, toward.incoming);
            let ray = match toward.target {
                Some(target) => segment_before(start, target),
                None => Ray::new(start, toward.incoming),
            };
            let [r, g, b] = bringing[j].light.map(|channel| channel[lane]);
            ask(self.start + lane as u32, ray, Rgb::new(r, g, b) * (total / bringing[j].weight[lane]));
        }
    }
}

/// The candidates that standpoints contribute.
fn draw(world: &World, firsts: &Scatterers, members: &[Place]) -> Vec<Candidate> {
    let candidate = |member: &Place| {
        let [choice, u, v, _] = member.numbers;
        let (from, normal) = (firsts.points.position(member.lane), firsts.receiving(member.lane));
        let chosen = world.lights.choose(from, normal, hash::unit_f64(choice))?;
        world.lights.candidate(chosen.emitter, &world.scene, [u, v].map(hash::unit_f32))
    };
    members.iter().filter_map(candidate).collect()
}

/// With which chance each standpoint would choose an emitter.
fn chances(lights: &Lights, emitter: u32, firsts: &Scatterers, members: &[Place]) -> Lanes {
    let mut chances = [0.0; LANES];
    for &Place { lane, .. } in members {
        chances[lane] = lights.probability(emitter, firsts.points.position(lane), firsts.receiving(lane));
    }
    chances
}
