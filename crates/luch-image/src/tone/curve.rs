//! The display curves. All take channels that are finite and not negative.

use crate::Rgb;

/// Luminance that [`reinhard`] turns into white.
const REINHARD_WHITE: f32 = 4.0;

/// Reinhard, Stark, Shirley, Ferwerda, "Photographic tone reproduction for digital images" (2002), equation 4: luminance
/// L becomes L (1 + L/W²) / (1 + L); colours keep their ratio.
pub(super) fn reinhard(light: Rgb) -> Rgb {
    let luminance = light.luminance();
    light * ((1.0 + luminance / (REINHARD_WHITE * REINHARD_WHITE)) / (1.0 + luminance))
}

/// Hable, "Uncharted 2: HDR lighting" (Game Developers Conference 2010) and "Filmic tonemapping operators" (2010):
/// shoulder A, linear strength B and angle C, toe strength D, numerator E and denominator F; exposure bias 2; white 11.2.
pub(super) fn hable(light: f32) -> f32 {
    let (a, b, c, d, e, f) = (0.15, 0.5, 0.1, 0.2, 0.02, 0.3);
    let curve = |x: f32| (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f;
    curve(2.0 * light) / curve(11.2)
}

/// Hill's fit of ACES 1.0 (reference rendering transform and sRGB output), as in Pettineo's "BakingLab" (2016): into the
/// rendering space with some desaturation, a rational curve, and back.
pub(super) fn aces(light: Rgb) -> Rgb {
    let fit =
        |v: f32| (v * (v + 0.024_578_6) - 0.000_090_537) / (v * (0.983_729 * v + 0.432_951) + 0.238_081);
    let rendered = transform(&ACES_IN, light).map(fit);
    transform(&ACES_OUT, rendered)
}

const ACES_IN: [[f32; 3]; 3] =
    [[0.597_19, 0.354_58, 0.048_23], [0.076_00, 0.908_34, 0.015_66], [0.028_40, 0.133_83, 0.837_77]];

const ACES_OUT: [[f32; 3]; 3] =
    [[1.604_75, -0.531_08, -0.073_67], [-0.102_08, 1.108_13, -0.006_05], [-0.003_27, -0.072_76, 1.076_02]];

/// Sobotka's AgX (2022) in Wrensch's short form, "Minimal AgX implementation" (2023): inset, logarithm between −12.47 and
/// 4.026 stops, a polynomial for the curve, outset, and the display's power 2.2 undone.
pub(super) fn agx(light: Rgb) -> Rgb {
    let (darkest, brightest) = (-12.473_93, 4.026_069);
    let shown = transform(&AGX_IN, light).map(|v| {
        let stops = libm::log2f(v.max(1e-10)).clamp(darkest, brightest);
        agx_contrast((stops - darkest) / (brightest - darkest))
    });
    transform(&AGX_OUT, shown).map(|v| libm::powf(v.max(0.0), 2.2))
}

fn agx_contrast(x: f32) -> f32 {
    let coefficients = [15.5, -40.14, 31.96, -6.868, 0.4298, 0.1191, -0.00232];
    coefficients.into_iter().fold(0.0, |sum, coefficient| sum * x + coefficient)
}

const AGX_IN: [[f32; 3]; 3] = [
    [0.842_479_06, 0.078_433_6, 0.079_223_745],
    [0.042_328_242, 0.878_468_64, 0.079_166_13],
    [0.042_375_655, 0.078_433_6, 0.879_143],
];

const AGX_OUT: [[f32; 3]; 3] = [
    [1.196_879, -0.098_020_88, -0.099_029_74],
    [-0.052_896_852, 1.151_903_1, -0.098_961_177],
    [-0.052_971_636, -0.098_043_45, 1.151_073_7],
];

/// "Khronos PBR neutral tone mapper" (2024): takes away the 4 % that a dielectric reflects, and compresses and
/// desaturates what is brighter than 0.8.
pub(super) fn pbr_neutral(light: Rgb) -> Rgb {
    let (fresnel, desaturation) = (0.04, 0.15);
    let start = 0.8 - fresnel;
    let least = light.r.min(light.g).min(light.b);
    let offset = if least < 2.0 * fresnel { least - least * least / (4.0 * fresnel) } else { fresnel };
    let color = light - Rgb::gray(offset);
    let peak = color.max_channel();
    if peak < start {
        return color;
    }
    let room = 1.0 - start;
    let new_peak = 1.0 - room * room / (peak + room - start);
    let white = 1.0 - 1.0 / (desaturation * (peak - new_peak) + 1.0);
    (color * (new_peak / peak)).lerp(Rgb::gray(new_peak), white)
}

fn transform(rows: &[[f32; 3]; 3], v: Rgb) -> Rgb {
    let [r, g, b] = rows.map(|row| row[0] * v.r + row[1] * v.g + row[2] * v.b);
    Rgb::new(r, g, b)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Both published matrices map white to white and undo one another (those of AgX exactly, those of ACES with the
    /// desaturation that is part of the fit, so only white is checked).
    #[test]
    fn published_matrices_agree() {
        for matrix in [&ACES_IN, &ACES_OUT, &AGX_IN, &AGX_OUT] {
            for channel in transform(matrix, Rgb::WHITE).to_array() {
                assert!((channel - 1.0).abs() < 2e-4, "{matrix:?}");
            }
        }
        for color in [Rgb::new(1.0, 0.0, 0.0), Rgb::new(0.2, 0.7, 0.1), Rgb::new(0.0, 0.3, 2.0)] {
            let again = transform(&AGX_OUT, transform(&AGX_IN, color));
            assert!((again - color).map(f32::abs).max_channel() < 1e-5, "{again:?}");
        }
    }
}
