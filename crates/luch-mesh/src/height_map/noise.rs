//! Gradient noise in the plane (Perlin 1985), with the blend of fifth degree of Perlin (2002).

use glam::DVec2;
use luch_sampling::hash::{combine, mix64};

/// Noise of a seed.
pub(super) struct Noise {
    seed: u64,
    /// Unit vectors, evenly around.
    directions: [DVec2; 16],
}

impl Noise {
    pub(super) fn new(seed: u64) -> Self {
        let angle = |k: usize| (k as f64 + 0.5) * (std::f64::consts::TAU / 16.0);
        Self {
            seed,
            directions: std::array::from_fn(|k| DVec2::new(libm::cos(angle(k)), libm::sin(angle(k)))),
        }
    }

    /// A number from −1 to 1, zero at whole points.
    pub(super) fn at(&self, point: DVec2) -> f64 {
        let cell = point.floor();
        let inside = point - cell;
        let corner = |i: f64, j: f64| {
            let whole = cell + DVec2::new(i, j);
            // Conversions from float to integer saturate.
            let hash = combine(combine(self.seed, whole.x as i64 as u64), whole.y as i64 as u64);
            self.directions[(hash >> 60) as usize].dot(inside - DVec2::new(i, j))
        };
        let blend = |t: f64| t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
        let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
        let (s, t) = (blend(inside.x), blend(inside.y));
        let value =
            mix(mix(corner(0.0, 0.0), corner(1.0, 0.0), s), mix(corner(0.0, 1.0), corner(1.0, 1.0), s), t);
        // In the middle of a cell four unit vectors reach √½ together.
        (value * std::f64::consts::SQRT_2).clamp(-1.0, 1.0)
    }
}

/// A number from −1 to 1 that belongs to a whole point.
pub(super) fn chance(seed: u64, column: u64, row: u64) -> f64 {
    let hash = combine(combine(mix64(seed.wrapping_add(1)), column), row);
    (hash >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_zero_at_whole_points_smooth_and_fair() {
        let noise = Noise::new(7);
        let (mut sum, mut squares) = (0.0, 0.0);
        for k in 0..10_000 {
            let point = DVec2::new(f64::from(k % 100), f64::from(k / 100));
            assert_eq!(noise.at(point), 0.0);
            let here = point + DVec2::new(chance(1, k as u64, 0), chance(1, k as u64, 1));
            let value = noise.at(here);
            // Slopes of gradient noise stay below 15/8 · 2 + 1, times √2.
            assert!((noise.at(here + DVec2::splat(1e-6)) - value).abs() < 1.5e-5);
            sum += value;
            squares += value * value;
        }
        let (mean, deviation) = (sum / 1e4, (squares / 1e4).sqrt());
        assert!(deviation > 0.2 && deviation < 0.6, "{deviation}");
        // Neighbouring samples share cells: at least one in four is independent.
        assert!(mean.abs() < 4.0 * deviation / 50.0, "{mean}");
    }
}
