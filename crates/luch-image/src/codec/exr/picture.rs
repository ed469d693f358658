//! From channels to one picture, or to named layers.

use super::header::{Part, read_parts};
use super::planes::read_planes;
use crate::codec::metadata::Reading;
use crate::codec::{DecodeError, Format, Layer, Layers, MAX_PIXELS, Metadata};
use crate::{Bitmap, Encoding, Pixels};

/// Which channels of a part make a picture.
struct Choice {
    part: usize,
    kind: Kind,
}

enum Kind {
    /// `R`, `G`, `B`, `A` behind a prefix; channels that are absent are 0 (alpha 1).
    Color { prefix: String },
    /// Luminance, and chroma if it is there.
    Luminance { has_chroma: bool },
    /// A single channel, shown gray.
    Gray { name: String },
}

/// The first part with plain colour or luminance, else the first coloured layer, else the only channel.
fn choose(parts: &[Part]) -> Option<Choice> {
    let plain = parts.iter().enumerate().find_map(|(part, Part { channels, .. })| {
        let has = |name: &str| channels.iter().any(|channel| channel == name);
        let kind = if has("R") || has("G") || has("B") {
            Kind::Color { prefix: String::new() }
        } else if has("Y") {
            Kind::Luminance { has_chroma: has("RY") && has("BY") }
        } else {
            return None;
        };
        Some(Choice { part, kind })
    });
    let layered = || {
        parts.iter().enumerate().find_map(|(part, Part { channels, .. })| {
            let is_there = |prefix: &str, letter: &str| {
                channels.iter().any(|channel| channel.strip_prefix(prefix).is_some_and(|rest| rest == letter))
            };
            let mut prefixes = channels.iter().filter_map(|channel| channel.strip_suffix(".R"));
            let prefix = prefixes.find(|prefix| is_there(prefix, ".G") && is_there(prefix, ".B"))?;
            Some(Choice { part, kind: Kind::Color { prefix: format!("{prefix}.") } })
        })
    };
    let single = || {
        parts.iter().enumerate().find_map(|(part, Part { channels, .. })| match &channels[..] {
            [name] => Some(Choice { part, kind: Kind::Gray { name: name.clone() } }),
            _ => None,
        })
    };
    plain.or_else(layered).or_else(single)
}

/// The picture of a file.
pub(in crate::codec) fn decode(bytes: &[u8]) -> Result<Bitmap, DecodeError> {
    let parts = read_parts(bytes)?;
    let Some(Choice { part, kind }) = choose(&parts) else {
        let names: Vec<&str> =
            parts.iter().flat_map(|part| &part.channels).take(20).map(String::as_str).collect();
        let what = format!("a file without R, G, B or Y (its channels are {})", names.join(", "));
        return Err(DecodeError::unsupported(Format::Exr, what));
    };
    let (prefix, names): (&str, &[&str]) = match &kind {
        Kind::Color { prefix } => (prefix, &["R", "G", "B", "A"]),
        Kind::Luminance { has_chroma: true } => ("", &["RY", "Y", "BY", "A"]),
        Kind::Luminance { has_chroma: false } => ("", &["", "Y", "", "A"]),
        Kind::Gray { name } => ("", &["", name, "", ""]),
    };
    let slot = |channel: &str| {
        let name = channel.strip_prefix(prefix)?;
        names.iter().position(|wanted| !name.is_empty() && *wanted == name)
    };
    let planes = read_planes(bytes, &parts, part, |channel| slot(channel).is_some())?;

    // Channels into pixels.
    let window = parts[part].display_window;
    let has_alpha = planes.iter().any(|(name, _)| slot(name) == Some(3));
    let mut pixels =
        vec![[0.0, 0.0, 0.0, if has_alpha { 0.0 } else { 1.0 }]; (window.width * window.height) as usize];
    for (name, plane) in &planes {
        let Some(slot) = slot(name) else { continue };
        pixels.iter_mut().zip(plane).for_each(|(pixel, &value)| pixel[slot] = value);
    }
    match kind {
        Kind::Color { .. } => {}
        Kind::Luminance { has_chroma: true } => {
            pixels.iter_mut().for_each(|pixel| *pixel = from_chroma(*pixel))
        }
        Kind::Luminance { has_chroma: false } | Kind::Gray { .. } => {
            pixels.iter_mut().for_each(|pixel| *pixel = [pixel[1], pixel[1], pixel[1], pixel[3]]);
        }
    }
    let (width, height) = (window.width as u32, window.height as u32);
    Ok(Bitmap { width, height, pixels: Pixels::F32(pixels), encoding: Encoding::Linear, has_alpha })
}

/// RY = (R − Y)/Y, BY = (B − Y)/Y with the luminance of Rec. 709 ("Technical introduction to OpenEXR").
fn from_chroma([ry, y, by, alpha]: [f32; 4]) -> [f32; 4] {
    let (r, b) = ((ry + 1.0) * y, (by + 1.0) * y);
    let g = (y - 0.212_639 * r - 0.072_192 * b) / 0.715_169;
    [r, g, b, alpha]
}

/// All channels of an OpenEXR file, grouped into layers by the part of their name before the last dot, sorted by
/// name, channels in the order R, G, B, A and then by name. In files of several parts a channel without a dot belongs
/// to the layer named like its part (in the first part to `""`). All numbers become `f32`; the size is that of the
/// display window.
///
/// # Errors
/// [`DecodeError`] if the file is damaged, too large, or holds deep or subsampled data.
pub fn decode_exr_layers(bytes: &[u8]) -> Result<Layers, DecodeError> {
    let parts = read_parts(bytes)?;
    let window = parts[0].display_window;
    let channels: u64 = parts.iter().map(|part| part.channels.len() as u64).sum();
    if channels.saturating_mul(window.width * window.height) > 4 * MAX_PIXELS {
        let (width, height) = (window.width, window.height);
        return Err(DecodeError::TooLarge { format: Format::Exr, width, height, channels });
    }
    let mut layers = Layers { width: window.width as u32, height: window.height as u32, layers: Vec::new() };
    for (index, part) in parts.iter().enumerate() {
        if (part.display_window.width, part.display_window.height) != (window.width, window.height) {
            return Err(DecodeError::unsupported(
                Format::Exr,
                "parts with display windows of different sizes",
            ));
        }
        let part_name = if index == 0 { String::new() } else { part.text("name").unwrap_or_default() };
        for (name, plane) in read_planes(bytes, &parts, index, |_| true)? {
            let (layer, channel) = match name.rsplit_once('.') {
                Some((layer, channel)) => (layer.to_owned(), channel.to_owned()),
                None => (part_name.clone(), name),
            };
            let place = layers.layers.iter().position(|known| known.name == layer).unwrap_or_else(|| {
                layers.layers.push(Layer { name: layer, channels: Vec::new() });
                layers.layers.len() - 1
            });
            // Parts may repeat a name (stereo views do): the first one counts.
            if layers.layers[place].channel(&channel).is_none() {
                layers.layers[place].channels.push((channel, plane));
            }
        }
    }
    layers.layers.sort_by(|a, b| a.name.cmp(&b.name));
    for layer in &mut layers.layers {
        let rank = |name: &str| ["R", "G", "B", "A"].iter().position(|letter| *letter == name).unwrap_or(4);
        layer.channels.sort_by(|(a, _), (b, _)| rank(a).cmp(&rank(b)).then_with(|| a.cmp(b)));
    }
    Ok(layers)
}

/// The `string` attributes of the first part that are not the format's own.
pub(in crate::codec) fn read_metadata(bytes: &[u8]) -> Result<Metadata, DecodeError> {
    let parts = read_parts(bytes)?;
    let mut texts = Reading::new(Format::Exr);
    for attribute in &parts[0].attributes {
        if attribute.kind == "string" && !super::write::is_reserved(&attribute.name) {
            texts.add(&attribute.name, String::from_utf8_lossy(attribute.value))?;
        }
    }
    Ok(texts.finish())
}
