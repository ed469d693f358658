//! Russian roulette: ends paths that carry little, without bias (Arvo and Kirk 1990).

use luch_image::Rgb;

/// Scatterings before roulette begins.
const FREE: u32 = 3;

/// Scatterings from which on no path is sure to survive.
const LONG: u32 = 1024;

/// The factor for paths that go on, or `None` for those that end. `carried` is what the path multiplies light with, radiance scaling
/// by refraction taken out; `chance` is uniform in [0, 1).
pub(crate) fn survive(depth: u32, carried: Rgb, chance: f32) -> Option<f32> {
    if depth < FREE {
        return Some(1.0);
    }
    // In a world of white mirrors nothing else would end a path.
    let most = if depth < LONG { 1.0 } else { 0.99 };
    let survival = carried.max_channel().clamp(0.0, most);
    if survival >= 1.0 {
        Some(1.0)
    } else if chance < survival {
        Some(1.0 / survival)
    } else {
        None
    }
}
