//! Spectra become linear red, green and blue, as Mitsuba's RGB variants reduce them.
//!
//! The colour matching functions are the multi-lobe fits of Wyman, Sloan and Shirley (*Simple analytic approximations to the CIE XYZ
//! color matching functions*, 2013), each scaled so that the constant spectrum 1 has X = Y = Z = 1.

use super::literal;
use super::tree::Value;
use crate::scene_file::clip;
use luch_image::Rgb;

/// Visible wavelengths, nanometres.
const SHORTEST: f64 = 360.0;
const LONGEST: f64 = 830.0;

/// Points of the integral.
const STEPS: usize = 470;

/// One lobe: height, middle, and inverse widths below and above it.
type Lobe = [f64; 4];

const X: [Lobe; 3] = [
    [1.056, 599.8, 1.0 / 37.9, 1.0 / 31.0],
    [0.362, 442.0, 1.0 / 16.0, 1.0 / 26.7],
    [-0.065, 501.1, 1.0 / 20.4, 1.0 / 26.2],
];
const Y: [Lobe; 2] = [[0.821, 568.8, 1.0 / 46.9, 1.0 / 40.5], [0.286, 530.9, 1.0 / 16.3, 1.0 / 31.1]];
const Z: [Lobe; 2] = [[1.217, 437.0, 1.0 / 11.8, 1.0 / 36.0], [0.681, 459.0, 1.0 / 26.0, 1.0 / 13.8]];

fn lobes(lobes: &[Lobe], wavelength: f64) -> f64 {
    let lobe = |&[height, middle, below, above]: &Lobe| {
        let t = (wavelength - middle) * if wavelength < middle { below } else { above };
        height * libm::exp(-0.5 * t * t)
    };
    lobes.iter().map(lobe).sum()
}

/// The colour of light whose power per wavelength is `power`, of which 1 at all wavelengths is as bright as white.
fn light(power: impl Fn(f64) -> f64) -> Rgb {
    let (mut sums, mut wholes) = ([0.0; 3], [0.0; 3]);
    for step in 0..STEPS {
        let wavelength = SHORTEST + (step as f64 + 0.5) / STEPS as f64 * (LONGEST - SHORTEST);
        let value = power(wavelength);
        let matches = [lobes(&X, wavelength), lobes(&Y, wavelength), lobes(&Z, wavelength)];
        for (place, part) in matches.into_iter().enumerate() {
            sums[place] += value * part;
            wholes[place] += part;
        }
    }
    let [x, y, z] = [0, 1, 2].map(|place| sums[place] / wholes[place]);
    // XYZ to linear sRGB, IEC 61966-2-1.
    let r = 3.240_625_5 * x - 1.537_208 * y - 0.498_628_6 * z;
    let g = -0.968_930_7 * x + 1.875_756_1 * y + 0.041_517_5 * z;
    let b = 0.055_710_1 * x - 0.204_021_1 * y + 1.056_995_9 * z;
    Rgb::new(r as f32, g as f32, b as f32)
}

/// The value at a wavelength: linear between neighbours, zero outside.
fn at(spectrum: &[[f64; 2]], wavelength: f64) -> f64 {
    let after = spectrum.partition_point(|[at, _]| *at <= wavelength);
    let Some([left, before]) = after.checked_sub(1).map(|place| spectrum[place]) else { return 0.0 };
    match spectrum.get(after) {
        Some([right, value]) => before + (value - before) * (wavelength - left) / (right - left),
        None if wavelength == left => before,
        None => 0.0,
    }
}

/// The colour of a spectrum of light; none of its channels is negative.
pub(super) fn color_of_light(spectrum: &[[f64; 2]]) -> Rgb {
    light(|wavelength| at(spectrum, wavelength)).map(|value| value.max(0.0))
}

/// The colour of a spectrum of a surface: 1 at all wavelengths is white.
pub(super) fn color_of_surface(spectrum: &[[f64; 2]]) -> Rgb {
    let white = light(|_| 1.0);
    let color = color_of_light(spectrum);
    Rgb::new(color.r / white.r, color.g / white.g, color.b / white.b)
}

/// Planck's law: the colour of a black body's radiance in W·sr⁻¹·m⁻²·nm⁻¹.
pub(super) fn blackbody(temperature: f64, scale: f64) -> Rgb {
    /// Planck's constant times the speed of light, J·m.
    const HC: f64 = 6.626_070_15e-34 * SPEED_OF_LIGHT;
    const SPEED_OF_LIGHT: f64 = 299_792_458.0;
    const BOLTZMANN: f64 = 1.380_649e-23;
    let radiance = |nanometres: f64| {
        let wavelength = nanometres * 1e-9;
        let fifth = wavelength * wavelength * wavelength * wavelength * wavelength;
        let photon = HC / (wavelength * BOLTZMANN * temperature);
        scale * 1e-9 * 2.0 * HC * SPEED_OF_LIGHT / (fifth * libm::expm1(photon))
    };
    light(radiance).map(|value| value.max(0.0))
}

/// The `value` of a spectrum: one number for all wavelengths, or `400:0.1, 500:0.2`.
pub(super) fn literal(text: &str) -> Result<Value, String> {
    if !text.contains(':') {
        return match literal::numbers(text)?[..] {
            [value] => Ok(Value::Spectrum(constant(value))),
            [r, g, b] => Ok(Value::Color(Rgb::new(r as f32, g as f32, b as f32))),
            ref all => Err(format!("has {} numbers, expected one, or pairs such as 400:0.1", all.len())),
        };
    }
    let pairs = text.split(|c: char| c.is_whitespace() || c == ',').filter(|word| !word.is_empty());
    let pair = |word: &str| {
        let (wavelength, value) = word.split_once(':').ok_or_else(|| {
            format!("\"{}\" is no pair of wavelength and value such as 400:0.1", clip(word))
        })?;
        Ok([literal::number(wavelength)?, literal::number(value)?])
    };
    rising(pairs.map(pair).collect::<Result<_, String>>()?).map(Value::Spectrum)
}

/// A file of lines with a wavelength and a value, `#` before comments.
pub(super) fn file(text: &str) -> Result<Value, String> {
    let mut pairs = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or("").trim();
        if line.is_empty() {
            continue;
        }
        let numbers = literal::numbers(line).map_err(|message| format!("line {}: {message}", index + 1))?;
        let [wavelength, value] = numbers[..] else {
            return Err(format!("line {} has {} numbers, expected 2", index + 1, numbers.len()));
        };
        pairs.push([wavelength, value]);
    }
    rising(pairs).map(Value::Spectrum)
}

/// The same value at all wavelengths.
pub(super) fn constant(value: f64) -> Vec<[f64; 2]> {
    vec![[0.0, value], [1e6, value]]
}

/// Wavelengths and values, if there are any and the wavelengths rise.
pub(super) fn rising(pairs: Vec<[f64; 2]>) -> Result<Vec<[f64; 2]>, String> {
    if pairs.is_empty() {
        return Err("is a spectrum without values".to_owned());
    }
    match pairs.windows(2).find(|two| two[1][0] <= two[0][0]) {
        Some(two) => Err(format!("wavelengths must rise, but {} comes after {}", two[1][0], two[0][0])),
        None => Ok(pairs),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(color: Rgb, [r, g, b]: [f32; 3], off: f32) {
        let difference = (color - Rgb::new(r, g, b)).map(f32::abs).max_channel();
        assert!(difference <= off, "{color:?} is {difference} off");
    }

    #[test]
    fn the_constant_spectrum_is_equal_energy_white() {
        // The linear sRGB of X = Y = Z = 1: the sums of the rows of the matrix.
        near(color_of_light(&constant(1.0)), [1.2048, 0.9483, 0.9087], 1e-4);
        near(color_of_surface(&constant(0.5)), [0.5; 3], 1e-6);
    }

    #[test]
    fn a_body_of_6500_kelvin_is_nearly_white_and_one_of_2000_red() {
        let day = blackbody(6504.0, 1.0);
        // Chromaticity 0.3135, 0.3237 in linear sRGB.
        let off = |have: f32, expected: f32| (have / expected - 1.0).abs();
        assert!(off(day.r / day.g, 1.0596) < 0.01 && off(day.b / day.g, 1.0515) < 0.01, "{day:?}");
        let coals = blackbody(2000.0, 1.0);
        assert!(coals.r > 2.0 * coals.g && coals.g > 5.0 * coals.b, "{coals:?}");
        // Twice the factor is twice the light.
        near(blackbody(2000.0, 2.0) * 0.5, [coals.r, coals.g, coals.b], coals.r * 1e-6);
    }

    #[test]
    fn the_cornell_box_green_is_green() {
        let Ok(Value::Spectrum(green)) =
            literal("400:0.09, 500:0.29, 520:0.46, 560:0.37, 600:0.18, 700:0.11")
        else {
            panic!("is a spectrum")
        };
        let color = color_of_surface(&green);
        assert!(color.g > 2.0 * color.r && color.g > 2.0 * color.b, "{color:?}");
    }

    #[test]
    fn spectra_that_are_none_say_why() {
        for (text, expected) in [
            ("400:x", "\"x\" is no number"),
            ("400 500:1", "\"400\" is no pair"),
            ("500:1, 400:2", "wavelengths must rise, but 400 comes after 500"),
            (":", "\"\" is no number"),
            ("", "has 0 numbers"),
        ] {
            let message = literal(text).unwrap_err();
            assert!(message.contains(expected), "{text}: {message}");
        }
        assert!(file("# none").unwrap_err().contains("without values"));
        assert!(file("400 1\n500 x").unwrap_err().contains("line 2: \"x\" is no number"));
        assert!(matches!(file("400 1 # one\n\n500 2"), Ok(Value::Spectrum(all)) if all.len() == 2));
    }
}
