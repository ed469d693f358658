//! Which lamps of a scene a point sees, and how much light comes from each: the lecture's lamp problem for any scene.
//!
//! A lamp with a surface is sampled evenly by area; a ray from the point tells whether the place is seen. The share that is seen is
//! the visible fraction; radiance times cosines over squared distance, times the area, is the irradiance.
//!
//! ```
//! use glam::Vec3;
//! use luch_lab::direct_light::{Query, direct_light};
//! use luch_lab::integral::HashedPoints;
//!
//! let world = luch_render::World::build(luch_scene::preset::cornell_box())?;
//! let query = Query { at: Vec3::new(0.0, 0.5, 0.0), normal: Vec3::Y, samples: 1024, points: &HashedPoints { seed: 1 } };
//! let found = direct_light(&world, &query, &|_| true, &|_, _| {});
//! assert!(found.lamps.len() == 1 && found.total.mean >= 0.0);
//! # Ok::<(), luch_render::UnsoundScene>(())
//! ```

mod lamp;
mod sky;
#[cfg(test)]
mod tests;

use crate::integral::Points;
use glam::Vec3;
use lamp::{Lamp, Sample};
use luch_render::World;
use luch_scene::Scene;
use rayon::prelude::*;
use serde::Serialize;

/// Independent randomisations.
const REPLICATES: u64 = 16;

/// Numbers that a sample takes.
pub const DIMENSIONS: usize = 4;

/// What is asked.
pub struct Query<'a> {
    /// The point, metres.
    pub at: Vec3,
    /// Which way the surface at the point faces; of any length but zero.
    pub normal: Vec3,
    /// Samples of each lamp; at least 32 are taken.
    pub samples: u64,
    /// Where they come from, in four dimensions.
    pub points: &'a dyn Points,
}

/// A mean and its standard error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Measured {
    /// The mean.
    pub mean: f64,
    /// Its standard error, from independent randomisations.
    pub standard_error: f64,
}

/// What a lamp is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum LampKind {
    /// Triangles, a sphere or a disc: sampled by area.
    Surface,
    /// A shape without a known area: found by rays over the hemisphere.
    Form,
    /// A point or a spot.
    Point,
    /// A sun.
    Sun,
    /// The environment.
    Sky,
}

impl LampKind {
    /// The name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Surface => "surface",
            Self::Form => "form",
            Self::Point => "point",
            Self::Sun => "sun",
            Self::Sky => "sky",
        }
    }
}

/// What came from a lamp.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LampSeen {
    /// As the scene calls it, or kind and number.
    pub name: String,
    /// What it is.
    pub kind: LampKind,
    /// Of a surface, square metres.
    pub area: Option<f64>,
    /// The share of its area that has a free line to the point, wherever the point faces; of a sun the share of its disc, of the sky
    /// that of the hemisphere above the surface, weighed by the cosine. `None` for forms without a known area.
    pub visible: Option<Measured>,
    /// Irradiance as luminance, W·m⁻².
    pub irradiance: Measured,
    /// Irradiance in red, green and blue.
    pub color: [f64; 3],
}

/// What came from all lamps that were asked for.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DirectLight {
    /// In the order of the scene: surfaces, lights, the sky.
    pub lamps: Vec<LampSeen>,
    /// The sum of their irradiances as luminance.
    pub total: Measured,
}

/// Names of all lamps of a scene, in the order of the results.
pub fn names(scene: &Scene) -> Vec<String> {
    Lamp::of_scene(scene).into_iter().map(|lamp| lamp.name).collect()
}

/// Measures the lamps whose names are wanted. Direct light only: what passes glass or mirrors does not count, and what stands between
/// hides wholly, unless its opacity says otherwise. `progress` is told how much is done and of how much.
pub fn direct_light(
    world: &World,
    query: &Query<'_>,
    wanted: &dyn Fn(&str) -> bool,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> DirectLight {
    let lamps: Vec<Lamp> =
        Lamp::of_scene(&world.scene).into_iter().filter(|lamp| wanted(&lamp.name)).collect();
    let normal = query.normal.try_normalize().unwrap_or(Vec3::Y);
    let receiver = lamp::Receiver::new(world, query.at, normal);
    let each = (query.samples / REPLICATES).max(2);
    let mut totals = [0.0; REPLICATES as usize];
    let mut found = Vec::new();
    for (number, lamp) in lamps.iter().enumerate() {
        let replicates: Vec<Sample> = (0..REPLICATES)
            .into_par_iter()
            .map(|replicate| lamp.mean(&receiver, query.points, number as u64 * REPLICATES + replicate, each))
            .collect();
        for (total, sample) in totals.iter_mut().zip(&replicates) {
            *total += luminance(sample.light);
        }
        let visible: Vec<f64> = replicates.iter().map(|sample| sample.seen).collect();
        let light: Vec<f64> = replicates.iter().map(|sample| luminance(sample.light)).collect();
        let channel =
            |c: usize| replicates.iter().map(|sample| sample.light[c]).sum::<f64>() / REPLICATES as f64;
        found.push(LampSeen {
            name: lamp.name.clone(),
            kind: lamp.kind(),
            area: lamp.area(),
            visible: (lamp.kind() != LampKind::Form).then(|| measured(&visible)),
            irradiance: measured(&light),
            color: [channel(0), channel(1), channel(2)],
        });
        progress(number + 1, lamps.len());
    }
    DirectLight { lamps: found, total: measured(&totals) }
}

fn luminance([r, g, b]: [f64; 3]) -> f64 {
    f64::from(luch_image::Rgb::new(r as f32, g as f32, b as f32).luminance())
}

fn measured(values: &[f64]) -> Measured {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / (n - 1.0);
    Measured { mean, standard_error: (variance / n).sqrt() }
}
