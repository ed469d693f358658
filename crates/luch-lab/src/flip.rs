//! ꟻLIP: how much of a difference somebody sees who flips between two pictures.
//!
//! Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild, "ꟻLIP: a difference evaluator for alternating images" (2020). The
//! constants are those of the paper; its authors' program gives the same numbers to some 10⁻⁵.

use luch_image::compare::SizeMismatch;
use luch_image::{Image, Rgb};
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Pixels in a degree of sight at 0.7 m from a screen 0.7 m and 3840 pixels wide: what the paper assumes.
pub const USUAL_PIXELS_PER_DEGREE: f64 = 3840.0 * PI / 180.0;

/// Exponent of colour differences, q_c of the paper.
const COLOR_EXPONENT: f64 = 0.7;
/// Exponent of feature differences, q_f.
const FEATURE_EXPONENT: f64 = 0.5;
/// Differences up to this part of the largest, p_c, …
const KNEE: f64 = 0.4;
/// … fill this part of the scale, p_t.
const AT_KNEE: f64 = 0.95;
/// Width of the edges and points that are looked for, degrees.
const FEATURE_WIDTH: f64 = 0.082;

/// Difference of every pixel from 0, none, to 1, for an observer who sees `pixels_per_degree` (0.1 to 1000; see
/// [`USUAL_PIXELS_PER_DEGREE`]).
///
/// The pictures are display-linear, as [`Tone::apply`](luch_image::tone::Tone::apply) gives them: channels outside 0 to 1 are clipped, NaN is 0.
/// The measure is symmetric.
///
/// # Errors
/// [`SizeMismatch`] if their sizes differ.
pub fn flip(a: &Image<Rgb>, b: &Image<Rgb>, pixels_per_degree: f64) -> Result<Image<f32>, SizeMismatch> {
    let sizes = [a, b].map(|image| [image.width(), image.height()]);
    if sizes[0] != sizes[1] {
        return Err(SizeMismatch { a: sizes[0], b: sizes[1] });
    }
    let per_degree =
        if pixels_per_degree.is_nan() { USUAL_PIXELS_PER_DEGREE } else { pixels_per_degree.clamp(0.1, 1e3) };
    let [first, second] = [a, b].map(|image| Seen::new(image, per_degree));
    let pixels = (0..a.pixels().len()).map(|at| {
        let color = color_difference(first.colors[at], second.colors[at]);
        let edge = (first.edges[at] - second.edges[at]).abs();
        let point = (first.points[at] - second.points[at]).abs();
        let feature = libm::pow(edge.max(point) * std::f64::consts::FRAC_1_SQRT_2, FEATURE_EXPONENT);
        libm::pow(color, 1.0 - feature.min(1.0)) as f32
    });
    let pixels: Vec<f32> = pixels.collect();
    let mut pixels = pixels.into_iter();
    Ok(a.map(|_| pixels.next().unwrap_or_default()))
}

/// Mean of the differences of [`flip`], 0 to 1.
///
/// # Errors
/// [`SizeMismatch`] if the sizes differ.
pub fn mean_flip(a: &Image<Rgb>, b: &Image<Rgb>, pixels_per_degree: f64) -> Result<f64, SizeMismatch> {
    flip(a, b, pixels_per_degree).map(|map| mean_of(&map))
}

/// Mean of a map of differences; 0 if it has no pixels.
pub fn mean_of(map: &Image<f32>) -> f64 {
    map.pixels().iter().map(|&pixel| f64::from(pixel)).sum::<f64>() / map.pixels().len().max(1) as f64
}

/// A picture as the eye has it.
struct Seen {
    /// After the contrast sensitivity of the eye: L*, a*, b* with Hunt's adjustment.
    colors: Vec<[f64; 3]>,
    /// Strength of edges.
    edges: Vec<f64>,
    /// Strength of points.
    points: Vec<f64>,
}

impl Seen {
    fn new(image: &Image<Rgb>, per_degree: f64) -> Self {
        let (width, height) = (image.width() as usize, image.height() as usize);
        let opponent: Vec<[f64; 3]> = image
            .pixels()
            .iter()
            .map(|pixel| {
                opponent_of(pixel.to_array().map(|v| if v > 0.0 { f64::from(v.min(1.0)) } else { 0.0 }))
            })
            .collect();
        let plane = |channel: usize| Plane {
            width,
            height,
            values: opponent.iter().map(|pixel| pixel[channel]).collect(),
        };
        let [y, x, z] = [0, 1, 2].map(plane);
        let [filtered_y, filtered_x, filtered_z] = [(&y, LUMINANCE), (&x, RED_GREEN), (&z, BLUE_YELLOW)]
            .map(|(plane, terms)| plane.blurred(terms, per_degree));
        let colors = (0..y.values.len())
            .map(|at| {
                let light = light_of([filtered_y[at], filtered_x[at], filtered_z[at]]);
                adjusted(lab_of(light.map(|v| v.clamp(0.0, 1.0))))
            })
            .collect();
        let gray = Plane { values: y.values.iter().map(|y| (y + 16.0) / 116.0).collect(), ..y };
        let features = Features::new(per_degree);
        Self {
            colors,
            edges: gray.strength(&features.slope, &features.bell),
            points: gray.strength(&features.bend, &features.bell),
        }
    }
}

/// Colour difference of the paper: HyAB, its exponent, its scale.
fn color_difference(a: [f64; 3], b: [f64; 3]) -> f64 {
    static LARGEST: LazyLock<f64> = LazyLock::new(|| {
        let of = |light: [f64; 3]| adjusted(lab_of(light));
        libm::pow(hyab(of([0.0, 1.0, 0.0]), of([0.0, 0.0, 1.0])), COLOR_EXPONENT)
    });
    let (difference, largest) = (libm::pow(hyab(a, b), COLOR_EXPONENT), *LARGEST);
    let knee = KNEE * largest;
    if difference < knee {
        AT_KNEE / knee * difference
    } else {
        (AT_KNEE + (difference - knee) / (largest - knee) * (1.0 - AT_KNEE)).min(1.0)
    }
}

/// Abasi, Tehran, Fairchild, "Distance metrics for very large color differences" (2019).
fn hyab(a: [f64; 3], b: [f64; 3]) -> f64 {
    let [l, x, z] = [0, 1, 2].map(|channel| a[channel] - b[channel]);
    l.abs() + (x * x + z * z).sqrt()
}

/// Colours look less colourful in the dark (Hunt).
fn adjusted([l, a, b]: [f64; 3]) -> [f64; 3] {
    [l, 0.01 * l * a, 0.01 * l * b]
}

/// From Rec. 709 light to CIE XYZ with white at (0.3127, 0.3290) in x and y.
const TO_XYZ: [[f64; 3]; 3] = [
    [0.412_390_799_265_960, 0.357_584_339_383_878, 0.180_480_788_401_834],
    [0.212_639_005_871_510, 0.715_168_678_767_756, 0.072_192_315_360_734],
    [0.019_330_818_715_592, 0.119_194_779_794_626, 0.950_532_152_249_661],
];

/// The inverse of it.
const FROM_XYZ: [[f64; 3]; 3] = [
    [3.240_969_941_904_521, -1.537_383_177_570_093, -0.498_610_760_293_003],
    [-0.969_243_636_280_880, 1.875_967_501_507_721, 0.041_555_057_407_176],
    [0.055_630_079_696_994, -0.203_976_958_888_977, 1.056_971_514_242_879],
];

fn times(matrix: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// Of white light.
fn white() -> [f64; 3] {
    times(&TO_XYZ, [1.0; 3])
}

/// The linear relative of CIELAB in which the eye's filters work: Y, C_x, C_z.
fn opponent_of(light: [f64; 3]) -> [f64; 3] {
    let (xyz, white) = (times(&TO_XYZ, light), white());
    let [x, y, z] = [0, 1, 2].map(|channel| xyz[channel] / white[channel]);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Back again.
fn light_of([y, cx, cz]: [f64; 3]) -> [f64; 3] {
    let y = (y + 16.0) / 116.0;
    let (relative, white) = ([y + cx / 500.0, y, y - cz / 200.0], white());
    times(&FROM_XYZ, [0, 1, 2].map(|channel| relative[channel] * white[channel]))
}

/// CIELAB of light (CIE 15).
fn lab_of(light: [f64; 3]) -> [f64; 3] {
    const DELTA: f64 = 6.0 / 29.0;
    let root = |t: f64| {
        if t > DELTA * DELTA * DELTA { libm::cbrt(t) } else { t / (3.0 * DELTA * DELTA) + 4.0 / 29.0 }
    };
    let (xyz, white) = (times(&TO_XYZ, light), white());
    let [x, y, z] = [0, 1, 2].map(|channel| root(xyz[channel] / white[channel]));
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// A term a·√(π/b)·exp(−π²r²/b) of a filter, r in degrees.
#[derive(Clone, Copy)]
struct Term {
    a: f64,
    b: f64,
}

/// Contrast sensitivities of the eye as filters: table 1 of the paper.
const LUMINANCE: &[Term] = &[Term { a: 1.0, b: 0.0047 }];
const RED_GREEN: &[Term] = &[Term { a: 1.0, b: 0.0053 }];
const BLUE_YELLOW: &[Term] = &[Term { a: 34.1, b: 0.04 }, Term { a: 13.5, b: 0.025 }];
/// The widest of all terms: three of its standard deviations are the radius of all filters.
const WIDEST: f64 = 0.04;

/// Numbers in rows.
struct Plane {
    width: usize,
    height: usize,
    values: Vec<f64>,
}

impl Plane {
    /// Under a sum of bells, of weight 1 together.
    fn blurred(&self, terms: &[Term], per_degree: f64) -> Vec<f64> {
        let radius = (3.0 * (WIDEST / (2.0 * PI * PI)).sqrt() * per_degree).ceil() as usize;
        let mut sum = vec![0.0; self.values.len()];
        let mut weight = 0.0;
        for term in terms {
            let bell: Vec<f64> = kernel(radius, |x| {
                let degrees = x / per_degree;
                libm::exp(-PI * PI * degrees * degrees / term.b)
            });
            let scale = term.a * (PI / term.b).sqrt();
            let total: f64 = bell.iter().sum();
            weight += scale * total * total;
            let smooth = self.across(&bell).down(&bell);
            sum.iter_mut().zip(smooth.values).for_each(|(sum, value)| *sum += scale * value);
        }
        sum.iter_mut().for_each(|value| *value /= weight);
        sum
    }

    /// Length of the pair of answers to a filter and the same filter turned by a quarter.
    fn strength(&self, along: &[f64], bell: &[f64]) -> Vec<f64> {
        let (x, y) = (self.across(along).down(bell), self.across(bell).down(along));
        x.values.iter().zip(y.values).map(|(x, y)| (x * x + y * y).sqrt()).collect()
    }

    /// Rows under a filter; what lies outside is as the nearest pixel.
    fn across(&self, filter: &[f64]) -> Plane {
        let radius = filter.len() / 2;
        let mut values = Vec::with_capacity(self.values.len());
        for row in self.values.chunks_exact(self.width.max(1)) {
            for x in 0..self.width {
                let at = |tap: usize| row[(x + tap).saturating_sub(radius).min(self.width - 1)];
                values.push(filter.iter().enumerate().map(|(tap, weight)| weight * at(tap)).sum());
            }
        }
        Plane { values, ..*self }
    }

    /// Columns under a filter.
    fn down(&self, filter: &[f64]) -> Plane {
        let radius = filter.len() / 2;
        let mut values = vec![0.0; self.values.len()];
        for (y, out) in values.chunks_exact_mut(self.width.max(1)).enumerate() {
            for (tap, weight) in filter.iter().enumerate() {
                let row = (y + tap).saturating_sub(radius).min(self.height - 1);
                let row = &self.values[row * self.width..(row + 1) * self.width];
                out.iter_mut().zip(row).for_each(|(out, value)| *out += weight * value);
            }
        }
        Plane { values, ..*self }
    }
}

/// A function at whole numbers from −radius to radius.
fn kernel(radius: usize, f: impl Fn(f64) -> f64) -> Vec<f64> {
    (0..=2 * radius).map(|tap| f(tap as f64 - radius as f64)).collect()
}

/// First and second derivatives of a bell, and the bell.
struct Features {
    slope: Vec<f64>,
    bend: Vec<f64>,
    bell: Vec<f64>,
}

impl Features {
    fn new(per_degree: f64) -> Self {
        let deviation = 0.5 * FEATURE_WIDTH * per_degree;
        let radius = (3.0 * deviation).ceil() as usize;
        let gauss = |x: f64| libm::exp(-x * x / (2.0 * deviation * deviation));
        let bell = kernel(radius, gauss);
        let total: f64 = bell.iter().sum();
        // Positive weights sum to 1 and negative ones to −1, each in the plane.
        let balanced = |raw: Vec<f64>| -> Vec<f64> {
            let up: f64 = raw.iter().filter(|w| **w > 0.0).sum();
            let down: f64 = -raw.iter().filter(|w| **w < 0.0).sum::<f64>();
            raw.into_iter().map(|w| if w < 0.0 { w / down } else { w / up }).collect()
        };
        Self {
            slope: balanced(kernel(radius, |x| -x * gauss(x))),
            bend: balanced(kernel(radius, |x| (x * x / (deviation * deviation) - 1.0) * gauss(x))),
            bell: bell.into_iter().map(|weight| weight / total).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn uniform(color: [f32; 3]) -> Image<Rgb> {
        Image::filled(40, 30, Rgb::from(color))
    }

    fn noise(seed: u32) -> Image<Rgb> {
        let value = |i: u32| {
            (i.wrapping_mul(2_654_435_761) ^ seed.wrapping_mul(40_503)).wrapping_mul(0x9e37_79b1) >> 8
        };
        let pixels = (0..50 * 33).map(|i| {
            Rgb::new(value(3 * i) as f32, value(3 * i + 1) as f32, value(3 * i + 2) as f32) / 16_777_216.0
        });
        Image::from_pixels(50, 33, pixels.collect()).unwrap()
    }

    #[test]
    fn equal_pictures_differ_nowhere_and_order_does_not_matter() {
        let (a, b) = (noise(1), noise(2));
        assert_eq!(mean_flip(&a, &a, USUAL_PIXELS_PER_DEGREE).unwrap(), 0.0);
        let there = flip(&a, &b, USUAL_PIXELS_PER_DEGREE).unwrap();
        assert_eq!(there, flip(&b, &a, USUAL_PIXELS_PER_DEGREE).unwrap());
        assert!(there.pixels().iter().all(|v| (0.0..=1.0).contains(v)));
        assert!(there.pixels().iter().any(|v| *v > 0.05));
    }

    /// Nothing has an edge here, so the colour difference stands alone; worked out by hand from the paper's formulas.
    #[test]
    fn uniform_pictures_have_the_difference_of_the_formulas() {
        let of = |a, b| {
            let map = flip(&uniform(a), &uniform(b), USUAL_PIXELS_PER_DEGREE).unwrap();
            assert!(map.pixels().iter().all(|v| (v - map.pixels()[0]).abs() < 1e-6));
            f64::from(map.pixels()[0])
        };
        // L* of green and blue: 87.735 and 32.297; adjusted (a, b): (−75.614, 72.980) and (25.578, −34.834).
        let largest = libm::pow(55.438 + 147.86_f64, 0.7);
        // Black and white: L* differ by 100 and nothing else does.
        let white = 0.95 + (libm::pow(100.0, 0.7) - 0.4 * largest) / (0.6 * largest) * 0.05;
        assert!((of([0.0; 3], [1.0; 3]) - white).abs() < 2e-5, "{} {white}", of([0.0; 3], [1.0; 3]));
        // Gray 0.18 against gray 0.2: L* 49.496 and 51.838.
        let gray = 0.95 / (0.4 * largest) * libm::pow(2.3416_f64, 0.7);
        assert!((of([0.18; 3], [0.2; 3]) - gray).abs() < 2e-4, "{} {gray}", of([0.18; 3], [0.2; 3]));
        // The pair that the scale ends with.
        assert!((of([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn from_afar_noise_is_not_seen() {
        let (a, b) = (noise(1), noise(2));
        let near = mean_flip(&a, &b, 20.0).unwrap();
        assert!(mean_flip(&a, &b, 200.0).unwrap() < 0.7 * near, "{near}");
    }

    #[test]
    fn anything_is_taken() {
        let strange = Image::filled(3, 2, Rgb::new(f32::NAN, f32::INFINITY, -1.0));
        let map = flip(&strange, &Image::filled(3, 2, Rgb::new(0.0, 1.0, 0.0)), f64::NAN).unwrap();
        assert_eq!(map.pixels(), [0.0; 6]);
        let none = Image::filled(0, 0, Rgb::BLACK);
        assert_eq!(mean_flip(&none, &none, 67.0).unwrap(), 0.0);
        assert!(flip(&none, &strange, 67.0).is_err());
    }

    #[test]
    fn light_comes_back() {
        for light in [[0.1, 0.7, 0.3], [1.0, 0.0, 0.5]] {
            let back = light_of(opponent_of(light));
            assert!(light.iter().zip(back).all(|(a, b)| (a - b).abs() < 1e-12), "{back:?}");
        }
    }
}
