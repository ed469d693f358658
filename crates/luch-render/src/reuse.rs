//! Neighbouring pixels share the second halves of their paths.
//!
//! Bekaert, Sbert, Halton, "Accelerating Path Tracing by Re-Using Paths" (2002). The paths of a *bundle*, the pixels of a small
//! block with the same sample index, scatter at their first points x₁ and arrive at second points x₂. Each x₂ and the light
//! found from there on serves every path of the bundle that sees it, weighted by the balance heuristic over all who could have
//! found it: with p(m → j) the density, per area at point j, with which path m finds it, zero where m does not see it,
//!
//! ```text
//! radiance of path k = Σ_j  f(k → j) G(k, j) V(k, j) · L(j) / Σ_m p(m → j)
//! ```
//!
//! Every visibility is tested, so the weights are exact and the mean of every pixel is what it was; pixels of a bundle now
//! share part of their noise. What a sample is depends on pixel and index still: bundles are cut by the picture alone.
//!
//! Points of mirrors and clear glass do not take part: the path passes over them. Second points that shine are found by light
//! sampling as well (`direct.rs`), weighted by the power heuristic of both densities, each the sum over the bundle. Second
//! points of metal send everyone something else (`glint.rs`). Surfaces that have no vector code, plastic or ground glass, take part in
//! direct light alone.

mod direct;
mod echo;
mod glint;
mod lamp;
mod points;
mod scatterers;
mod share;

pub(crate) use direct::Standpoint;
pub(crate) use echo::Lucky;
pub(crate) use glint::Lit;
pub(crate) use scatterers::Scatterer;

use crate::surface::{Exit, segment_before};
use crate::world::World;
use glam::Vec3;
use glint::{Glint, Met};
use luch_bvh::simd::dispatch;
use luch_bvh::{Coherence, Ray};
use luch_image::Rgb;
use points::{Densities, LANES, Points};
use scatterers::{Optics, Scatterers};
use share::Share;

/// Bundles whose visibilities are asked for together: their rays stay in the cache.
const TOGETHER: usize = 16;

/// A table of numbers for each second point of a bundle (row) and each first point (column).
type Table = [[f32; LANES]; LANES];

/// The first two points of all paths of a wave, and the light found past the second.
#[derive(Debug, Default)]
pub(crate) struct Reuse {
    /// Those in use come first; the others are memory.
    bundles: Vec<Bundle>,
    used: usize,
    /// For each sample its bundle and its lane there.
    places: Vec<(u32, u32)>,
    tables: Vec<Table>,
    lucky: Vec<Lucky>,
    rays: Vec<Ray>,
    occluded: Vec<bool>,
}

/// The paths of one bundle.
#[derive(Clone, Debug, Default)]
struct Bundle {
    /// Where paths scattered first.
    firsts: Scatterers,
    /// Where they arrived second.
    seconds: Points,
    /// What light from the first point is multiplied by on the way to the camera.
    gains: [Rgb; LANES],
    /// Light that second points send alike to all.
    tails: [Rgb; LANES],
    /// Second points that do not.
    glints: Vec<Glint>,
    /// How many paths sampled direct light together with each.
    partners: [f32; LANES],
    /// The first sample of the bundle.
    start: u32,
}

impl Reuse {
    /// Begins a wave of samples; `bundles` gives the number of the bundle of each in turn.
    pub(crate) fn start(&mut self, bundles: impl Iterator<Item = u32>) {
        let reuse = self;
        reuse.used = 0;
        reuse.places.clear();
        reuse.lucky.clear();
        let (mut last, mut lane) = (None, 0);
        for (i, number) in bundles.enumerate() {
            if last != Some(number) || lane == LANES {
                if reuse.used == reuse.bundles.len() {
                    reuse.bundles.push(Bundle::default());
                }
                reuse.bundles[reuse.used].clear(i as u32);
                reuse.used += 1;
                (last, lane) = (Some(number), 0);
            }
            reuse.places.push((reuse.used as u32 - 1, lane as u32));
            lane += 1;
        }
    }

    /// The path of `sample` scattered first, at a diffuse surface; `gain` is the throughput of the way from the camera.
    pub(crate) fn set_first_diffuse(&mut self, sample: u32, exit: &Exit, depth: u32, gain: Rgb, albedo: Rgb) {
        let (bundle, lane) = self.place(sample);
        bundle.firsts.set_diffuse(lane, exit, depth, albedo);
        bundle.gains[lane] = gain;
    }

    /// The path of `sample` scattered first, at any surface that is not a mirror.
    pub(crate) fn set_first(&mut self, sample: u32, scatterer: &Scatterer, depth: u32, gain: Rgb) {
        let (bundle, lane) = self.place(sample);
        bundle.firsts.set(lane, scatterer, depth);
        bundle.gains[lane] = gain;
    }

    /// The path of `sample` arrived second at a surface that sends the same to all: it is diffuse, or it shines.
    pub(crate) fn set_second(&mut self, sample: u32, exit: &Exit, depth: u32) {
        let (bundle, lane) = self.place(sample);
        bundle.seconds.set(lane, exit, depth);
    }

    /// The path of `sample` arrived second at a metal, which sends everyone something else.
    pub(crate) fn set_glint(&mut self, sample: u32, exit: &Exit, optics: Optics, depth: u32) {
        let (bundle, lane) = self.place(sample);
        bundle.seconds.set(lane, exit, depth);
        let normal = exit.normal;
        bundle.glints.push(Glint {
            lane,
            optics,
            normal,
            lit: None,
            way: None,
            met: Vec::new(),
            tail: Rgb::BLACK,
        });
    }

    /// The light that was sampled at the second point of `sample`, a glint; not yet known to be free.
    pub(crate) fn set_lit(&mut self, sample: u32, lit: Lit) {
        if let Some(glint) = self.glint(sample) {
            glint.lit = Some(lit);
        }
    }

    /// That light is free.
    pub(crate) fn set_free(&mut self, sample: u32) {
        if let Some(lit) = self.glint(sample).and_then(|glint| glint.lit.as_mut()) {
            lit.is_free = true;
        }
    }

    /// The path of `sample` goes on from its second point, a glint.
    pub(crate) fn set_way(&mut self, sample: u32, direction: Vec3) {
        if let Some(glint) = self.glint(sample) {
            glint.way = Some(direction);
        }
    }

    /// The path of `sample` met a lamp on the way from a glint; light sampling there had density `pdf` for it.
    pub(crate) fn meet(&mut self, sample: u32, light: Rgb, pdf: f32) {
        if let Some(glint) = self.glint(sample) {
            glint.met.push(Met { light, pdf });
        }
    }

    /// Adds light that the path of `sample` found past its second point, or that this point sends itself.
    pub(crate) fn add(&mut self, sample: u32, light: Rgb) {
        if let Some(glint) = self.glint(sample) {
            glint.tail += light;
        } else {
            let (bundle, lane) = self.place(sample);
            bundle.tails[lane] += light;
        }
    }

    /// A path found light over mirrors or glass after its first point.
    pub(crate) fn add_lucky(&mut self, lucky: Lucky) {
        self.lucky.push(lucky);
    }

    fn glint(&mut self, sample: u32) -> Option<&mut Glint> {
        let (bundle, lane) = self.place(sample);
        bundle.glints.iter_mut().find(|glint| glint.lane == lane)
    }

    fn place(&mut self, sample: u32) -> (&mut Bundle, usize) {
        let (bundle, lane) = self.places[sample as usize];
        (&mut self.bundles[bundle as usize], lane as usize)
    }

    /// Hands every path its share of all the light that the bundle found together.
    pub(crate) fn share(&mut self, world: &World, max_depth: u32, radiance: &mut [Rgb]) {
        self.connect(world);
        for (bundle, table) in self.bundles[..self.used].iter().zip(&self.tables) {
            dispatch(Share { bundle, table, radiance: &mut radiance[bundle.start as usize..] });
        }
        self.echo(world, max_depth, radiance);
    }

    /// Finds who sees whose second point, and what that counts.
    fn connect(&mut self, world: &World) {
        if self.tables.len() < self.used {
            self.tables.resize(self.used, [[0.0; LANES]; LANES]);
        }
        let Self { bundles, used, tables, rays, occluded, .. } = self;
        let bundles = &bundles[..*used];
        for (bundles, tables) in bundles.chunks(TOGETHER).zip(tables.chunks_mut(TOGETHER)) {
            rays.clear();
            for (bundle, table) in bundles.iter().zip(&mut *tables) {
                dispatch(Densities { firsts: &bundle.firsts, seconds: &bundle.seconds, table });
                bundle.ask(table, rays);
            }
            occluded.clear();
            occluded.resize(rays.len(), false);
            world.geometry.occluded(&world.scene, rays, occluded, Coherence::Coherent, |_| 0);
            let mut answers = occluded.chunks_exact(LANES);
            for (bundle, table) in bundles.iter().zip(&mut *tables) {
                bundle.weigh(table, &mut answers);
            }
        }
    }
}

impl Bundle {
    fn clear(&mut self, start: u32) {
        self.firsts.clear();
        self.seconds.clear();
        self.tails = [Rgb::BLACK; LANES];
        self.glints.clear();
        self.start = start;
    }

    /// Whether anything is known to come from a second point.
    fn sends(&self, lane: usize) -> bool {
        self.seconds.is_set(lane)
            && (!self.tails[lane].is_black()
                || self.glints.iter().any(|glint| glint.lane == lane && glint.sends()))
    }

    /// Appends a group of rays for each second point that others might see, one for each lane.
    fn ask(&self, table: &Table, rays: &mut Vec<Ray>) {
        for (j, row) in table.iter().enumerate() {
            if !self.sends(j) {
                continue;
            }
            let target = self.seconds.near(j);
            for (k, &density) in row.iter().enumerate() {
                let asked = density > 0.0 && k != j;
                let start = || self.firsts.start_toward(k, target - self.firsts.points.position(k));
                rays.push(if asked { segment_before(start(), target) } else { NO_RAY });
            }
        }
    }

    /// Turns densities into weights: zero for whom the point is hidden from, then divided by the sum of all.
    fn weigh<'a>(&self, table: &mut Table, answers: &mut impl Iterator<Item = &'a [bool]>) {
        for (j, row) in table.iter_mut().enumerate() {
            if !self.sends(j) {
                continue;
            }
            let hidden = answers.next().unwrap_or(&[]);
            for (k, (density, &hidden)) in row.iter_mut().zip(hidden).enumerate() {
                if hidden && k != j {
                    *density = 0.0;
                }
            }
            let sum: f32 = row.iter().sum();
            let scale = if sum > 0.0 { 1.0 / sum } else { 0.0 };
            // A density too small to divide by: whoever found the point keeps it.
            if scale.is_finite() {
                row.iter_mut().for_each(|density| *density *= scale);
            } else {
                *row = std::array::from_fn(|k| f32::from(u8::from(k == j)));
            }
        }
    }
}

/// A ray that meets nothing.
const NO_RAY: Ray = Ray { origin: Vec3::ZERO, direction: Vec3::Z, t_min: 1.0, t_max: 0.0 };
