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
//! Only diffuse first points take part, and second points whose light does not depend on who looks: diffuse ones. There f G is
//! p but for the albedo, so one table of densities is all there is.

mod direct;
mod echo;
mod points;

pub(crate) use direct::Standpoint;
pub(crate) use echo::Lucky;

use crate::surface::{Exit, segment_before};
use crate::world::World;
use glam::Vec3;
use luch_bvh::simd::{Task, dispatch};
use luch_bvh::{Coherence, Ray};
use luch_image::Rgb;
use points::{Densities, LANES, Points};

/// Bundles whose visibilities are asked for together: their rays stay in the cache.
const TOGETHER: usize = 16;

/// A table of numbers for each second point of a bundle (row) and each first point (column).
type Table = [[f32; LANES]; LANES];

/// The first two points of all paths of a wave, and the light found past the second.
#[derive(Debug, Default)]
pub(crate) struct Reuse {
    bundles: Vec<Bundle>,
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
    firsts: Points,
    /// Where they arrived second.
    seconds: Points,
    /// What light scattered at the first point is multiplied by: albedo, and the way from the camera.
    gains: [Rgb; LANES],
    /// Light past the second point, for a throughput of one there.
    tails: [Rgb; LANES],
    /// How many paths sampled direct light together with each.
    partners: [f32; LANES],
    /// The first sample of the bundle.
    start: u32,
}

impl Reuse {
    /// Begins a wave of samples; `bundles` gives the number of the bundle of each in turn.
    pub(crate) fn start(&mut self, bundles: impl Iterator<Item = u32>) {
        let reuse = self;
        reuse.bundles.clear();
        reuse.places.clear();
        reuse.lucky.clear();
        let (mut last, mut lane) = (None, 0);
        for (i, number) in bundles.enumerate() {
            if last != Some(number) || lane == LANES {
                reuse.bundles.push(Bundle { start: i as u32, ..Bundle::default() });
                (last, lane) = (Some(number), 0);
            }
            reuse.places.push((reuse.bundles.len() as u32 - 1, lane as u32));
            lane += 1;
        }
    }

    /// The path of `sample` scattered first at a diffuse surface.
    ///
    /// `gain` is its albedo times the throughput of the way from the camera.
    pub(crate) fn set_first(&mut self, sample: u32, exit: &Exit, depth: u32, gain: Rgb) {
        let (bundle, lane) = self.place(sample);
        bundle.firsts.set(lane, exit, depth);
        bundle.gains[lane] = gain;
    }

    /// The path of `sample` arrived second at a diffuse surface.
    pub(crate) fn set_second(&mut self, sample: u32, exit: &Exit, depth: u32) {
        let (bundle, lane) = self.place(sample);
        bundle.seconds.set(lane, exit, depth);
    }

    /// Adds light that the path of `sample` found past its second point.
    pub(crate) fn add(&mut self, sample: u32, light: Rgb) {
        let (bundle, lane) = self.place(sample);
        bundle.tails[lane] += light;
    }

    /// A path found light over mirrors or glass after its first point.
    pub(crate) fn add_lucky(&mut self, lucky: Lucky) {
        self.lucky.push(lucky);
    }

    fn place(&mut self, sample: u32) -> (&mut Bundle, usize) {
        let (bundle, lane) = self.places[sample as usize];
        (&mut self.bundles[bundle as usize], lane as usize)
    }

    /// Hands every path its share of all the light that the bundle found together.
    pub(crate) fn share(&mut self, world: &World, max_depth: u32, radiance: &mut [Rgb]) {
        self.connect(world);
        for (bundle, table) in self.bundles.iter().zip(&self.tables) {
            dispatch(Share { bundle, table, radiance: &mut radiance[bundle.start as usize..] });
        }
        self.echo(world, max_depth, radiance);
    }

    /// Finds who sees whose second point, and what that counts.
    fn connect(&mut self, world: &World) {
        self.tables.resize(self.bundles.len(), [[0.0; LANES]; LANES]);
        let Self { bundles, tables, rays, occluded, .. } = self;
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
    /// Appends a group of rays for each second point that others might see, one for each lane.
    fn ask(&self, table: &Table, rays: &mut Vec<Ray>) {
        for (j, row) in table.iter().enumerate() {
            if !self.seconds.is_set(j) {
                continue;
            }
            let target = self.seconds.near(j);
            for (k, &density) in row.iter().enumerate() {
                let asked = density > 0.0 && k != j;
                rays.push(if asked { segment_before(self.firsts.near(k), target) } else { NO_RAY });
            }
        }
    }

    /// Turns densities into weights: zero for whom the point is hidden from, then divided by the sum of all.
    fn weigh<'a>(&self, table: &mut Table, answers: &mut impl Iterator<Item = &'a [bool]>) {
        for (j, row) in table.iter_mut().enumerate() {
            if !self.seconds.is_set(j) {
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

/// Sums the tails by weight, for all lanes at once.
struct Share<'a> {
    bundle: &'a Bundle,
    table: &'a Table,
    radiance: &'a mut [Rgb],
}

impl Task for Share<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let mut sums = [[0.0_f32; LANES]; 3];
        for (row, tail) in self.table.iter().zip(&self.bundle.tails) {
            for (sum, tail) in sums.iter_mut().zip(tail.to_array()) {
                for k in 0..LANES {
                    sum[k] += row[k] * tail;
                }
            }
        }
        for (k, gain) in self.bundle.gains.iter().enumerate() {
            if self.bundle.firsts.is_set(k) {
                self.radiance[k] += *gain * Rgb::new(sums[0][k], sums[1][k], sums[2][k]);
            }
        }
    }
}
