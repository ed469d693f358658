//! Sines, cosines and angles for warps, in single precision: polynomials without a branch.
//!
//! Every step is an addition, a multiplication or a choice, so a loop over lanes becomes vector code and gives the bits of the
//! scalar call. Coefficients are Chebyshev fits of the series, rounded once; errors are measured in the tests.

use std::f32::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// Sine and cosine of an angle of at most π/4 to either side; error at most 1·10⁻⁷.
#[inline(always)]
pub fn sin_cos_eighth(angle: f32) -> [f32; 2] {
    let square = angle * angle;
    let sine =
        angle + angle * square * (-0.166_666_64 + square * (0.008_332_749 + square * -0.000_195_879_56));
    let quartic = square * square;
    let cosine = 1.0 - 0.5 * square
        + quartic * (0.041_666_664 + square * (-0.001_388_829_9 + square * 2.454_660_5e-5));
    [sine, cosine]
}

/// Sine and cosine of an angle counted in whole turns, 0 to 1; error at most 3·10⁻⁷.
#[inline(always)]
pub fn sin_cos_turns(turns: f32) -> [f32; 2] {
    // The nearest quarter, and what is left: at most an eighth of a turn, found without rounding.
    let quarters = (4.0 * turns + 0.5).floor();
    let [sine, cosine] = sin_cos_eighth((turns - 0.25 * quarters) * (2.0 * PI));
    let quarter = quarters as i32;
    let (first, second) = if quarter & 1 == 0 { (sine, cosine) } else { (cosine, sine) };
    let sine = if quarter & 2 == 0 { first } else { -first };
    let cosine = if quarter.wrapping_add(1) & 2 == 0 { second } else { -second };
    [sine, cosine]
}

/// The angle of the point (`x`, `y`) from the x axis, −π to π; 0 for the origin. Error at most 4·10⁻⁷.
#[inline(always)]
pub fn angle(y: f32, x: f32) -> f32 {
    let (width, height) = (x.abs(), y.abs());
    let (less, more) = if height > width { (width, height) } else { (height, width) };
    let ratio = less / if more > 0.0 { more } else { 1.0 };
    let square = ratio * ratio;
    const SERIES: [f32; 9] = [
        1.0,
        -0.333_330_66,
        0.199_924_84,
        -0.142_025_71,
        0.106_367_54,
        -0.074_954_46,
        0.042_587_608,
        -0.016_005_03,
        0.002_834_064_2,
    ];
    let mut sum = SERIES[8];
    for coefficient in SERIES[..8].iter().rev() {
        sum = sum * square + coefficient;
    }
    let eighth = ratio * sum;
    let quarter = if height > width { FRAC_PI_2 - eighth } else { eighth };
    let half = if x < 0.0 { PI - quarter } else { quarter };
    if y < 0.0 { -half } else { half }
}

/// A point of the unit disc from the square [−1, 1]²: the concentric map of Shirley and Chiu (1997), in Cline's form.
#[inline(always)]
pub(crate) fn concentric(x: f32, y: f32) -> [f32; 2] {
    // Squares about the centre become circles; the angle runs along the longer coordinate's eighth.
    let wide = x.abs() > y.abs();
    let (radius, other) = if wide { (x, y) } else { (y, x) };
    let divisor = if radius == 0.0 { 1.0 } else { radius };
    let [sine, cosine] = sin_cos_eighth(FRAC_PI_4 * (other / divisor));
    let (along, across) = (radius * cosine, radius * sine);
    if wide { [along, across] } else { [across, along] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sines_and_cosines_are_near_the_exact_ones() {
        let mut worst = 0.0_f64;
        for i in 0..=1_000_000 {
            let turns = i as f32 / 1_000_000.0;
            let (sine, cosine) = libm::sincos(2.0 * std::f64::consts::PI * f64::from(turns));
            let [s, c] = sin_cos_turns(turns);
            worst = worst.max((f64::from(s) - sine).abs()).max((f64::from(c) - cosine).abs());
        }
        assert!(worst < 3e-7, "{worst:e}");
    }

    #[test]
    fn angles_are_near_the_exact_ones() {
        let mut worst = 0.0_f64;
        for i in 0..100_000 {
            let (sine, cosine) = libm::sincos(2.0 * std::f64::consts::PI * f64::from(i) / 100_000.0);
            for radius in [1.0, 1e-20, 1e20] {
                let (x, y) = ((radius * cosine) as f32, (radius * sine) as f32);
                worst = worst.max((f64::from(angle(y, x)) - libm::atan2(f64::from(y), f64::from(x))).abs());
            }
        }
        assert!(worst < 4e-7, "{worst:e}");
        assert_eq!((angle(0.0, 0.0), angle(0.0, 1.0), angle(1.0, 0.0)), (0.0, 0.0, FRAC_PI_2));
        assert_eq!((angle(0.0, -1.0), angle(-2.0, 0.0)), (PI, -FRAC_PI_2));
    }
}
