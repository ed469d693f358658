//! Single values as attributes write them.

use crate::scene_file::clip;
use glam::{DVec3, Vec3};
use luch_image::{Rgb, srgb};

/// Numbers beyond this leave no room for sums and products.
pub(super) const LARGEST: f64 = 1e18;

/// A whole number.
pub(super) fn integer(text: &str) -> Result<i64, String> {
    text.trim().parse().map_err(|_| format!("\"{}\" is no whole number", clip(text)))
}

/// A number, at most [`LARGEST`] in size.
pub(super) fn number(text: &str) -> Result<f64, String> {
    let value: f64 = text.trim().parse().map_err(|_| format!("\"{}\" is no number", clip(text)))?;
    if value.abs() <= LARGEST {
        Ok(value)
    } else {
        Err(format!("{} is no number of at most {LARGEST:e}", clip(text)))
    }
}

/// `true` or `false`, in any case.
pub(super) fn flag(text: &str) -> Result<bool, String> {
    match text.trim() {
        t if t.eq_ignore_ascii_case("true") => Ok(true),
        t if t.eq_ignore_ascii_case("false") => Ok(false),
        _ => Err(format!("\"{}\" is neither true nor false", clip(text))),
    }
}

/// Numbers separated by blanks or commas.
pub(super) fn numbers(text: &str) -> Result<Vec<f64>, String> {
    let words = text.split(|c: char| c.is_whitespace() || c == ',').filter(|word| !word.is_empty());
    words.map(number).collect()
}

/// Three numbers.
pub(super) fn vector(text: &str) -> Result<Vec3, String> {
    match numbers(text)?[..] {
        [x, y, z] => Ok(DVec3::new(x, y, z).as_vec3()),
        ref all => Err(format!("has {} numbers, expected 3", all.len())),
    }
}

/// Linear red, green and blue, one number for gray, or `#rrggbb` on the scale of screens.
pub(super) fn color(text: &str) -> Result<Rgb, String> {
    if text.trim_start().starts_with('#') {
        return screen_color(text);
    }
    match numbers(text)?[..] {
        [gray] => Ok(Rgb::gray(gray as f32)),
        [r, g, b] => Ok(Rgb::new(r as f32, g as f32, b as f32)),
        ref all => Err(format!("has {} numbers, expected 3, one for gray, or \"#rrggbb\"", all.len())),
    }
}

/// A colour by the sRGB curve: `#rrggbb`, three numbers from 0 to 1, or one for gray.
pub(super) fn screen_color(text: &str) -> Result<Rgb, String> {
    let Some(digits) = text.trim().strip_prefix('#') else {
        return color(text).map(|color| color.map(srgb::decode));
    };
    let wrong = || format!("\"{}\" is no colour, expected \"#rrggbb\"", clip(text));
    if digits.len() != 6 || !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
        return Err(wrong());
    }
    let packed = u32::from_str_radix(digits, 16).map_err(|_| wrong())?;
    let [_, r, g, b] = packed.to_be_bytes();
    Ok(Rgb::new(srgb::decode_u8(r), srgb::decode_u8(g), srgb::decode_u8(b)))
}
