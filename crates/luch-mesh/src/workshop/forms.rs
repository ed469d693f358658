//! Ready-made bodies, outlines that become bodies, text.

mod curious;
mod flat;
mod flat_sided;
mod lettering;
mod outlined;
mod round;

use std::ops::RangeInclusive;

use super::{Arguments, Kind, Verb, WorkshopError};
use crate::PolygonMesh;
use crate::generate::{Generator, MAX_DIVISIONS};
use glam::Vec3;

/// The verbs of this group.
pub(super) const VERBS: &[Verb] = &joined::<{ count() }>();

const GROUPS: &[&[Verb]] =
    &[round::VERBS, flat_sided::VERBS, flat::VERBS, curious::VERBS, outlined::VERBS, lettering::VERBS];

const fn count() -> usize {
    let (mut count, mut group) = (0, 0);
    while group < GROUPS.len() {
        count += GROUPS[group].len();
        group += 1;
    }
    count
}

/// All groups one after another.
const fn joined<const COUNT: usize>() -> [Verb; COUNT] {
    let mut verbs = [GROUPS[0][0]; COUNT];
    let (mut place, mut group) = (0, 0);
    while group < GROUPS.len() {
        let mut verb = 0;
        while verb < GROUPS[group].len() {
            verbs[place] = GROUPS[group][verb];
            place += 1;
            verb += 1;
        }
        group += 1;
    }
    verbs
}

/// The most faces a form may have.
const MAX_FACES: u64 = 1 << 26;
/// Lengths that a mesh can keep: squares and cubes of them stay finite in double precision, and they in single.
const LENGTHS: RangeInclusive<f64> = 1e-30..=1e30;
/// A length.
const LENGTH: Kind = Kind::Number { least: *LENGTHS.start(), most: *LENGTHS.end() };
/// A length that may be zero.
const LENGTH_OR_ZERO: Kind = Kind::Number { least: 0.0, most: *LENGTHS.end() };
/// An exponent of a superellipsoid.
const EXPONENT: Kind = Kind::Number { least: 0.1, most: 2.0 };

/// A count of pieces.
const fn pieces(least: u64) -> Kind {
    Kind::Count { least, most: MAX_DIVISIONS as u64 }
}

/// The mesh of a generator, if it is not too large.
fn made(generator: Generator) -> Result<PolygonMesh, WorkshopError> {
    let triangles = generator.triangle_count();
    if triangles > MAX_FACES {
        let message = format!("that would be {triangles} triangles; at most {MAX_FACES} are made");
        return Err(WorkshopError::new(message));
    }
    Ok(generator.polygons())
}

fn too_long() -> String {
    format!("lengths are from {} to {}", LENGTHS.start(), LENGTHS.end())
}

/// Three lengths.
fn size(a: &Arguments, name: &str) -> Result<Vec3, WorkshopError> {
    let size = a.vector(name);
    let fits = size.to_array().iter().all(|side| LENGTHS.contains(side));
    if fits { Ok(size.as_vec3()) } else { Err(WorkshopError::of(name, too_long())) }
}

/// The radius of a hole, which must be less than that of the body.
fn inner_radius(a: &Arguments) -> Result<f32, WorkshopError> {
    let [outer, inner] = ["radius", "inner-radius"].map(|name| a.length(name));
    if inner < outer {
        return Ok(inner);
    }
    Err(WorkshopError::of("inner-radius", format!("found {inner}, expected less than the radius {outer}")))
}

/// Counts of pieces.
fn counts(a: &Arguments, name: &str) -> Result<Vec<u32>, WorkshopError> {
    let whole = |&count: &f64| {
        let fits = count == count.floor() && (1.0..=f64::from(MAX_DIVISIONS)).contains(&count);
        fits.then_some(count as u32)
    };
    let counts: Option<Vec<u32>> = a.numbers(name).iter().map(whole).collect();
    counts.ok_or_else(|| WorkshopError::of(name, format!("expected whole numbers from 1 to {MAX_DIVISIONS}")))
}
