//! Smaller copies of a picture, each half as wide and high: what it looks like from afar (Williams, "Pyramidal Parametrics", 1983).

use crate::{Bitmap, Encoding, Pixels, srgb};

/// Copies of at most so many pixels are kept exactly; what they weigh is nothing beside the picture.
const KEPT_EXACTLY: usize = 64 * 64;

/// Relative differences that are taken for the rounding of sums of nine products, over all levels.
const ROUNDING: f32 = 64.0 * f32::EPSILON;

/// A picture at half, a quarter, an eighth … of its width and height, down to one pixel.
///
/// Every pixel of a copy is the mean of the light of the area it covers, and so the mean of a copy is that of the picture. Copies of
/// pictures with 8 or 16 bits have as many: a mean between two codes becomes one of them, chosen by its place so that the
/// light is right on average. All copies together take a third of the memory of the picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Pyramid {
    levels: Vec<Bitmap>,
}

impl Pyramid {
    /// The smaller copies of `base`, whose stored numbers are read by `encoding`. There are none if it has one pixel.
    pub fn new(base: &Bitmap, encoding: Encoding) -> Self {
        let mut levels = Vec::new();
        if base.width == 0 || base.height == 0 {
            return Self { levels };
        }
        let (mut width, mut height) = (base.width, base.height);
        let mut light: Option<Vec<[f32; 4]>> = None;
        while width > 1 || height > 1 {
            let halved = match &light {
                None => halve(width, height, |x, y| base.linear(x, y, encoding)),
                Some(light) => halve(width, height, |x, y| light[y as usize * width as usize + x as usize]),
            };
            (width, height) = (width.div_ceil(2), height.div_ceil(2));
            let pixels = if halved.len() <= KEPT_EXACTLY {
                Pixels::F32(halved.clone())
            } else {
                stored(&halved, &base.pixels, encoding, levels.len() as u32)
            };
            levels.push(Bitmap { width, height, pixels, encoding, has_alpha: base.has_alpha });
            light = Some(halved);
        }
        Self { levels }
    }

    /// The copies: the first has half the width and height of the picture, rounded up, the last one pixel.
    pub fn levels(&self) -> &[Bitmap] {
        &self.levels
    }

    /// Memory that the copies take, in bytes.
    pub fn memory_bytes(&self) -> usize {
        self.levels.iter().map(Bitmap::memory_bytes).sum()
    }
}

/// A picture of half the size: each of its pixels is the mean of the area it covers, parts of pixels included.
fn halve(width: u32, height: u32, at: impl Fn(u32, u32) -> [f32; 4]) -> Vec<[f32; 4]> {
    let (columns, rows) = (Taps::all(width), Taps::all(height));
    let mut halved = Vec::with_capacity(columns.len() * rows.len());
    for row in &rows {
        for column in &columns {
            let mut sum = [0.0; 4];
            for (y, row_weight) in row.pixels() {
                for (x, column_weight) in column.pixels() {
                    for (total, value) in sum.iter_mut().zip(at(x, y)) {
                        *total += row_weight * column_weight * value;
                    }
                }
            }
            halved.push(sum);
        }
    }
    halved
}

/// What one pixel of the smaller picture covers along an axis: up to three pixels with weights that add up to 1.
struct Taps {
    first: u32,
    weights: [f32; 3],
}

impl Taps {
    /// For a row of `length` pixels those of the row of half as many, rounded up.
    fn all(length: u32) -> Vec<Self> {
        let count = length.div_ceil(2);
        if length == 1 {
            return vec![Self { first: 0, weights: [1.0, 0.0, 0.0] }];
        }
        // Pixel i covers from i·length / count to (i + 1)·length / count, here in units of 1 / count.
        let (long, short) = (u64::from(length), u64::from(count));
        let cover = |i: u64| {
            let (from, to) = (i * long, (i + 1) * long);
            let first = from / short;
            let weight = |place: u64| {
                let (start, end) = (place * short, (place + 1) * short);
                end.min(to).saturating_sub(start.max(from)) as f32 / long as f32
            };
            Self { first: first as u32, weights: [weight(first), weight(first + 1), weight(first + 2)] }
        };
        (0..short).map(cover).collect()
    }

    /// The pixels that count.
    fn pixels(&self) -> impl Iterator<Item = (u32, f32)> {
        (self.first..).zip(self.weights).filter(|(_, weight)| *weight > 0.0)
    }
}

/// Light in the form of the picture.
fn stored(light: &[[f32; 4]], form: &Pixels, encoding: Encoding, level: u32) -> Pixels {
    match form {
        Pixels::F32(_) => Pixels::F32(light.to_vec()),
        Pixels::U8(_) => {
            let color = |code: u32| match encoding {
                Encoding::Srgb => srgb::decode_u8(code as u8),
                Encoding::Linear => code as f32 / 255.0,
            };
            let near = |value: f32| match encoding {
                Encoding::Srgb => u32::from(srgb::encode_u8(value)),
                Encoding::Linear => (value * 255.0) as u32,
            };
            let code = |value: f32, chance: f32, is_alpha: bool| match is_alpha {
                true => between(value, chance, 255, |v| (v * 255.0) as u32, |code| code as f32 / 255.0) as u8,
                false => between(value, chance, 255, near, color) as u8,
            };
            Pixels::U8(light.iter().enumerate().map(|(at, pixel)| coded(pixel, at, level, code)).collect())
        }
        Pixels::U16(_) => {
            let color = |code: u32| match encoding {
                Encoding::Srgb => srgb::decode_u16(code as u16),
                Encoding::Linear => code as f32 / 65535.0,
            };
            let near = |value: f32| match encoding {
                Encoding::Srgb => u32::from(srgb::encode_u16(value)),
                Encoding::Linear => (value * 65535.0) as u32,
            };
            let code = |value: f32, chance: f32, is_alpha: bool| match is_alpha {
                true => between(value, chance, 65535, |v| (v * 65535.0) as u32, |code| code as f32 / 65535.0)
                    as u16,
                false => between(value, chance, 65535, near, color) as u16,
            };
            Pixels::U16(light.iter().enumerate().map(|(at, pixel)| coded(pixel, at, level, code)).collect())
        }
    }
}

/// The four codes of pixel number `at`.
fn coded<C>(pixel: &[f32; 4], at: usize, level: u32, code: impl Fn(f32, f32, bool) -> C) -> [C; 4] {
    std::array::from_fn(|channel| {
        // One draw for each number: bits of its place, mixed well (Steele, Lea and Flood 2014).
        let mut bits =
            ((at as u64) << 7 | u64::from(level) << 2 | channel as u64).wrapping_add(0x9e37_79b9_7f4a_7c15);
        bits = (bits ^ bits >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ bits >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        let chance = (bits >> 40) as f32 / (1u32 << 24) as f32;
        code(pixel[channel], chance, channel == 3)
    })
}

/// One of the two codes around `value`, the upper one with the probability that makes the mean right. `near` is at most one code off.
fn between(
    value: f32,
    chance: f32,
    most: u32,
    near: impl Fn(f32) -> u32,
    decode: impl Fn(u32) -> f32,
) -> u32 {
    let near = near(value.clamp(0.0, 1.0)).min(most);
    let mut low = (near + 1).min(most);
    while low > 0 && decode(low) > value {
        low -= 1;
    }
    if low == most {
        return most;
    }
    let (under, over) = (decode(low), decode(low + 1));
    // What is a code but for the rounding of its sum stays that code.
    let rounding = ROUNDING * value;
    let part = (value - under) / (over - under);
    low + u32::from(over - value <= rounding || (value - under > rounding && chance < part))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bitmap(width: u32, height: u32, pixels: Pixels, encoding: Encoding) -> Bitmap {
        Bitmap { width, height, pixels, encoding, has_alpha: true }
    }

    #[test]
    fn levels_halve_down_to_one_pixel_and_weigh_a_third() {
        let base = bitmap(300, 7, Pixels::U8(vec![[10, 20, 30, 255]; 2100]), Encoding::Srgb);
        let pyramid = Pyramid::new(&base, Encoding::Srgb);
        let sizes: Vec<_> = pyramid.levels().iter().map(|level| (level.width, level.height)).collect();
        assert_eq!(sizes[..4], [(150, 4), (75, 2), (38, 1), (19, 1)]);
        assert_eq!(sizes.last(), Some(&(1, 1)));
        let large = bitmap(1024, 1024, Pixels::U8(vec![[1; 4]; 1 << 20]), Encoding::Linear);
        let weight =
            Pyramid::new(&large, Encoding::Linear).memory_bytes() as f64 / large.memory_bytes() as f64;
        assert!((0.33..0.36).contains(&weight), "{weight}");
        let single = bitmap(1, 1, Pixels::U8(vec![[1; 4]]), Encoding::Srgb);
        assert!(Pyramid::new(&single, Encoding::Srgb).levels().is_empty());
    }

    #[test]
    fn one_colour_stays_itself_in_every_form() {
        for code in [0_u8, 1, 77, 200, 254, 255] {
            let eight = Pixels::U8(vec![[code, 255 - code, 3, code]; 201 * 150]);
            let sixteen = Pixels::U16(vec![[u16::from(code) * 129, 65535, 0, 12345]; 201 * 150]);
            let float = Pixels::F32(vec![[f32::from(code) * 3.0, 0.25, 1.0, 0.5]; 201 * 150]);
            for pixels in [eight, sixteen, float] {
                for encoding in [Encoding::Srgb, Encoding::Linear] {
                    let base = bitmap(201, 150, pixels.clone(), encoding);
                    let expected = base.linear(0, 0, encoding);
                    for level in Pyramid::new(&base, encoding).levels() {
                        let places = (0..level.height).flat_map(|y| (0..level.width).map(move |x| (x, y)));
                        for (x, y) in places {
                            for (found, expected) in level.linear(x, y, encoding).into_iter().zip(expected) {
                                // Codes are the same; the exact levels sum weights that add up to 1 but for some roundings.
                                let rounding =
                                    if matches!(level.pixels, Pixels::F32(_)) { 1e-5 } else { 0.0 };
                                assert!(
                                    (found - expected).abs() <= rounding * expected,
                                    "{found} {expected}"
                                );
                            }
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn the_mean_of_every_copy_is_that_of_the_picture() {
        // Noise of all codes, sides that are no powers of two.
        let (width, height) = (517_u32, 389_u32);
        let mut state = 1_u64;
        let mut noise = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 56) as u8
        };
        let pixels: Vec<[u8; 4]> =
            (0..width * height).map(|_| [noise(), noise(), noise(), noise()]).collect();
        for encoding in [Encoding::Srgb, Encoding::Linear] {
            let base = bitmap(width, height, Pixels::U8(pixels.clone()), encoding);
            let expected = base.average();
            for level in Pyramid::new(&base, encoding).levels() {
                let count = f64::from(level.width) * f64::from(level.height);
                // The choice between two codes has a deviation of half a step at most; a step of sRGB is 0.009 of light at most.
                let error = if count > KEPT_EXACTLY as f64 { 4.0 * 0.0045 / count.sqrt() } else { 1e-5 };
                for (found, expected) in level.average().into_iter().zip(expected) {
                    let difference = f64::from(found - expected).abs();
                    assert!(difference < error, "{} × {}: {found} {expected}", level.width, level.height);
                }
            }
        }
    }
}
