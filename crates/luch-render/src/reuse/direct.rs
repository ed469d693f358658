//! Direct light at first points, sampled by the whole bundle.
//!
//! Each path of a bundle draws one point of a lamp (or direction of the sky); every path then weighs all of them, n candidates
//! for the price of one, and asks for the visibility of one that it picks in proportion to what it would bring: resampled
//! importance sampling (Talbot, Cline and Egbert 2005) with the candidates of neighbours. With p(m) the density per area with
//! which path m draws a point, candidate y brings path k
//!
//! ```text
//! c(k, y) = w(k, y) · throughput · f · L · G / Σ over m of p(m)
//! ```
//!
//! where w is the weight against finding the lamp by scattering: the power heuristic of n · p(k) and the density of scattering.
//! The sum over all candidates is unbiased, since every p is known everywhere; so is one candidate of it, picked with a chance
//! proportional to c and divided by that.

mod lanes;

use super::{LANES, Reuse};
use crate::bsdf::Bsdf;
use crate::lights::{Candidate, Lights};
use crate::surface::{Exit, segment_before};
use crate::world::World;
use glam::Vec3;
use luch_bvh::Ray;
use luch_bvh::simd::dispatch;
use luch_image::Rgb;
use luch_sampling::{Frame, hash, mis};

/// A first point that wants direct light.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Standpoint {
    pub(crate) sample: u32,
    pub(crate) exit: Exit,
    pub(crate) frame: Frame,
    pub(crate) bsdf: Bsdf,
    /// Toward the viewer, in the frame.
    pub(crate) outgoing: Vec3,
    /// The same in the world.
    pub(crate) toward_viewer: Vec3,
    pub(crate) throughput: Rgb,
    /// Which emitter, where on it, and which candidate.
    pub(crate) numbers: [u32; 4],
}

/// What a candidate brings a standpoint if nothing stands between.
#[derive(Clone, Copy)]
struct Brought {
    light: Rgb,
    ray: Ray,
}

impl Standpoint {
    /// Normal on the side that receives light; zero if light of both sides counts.
    fn normal(&self) -> Vec3 {
        if self.bsdf.transmits() { Vec3::ZERO } else { self.exit.normal }
    }
}

impl Reuse {
    /// Answers all standpoints of a bounce: `ask` gets the sample, a ray and the light that comes along it if it is free.
    pub(crate) fn light(
        &mut self,
        world: &World,
        standpoints: &mut [Standpoint],
        mut ask: impl FnMut(u32, Ray, Rgb),
    ) {
        standpoints.sort_by_key(|standpoint| standpoint.sample);
        let places = std::mem::take(&mut self.places);
        let bundle = |standpoint: &Standpoint| places[standpoint.sample as usize].0;
        let mut candidates = Vec::new();
        for group in standpoints.chunk_by(|a, b| bundle(a) == bundle(b)) {
            candidates.clear();
            candidates.extend(group.iter().filter_map(|standpoint| draw(world, standpoint)));
            let partners = &mut self.bundles[bundle(&group[0]) as usize].partners;
            for standpoint in group {
                partners[places[standpoint.sample as usize].1 as usize] = group.len() as f32;
            }
            let chances = chances(&world.lights, &candidates, group);
            if world.lights.is_extended()
                && let Some(lanes) = lanes::Group::new(group)
            {
                pick_side_by_side(world, group, &lanes, &candidates, &chances, &mut ask);
                continue;
            }
            for (k, standpoint) in group.iter().enumerate() {
                if let Some(brought) = pick(world, standpoint, &candidates, &chances, k, group.len()) {
                    ask(standpoint.sample, brought.ray, brought.light);
                }
            }
        }
        self.places = places;
    }

    /// How many paths sampled direct light together at the first point of `sample`.
    pub(crate) fn partners(&self, sample: u32) -> f32 {
        let (bundle, lane) = self.places[sample as usize];
        self.bundles[bundle as usize].partners[lane as usize]
    }
}

/// The candidate that a standpoint contributes.
fn draw(world: &World, standpoint: &Standpoint) -> Option<Candidate> {
    let [choice, u, v, _] = standpoint.numbers;
    let choice = hash::unit_f64(choice);
    let chosen = world.lights.choose(standpoint.exit.position, standpoint.normal(), choice)?;
    world.lights.candidate(chosen.emitter, &world.scene, [u, v].map(hash::unit_f32))
}

/// With which chance each standpoint would choose the emitter of each candidate: `[candidate][standpoint]`.
fn chances(lights: &Lights, candidates: &[Candidate], group: &[Standpoint]) -> Vec<[f32; LANES]> {
    let mut table: Vec<[f32; LANES]> = Vec::with_capacity(candidates.len());
    for (j, candidate) in candidates.iter().enumerate() {
        let same = candidates[..j].iter().position(|other| other.emitter == candidate.emitter);
        table.push(match same {
            Some(same) => table[same],
            None => {
                let mut row = [0.0; LANES];
                for (chance, standpoint) in row.iter_mut().zip(group) {
                    *chance =
                        lights.probability(candidate.emitter, standpoint.exit.position, standpoint.normal());
                }
                row
            }
        });
    }
    table
}

/// The same as [`pick`] for all standpoints of a group at once.
fn pick_side_by_side(
    world: &World,
    group: &[Standpoint],
    lanes: &lanes::Group,
    candidates: &[Candidate],
    chances: &[[f32; LANES]],
    ask: &mut impl FnMut(u32, Ray, Rgb),
) {
    let mut brought = [const { lanes::Bringing::NOTHING }; LANES];
    let mut totals = [0.0_f32; LANES];
    for (j, candidate) in candidates.iter().enumerate() {
        let Some(shone) = world.lights.shone(candidate, &world.scene) else { continue };
        let all: f32 = chances[j][..group.len()].iter().sum();
        let own = chances[j].map(|chance| chance * group.len() as f32);
        let bringing = &mut brought[j];
        dispatch(lanes::Weigh { group: lanes, shone: &shone, own: &own, all, bringing });
        for (total, weight) in totals.iter_mut().zip(&bringing.weight) {
            *total += weight;
        }
    }
    for (k, standpoint) in group.iter().enumerate() {
        let total = totals[k];
        if !(total > 0.0 && total.is_finite()) {
            continue;
        }
        let mut rest = hash::unit_f32(standpoint.numbers[3]) * total;
        let mut picked = None;
        for (j, bringing) in brought[..candidates.len()].iter().enumerate() {
            let weight = bringing.weight[k];
            if weight > 0.0 {
                picked = Some(j);
                if rest < weight {
                    break;
                }
                rest -= weight;
            }
        }
        let Some(j) = picked else { continue };
        let exit = &standpoint.exit;
        let Some(toward) = world.lights.toward(&candidates[j], &world.scene, exit.position) else { continue };
        let [r, g, b] = brought[j].light.map(|channel| channel[k]);
        let ray = match toward.target {
            Some(target) => segment_before(exit.start_toward(toward.incoming), target),
            None => exit.ray_toward(toward.incoming),
        };
        ask(standpoint.sample, ray, Rgb::new(r, g, b) * (total / brought[j].weight[k]));
    }
}

/// One candidate for a standpoint, and what it brings divided by the chance to pick it.
fn pick(
    world: &World,
    standpoint: &Standpoint,
    candidates: &[Candidate],
    chances: &[[f32; LANES]],
    k: usize,
    partners: usize,
) -> Option<Brought> {
    let mut brought = [None; LANES];
    let mut weights = [0.0_f32; LANES];
    let mut total = 0.0;
    for (j, candidate) in candidates.iter().enumerate() {
        let all: f32 = chances[j][..partners].iter().sum();
        brought[j] = bring(world, standpoint, candidate, chances[j][k] * partners as f32, all);
        weights[j] = brought[j].map_or(0.0, |brought| brought.light.max_channel());
        total += weights[j];
    }
    if !(total > 0.0 && total.is_finite()) {
        return None;
    }
    let mut rest = hash::unit_f32(standpoint.numbers[3]) * total;
    let mut picked = None;
    for (j, &weight) in weights.iter().enumerate() {
        if weight > 0.0 {
            picked = Some(j);
            if rest < weight {
                break;
            }
            rest -= weight;
        }
    }
    let picked = picked?;
    let Brought { light, ray } = brought[picked]?;
    Some(Brought { light: light * (total / weights[picked]), ray })
}

/// What a candidate brings a standpoint that would draw it with `own` expected candidates of the bundle, where all together draw it
/// `all` times.
fn bring(
    world: &World,
    standpoint: &Standpoint,
    candidate: &Candidate,
    own: f32,
    all: f32,
) -> Option<Brought> {
    let exit = &standpoint.exit;
    let toward = world.lights.toward(candidate, &world.scene, exit.position)?;
    if !exit.is_honest(toward.incoming) {
        return None;
    }
    let scattered = standpoint.bsdf.evaluate(standpoint.outgoing, standpoint.frame.to_local(toward.incoming));
    let weight = if toward.delta { 1.0 } else { mis::power(own * toward.pdf, scattered.pdf) };
    // Densities of all standpoints are in proportion to their chances, measured here.
    let light = standpoint.throughput * scattered.value * toward.radiance * (weight / (all * toward.pdf));
    if light.is_black() || !light.is_finite() {
        return None;
    }
    let ray = match toward.target {
        Some(target) => segment_before(exit.start_toward(toward.incoming), target),
        None => exit.ray_toward(toward.incoming),
    };
    Some(Brought { light, ray })
}
