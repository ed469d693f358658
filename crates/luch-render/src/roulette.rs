//! Russian roulette: ends paths that carry little, without bias (Arvo and Kirk 1990).

use luch_image::Rgb;

/// Scatterings before roulette begins.
const FREE: u32 = 3;

/// Scatterings from which on no path is sure to survive.
const LONG: u32 = 1024;

/// The probability to go on of a path that scattered `depth` times and multiplies light by at most `most`, radiance scaling by
/// refraction taken out. Above 0 it is at least so large that its reciprocal is finite.
#[inline(always)]
pub(crate) fn survival(depth: u32, most: f32) -> f32 {
    if depth < FREE {
        return 1.0;
    }
    // In a world of white mirrors nothing else would end a path.
    let limit = if depth < LONG { 1.0 } else { 0.99 };
    let bounded = if most < limit { most } else { limit };
    if bounded > f32::MIN_POSITIVE { bounded } else { 0.0 }
}

/// The factor for paths that go on, or `None` for those that end; `chance` is uniform in [0, 1).
pub(crate) fn survive(depth: u32, carried: Rgb, chance: f32) -> Option<f32> {
    let survival = survival(depth, carried.max_channel());
    (chance < survival).then(|| 1.0 / survival)
}
